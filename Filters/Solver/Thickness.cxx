// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Thickness.h"

#include "Frame.h"
#include "Parallel.h"
#include "SurfaceMeasures.h"
#include "TriangleTree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace SphericalStyle
{
namespace
{
// Lengths are fractions of the diagonal.
constexpr double Nearest = 1e-6;  // far above the rounding of points of single precision
constexpr double Rounding = 1e-9; // a ray through an edge must not pass between its triangles

/// What a ray from a point of the mesh hits first, nearer than its reach.
struct FirstHit
{
  static constexpr double Nothing = std::numeric_limits<double>::infinity();

  const Points& P;
  const Triangles& F;
  int Point;
  Eigen::Vector3d Origin;
  Eigen::Vector3d Direction;
  Eigen::Vector3d Inverse; // of the direction, finite

  double Distance; // of the hit; the reach before there is one
  int Triangle = -1;
  Eigen::Vector2d Place = { 0.0, 0.0 }; // barycentric coordinates 1 and 2

  FirstHit(const Points& points, const Triangles& triangles, int point,
    const Eigen::Vector3d& direction, double reach)
    : P(points)
    , F(triangles)
    , Point(point)
    , Origin(points.row(point))
    , Direction(direction)
    , Inverse(direction.unaryExpr([](double x) { return 1.0 / (x == 0.0 ? 1e-300 : x); }))
    , Distance(reach)
  {
  }

  /// Looks through what is below a node of the tree, nearest boxes first.
  void Search(const TriangleTree& tree, const TriangleTree::Node& node)
  {
    if (TriangleTree::IsLeaf(node))
    {
      std::for_each(tree.Begin(node), tree.End(node), [this](int f) { this->Test(f); });
      return;
    }
    TriangleTree::Node near = tree.GetLeft(node);
    TriangleTree::Node far = tree.GetRight(node);
    double toNear = this->DistanceOf(tree.GetBox(near));
    double toFar = this->DistanceOf(tree.GetBox(far));
    if (toFar < toNear)
    {
      std::swap(near, far);
      std::swap(toNear, toFar);
    }
    this->SearchWithin(tree, near, toNear);
    this->SearchWithin(tree, far, toFar);
  }

  void SearchWithin(const TriangleTree& tree, const TriangleTree::Node& node, double distance)
  {
    if (distance < Nothing && distance <= this->Distance)
    {
      this->Search(tree, node);
    }
  }

  /// Distance of the box along the ray.
  double DistanceOf(const Eigen::AlignedBox3d& box) const
  {
    const Eigen::Array3d low = (box.min() - this->Origin).array() - Rounding;
    const Eigen::Array3d high = (box.max() - this->Origin).array() + Rounding;
    const Eigen::Array3d a = low * this->Inverse.array(), b = high * this->Inverse.array();
    const double enters = std::max(0.0, a.min(b).maxCoeff());
    const double leaves = a.max(b).minCoeff();
    return enters <= leaves ? enters : Nothing; // NOLINT(bugprone-narrowing-conversions): infinity
  }

  /// Takes the triangle if the ray meets it first (Moeller, Trumbore, Fast, minimum storage
  /// ray/triangle intersection, 1997). Of two at one distance the first triangle is taken.
  void Test(int f)
  {
    const auto corners = this->F.row(f);
    if ((corners.array() == this->Point).any())
    {
      return;
    }
    const Eigen::Vector3d a = this->P.row(corners(0));
    const Eigen::Vector3d ab = this->P.row(corners(1)).transpose() - a;
    const Eigen::Vector3d ac = this->P.row(corners(2)).transpose() - a;
    const Eigen::Vector3d across = this->Direction.cross(ac);
    const double determinant = ab.dot(across);
    if (std::abs(determinant) <= 1e-12 * ab.norm() * ac.norm()) // along the ray
    {
      return;
    }
    const Eigen::Vector3d s = this->Origin - a;
    const Eigen::Vector3d q = s.cross(ab);
    const Eigen::Vector2d place(s.dot(across) / determinant, this->Direction.dot(q) / determinant);
    const double distance = ac.dot(q) / determinant;
    const bool inside = place.minCoeff() >= -Rounding && place.sum() <= 1.0 + Rounding;
    const bool first =
      distance < this->Distance || (distance == this->Distance && f < this->Triangle);
    if (inside && distance > Nearest && first)
    {
      this->Distance = distance;
      this->Triangle = f;
      this->Place = place;
    }
  }
};
}

ThicknessProbes PlaceThicknessProbes(
  const TriangleMesh& rest, const std::vector<int>& points, int threads, double reach)
{
  ThicknessProbes probes;
  if (rest.F.rows() == 0 || points.empty())
  {
    return probes;
  }
  const Points P = FrameOf(rest.P).Into(rest.P);
  const double inward = EnclosedVolume(P, rest.F) < 0.0 ? 1.0 : -1.0;
  const Points normals = PointNormals(P, rest.F);
  const TriangleTree tree(P, rest.F);

  const int n = static_cast<int>(points.size());
  std::vector<int> triangles(n, -1);
  Points barycentric(n, 3);
  ParallelFor(n, threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        const Eigen::Vector3d normal = normals.row(points[i]);
        FirstHit hit(P, rest.F, points[i], inward * normal, reach);
        if (normal.norm() > 0.5)
        {
          hit.Search(tree, tree.GetRoot());
        }
        if (hit.Triangle >= 0)
        {
          triangles[i] = hit.Triangle;
          barycentric.row(i) << 1.0 - hit.Place.sum(), hit.Place.transpose();
        }
      }
    });
  for (int i = 0; i < n; ++i)
  {
    if (triangles[i] >= 0)
    {
      barycentric.row(static_cast<Eigen::Index>(probes.points.size())) =
        barycentric.row(i).eval(); // no row is overtaken
      probes.points.push_back(points[i]);
      probes.triangles.push_back(triangles[i]);
    }
  }
  probes.barycentric = barycentric.topRows(static_cast<Eigen::Index>(probes.points.size()));
  return probes;
}

Eigen::VectorXd ThicknessRatios(
  const TriangleMesh& rest, const Points& deformed, const ThicknessProbes& probes)
{
  const auto thickness = [&](const Points& x, Eigen::Index i)
  {
    const auto corners = rest.F.row(probes.triangles[i]);
    Eigen::RowVector3d across = -x.row(probes.points[i]);
    for (int k = 0; k < 3; ++k)
    {
      across += probes.barycentric(i, k) * x.row(corners(k));
    }
    return across.norm();
  };
  Eigen::VectorXd ratio(static_cast<Eigen::Index>(probes.points.size()));
  for (Eigen::Index i = 0; i < ratio.size(); ++i)
  {
    ratio(i) = thickness(deformed, i) / thickness(rest.P, i);
  }
  return ratio;
}
} // namespace SphericalStyle
