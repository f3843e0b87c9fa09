// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Several centers: which points have one in common, and where it lies. Private.
#ifndef vtkCenterIds_h
#define vtkCenterIds_h

#include "TargetDirections.h" // for PartWithoutSphere
#include "vtkType.h"          // for vtkIdType

#include <string>
#include <vector>

class vtkInformation;
class vtkPointSet;
class vtkPolyData;
struct vtkSurfaceMesh;

/// All empty without an array of ids.
struct vtkCenterIds
{
  std::vector<int> OfPoints;     ///< rank of the id that each mesh point has
  std::vector<vtkIdType> Values; ///< the ids, ascending
  std::string ArrayName;

  /// @param wanted  vtkAlgorithm::GetInputArrayInformation
  /// @throw std::invalid_argument naming the array and the first offending point
  static vtkCenterIds Find(
    vtkInformation* wanted, const vtkSurfaceMesh& surface, vtkPolyData* input);

  /// One row per id, of the points given: by the array of the same name, or in the order of the
  /// ids.
  /// @throw std::invalid_argument naming the first id without one
  SphericalStyle::Points Centers(vtkPointSet* given) const;

  /// Says whose part has no sphere, in the user's words; with no ids it is a region.
  /// @throw std::invalid_argument always
  [[noreturn]] void Refuse(const SphericalStyle::PartWithoutSphere& error) const;
};

#endif
