// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// CGAL's kernel and mesh, and the way there and back. Included by source files of this folder
/// only.
#ifndef SphericalStyle_SurfaceMesh_h
#define SphericalStyle_SurfaceMesh_h

#include "TriangleMesh.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <vector>

namespace SphericalStyle
{
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point3 = Kernel::Point_3;
using SurfaceMesh = CGAL::Surface_mesh<Point3>;

inline Point3 ToPoint(const Points& P, Eigen::Index i)
{
  return { P(i, 0), P(i, 1), P(i, 2) };
}

/// The mesh must be a manifold. Points and triangles keep their numbers.
inline SurfaceMesh ToSurfaceMesh(const TriangleMesh& mesh)
{
  SurfaceMesh result;
  for (Eigen::Index i = 0; i < mesh.P.rows(); ++i)
  {
    result.add_vertex(ToPoint(mesh.P, i));
  }
  using Vertex = SurfaceMesh::Vertex_index;
  for (const auto& t : mesh.F.rowwise())
  {
    result.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2]));
  }
  return result;
}

/// Removed elements are left out, the others numbered in order.
inline TriangleMesh ToTriangleMesh(const SurfaceMesh& mesh)
{
  TriangleMesh result;
  result.P.resize(static_cast<Eigen::Index>(mesh.number_of_vertices()), 3);
  result.F.resize(static_cast<Eigen::Index>(mesh.number_of_faces()), 3);
  std::vector<int> number(mesh.num_vertices(), -1);
  int n = 0;
  for (const auto v : mesh.vertices())
  {
    const Point3& p = mesh.point(v);
    result.P.row(n) << p.x(), p.y(), p.z();
    number[v] = n++;
  }
  Eigen::Index m = 0;
  for (const auto f : mesh.faces())
  {
    int k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
    {
      result.F(m, k++) = number[v];
    }
    ++m;
  }
  return result;
}
} // namespace SphericalStyle

#endif
