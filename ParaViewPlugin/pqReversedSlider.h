// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A slider and line edit for a number from 0 to 1 that says how much of something stays, with what
/// it takes away shown instead: 0.2 for 0.8. So that more to the right is more of the effect, as
/// for all sliders, while scripts keep the number of the formula:
///
///     <DoubleVectorProperty name="Blend" panel_widget="ReversedSlider" ...>
///       <Hints><PropertyWidgetDecorator type="PanelLabel" text="Amount"/></Hints>
#ifndef pqReversedSlider_h
#define pqReversedSlider_h

#include "pqPropertyWidget.h"

class pqDoubleRangeWidget;

class pqReversedSlider : public pqPropertyWidget
{
  Q_OBJECT
  Q_PROPERTY(double stays READ stays WRITE setStays NOTIFY staysChanged)

public:
  pqReversedSlider(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);

  double stays() const;
  void setStays(double value);

Q_SIGNALS:
  void staysChanged();

private:
  pqDoubleRangeWidget* Range;
};

#endif
