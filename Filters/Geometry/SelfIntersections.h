// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Triangles of a mesh that run through each other.
#ifndef SphericalStyle_SelfIntersections_h
#define SphericalStyle_SelfIntersections_h

#include "TriangleMesh.h"

#include <array>
#include <vector>

namespace SphericalStyle
{
/// Pairs of triangles that have more in common than the points and the edge that they share by
/// number: crossing, touching, or overlapping in a plane. Decided exactly (CGAL's predicates). Any
/// triangles, manifold or not.
/// @param mesh  every triangle has an area
/// @return pairs (f, g), f < g, in order
std::vector<std::array<int, 2>> SelfIntersections(const TriangleMesh& mesh);
/// Only pairs with a chosen triangle. @param chosen  of each triangle, not 0 if it is
std::vector<std::array<int, 2>> SelfIntersections(
  const TriangleMesh& mesh, const std::vector<char>& chosen);

/// Of each triangle, 1 if it is in such a pair, else 0.
std::vector<char> IntersectingTriangles(const TriangleMesh& mesh);
} // namespace SphericalStyle

#endif
