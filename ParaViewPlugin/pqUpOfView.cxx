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
  auto* shown =
    widget->view() ? vtkSMRenderViewProxy::SafeDownCast(widget->view()->getProxy()) : nullptr;
  if (!shown)
  {
    return;
  }
  double up[3];
  shown->GetActiveCamera()->GetViewUp(up);
  int axis = 0;
  for (int k = 1; k < 3; ++k)
  {
    axis = std::abs(up[k]) > std::abs(up[axis]) ? k : axis;
  }
  this->OwnAxis = axis;
  if (pqShownValue::get(widget->property()) == this->OwnAxis)
  {
    return;
  }
  pqShownValue::set(widget->property(), this->OwnAxis);
  Q_EMIT widget->changeAvailable();
}
