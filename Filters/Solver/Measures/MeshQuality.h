// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Angles, weights and edges of a mesh: how well it is made for a solve. [measures]
#ifndef SphericalStyle_MeshQuality_h
#define SphericalStyle_MeshQuality_h

#include "EdgePart.h"

namespace SphericalStyle
{
/// Cosines, cotangents and cotangent sums within this of 0 count as 0: it is the rounding of points
/// of single precision, and a box is not made of obtuse triangles.
constexpr double RightAngle = 1e-6;

struct EdgeCounts
{
  Eigen::Index edges = 0;
  Eigen::Index border = 0;      ///< edges of one triangle
  Eigen::Index nonManifold = 0; ///< edges of three or more
  Eigen::Index misoriented = 0; ///< edges that two triangles run through in the same direction
  /// Every edge is run through as often in one direction as in the other: the triangles bound a
  /// volume.
  bool closed = false;
};
/// How many triangles run through edge e from its smaller to its larger point, less those that run
/// the other way.
int EdgeBalance(const Triangles& F, const MeshEdges& edges, int e);
/// Of all processes.
EdgeCounts CountEdges(const Triangles& F, const MeshEdges& edges, const EdgePart& part = {});

/// m x 2, smallest and largest angle of each triangle, degrees.
Eigen::MatrixX2d ExtremeAngles(const Points& P, const Triangles& F);

struct WeightReport
{
  Eigen::Index negative = 0; ///< edges whose cotangent sum w (Eq. 2.4) is below 0
  /// Smallest lambda with which every edge's entry w + lambda of the matrix is 0 or more; at a
  /// border, where one triangle brings c + lambda / 2, as well. 0 if it always is. No unit.
  double lambdaStar = 0.0;
};
/// Sum of c over the half-edges on edge e: its weight w (Eq. 2.4) where c is HalfEdgeCotangents.
double EdgeSum(const HalfEdgeScalars& c, const MeshEdges& edges, int e);
/// Of all processes. @param c  HalfEdgeCotangents
WeightReport CheckWeights(
  const HalfEdgeScalars& c, const MeshEdges& edges, const EdgePart& part = {});

/// Angle between the triangles at each edge that has two of them and counts here, in the order of
/// the edges: 0 where flat, above 0 where convex seen from the first one's outside; radians, -pi to
/// pi.
Eigen::VectorXd DihedralAngles(
  const Points& P, const Triangles& F, const MeshEdges& edges, const EdgePart& part = {});

struct OppositionReport
{
  Eigen::Index edges = 0; ///< of all processes, with (n_u - n_v).(p_u - p_v) below 0
  Eigen::VectorXd share;  ///< of such edges among those at each point, 0..1
};
/// Edges that the target of NormalBlend 1 turns around (thesis 4.5.3.1, Fig. 4.15): the concave
/// ones.
/// @param normals  n x 3 unit normals
OppositionReport FindOpposition(const Points& P, const Points& normals, const Triangles& F,
  const MeshEdges& edges, const SurfacePart& points = {}, const EdgePart& part = {});
} // namespace SphericalStyle

#endif
