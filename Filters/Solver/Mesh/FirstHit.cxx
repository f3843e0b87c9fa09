// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "FirstHit.h"

#include <utility>

namespace SphericalStyle
{
namespace
{
constexpr double Nearest = 1e-6;     // far above the rounding of points of single precision
constexpr double RayRounding = 1e-9; // a ray through an edge must not pass between its triangles
}

FirstHit::FirstHit(const Points& points, const Triangles& triangles, const Eigen::Vector3d& origin,
  const Eigen::Vector3d& direction, double reach)
  : P(points)
  , F(triangles)
  , Origin(origin)
  , Direction(direction)
  , Inverse(direction.unaryExpr([](double x) { return 1.0 / (x == 0.0 ? 1e-300 : x); }))
  , Distance(reach)
{
}

/// Looks through what is below a node of the tree, nearest boxes first.
void FirstHit::Search(const TriangleTree& tree, const TriangleTree::Node& node)
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

void FirstHit::SearchWithin(
  const TriangleTree& tree, const TriangleTree::Node& node, double distance)
{
  if (distance < Nothing && distance <= this->Distance)
  {
    this->Search(tree, node);
  }
}

/// Distance of the box along the ray.
double FirstHit::DistanceOf(const Eigen::AlignedBox3d& box) const
{
  double enters = 0.0;
  double leaves = Nothing;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double a = (box.min()[axis] - this->Origin[axis] - RayRounding) * this->Inverse[axis];
    const double b = (box.max()[axis] - this->Origin[axis] + RayRounding) * this->Inverse[axis];
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  return enters <= leaves ? enters : Nothing; // NOLINT(bugprone-narrowing-conversions): infinity
}

/// Takes the triangle if the ray meets it first (Moeller, Trumbore, Fast, minimum storage
/// ray/triangle intersection, 1997). Of two at one distance the first triangle is taken.
void FirstHit::Test(int f)
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
  const bool inside = place.minCoeff() >= -RayRounding && place.sum() <= 1.0 + RayRounding;
  const bool first =
    distance < this->Distance || (distance == this->Distance && f < this->Triangle);
  const bool seen = determinant < 0.0 || distance >= this->Blind; // below 0: from its inside
  if (inside && distance > Nearest && first && seen)
  {
    this->Distance = distance;
    this->Triangle = f;
    this->Place = place;
  }
}
} // namespace SphericalStyle
