// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqColors.h"

#include "vtkNew.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"
#include "vtkSMTransferFunctionManager.h"
#include "vtkSMViewProxy.h"

namespace pqColors
{
Choice get(vtkSMPVRepresentationProxy* display, vtkSMViewProxy* view)
{
  if (!display->GetUsingScalarColoring())
  {
    return {};
  }
  const vtkSMPropertyHelper array(display, "ColorArrayName");
  return { array.GetInputArrayNameToProcess(), array.GetInputArrayAssociation(),
    display->IsScalarBarVisible(view) };
}

void set(vtkSMPVRepresentationProxy* display, vtkSMViewProxy* view, const Choice& choice)
{
  display->SetScalarColoring(
    choice.Array.isEmpty() ? nullptr : choice.Array.data(), choice.Association);
  if (!choice.Array.isEmpty())
  {
    display->SetScalarBarVisibility(view, choice.Legend);
  }
  vtkNew<vtkSMTransferFunctionManager>()->UpdateScalarBars(
    view, vtkSMTransferFunctionManager::HIDE_UNUSED_SCALAR_BARS);
}

bool areShown(vtkSMPVRepresentationProxy* display)
{
  const vtkSMPropertyHelper input(display, "Input");
  const vtkSMPropertyHelper array(display, "ColorArrayName");
  auto* source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  vtkPVDataInformation* data = source ? source->GetDataInformation(input.GetOutputPort()) : nullptr;
  vtkPVArrayInformation* shown = data && display->GetUsingScalarColoring()
    ? data->GetArrayInformation(
        array.GetInputArrayNameToProcess(), array.GetInputArrayAssociation())
    : nullptr;
  return shown && shown->GetDataType() == VTK_UNSIGNED_CHAR &&
    (shown->GetNumberOfComponents() == 3 || shown->GetNumberOfComponents() == 4);
}

bool areMapped(vtkSMPVRepresentationProxy* display)
{
  return vtkSMPropertyHelper(display, "MapScalars", true).GetAsInt() != 0;
}

void setMapped(vtkSMPVRepresentationProxy* display, bool mapped)
{
  if (display->GetProperty("MapScalars") && mapped != areMapped(display))
  {
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", display);
    vtkSMPropertyHelper(display, "MapScalars").Set(mapped);
    display->UpdateVTKObjects();
  }
}
}
