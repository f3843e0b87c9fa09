// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Creases.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace SphericalStyle
{
namespace
{
/// The triangles at an edge: how many, and the half-edges of the first two.
struct Sides
{
  int count = 0;
  int first = -1;
  int second = -1;
  int looks = 0;     // how many of its triangles are looked at
  double area = 0.0; // that these give to it
};

/// By the smaller and the larger point.
using SidesOfEdges = std::unordered_map<std::uint64_t, Sides>;

std::uint64_t KeyOf(const Triangles& F, int h)
{
  const auto u = static_cast<std::uint64_t>(StartPoint(F, h));
  const auto v = static_cast<std::uint64_t>(EndPoint(F, h));
  return (std::min(u, v) << 32U) | std::max(u, v);
}

/// Twice the area long.
Eigen::Vector3d Normal(const Points& x, int i, int j, int k)
{
  const Eigen::Vector3d a = x.row(i);
  const Eigen::Vector3d b = x.row(j);
  const Eigen::Vector3d c = x.row(k);
  return (b - a).cross(c - a);
}

/// Those at an edge, whatever the order of the triangles' points.
std::array<Eigen::Vector3d, 2> NormalsAt(const Points& x, const std::array<int, 4>& points)
{
  return { Normal(x, points[0], points[1], points[2]), Normal(x, points[1], points[0], points[3]) };
}

/// Of the edges of every step-th triangle.
SidesOfEdges FindSides(const TriangleMesh& mesh, int step)
{
  const Triangles& F = mesh.F;
  SidesOfEdges edges;
  edges.reserve(static_cast<std::size_t>(3 * (F.rows() / step + 1)));
  std::vector<char> isAtOne(mesh.P.rows(), 0); // few triangles have two such points
  for (int f = 0; f < F.rows(); f += step)
  {
    const double area = Normal(mesh.P, F(f, 0), F(f, 1), F(f, 2)).norm() / 6.0;
    for (int k = 0; k < 3; ++k)
    {
      Sides& sides = edges[KeyOf(F, 3 * f + k)];
      ++sides.looks;
      sides.area += area;
      isAtOne[F(f, k)] = 1;
    }
  }
  for (int h = 0; h < 3 * F.rows(); ++h)
  {
    if (isAtOne[StartPoint(F, h)] == 0 || isAtOne[EndPoint(F, h)] == 0)
    {
      continue;
    }
    if (const auto edge = edges.find(KeyOf(F, h)); edge != edges.end())
    {
      Sides& sides = edge->second;
      (sides.count == 0 ? sides.first : sides.second) = h;
      ++sides.count;
    }
  }
  return edges;
}
}

CreaseProbes PlaceCreaseProbes(const TriangleMesh& mesh, int step)
{
  const Triangles& F = mesh.F;
  CreaseProbes probes;
  double all = 0.0;
  double angles = 0.0;
  double border = 0.0;
  double planar = 0.0;
  double boxEdges = 0.0;
  for (const auto& [key, sides] : FindSides(mesh, step))
  {
    const int h = sides.first;
    const int u = StartPoint(F, h);
    const int v = EndPoint(F, h);
    const double length = (mesh.P.row(u) - mesh.P.row(v)).norm();
    all += sides.area;
    if (sides.count == 2)
    {
      probes.manifold = probes.manifold && StartPoint(F, sides.second) == v;
      const std::array<int, 4> points = { u, v, F(h / 3, h % 3),
        F(sides.second / 3, sides.second % 3) };
      const auto [a, b] = NormalsAt(mesh.P, points);
      const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
      probes.area += sides.area;
      angles += sides.area * angle;
      planar += angle < PlanarEdge ? sides.area : 0.0;
      boxEdges += angle > BoxEdge ? 0.5 * sides.looks * length : 0.0;
      if (angle < FlatEdge)
      {
        probes.flat.push_back({ points, sides.area });
      }
    }
    else
    {
      probes.manifold = probes.manifold && sides.count == 1;
      border += sides.count == 1 ? length : 0.0;
    }
  }
  if (probes.area > 0.0)
  {
    probes.meanAngle = angles / probes.area;
    probes.planarShare = planar / probes.area;
  }
  if (all > 0.0)
  {
    // Lengths and area stand for step times as much.
    probes.border = border * std::sqrt(step / all);
    probes.boxEdges = boxEdges * std::sqrt(step / all);
  }
  return probes;
}

double NewCreases(const CreaseProbes& probes, const Points& Q)
{
  const double sharp = std::cos(SharpEdge);
  double area = 0.0;
  for (const auto& edge : probes.flat)
  {
    const auto [a, b] = NormalsAt(Q, edge.points);
    area += a.dot(b) < sharp * a.norm() * b.norm() ? edge.area : 0.0;
  }
  return probes.area > 0.0 ? area / probes.area : 0.0;
}
} // namespace SphericalStyle
