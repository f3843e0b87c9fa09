// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A surface beside what it was before a deformation. Private.
#ifndef vtkSurfacePair_h
#define vtkSurfacePair_h

#include "vtkSurfaceMeshConversion.h"

/// The triangles that have an area in both surfaces. Input points are one point here if they
/// coincide in both.
struct vtkSurfacePair
{
  SphericalStyle::TriangleMesh Rest; ///< before
  SphericalStyle::Points Deformed;   ///< after, one row per point of Rest
  std::vector<int> Point;            ///< of each input point; vtkSurfaceMesh::NotMoved for none
  std::vector<int> Triangle;         ///< number of each triangle in the mesh of the surface
  SphericalStyle::TriangleMesh Reference; ///< all triangles of the reference by themselves
  /// What this process has of the points of Rest, and of those of Reference.
  SphericalStyle::SurfacePart Part;
  SphericalStyle::SurfacePart ReferencePart;
};

/// @param surface  FromPolyData(input, weld), of all processes where it is spread: all call this
///        with their parts then
/// @throw WholeSurfaceNeeded where the parts of the reference are not those of the input
/// @throw std::invalid_argument naming the reference: not the points and cells of the input, points
///        that are not finite, or no triangle that has an area in both
vtkSurfacePair vtkMakeSurfacePair(
  vtkPolyData* input, const vtkSurfaceMesh& surface, vtkPolyData* reference, bool weld);

#endif
