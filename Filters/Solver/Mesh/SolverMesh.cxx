// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SolverMesh.h"

#include "EdgeWeights.h"

#include <utility>

namespace SphericalStyle
{
MeshChange SolverMesh::Compare(const TriangleMesh& mesh) const
{
  if (mesh.F.rows() == 0)
  {
    throw std::invalid_argument("the mesh has no triangle");
  }
  const TriangleMesh* given = this->Given.get();
  if (given == &mesh)
  {
    return MeshChange::Nothing;
  }
  const bool sameTriangles = given && HaveSameTriangles(*given, mesh);
  if (sameTriangles && given->P == mesh.P)
  {
    return MeshChange::Nothing;
  }
  if (!mesh.P.allFinite())
  {
    throw std::invalid_argument("a point is not finite");
  }
  return sameTriangles ? MeshChange::Points : MeshChange::Triangles;
}

void SolverMesh::Set(std::shared_ptr<const TriangleMesh> mesh, MeshChange change)
{
  ++this->Version;
  this->Given = std::move(mesh);
  const auto& [P, F] = *this->Given;
  if (change == MeshChange::Triangles)
  {
    this->Surface.Topology = MeshTopology(F, static_cast<int>(P.rows()));
  }
  this->MeshFrame = FrameOf(P);
  this->P = this->MeshFrame.Into(P);
  this->Surface.Cotangents = HalfEdgeCotangents(this->P, F);
  if (!this->Surface.Cotangents.allFinite())
  {
    throw std::invalid_argument("a triangle has no area");
  }
}
} // namespace SphericalStyle
