// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A closed surface cut flat, so that it has a foot to stand on. [foot]
#ifndef SphericalStyle_FlatFoot_h
#define SphericalStyle_FlatFoot_h

#include "TriangleMesh.h"

#include <array>
#include <vector>

namespace SphericalStyle
{
/// A surface that has been made of another one. Each point lies between two of that one's points.
struct DerivedSurface
{
  TriangleMesh mesh;
  std::vector<std::array<int, 2>> ends; ///< of each point; one point twice where it is that point
  std::vector<double> shares;           ///< of the second end, 0..1
  std::vector<int> triangles;           ///< of each triangle, the one it is of; -1: a new one
};

/// A surface that is the mesh itself.
DerivedSurface Underived(const TriangleMesh& mesh);

/// Edges that are not those of one triangle on each side.
struct OpenEdges
{
  int borders = 0;      ///< edges of one triangle
  int nonManifold = 0;  ///< edges of three or more, or of two that run the same way
  int firstBorder = -1; ///< a point of each kind, or -1
  int firstNonManifold = -1;
};
OpenEdges FindOpenEdges(const Triangles& F);

/// Gives each point one fan of triangles: where several meet in a point, as the halves of an
/// hourglass, the others get points of their own at the same place.
void SplitFans(DerivedSurface& surface);

/// Area of the section of a closed surface, facing outward, across an axis. length^2.
double SectionArea(const TriangleMesh& mesh, int axis, double level);

/// Area of the triangles that lie on the lowest level, within `tolerance`. length^2.
double GroundArea(const TriangleMesh& mesh, int axis, double tolerance);

/// The lowest level at which the section is as large as wanted.
/// @param deepest  where the search ends
/// @param most  the largest section up to there
/// @return NaN where none is large enough
double FootLevel(const TriangleMesh& mesh, int axis, double wanted, double deepest, double& most);

/// What is above a level, closed by flat triangles on it (a constrained Delaunay triangulation of
/// the section, CGAL). Points of edges that the cut would leave shorter than a twentieth are moved
/// onto the level instead, so that no sliver comes about. The foot is flat to the bit.
/// @param mesh  closed, a manifold
/// @return empty where the section runs through itself
DerivedSurface CutFlat(const TriangleMesh& mesh, int axis, double level);
} // namespace SphericalStyle

#endif
