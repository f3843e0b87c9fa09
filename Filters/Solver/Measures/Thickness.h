// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How thick a surface is along its normals, before and after a deformation. [thickness]
#ifndef SphericalStyle_Thickness_h
#define SphericalStyle_Thickness_h

#include "SurfacePart.h"

#include <limits>

namespace SphericalStyle
{
/// A part that has less than this left of its thickness counts as thinned: at a tenth a sheet looks
/// like one surface.
constexpr double ThinnedBelow = 0.1;

/// Points, each with the point of the surface that lies opposite on the rest shape. Both move with
/// the material.
struct ThicknessProbes
{
  std::vector<int> points;
  std::vector<int> triangles; ///< that of the opposite point
  Points barycentric;         ///< its coordinates there, they sum to 1
};

/// The opposite point is where a ray from the point against its normal, inward, meets the surface
/// first. The triangles at the point and what is nearer than 1e-6 diagonals do not count. Points
/// whose ray meets nothing, as on an open sheet, are left out. A surface whose signed volume is
/// negative is inside out: its normals are taken the other way.
/// @param points  whose opposite points are wanted
/// @param reach  fraction of the diagonal; only what is nearer is met
/// Cost: a tree of the triangles, m log m, and about log m per ray.
ThicknessProbes PlaceThicknessProbes(const TriangleMesh& rest, const std::vector<int>& points,
  int threads, double reach = std::numeric_limits<double>::infinity());

/// Distance of each probe's two points after over before.
Eigen::VectorXd ThicknessRatios(
  const TriangleMesh& rest, const Points& deformed, const ThicknessProbes& probes);

/// The same for all points of a surface, NaN for those that have no point opposite. Where the
/// surface is spread, rays that may meet triangles of another process first are sent to all.
/// @param deformed  one row per point of rest
Eigen::VectorXd ThicknessRatios(
  const TriangleMesh& rest, const Points& deformed, int threads, const SurfacePart& part = {});
} // namespace SphericalStyle

#endif
