// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The volume cells of a data set as the solver takes them. Private.
#ifndef vtkVolumeCells_h
#define vtkVolumeCells_h

#include "VolumeMesh.h"
#include "vtkType.h" // for vtkIdType

#include <vector>

class vtkDataSet;

namespace vtkVolumeCells
{
struct Volume
{
  SphericalStyle::VolumeMesh Mesh; ///< numbered the right way round; all points of the data set
  std::vector<vtkIdType> Cells;    ///< input cell of each
};

/// Tetrahedra, pyramids, wedges, hexahedra and voxels. Cells without a volume are left out; of an
/// image or a rectilinear grid, whose cells cannot move one by one, all.
/// @param P  of the input: vtkSurfaceMeshConversion::PointsOf
/// @throw std::invalid_argument naming the first cell of another kind with a volume, with a point
/// id
///        out of range or with too few points
Volume FromDataSet(vtkDataSet* input, const SphericalStyle::Points& P);
}

#endif
