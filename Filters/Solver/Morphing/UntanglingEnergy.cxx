// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "UntanglingEnergy.h"

#include "LocalStep.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace SphericalStyle
{
namespace
{
/// psi as a function of I = |J|^2 and D = det J, and its derivatives. It is linear in I.
struct Invariants
{
  double value;
  double byI;
  double byD;
  double byID;
  double byDD;
};

Invariants Differentiate(double I, double D, double epsilon)
{
  const double root = std::hypot(D, epsilon);
  const double chi = RegularizedDeterminant(D, epsilon);
  const double chi1 = chi / root;
  const double chi2 = 0.5 * (epsilon / root) * (epsilon / root) / root;
  const double power = 1.0 / std::cbrt(chi * chi);
  const double ratio = chi1 / chi; // = 1 / root
  const double volume = (D * D + 1.0) / chi;
  Invariants psi = {};
  psi.byI = power;
  psi.byID = -2.0 / 3.0 * power * ratio;
  psi.value = I * power + volume;
  psi.byD = I * psi.byID + 2.0 * D / chi - volume * ratio;
  psi.byDD = I * power * (10.0 / 9.0 * ratio * ratio - 2.0 / 3.0 * chi2 / chi) + 2.0 / chi -
    4.0 * D / chi * ratio + volume * (2.0 * ratio * ratio - chi2 / chi);
  return psi;
}

Eigen::Matrix3d Cofactors(const Eigen::Matrix3d& J)
{
  Eigen::Matrix3d cofactors;
  cofactors.col(0) = J.col(1).cross(J.col(2));
  cofactors.col(1) = J.col(2).cross(J.col(0));
  cofactors.col(2) = J.col(0).cross(J.col(1));
  return cofactors;
}
} // namespace

double RegularizedDeterminant(double D, double epsilon)
{
  const double root = std::hypot(D, epsilon);
  return D >= 0.0 ? 0.5 * (D + root) : 0.5 * epsilon * (epsilon / (root - D));
}

double UntanglingEnergy(const Eigen::Matrix3d& J, double epsilon)
{
  return Differentiate(J.squaredNorm(), J.determinant(), epsilon).value;
}

Eigen::Matrix3d UntanglingGradient(const Eigen::Matrix3d& J, double epsilon)
{
  const Invariants psi = Differentiate(J.squaredNorm(), J.determinant(), epsilon);
  return 2.0 * psi.byI * J + psi.byD * Cofactors(J);
}

UntanglingHessian UntanglingSecondDerivative(
  const Eigen::Matrix3d& J, double epsilon, double smallest)
{
  // J = R S, S = V diag(s) V^T, with a rotation R: s has the sign of det J.
  const Eigen::Matrix3d R = ClosestRotation(J.transpose());
  const Eigen::Matrix3d S = R.transpose() * J;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(0.5 * (S + S.transpose()));
  UntanglingHessian hessian;
  hessian.V = solver.eigenvectors();
  hessian.U = R * hessian.V;
  const Eigen::Vector3d s = solver.eigenvalues();
  const double D = s.prod();
  const Invariants psi = Differentiate(s.squaredNorm(), D, epsilon);
  const Eigen::Vector3d c(s[1] * s[2], s[2] * s[0], s[0] * s[1]); // d D / d s
  hessian.Stretch =
    psi.byDD * c * c.transpose() + 2.0 * psi.byID * (s * c.transpose() + c * s.transpose());
  hessian.Stretch.diagonal().array() += 2.0 * psi.byI;
  Eigen::Vector3d same;     // eigenvalues of E_ij + E_ji
  Eigen::Vector3d opposite; // of E_ij - E_ji
  for (int k = 0; k < 3; ++k)
  {
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    hessian.Stretch(i, j) += psi.byD * s[k];
    hessian.Stretch(j, i) += psi.byD * s[k];
    same[k] = 2.0 * psi.byI - s[k] * psi.byD;
    opposite[k] = 2.0 * psi.byI + s[k] * psi.byD;
  }
  solver.computeDirect(hessian.Stretch);
  const double largest =
    std::max({ solver.eigenvalues().maxCoeff(), same.maxCoeff(), opposite.maxCoeff() });
  const double least = smallest * largest;
  if (solver.eigenvalues().minCoeff() < least)
  {
    hessian.Stretch = solver.eigenvectors() * solver.eigenvalues().cwiseMax(least).asDiagonal() *
      solver.eigenvectors().transpose();
  }
  hessian.Turn.setZero();
  hessian.Cross.setZero();
  for (int k = 0; k < 3; ++k)
  {
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    const double plus = std::max(same[k], least);
    const double minus = std::max(opposite[k], least);
    hessian.Turn(i, j) = hessian.Turn(j, i) = 0.5 * (plus + minus);
    hessian.Cross(i, j) = hessian.Cross(j, i) = 0.5 * (plus - minus);
  }
  return hessian;
}
} // namespace SphericalStyle
