// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Inner points carried by the boundary: what stays, what is exact, that the energy is smallest, and
// cells that the harmonic extension inverts and the energy does not.
#include "Check.h"
#include "UntanglingEnergy.h"
#include "VolumeMorphing.h"
#include "Volumes.h"

#include <Eigen/LU>

using namespace Volumes;

namespace
{
using Motion = Points (*)(const Points&);

/// Deeper than the points below the top.
Points Dent(const Points& P)
{
  Points u = Points::Zero(P.rows(), 3);
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    const double r = (P.row(i).head<2>() - Eigen::RowVector2d(0.5, 0.5)).squaredNorm();
    u(i, 2) = P(i, 2) > 0.99 ? -0.6 * std::exp(-12.0 * r) : 0.0;
  }
  return u;
}

Points Bend(const Points& P)
{
  Points u(P.rows(), 3);
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    const double angle = 1.2 * (P(i, 2) - 0.5);
    const double r = 1.0 + P(i, 0);
    u.row(i) << r * std::cos(angle) - 1.0 - P(i, 0), 0.0, r * std::sin(angle) - P(i, 2);
  }
  return u;
}

/// Unevenly, so that no cell has a neighbor of its shape. The boundary stays.
VolumeMesh MakeUneven(int n, CellShape shape)
{
  VolumeMesh mesh = MakeCube(n, shape);
  const std::vector<char> boundary = BoundaryPoints(mesh);
  Meshes::Random random(3);
  for (Eigen::Index i = 0; i < mesh.P.rows(); ++i)
  {
    const Eigen::Vector3d shift = random.InCube();
    if (!boundary[i])
    {
      mesh.P.row(i) += 0.15 / n * shift.transpose();
    }
  }
  return mesh;
}

void TestIdentityAndRigid()
{
  const Eigen::Matrix3d R =
    Eigen::AngleAxisd(2.0, Eigen::Vector3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
  const Eigen::RowVector3d t(3.0, -2.0, 1.0);
  for (const CellShape shape : AllShapes)
  {
    const VolumeMesh mesh = MakeUneven(4, shape);
    const std::vector<char> fixed = BoundaryPoints(mesh);
    const Points none = Points::Zero(mesh.P.rows(), 3);
    CHECK(
      MorphVolume(mesh, fixed, none, 1).P == mesh.P, "nothing moves where nothing is displaced");
    const Points rigid = (mesh.P * R.transpose()).rowwise() + t;
    const MorphedVolume result = MorphVolume(mesh, fixed, rigid - mesh.P, 1);
    CHECK_NEAR((result.P - rigid).cwiseAbs().maxCoeff(), 0.0, 1e-11,
      "rigid motion, shape " << static_cast<int>(shape));
    if (shape == CellShape::Tetrahedron) // the corners of others overlap
    {
      const Points linear = mesh.P * Meshes::Random(5).Matrix();
      const Points harmonic = HarmonicExtension(mesh, fixed, linear - mesh.P, 1);
      CHECK_NEAR(
        (harmonic - linear).cwiseAbs().maxCoeff(), 0.0, 1e-5, "linear motions are harmonic");
    }
  }
}

/// By other means than the solver: each corner tetrahedron from its points before and after.
double EnergyOf(const VolumeMesh& mesh, const Points& Q)
{
  double sum = 0.0;
  for (int cell = 0; cell < mesh.GetNumberOfCells(); ++cell)
  {
    const int* ids = mesh.PointsOf(cell);
    const std::vector<CellCorner>& corners = CornersOf(mesh.Shapes[cell]);
    const double share = mesh.Shapes[cell] == CellShape::Tetrahedron ? 0.25 : 1.0; // all are one
    for (const CellCorner& c : corners)
    {
      Eigen::Matrix3d before;
      Eigen::Matrix3d after;
      for (int k = 0; k < 3; ++k)
      {
        before.row(k) = mesh.P.row(ids[c[k + 1]]) - mesh.P.row(ids[c[0]]);
        after.row(k) = Q.row(ids[c[k + 1]]) - Q.row(ids[c[0]]);
      }
      const Eigen::Matrix3d J = (before.inverse() * after).transpose();
      sum += share * before.determinant() / 6.0 * UntanglingEnergy(J, 1e-9);
    }
  }
  return sum;
}

void TestMinimum()
{
  Meshes::Random random(11);
  for (const CellShape shape : AllShapes)
  {
    const VolumeMesh mesh = MakeUneven(4, shape);
    const std::vector<char> fixed = BoundaryPoints(mesh);
    const Points Q = MorphVolume(mesh, fixed, Bend(mesh.P), 1).P;
    CHECK(ScaledJacobians(mesh, Q, 1).minCoeff() > 0.0, "a bent cube has no inverted cell");
    const double energy = EnergyOf(mesh, Q);
    for (int k = 0; k < 50; ++k)
    {
      Points near = Q;
      for (Eigen::Index i = 0; i < Q.rows(); ++i)
      {
        const Eigen::Vector3d shift = random.InCube();
        near.row(i) += (fixed[i] ? 0.0 : 1e-3) * shift.transpose();
      }
      CHECK(EnergyOf(mesh, near) > energy, "no points nearby should have less energy");
    }
  }
}

void TestRepairsWhatHarmonicInverts()
{
  for (const CellShape shape : AllShapes)
  {
    const VolumeMesh mesh = MakeCube(6, shape);
    const std::vector<char> fixed = BoundaryPoints(mesh);
    const Points u = Dent(mesh.P);
    const double harmonic =
      ScaledJacobians(mesh, HarmonicExtension(mesh, fixed, u, 1), 1).minCoeff();
    const MorphedVolume result = MorphVolume(mesh, fixed, u, 1);
    const double ours = ScaledJacobians(mesh, result.P, 1).minCoeff();
    std::cout << "shape " << static_cast<int>(shape) << ": harmonic " << harmonic << ", ours "
              << ours << " in " << result.iterations << " steps\n";
    CHECK(harmonic < 0.0, "the harmonic extension should invert a cell; it has " << harmonic);
    CHECK(ours > 0.0, "no cell should be inverted; the smallest is " << ours);
    for (Eigen::Index i = 0; i < mesh.P.rows(); ++i)
    {
      CHECK(!fixed[i] || result.P.row(i) == mesh.P.row(i) + u.row(i), "the boundary is given");
    }
    const Eigen::Matrix3d R = Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitX()).toRotationMatrix();
    VolumeMesh turned = mesh;
    turned.P = 1e4 * mesh.P * R.transpose();
    const Points other = MorphVolume(turned, fixed, 1e4 * u * R.transpose(), 1).P;
    CHECK_NEAR((other / 1e4 - result.P * R.transpose()).cwiseAbs().maxCoeff(), 0.0, 1e-6,
      "the same, turned and scaled");
    CHECK(MorphVolume(mesh, fixed, u, 2).P == result.P, "the same bits on two threads");
  }
}

