// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "FlatFoot.h"

#include "MeshTopology.h"
#include "SurfaceMesh.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace SphericalStyle
{
namespace
{
/// Where an edge is cut nearer to one of its ends than this, that end is moved onto the level.
constexpr double ShortestPiece = 0.05;
/// Levels that are looked at before the search between two of them.
constexpr int NumberOfLevels = 256;

std::uint64_t Key(int u, int v)
{
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(u)) << 32U) |
    static_cast<std::uint32_t>(v);
}

struct FaceInfo
{
  int depth = -1; // how many constraints are crossed on the way from outside
};
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel,
  CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
/// It throws where constraints cross each other.
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure,
  CGAL::No_constraint_intersection_requiring_constructions_tag>;

/// Of each face, whether an odd number of borders is around it.
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

/// Triangles inside of borders in a plane across the axis, facing down.
/// @return false where the borders cross each other or pass through a point twice
bool FillBorders(const Points& P, int axis, const std::vector<std::array<int, 2>>& borders,
  std::vector<std::array<int, 3>>& filling)
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
    const auto vertex =
      triangulation.insert(Kernel::Point_2(P(i, (axis + 1) % 3), P(i, (axis + 2) % 3)));
    if (triangulation.number_of_vertices() > before)
    {
      vertex->info() = i;
    }
    vertices.emplace(i, vertex);
    return vertex;
  };
  try
  {
    for (const auto& border : borders)
    {
      const auto u = vertexOf(border[0]);
      const auto v = vertexOf(border[1]);
      if (u->info() != border[0] || v->info() != border[1])
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
    return borders.empty();
  }
  MarkInside(triangulation);
  for (const auto face : triangulation.finite_face_handles())
  {
    if (face->info().depth % 2 == 1)
    {
      filling.push_back(
        { face->vertex(0)->info(), face->vertex(2)->info(), face->vertex(1)->info() });
    }
  }
  return true;
}

/// Moves points onto the level where edges would be cut close to them.
void MoveOntoLevel(Points& P, const Triangles& F, int axis, double level)
{
  std::vector<char> moves(P.rows(), 0);
  for (const auto& t : F.rowwise())
  {
    for (int k = 0; k < 3; ++k)
    {
      const int u = t[k];
      const int v = t[(k + 1) % 3];
      const double above = P(u, axis) - level;
      const double other = P(v, axis) - level;
      if ((above > 0.0) != (other > 0.0) && above != 0.0 && other != 0.0)
      {
        const double share = above / (above - other);
        moves[u] = moves[u] || share < ShortestPiece ? 1 : 0;
        moves[v] = moves[v] || share > 1.0 - ShortestPiece ? 1 : 0;
      }
    }
  }
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    if (moves[i])
    {
      P(i, axis) = level;
    }
  }
}

/// Leaves out points that no triangle has.
void DropUnused(DerivedSurface& surface)
{
  std::vector<int> number(surface.mesh.P.rows(), -1);
  for (const auto& t : surface.mesh.F.rowwise())
  {
    for (int k = 0; k < 3; ++k)
    {
      number[t[k]] = 0;
    }
  }
  int n = 0;
  for (std::size_t i = 0; i < number.size(); ++i)
  {
    if (number[i] == 0)
    {
      surface.mesh.P.row(n) = surface.mesh.P.row(static_cast<Eigen::Index>(i)).eval();
      surface.ends[n] = surface.ends[i];
      surface.shares[n] = surface.shares[i];
      number[i] = n++;
    }
  }
  surface.mesh.P.conservativeResize(n, 3);
  surface.ends.resize(n);
  surface.shares.resize(n);
  surface.mesh.F = surface.mesh.F.unaryExpr([&](int i) { return number[i]; }).eval();
}
} // namespace

DerivedSurface Underived(const TriangleMesh& mesh)
{
  DerivedSurface whole;
  whole.mesh = mesh;
  for (int i = 0; i < static_cast<int>(mesh.P.rows()); ++i)
  {
    whole.ends.push_back({ i, i });
    whole.shares.push_back(0.0);
  }
  for (int f = 0; f < static_cast<int>(mesh.F.rows()); ++f)
  {
    whole.triangles.push_back(f);
  }
  return whole;
}

