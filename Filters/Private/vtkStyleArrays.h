// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the inputs of vtkSphericalStyleFilter say of single points, as options of the method:
/// point arrays, centers and region. Private.
#ifndef vtkStyleArrays_h
#define vtkStyleArrays_h

#include "SphericalStyleMethod.h"
#include "vtkCenterIds.h"

#include <vector>

class vtkAlgorithm;
class vtkPointSet;
class vtkPolyData;
struct vtkSurfaceMesh;

namespace vtkStyleArrays
{
/// The input arrays to process.
enum InputArrays
{
  NORMALS = 0,
  ROUNDNESS_FACTOR = 1,
  NORMAL_BLEND = 2,
  TARGET_DIRECTIONS = 3,
  REGION_MASK = 4,
  CENTER_ID = 5
};

/// For constructors: the active normals, and no other array.
void SetDefaults(vtkAlgorithm* self);

/// The arrays of vtkPartSizesFilter that are taken where none is chosen.
constexpr const char* PartRoundness = "PartRoundness";
constexpr const char* PartNormalBlend = "PartNormalBlend";

/// Whether an array was chosen by its name.
bool IsChosen(vtkAlgorithm* self, int array);

/// One row per point of the solve and array into the options, no row where no array was chosen and
/// none of parts is there.
/// Normals are read only where the blend of some point needs them.
/// @param o  with the properties of the filter set @param centers  or nullptr
/// @throw std::invalid_argument naming purpose, array and the first offending point or id
void Read(vtkAlgorithm* self, const vtkSurfaceMesh& surface, vtkPolyData* model,
  vtkPointSet* centers, SphericalStyle::MethodOptions& o);

/// Where there is a region, holds the points outside of it.
/// @param region  vtkSurfaceRegion::Marks
void Hold(
  const std::vector<char>& region, const vtkSurfaceMesh& surface, SphericalStyle::MethodOptions& o);

/// The ids of Read, for messages. @throw see Read
vtkCenterIds CenterIds(vtkAlgorithm* self, const vtkSurfaceMesh& surface, vtkPolyData* model);
}

#endif
