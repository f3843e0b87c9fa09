// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ClosedSurface.h"

#include "CGALVersion.h"
#include "Frame.h"
#include "PlanarPolygons.h"
#include "SurfaceMeasures.h"
#include "SurfaceMesh.h"

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/refine.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/boost/graph/Euler_operations.h>
#if SPHERICALSTYLE_CGAL_6_2
#include <CGAL/boost/graph/border.h>
#else
#include <CGAL/Polygon_mesh_processing/border.h>
#endif

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace SphericalStyle
{
namespace
{
namespace PMP = CGAL::Polygon_mesh_processing;
#if SPHERICALSTYLE_CGAL_6_2
using CGAL::extract_boundary_cycles;
#else
using PMP::extract_boundary_cycles;
#endif

using Triangle = std::array<std::size_t, 3>;
using HalfEdge = SurfaceMesh::Halfedge_index;
using Vertex = SurfaceMesh::Vertex_index;
using Face = SurfaceMesh::Face_index;

/// A triangle lower than this fraction of its longest edge has no angles to speak of.
constexpr double LowestTriangle = 1e-8;
/// How thick a border may be across its plane, as a share of its extent, to be filled in the plane.
constexpr double FarFromPlane = 1e-3;
/// Longer borders are filled by CGAL's Delaunay search only: the full one takes n^3.
constexpr std::size_t LongBorder = 300;

/// A triangle at a point: the corner after the point, and the one before it.
struct Spoke
{
  int next;
  int previous;
};

std::vector<std::vector<Spoke>> Spokes(const Triangles& F, int numberOfPoints)
{
  std::vector<std::vector<Spoke>> spokes(numberOfPoints);
  for (const auto& t : F.rowwise())
  {
    for (int k = 0; k < 3; ++k)
    {
      spokes[t[k]].push_back({ t[(k + 1) % 3], t[(k + 2) % 3] });
    }
  }
  return spokes;
}

/// Whether the triangles, one after the other, lead once around the point and meet all of them.
bool IsClosedFan(const std::vector<Spoke>& spokes)
{
  int at = spokes.front().next;
  for (std::size_t step = 0; step < spokes.size(); ++step)
  {
    const auto leadsOn = [&](const Spoke& spoke) { return spoke.next == at; };
    const auto found = std::find_if(spokes.begin(), spokes.end(), leadsOn);
    if (found == spokes.end() || (step > 0 && at == spokes.front().next) ||
      std::find_if(std::next(found), spokes.end(), leadsOn) != spokes.end())
    {
      return false;
    }
    at = found->previous;
  }
  return at == spokes.front().next;
}

bool HasCorners(const Eigen::RowVector3i& t, int numberOfPoints)
{
  return t.minCoeff() >= 0 && t.maxCoeff() < numberOfPoints && t[0] != t[1] && t[1] != t[2] &&
    t[2] != t[0];
}

/// Takes out triangles until every edge has one or two and every point a single fan, whatever their
/// directions: what CGAL would cut apart, and leave several points at one place.
class ManifoldPart
{
public:
  ManifoldPart(const Triangles& F, int numberOfPoints)
    : Corners(numberOfPoints)
  {
    for (const auto& t : F.rowwise())
    {
      if (HasCorners(t, numberOfPoints))
      {
        this->Add({ static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
          static_cast<std::size_t>(t[2]) });
      }
    }
    for (bool changed = true; changed;)
    {
      changed = false;
      for (std::size_t point = 0; point < this->Corners.size(); ++point)
      {
        changed = this->KeepLargestFan(point) || changed;
      }
    }
  }

  std::vector<Triangle> GetTriangles() const
  {
    std::vector<Triangle> kept;
    for (std::size_t f = 0; f < this->All.size(); ++f)
    {
      if (this->Alive[f])
      {
        kept.push_back(this->All[f]);
      }
    }
    return kept;
  }

private:
  /// Triangles that have both points.
  int CountAt(std::size_t u, std::size_t v) const
  {
    return static_cast<int>(std::count_if(this->Corners[u].begin(), this->Corners[u].end(),
      [&](std::size_t f) { return this->Has(f, v); }));
  }

  bool Has(std::size_t f, std::size_t point) const
  {
    return std::find(this->All[f].begin(), this->All[f].end(), point) != this->All[f].end();
  }

  void Add(const Triangle& t)
  {
    const bool doubled = std::any_of(this->Corners[t[0]].begin(), this->Corners[t[0]].end(),
      [&](std::size_t f) { return this->Has(f, t[1]) && this->Has(f, t[2]); });
    if (doubled || this->CountAt(t[0], t[1]) > 1 || this->CountAt(t[1], t[2]) > 1 ||
      this->CountAt(t[2], t[0]) > 1)
    {
      return;
    }
    for (const std::size_t point : t)
    {
      this->Corners[point].push_back(this->All.size());
    }
    this->All.push_back(t);
    this->Alive.push_back(true);
  }

  void Remove(std::size_t f)
  {
    this->Alive[f] = false;
    for (const std::size_t point : this->All[f])
    {
      auto& corners = this->Corners[point];
      corners.erase(std::find(corners.begin(), corners.end(), f));
    }
  }

  /// The triangles at the point that hang together by edges at the point.
  std::vector<std::size_t> FanOf(std::size_t point, std::size_t first) const
  {
    std::vector<std::size_t> fan = { first };
    for (std::size_t k = 0; k < fan.size(); ++k)
    {
      for (const std::size_t other : this->Corners[point])
      {
        const auto shared = [&](std::size_t v) { return v != point && this->Has(fan[k], v); };
        if (std::any_of(this->All[other].begin(), this->All[other].end(), shared) &&
          std::find(fan.begin(), fan.end(), other) == fan.end())
        {
          fan.push_back(other);
        }
      }
    }
    return fan;
  }

  bool KeepLargestFan(std::size_t point)
  {
    const std::vector<std::size_t> all = this->Corners[point];
    std::vector<std::size_t> largest;
    for (const std::size_t f : all)
    {
      if (std::find(largest.begin(), largest.end(), f) != largest.end())
      {
        continue;
      }
      std::vector<std::size_t> fan = this->FanOf(point, f);
      if (fan.size() > largest.size())
      {
        largest = std::move(fan);
      }
    }
    for (const std::size_t f : all)
    {
      if (std::find(largest.begin(), largest.end(), f) == largest.end())
      {
        this->Remove(f);
      }
    }
    return largest.size() < all.size();
  }

  std::vector<Triangle> All;
  std::vector<bool> Alive;
  std::vector<std::vector<std::size_t>> Corners; ///< triangles at each point
};

Eigen::RowVector3d PlaceOf(const SurfaceMesh& surface, Vertex v)
{
  const Point3& p = surface.point(v);
  return { p.x(), p.y(), p.z() };
}

bool IsDegenerate(
  const Eigen::RowVector3d& a, const Eigen::RowVector3d& b, const Eigen::RowVector3d& c)
{
  const double longest =
    std::max({ (b - a).stableNorm(), (c - b).stableNorm(), (a - c).stableNorm() });
  const Eigen::RowVector3d u = (b - a) / longest;
  const Eigen::RowVector3d v = (c - a) / longest;
  return !(u.cross(v).norm() > LowestTriangle);
}

/// A point in the middle, joined to every edge of the border. Never makes an edge that is there.
void FillByFan(SurfaceMesh& surface, HalfEdge border)
{
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  int count = 0;
  for (const Vertex v : surface.vertices_around_face(border))
  {
    sum += PlaceOf(surface, v);
    ++count;
  }
  sum /= count;
  CGAL::Euler::fill_hole(border, surface);
  const HalfEdge spoke = CGAL::Euler::add_center_vertex(border, surface);
  surface.point(surface.target(spoke)) = Point3(sum[0], sum[1], sum[2]);
}

/// Fills a hole whose border lies in a plane, about.
/// @return the triangles; none where it does not, has no area or crosses itself in the plane, or
/// where an edge is elsewhere already
std::vector<Face> FillPlanarHole(SurfaceMesh& surface, HalfEdge border)
{
  std::vector<Vertex> corners;
  for (const Vertex v : surface.vertices_around_face(border))
  {
    corners.push_back(v);
  }
  const auto n = static_cast<int>(corners.size());
  Points P(n, 3);
  for (int i = 0; i < n; ++i)
  {
    P.row(i) = PlaceOf(surface, corners[i]);
  }
  const double extent = (P.colwise().maxCoeff() - P.colwise().minCoeff()).maxCoeff();
  P = (P.rowwise() - P.row(0).eval()) / extent; // so that no square overflows
  std::vector<std::array<int, 2>> edges;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (int i = 0; i < n; ++i)
  {
    const int next = (i + 1) % n;
    edges.push_back({ i, next });
    normal += P.row(i).cross(P.row(next));
  }
  const double area = 0.5 * normal.norm();
  normal.normalize();
  const Eigen::VectorXd heights = P * normal;
  if (!(area > LowestTriangle) || !(heights.maxCoeff() - heights.minCoeff() <= FarFromPlane))
  {
    return {};
  }
  const Eigen::Vector3d x = normal.unitOrthogonal();
  const Eigen::Vector3d y = normal.cross(x);
  const auto placeOf = [&](int i) -> Eigen::Vector2d {
    return { P.row(i).dot(x), P.row(i).dot(y) };
  };
  std::vector<std::array<int, 3>> triangles;
  const auto isElsewhere = [&](int u, int v)
  { return v != (u + 1) % n && surface.halfedge(corners[u], corners[v]).is_valid(); };
  if (!FillPlanarPolygons(edges, placeOf, triangles) ||
    std::any_of(triangles.begin(), triangles.end(),
      [&](const std::array<int, 3>& t)
      { return isElsewhere(t[0], t[1]) || isElsewhere(t[1], t[2]) || isElsewhere(t[2], t[0]); }))
  {
    return {};
  }
  std::vector<Face> faces;
  for (const auto& [a, b, c] : triangles)
  {
    faces.push_back(surface.add_face(corners[a], corners[b], corners[c]));
  }
  return faces;
}

/// The points of a border, moved at random until the end of its life, by up to a hundredth of the
/// way to the next ones: CGAL goes by addresses in memory between equal choices, of which there are
/// many where four points lie in a plane.
class MovedBorder
{
public:
  MovedBorder(SurfaceMesh& surface, HalfEdge border)
    : Surface(surface)
  {
    for (const Vertex v : surface.vertices_around_face(border))
    {
      this->Before.emplace_back(v, surface.point(v));
    }
    std::mt19937 engine; // the same numbers each time
    const auto noise = [&engine] { return Noise * (engine() / 2147483648.0 - 1.0); };
    for (std::size_t i = 0; i < this->Before.size(); ++i)
    {
      const auto& [v, p] = this->Before[i];
      const double gap = this->GapAt(i);
      const double by[] = { gap * noise(), gap * noise(), gap * noise() };
      surface.point(v) = Point3(p.x() + by[0], p.y() + by[1], p.z() + by[2]);
    }
  }
  MovedBorder(const MovedBorder&) = delete;
  MovedBorder& operator=(const MovedBorder&) = delete;
  ~MovedBorder()
  {
    for (const auto& [v, p] : this->Before)
    {
      this->Surface.point(v) = p;
    }
  }

private:
  static constexpr double Noise = 0.006; // along each axis

  /// The way to the nearest of two points on each side, before.
  double GapAt(std::size_t i) const
  {
    const std::size_t n = this->Before.size();
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t step : { std::size_t{ 1 }, std::size_t{ 2 }, n - 2, n - 1 })
    {
      const Point3& p = this->Before[i].second;
      const Point3& q = this->Before[(i + step) % n].second;
      least =
        std::min(least, Eigen::Vector3d(q.x() - p.x(), q.y() - p.y(), q.z() - p.z()).stableNorm());
    }
    return least;
  }

  SurfaceMesh& Surface;
  std::vector<std::pair<Vertex, Point3>> Before;
};

/// CGAL's filling of a hole of any shape.
/// @param all  looks at all triangles, not only at those of a Delaunay triangulation
std::vector<Face> SearchTriangles(SurfaceMesh& surface, HalfEdge border, bool all)
{
  std::vector<Face> faces;
  const bool isLong = surface.vertices_around_face(border).size() > LongBorder;
  const auto parameters =
    PMP::parameters::do_not_use_cubic_algorithm(isLong).use_delaunay_triangulation(isLong || !all);
#if SPHERICALSTYLE_CGAL_6
  PMP::triangulate_hole(
    surface, border, parameters.face_output_iterator(std::back_inserter(faces)));
#else
  PMP::triangulate_hole(surface, border, std::back_inserter(faces), parameters);
#endif
  return faces;
}

/// Fills a hole of any shape. @return the triangles; none where CGAL finds none
std::vector<Face> FillAnyHole(SurfaceMesh& surface, HalfEdge border)
{
  std::vector<Face> faces;
  {
    const MovedBorder moved(surface, border);
    faces = SearchTriangles(surface, border, false);
  }
  const auto isDegenerate = [&surface](Face f)
  {
    std::array<Eigen::RowVector3d, 3> corners;
    int k = 0;
    for (const Vertex v : surface.vertices_around_face(surface.halfedge(f)))
    {
      corners[k++] = PlaceOf(surface, v);
    }
    return IsDegenerate(corners[0], corners[1], corners[2]);
  };
  if (std::none_of(faces.begin(), faces.end(), isDegenerate))
  {
    return faces;
  }
  // Three points on a line make a triangle only when moved. In place, CGAL leaves it out.
  for (const Face f : faces)
  {
    CGAL::Euler::remove_face(surface.halfedge(f), surface);
  }
  return SearchTriangles(surface, border, true);
}

void FillHole(SurfaceMesh& surface, HalfEdge border)
{
  std::vector<Face> faces = FillPlanarHole(surface, border);
  if (faces.empty())
  {
    faces = FillAnyHole(surface, border);
  }
  if (faces.empty())
  {
    FillByFan(surface, border);
    return;
  }
  PMP::refine(surface, faces, CGAL::Emptyset_iterator(), CGAL::Emptyset_iterator());
}

int FillBorders(SurfaceMesh& surface)
{
  std::vector<HalfEdge> borders;
  extract_boundary_cycles(surface, std::back_inserter(borders));
  for (const HalfEdge border : borders)
  {
    FillHole(surface, border);
  }
  return static_cast<int>(borders.size());
}

bool HasDegenerateTriangle(const TriangleMesh& mesh)
{
  const auto rows = mesh.F.rowwise();
  return std::any_of(rows.begin(), rows.end(),
    [&](const Eigen::RowVector3i& t)
    { return IsDegenerate(mesh.P.row(t[0]), mesh.P.row(t[1]), mesh.P.row(t[2])); });
}

/// V - E + F of a closed surface.
Eigen::Index EulerCharacteristic(const TriangleMesh& mesh)
{
  return mesh.P.rows() - mesh.F.rows() / 2;
}
} // namespace