void TestInvertedAtRest()
{
  VolumeMesh mesh = MakeCube(4, CellShape::Tetrahedron);
  const std::vector<char> fixed = BoundaryPoints(mesh);
  const auto inner = std::find(fixed.begin(), fixed.end(), 0) - fixed.begin();
  mesh.P.row(inner) += Eigen::RowVector3d(0.4, 0.0, 0.0);
  CHECK(ScaledJacobians(mesh, mesh.P, 1).minCoeff() < 0.0, "a cell is inverted at rest");
  const Points Q = MorphVolume(mesh, fixed, Bend(mesh.P), 1).P;
  CHECK(ScaledJacobians(mesh, Q, 1).minCoeff() > 0.0, "and none after");
}

void TestInvertedByBoundary()
{
  const VolumeMesh mesh = MakeCube(3, CellShape::Hexahedron);
  const std::vector<char> fixed = BoundaryPoints(mesh);
  Points Q = mesh.P;
  Q.row(0) = Eigen::RowVector3d(0.5, 0.5, 0.5); // a corner of the cube beyond its neighbors
  const std::vector<char> flags = InvertedByBoundary(mesh, fixed, Q);
  CHECK(flags[0] == 1, "the cell at the corner");
  CHECK(std::count(flags.begin(), flags.end(), 1) == 1, "and no other");
  Points u = Q - mesh.P;
  const Points best = MorphVolume(mesh, fixed, u, 1).P;
  CHECK(best.allFinite() && ScaledJacobian(mesh, 0, best) < 0.0, "nothing repairs it");
}

void TestAbort()
{
  const VolumeMesh mesh = MakeCube(4, CellShape::Hexahedron);
  const std::vector<char> fixed = BoundaryPoints(mesh);
  int steps = 0;
  bool aborted = false;
  try
  {
    MorphVolume(mesh, fixed, Dent(mesh.P), 1, [&](int, double) { return ++steps < 2; });
  }
  catch (const SolveAborted&)
  {
    aborted = true;
  }
  CHECK(aborted && steps == 2, "it should end at once");
}
}

int main()
{
  TestIdentityAndRigid();
  TestMinimum();
  TestRepairsWhatHarmonicInverts();
  TestInvertedAtRest();
  TestInvertedByBoundary();
  TestAbort();
  return CheckResult();
}
