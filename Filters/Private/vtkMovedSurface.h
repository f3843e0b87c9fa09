// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the output of every style filter has: the moved points, normals, and vectors that turn with
/// the surface [vectors]. Private.
#ifndef vtkMovedSurface_h
#define vtkMovedSurface_h

#include "vtkSurfaceMeshConversion.h"

class vtkPolyData;
class vtkStyleAlgorithm;

namespace vtkMovedSurface
{
/// Gives the output, a shallow copy of the input, the points Q and what follows from them, as the
/// properties of `self` ask for. Of a surface that is spread over processes all call this.
/// @param Q  one row per mesh point; none where the surface has no triangles
/// @throw see vtkSurfaceMeshConversion::ReplacePoints
void Fill(vtkStyleAlgorithm* self, vtkPolyData* output, const vtkSurfaceMesh& surface,
  const SphericalStyle::Points& Q);
}

#endif
