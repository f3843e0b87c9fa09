// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqAlwaysInFront.h"

#include "pqInteractivePropertyWidget.h"
#include "vtkActor.h"
#include "vtkCommand.h"
#include "vtkHandleWidget.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkPointHandleRepresentation3D.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkSMNewWidgetRepresentationProxy.h"
#include "vtkWidgetEventTranslator.h"

namespace
{
/// Farther toward the eye than any depth: the unit is one of 65536 steps between near and far.
constexpr double ToTheEye = -70000.0;

const QColor Selected(255, 204, 51);

void SetLook(vtkProperty* property, const QColor& color)
{
  property->LightingOff();
  property->SetColor(color.redF(), color.greenF(), color.blueF());
  property->SetLineWidth(3.0F);
}
}

const QColor pqAlwaysInFront::Orange(255, 64, 0);

pqAlwaysInFront::pqAlwaysInFront(vtkPVXMLElement* xml, pqPropertyWidget* widget)
  : pqPropertyWidgetDecorator(xml, widget)
{
  auto* interactive = qobject_cast<pqInteractivePropertyWidget*>(widget);
  if (interactive)
  {
    apply(interactive->widgetProxy());
  }
}

void pqAlwaysInFront::apply(vtkSMNewWidgetRepresentationProxy* widget, const QColor& color)
{
  vtkSMProxy* prop = widget->GetRepresentationProxy();
  auto* handle =
    prop ? vtkPointHandleRepresentation3D::SafeDownCast(prop->GetClientSideObject()) : nullptr;
  if (!handle)
  {
    return;
  }
  // VTK's handles shrink under the right button, to a dot that nobody finds again.
  if (vtkAbstractWidget* shown = widget->GetWidget())
  {
    shown->GetEventTranslator()->RemoveTranslation(vtkCommand::RightButtonPressEvent);
  }
  SetLook(handle->GetProperty(), color);
  SetLook(handle->GetSelectedProperty(), Selected);
  vtkNew<vtkPropCollection> actors;
  handle->GetActors(actors);
  for (int i = 0; i < actors->GetNumberOfItems(); ++i)
  {
    auto* actor = vtkActor::SafeDownCast(actors->GetItemAsObject(i));
    if (vtkMapper* mapper = actor ? actor->GetMapper() : nullptr)
    {
      mapper->SetRelativeCoincidentTopologyLineOffsetParameters(0.0, ToTheEye);
    }
  }
}
