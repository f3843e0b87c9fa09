// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Weights of the half-edges in the energy: c_h of the rigid and l_h of the spherical term.
#ifndef SphericalStyle_EdgeWeights_h
#define SphericalStyle_EdgeWeights_h

#include "TriangleMesh.h"

namespace SphericalStyle
{
/// How the cotangents enter the energy.
enum class EdgeWeighting
{
  HalfEdge, ///< each triangle brings its own (Chao et al. 2010); E >= 0, never rises
  FullEdge, ///< Eq. 4.13 and 4.22 to the letter; for reproduction
  /// As HalfEdge, on the intrinsic Delaunay triangles of the same surface: no edge between two of
  /// them has a negative weight.
  IntrinsicDelaunay
};

/// Weight of an edge in the spherical term.
enum class SphericalWeighting
{
  Uniform,  ///< s_h = 1 (thesis)
  Cotangent ///< l_h = sqrt(3) lambda c_h: independent of the triangulation
};

/// m x 3 half cotangents c_h of the angle opposite half-edge h in its own triangle (half of
/// Eq. 2.4 and 2.5). Never clamped: the sum over a triangle is positive semidefinite only as it is.
/// The three share one area, so that it stays so, up to rounding, for every triangle that is not
/// degenerate, at any scale.
HalfEdgeScalars HalfEdgeCotangents(const Points& P, const Triangles& F);

/// m x 3 w_uv: the sum of x over all half-edges of the undirected edge (Eq. 2.4 for x = c_h).
HalfEdgeScalars EdgeSums(const HalfEdgeScalars& x, const Triangles& F);

/// The weights of [energy].
struct EdgeWeights
{
  HalfEdgeScalars c; ///< rigid term, no unit
  HalfEdgeScalars l; ///< spherical term, no unit
  /// l = ratio * c on every half-edge (cotangent weights and one lambda, or lambda = 0): the case
  /// of [blend].
  bool proportional = false;
  double ratio = 0.0;
};

/// @param cotangents, F  EnergyTriangles
/// @param lambda  >= 0, of each point (n) @param stitches  EnergyTriangles::NumberOfStitches
/// An edge takes the mean lambda of its ends with uniform weights; with cotangent weights each
/// triangle takes the mean of its corners, because (lambda_uv c_h) is not positive semidefinite on
/// an obtuse triangle when lambda_uv differs between its edges. A stitch takes sqrt(3) lambda c_h
/// with either.
EdgeWeights ComputeEdgeWeights(const HalfEdgeScalars& cotangents, const Triangles& F,
  const Eigen::VectorXd& lambda, EdgeWeighting edges, SphericalWeighting spherical,
  int stitches = 0);
} // namespace SphericalStyle

#endif
