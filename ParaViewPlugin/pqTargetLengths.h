// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Three handles in the view at the ends of a target shape, which set its lengths along x, y and z.
/// For an information property of a filter with an output port "Target Sphere":
///
///     <PropertyGroup panel_widget="TargetLengths">
///       <Property function="Radius" name="EffectiveRadius"/>
///     </PropertyGroup>
///
/// A target is as large as the sphere whatever its lengths, so that one that is drawn out becomes
/// thinner. A handle therefore changes the ratio of lengths more than it moves, and stays near the
/// mouse.
#ifndef pqTargetLengths_h
#define pqTargetLengths_h

#include "pqViewHandles.h"

class vtkSMPropertyGroup;

class pqTargetLengths : public pqViewHandles
{
  Q_OBJECT

public:
  pqTargetLengths(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);

protected:
  std::vector<Place> places() const override;
  QColor color(std::size_t handle) const override;
  void dragBegins() override;
  void handleMoved(int handle, const Place& to) override;

private:
  /// Of the shape as it was last executed.
  struct Extent
  {
    Place Center = {};
    Place Half = {};
    bool IsKnown = false;
  };

  Extent extent() const;

  Extent Begin;                   // of the drag
  std::array<Place, 3> Pull = {}; // directions in which dragging makes longer
};

#endif
