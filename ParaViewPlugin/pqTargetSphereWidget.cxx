// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqTargetSphereWidget.h"

#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqServerManagerModel.h"
#include "pqSettingCheckBox.h"
#include "pqSourceOf.h"
#include "pqSpherePropertyWidget.h"
#include "pqTargetLengths.h"
#include "pqUndoStack.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkPVDataInformation.h"
#include "vtkSMParaViewPipelineController.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyGroup.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"

#include <QLabel>
#include <QVBoxLayout>

#include <algorithm>

namespace
{
constexpr int Custom = 2; // of CenterMode and of RadiusMode
}

pqTargetSphereWidget::pqTargetSphereWidget(
  vtkSMProxy* smproxy, vtkSMPropertyGroup* smgroup, QWidget* parentWidget)
  : pqPropertyWidget(smproxy, parentWidget)
  , CenterPosition(smgroup->GetProperty("CenterPosition"))
  , Statement(new QLabel(this))
  , ShowSphere(new pqSettingCheckBox("ShowTargetSphere", tr("Show Target Sphere"), false, this))
{
  this->setShowLabel(false);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->Statement);
  layout->addWidget(this->ShowSphere);
  this->Statement->setObjectName("CenterPosition");
  this->Statement->setWordWrap(true);
  this->Statement->setToolTip(pqPropertyWidget::getTooltip(this->CenterPosition));
  this->ShowSphere->setToolTip(tr("Show the sphere that the model is rounded to, while the filter "
                                  "is selected."));
  this->connect(this->ShowSphere, SIGNAL(toggled(bool)), SLOT(updateSphere()));

  this->Timer.setSingleShot(true);
  this->Timer.setInterval(1); // one of no time would wait until the mouse rests
  this->connect(&this->Timer, SIGNAL(timeout()), SLOT(refresh()));
  pqPipelineSource* source = pqSourceOf(smproxy);
  if (source)
  {
    // Not in the middle of the update that tells of it.
    this->Timer.connect(source, SIGNAL(dataUpdated(pqPipelineSource*)), SLOT(start()));
  }
  this->Observers.add(
    this->CenterPosition, vtkCommand::ModifiedEvent, this, &pqTargetSphereWidget::updateStatement);
  for (vtkSMProperty* mode :
    { smproxy->GetProperty("CenterMode"), smproxy->GetProperty("RadiusMode") })
  {
    this->Observers.add(
      mode, vtkCommand::UncheckedPropertyModifiedEvent, this, &pqTargetSphereWidget::startCustom);
  }
  this->updateStatement();
}

pqTargetSphereWidget::~pqTargetSphereWidget()
{
  this->Observers.clear();
  this->addToView(false);
}

void pqTargetSphereWidget::select()
{
  this->pqPropertyWidget::select();
  for (const auto* handles : this->parentWidget()->findChildren<pqTargetLengths*>())
  {
    for (const auto signal : { &pqViewHandles::startInteraction, &pqViewHandles::endInteraction })
    {
      QObject::connect(
        handles, signal, this, &pqTargetSphereWidget::updateSphere, Qt::UniqueConnection);
    }
  }
  this->Timer.start(); // which of the widgets beside this one are shown is not settled yet
}

void pqTargetSphereWidget::deselect()
{
  this->pqPropertyWidget::deselect();
  this->updateSphere();
}

void pqTargetSphereWidget::setView(pqView* newView)
{
  if (newView != this->view())
  {
    this->addToView(false);
    this->pqPropertyWidget::setView(newView);
    this->addToView(true);
    this->updateSphere();
  }
}

bool pqTargetSphereWidget::isSphereVisible() const
{
  return this->Sphere && vtkSMPropertyHelper(this->Sphere, "Visibility").GetAsInt() != 0;
}

void pqTargetSphereWidget::refresh()
{
  this->proxy()->UpdatePropertyInformation();
  this->updateStatement(); // of another mode the position may be the same
  this->updateSphere();
}

void pqTargetSphereWidget::updateStatement()
{
  const QString text = vtkSMPropertyHelper(this->CenterPosition).GetAsString();
  const bool isOutside = text == "Outside";
  const bool isCustom = vtkSMPropertyHelper(this->proxy(), "CenterMode").GetAsInt() == Custom;
  QString statement = tr("The center is inside the model.");
  if (isOutside)
  {
    statement = tr("The center is outside the model: the side that faces it becomes flatter, and "
                   "hollow where Limbs is low.");
    statement += isCustom ? QString() : tr(" Center Mode Custom moves it.");
  }
  else if (isCustom && text == "NearSurface")
  {
    // Many models have their centroid near the surface and show nothing of it; a center that was
    // put there does more often.
    statement = tr("The center is inside the model, near the surface, which may bulge there.");
  }
  vtkSMProperty* blend = this->proxy()->GetProperty("NormalBlend");
  if (blend && vtkSMPropertyHelper(blend).GetAsDouble() == 1.0)
  {
    statement =
      tr("The center does not change the shape where Limbs is 1 and Roundness is the same "
         "everywhere.");
  }
  this->Statement->setText(statement);
  this->Statement->setVisible(!text.isEmpty());
  QFont font = this->font();
  font.setBold(isOutside && isCustom);
  this->Statement->setFont(font);
}

