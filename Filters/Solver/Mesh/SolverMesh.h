// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A mesh made ready for a solve.
#ifndef SphericalStyle_SolverMesh_h
#define SphericalStyle_SolverMesh_h

#include "EnergyTriangles.h"
#include "Frame.h"

#include <memory>

namespace SphericalStyle
{
/// What a new mesh makes stale.
enum class MeshChange
{
  Nothing,
  Points,
  Triangles
};

/// What depends on points and triangles alone. Lengths are those of the frame.
struct SolverMesh
{
  std::shared_ptr<const TriangleMesh> Given; ///< as given, to recognize it; none at first
  Frame MeshFrame;
  Points P;
  EnergyTriangles Surface; ///< the triangles as given
  int Version = 0;         ///< another one for every mesh that it took

  /// @throw std::invalid_argument for a mesh without triangles or with points that are not finite
  MeshChange Compare(const TriangleMesh& mesh) const;
  /// Takes the mesh. @param change  Compare(mesh): with Points, the topology is kept
  /// @throw std::invalid_argument: see MeshTopology; triangles without area
  void Set(std::shared_ptr<const TriangleMesh> mesh, MeshChange change);
};
} // namespace SphericalStyle

#endif
