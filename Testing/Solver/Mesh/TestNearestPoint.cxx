// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// The nearest point of a surface: of one triangle in each of its regions, and of boxes, where it
/// is known in closed form.
#include "Check.h"
#include "Dense.h"
#include "Meshes.h"
#include "NearestPoint.h"

#include <random>

using namespace SphericalStyle;
using Eigen::Vector3d;

namespace
{
Vector3d Nearest(const TriangleMesh& mesh, const TriangleTree& tree, const Vector3d& place)
{
  NearestPoint nearest(mesh.P, mesh.F, place);
  nearest.Search(tree);
  CHECK_NEAR(nearest.GetSquaredDistance(), (place - nearest.GetPoint()).squaredNorm(), 1e-300,
    "squared distance");
  // The point lies in the triangle: it is a mean of its corners.
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k)
  {
    corners.col(k) = mesh.P.row(mesh.F(nearest.GetTriangle(), k)).transpose();
  }
  Eigen::MatrixX3d A(4, 3);
  A << corners, Eigen::RowVector3d::Ones();
  const Eigen::VectorXd b = nearest.GetPoint().homogeneous();
  const Vector3d shares = Dense::Solve(A, b);
  CHECK((A * shares - b).norm() < 1e-12 && shares.minCoeff() > -1e-12, "within the triangle");
  return nearest.GetPoint();
}

/// a at 0, b at (4, 0, 0), c at (1, 3, 0).
void TestRegions()
{
  const TriangleMesh triangle =
    Meshes::Make({ { 0, 0, 0 }, { 4, 0, 0 }, { 1, 3, 0 } }, { { 0, 1, 2 } });
  const TriangleTree tree(triangle.P, triangle.F);
  const double toBC = std::sqrt(0.5);
  const std::vector<std::array<Vector3d, 2>> cases = { { Vector3d(-1, -0.1, 2), Vector3d(0, 0, 0) },
    { Vector3d(6, 0.5, -1), Vector3d(4, 0, 0) }, { Vector3d(1, 7, 3), Vector3d(1, 3, 0) },
    { Vector3d(1.5, -2, 1), Vector3d(1.5, 0, 0) },
    { Vector3d(2.5 + toBC, 1.5 + toBC, 1), Vector3d(2.5, 1.5, 0) },
    { Vector3d(0.5 - 3, 1.5 + 1, 1), Vector3d(0.5, 1.5, 0) },
    { Vector3d(1.5, 1, -4), Vector3d(1.5, 1, 0) }, { Vector3d(1.5, 1, 0), Vector3d(1.5, 1, 0) } };
  for (const auto& [place, expected] : cases)
  {
    CHECK((Nearest(triangle, tree, place) - expected).norm() < 1e-14,
      "nearest to " << place.transpose() << ": " << Nearest(triangle, tree, place).transpose());
  }
}

/// The distance from the surface of a box, from outside and from inside.
double DistanceFromBox(const Vector3d& half, const Vector3d& place)
{
  const Vector3d beyond = place.cwiseAbs() - half;
  return beyond.maxCoeff() > 0.0 ? beyond.cwiseMax(0.0).norm() : -beyond.maxCoeff();
}

void TestBoxes()
{
  const Vector3d half(1.0, 2.0, 0.5);
  const TriangleMesh box = Meshes::Box(7, half);
  const TriangleTree tree(box.P, box.F);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-3.0, 3.0);
  for (int k = 0; k < 2000; ++k)
  {
    const double near = k % 2 == 0 ? 1.0 : 0.3; // many inside
    const Vector3d place = near * Vector3d(uniform(random), uniform(random), uniform(random));
    CHECK_NEAR((place - Nearest(box, tree, place)).norm(), DistanceFromBox(half, place), 1e-14,
      "distance from a box");
  }
}
} // namespace

int main()
{
  TestRegions();
  TestBoxes();
  return CheckResult();
}
