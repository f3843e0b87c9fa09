// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PlanarPolygons.h"

#include "SurfaceMesh.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <deque>
#include <unordered_map>
#include <utility>

namespace SphericalStyle
{
namespace
{
struct FaceInfo
{
  int depth = -1; // how many edges are crossed on the way from outside
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel,
  CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
/// It throws where constraints cross each other.
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure,
  CGAL::No_constraint_intersection_requiring_constructions_tag>;

/// Of each face, whether an odd number of polygons is around it.
void MarkInside(Delaunay& triangulation)
{
  std::deque<std::pair<Delaunay::Face_handle, int>> next = { { triangulation.infinite_face(), 0 } };
  while (!next.empty())
  {
    const auto [face, depth] = next.front();
    next.pop_front();
    if (face->info().depth >= 0)
    {
      continue;
    }
    face->info().depth = depth;
    for (int k = 0; k < 3; ++k)
    {
      const bool crosses = face->is_constrained(k);
      const auto place = std::make_pair(face->neighbor(k), depth + (crosses ? 1 : 0));
      crosses ? next.push_back(place) : next.push_front(place);
    }
  }
}

} // namespace

bool FillPlanarPolygons(const std::vector<std::array<int, 2>>& edges,
  const std::function<Eigen::Vector2d(int)>& placeOf, std::vector<std::array<int, 3>>& triangles)
{
  Delaunay triangulation;
  std::unordered_map<int, Delaunay::Vertex_handle> vertices;
  const auto vertexOf = [&](int i)
  {
    const auto found = vertices.find(i);
    if (found != vertices.end())
    {
      return found->second;
    }
    const std::size_t before = triangulation.number_of_vertices();
    const Eigen::Vector2d place = placeOf(i);
    const auto vertex = triangulation.insert(Kernel::Point_2(place.x(), place.y()));
    if (triangulation.number_of_vertices() > before)
    {
      vertex->info() = i;
    }
    vertices.emplace(i, vertex);
    return vertex;
  };
  try
  {
    for (const auto& edge : edges)
    {
      const auto u = vertexOf(edge[0]);
      const auto v = vertexOf(edge[1]);
      if (u->info() != edge[0] || v->info() != edge[1])
      {
        return false;
      }
      triangulation.insert_constraint(u, v);
    }
  }
  catch (const Delaunay::Intersection_of_constraints_exception&)
  {
    return false;
  }
  if (triangulation.dimension() < 2)
  {
    return edges.empty();
  }
  MarkInside(triangulation);
  for (const auto face : triangulation.finite_face_handles())
  {
    if (face->info().depth % 2 == 1)
    {
      triangles.push_back(
        { face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info() });
    }
  }
  return true;
}
} // namespace SphericalStyle
