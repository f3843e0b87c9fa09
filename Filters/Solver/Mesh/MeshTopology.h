// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What depends on the triangles alone: who touches whom, and what is connected.
#ifndef SphericalStyle_MeshTopology_h
#define SphericalStyle_MeshTopology_h

#include "TriangleMesh.h"

namespace SphericalStyle
{
/// Whether triangles may use a point twice, as those of the energy may (EnergyTriangles).
enum class RepeatedPoints
{
  Refused,
  Allowed
};

/// The component of each point, what triangles connect: its first point, so that a point of no
/// triangle is one of its own. @param numberOfPoints  n
std::vector<int> FirstPointsOfComponents(const Triangles& F, int numberOfPoints);

class MeshTopology
{
public:
  MeshTopology() = default;
  /// @param F  m x 3 @param numberOfPoints  n
  /// @throw std::invalid_argument for a corner outside 0..n-1, a triangle that uses a point twice
  ///        where that is refused, or a point of no triangle (its number is named).
  MeshTopology(
    const Triangles& F, int numberOfPoints, RepeatedPoints repeated = RepeatedPoints::Refused);

  const Triangles& GetTriangles() const { return this->F; }
  int GetNumberOfPoints() const { return static_cast<int>(this->CornerOffset.size()) - 1; }
  int GetNumberOfTriangles() const { return static_cast<int>(this->F.rows()); }

  /// Corners (3 * triangle + k) at point i: GetCorners()[GetCornerOffset()[i] .. [i + 1]),
  /// triangles ascending, so that sums over them have one order. A point that a triangle uses
  /// twice has two corners of it.
  const std::vector<int>& GetCornerOffset() const { return this->CornerOffset; }
  const std::vector<int>& GetCorners() const { return this->Corners; }

  /// Connected component of each point, numbered by first appearance.
  const std::vector<int>& GetComponents() const { return this->Components; }
  int GetNumberOfComponents() const { return static_cast<int>(this->LastPoints.size()); }
  /// The last point of each component.
  const std::vector<int>& GetLastPoints() const { return this->LastPoints; }

  /// Weighted mean of the rows of x over each component, one row per component.
  Points ComponentMeans(const Points& x, const Eigen::VectorXd& weights) const;

private:
  Triangles F;
  std::vector<int> CornerOffset = { 0 };
  std::vector<int> Corners;
  std::vector<int> Components;
  std::vector<int> LastPoints;
};
} // namespace SphericalStyle

#endif
