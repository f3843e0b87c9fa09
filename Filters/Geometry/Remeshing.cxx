// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Remeshing.h"

#include "SurfaceMesh.h"

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace SphericalStyle
{
namespace PMP = CGAL::Polygon_mesh_processing;

namespace
{
// Edges as sharp as this stay where they are: a plate keeps its rim.
constexpr double SharpEdgeDegrees = 50.0;

using ThreeCorners = std::array<int, 3>;

/// Parts of triangle (a, b, c) between its corners and the middles of its long edges.
/// @param m  middle of bc, ca, ab; -1 where the edge stays whole
void Cut(const Points& P, ThreeCorners t, ThreeCorners m, std::vector<ThreeCorners>& parts)
{
  const auto whole = std::count(m.begin(), m.end(), -1);
  // Turned so that the one cut, or the one whole edge, is bc.
  while (whole == 2 ? m[0] < 0 : whole == 1 && m[0] >= 0)
  {
    std::rotate(t.begin(), t.begin() + 1, t.end());
    std::rotate(m.begin(), m.begin() + 1, m.end());
  }
  const auto [a, b, c] = t;
  switch (whole)
  {
    case 3:
      parts.push_back(t);
      break;
    case 2:
      parts.insert(parts.end(), { { a, b, m[0] }, { a, m[0], c } });
      break;
    case 1: // the rest is the quadrilateral b, c, m[1], m[2]: along its shorter diagonal
      parts.push_back({ a, m[2], m[1] });
      if ((P.row(b) - P.row(m[1])).squaredNorm() < (P.row(c) - P.row(m[2])).squaredNorm())
      {
        parts.insert(parts.end(), { { b, c, m[1] }, { b, m[1], m[2] } });
      }
      else
      {
        parts.insert(parts.end(), { { b, c, m[2] }, { c, m[1], m[2] } });
      }
      break;
    default:
      parts.insert(parts.end(),
        { { a, m[2], m[1] }, { b, m[0], m[2] }, { c, m[1], m[0] }, { m[0], m[1], m[2] } });
  }
}

/// Cuts every edge that is too long once, in the middle. @return whether there was one
bool SplitOnce(TriangleMesh& mesh, double edgeLength)
{
  std::map<std::pair<int, int>, int> middles;
  std::vector<Eigen::RowVector3d> added;
  const auto middle = [&](int u, int v)
  {
    if (!((mesh.P.row(u) - mesh.P.row(v)).norm() > edgeLength))
    {
      return -1;
    }
    const int next = static_cast<int>(mesh.P.rows()) + static_cast<int>(added.size());
    const auto found = middles.insert({ std::minmax(u, v), next });
    if (found.second)
    {
      added.emplace_back(0.5 * (mesh.P.row(u) + mesh.P.row(v)));
    }
    return found.first->second;
  };
  std::vector<ThreeCorners> cuts;
  cuts.reserve(mesh.F.rows());
  for (const auto& t : mesh.F.rowwise())
  {
    cuts.push_back({ middle(t[1], t[2]), middle(t[2], t[0]), middle(t[0], t[1]) });
  }
  const Eigen::Index before = mesh.P.rows();
  mesh.P.conservativeResize(before + static_cast<Eigen::Index>(added.size()), 3);
  for (std::size_t i = 0; i < added.size(); ++i)
  {
    mesh.P.row(before + static_cast<Eigen::Index>(i)) = added[i];
  }
  std::vector<ThreeCorners> parts;
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    Cut(mesh.P, { mesh.F(f, 0), mesh.F(f, 1), mesh.F(f, 2) }, cuts[f], parts);
  }
  mesh.F.resize(static_cast<Eigen::Index>(parts.size()), 3);
  for (std::size_t f = 0; f < parts.size(); ++f)
  {
    mesh.F.row(static_cast<Eigen::Index>(f)) << parts[f][0], parts[f][1], parts[f][2];
  }
  return !added.empty();
}

/// Cuts sharp edges into equal parts about as long as the edge length. CGAL cuts in halves, so that
/// a box would have a half or the double of the points asked for.
template <typename EdgeMap>
void CutSharpEdges(SurfaceMesh& mesh, EdgeMap sharp, double edgeLength)
{
  std::vector<SurfaceMesh::Edge_index> edges;
  std::copy_if(mesh.edges().begin(), mesh.edges().end(), std::back_inserter(edges),
    [&](SurfaceMesh::Edge_index edge) { return sharp[edge]; });
  for (const SurfaceMesh::Edge_index edge : edges)
  {
    const SurfaceMesh::Halfedge_index rest = mesh.halfedge(edge);
    const Point3 start = mesh.point(mesh.source(rest));
    const auto line = mesh.point(mesh.target(rest)) - start;
    const auto parts = std::lround(std::sqrt(line.squared_length()) / edgeLength);
    for (long k = 1; k < parts; ++k)
    {
      const SurfaceMesh::Halfedge_index part = CGAL::Euler::split_edge(rest, mesh);
      mesh.point(mesh.target(part)) = start + static_cast<double>(k) / parts * line;
      sharp[mesh.edge(part)] = true;
      for (const auto& [to, from] :
        { std::pair(part, rest), std::pair(mesh.opposite(rest), mesh.opposite(part)) })
      {
        if (!mesh.is_border(to))
        {
          CGAL::Euler::split_face(to, mesh.next(from), mesh);
        }
      }
    }
  }
}
} // namespace

double EdgeLengthFor(double area, int numberOfPoints)
{
  // Two triangles a point, each of area sqrt(3) / 4 * length^2.
  return std::sqrt(2.0 * area / (std::sqrt(3.0) * numberOfPoints));
}

TriangleMesh IsotropicRemeshing(const TriangleMesh& mesh, double edgeLength)
{
  SurfaceMesh surface = ToSurfaceMesh(mesh);
  auto sharp = surface.add_property_map<SurfaceMesh::Edge_index, bool>("e:sharp", false).first;
  PMP::detect_sharp_edges(surface, SharpEdgeDegrees, sharp);
  CutSharpEdges(surface, sharp, edgeLength);
  PMP::isotropic_remeshing(surface.faces(), edgeLength, surface,
    PMP::parameters::number_of_iterations(5).number_of_relaxation_steps(2).edge_is_constrained_map(
      sharp));
  return ToTriangleMesh(surface);
}

TriangleMesh SplitLongEdges(TriangleMesh mesh, double edgeLength)
{
  // CGAL's function of this name cuts the edges that are there and not those that the cuts make:
  // slivers become stars of slivers.
  while (SplitOnce(mesh, edgeLength))
  {
  }
  return mesh;
}
} // namespace SphericalStyle
