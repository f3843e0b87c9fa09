// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Handles in the view for the rows of Handle Deform: the key P puts one on the model under the
/// mouse, and what is dragged is where its place moves to. For an information property:
///
///     <PropertyGroup panel_widget="HandleRows">
///       <Property function="Rows" name="NumberOfHandles"/>
///     </PropertyGroup>
///
/// A new handle has a radius of a twentieth of the model's diagonal. One that is put on the result
/// gets the place of that point on the model, and stays where it is until it is dragged.
#ifndef pqHandleRows_h
#define pqHandleRows_h

#include "pqViewHandles.h"

class vtkSMPropertyGroup;

class pqHandleRows : public pqViewHandles
{
  Q_OBJECT

public:
  pqHandleRows(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);

public Q_SLOTS:
  void addHandle(double x, double y, double z);

protected:
  std::vector<Place> places() const override;
  void handleMoved(int handle, const Place& to) override;

private:
  Place placeOnModel(const Place& shown) const;
};

#endif
