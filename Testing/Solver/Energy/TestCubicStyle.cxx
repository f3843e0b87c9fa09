// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The cubic term: its local step, descent, what results must not depend on, and that cubes come
// out.
#include "CubicStyle.h"
#include "LocalTermTesting.h"

#include <limits>

using namespace LocalTermTesting;

namespace
{
Term Make(double lambda)
{
  return std::make_shared<CubicStyle>(lambda);
}

TermOf ValueOf(double lambda)
{
  return [lambda](const Vector3d& n, double area, const Matrix3d& R)
  {
    const Vector3d x = R * n;
    return lambda * area * (std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]));
  };
}

/// sum of area times |n|_1 over the triangles: what a cubic surface has little of.
double NormEnergy(const Points& P, const Triangles& F)
{
  double sum = 0.0;
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    const Vector3d a = P.row(F(f, 0));
    sum += 0.5 * (P.row(F(f, 1)).transpose() - a).cross(P.row(F(f, 2)).transpose() - a).lpNorm<1>();
  }
  return sum;
}

// The more cubeness, the more of the surface looks along an axis.
void TestCubes()
{
  const TriangleMesh mesh = Meshes::Perturbed(Meshes::Ellipsoid(4), 0.002, 3);
  const Points axes = HalfAxes();
  double share = ShareNear(mesh.P, mesh.F, axes, 10.0);
  double perArea = NormEnergy(mesh.P, mesh.F) / TriangleAreas(mesh.P, mesh.F).sum();
  std::cout << "ellipsoid: " << share << " of the area looks along an axis, mean |n|_1 " << perArea
            << std::endl;
  CHECK(share < 0.2, "an ellipsoid looks everywhere, along an axis " << share);
  StyleSolver solver;
  solver.SetMesh(mesh);
  for (const double lambda : { 0.2, 1.0, 5.0 })
  {
    solver.Solve(OptionsOf(Make(lambda)));
    const Points& Q = solver.GetPositions();
    const double next = ShareNear(Q, mesh.F, axes, 10.0);
    const double norm = NormEnergy(Q, mesh.F) / TriangleAreas(Q, mesh.F).sum();
    std::cout << "cubeness " << lambda << ": " << next << ", mean |n|_1 " << norm << std::endl;
    CHECK(next > share, "cubeness " << lambda << ": more should look along an axis than " << share);
    CHECK(norm < perArea, "cubeness " << lambda << ": the mean |n|_1 should fall from " << perArea);
    share = next;
    perArea = norm;
  }
  CHECK(share >= 0.8, "cubeness 5: most of the area should look along an axis, not " << share);
}

// A cube along the axes is at rest, whatever the weight.
void TestCubeStays()
{
  TriangleMesh cube = Meshes::Box(6);
  // Normals of corners and edges do not look along an axis: cut them off by points of their own.
  TriangleMesh sheets;
  sheets.F.resize(cube.F.rows(), 3);
  sheets.P.resize(3 * cube.F.rows(), 3);
  for (Eigen::Index f = 0; f < cube.F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      sheets.F(f, k) = static_cast<int>(3 * f) + k;
      sheets.P.row(3 * f + k) = cube.P.row(cube.F(f, k));
    }
  }
  StyleSolver solver;
  solver.SetMesh(sheets);
  solver.Solve(OptionsOf(Make(3.0)));
  CHECK(Meshes::Distance(solver.GetPositions(), sheets.P) <= 1e-7,
    "triangles along the axes should stay, move by "
      << Meshes::Distance(solver.GetPositions(), sheets.P));
}

void TestRefusals()
{
  for (const double bad :
    { -0.1, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    CHECK_THROWS(std::invalid_argument, CubicStyle{ bad }, "cubeness");
  }
}
} // namespace

int main()
{
  CheckLocalSteps(Make, ValueOf);
  CheckDescent(Make, ValueOf);
  CheckInvariance(Make);
  TestCubes();
  TestCubeStays();
  TestRefusals();
  return CheckResult();
}
