// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A handle in the view that the model never hides, and that keeps its size. A decorator, for a
/// group whose widget puts one there:
///
///     <PropertyGroup panel_widget="InteractiveHandle">
///       <Hints>
///         <PropertyWidgetDecorator type="AlwaysInFront"/>
///
/// A center is inside of the model, and ParaView's cross of thin white lines could not be seen
/// there: who missed it turned the camera.
#ifndef pqAlwaysInFront_h
#define pqAlwaysInFront_h

#include "pqPropertyWidgetDecorator.h"

#include <QColor>

class vtkSMNewWidgetRepresentationProxy;

class pqAlwaysInFront : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqAlwaysInFront(vtkPVXMLElement* xml, pqPropertyWidget* widget);

  /// The same for a handle that is there already.
  static void apply(vtkSMNewWidgetRepresentationProxy* widget, const QColor& color = Orange);

  static const QColor Orange;
};

#endif
