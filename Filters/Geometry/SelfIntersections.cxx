// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SelfIntersections.h"

#include "SurfaceMesh.h"

#include <CGAL/box_intersection_d.h>

#include <algorithm>

namespace SphericalStyle
{
namespace
{
using Triangle3 = Kernel::Triangle_3;
using Segment3 = Kernel::Segment_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;

/// Exact tests of two triangles by their numbers. CGAL's own self_intersections does the same, but
/// on manifold meshes only.
class PairTest
{
public:
  explicit PairTest(const TriangleMesh& mesh)
    : Mesh(mesh)
  {
  }

  bool operator()(int f, int g) const
  {
    // Positions of the shared points in f and in g.
    std::array<int, 3> inF{};
    std::array<int, 3> inG{};
    int shared = 0;
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        if (this->Mesh.F(f, i) == this->Mesh.F(g, j))
        {
          inF[shared] = i;
          inG[shared++] = j;
        }
      }
    }
    switch (shared)
    {
      case 0:
        return CGAL::do_intersect(this->Triangle(f), this->Triangle(g));
      case 1: // what they have in common beyond the point reaches an edge opposite of it
        return CGAL::do_intersect(this->Triangle(f), this->Opposite(g, inG[0])) ||
          CGAL::do_intersect(this->Triangle(g), this->Opposite(f, inF[0]));
      case 2: // overlapping in one plane, folded onto each other
        return OnOneSide(this->Corner(f, inF[0]), this->Corner(f, inF[1]),
          this->Corner(f, 3 - inF[0] - inF[1]), this->Corner(g, 3 - inG[0] - inG[1]));
      default: // the same triangle twice
        return true;
    }
  }

private:
  Point3 Corner(int f, int k) const { return ToPoint(this->Mesh.P, this->Mesh.F(f, k)); }
  Triangle3 Triangle(int f) const
  {
    return { this->Corner(f, 0), this->Corner(f, 1), this->Corner(f, 2) };
  }
  Segment3 Opposite(int f, int k) const
  {
    return { this->Corner(f, HalfEdgeStart(k)), this->Corner(f, HalfEdgeEnd(k)) };
  }
  static bool OnOneSide(const Point3& a, const Point3& b, const Point3& c, const Point3& d)
  {
    return CGAL::coplanar(a, b, c, d) && CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE;
  }

  const TriangleMesh& Mesh;
};
}

std::vector<std::array<int, 2>> SelfIntersections(const TriangleMesh& mesh)
{
  return SelfIntersections(mesh, std::vector<char>(mesh.F.rows(), 1));
}

std::vector<std::array<int, 2>> SelfIntersections(
  const TriangleMesh& mesh, const std::vector<char>& chosen)
{
  std::array<std::vector<Box>, 2> boxes; // of the others, and of those that are chosen
  for (int f = 0; f < mesh.F.rows(); ++f)
  {
    CGAL::Bbox_3 bounds;
    for (const int i : mesh.F.row(f))
    {
      bounds += ToPoint(mesh.P, i).bbox();
    }
    boxes[chosen[f] ? 1 : 0].emplace_back(bounds, f);
  }
  auto& [others, own] = boxes;
  std::vector<std::array<int, 2>> pairs;
  const PairTest intersect(mesh);
  const auto test = [&](const Box& a, const Box& b)
  {
    const auto ends = std::minmax({ a.info(), b.info() });
    if (intersect(ends.first, ends.second))
    {
      pairs.push_back({ ends.first, ends.second });
    }
  };
  CGAL::box_self_intersection_d(own.begin(), own.end(), test);
  CGAL::box_intersection_d(own.begin(), own.end(), others.begin(), others.end(), test);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<char> IntersectingTriangles(const TriangleMesh& mesh)
{
  std::vector<char> intersecting(mesh.F.rows(), 0);
  for (const auto& pair : SelfIntersections(mesh))
  {
    intersecting[pair[0]] = 1;
    intersecting[pair[1]] = 1;
  }
  return intersecting;
}
} // namespace SphericalStyle
