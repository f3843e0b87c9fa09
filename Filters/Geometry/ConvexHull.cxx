// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ConvexHull.h"

#include "SurfaceMesh.h"

#include <CGAL/Convex_hull_traits_adapter_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/convex_hull_2.h>
#include <CGAL/convex_hull_3.h>
#include <CGAL/convex_hull_3_to_face_graph.h>
#include <CGAL/property_map.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <numeric>
#include <vector>

namespace SphericalStyle
{
namespace
{
// How far the hull may stay inside of a point, as a fraction of the extent: what double precision
// leaves of planes that do not lie along the axes, also far from the origin.
constexpr double FlatnessNoise = 1e-10;
// Two opposite circles of n points have n^2 tetrahedra.
constexpr std::size_t MostForDelaunay = 5000;

/// Axes of the points around their mean, the longest extent first.
Points PrincipalCoordinates(const Points& P)
{
  const Points centered = P.rowwise() - P.colwise().mean();
  const double largest = centered.cwiseAbs().maxCoeff();
  const Points unit = largest > 0.0 ? Points(centered / largest) : centered;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(unit.transpose() * unit);
  return unit * axes.eigenvectors().rowwise().reverse();
}

int Dimension(const Points& principal)
{
  const Eigen::RowVector3d extent = principal.colwise().maxCoeff() - principal.colwise().minCoeff();
  const double largest = extent.maxCoeff();
  return largest > 0.0 ? static_cast<int>((extent.array() > FlatExtent * largest).count()) : 0;
}

/// Takes out corners of a convex polygon that rounding alone put off the line between their
/// neighbors: their triangles would have no area.
void DropCornersOnLines(std::vector<int>& corners, const Points& principal)
{
  const double least =
    FlatExtent * (principal.colwise().maxCoeff() - principal.colwise().minCoeff()).maxCoeff();
  const auto isOnLine = [&](std::size_t i)
  {
    const std::size_t n = corners.size();
    const auto at = [&](std::size_t k) -> Eigen::Vector2d
    { return principal.row(corners[k % n]).head<2>().transpose(); };
    const Eigen::Vector2d along = at(i + 1) - at(i + n - 1);
    const Eigen::Vector2d x = at(i) - at(i + n - 1);
    return std::abs(along[0] * x[1] - along[1] * x[0]) <= least * along.norm();
  };
  std::size_t kept = 0; // corners in a row that may stay
  for (std::size_t i = 0; corners.size() > 3 && kept < corners.size();)
  {
    if (isOnLine(i))
    {
      corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
      kept = 0;
    }
    else
    {
      ++kept;
      ++i;
    }
    i = i < corners.size() ? i : 0;
  }
}

/// The corners of the hull of points in a plane, as a fan.
TriangleMesh HullPolygon(const Points& P, const Points& principal)
{
  using Point2 = Kernel::Point_2;
  std::vector<Point2> plane;
  plane.reserve(P.rows());
  for (const auto& p : principal.rowwise())
  {
    plane.emplace_back(p[0], p[1]);
  }
  std::vector<int> ids(plane.size());
  std::iota(ids.begin(), ids.end(), 0);
  std::vector<int> corners;
  using Traits =
    CGAL::Convex_hull_traits_adapter_2<Kernel, CGAL::Pointer_property_map<Point2>::type>;
  CGAL::convex_hull_2(
    ids.begin(), ids.end(), std::back_inserter(corners), Traits(CGAL::make_property_map(plane)));
  DropCornersOnLines(corners, principal);

  TriangleMesh mesh;
  const auto n = static_cast<Eigen::Index>(corners.size());
  mesh.P = P(corners, AllColumns);
  mesh.F.resize(n - 2, 3);
  for (Eigen::Index i = 0; i < n - 2; ++i)
  {
    mesh.F.row(i) << 0, static_cast<int>(i + 1), static_cast<int>(i + 2);
  }
  return mesh;
}

/// The corners of a closed convex surface: points where three planes or more meet.
std::vector<Point3> CornersOf(const SurfaceMesh& mesh)
{
  // Exactly: whether the two triangles at an edge lie in different planes.
  const auto isSharp = [&mesh](SurfaceMesh::Halfedge_index h)
  {
    const auto opposite = [&mesh](SurfaceMesh::Halfedge_index g)
    { return mesh.point(mesh.target(mesh.next(g))); };
    return !CGAL::coplanar(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), opposite(h),
      opposite(mesh.opposite(h)));
  };
  std::vector<Point3> corners;
  for (const auto v : mesh.vertices())
  {
    const auto around = CGAL::halfedges_around_target(v, mesh);
    if (std::count_if(around.begin(), around.end(), isSharp) >= 3)
    {
      corners.push_back(mesh.point(v));
    }
  }
  return corners;
}

/// CGAL's hull goes by addresses in memory: which triangles it puts into a flat facet, and which
/// points inside of it become vertices, would differ in each process and so would everything
/// behind. Corners are unique, and so is the Delaunay triangulation of points in order.
SurfaceMesh DelaunayHull(std::vector<Point3> corners)
{
  std::sort(corners.begin(), corners.end());
  SurfaceMesh mesh;
  if (corners.size() > MostForDelaunay)
  {
    CGAL::convex_hull_3(corners.begin(), corners.end(), mesh);
    return mesh;
  }
  const CGAL::Delaunay_triangulation_3<Kernel> triangulation(corners.begin(), corners.end());
  CGAL::convex_hull_3_to_face_graph(triangulation, mesh);
  return mesh;
}

/// Whether rounding alone keeps a point of the surface from lying inside of a facet or of an edge:
/// its triangles are needles, or stand in directions that mean nothing.
bool IsNoise(const SurfaceMesh& mesh, SurfaceMesh::Vertex_index v, double extent)
{
  constexpr std::size_t MostPairs = 200;
  const auto from = [&](SurfaceMesh::Vertex_index u)
  {
    const auto e = mesh.point(u) - mesh.point(v);
    return Eigen::Vector3d(e.x() / extent, e.y() / extent, e.z() / extent);
  };
  std::vector<Eigen::Vector3d> ring;
  for (const auto u : mesh.vertices_around_target(mesh.halfedge(v)))
  {
    ring.push_back(from(u));
  }
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < ring.size(); ++i)
  {
    normal += ring[i].cross(ring[(i + 1) % ring.size()]);
  }
  normal = normal.stableNormalized();
  if (std::all_of(ring.begin(), ring.end(),
        [&](const Eigen::Vector3d& e) { return std::abs(normal.dot(e)) <= FlatnessNoise; }))
  {
    return true;
  }
  for (std::size_t i = 0; i < ring.size() && ring.size() <= MostPairs; ++i)
  {
    for (std::size_t k = 0; k < i; ++k)
    {
      const Eigen::Vector3d& a = ring[i];
      const Eigen::Vector3d& b = ring[k];
      if (a.dot(b) < 0.0 && a.cross(b).norm() <= FlatnessNoise * (a - b).norm())
      {
        return true;
      }
    }
  }
  return false;
}

