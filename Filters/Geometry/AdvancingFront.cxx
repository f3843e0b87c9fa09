// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "AdvancingFront.h"

#include "DisjointSets.h"
#include "SurfaceMesh.h"

#include <CGAL/Advancing_front_surface_reconstruction.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace SphericalStyle
{
namespace
{
using ThreeIds = std::array<std::size_t, 3>;

/// The order of CGAL's triangles and which of its two sides a connected part turns outward: here
/// the points decide both.
void PutInOrder(std::vector<ThreeIds>& facets, std::size_t numberOfPoints)
{
  std::vector<std::size_t> parent(numberOfPoints);
  std::iota(parent.begin(), parent.end(), std::size_t{ 0 });
  for (ThreeIds& facet : facets)
  {
    std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
    JoinSets(parent, facet[0], facet[1]);
    JoinSets(parent, facet[0], facet[2]);
  }
  const auto ascending = [](const ThreeIds& facet) {
    return ThreeIds{ facet[0], std::min(facet[1], facet[2]), std::max(facet[1], facet[2]) };
  };
  std::sort(facets.begin(), facets.end(),
    [&](const ThreeIds& a, const ThreeIds& b) { return ascending(a) < ascending(b); });
  enum class Side
  {
    Unknown,
    Kept,
    Turned
  };
  std::vector<Side> sides(numberOfPoints, Side::Unknown);
  for (ThreeIds& facet : facets)
  {
    Side& side = sides[RootOf(parent, facet[0])];
    if (side == Side::Unknown)
    {
      side = facet[1] < facet[2] ? Side::Kept : Side::Turned;
    }
    if (side == Side::Turned)
    {
      std::swap(facet[1], facet[2]);
    }
  }
}

/// Whether no tetrahedron of the points has a volume, to the last bit.
bool IsFlat(const std::vector<Point3>& points)
{
  const std::size_t n = points.size();
  std::size_t i = 1;
  while (i < n && points[i] == points[0])
  {
    ++i;
  }
  std::size_t j = i + 1;
  while (j < n && CGAL::collinear(points[0], points[i], points[j]))
  {
    ++j;
  }
  for (std::size_t k = j + 1; k < n; ++k)
  {
    if (!CGAL::coplanar(points[0], points[i], points[j], points[k]))
    {
      return false;
    }
  }
  return true;
}

/// Points as CGAL needs them: of about unit size, which its thresholds are made for, and moved by a
/// millionth of that at random, since between equal choices it goes by addresses in memory, and in
/// a plane there are many.
std::vector<Point3> ForCgal(const Points& P)
{
  const Eigen::RowVector3d low = P.colwise().minCoeff();
  const double extent = (P.colwise().maxCoeff() - low).maxCoeff();
  constexpr double Noise = 1e-6;
  std::mt19937 engine; // the same numbers each time
  const auto noise = [&engine] { return Noise * (engine() / 4294967296.0 - 0.5); };
  std::vector<Point3> points;
  points.reserve(P.rows());
  for (const auto& p : P.rowwise())
  {
    const Eigen::RowVector3d x = (p - low) / extent;
    const double moved[] = { x[0] + noise(), x[1] + noise(), x[2] + noise() };
    points.emplace_back(moved[0], moved[1], moved[2]);
  }
  return points;
}
} // namespace

Triangles AdvancingFront(const Points& P)
{
  std::vector<Point3> points;
  points.reserve(P.rows());
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    points.push_back(ToPoint(P, i));
  }
  std::vector<ThreeIds> facets;
  if (!IsFlat(points)) // CGAL writes to the terminal about flat ones
  {
    const std::vector<Point3> moved = ForCgal(P);
    CGAL::advancing_front_surface_reconstruction(
      moved.begin(), moved.end(), std::back_inserter(facets));
  }
  PutInOrder(facets, static_cast<std::size_t>(P.rows()));
  Triangles F(static_cast<Eigen::Index>(facets.size()), 3);
  Eigen::Index f = 0;
  for (const auto& [a, b, c] : facets)
  {
    F.row(f++) << static_cast<int>(a), static_cast<int>(b), static_cast<int>(c);
  }
  return F;
}
} // namespace SphericalStyle
