// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Remeshing.h"

#include "SurfaceMesh.h"

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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
  AppendPoints(mesh.P, added);
  std::vector<ThreeCorners> parts;
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    Cut(mesh.P, { mesh.F(f, 0), mesh.F(f, 1), mesh.F(f, 2) }, cuts[f], parts);
  }
  mesh.F = ToTriangles(parts);
  return !added.empty();
}

/// Points along the sides of a triangle, in order.
using Chain = std::vector<int>;

/// Triangles between two chains that begin in one point and end in one: always by the shorter of
/// the two next diagonals. A chain may have two sides of a triangle, the other one is straight.
/// @param left  straight, goes the way of the triangles
void Zip(const Points& P, const Chain& left, const Chain& right, std::vector<ThreeCorners>& parts)
{
  std::size_t i = 1;
  std::size_t j = 1;
  parts.push_back({ left[0], left[1], right[1] });
  while (i + 1 < left.size() || j + 2 < right.size())
  {
    // The common end comes last, by the left: three points of one side are no triangle.
    const bool rightIsDone = j + 2 >= right.size();
    const bool leftWaits = !rightIsDone && i + 2 >= left.size();
    const bool goesLeft = rightIsDone ||
      (!leftWaits &&
        (P.row(left[i + 1]) - P.row(right[j])).squaredNorm() <=
          (P.row(left[i]) - P.row(right[j + 1])).squaredNorm());
    if (goesLeft)
    {
      parts.push_back({ left[i], left[i + 1], right[j] });
      ++i;
    }
    else
    {
      parts.push_back({ left[i], right[j + 1], right[j] });
      ++j;
    }
  }
}

/// Cuts edges into equal parts about as long as the edge length. CGAL cuts in halves, so that a box
/// would have a half or the double of the points asked for.
class EvenlyCut
{
public:
  EvenlyCut(const TriangleMesh& mesh, double edgeLength)
    : P(mesh.P)
  {
    for (const auto& t : mesh.F.rowwise())
    {
      for (int k = 0; k < 3; ++k)
      {
        this->CutEdge(t[k], t[(k + 1) % 3], edgeLength);
      }
    }
    AppendPoints(this->P, this->Added);
    for (const auto& t : mesh.F.rowwise())
    {
      this->CutTriangle({ t[0], t[1], t[2] });
    }
  }

  TriangleMesh GetMesh() const { return { this->P, ToTriangles(this->Parts) }; }

  /// The points of an edge.
  Chain Side(int u, int v) const
  {
    Chain side = this->Sides.at(std::minmax(u, v));
    if (u > v)
    {
      std::reverse(side.begin(), side.end());
    }
    return side;
  }

private:
  void CutEdge(int u, int v, double edgeLength)
  {
    const auto [from, to] = std::minmax(u, v);
    Chain& side = this->Sides[{ from, to }];
    if (!side.empty())
    {
      return;
    }
    side.push_back(from);
    const Eigen::RowVector3d line = this->P.row(to) - this->P.row(from);
    const auto parts = std::lround(line.norm() / edgeLength);
    for (long k = 1; k < parts; ++k)
    {
      side.push_back(static_cast<int>(this->P.rows()) + static_cast<int>(this->Added.size()));
      this->Added.emplace_back(this->P.row(from) + static_cast<double>(k) / parts * line);
    }
    side.push_back(to);
  }

  /// From the corner across the shortest side, which meets the two long ones.
  void CutTriangle(ThreeCorners t)
  {
    const auto length = [&](int k)
    { return (this->P.row(t[(k + 1) % 3]) - this->P.row(t[(k + 2) % 3])).squaredNorm(); };
    int shortest = 0;
    for (int k = 1; k < 3; ++k)
    {
      shortest = length(k) < length(shortest) ? k : shortest;
    }
    std::rotate(t.begin(), t.begin() + shortest, t.end());
    const Chain left = this->Side(t[0], t[1]);
    Chain right = this->Side(t[0], t[2]);
    const Chain across = this->Side(t[2], t[1]);
    right.insert(right.end(), across.begin() + 1, across.end());
    Zip(this->P, left, right, this->Parts);
  }

  Points P;
  std::vector<Eigen::RowVector3d> Added;
  std::map<std::pair<int, int>, Chain> Sides;
  std::vector<ThreeCorners> Parts;
};

/// Those of a hull's edges that stay where they are.
std::vector<std::array<int, 2>> SharpEdges(const TriangleMesh& mesh)
{
  SurfaceMesh surface = ToSurfaceMesh(mesh);
  auto sharp = surface.add_property_map<SurfaceMesh::Edge_index, bool>("e:sharp", false).first;
  PMP::detect_sharp_edges(surface, SharpEdgeDegrees, sharp);
  std::vector<std::array<int, 2>> edges;
  for (const SurfaceMesh::Edge_index edge : surface.edges())
  {
    if (sharp[edge])
    {
      edges.push_back(
        { static_cast<int>(surface.vertex(edge, 0)), static_cast<int>(surface.vertex(edge, 1)) });
    }
  }
  return edges;
}
} // namespace

double EdgeLengthFor(double area, int numberOfPoints)
{
  // Two triangles a point, each of area sqrt(3) / 4 * length^2.
  return std::sqrt(2.0 * area / (std::sqrt(3.0) * numberOfPoints));
}

TriangleMesh IsotropicRemeshing(const TriangleMesh& mesh, double edgeLength)
{
  // Not with long edges: CGAL would split those of a needle as often as there are points along it,
  // for each of them.
  const EvenlyCut cut(mesh, edgeLength);
  SurfaceMesh surface = ToSurfaceMesh(cut.GetMesh());
  auto sharp = surface.add_property_map<SurfaceMesh::Edge_index, bool>("e:sharp", false).first;
  for (const auto& [u, v] : SharpEdges(mesh))
  {
    const Chain side = cut.Side(u, v);
    for (std::size_t k = 1; k < side.size(); ++k)
    {
      using Vertex = SurfaceMesh::Vertex_index;
      sharp[surface.edge(surface.halfedge(Vertex(side[k - 1]), Vertex(side[k])))] = true;
    }
  }
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
