// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The undirected edges of triangles, manifold or not.
#ifndef SphericalStyle_MeshEdges_h
#define SphericalStyle_MeshEdges_h

#include "TriangleMesh.h"

namespace SphericalStyle
{
/// Which half-edges lie on which edge. Edges are ordered by their smaller, then their larger point.
class MeshEdges
{
public:
  explicit MeshEdges(const Triangles& F);

  int GetNumberOfEdges() const { return static_cast<int>(this->Offset.size()) - 1; }
  /// Half-edges (3 * triangle + k) on edge e: GetHalfEdges()[GetOffset()[e] .. [e + 1]), ascending.
  const std::vector<int>& GetOffset() const { return this->Offset; }
  const std::vector<int>& GetHalfEdges() const { return this->HalfEdges; }
  /// How many triangles meet at edge e.
  int GetValence(int e) const { return this->Offset[e + 1] - this->Offset[e]; }

private:
  std::vector<int> Offset = { 0 };
  std::vector<int> HalfEdges;
};
} // namespace SphericalStyle

#endif
