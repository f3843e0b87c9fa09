// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Parts of a surface that touch in a point or along an edge, taken apart there. [manifold]
#ifndef SphericalStyle_ManifoldSurface_h
#define SphericalStyle_ManifoldSurface_h

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
  int nonManifold = 0;  ///< edges of three or more
  int misoriented = 0;  ///< edges that two triangles run through in the same direction
  int firstBorder = -1; ///< a point of each kind, or -1
  int firstNonManifold = -1;
  int firstMisoriented = -1;
};
OpenEdges FindOpenEdges(const Triangles& F);

/// The numbers of the triangles, ascending, without those that say again what an earlier one says:
/// of the same three points, facing the same way. Where every triangle of the surface has one that
/// faces the other way, as in models for renderers that show front sides only, the first of both
/// stays.
std::vector<int> WithoutRepetitions(const Triangles& F);

/// Gives each point one fan of triangles and each edge at most two, by points of their own at the
/// same place. At an edge of three or more triangles two that have the inside of the surface
/// between them belong together. What one direction has more than the other gets a border there:
/// first what has borders already, as walls and fins have, then what is small. Points keep their
/// numbers, new ones follow; edges whose ends stay together are split in the middle.
/// @param surface  its triangles agree on the outside
void MakeManifold(DerivedSurface& surface);
} // namespace SphericalStyle

#endif
