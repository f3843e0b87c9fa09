// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How thick a model is where, as a smooth field [limb], and its thin walls [wall].
#ifndef SphericalStyle_LimbThickness_h
#define SphericalStyle_LimbThickness_h

#include "SurfaceGrid.h"

namespace SphericalStyle
{
/// The size of the limbs that rho tells apart, as a fraction of the diagonal.
constexpr double LimbSize = 0.075;

/// Half of the thickness of the limb that each point belongs to [limb]. From each sample of a grid
/// of LimbSize a ray goes inward through the base, against its normal n_k. rho_k is half of its
/// length, no less than .002 and no more than the radius r or what 98 % of the samples have; its
/// logarithm is smoothed with LimbSize. One ray does what the median of several
/// around it does, with a third of the time, for the samples lie close.
///
/// - The ray does not see outsides within half a cell: the surface it starts from.
/// - A sample that holds both sides of a sheet, |N_k| / w_k < 1/2, takes half of what is between
///   them, the more the smaller |N_k| is.
/// - A sample that faces against its surroundings, n_k . smooth(n)_k < -.3, as where triangles are
///   flipped, says nothing.
/// - Where no ray meets anything around, as on an open sheet, r.
///
/// Of a surface that is spread over processes each looks for all rays at its own triangles, and the
/// nearest hit is taken; here and in FindWalls.
///
/// @param P, B  n x 3 points and base, in the frame @param F  m x 3, facing outward @param radius
/// r @return n, above 0
Eigen::VectorXd LimbThickness(const Points& P, const Points& B, const Triangles& F, double radius,
  int threads, const SurfacePart& part = {});

/// Pairs through walls thinner than 2 s [wall]: from each sample k of the grid, u = x_k, a ray goes
/// inward, against N_k, until it leaves the surface at v, at a distance d below 2 s and an angle
/// theta to the normal there:
///
///     weight = 24 w_k cos^2 theta (1 / d^2 - 1 / (2 s)^2),
///
/// d not below s / 10. Both sides of a wall find each other. Gaps are no walls. A sample with both
/// sides of a sheet, |N_k| / w_k < 1/2, looks for none: they are together already.
/// @param F  m x 3, the triangles face outward
std::vector<GridPair> FindWalls(const SurfaceGrid& grid, const Points& P, const Triangles& F,
  int threads, const SurfacePart& part = {});
} // namespace SphericalStyle

#endif
