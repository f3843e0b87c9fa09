// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqUpdateWhileDragging.h"

#include "pqAncestor.h"
#include "pqApplicationCore.h"
#include "pqInteractivePropertyWidgetAbstract.h"
#include "pqPipelineSource.h"
#include "pqProblem.h"
#include "pqProxyWidget.h"
#include "pqServerManagerModel.h"
#include "pqSettingCheckBox.h"
#include "pqSourceOf.h"
#include "pqUndoStack.h"
#include "pqView.h"
#include "pqViewHandles.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"
#include "vtkPVGeneralSettings.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSession.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMTrace.h"
#include "vtkSMTransferFunctionManager.h"
#include "vtkSMViewProxy.h"

#include <QByteArrayList>
#include <QElapsedTimer>
#include <QGridLayout>

#include <utility>

//------------------------------------------------------------------------------------------------
/// Holds warnings back, and then gives those of the last update. What comes to ParaView's window of
/// messages comes by here: from filters of this process and from those of a server.
class pqUpdateWhileDragging::HeldMessages : public vtkOutputWindow
{
public:
  static HeldMessages* New();
  vtkTypeMacro(HeldMessages, vtkOutputWindow);

  void Hold()
  {
    if (auto* other = HeldMessages::SafeDownCast(vtkOutputWindow::GetInstance()))
    {
      other->Give(); // the end of its drag was lost
    }
    this->Window = vtkOutputWindow::GetInstance();
    vtkOutputWindow::SetInstance(this);
  }

  void BeginUpdate() { this->OfThisUpdate.clear(); }
  void NoteExecution() { this->Last = this->OfThisUpdate; }

  void Give()
  {
    if (vtkOutputWindow::GetInstance() == this)
    {
      vtkOutputWindow::SetInstance(this->Window);
    }
    for (const QByteArray& warning : std::exchange(this->Last, {}))
    {
      this->Window->DisplayWarningText(warning);
    }
  }

  void DisplayText(const char* text) override { this->Window->DisplayText(text); }
  void DisplayErrorText(const char* text) override { this->Window->DisplayErrorText(text); }
  void DisplayWarningText(const char* text) override { this->OfThisUpdate << text; }
  void DisplayGenericWarningText(const char* text) override
  {
    this->Window->DisplayGenericWarningText(text);
  }
  void DisplayDebugText(const char* text) override { this->Window->DisplayDebugText(text); }

private:
  vtkSmartPointer<vtkOutputWindow> Window;
  QByteArrayList OfThisUpdate;
  QByteArrayList Last; // of the last update that there was something to do in
};

vtkStandardNewMacro(pqUpdateWhileDragging::HeldMessages);

//------------------------------------------------------------------------------------------------
pqUpdateWhileDragging::pqUpdateWhileDragging(vtkPVXMLElement* xml, pqPropertyWidget* widget)
  : pqPropertyWidgetDecorator(xml, widget)
  , Messages(vtkSmartPointer<HeldMessages>::New())
{
  this->Timer.setSingleShot(true);
  this->connect(&this->Timer, SIGNAL(timeout()), SLOT(updateOnTime()));
  this->connect(widget, SIGNAL(startInteraction()), SLOT(start()));
  this->connect(widget, SIGNAL(interaction()), SLOT(follow()));
  this->connect(widget, SIGNAL(endInteraction()), SLOT(finish()));
  if (qobject_cast<pqInteractivePropertyWidgetAbstract*>(widget) ||
    qobject_cast<pqViewHandles*>(widget))
  {
    this->addCheckBox();
  }
}

pqUpdateWhileDragging::~pqUpdateWhileDragging()
{
  this->close();
}

void pqUpdateWhileDragging::addCheckBox()
{
  this->CheckBox = new pqSettingCheckBox(
    "UpdateWhileDragging", tr("Update While Dragging"), true, this->parentWidget());
  this->CheckBox->setToolTip(tr("The model follows while you drag, if an update takes less than "
                                "%1 s; otherwise when you let go.")
                               .arg(SlowUpdate / 1000.0));
  QLayout* layout = this->parentWidget()->layout();
  if (auto* grid = qobject_cast<QGridLayout*>(layout))
  {
    grid->addWidget(this->CheckBox, grid->rowCount(), 0, 1, -1);
  }
  else
  {
    layout->addWidget(this->CheckBox);
  }
}

bool pqUpdateWhileDragging::isWanted() const
{
  return pqExecutedSourceOf(this->parentWidget()->proxy()) &&
    (this->CheckBox ? this->CheckBox->isChecked()
                    : vtkPVGeneralSettings::GetInstance()->GetAutoApply());
}