OpenEdges FindOpenEdges(const Triangles& F)
{
  std::unordered_map<std::uint64_t, int> counts;
  counts.reserve(3 * F.rows());
  for (const auto& t : F.rowwise())
  {
    for (int k = 0; k < 3; ++k)
    {
      ++counts[Key(t[k], t[(k + 1) % 3])];
    }
  }
  OpenEdges open;
  for (const auto& t : F.rowwise()) // in their order, so that the first is the same everywhere
  {
    for (int k = 0; k < 3; ++k)
    {
      const auto other = counts.find(Key(t[(k + 1) % 3], t[k]));
      const int back = other == counts.end() ? 0 : other->second;
      const int forth = counts[Key(t[k], t[(k + 1) % 3])];
      if (forth > 1 || back > 1)
      {
        ++open.nonManifold;
        open.firstNonManifold = open.firstNonManifold < 0 ? t[k] : open.firstNonManifold;
      }
      else if (back == 0)
      {
        ++open.borders;
        open.firstBorder = open.firstBorder < 0 ? t[k] : open.firstBorder;
      }
    }
  }
  return open;
}

void SplitFans(DerivedSurface& surface)
{
  Triangles& F = surface.mesh.F;
  const auto n = static_cast<int>(surface.mesh.P.rows());
  std::vector<std::vector<int>> at(n); // triangles
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      at[F(f, k)].push_back(static_cast<int>(f));
    }
  }
  std::vector<int> sources; // of new points
  for (int i = 0; i < n; ++i)
  {
    std::vector<int> rest = at[i];
    for (bool first = true; !rest.empty(); first = false)
    {
      std::vector<int> fan = { rest.back() };
      rest.pop_back();
      for (std::size_t k = 0; k < fan.size(); ++k)
      {
        const Eigen::RowVector3i t = F.row(fan[k]);
        const auto meets = [&](int f)
        {
          int common = 0;
          for (int a = 0; a < 3; ++a)
          {
            common += (t.array() == F(f, a)).any() ? 1 : 0;
          }
          return common >= 2;
        };
        const auto end =
          std::stable_partition(rest.begin(), rest.end(), [&](int f) { return !meets(f); });
        fan.insert(fan.end(), end, rest.end());
        rest.erase(end, rest.end());
      }
      if (!first)
      {
        const int copy = n + static_cast<int>(sources.size());
        sources.push_back(i);
        for (const int f : fan)
        {
          F.row(f) = (F.row(f).array() == i).select(copy, F.row(f)).eval();
        }
      }
    }
  }
  surface.mesh.P.conservativeResize(n + static_cast<Eigen::Index>(sources.size()), 3);
  for (std::size_t k = 0; k < sources.size(); ++k)
  {
    surface.mesh.P.row(n + static_cast<Eigen::Index>(k)) = surface.mesh.P.row(sources[k]).eval();
    surface.ends.push_back(surface.ends[sources[k]]);
    surface.shares.push_back(surface.shares[sources[k]]);
  }
}

double SectionArea(const TriangleMesh& mesh, int axis, double level)
{
  const int x = (axis + 1) % 3;
  const int y = (axis + 2) % 3;
  double twice = 0.0;
  const Eigen::RowVector3d O = mesh.P.row(mesh.F(0, 0));
  for (const auto& t : mesh.F.rowwise())
  {
    Eigen::Vector2d from = Eigen::Vector2d::Zero();
    Eigen::Vector2d to = Eigen::Vector2d::Zero();
    bool crosses = false;
    for (int k = 0; k < 3; ++k)
    {
      const int u = t[k];
      const int v = t[(k + 1) % 3];
      const bool up = mesh.P(u, axis) < level && mesh.P(v, axis) >= level;
      const bool down = mesh.P(u, axis) >= level && mesh.P(v, axis) < level;
      if (up || down)
      {
        const double share = (level - mesh.P(u, axis)) / (mesh.P(v, axis) - mesh.P(u, axis));
        const Eigen::RowVector3d p = mesh.P.row(u) - O + share * (mesh.P.row(v) - mesh.P.row(u));
        (up ? from : to) = { p(x), p(y) };
        crosses = true;
      }
    }
    if (crosses)
    {
      twice += to(0) * from(1) - to(1) * from(0);
    }
  }
  return 0.5 * twice;
}

double GroundArea(const TriangleMesh& mesh, int axis, double tolerance)
{
  const double ground = mesh.P.col(axis).minCoeff() + tolerance;
  double area = 0.0;
  for (const auto& t : mesh.F.rowwise())
  {
    if (mesh.P(t[0], axis) <= ground && mesh.P(t[1], axis) <= ground &&
      mesh.P(t[2], axis) <= ground)
    {
      const Eigen::RowVector3d u = mesh.P.row(t[1]) - mesh.P.row(t[0]);
      const Eigen::RowVector3d v = mesh.P.row(t[2]) - mesh.P.row(t[0]);
      area += 0.5 * std::abs(u.cross(v)(axis));
    }
  }
  return area;
}

