// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqLogarithmicSlider.h"

#include "pqDoubleRangeWidget.h"
#include "vtkPVXMLElement.h"
#include "vtkSMDoubleRangeDomain.h"
#include "vtkSMProperty.h"

#include <QSlider>
#include <QVBoxLayout>

#include <cmath>

namespace
{
/// Where on the slider a value is: 0 at the minimum, 1 at Smallest, resolution() at the maximum.
class Range : public pqDoubleRangeWidget
{
public:
  using pqDoubleRangeWidget::pqDoubleRangeWidget;
  double Smallest = 0.01;

protected:
  int valueToSliderPos(double value) override
  {
    if (!(value > this->minimum()))
    {
      return 0;
    }
    const double share =
      std::log(value / this->Smallest) / std::log(this->maximum() / this->Smallest);
    return qBound(
      1, static_cast<int>(std::lround(1 + share * (this->resolution() - 1))), this->resolution());
  }

  double sliderPosToValue(int position) override
  {
    if (position < 1)
    {
      return this->minimum();
    }
    const double share = (position - 1.0) / (this->resolution() - 1);
    const double value = this->Smallest * std::pow(this->maximum() / this->Smallest, share);
    return QString::number(value, 'g', 3).toDouble(); // more digits would only be noise
  }
};
}

pqLogarithmicSlider::pqLogarithmicSlider(
  vtkSMProxy* smproxy, vtkSMProperty* smproperty, QWidget* parentWidget)
  : pqPropertyWidget(smproxy, parentWidget)
{
  auto* range = new Range(this);
  range->setObjectName("DoubleRangeWidget"); // as where ParaView makes it
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(range);

  if (auto* domain = smproperty->FindDomain<vtkSMDoubleRangeDomain>())
  {
    range->setMinimum(domain->GetMinimum(0));
    range->setMaximum(domain->GetMaximum(0));
  }
  vtkPVXMLElement* hints = smproperty->GetHints();
  if (auto* hint = hints ? hints->FindNestedElementByName("LogarithmicSlider") : nullptr)
  {
    hint->GetScalarAttribute("smallest", &range->Smallest);
  }
  range->setResolution(500);

  // The property follows the slider, the change is finished when it is let go.
  this->setChangeAvailableAsChangeFinished(false);
  this->addPropertyLink(range, "value", SIGNAL(valueChanged(double)), smproperty);
  this->connect(range, SIGNAL(valueEdited(double)), SIGNAL(changeFinished()));
  auto* slider = range->findChild<QSlider*>();
  this->connect(slider, SIGNAL(sliderPressed()), SIGNAL(startInteraction()));
  this->connect(slider, SIGNAL(sliderMoved(int)), SIGNAL(interaction()));
  this->connect(slider, SIGNAL(sliderReleased()), SIGNAL(endInteraction()));
}
