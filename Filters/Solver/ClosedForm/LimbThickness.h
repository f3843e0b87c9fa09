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

/// Half of the thickness of the limb that each point belongs to [limb]. With x_k and n_k the places
/// and normals of the samples of a grid of LimbSize, on the base, the ball that touches the surface
/// at x_k from inside and goes through x_j has the radius
///
///     rho_kj = |x_j - x_k|^2 / (2 depth),    depth = -(x_j - x_k) . n_k.
///
/// Samples opposite count: n_j . n_k < -.55, rho_kj < 1 and rho_jk < 1. Each bounds the
/// directions within 22.5 degrees of its own, an arc around n_k; rho_k is the smallest radius at
/// which samples with no larger a ball bound 135 degrees of the turn. So what lies on the axis
/// bounds the ball alone, the end of a neck does not let it grow into the next limb, and an edge on
/// one side does not make it small. rho_k is at least .002, and no more than the radius r or what
/// 98 % of the samples have; its logarithm is smoothed with LimbSize.
///
/// - A sample that holds both sides of a sheet, |N_k| / w_k < 1/2, takes half of what is between
///   them, the more the smaller |N_k| is.
/// - The sides of a thin wall may lie on each other in the base. Where they are within a quarter of
///   the spacing there and three quarters in the model, and behind each other in the model alone,
///   half of their distance bounds the ball.
/// - A sample that faces against its surroundings, n_k . smooth(n)_k < -.3, as where triangles are
///   flipped, says nothing.
/// - Where nothing is opposite anywhere around, as on an open sheet, r.
///
/// The ball is that of Ma, Bae, Choi, 3D medial axis point approximation using nearest neighbors
/// and the normal field, The Visual Computer 28, 2012; there it shrinks until it is empty. Cost:
/// each sample looks at all others, or at 10,000 of them. Their number depends on the area alone.
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
/// sides of a sheet, |N_k| / w_k < 1/2, looks for none: they are together already. Of a surface
/// that is spread over processes each looks for all rays at its own triangles, and the nearest hit
/// is taken.
/// @param F  m x 3, the triangles face outward
std::vector<GridPair> FindWalls(const SurfaceGrid& grid, const Points& P, const Triangles& F,
  int threads, const SurfacePart& part = {});
} // namespace SphericalStyle

#endif
