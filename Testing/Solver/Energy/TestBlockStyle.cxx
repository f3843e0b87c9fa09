// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// BlockStyle: the axes of a part, the targets, and what results must not depend on.
#include "BlockStyle.h"
#include "LocalTermTesting.h"
#include "MeshTopology.h"

using namespace LocalTermTesting;
using Meshes::Random;

namespace
{
Term Make(double lambda)
{
  return std::make_shared<BlockStyle>(lambda);
}

std::vector<Matrix3d> AxesOf(const TriangleMesh& mesh)
{
  const MeshTopology topology(mesh.F, static_cast<int>(mesh.P.rows()));
  return BlockAxes(mesh.P, mesh.F, topology.GetComponents(), topology.GetNumberOfComponents());
}

/// Sum over triangles of a sum over axes of (u . n)^4, over the area: triangle by triangle.
double Along(const TriangleMesh& mesh, const Matrix3d& axes)
{
  double sum = 0.0;
  double areas = 0.0;
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    const Vector3d a = mesh.P.row(mesh.F(f, 0));
    const Vector3d b = mesh.P.row(mesh.F(f, 1));
    const Vector3d c = mesh.P.row(mesh.F(f, 2));
    const Vector3d cross = (b - a).cross(c - a);
    sum += cross.norm() * (axes * cross.normalized()).array().pow(4).sum();
    areas += cross.norm();
  }
  return sum / areas;
}

/// Largest sine of an angle between an axis and the nearest of the other ones.
double Apart(const Matrix3d& one, const Matrix3d& other)
{
  const Matrix3d cosines = (one * other.transpose()).cwiseAbs();
  return std::sqrt(std::max(0.0, 1.0 - std::pow(cosines.rowwise().maxCoeff().minCoeff(), 2)));
}

// Boxes, whatever their sides, turned: the axes are known.
void TestBoxes()
{
  Random random(7);
  for (const Vector3d& half : { Vector3d(1, 1, 1), Vector3d(1, 1, 3), Vector3d(0.2, 1, 3) })
  {
    for (int k = 0; k < 5; ++k)
    {
      const Matrix3d turn = random.Rotation();
      const TriangleMesh box = Meshes::Turned(Meshes::Box(3, { half[0], half[1], half[2] }), turn);
      const Matrix3d axes = AxesOf(box).front();
      CHECK(Apart(axes, turn.transpose()) <= 1e-7,
        "the axes of a box are off by " << Apart(axes, turn.transpose()));
      CHECK_NEAR(Along(box, axes), 1.0, 1e-14, "all normals of a box lie along its axes");
    }
  }
}

// No rotation is better than the axes found, by trying many and refining the best.
void TestMost()
{
  Random random(3);
  std::vector<Matrix3d> samples;
  for (int k = 0; k < 500; ++k)
  {
    samples.push_back(random.Rotation());
  }
  for (const TriangleMesh& mesh : { Meshes::Perturbed(Meshes::Ellipsoid(3), 0.02, 5),
         Meshes::Turned(Meshes::RoundedBox(6, 0.5), random.Rotation()), Meshes::House(),
         Meshes::Tetrahedron(), Meshes::Patch(6, 0.4) })
  {
    const Matrix3d axes = AxesOf(mesh).front();
    CHECK_NEAR((axes * axes.transpose() - Matrix3d::Identity()).norm(), 0.0, 1e-14, "right angles");
    const double most = -LeastOver(samples, [&](const Matrix3d& R) { return -Along(mesh, R); });
    CHECK(Along(mesh, axes) >= most - 1e-8,
      "the axes reach " << Along(mesh, axes) << ", a search " << most);
  }
  const TriangleMesh ball = Meshes::Icosphere(4);
  CHECK_NEAR(Along(ball, AxesOf(ball).front()), 0.6, 1e-3, "the value of a ball");
}

// Each part has its own.
void TestParts()
{
  Random random(5);
  const Matrix3d first = random.Rotation();
  const Matrix3d second = random.Rotation();
  const TriangleMesh both = Meshes::Together({ Meshes::Turned(Meshes::Box(3), first),
    Meshes::Moved(Meshes::Turned(Meshes::Box(4), second), { 5, 0, 0 }) });
  const std::vector<Matrix3d> axes = AxesOf(both);
  CHECK(axes.size() == 2, "two parts");
  CHECK(Apart(axes[0], first.transpose()) <= 1e-7, "axes of the first box");
  CHECK(Apart(axes[1], second.transpose()) <= 1e-7, "axes of the second box");
}

// Targets are the closest half axes, one for each point that has a normal. A box keeps its shape.
void TestTargets()
{
  const TriangleMesh mesh = Meshes::Perturbed(Meshes::Ellipsoid(3), 0.01, 4);
  const Matrix3d axes = AxesOf(mesh).front();
  BlockStyle style(1.0);
  style.SetMesh(mesh.P, mesh.F);
  const Points normals = PointNormals(mesh.P, mesh.F);
  for (Eigen::Index i = 0; i < mesh.P.rows(); ++i)
  {
    const Vector3d target = style.GetTargets().row(i);
    CHECK_NEAR(target.norm(), 1.0, 1e-14, "length of a target");
    CHECK_NEAR(normals.row(i).dot(target.transpose()),
      (axes * normals.row(i).transpose()).cwiseAbs().maxCoeff(), 1e-14, "cosine to the target");
  }
}

// A turned model gives the turned result.
void TestTurned()
{
  Random random(9);
  const TriangleMesh mesh = Meshes::Perturbed(Meshes::RoundedBox(8, 0.6), 0.01, 4);
  StyleSolver solver;
  solver.SetMesh(mesh);
  solver.Solve(Fixed(OptionsOf(Make(2.0)), 6));
  for (int k = 0; k < 5; ++k)
  {
    const Matrix3d turn = random.Rotation();
    StyleSolver other;
    other.SetMesh(Meshes::Turned(mesh, turn));
    other.Solve(Fixed(OptionsOf(Make(2.0)), 6));
    const Points expected = solver.GetPositions() * turn.transpose();
    CHECK(Meshes::Distance(other.GetPositions(), expected) <= 1e-7,
      "turned: the result differs by " << Meshes::Distance(other.GetPositions(), expected));
  }
}

// The normals gather at the axes: that is the style.
void TestBlocks()
{
  const TriangleMesh mesh =
    Meshes::Turned(Meshes::Perturbed(Meshes::RoundedBox(12, 0.6), 0.002, 3), Random(11).Rotation());
  const Matrix3d axes = AxesOf(mesh).front();
  Points halfAxes(6, 3);
  halfAxes << axes, -axes;
  double share = ShareNear(mesh.P, mesh.F, halfAxes, 10.0);
  const double before = share;
  StyleSolver solver;
  solver.SetMesh(mesh);
  for (const double lambda : { 0.3, 1.0, 10.0 })
  {
    solver.Solve(OptionsOf(Make(lambda)));
    const double next = ShareNear(solver.GetPositions(), mesh.F, halfAxes, 10.0);
    CHECK(next > share, "weight " << lambda << ": more than " << share << ", not " << next);
    share = next;
  }
  CHECK(share >= before + 0.3, "with weight 10 it should be a block: " << before << ", " << share);
}
} // namespace

int main()
{
  TestBoxes();
  TestMost();
  TestParts();
  TestTargets();
  TestTurned();
  TestBlocks();
  CheckInvariance(Make);
  return CheckResult();
}