/// Whether there is a sphere: of a failed execution there is none, and its center and radius are
/// those of a new filter.
bool pqTargetSphereWidget::hasResult() const
{
  auto* source = vtkSMSourceProxy::SafeDownCast(this->proxy());
  return pqExecutedSourceOf(source) &&
    source->GetDataInformation(source->GetOutputPortIndex("Target Sphere"))->GetNumberOfPoints() >
    0;
}

void pqTargetSphereWidget::startCustom(vtkObject* mode, unsigned long, void*)
{
  vtkSMPropertyHelper applied(static_cast<vtkSMProperty*>(mode));
  vtkSMPropertyHelper chosen(static_cast<vtkSMProperty*>(mode));
  chosen.SetUseUnchecked(true);
  if (!this->hasResult() || applied.GetAsInt() == Custom || chosen.GetAsInt() != Custom)
  {
    return;
  }
  this->proxy()->UpdatePropertyInformation();
  const bool center = mode == this->proxy()->GetProperty("CenterMode");
  const std::vector<double> effective =
    vtkSMPropertyHelper(this->proxy(), center ? "EffectiveCenter" : "EffectiveRadius")
      .GetDoubleArray();
  vtkSMPropertyHelper custom(this->proxy(), center ? "Center" : "Radius");
  custom.SetUseUnchecked(true);
  custom.Set(effective.data(), static_cast<unsigned int>(effective.size()));
}

bool pqTargetSphereWidget::isSphereWanted() const
{
  const auto lengths = this->parentWidget()->findChildren<pqTargetLengths*>();
  const bool dragged = std::any_of(
    lengths.begin(), lengths.end(), [](const auto* handles) { return handles->isDragged(); });
  if (!this->isSelected() || !(dragged || this->ShowSphere->isChecked()) ||
    !pqExecutedSourceOf(this->proxy()))
  {
    return false;
  }
  const auto others = this->parentWidget()->findChildren<pqSpherePropertyWidget*>();
  return std::none_of(others.begin(), others.end(),
    [](const pqSpherePropertyWidget* other) { return other->isWidgetVisible(); });
}

void pqTargetSphereWidget::updateSphere()
{
  const bool wanted = this->isSphereWanted();
  if (wanted && !this->Sphere)
  {
    this->makeSphere();
    this->addToView(true);
  }
  if (!this->Sphere)
  {
    return;
  }
  if (this->isSphereVisible() != wanted)
  {
    vtkSMPropertyHelper(this->Sphere, "Visibility").Set(wanted);
    this->Sphere->UpdateVTKObjects();
    if (this->view())
    {
      this->view()->render();
    }
  }
}

void pqTargetSphereWidget::makeSphere()
{
  auto* source = vtkSMSourceProxy::SafeDownCast(this->proxy());
  SCOPED_UNDO_EXCLUDE();
  vtkNew<vtkSMParaViewPipelineController> controller;
  this->Sphere.TakeReference(
    source->GetSessionProxyManager()->NewProxy("representations", "GeometryRepresentation"));
  this->Sphere->PrototypeOn(); // not tracked by undo, as ParaView's own widgets
  controller->PreInitializeProxy(this->Sphere);
  vtkSMPropertyHelper(this->Sphere, "Input")
    .Set(source, source->GetOutputPortIndex("Target Sphere"));
  const double color[3] = { 1.0, 0.75, 0.2 }; // opaque: peeling translucent lines takes long
  vtkSMPropertyHelper(this->Sphere, "AmbientColor").Set(color, 3);
  vtkSMPropertyHelper(this->Sphere, "DiffuseColor").Set(color, 3);
  vtkSMPropertyHelper(this->Sphere, "Pickable").Set(0);
  vtkSMPropertyHelper(this->Sphere, "Visibility").Set(0);
  controller->PostInitializeProxy(this->Sphere);
  this->Sphere->UpdateVTKObjects();
}

void pqTargetSphereWidget::addToView(bool add)
{
  auto* renderView = qobject_cast<pqRenderView*>(this->view());
  if (!renderView || !this->Sphere ||
    renderView->getProxy()->GetSession() != this->Sphere->GetSession())
  {
    return;
  }
  SCOPED_UNDO_EXCLUDE();
  vtkSMPropertyHelper representations(renderView->getProxy(), "HiddenRepresentations");
  add ? representations.Add(this->Sphere) : representations.Remove(this->Sphere);
  renderView->getProxy()->UpdateVTKObjects();
}
