// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a ray meets first.
#ifndef SphericalStyle_FirstHit_h
#define SphericalStyle_FirstHit_h

#include "TriangleTree.h"

#include <limits>

namespace SphericalStyle
{
/// What a ray hits first, nearer than its reach. Lengths are fractions of the diagonal.
class FirstHit
{
public:
  static constexpr double Nothing = std::numeric_limits<double>::infinity();

  /// @param direction  of length 1 @param reach  distance of what is still hit
  FirstHit(const Points& points, const Triangles& triangles, const Eigen::Vector3d& origin,
    const Eigen::Vector3d& direction, double reach);

  /// Triangles at this point do not count.
  void SkipPoint(int point) { this->Point = point; }
  /// Nor do those nearer than this that the ray meets from their outside.
  void SkipOutsides(double nearer) { this->Blind = nearer; }

  void Search(const TriangleTree& tree) { this->Search(tree, tree.GetRoot()); }

  /// Whether something in the box may be hit before what is.
  bool MayMeet(const Eigen::AlignedBox3d& box) const
  {
    const double distance = this->DistanceOf(box);
    return distance < Nothing && distance <= this->Distance;
  }

  int GetTriangle() const { return this->Triangle; } ///< -1 where nothing is hit
  double GetDistance() const { return this->Distance; }
  /// Barycentric coordinates of the hit.
  Eigen::Vector3d GetPlace() const
  {
    return { 1.0 - this->Place.sum(), this->Place(0), this->Place(1) };
  }

private:
  void Search(const TriangleTree& tree, const TriangleTree::Node& node);
  void SearchWithin(const TriangleTree& tree, const TriangleTree::Node& node, double distance);
  double DistanceOf(const Eigen::AlignedBox3d& box) const;
  void Test(int f);

  const Points& P;
  const Triangles& F;
  Eigen::Vector3d Origin;
  Eigen::Vector3d Direction;
  Eigen::Vector3d Inverse; // of the direction, finite
  int Point = -1;
  double Blind = 0.0;

  double Distance; // of the hit; the reach before there is one
  int Triangle = -1;
  Eigen::Vector2d Place = { 0.0, 0.0 }; // barycentric coordinates 1 and 2
};
} // namespace SphericalStyle

#endif
