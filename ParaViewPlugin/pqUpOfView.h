// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where the user sets another property to a value, an axis becomes the one that points up: that of
/// the nearest filter before that has one with an effect, z behind one that turns its result
/// upright, or else the axis that is nearest to the up direction of the active view. A decorator,
/// for the property with the axis (X, Y and Z):
///
///     <PropertyWidgetDecorator type="UpOfView" property="KeepOnGround" value="1"/>
///
/// or without property, where the panel of a new filter opens:
///
///     <PropertyWidgetDecorator type="UpOfView" turned="PlaceOnPlate"/>
///
/// where `turned` names a property with which z points up in the result, if there is one.
///
/// The axis is set in the panel, as if it had been chosen there: Apply takes over both properties,
/// in one step of undo, and one of the trace. An axis that the user has chosen stays, and so does
/// one from a state file or a script.
#ifndef pqUpOfView_h
#define pqUpOfView_h

#include "pqObservers.h"
#include "pqPropertyWidgetDecorator.h"
#include "vtkWeakPointer.h"

class pqPipelineSource;
class vtkSMProperty;

class pqUpOfView : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  pqUpOfView(vtkPVXMLElement* xml, pqPropertyWidget* widget);

private:
  void begin();
  void forget(const pqPipelineSource* filter);
  bool isNeeded() const;
  bool isChosen() const;
  void follow();
  void setAxis();

  vtkWeakPointer<vtkSMProperty> Other;
  double Value = 0.0;
  bool WasNeeded = false;
  bool Chosen = false;  // in the list, by the user
  double OwnAxis = 0.0; // what this has set, or the default
  pqObservers Observers;
};

#endif
