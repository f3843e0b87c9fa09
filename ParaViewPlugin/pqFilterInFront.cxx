// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqFilterInFront.h"

#include "pqAncestor.h"
#include "pqPropertiesPanel.h"
#include "pqPropertyWidget.h"
#include "pqSourceOf.h"
#include "pqUndoStack.h"
#include "pqView.h"
#include "vtkNew.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxySelectionModel.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"
#include "vtkSMViewProxy.h"
#include "vtkSmartPointer.h"

#include <QPointer>
#include <QTimer>

namespace
{
/// A new filter in the pipeline, executed. @param port  of its input
vtkSMSourceProxy* Append(vtkSMSourceProxy* to, int port, const QString& filter)
{
  vtkSmartPointer<vtkSMProxy> made;
  made.TakeReference(
    to->GetSessionProxyManager()->NewProxy("filters", filter.toUtf8().constData()));
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  controller->PreInitializeProxy(made);
  vtkSMPropertyHelper(made, "Input").Set(to, port);
  controller->PostInitializeProxy(made);
  made->UpdateVTKObjects();
  controller->RegisterPipelineProxy(made);
  if (pqPipelineSource* item = pqSourceOf(made))
  {
    item->setModifiedState(pqProxy::UNMODIFIED);
  }
  auto* source = vtkSMSourceProxy::SafeDownCast(made);
  source->UpdatePipeline();
  return source;
}
}

void pqFilterInFront::insert(pqPropertyWidget* widget, const QStringList& filters,
  const QString& name, const QStringList& switches)
{
  vtkSMPropertyHelper input(widget->proxy(), "Input");
  auto* model = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  const QPointer<pqPipelineSource> item = pqSourceOf(widget->proxy());
  const QPointer<pqPropertiesPanel> panel = pqAncestor<pqPropertiesPanel>(widget);
  if (!model || !item)
  {
    return;
  }
  const QPointer<pqView> view = widget->view();
  const int port = static_cast<int>(input.GetOutputPort());
  BEGIN_UNDO_SET(name);
  vtkSMSourceProxy* last = model;
  for (const QString& filter : filters)
  {
    last = Append(last, last == model ? port : 0, filter);
  }
  {
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", item->getProxy());
    vtkSMPropertyHelper(item->getProxy(), "Input").Set(last, 0);
    for (const QString& property : switches)
    {
      vtkSMPropertyHelper(item->getProxy(), property.toUtf8().constData()).Set(1);
    }
    item->getProxy()->UpdateVTKObjects();
  }
  // As Apply does it with the input of what it shows.
  if (vtkSMViewProxy* smview = view ? view->getViewProxy() : nullptr)
  {
    vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
    controller->Hide(model, port, smview);
  }
  item->getProxy()
    ->GetSessionProxyManager()
    ->GetSelectionModel("ActiveSources")
    ->SetCurrentProxy(item->getProxy(), vtkSMProxySelectionModel::CLEAR_AND_SELECT);
  END_UNDO_SET();
  if (panel)
  {
    // When the panel is laid out without the note: executing paints it as it is.
    QTimer::singleShot(0, panel, &pqPropertiesPanel::apply);
  }
}
