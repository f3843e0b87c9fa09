// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The energy of a tetrahedron: its minimum, what it does not depend on, and its derivatives by
// finite differences, also of inverted ones.
#include "Check.h"
#include "Meshes.h"
#include "UntanglingEnergy.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <limits>

using namespace SphericalStyle;

namespace
{
Eigen::Matrix3d RandomRotation(Meshes::Random& random)
{
  return Eigen::AngleAxisd(3.0 * random.Signed(), random.InCube().normalized()).toRotationMatrix();
}

void TestDeterminant()
{
  for (const double epsilon : { 1.0, 1e-3, 1e-9 })
  {
    for (const double D : { -2.0, -1e-4, 0.0, 1e-4, 3.0 })
    {
      const double chi = RegularizedDeterminant(D, epsilon);
      CHECK(chi > 0.0, "chi(" << D << ") should be above 0, it is " << chi);
      // the positive root of chi (chi - D) = epsilon^2 / 4
      CHECK_NEAR(chi * (chi - D), 0.25 * epsilon * epsilon, 1e-15 * (1.0 + chi * chi),
        "chi at " << D << ", epsilon " << epsilon);
    }
    CHECK_NEAR(RegularizedDeterminant(0.0, epsilon), 0.5 * epsilon, 0.0, "chi(0)");
  }
  CHECK_NEAR(RegularizedDeterminant(-1.0, 1e-9) / 2.5e-19, 1.0, 1e-12, "chi without cancellation");
}

void TestMinimum()
{
  Meshes::Random random(1);
  for (int k = 0; k < 100; ++k)
  {
    const Eigen::Matrix3d R = RandomRotation(random);
    CHECK_NEAR(UntanglingEnergy(R, 1e-9), 5.0, 1e-12, "energy of a rotation");
    CHECK_NEAR(UntanglingGradient(R, 1e-9).norm(), 0.0, 1e-12, "its gradient");
    const Eigen::Matrix3d J = R + 0.3 * random.Matrix();
    CHECK(UntanglingEnergy(J, 1e-9) > 5.0, "any other energy should be above 5");
    const Eigen::Matrix3d turned = RandomRotation(random) * J * RandomRotation(random);
    CHECK_NEAR(UntanglingEnergy(turned, 0.1) / UntanglingEnergy(J, 0.1), 1.0, 1e-12,
      "energy of a turned tetrahedron");
  }
}

// By hand: J = diag(2, 1, 1) with epsilon 0: 6 / 2^(2/3) + 5 / 2.
void TestValue()
{
  const Eigen::Matrix3d J = Eigen::Vector3d(2.0, 1.0, 1.0).asDiagonal();
  CHECK_NEAR(
    UntanglingEnergy(J, 0.0), 6.0 / std::pow(2.0, 2.0 / 3.0) + 2.5, 1e-14, "diag(2, 1, 1)");
}

/// 9 x 9, of J column by column: x g^T with the axes as g.
Eigen::Matrix<double, 9, 9> AllOf(const UntanglingHessian& H)
{
  Eigen::Matrix<double, 9, 9> all;
  for (int k = 0; k < 3; ++k)
  {
    for (int l = 0; l < 3; ++l)
    {
      all.block<3, 3>(3 * k, 3 * l) =
        H.U * H.InAxes(H.V.row(k).transpose(), H.V.row(l).transpose()) * H.U.transpose();
    }
  }
  return all;
}

void TestDerivatives()
{
  Meshes::Random random(2);
  int inverted = 0;
  int indefinite = 0;
  for (int k = 0; k < 200; ++k)
  {
    const double epsilon = k % 2 == 0 ? 1.0 : 0.05;
    const Eigen::Matrix3d J =
      k % 5 == 0 ? RandomRotation(random) : Eigen::Matrix3d(1.5 * random.Matrix());
    inverted += J.determinant() < 0.0;
    const Eigen::Matrix3d direction = random.Matrix();
    const double h = 1e-5;
    const Eigen::Matrix3d gradient = UntanglingGradient(J, epsilon);
    const double slope = (UntanglingEnergy(J + h * direction, epsilon) -
                           UntanglingEnergy(J - h * direction, epsilon)) /
      (2.0 * h);
    CHECK_NEAR(slope, gradient.cwiseProduct(direction).sum(),
      1e-5 * (1.0 + gradient.norm()) / epsilon, "slope");
    Eigen::Matrix<double, 9, 9> differences;
    for (int q = 0; q < 9; ++q)
    {
      Eigen::Matrix3d step = Eigen::Matrix3d::Zero();
      step(q) = h;
      const Eigen::Matrix3d change =
        (UntanglingGradient(J + step, epsilon) - UntanglingGradient(J - step, epsilon)) / (2.0 * h);
      differences.col(q) = Eigen::Map<const Eigen::Matrix<double, 9, 1>>(change.data());
    }
    const double size = 1.0 + differences.norm();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> exact(
      0.5 * (differences + differences.transpose()));
    const Eigen::Matrix<double, 9, 9> made =
      AllOf(UntanglingSecondDerivative(J, epsilon, -std::numeric_limits<double>::infinity()));
    CHECK_NEAR(
      (made - differences).norm() / size, 0.0, 1e-5 / epsilon / epsilon, "second derivative");
    // With its eigenvalues made positive.
    const Eigen::Matrix<double, 9, 9> positive = AllOf(UntanglingSecondDerivative(J, epsilon, 0.0));
    const Eigen::Matrix<double, 9, 9> expected = exact.eigenvectors() *
      exact.eigenvalues().cwiseMax(0.0).asDiagonal() * exact.eigenvectors().transpose();
    CHECK_NEAR(
      (positive - expected).norm() / size, 0.0, 1e-5 / epsilon / epsilon, "positive eigenvalues");
    indefinite += exact.eigenvalues()[0] < -1e-3 * size;
  }
  CHECK(inverted > 50, "many should be inverted, not " << inverted);
  CHECK(indefinite > 50, "many should have a negative eigenvalue, not " << indefinite);
}

/// J without a middle axis, flat, a line, nothing: no numbers that are not finite.
void TestDegenerate()
{
  for (const Eigen::Vector3d& s : { Eigen::Vector3d(1.0, 1.0, 0.0), Eigen::Vector3d(1.0, 0.0, 0.0),
         Eigen::Vector3d(0.0, 0.0, 0.0), Eigen::Vector3d(1.0, 1.0, -1.0),
         Eigen::Vector3d(1.0, 1e-12, -1e-12) })
  {
    const UntanglingHessian H = UntanglingSecondDerivative(s.asDiagonal(), 0.1, 1e-8);
    const Eigen::Matrix<double, 9, 9> all = AllOf(H);
    CHECK(all.allFinite(), "finite at " << s.transpose());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> solver(all);
    CHECK(solver.eigenvalues()[0] > 0.0, "positive at " << s.transpose());
    CHECK_NEAR((H.U.transpose() * H.U - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-12, "axes");
  }
}
}

int main()
{
  TestDeterminant();
  TestMinimum();
  TestValue();
  TestDerivatives();
  TestDegenerate();
  return CheckResult();
}
