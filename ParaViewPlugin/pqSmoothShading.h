// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where the panel of a new filter opens, switches on that the result gets normals, so that
/// ParaView shades it smoothly: without normals it shows flat triangles, and a coarse model does
/// not look round however round it is. A decorator, for the property that makes the normals:
///
///     <PropertyWidgetDecorator type="SmoothShading"/>
///
/// It stays off where the model has normals, which the filters recompute, where it has sharp edges,
/// which normals would smear over the faces beside them, and where it has so many points that
/// triangles cannot be told apart. So does it on a remote server, as only the server has the model.
///
/// It is set in the panel, as if it had been chosen there: Apply takes it over in the same step of
/// undo, and of the trace. What a state file or a script has made stays as it is.
#ifndef pqSmoothShading_h
#define pqSmoothShading_h

#include "pqPropertyWidgetDecorator.h"

class pqSmoothShading : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqSmoothShading(vtkPVXMLElement* xml, pqPropertyWidget* widget);

private:
  void begin();
};

#endif
