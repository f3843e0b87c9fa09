// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A mesh as the target shape [target]. Private.
#ifndef vtkTargetMesh_h
#define vtkTargetMesh_h

#include <memory>

namespace SphericalStyle
{
class StarMesh;
}
class vtkPolyData;
struct vtkSurfaceMesh;

/// Made once, as long as the mesh stays the same.
class vtkTargetMesh
{
public:
  /// @param mesh  or nullptr
  /// @throw std::invalid_argument naming the first cell that is not seen from the centroid, or what
  /// else is wrong
  std::shared_ptr<const SphericalStyle::StarMesh> Update(vtkPolyData* mesh);

private:
  std::shared_ptr<const vtkSurfaceMesh> Surface; // of Star
  std::shared_ptr<const SphericalStyle::StarMesh> Star;
};

#endif
