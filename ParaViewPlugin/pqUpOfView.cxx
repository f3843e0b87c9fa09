// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqUpOfView.h"

#include "pqPipelineSource.h"
#include "pqPropertyWidget.h"
#include "pqShownValue.h"
#include "pqSourceOf.h"
#include "pqView.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkPVXMLElement.h"
#include "vtkSMIntVectorProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMRenderViewProxy.h"

#include <QComboBox>
#include <QTimer>

#include <cmath>
#include <string>

namespace
{
constexpr int ZAxis = 2;
constexpr int Unknown = -1;

/// The axis that points up in what a filter gives, where it has one with an effect.
int UpOfResult(vtkSMProxy* filter, vtkSMProperty* axis)
{
  vtkPVXMLElement* hints = axis->GetHints();
  for (unsigned int k = 0; hints && k < hints->GetNumberOfNestedElements(); ++k)
  {
    vtkPVXMLElement* hint = hints->GetNestedElement(k);
    if (std::string(hint->GetAttributeOrEmpty("type")) != "UpOfView")
    {
      continue;
    }
    const auto isOn = [&](const char* attribute, double value)
    {
      vtkSMProperty* other = filter->GetProperty(hint->GetAttributeOrEmpty(attribute));
      return other && vtkSMPropertyHelper(other).GetAsDouble() == value;
    };
    double value = 0.0;
    if (!hint->GetScalarAttribute("value", &value) || isOn("property", value))
    {
      return isOn("turned", 1.0) ? ZAxis : vtkSMPropertyHelper(axis).GetAsInt();
    }
  }
  return Unknown;
}

/// The axis that points up in the input of a filter, as the nearest filter before it has it.
/// @param name  of the property
int UpOfInput(vtkSMProxy* filter, const char* name)
{
  const vtkSMPropertyHelper input(filter, "Input", /*quiet=*/true);
  vtkSMProxy* before = input.GetNumberOfElements() > 0 ? input.GetAsProxy() : nullptr;
  if (!before || std::string(before->GetXMLName()) == "TransformFilter")
  {
    return Unknown;
  }
  vtkSMProperty* axis = before->GetProperty(name);
  const int up = axis ? UpOfResult(before, axis) : Unknown;
  return up != Unknown ? up : UpOfInput(before, name);
}

/// The axis that points up in a view, or down: nearest to its up direction.
int UpOf(pqView* view)
{
  auto* shown = view ? vtkSMRenderViewProxy::SafeDownCast(view->getProxy()) : nullptr;
  if (!shown)
  {
    return Unknown;
  }
  double up[3];
  shown->GetActiveCamera()->GetViewUp(up);
  int axis = 0;
  for (int k = 1; k < 3; ++k)
  {
    axis = std::abs(up[k]) > std::abs(up[axis]) ? k : axis;
  }
  return axis;
}
}

pqUpOfView::pqUpOfView(vtkPVXMLElement* xml, pqPropertyWidget* widget)
  : pqPropertyWidgetDecorator(xml, widget)
  , Other(widget->proxy()->GetProperty(xml->GetAttributeOrEmpty("property")))
{
  xml->GetScalarAttribute("value", &this->Value);
  auto* axis = vtkSMIntVectorProperty::SafeDownCast(widget->property());
  auto* list = widget->findChild<QComboBox*>();
  if (!axis || !list)
  {
    return;
  }
  this->OwnAxis = axis->GetDefaultValue(0);
  QObject::connect(
    list, qOverload<int>(&QComboBox::activated), this, [this] { this->Chosen = true; });
  if (!this->Other)
  {
    QTimer::singleShot(0, this, [this] { this->begin(); }); // the widget has its view then
    return;
  }
  this->WasNeeded = this->isNeeded();
  for (const auto event : { vtkCommand::ModifiedEvent, vtkCommand::UncheckedPropertyModifiedEvent })
  {
    this->Observers.add(this->Other, event, this, &pqUpOfView::follow);
  }
}

/// Not of a filter that was applied, or that a state file or a script has made.
void pqUpOfView::begin()
{
  const pqPipelineSource* filter = pqSourceOf(this->parentWidget()->proxy());
  if (filter && filter->modifiedState() == pqProxy::UNINITIALIZED && !this->isChosen())
  {
    this->setAxis();
    QObject::connect(
      filter, &pqProxy::modifiedStateChanged, this, [this, filter] { this->forget(filter); });
  }
}

/// Where undo has taken back that the filter was made, redo makes it again, and then its first
/// Apply. That sets no property to the value that it has, and what is shown here would stay.
void pqUpOfView::forget(const pqPipelineSource* filter)
{
  vtkSMProperty* axis = this->parentWidget()->property();
  if (filter->modifiedState() == pqProxy::UNMODIFIED)
  {
    pqShownValue::set(axis, vtkSMPropertyHelper(axis).GetAsDouble());
  }
}

bool pqUpOfView::isNeeded() const
{
  return pqShownValue::get(this->Other) == this->Value;
}

bool pqUpOfView::isChosen() const
{
  const double axis = pqShownValue::get(this->parentWidget()->property());
  auto* property = vtkSMIntVectorProperty::SafeDownCast(this->parentWidget()->property());
  return this->Chosen || (axis != this->OwnAxis && axis != property->GetDefaultValue(0));
}

void pqUpOfView::follow()
{
  const bool was = this->WasNeeded;
  this->WasNeeded = this->isNeeded();
  // Undo and scripts set both properties themselves, and leave nothing to apply.
  const bool byUser = vtkSMPropertyHelper(this->Other).GetAsDouble() != this->Value;
  if (this->WasNeeded && !was && byUser && !this->isChosen())
  {
    this->setAxis();
  }
}

void pqUpOfView::setAxis()
{
  pqPropertyWidget* widget = this->parentWidget();
  const int before = UpOfInput(widget->proxy(), widget->property()->GetXMLName());
  const int axis = before != Unknown ? before : UpOf(widget->view());
  if (axis == Unknown)
  {
    return;
  }
  this->OwnAxis = axis;
  if (pqShownValue::get(widget->property()) == this->OwnAxis)
  {
    return;
  }
  pqShownValue::set(widget->property(), this->OwnAxis);
  Q_EMIT widget->changeAvailable();
}
