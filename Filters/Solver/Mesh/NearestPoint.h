// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The point of a surface that is nearest to a place.
#ifndef SphericalStyle_NearestPoint_h
#define SphericalStyle_NearestPoint_h

#include "TriangleTree.h"

#include <limits>

namespace SphericalStyle
{
/// The point of the triangle abc that is nearest to p, by the corner, edge or face whose Voronoi
/// region p is in (C. Ericson, Real-Time Collision Detection, 2005, 5.1.5).
Eigen::Vector3d NearestOfTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
  const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// The nearest point of triangles that have an area, by their tree: boxes that are farther than
/// what has been found are left out.
///
/// Why not vtkStaticCellLocator (VTK 9.2, measured): it searches cubes around the place that grow,
/// which takes long where the surface is far. To find the planes of symmetry of creature, spot,
/// armadillo and human-parts took 2 to 10 times as long with it (farthest: 10.2 and 1.0 s).
class NearestPoint
{
public:
  NearestPoint(const Points& points, const Triangles& triangles, const Eigen::Vector3d& place)
    : P(points)
    , F(triangles)
    , Place(place)
  {
  }

  void Search(const TriangleTree& tree) { this->Search(tree, tree.GetRoot()); }

  int GetTriangle() const { return this->Triangle; } ///< of equally near ones any, always the same
  const Eigen::Vector3d& GetPoint() const { return this->Point; }
  double GetSquaredDistance() const { return this->Square; }

private:
  void Search(const TriangleTree& tree, const TriangleTree::Node& node);
  void Test(int f);

  const Points& P;
  const Triangles& F;
  Eigen::Vector3d Place;

  double Square = std::numeric_limits<double>::infinity();
  int Triangle = -1;
  Eigen::Vector3d Point = Eigen::Vector3d::Zero();
};
} // namespace SphericalStyle

#endif
