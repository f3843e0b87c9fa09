// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqAlwaysInFront.h"

#include "pqInteractivePropertyWidget.h"
#include "vtkActor.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkPointHandleRepresentation3D.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkSMNewWidgetRepresentationProxy.h"

namespace
{
/// Farther toward the eye than any depth: the unit is one of 65536 steps between near and far.
constexpr double ToTheEye = -70000.0;

void SetLook(vtkProperty* property, double red, double green, double blue)
{
  property->LightingOff();
  property->SetColor(red, green, blue);
  property->SetLineWidth(3.0F);
}
}

pqAlwaysInFront::pqAlwaysInFront(vtkPVXMLElement* xml, pqPropertyWidget* widget)
  : pqPropertyWidgetDecorator(xml, widget)
{
  auto* interactive = qobject_cast<pqInteractivePropertyWidget*>(widget);
  if (interactive)
  {
    apply(interactive->widgetProxy());
  }
}

void pqAlwaysInFront::apply(vtkSMNewWidgetRepresentationProxy* widget)
{
  vtkSMProxy* prop = widget->GetRepresentationProxy();
  auto* handle =
    prop ? vtkPointHandleRepresentation3D::SafeDownCast(prop->GetClientSideObject()) : nullptr;
  if (!handle)
  {
    return;
  }
  SetLook(handle->GetProperty(), 1.0, 0.25, 0.0);
  SetLook(handle->GetSelectedProperty(), 1.0, 0.8, 0.2);
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
