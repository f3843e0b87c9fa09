// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The triangles that the energy is a sum over. They need not be those of the surface.
#ifndef SphericalStyle_EnergyTriangles_h
#define SphericalStyle_EnergyTriangles_h

#include "MeshTopology.h"

namespace SphericalStyle
{
/// Triangles with half a cotangent per half-edge. [energy] is nonnegative and falls in both steps
/// whenever the three of each triangle are a positive semidefinite form, whatever points it joins:
/// triangles may use a point twice (an edge from a point to itself is 0 long and adds nothing) or
/// join points of several parts.
struct EnergyTriangles
{
  MeshTopology Topology;
  HalfEdgeScalars Cotangents; ///< m x 3
  /// Of IntrinsicTriangulation; -1 where it was not asked for. @{
  int NumberOfFlips = -1;
  int NumberOfNegativeEdges = -1;
  /// @}
  /// A stitch uv is a pair of triangles (u, v, v) and (v, u, u), after all others: an edge in the
  /// cells of its two ends only [stitch]. Their edge uv comes twice: each half-edge counts half.
  int NumberOfStitches = 0;
};

/// What the energy's triangles depend on besides the mesh.
struct EnergyTriangleOptions
{
  bool intrinsicDelaunay = false; ///< the triangles of IntrinsicDelaunay
  bool stitched = false;          ///< parts are joined [stitch]

  bool operator==(const EnergyTriangleOptions& other) const
  {
    return this->intrinsicDelaunay == other.intrinsicDelaunay && this->stitched == other.stitched;
  }
  /// Whether the energy is summed over the surface's own triangles.
  bool KeepSurface() const { return !this->intrinsicDelaunay && !this->stitched; }
};

/// Makes the energy's triangles from the surface's, unless options.KeepSurface().
/// @param P  n x 3, in the frame @param surface  the surface's triangles and their cotangents
/// @param triangles  takes the result; its topology is left untouched where it fits already, so
///        that what was built on it can be kept
/// @return whether the topology was replaced
bool UpdateEnergyTriangles(const Points& P, const EnergyTriangles& surface,
  const EnergyTriangleOptions& options, EnergyTriangles& triangles);
} // namespace SphericalStyle

#endif