/// The hull of the corners without those that are noise. Of neighbors one goes at a time, so that
/// round surfaces of many points keep their shape.
SurfaceMesh HullWithoutNoise(std::vector<Point3> corners, double extent)
{
  for (;;)
  {
    SurfaceMesh mesh = DelaunayHull(corners);
    std::map<Point3, SurfaceMesh::Vertex_index> byPlace;
    for (const auto v : mesh.vertices())
    {
      byPlace[mesh.point(v)] = v;
    }
    std::vector<char> stays(mesh.num_vertices(), 0);
    corners.clear();
    for (const auto& [place, v] : byPlace)
    {
      if (stays[v] != 0 || !IsNoise(mesh, v, extent))
      {
        corners.push_back(place);
        continue;
      }
      for (const auto u : mesh.vertices_around_target(mesh.halfedge(v)))
      {
        stays[u] = 1;
      }
    }
    if (corners.size() == byPlace.size())
    {
      return mesh;
    }
  }
}

/// Points by coordinates, triangles by points.
TriangleMesh Sorted(const TriangleMesh& mesh)
{
  std::vector<int> order(mesh.P.rows());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
    [&P = mesh.P](int a, int b)
    {
      return std::lexicographical_compare(
        P.row(a).begin(), P.row(a).end(), P.row(b).begin(), P.row(b).end());
    });
  std::vector<int> number(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    number[order[i]] = static_cast<int>(i);
  }
  std::vector<std::array<int, 3>> triangles;
  triangles.reserve(mesh.F.rows());
  for (const auto& t : mesh.F.rowwise())
  {
    triangles.push_back({ number[t[0]], number[t[1]], number[t[2]] });
    auto& sorted = triangles.back();
    std::rotate(sorted.begin(), std::min_element(sorted.begin(), sorted.end()), sorted.end());
  }
  std::sort(triangles.begin(), triangles.end());

  TriangleMesh result{ mesh.P(order, AllColumns), Triangles(mesh.F.rows(), 3) };
  for (std::size_t f = 0; f < triangles.size(); ++f)
  {
    result.F.row(static_cast<Eigen::Index>(f)) << triangles[f][0], triangles[f][1], triangles[f][2];
  }
  return result;
}
} // namespace

int HullDimension(const Points& P)
{
  return P.rows() > 0 ? Dimension(PrincipalCoordinates(P)) : 0;
}

Hull ConvexHull(const Points& P)
{
  Hull hull;
  if (P.rows() == 0)
  {
    return hull;
  }
  const Points principal = PrincipalCoordinates(P);
  hull.dimension = Dimension(principal);
  if (hull.dimension == 2)
  {
    hull.mesh = HullPolygon(P, principal);
  }
  else if (hull.dimension == 3)
  {
    std::vector<Point3> points;
    points.reserve(P.rows());
    for (Eigen::Index i = 0; i < P.rows(); ++i)
    {
      points.push_back(ToPoint(P, i));
    }
    SurfaceMesh mesh;
    CGAL::convex_hull_3(points.begin(), points.end(), mesh);
    const double extent = (P.colwise().maxCoeff() - P.colwise().minCoeff()).maxCoeff();
    hull.mesh = Sorted(ToTriangleMesh(HullWithoutNoise(CornersOf(mesh), extent)));
  }
  return hull;
}
} // namespace SphericalStyle
