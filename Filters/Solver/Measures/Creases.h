// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How sharp the edges of a surface are before and after a deformation. [advice]
#ifndef SphericalStyle_Creases_h
#define SphericalStyle_Creases_h

#include "TriangleMesh.h"

#include <array>
#include <vector>

namespace SphericalStyle
{
/// An edge of two triangles is flat where their normals differ by less than FlatEdge, and sharp
/// where they differ by more than SharpEdge; within a face where by less than PlanarEdge. Radians.
constexpr double PlanarEdge = Pi / 180.0;
constexpr double FlatEdge = Pi / 9.0;
constexpr double SharpEdge = 2.0 * Pi / 9.0;
/// Edges of boxes and cylinders differ by more, those of round bodies of coarse panels by less.
constexpr double BoxEdge = 5.0 * Pi / 18.0;

/// The edges of a surface before a deformation, so that many deformations can be looked at. Each
/// triangle gives a third of its area to each of its edges.
struct CreaseProbes
{
  struct FlatEdgePoints
  {
    std::array<int, 4> points; ///< of the edge, then those opposite of it in its two triangles
    double area = 0.0;
  };
  std::vector<FlatEdgePoints> flat;
  double area = 0.0;        ///< at all edges of two triangles
  double planarShare = 0.0; ///< of that, at edges within faces
  double boxEdges = 0.0;    ///< length of edges above BoxEdge over the square root of the area
  double meanAngle = 0.0;   ///< between the normals at an edge, weighted by area; radians
  double border = 0.0;      ///< length of the border over the square root of the area
  bool manifold = true;     ///< no edge has three triangles, or two that disagree on the outside
};

/// O(n), with a small factor where few triangles are looked at.
/// @param step  only the edges of every step-th triangle are looked at
CreaseProbes PlaceCreaseProbes(const TriangleMesh& mesh, int step = 1);

/// Area at edges that were flat and are sharp, of that at all edges, 0..1.
/// @param Q  the points after the deformation
double NewCreases(const CreaseProbes& probes, const Points& Q);
} // namespace SphericalStyle

#endif
