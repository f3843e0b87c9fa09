// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The term of the normals: its local step, descent, what results must not depend on, clusters in
// the Gauss map, and that a sphere as style does nothing (A2.6).
#include "LocalTermTesting.h"
#include "NormalAnalogy.h"

#include <limits>

using namespace LocalTermTesting;

namespace
{
/// The style normal of the largest cosine, by trying all.
Vector3d ClosestTo(const Vector3d& n, const Points& style)
{
  Eigen::Index closest = 0;
  (style * n).maxCoeff(&closest);
  return style.row(closest).transpose();
}

std::shared_ptr<NormalAnalogy> Analogy(const Points& style, double lambda)
{
  return std::make_shared<NormalAnalogy>(
    [style](const Points& normals)
    {
      Points targets(normals.rows(), 3);
      for (Eigen::Index i = 0; i < normals.rows(); ++i)
      {
        targets.row(i) = ClosestTo(normals.row(i).transpose(), style).transpose();
      }
      return targets;
    },
    lambda);
}

Points TetrahedronNormals()
{
  const TriangleMesh solid = Meshes::Tetrahedron();
  return DistinctNormals(solid.P, solid.F);
}

Term Make(double lambda)
{
  return Analogy(TetrahedronNormals(), lambda);
}

TermOf ValueOf(double lambda)
{
  const Points style = TetrahedronNormals();
  return [style, lambda](const Vector3d& n, double area, const Matrix3d& R)
  {
    const double misfit = n.isZero(0.0) ? 0.0 : (R * n - ClosestTo(n, style)).squaredNorm();
    return lambda * area * misfit;
  };
}

void TestDistinctNormals()
{
  CHECK(TetrahedronNormals().rows() == 4, "a tetrahedron has 4 normals");
  const TriangleMesh box = Meshes::Scaled(Meshes::Box(7), { 1e-3, 0.3, 20.0 });
  const Points n = DistinctNormals(box.P, box.F);
  CHECK(n.rows() == 6, "a box has 6 normals, not " << n.rows());
  for (Eigen::Index i = 0; i < n.rows(); ++i)
  {
    CHECK_NEAR(n.row(i).cwiseAbs().maxCoeff(), 1.0, 1e-15, "a normal of a box along an axis");
  }
  Eigen::Index first = 0;
  CHECK((n * Vector3d(-1, 0, 0)).maxCoeff(&first) == 1.0 && first == 0,
    "they should come in the order of the triangles");
  const TriangleMesh ball = Meshes::Icosphere(3);
  CHECK(DistinctNormals(ball.P, ball.F).rows() == ball.F.rows(), "those of a sphere all differ");
  TriangleMesh flat = Meshes::ThreeAtAnEdge();
  flat.P.row(2) = 0.5 * (flat.P.row(0) + flat.P.row(1));
  CHECK(DistinctNormals(flat.P, flat.F).rows() == 2, "a triangle without an area has no normal");
}

// The normals gather at those of the style.
void TestClusters()
{
  const Points axes = HalfAxes();
  for (const auto& [name, mesh] : { std::pair<std::string, TriangleMesh>{ "ellipsoid",
                                      Meshes::Perturbed(Meshes::Ellipsoid(4), 0.002, 3) },
         { "rounded box", Meshes::Perturbed(Meshes::RoundedBox(12, 0.6), 0.002, 3) } })
  {
    const double before = ShareNear(mesh.P, mesh.F, axes, 10.0);
    double share = before;
    StyleSolver solver;
    solver.SetMesh(mesh);
    for (const double lambda : { 0.3, 1.0, 10.0 })
    {
      solver.Solve(OptionsOf(Analogy(axes, lambda)));
      const double next = ShareNear(solver.GetPositions(), mesh.F, axes, 10.0);
      CHECK(next > share,
        name << ", lambda " << lambda << ": more than " << share
             << " should look along an axis, not " << next);
      share = next;
    }
    std::cout << name << ": " << before << " of the area looks along an axis, with weight 10 "
              << share << std::endl;
    CHECK(share >= before + 0.4, name << ": with weight 10 clusters should form, share " << share);
  }
}

// A2.6: a sphere as style. All directions are allowed already, so the finer it is, the less
// happens.
void TestSphereStyle()
{
  const TriangleMesh mesh = Meshes::Perturbed(Meshes::Ellipsoid(4), 0.002, 3);
  StyleSolver solver;
  solver.SetMesh(mesh);
  std::vector<double> moved;
  for (int level = 0; level <= 5; ++level)
  {
    const TriangleMesh style = Meshes::Icosphere(level);
    solver.Solve(OptionsOf(Analogy(DistinctNormals(style.P, style.F), 10.0)));
    moved.push_back(Meshes::Distance(solver.GetPositions(), mesh.P) / Meshes::Diagonal(mesh.P));
    std::cout << "style of " << style.F.rows() << " normals: largest displacement " << moved.back()
              << " diagonals" << std::endl;
    CHECK(level == 0 || moved[level] < moved[level - 1],
      "level " << level << ": the displacement should fall, " << moved[level]);
  }
  CHECK(moved[0] >= 0.02, "20 normals should do something: " << moved[0]);
  CHECK(moved[5] <= 0.1 * moved[0], "20480 normals should do next to nothing: " << moved[5]);
}

// Model and style turned together: the result turned.
void TestTurned()
{
  Meshes::Random random(5);
  const TriangleMesh mesh = Meshes::Perturbed(Meshes::Ellipsoid(2), 0.05, 4);
  const Points style = TetrahedronNormals();
  StyleSolver solver;
  solver.SetMesh(mesh);
  solver.Solve(Fixed(OptionsOf(Analogy(style, 2.0)), 6));
  for (int k = 0; k < 5; ++k)
  {
    const Matrix3d turn = random.Rotation();
    TriangleMesh turned = mesh;
    turned.P = mesh.P * turn.transpose();
    StyleSolver other;
    other.SetMesh(turned);
    other.Solve(Fixed(OptionsOf(Analogy(style * turn.transpose(), 2.0)), 6));
    const Points expected = solver.GetPositions() * turn.transpose();
    CHECK(Meshes::Distance(other.GetPositions(), expected) <= 1e-11,
      "model and style turned: the result differs by "
        << Meshes::Distance(other.GetPositions(), expected));
  }
}

// With its own normals as style a surface stays.
void TestOwnStyle()
{
  const TriangleMesh mesh = Meshes::Perturbed(Meshes::Ellipsoid(3), 0.01, 4);
  StyleSolver solver;
  solver.SetMesh(mesh);
  const auto own = Analogy(PointNormals(mesh.P, mesh.F), 10.0);
  const StyleReport report = solver.Solve(OptionsOf(own));
  CHECK(report.loop.converged && Meshes::Distance(solver.GetPositions(), mesh.P) <= 1e-14,
    "a surface in its own style should stay, moves by "
      << Meshes::Distance(solver.GetPositions(), mesh.P));
}

void TestRefusals()
{
  for (const double bad :
    { -0.1, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    CHECK_THROWS(std::invalid_argument, Analogy(HalfAxes(), bad), "weight");
  }
}
} // namespace

int main()
{
  CheckLocalSteps(Make, ValueOf);
  CheckDescent(Make, ValueOf);
  CheckInvariance(Make);
  TestDistinctNormals();
  TestClusters();
  TestSphereStyle();
  TestTurned();
  TestOwnStyle();
  TestRefusals();
  return CheckResult();
}
