// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "UntanglingEnergy.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>

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

UntanglingHessian UntanglingSecondDerivative(const Eigen::Matrix3d& J, double epsilon)
{
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(J, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d& U = svd.matrixU();
  Eigen::Matrix3d V = svd.matrixV();
  Eigen::Vector3d s = svd.singularValues();
  if (U.determinant() * V.determinant() < 0.0) // then J is inverted, and s has its sign
  {
    V.col(2) = -V.col(2);
    s[2] = -s[2];
  }
  const double D = s.prod();
  const Invariants psi = Differentiate(s.squaredNorm(), D, epsilon);
  const Eigen::Vector3d c(s[1] * s[2], s[2] * s[0], s[0] * s[1]); // d D / d s

  UntanglingHessian hessian = {};
  int n = 0;
  Eigen::Matrix3d stretch =
    psi.byDD * c * c.transpose() + 2.0 * psi.byID * (s * c.transpose() + c * s.transpose());
  for (int k = 0; k < 3; ++k)
  {
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    stretch(k, k) += 2.0 * psi.byI;
    stretch(i, j) += psi.byD * s[k];
    stretch(j, i) += psi.byD * s[k];
    for (const double sign : { -1.0, 1.0 })
    {
      hessian.Values[n] = 2.0 * psi.byI + sign * s[k] * psi.byD;
      hessian.Vectors[n] =
        std::sqrt(0.5) * (U.col(i) * V.col(j).transpose() - sign * U.col(j) * V.col(i).transpose());
      ++n;
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(stretch);
  for (int k = 0; k < 3; ++k)
  {
    hessian.Values[n] = solver.eigenvalues()[k];
    hessian.Vectors[n] = U * solver.eigenvectors().col(k).asDiagonal() * V.transpose();
    ++n;
  }
  return hessian;
}
} // namespace SphericalStyle
