// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The Delaunay triangulation of a surface's own metric on its own points: the same surface, other
/// triangles, and no negative weight on any edge between two of them.
#ifndef SphericalStyle_IntrinsicDelaunay_h
#define SphericalStyle_IntrinsicDelaunay_h

#include "TriangleMesh.h"

namespace SphericalStyle
{
/// Triangles that lie in the surface, not in space: their edges are geodesics, which run over the
/// surface's edges as if it were unfolded. Two edges may have the same ends, and an edge may return
/// to the point that it starts from.
struct IntrinsicTriangulation
{
  Triangles F;                ///< m x 3; those that no flip has touched as given
  HalfEdgeScalars Cotangents; ///< m x 3 half cotangents, in the metric of the surface
  /// Of each half-edge 3 f + k the other one at its edge; -1 where not two triangles meet.
  std::vector<int> Twins;
  int NumberOfFlips = 0;
  /// Edges whose weight, the sum of the half cotangents at it, stays below -1e-12: borders and
  /// edges of three or more triangles, which cannot be flipped.
  int NumberOfNegativeEdges = 0;
};

/// Flips edges between two triangles until the angles opposite each sum to no more than pi
/// (Fisher, Springborn, Bobenko, Schroeder, An algorithm for the construction of intrinsic Delaunay
/// triangulations, 2007): cot + cot >= 0. Edges with another number of triangles stay. Orientations
/// do not matter, nor whether there is one: triangles are glued by their edges.
///
/// Lengths alone lose a sliver (at two angles of 1e-5 degrees its area hangs on the 15th digit of
/// its edges), which is why implementations on lengths first make all edges a little longer (Sharp,
/// Crane, A Laplacian for nonmanifold triangle meshes, 2020). Here each triangle carries its area
/// besides, first from the points and then from flip to flip: with triangles of 1e-5 to 1e-8
/// degrees the weights have two to five digits more than by Heron's formula. So no edge has to
/// change and the metric stays the surface's own; triangles without area must not come in.
///
/// Deterministic. The number of flips is bounded by 100 per edge: where that ends it, the
/// triangulation is valid but not Delaunay, and NumberOfNegativeEdges counts the rest.
/// Cost: a sort of the edges and about a microsecond per flip.
/// @param P  n x 3 @param F  m x 3, each triangle with an area and three different points
/// @param cotangents  HalfEdgeCotangents(P, F)
IntrinsicTriangulation IntrinsicDelaunay(
  const Points& P, const Triangles& F, const HalfEdgeScalars& cotangents);
} // namespace SphericalStyle

#endif
