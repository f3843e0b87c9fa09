// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where each point of a model meets the proxy [proxy], step 4 (thesis 5.3).
#ifndef SphericalStyle_SurfaceProjection_h
#define SphericalStyle_SurfaceProjection_h

#include "TriangleMesh.h"

#include <memory>

namespace SphericalStyle
{
/// The three cases of thesis 5.3.1 (4).
enum ProjectionCase
{
  OneFoot = 1,     ///< one candidate triangle holds the foot of its plane
  SeveralFeet = 2, ///< several do: the nearest
  NoFoot = 3       ///< none does: the nearest foot outside its triangle is projected again
};

/// One foot q = b_1 q_1 + b_2 q_2 + b_3 q_3 per point.
struct Feet
{
  Eigen::VectorXi cell;           ///< n, triangle of the proxy
  Points barycentric;             ///< n x 3, b >= 0, sum 1 (to rounding)
  Eigen::VectorXi projectionCase; ///< n, ProjectionCase; 0 rows unless NearestVertices
  Eigen::VectorXi byClosestPoint; ///< n, 1 where ClosestPoint had to stand in; 0 rows if it cannot
};

/// sum_k b_k x_k for every foot, x one row per point of the proxy.
Points Interpolate(const Triangles& F, const Feet& feet, const Points& x);

/// Nearest point of triangle (A, B, C) to p as barycentric coefficients, >= 0, sum 1. Thesis
/// Eq. 5.1 - 5.17 by area ratios, which need no case for triangles along an axis; the nearest edge
/// where the foot lies outside, and for triangles without area.
Eigen::Vector3d ClosestBarycentric(const Eigen::Vector3d& p, const Eigen::Vector3d& A,
  const Eigen::Vector3d& B, const Eigen::Vector3d& C);

/// Searches on a proxy that is kept. All searches are deterministic and give the same bits for any
/// number of threads. The proxy may be open, of several parts or not convex. Triangles without area
/// (height below 1e-10 of the edges) are left out, unless it has no others.
class SurfaceProjection
{
public:
  /// @throw std::invalid_argument for a mesh without triangles
  explicit SurfaceProjection(const TriangleMesh& proxy);
  ~SurfaceProjection();

  /// The nearest point of the surface, exactly.
  Feet ClosestPoint(const Points& P, int threads) const;

  /// Thesis 5.3.1: only triangles at the k nearest proxy points are looked at, and a foot must lie
  /// inside its triangle. Where none does (case 3), the nearest foot outside is projected again;
  /// what has not ended after a few rounds takes the point of the last candidate triangles that is
  /// nearest to p.
  Feet NearestVertices(const Points& P, int k, int threads) const;

  /// Of all points whose projection vector is perpendicular to the proxy there, and the nearest one
  /// of all, the foot with the smallest angle between the line p q and the line of the normal
  /// (thesis 5.5); angles within one degree of it count as equal, then the nearer one wins. Feet
  /// beyond .15 of the proxy's diagonal and twice the nearest distance do not count: they would
  /// tear the model where its normals are restless. Normals that point inward do no harm; a normal
  /// of length 0 takes the nearest point.
  Feet SmallestAngle(const Points& P, const Points& normals, int threads) const;

  /// The first point that the ray from p along its direction meets, or else the nearest that the
  /// opposite ray meets (points just outside), or else, and for a direction of length 0, the
  /// nearest point.
  Feet AlongDirections(const Points& P, const Points& directions, int threads) const;

private:
  class State;
  std::unique_ptr<State> S;
};
} // namespace SphericalStyle

#endif
