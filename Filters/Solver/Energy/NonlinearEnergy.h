// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The energy of the nonlinear feature [nonlinear] (Eq. 3.2, with the bracket that it lacks):
///
///     E(P', R, s) = sum_i [ sum_{j in N(i)} w_ij |e'_ij - R_i e_ij|^2
///                           + sum_{j in N(i) + i} lambda_j |R_i n_j - s_j (p'_j - o)|^2 ]
///
/// in a frame whose origin is o. With s_j = 1 / |p'_j| it is Eq. 3.1.
#ifndef SphericalStyle_NonlinearEnergy_h
#define SphericalStyle_NonlinearEnergy_h

#include "OneRings.h"
#include "StyleEnergy.h"

namespace SphericalStyle
{
class NonlinearEnergy
{
public:
  /// Scales are held below this: a point nearer to o than 1e-6 counts as that far away.
  static constexpr double LargestScale = 1e6;

  NonlinearEnergy() = default;
  /// @param rings  kept by reference, must outlive this
  /// @param P  rest points, n x 3, around o, in units of r @param normals  n x 3, unit or zero
  /// @param lambda  >= 0, of each point
  NonlinearEnergy(
    const OneRings& rings, Points P, Points normals, Eigen::VectorXd lambda, int threads);

  const OneRings& GetRings() const { return *this->Rings; }
  const Points& GetRestPoints() const { return this->P; }
  int GetThreads() const { return this->Threads; }
  /// A scale to hold energies against: E at rest with R = I and s = 0, signs of w dropped.
  double GetScale() const { return this->Scale; }

  /// E(Q, R, s). Negative w can make it negative, but it has a lower bound: for fixed R and s it is
  /// |x|^2 in the cotangent matrix, which is positive semidefinite on every mesh, and linear terms.
  EnergyTerms Evaluate(const Points& Q, const Matrices& R, const Eigen::VectorXd& s) const;
  /// The share of each cell in E, n values that sum to it.
  Eigen::VectorXd CellEnergies(const Points& Q, const Matrices& R, const Eigen::VectorXd& s) const;

  /// s_j = 1 / |p'_j|, of which s is the auxiliary (Eq. 3.2).
  static Eigen::VectorXd ReciprocalDistances(const Points& Q);
  /// S_i (Eq. 3.7).
  void Covariances(const Points& Q, const Eigen::VectorXd& s, Matrices& S) const;
  /// s_j := the minimizer of E over 0 <= s_j <= LargestScale, one per point. 0 for p'_j = o, where
  /// E does not depend on it. @return the change of E, <= 0
  double FitScales(const Points& Q, const Matrices& R, Eigen::VectorXd& s) const;
  /// s_i := Eq. 3.12 to the letter: the one scale of all points of cell i that suits that cell
  /// best, of any sign. @return the change of E, of any sign
  double FitScalesPerCell(const Points& Q, const Matrices& R, Eigen::VectorXd& s) const;

  /// Half of dE/dP' is (2 L_w + diag(D)) P' - b. D_i = lambda_i nu_i s_i^2, nu_i cells hold i.
  Eigen::VectorXd Diagonal(const Eigen::VectorXd& s) const;
  /// b_i = sum_{j in N(i)} w_ij (R_i + R_j) e_ij + lambda_i s_i sum_{j in N(i) + i} R_j n_i.
  void RightHandSide(const Matrices& R, const Eigen::VectorXd& s, Points& b) const;

private:
  EnergyTerms CellEnergy(int i, const Points& Q, const Matrices& R, const Eigen::VectorXd& s) const;
  Eigen::Vector3d SumOfTurnedNormals(int j, const Matrices& R) const;
  double SetScales(
    const Points& Q, const Matrices& R, const Eigen::VectorXd& next, Eigen::VectorXd& s) const;

  const OneRings* Rings = nullptr;
  Points P;
  Points Normals;
  Eigen::VectorXd Lambda;
  double Scale = 0.0;
  int Threads = 1;
};
} // namespace SphericalStyle

#endif
