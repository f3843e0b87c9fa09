// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A slider for a number whose small values matter as much as the large ones, and its line edit:
///
///     <DoubleVectorProperty name="Roundness" panel_widget="LogarithmicSlider" ...>
///       <DoubleRangeDomain name="range" min="0" max="50"/>
///       <Hints><LogarithmicSlider smallest="0.01"/></Hints>
///
/// The slider is at `min` at its left end, and one step from there at `smallest`; from then on each
/// step is the same factor, up to `max`. Other values can be typed. Its signals are those that
/// pqUpdateWhileDragging waits for.
#ifndef pqLogarithmicSlider_h
#define pqLogarithmicSlider_h

#include "pqPropertyWidget.h"

class pqLogarithmicSlider : public pqPropertyWidget
{
  Q_OBJECT

public:
  pqLogarithmicSlider(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);

Q_SIGNALS:
  void startInteraction();
  void interaction();
  void endInteraction();
};

#endif
