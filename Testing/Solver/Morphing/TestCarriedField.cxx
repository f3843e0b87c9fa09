// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The field near a surface: what it is exactly, against the sum over all points, and its steps.
#include "CarriedField.h"
#include "Check.h"
#include "DeformationMeasures.h"
#include "Meshes.h"
#include "SurfaceMeasures.h"

#include <algorithm>

using namespace SphericalStyle;

namespace
{
Points RandomPoints(int n)
{
  Meshes::Random random(17);
  Points x(n, 3);
  for (int i = 0; i < n; ++i)
  {
    x.row(i) = 1.5 * random.InCube().transpose();
  }
  return x;
}

/// A ball that becomes a bent egg.
Points Egg(const Points& P)
{
  Points Q = P;
  Q.col(2) *= 1.5;
  Q.col(0) += 0.3 * P.col(2).cwiseAbs2();
  return Q;
}

void TestExact()
{
  const TriangleMesh ball = Meshes::Icosphere(3);
  const Points x = RandomPoints(200);
  CHECK(CarriedField(ball, ball.P, 1).At(x, 1).isZero(0.0), "nothing moves");
  const Eigen::Matrix3d R =
    Eigen::AngleAxisd(2.5, Eigen::Vector3d(1.0, 1.0, 0.3).normalized()).toRotationMatrix();
  const Eigen::RowVector3d t(5.0, 1.0, 2.0);
  const auto move = [&](const Points& p) { return Points((p * R.transpose()).rowwise() + t); };
  const Points u = CarriedField(ball, move(ball.P), 1).At(x, 1);
  CHECK_NEAR((x + u - move(x)).cwiseAbs().maxCoeff(), 0.0, 1e-12, "rigid motion");
  const Points Q = Egg(ball.P);
  const CarriedField field(ball, Q, 1);
  CHECK_NEAR((field.At(ball.P, 1) - (Q - ball.P)).cwiseAbs().maxCoeff(), 0.0, 1e-9,
    "points of the surface go where it goes");
  CHECK(field.At(x, 1) == field.At(x, 2), "the same bits on two threads");
}

void TestAgainstSum()
{
  const TriangleMesh ball = Meshes::Icosphere(4);
  const Points Q = Egg(ball.P);
  const Points x = RandomPoints(300);
  const Points u = CarriedField(ball, Q, 1).At(x, 1);
  const Eigen::VectorXd areas = PointAreas(ball.P, ball.F);
  const Matrices R = SurfaceRotations(ball, Q, 1);
  double largest = 0.0;
  for (Eigen::Index i = 0; i < x.rows(); ++i)
  {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    double weights = 0.0;
    for (Eigen::Index k = 0; k < ball.P.rows(); ++k)
    {
      const Eigen::RowVector3d from = x.row(i) - ball.P.row(k);
      const double w = areas[k] / (from.squaredNorm() * from.squaredNorm());
      sum += w * (Q.row(k) + from * R[k].transpose());
      weights += w;
    }
    largest = std::max(largest, (x.row(i) + u.row(i) - sum / weights).norm());
  }
  const double moved = (Q - ball.P).rowwise().norm().maxCoeff();
  std::cout << "groups differ from the sum by " << largest / moved << " of the motion\n";
  CHECK_NEAR(largest / moved, 0.0, 0.02, "difference from the sum");
}

// Along a line that comes close: the change over a small step falls with the step, everywhere.
void TestNoSteps()
{
  const TriangleMesh ball = Meshes::Icosphere(4);
  const CarriedField field(ball, Egg(ball.P), 1);
  const int n = 20000;
  Points x(n, 3);
  for (int i = 0; i < n; ++i)
  {
    x.row(i) << -3.0 + 6.0 * i / n, 0.3, 1.1;
  }
  const Points u = field.At(x, 2);
  const double change = (u.bottomRows(n - 1) - u.topRows(n - 1)).rowwise().norm().maxCoeff();
  std::cout << "largest slope " << change * n / 6.0 << "\n";
  CHECK_NEAR(change * n / 6.0, 0.0, 5.0, "slope of the field");
}

void TestErrors()
{
  TriangleMesh flat = Meshes::Icosphere(1);
  flat.F.resize(0, 3);
  CHECK_THROWS(std::invalid_argument, CarriedField(flat, flat.P, 1), "no triangle");
}
}

int main()
{
  TestExact();
  TestAgainstSum();
  TestNoSteps();
  TestErrors();
  return CheckResult();
}