bool IsClosedManifold(const Triangles& F, int numberOfPoints)
{
  const auto rows = F.rowwise();
  if (F.rows() == 0 ||
    !std::all_of(rows.begin(), rows.end(),
      [&](const Eigen::RowVector3i& t) { return HasCorners(t, numberOfPoints); }))
  {
    return false;
  }
  const auto spokes = Spokes(F, numberOfPoints);
  return std::all_of(spokes.begin(), spokes.end(),
    [](const std::vector<Spoke>& at) { return at.empty() || IsClosedFan(at); });
}

ClosedSurfaceResult CloseSurface(const Points& P, const Triangles& F)
{
  ClosedSurfaceResult result;
  std::vector<Triangle> triangles = ManifoldPart(F, static_cast<int>(P.rows())).GetTriangles();
  if (triangles.empty())
  {
    return result;
  }
  std::vector<Point3> points;
  points.reserve(P.rows());
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    points.push_back(ToPoint(P, i));
  }
  const bool orientable = PMP::orient_polygon_soup(points, triangles);
  SurfaceMesh surface;
  PMP::polygon_soup_to_polygon_mesh(points, triangles, surface);
  PMP::keep_largest_connected_components(surface, 1);
  if (orientable) // one that is not was cut open: there is no border to fill
  {
    result.holesClosed = FillBorders(surface);
  }
  for (const auto v : surface.vertices())
  {
    if (surface.is_isolated(v))
    {
      surface.remove_vertex(v);
    }
  }
  result.mesh = ToTriangleMesh(surface);
  if (EnclosedVolume(result.mesh.P, result.mesh.F) < 0.0)
  {
    result.mesh.F.col(1).swap(result.mesh.F.col(2));
  }
  result.closed = IsClosedManifold(result.mesh.F, static_cast<int>(result.mesh.P.rows())) &&
    EulerCharacteristic(result.mesh) == 2 && !HasDegenerateTriangle(result.mesh);
  return result;
}

int FillHoles(TriangleMesh& mesh)
{
  const Points before = mesh.P;
  const Frame frame = FrameOf(before); // CGAL's measures would overflow
  SurfaceMesh surface = ToSurfaceMesh({ frame.Into(before), mesh.F });
  const int holes = FillBorders(surface);
  mesh = ToTriangleMesh(surface);
  mesh.P = frame.OutOf(mesh.P);
  mesh.P.topRows(before.rows()) = before; // to the bit
  return holes;
}
} // namespace SphericalStyle
