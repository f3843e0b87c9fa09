// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Edges through thin walls [wall]: the two sides of a sheet have one base and keep their distance.
#ifndef SphericalStyle_WallStitches_h
#define SphericalStyle_WallStitches_h

#include "Stitches.h"

namespace SphericalStyle
{
/// Joins the sides of every wall that is thinner than 2 s. From a point u a ray goes inward,
/// against the normal (Thickness.h), until it meets the surface. The nearest corner v of the
/// triangle there is joined to u if it is at a length below 2 s and the normals of u and of the
/// triangle are opposite, at an angle theta to that, with
///
///     c_uv = A_u / 2 cos^2 theta (1 / length^2 - 1 / (2 s)^2),        none for cos theta <= 0,
///
/// A_u the area at u; a length below s / 10 counts as that. What two points find in each other adds
/// up. So across a wall there is as much for [detail] to conduct, and as stiff, as in the plane of
/// its two sides, whatever their triangles, and nothing jumps where a wall becomes too thick: of
/// its thickness d the base keeps (d / 2 s)^4. Gaps are no walls, and which triangles are turned
/// round does not matter (OrientAlike).
/// @param P  n x 3 @param F  m x 3 @param size  s, fraction of the diagonal of the bounds
/// @return ascending, each once. Depends on neither place, scale nor the order of points, up to
///         ties. About n log n
std::vector<Stitch> FindWallStitches(const Points& P, const Triangles& F, double size, int threads);
} // namespace SphericalStyle

#endif