void pqUpdateWhileDragging::start()
{
  this->close(); // should the end of the last one have been lost
  this->Dragging = this->isWanted();
  this->Previews = this->Dragging && !vtkSMTrace::GetActiveTracer();
  this->SlowUpdates = 0;
  if (this->Dragging)
  {
    BEGIN_UNDO_SET(tr("Drag"));
    this->Messages->Hold();
    this->watchRenderings();
  }
}

void pqUpdateWhileDragging::follow()
{
  // A timer of no time would wait until the mouse rests.
  if (this->Dragging && this->SlowUpdates < 2 && !this->Timer.isActive() &&
    !vtkSMTrace::GetActiveTracer())
  {
    this->Timer.start(1);
  }
}

void pqUpdateWhileDragging::finish()
{
  if (this->Dragging)
  {
    // Not at once: the widget's end of the change, which lights up Apply, comes after this signal.
    this->Released = true;
    this->Timer.start(0);
  }
}

void pqUpdateWhileDragging::updateOnTime()
{
  vtkSMProxy* filter = this->parentWidget()->proxy();
  if (filter->GetSession()->GetPendingProgress())
  {
    // From 6.1 on ParaView handles events in the middle of an execution: after it, as pqView does.
    this->Timer.start(10);
    return;
  }
  if (!this->Released)
  {
    this->update();
    return;
  }
  this->Previews = false;
  this->update();
  // As after Apply: each color map knows whether its range follows.
  vtkNew<vtkSMTransferFunctionManager>()->ResetAllTransferFunctionRangesUsingCurrentData(
    filter->GetSessionProxyManager(), false);
  this->close();
  pqApplicationCore::instance()->render(); // what shows the result elsewhere, such as charts
}

void pqUpdateWhileDragging::close()
{
  this->Timer.stop();
  this->Released = false;
  this->Previews = false;
  if (this->Interactor)
  {
    this->Interactor->RemoveObserver(this->RenderObserver);
    this->Interactor = nullptr;
  }
  this->setPreview(false); // should there be no release, the next update gives the full result
  if (this->Dragging)
  {
    this->Dragging = false;
    END_UNDO_SET();
    this->Messages->Give();
    const QWidget* widget = this->parentWidget();
    if (const auto* panel = widget ? pqAncestor<pqProxyWidget>(widget) : nullptr)
    {
      for (pqProblem* problem : panel->findChildren<pqProblem*>())
      {
        problem->end();
      }
    }
  }
}

void pqUpdateWhileDragging::watchRenderings()
{
  constexpr float First = 10.0F; // before what renders the view
  pqView* view = this->parentWidget()->view();
  this->Interactor = view ? view->getViewProxy()->GetInteractor() : nullptr;
  if (this->Interactor)
  {
    this->RenderObserver = this->Interactor->AddObserver(
      vtkCommand::RenderEvent, this, &pqUpdateWhileDragging::rendersSoon, First);
  }
}

/// @return whether the view need not be rendered: aborts the event
bool pqUpdateWhileDragging::rendersSoon(
  vtkObject* /*interactor*/, unsigned long /*event*/, void* /*data*/)
{
  return this->Timer.isActive();
}

void pqUpdateWhileDragging::setPreview(bool on)
{
  vtkSMProxy* filter = this->parentWidget() ? this->parentWidget()->proxy() : nullptr;
  vtkSMProperty* property = filter ? filter->GetProperty("Preview") : nullptr;
  if (property && vtkSMPropertyHelper(property).GetAsInt() != (on ? 1 : 0))
  {
    vtkSMPropertyHelper(property).Set(on ? 1 : 0);
    filter->UpdateProperty("Preview");
  }
}

void pqUpdateWhileDragging::update()
{
  const pqProxyWidget* panel = pqAncestor<pqProxyWidget>(this->parentWidget());
  pqPipelineSource* source = pqSourceOf(this->parentWidget()->proxy());
  pqView* view = this->parentWidget()->view();
  if (!panel || !source || !view)
  {
    return;
  }
  QElapsedTimer clock;
  clock.start();
  this->Messages->BeginUpdate();
  const auto executed =
    QObject::connect(source, qOverload<pqPipelineSource*>(&pqPipelineSource::dataUpdated), this,
      [this] { this->Messages->NoteExecution(); });
  this->setPreview(this->Previews);
  panel->apply();
  source->setModifiedState(pqProxy::UNMODIFIED);
  view->forceRender();
  QObject::disconnect(executed);
  this->SlowUpdates = clock.elapsed() > SlowUpdate ? this->SlowUpdates + 1 : 0;
}
