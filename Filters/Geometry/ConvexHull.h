// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Convex hull of points [proxy], step 1 (thesis 5.2).
#ifndef SphericalStyle_ConvexHull_h
#define SphericalStyle_ConvexHull_h

#include "TriangleMesh.h"

namespace SphericalStyle
{
/// Extent below which a direction counts as missing, as a fraction of the largest extent: what
/// single precision leaves of a plane that does not lie along the axes.
constexpr double FlatExtent = 1e-6;

struct Hull
{
  /// 3: a closed surface, oriented outward. 2: the convex polygon of the points in their plane as a
  /// fan of triangles, open. 1: points on a line, 0: all points at one place; no triangles.
  int dimension = 0;
  TriangleMesh mesh;
};

/// The dimension alone, by three extents: about n.
int HullDimension(const Points& P);

/// @param P  n x 3, finite. About n log n. The same in every process, but for how facets of four
/// and more corners are cut on hulls of more than 5000 corners: that is left to CGAL.
Hull ConvexHull(const Points& P);
} // namespace SphericalStyle

#endif
