// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The affine map closest to how points moved [guard].
#include "AffineFit.h"
#include "Check.h"
#include "Meshes.h"

#include <Eigen/Geometry>

#include <limits>

using namespace SphericalStyle;

namespace
{
const Eigen::RowVector3d Shift(0.3, -0.2, 0.7);

Eigen::Matrix3d Rotation()
{
  return Eigen::AngleAxisd(2.0, Eigen::Vector3d(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
}

Points Image(const Points& P, const Eigen::Matrix3d& L)
{
  return (P * L.transpose()).rowwise() + Shift;
}

// How far the map is from the points' images, for each.
Eigen::VectorXd Distances(const AffineMap& map, const Points& P, const Points& Q)
{
  Eigen::VectorXd distances(P.rows());
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    distances(i) = (map(P.row(i)) - Q.row(i)).norm();
  }
  return distances;
}

// What all points follow is found, and one that does not follow and has no weight changes nothing.
void TestSimilarity()
{
  const Points P = Meshes::Ellipsoid(2).P;
  const Eigen::Matrix3d L = 1.7 * Rotation();
  Points Q = Image(P, L);
  Q.row(5) += Eigen::RowVector3d(3.0, 1.0, 2.0);
  Eigen::VectorXd a = Eigen::VectorXd::LinSpaced(P.rows(), 0.5, 2.0);
  a(5) = 0.0;
  const AffineMap map = *FitAffineMap(P, Q, a);
  CHECK((map.L - L).norm() < 1e-13, "the similarity, not with an error of " << (map.L - L).norm());
  Q.row(5) = Image(P, L).row(5);
  CHECK(Distances(map, P, Q).maxCoeff() < 1e-13, "at all points, also the one without weight");

  a(5) = 1.0;
  Q.row(5) += Eigen::RowVector3d(3.0, 1.0, 2.0);
  CHECK((FitAffineMap(P, Q, a)->L - L).norm() > 1e-3, "with weight it counts");
}

// One direction becomes longer: hardly anything is left, where the similarity alone is far away.
void TestAffine()
{
  const Points P = Meshes::Icosphere(2).P;
  const Eigen::Matrix3d L = Rotation() * Eigen::Vector3d(1.0, 1.3, 0.8).asDiagonal();
  const Points Q = Image(P, L);
  const double left =
    Distances(*FitAffineMap(P, Q, Eigen::VectorXd::Ones(P.rows())), P, Q).maxCoeff();
  CHECK(left > 0.0 && left < 0.004, "left " << left);
}

// Nothing says how a plane moves across itself: as the similarity does.
void TestFlat()
{
  Points P = Meshes::Icosphere(2).P;
  P.col(2).setZero();
  const Eigen::Matrix3d L = 1.5 * Rotation();
  const AffineMap map = *FitAffineMap(P, Image(P, L), Eigen::VectorXd::Ones(P.rows()));
  CHECK((map.L - L).norm() < 1e-13, "not with an error of " << (map.L - L).norm());
}

// How a line turns about itself is not determined.
void TestLine()
{
  Points P = Meshes::Icosphere(1).P;
  Eigen::VectorXd a = Eigen::VectorXd::Ones(P.rows());
  CHECK(FitAffineMap(P, P, a), "a ball");
  CHECK(!FitAffineMap(P, P, 0.0 * a), "no weight");
  CHECK(!FitAffineMap(P.topRows(1), P.topRows(1), a.head(1)), "one point");
  CHECK(!FitAffineMap(P.topRows(2), P.topRows(2), a.head(2)), "two points");
  CHECK(FitAffineMap(P.topRows(3), P.topRows(3), a.head(3)), "three points");
  CHECK(!FitAffineMap(P, std::numeric_limits<double>::infinity() * P, a), "infinite");
  CHECK(!FitAffineMap(P, 1.7e308 * P, 100.0 * a), "sums are infinite");
  a.tail(P.rows() - 2).setZero();
  CHECK(!FitAffineMap(P, P, a), "two points with a weight");
  P = P.col(0) * Eigen::RowVector3d(1.0, 2.0, -0.5);
  CHECK(!FitAffineMap(P, P, Eigen::VectorXd::Ones(P.rows())), "many on a line");
}
}

int main()
{
  TestSimilarity();
  TestAffine();
  TestFlat();
  TestLine();
  return CheckResult();
}
