// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqReversedSlider.h"

#include "pqDoubleRangeWidget.h"

#include <QVBoxLayout>

namespace
{
/// Without the digits that only come from the subtraction: 0.3 for 0.7.
double Rest(double value)
{
  return QString::number(1.0 - value, 'g', 12).toDouble();
}
}

pqReversedSlider::pqReversedSlider(
  vtkSMProxy* smproxy, vtkSMProperty* smproperty, QWidget* parentWidget)
  : pqPropertyWidget(smproxy, parentWidget)
  , Range(new pqDoubleRangeWidget(this))
{
  this->Range->setObjectName("DoubleRangeWidget"); // as where ParaView makes it
  this->Range->setMinimum(0.0);
  this->Range->setMaximum(1.0);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->Range);

  // The property follows the slider, the change is finished when it is let go.
  this->setChangeAvailableAsChangeFinished(false);
  this->connect(this->Range, SIGNAL(valueChanged(double)), SIGNAL(staysChanged()));
  this->connect(this->Range, SIGNAL(valueEdited(double)), SIGNAL(changeFinished()));
  this->addPropertyLink(this, "stays", SIGNAL(staysChanged()), smproperty);
}

double pqReversedSlider::stays() const
{
  return Rest(this->Range->value());
}

void pqReversedSlider::setStays(double value)
{
  this->Range->setValue(Rest(value));
}
