// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A normal for every point to turn to, the common part of styles that are made of normals
/// [analogy]:
///
///     term_y(R) = lambda a_y |R n_y - t_y|^2
///
/// n_y the rest normal and a_y the lumped area of point y. What t_y is makes the style. H.-T. D.
/// Liu, A. Jacobson, Normal-Driven Spherical Shape Analogies, Computer Graphics Forum 40(5), SGP
/// 2021.
#ifndef SphericalStyle_TargetNormals_h
#define SphericalStyle_TargetNormals_h

#include "LocalTerm.h"

namespace SphericalStyle
{
class TargetNormals : public LocalTerm
{
public:
  /// @param lambda  weight, >= 0, no unit
  /// @throw std::invalid_argument for a lambda that is negative or not finite
  explicit TargetNormals(double lambda);

  void SetMesh(const Points& P, const Triangles& F) override;
  /// Exact: -2 tr(R S) + term(R) = -2 tr(R (S + lambda a n t^T)) + const.
  double Fit(Matrices& S, Matrices& R, int threads) override;
  double Evaluate(const Matrices& R) const override;

  const Points& GetTargets() const { return this->Targets; } ///< t, n x 3; 0 where n is 0

private:
  /// t, n x 3, unit; called once per solve. Rows of points without a normal do not count.
  /// @param P, F  the rest mesh @param normals  n_y, n x 3; 0 where a point has none
  virtual Points MakeTargets(const Points& P, const Triangles& F, const Points& normals) const = 0;

  double Lambda;
  Points Normals;          // n
  Points Targets;          // t
  Eigen::VectorXd Weights; // lambda a
};
} // namespace SphericalStyle

#endif
