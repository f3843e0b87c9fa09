// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Normals along the coordinate axes, which makes a surface like a cube [cubic]:
///
///     term_y(R) = lambda a_y |R n_y|_1
///
/// n_y the rest normal and a_y the lumped area of point y. H.-T. D. Liu, A. Jacobson, Cubic
/// Stylization, ACM Transactions on Graphics 38(6), SIGGRAPH Asia 2019,
/// doi:10.1145/3355089.3356495.
#ifndef SphericalStyle_CubicStyle_h
#define SphericalStyle_CubicStyle_h

#include "LocalTerm.h"

namespace SphericalStyle
{
class CubicStyle : public LocalTerm
{
public:
  /// @param lambda  cubeness, >= 0, no unit
  /// @throw std::invalid_argument for a lambda that is negative or not finite
  explicit CubicStyle(double lambda);

  void SetMesh(const Points& P, const Triangles& F) override;
  /// Alternating directions as in the article, warm from call to call, and the best rotations with
  /// R n on a half axis: a local minimum, nearly always the least. A rotation stays where nothing
  /// better is found.
  double Fit(Matrices& S, Matrices& R, int threads) override;
  double Evaluate(const Matrices& R) const override;

private:
  /// Of the cell: z stands for R n, u is the scaled multiplier of z = R n, rho its penalty.
  struct Split
  {
    Eigen::Vector3d z;
    Eigen::Vector3d u;
    double rho;
  };

  double Value(const Eigen::Matrix3d& S, const Eigen::Matrix3d& R, Eigen::Index cell) const;
  void Alternate(const Eigen::Matrix3d& S, Eigen::Index cell, Eigen::Matrix3d& best, double& value);
  void Snap(
    const Eigen::Matrix3d& S, Eigen::Index cell, Eigen::Matrix3d& best, double& value) const;

  double Lambda;
  Points Normals;        // n
  Eigen::VectorXd Areas; // a
  std::vector<Split> Splits;
  Matrices Before; // R given in the last call
};
} // namespace SphericalStyle

#endif
