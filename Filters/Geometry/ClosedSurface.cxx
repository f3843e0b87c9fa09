// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ClosedSurface.h"

#include "CGALVersion.h"
#include "SurfaceMeasures.h"
#include "SurfaceMesh.h"

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
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
#include <iterator>
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

/// A triangle lower than this fraction of its longest edge has no angles to speak of.
constexpr double LowestTriangle = 1e-8;
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

/// A point in the middle, joined to every edge of the border. Never makes an edge that is there.
void FillByFan(SurfaceMesh& surface, HalfEdge border)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (const auto v : surface.vertices_around_face(border))
  {
    const Point3& p = surface.point(v);
    sum += Eigen::Vector3d(p.x(), p.y(), p.z());
    ++count;
  }
  sum /= count;
  CGAL::Euler::fill_hole(border, surface);
  const HalfEdge spoke = CGAL::Euler::add_center_vertex(border, surface);
  surface.point(surface.target(spoke)) = Point3(sum[0], sum[1], sum[2]);
}

void FillHole(SurfaceMesh& surface, HalfEdge border)
{
  std::vector<SurfaceMesh::Face_index> faces;
  const bool isLong = surface.vertices_around_face(border).size() > LongBorder;
  const auto parameters = PMP::parameters::do_not_use_cubic_algorithm(isLong);
#if SPHERICALSTYLE_CGAL_6
  PMP::triangulate_and_refine_hole(
    surface, border, parameters.face_output_iterator(std::back_inserter(faces)));
#else
  std::vector<SurfaceMesh::Vertex_index> vertices;
  PMP::triangulate_and_refine_hole(
    surface, border, std::back_inserter(faces), std::back_inserter(vertices), parameters);
#endif
  if (faces.empty())
  {
    FillByFan(surface, border);
  }
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
    {
      const Eigen::RowVector3d u = mesh.P.row(t[1]) - mesh.P.row(t[0]);
      const Eigen::RowVector3d v = mesh.P.row(t[2]) - mesh.P.row(t[0]);
      const double longest = std::max({ u.norm(), v.norm(), (u - v).norm() });
      return !(u.cross(v).norm() > LowestTriangle * longest * longest);
    });
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
  SurfaceMesh surface = ToSurfaceMesh(mesh);
  const int holes = FillBorders(surface);
  mesh = ToTriangleMesh(surface);
  return holes;
}
} // namespace SphericalStyle