double FootLevel(const TriangleMesh& mesh, int axis, double wanted, double deepest, double& most)
{
  const double ground = mesh.P.col(axis).minCoeff();
  most = 0.0;
  double low = ground;
  for (int k = 1; k <= NumberOfLevels; ++k)
  {
    double high = ground + (deepest - ground) * k / NumberOfLevels;
    const double area = SectionArea(mesh, axis, high);
    most = std::max(most, area);
    if (area >= wanted)
    {
      for (int step = 0; step < 60; ++step)
      {
        const double middle = 0.5 * (low + high);
        (SectionArea(mesh, axis, middle) >= wanted ? high : low) = middle;
      }
      return high;
    }
    low = high;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

DerivedSurface CutFlat(const TriangleMesh& mesh, int axis, double level)
{
  DerivedSurface cut;
  Points P = mesh.P;
  MoveOntoLevel(P, mesh.F, axis, level);
  const auto n = static_cast<int>(P.rows());
  std::vector<Eigen::RowVector3d> added;
  for (int i = 0; i < n; ++i)
  {
    cut.ends.push_back({ i, i });
    cut.shares.push_back(0.0);
  }
  std::unordered_map<std::uint64_t, int> onEdge;
  const auto pointOn = [&](int u, int v) // one above, one below
  {
    const auto [place, isNew] =
      onEdge.emplace(Key(std::min(u, v), std::max(u, v)), n + static_cast<int>(added.size()));
    if (isNew)
    {
      const int a = std::min(u, v);
      const int b = std::max(u, v);
      const double share = (level - P(a, axis)) / (P(b, axis) - P(a, axis));
      Eigen::RowVector3d p = P.row(a) + share * (P.row(b) - P.row(a));
      p(axis) = level;
      added.emplace_back(p);
      cut.ends.push_back({ a, b });
      cut.shares.push_back(share);
    }
    return place->second;
  };
  std::vector<std::array<int, 3>> kept;
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    std::vector<int> polygon; // what is above
    bool isAbove = false;
    for (int k = 0; k < 3; ++k)
    {
      const int u = mesh.F(f, k);
      const int v = mesh.F(f, (k + 1) % 3);
      if (P(u, axis) >= level)
      {
        polygon.push_back(u);
        isAbove = isAbove || P(u, axis) > level;
      }
      if ((P(u, axis) > level && P(v, axis) < level) || (P(u, axis) < level && P(v, axis) > level))
      {
        polygon.push_back(pointOn(u, v));
      }
    }
    for (std::size_t k = 2; isAbove && k < polygon.size(); ++k)
    {
      kept.push_back({ polygon[0], polygon[k - 1], polygon[k] });
      cut.triangles.push_back(static_cast<int>(f));
    }
  }
  P.conservativeResize(n + static_cast<Eigen::Index>(added.size()), 3);
  for (std::size_t k = 0; k < added.size(); ++k)
  {
    P.row(n + static_cast<Eigen::Index>(k)) = added[k];
  }
  const auto fill = [&](const std::vector<std::array<int, 3>>& triangles)
  {
    Triangles F(static_cast<Eigen::Index>(triangles.size()), 3);
    for (std::size_t f = 0; f < triangles.size(); ++f)
    {
      F.row(static_cast<Eigen::Index>(f)) =
        Eigen::Map<const Eigen::RowVector3i>(triangles[f].data());
    }
    return F;
  };
  const Triangles above = fill(kept);
  std::unordered_map<std::uint64_t, int> edges;
  for (const auto& t : kept)
  {
    for (int k = 0; k < 3; ++k)
    {
      edges.emplace(Key(t[k], t[(k + 1) % 3]), 0);
    }
  }
  // Borders of each part of the surface: parts that run through each other are closed one by one.
  const std::vector<int> parts = MeshTopology(mesh.F, n).GetComponents();
  std::map<int, std::vector<std::array<int, 2>>> borders;
  std::vector<std::array<int, 2>> all;
  for (const auto& t : kept)
  {
    for (int k = 0; k < 3; ++k)
    {
      if (edges.count(Key(t[(k + 1) % 3], t[k])) == 0)
      {
        all.push_back({ t[(k + 1) % 3], t[k] });
        borders[parts[cut.ends[t[k]][0]]].push_back(all.back());
      }
    }
  }
  std::vector<std::array<int, 3>> foot;
  bool filled = FillBorders(P, axis, all, foot);
  if (!filled)
  {
    foot.clear();
    filled = std::all_of(borders.begin(), borders.end(),
      [&](const auto& part) { return FillBorders(P, axis, part.second, foot); });
  }
  kept.insert(kept.end(), foot.begin(), foot.end());
  cut.triangles.resize(kept.size(), -1);
  cut.mesh = { P, fill(kept) };
  const OpenEdges open = FindOpenEdges(cut.mesh.F);
  if (!filled || kept.empty() || open.borders + open.nonManifold > 0)
  {
    return {};
  }
  SplitFans(cut);
  DropUnused(cut);
  return cut;
}
} // namespace SphericalStyle
