// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqViewHandles.h"

#include "pqAlwaysInFront.h"
#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqServerManagerModel.h"
#include "pqSourceOf.h"
#include "pqUndoStack.h"
#include "vtkCommand.h"
#include "vtkHandleRepresentation.h"
#include "vtkNew.h"
#include "vtkSMNewWidgetRepresentationProxy.h"
#include "vtkSMParaViewPipelineController.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"

#include <QLabel>
#include <QVBoxLayout>

#include <algorithm>

/// A handle of ParaView's own, in no pipeline browser, state, trace or undo.
class pqViewHandles::Handle
{
public:
  Handle(pqViewHandles* owner, const QColor& color)
    : Owner(owner)
  {
    SCOPED_UNDO_EXCLUDE();
    vtkSmartPointer<vtkSMProxy> made;
    made.TakeReference(owner->proxy()->GetSessionProxyManager()->NewProxy(
      "representations", "HandleWidgetRepresentation"));
    this->Proxy = vtkSMNewWidgetRepresentationProxy::SafeDownCast(made);
    this->Proxy->PrototypeOn();
    vtkNew<vtkSMParaViewPipelineController> controller;
    controller->InitializeProxy(this->Proxy);
    this->show(false);
    pqAlwaysInFront::apply(this->Proxy, color);
    for (const unsigned long event : { vtkCommand::StartInteractionEvent,
           vtkCommand::InteractionEvent, vtkCommand::EndInteractionEvent })
    {
      this->Observers.add(this->Proxy, event, this, &Handle::tell);
    }
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle()
  {
    this->Observers.clear();
    this->addTo(nullptr);
  }

  void addTo(pqView* view)
  {
    SCOPED_UNDO_EXCLUDE();
    if (this->View)
    {
      vtkSMPropertyHelper(this->View->getProxy(), "HiddenRepresentations").Remove(this->Proxy);
      this->View->getProxy()->UpdateVTKObjects();
    }
    this->View = qobject_cast<pqRenderView*>(view);
    if (this->View && this->View->getProxy()->GetSession() != this->Proxy->GetSession())
    {
      this->View = nullptr;
    }
    if (this->View)
    {
      vtkSMPropertyHelper(this->View->getProxy(), "HiddenRepresentations").Add(this->Proxy);
      this->View->getProxy()->UpdateVTKObjects();
    }
  }

  void show(bool on)
  {
    vtkSMPropertyHelper(this->Proxy, "Visibility").Set(on ? 1 : 0);
    vtkSMPropertyHelper(this->Proxy, "Enabled").Set(on ? 1 : 0);
    this->Proxy->UpdateVTKObjects();
  }

  bool isShown() const
  {
    return this->View && vtkSMPropertyHelper(this->Proxy, "Visibility").GetAsInt() != 0;
  }

  void moveTo(const Place& place)
  {
    vtkSMPropertyHelper(this->Proxy, "WorldPosition").Set(place.data(), 3);
    this->Proxy->UpdateVTKObjects();
  }

  Place place() const
  {
    Place place = {};
    auto* shown = vtkHandleRepresentation::SafeDownCast(
      this->Proxy->GetRepresentationProxy()->GetClientSideObject());
    if (shown)
    {
      shown->GetWorldPosition(place.data());
    }
    return place;
  }

private:
  void tell(vtkObject*, unsigned long event, void*) { this->Owner->dragged(this, event); }

  pqViewHandles* Owner;
  vtkSmartPointer<vtkSMNewWidgetRepresentationProxy> Proxy;
  QPointer<pqRenderView> View;
  pqObservers Observers;
};

//------------------------------------------------------------------------------------------------
pqViewHandles::pqViewHandles(
  vtkSMProxy* smproxy, vtkSMProperty* numbers, const QString& hint, QWidget* parentWidget)
  : pqPropertyWidget(smproxy, parentWidget)
  , Numbers(numbers)
{
  this->setShowLabel(false);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* label = new QLabel(hint, this);
  label->setWordWrap(true);
  label->setObjectName("Hint");
  layout->addWidget(label);
  for (const auto event : { vtkCommand::ModifiedEvent, vtkCommand::UncheckedPropertyModifiedEvent })
  {
    this->Observers.add(numbers, event, this, &pqViewHandles::refreshSoon);
  }
  this->setChangeAvailableAsChangeFinished(false);
  this->Timer.setSingleShot(true);
  this->Timer.setInterval(1); // one of no time would wait until the mouse rests
  QObject::connect(&this->Timer, &QTimer::timeout, this, [this] { this->refresh(); });
  pqPipelineSource* source = pqSourceOf(smproxy);
  if (source)
  {
    QObject::connect(source, qOverload<pqPipelineSource*>(&pqPipelineSource::dataUpdated), this,
      [this] { this->refreshSoon(); }); // not in the middle of the update that tells of it
  }
}

pqViewHandles::~pqViewHandles() = default;

void pqViewHandles::select()
{
  this->pqPropertyWidget::select();
  this->updateVisibility();
  this->refreshSoon();
}

void pqViewHandles::deselect()
{
  this->pqPropertyWidget::deselect();
  this->updateVisibility();
  this->refresh();
}

void pqViewHandles::setView(pqView* newView)
{
  if (newView != this->view())
  {
    this->pqPropertyWidget::setView(newView);
    for (const auto& handle : this->Handles)
    {
      handle->addTo(newView);
    }
    this->updateVisibility();
    this->refreshSoon();
  }
}

void pqViewHandles::showEvent(QShowEvent* event)
{
  this->pqPropertyWidget::showEvent(event);
  this->updateVisibility();
  this->refreshSoon();
}

void pqViewHandles::hideEvent(QHideEvent* event)
{
  this->pqPropertyWidget::hideEvent(event);
  this->updateVisibility();
  this->refresh();
}

int pqViewHandles::shownHandles() const
{
  return static_cast<int>(std::count_if(this->Handles.begin(), this->Handles.end(),
    [](const std::unique_ptr<Handle>& handle) { return handle->isShown(); }));
}

std::vector<double> pqViewHandles::shownNumbers() const
{
  vtkSMPropertyHelper helper(this->Numbers.Get());
  helper.SetUseUnchecked(true);
  return helper.GetDoubleArray();
}

void pqViewHandles::showNumbers(const std::vector<double>& values)
{
  vtkSMPropertyHelper helper(this->Numbers.Get());
  helper.SetUseUnchecked(true);
  helper.Set(values.data(), static_cast<unsigned int>(values.size()));
}

QColor pqViewHandles::color(std::size_t /*handle*/) const
{
  return pqAlwaysInFront::Orange;
}

void pqViewHandles::refreshSoon()
{
  this->Timer.start();
}

bool pqViewHandles::isInUse() const
{
  return this->isSelected() && this->isVisible() && this->view() != nullptr;
}

void pqViewHandles::updateVisibility()
{
  Q_EMIT this->widgetVisibilityUpdated(this->isInUse());
}

void pqViewHandles::refresh()
{
  const std::vector<Place> places = this->isInUse() ? this->places() : std::vector<Place>();
  bool changed = false;
  if (!this->Dragged && this->Handles.size() > places.size())
  {
    changed = true;
    this->Handles.resize(places.size());
  }
  while (this->Handles.size() < places.size())
  {
    changed = true;
    this->Handles.push_back(std::make_unique<Handle>(this, this->color(this->Handles.size())));
    this->Handles.back()->addTo(this->view());
  }
  for (std::size_t k = 0; k < std::min(this->Handles.size(), places.size()); ++k)
  {
    Handle& handle = *this->Handles[k];
    if (&handle != this->Dragged && (!handle.isShown() || handle.place() != places[k]))
    {
      changed = true;
      handle.moveTo(places[k]);
      handle.show(true);
    }
  }
  if (changed && !this->Dragged && this->view())
  {
    this->view()->render();
  }
}

void pqViewHandles::dragged(Handle* handle, unsigned long event)
{
  if (event == vtkCommand::StartInteractionEvent)
  {
    this->Dragged = handle;
    this->dragBegins();
    Q_EMIT this->startInteraction();
    return;
  }
  const auto at = std::find_if(this->Handles.begin(), this->Handles.end(),
    [handle](const std::unique_ptr<Handle>& other) { return other.get() == handle; });
  if (this->Dragged != handle || at == this->Handles.end())
  {
    return;
  }
  if (event == vtkCommand::InteractionEvent)
  {
    this->handleMoved(static_cast<int>(at - this->Handles.begin()), handle->place());
    Q_EMIT this->changeAvailable();
    Q_EMIT this->interaction();
    return;
  }
  this->Dragged = nullptr;
  Q_EMIT this->endInteraction();
  Q_EMIT this->changeFinished();
  this->refreshSoon();
}
