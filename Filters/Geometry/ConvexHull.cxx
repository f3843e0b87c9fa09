// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ConvexHull.h"

#include "SurfaceMesh.h"

#include <CGAL/Convex_hull_traits_adapter_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/convex_hull_2.h>
#include <CGAL/convex_hull_3.h>
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
#include <utility>
#include <vector>

namespace SphericalStyle
{
namespace
{
// How far the hull may stay inside of a point, as a fraction of the extent: what double precision
// leaves of planes that do not lie along the axes, also far from the origin.
constexpr double FlatnessNoise = 1e-10;

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

/// Exactly: whether the two triangles at an edge lie in different planes.
bool IsSharp(const SurfaceMesh& mesh, SurfaceMesh::Halfedge_index h)
{
  const auto opposite = [&mesh](SurfaceMesh::Halfedge_index g)
  { return mesh.point(mesh.target(mesh.next(g))); };
  return !CGAL::coplanar(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), opposite(h),
    opposite(mesh.opposite(h)));
}

/// The corners of a closed convex surface: points where three planes or more meet.
std::vector<Point3> CornersOf(const SurfaceMesh& mesh)
{
  std::vector<Point3> corners;
  for (const auto v : mesh.vertices())
  {
    const auto around = CGAL::halfedges_around_target(v, mesh);
    const auto isSharp = [&mesh](SurfaceMesh::Halfedge_index h) { return IsSharp(mesh, h); };
    if (std::count_if(around.begin(), around.end(), isSharp) >= 3)
    {
      corners.push_back(mesh.point(v));
    }
  }
  return corners;
}

/// The Delaunay triangles of the corners of a flat facet, in ascending order.
/// @param triangle  three of them, oriented as the facet is
std::vector<std::array<std::size_t, 3>> FacetTriangles(const std::vector<Point3>& corners,
  const std::vector<std::size_t>& facet, const std::array<std::size_t, 3>& triangle)
{
  using Point2 = Kernel::Point_2;
  using Triangulation = CGAL::Delaunay_triangulation_2<Kernel,
    CGAL::Triangulation_data_structure_2<
      CGAL::Triangulation_vertex_base_with_info_2<std::size_t, Kernel>>>;
  if (facet.size() == 3)
  {
    return { triangle };
  }
  const Point3& a = corners[triangle[0]];
  const Kernel::Vector_3 normal =
    CGAL::cross_product(corners[triangle[1]] - a, corners[triangle[2]] - a);
  std::array<int, 3> axes = { 0, 1, 2 };
  std::sort(axes.begin(), axes.end(),
    [&](int i, int k) { return std::abs(normal[i]) > std::abs(normal[k]); });
  // Leaving out a coordinate rounds nothing.
  for (const int axis : axes)
  {
    const auto flat = [&](std::size_t i)
    { return Point2(corners[i][(axis + 1) % 3], corners[i][(axis + 2) % 3]); };
    const auto side = CGAL::orientation(flat(triangle[0]), flat(triangle[1]), flat(triangle[2]));
    if (side == CGAL::COLLINEAR)
    {
      continue; // the facet is upright
    }
    Triangulation triangulation;
    for (const std::size_t i : facet)
    {
      triangulation.insert(flat(i))->info() = i;
    }
    std::vector<std::array<std::size_t, 3>> triangles;
    for (const auto f : triangulation.finite_face_handles())
    {
      triangles.push_back({ f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info() });
      if (side == CGAL::RIGHT_TURN)
      {
        std::swap(triangles.back()[0], triangles.back()[1]);
      }
    }
    return triangles;
  }
  return {};
}

/// The hull of its corners. CGAL goes by addresses in memory: which triangles it puts into a flat
/// facet would differ in each process and so would everything behind. Corners and facets are
/// unique, and so are the triangles of a facet whose corners come in order.
SurfaceMesh HullOfCorners(std::vector<Point3> corners)
{
  SurfaceMesh any;
  std::sort(corners.begin(), corners.end());
  CGAL::convex_hull_3(corners.begin(), corners.end(), any);
  const auto numberOf = [&](SurfaceMesh::Vertex_index v)
  {
    const auto at = std::lower_bound(corners.begin(), corners.end(), any.point(v));
    return static_cast<std::size_t>(at - corners.begin());
  };
  SurfaceMesh mesh;
  std::vector<SurfaceMesh::Vertex_index> vertices;
  std::transform(corners.begin(), corners.end(), std::back_inserter(vertices),
    [&mesh](const Point3& corner) { return mesh.add_vertex(corner); });

  std::vector<char> isDone(any.num_faces(), 0);
  for (const auto first : any.faces())
  {
    if (isDone[first] != 0)
    {
      continue;
    }
    isDone[first] = 1;
    std::vector<SurfaceMesh::Face_index> faces = { first };
    std::vector<std::size_t> facet;
    for (std::size_t k = 0; k < faces.size(); ++k)
    {
      for (const auto h : any.halfedges_around_face(any.halfedge(faces[k])))
      {
        facet.push_back(numberOf(any.target(h)));
        const auto neighbor = any.face(any.opposite(h));
        if (isDone[neighbor] == 0 && !IsSharp(any, h))
        {
          isDone[neighbor] = 1;
          faces.push_back(neighbor);
        }
      }
    }
    const std::array<std::size_t, 3> triangle = { facet[0], facet[1], facet[2] };
    std::sort(facet.begin(), facet.end());
    facet.erase(std::unique(facet.begin(), facet.end()), facet.end());
    for (const auto& t : FacetTriangles(corners, facet, triangle))
    {
      mesh.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
    }
  }
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
    SurfaceMesh mesh = HullOfCorners(corners);
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
