// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Triangles from points by a rolling ball (thesis 5.2, step 3).
#ifndef SphericalStyle_BallPivoting_h
#define SphericalStyle_BallPivoting_h

#include "TriangleMesh.h"

#include <vector>

namespace SphericalStyle
{
/// Ball pivoting (Bernardini, Mittleman, Rushmeier, Silva, Taubin, The ball-pivoting algorithm for
/// surface reconstruction, IEEE TVCG 5(4), 1999): a ball touches three points without holding any
/// other, rolls over each edge to the next point it meets, and leaves a triangle each time. Each
/// radius goes on from the borders that the smaller one left, and seeds where nothing is.
///
/// The result is oriented like the normals, has at most two triangles at an edge, in opposite
/// directions, and may have holes: see ClosedSurface. Points are moved by 1e-7 of the first radius
/// while the ball rolls: four on one ball do not occur. Of points nearer than 1e-4 of it only the
/// first is used.
///
/// A ball that fits through a gap between points also comes to the other side of a thin plate: the
/// first radius must be above the largest gap, and, with g the radius of the largest empty circle
/// on a side and d the thickness, above g^2 / (2 d).
///
/// @param P        n x 3, finite
/// @param normals  n x 3, pointing outward; any length above 0
/// @param radii    of the ball, ascending, above 0, length; about 1 to 2 times the point spacing
/// @throw std::invalid_argument for sizes that do not match and radii out of order
/// Deterministic. About n times the points inside one ball.
Triangles BallPivoting(const Points& P, const Points& normals, const std::vector<double>& radii);
} // namespace SphericalStyle

#endif
