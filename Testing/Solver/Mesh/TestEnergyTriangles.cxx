// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Triangles of the energy that use a point twice or three times: an edge from a point to itself
// adds nothing, and all identities stay.
#include "Check.h"
#include "EdgeMatrix.h"
#include "LocalStep.h"
#include "Meshes.h"
#include "StyleEnergy.h"

#include <algorithm>

using namespace SphericalStyle;
using Eigen::Matrix3d;

namespace
{
/// Triangles that use points once, twice and three times; every point has one.
Triangles RepeatingTriangles(int n, int m, Meshes::Random& random)
{
  Triangles F(m, 3);
  for (int f = 0; f < m; ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      F(f, k) = k == 0 && f < n ? f : static_cast<int>(n * random.Unit());
    }
  }
  F.row(m - 3) << 1, 2, 2;
  F.row(m - 2) << 2, 1, 1;
  F.row(m - 1) << 3, 3, 3;
  return F;
}

/// Half cotangents of random triangles: each row is positive semidefinite.
HalfEdgeScalars RandomCotangents(Eigen::Index m, Meshes::Random& random)
{
  HalfEdgeScalars c(m, 3);
  for (Eigen::Index f = 0; f < m; ++f)
  {
    const TriangleMesh one =
      Meshes::Make({ random.InCube(), random.InCube(), random.InCube() }, { { 0, 1, 2 } });
    c.row(f) = HalfEdgeCotangents(one.P, one.F);
  }
  return c;
}

Points RandomPoints(int n, Meshes::Random& random)
{
  Points x(n, 3);
  for (int i = 0; i < n; ++i)
  {
    x.row(i) = random.InCube().transpose();
  }
  return x;
}

void TestTopology()
{
  Triangles F(4, 3);
  F << 0, 1, 2, 1, 3, 3, 3, 1, 1, 4, 4, 4;
  CHECK_THROWS(std::invalid_argument, MeshTopology(F, 5), "triangle 1 uses a point twice");
  const MeshTopology topology(F, 5, RepeatedPoints::Allowed);
  CHECK(topology.GetCorners().size() == 12, "every corner should be at its point");
  for (int i = 0; i < 5; ++i)
  {
    int before = -1;
    for (int at = topology.GetCornerOffset()[i]; at < topology.GetCornerOffset()[i + 1]; ++at)
    {
      const int corner = topology.GetCorners()[at];
      CHECK(F(corner / 3, corner % 3) == i, "corner " << corner << " should be at point " << i);
      CHECK(corner > before, "corners should ascend");
      before = corner;
    }
  }
  CHECK(topology.GetNumberOfComponents() == 2, "a flat triangle should join its points");
  F(0, 0) = 5;
  CHECK_THROWS(std::invalid_argument, MeshTopology(F, 5, RepeatedPoints::Allowed), "outside");
}

/// x^T A y against the sum over half-edges, with some points fixed (x = 0 there).
void TestMatrix()
{
  Meshes::Random random(11);
  const int n = 12, m = 40;
  const Triangles F = RepeatingTriangles(n, m, random);
  const MeshTopology topology(F, n, RepeatedPoints::Allowed);
  const HalfEdgeScalars k = RandomCotangents(m, random);
  for (const int numberFixed : { 0, 3 })
  {
    std::vector<char> fixed(n, 0);
    std::fill(fixed.begin(), fixed.begin() + numberFixed, 1);
    EdgeMatrix matrix(topology, fixed);
    const Eigen::VectorXd d = Eigen::VectorXd::LinSpaced(n, 0.5, 2.0);
    const Eigen::MatrixXd lower = matrix.Assemble(k, d);
    const Eigen::MatrixXd A = lower.selfadjointView<Eigen::Lower>();
    for (int trial = 0; trial < 5; ++trial)
    {
      Eigen::VectorXd x = RandomPoints(n, random).col(0);
      x.head(numberFixed).setZero();
      const Eigen::VectorXd free = x.tail(n - numberFixed);
      double sum = x.dot(d.asDiagonal() * x), size = sum;
      for (int h = 0; h < 3 * m; ++h)
      {
        const double step = x[F(h / 3, HalfEdgeStart(h % 3))] - x[F(h / 3, HalfEdgeEnd(h % 3))];
        sum += k(h / 3, h % 3) * step * step;
        size += std::abs(k(h / 3, h % 3)) * step * step;
      }
      CHECK_NEAR(free.dot(A * free), sum, 1e-13 * size, "x^T A x, " << numberFixed << " fixed");
    }
  }
}

/// [local] and [global] from what they minimize, E evaluated edge by edge.
void TestSteps()
{
  Meshes::Random random(12);
  const int n = 12, m = 40;
  const Triangles F = RepeatingTriangles(n, m, random);
  const MeshTopology topology(F, n, RepeatedPoints::Allowed);
  const Points P = RandomPoints(n, random);
  const auto edges = [&] { return HalfEdgeDifferences(RandomPoints(n, random), F); };
  const EdgeWeights weights = ComputeEdgeWeights(RandomCotangents(m, random), F,
    Eigen::VectorXd::Constant(n, 0.7), EdgeWeighting::HalfEdge, SphericalWeighting::Uniform);
  StyleEnergy energy(topology, weights, HalfEdgeDifferences(P, F), edges(), 1);
  const CellPattern pattern(topology);
  energy.PrepareSteps(pattern);
  const Points Q = RandomPoints(n, random);
  Matrices R(n), S;
  for (Matrix3d& rotation : R)
  {
    rotation = random.Rotation();
  }
  const double size = energy.GetScale();
  CHECK_NEAR(energy.CellEnergies(Q, R).sum(), energy.Evaluate(Q, R).Total(), 1e-13 * size,
    "the cells' energies, added up,");

  // In R the energy is -2 tr(R_y S_y) and a constant.
  energy.Covariances(Q, S);
  Matrices other = R;
  double expected = 0.0;
  for (int y = 0; y < n; ++y)
  {
    other[y] = random.Rotation();
    expected += 2.0 * ((R[y] - other[y]) * S[y]).trace();
  }
  CHECK_NEAR(energy.Evaluate(Q, other).Total() - energy.Evaluate(Q, R).Total(), expected,
    1e-13 * size, "the change of E with R");
  other = R;
  FitRotations(S, other, 1);
  CHECK(energy.Evaluate(Q, other).Total() < energy.Evaluate(Q, R).Total(),
    "the local step should lower E");

  // In Q it is tr(Q^T L Q) - 2 tr(Q^T b) and a constant, L = sum_h 3 (c + l) (x_u - x_v)^2.
  Points b;
  energy.RightHandSide(R, b);
  EdgeMatrix matrix(topology, std::vector<char>(n, 0));
  const Eigen::MatrixXd lower = matrix.Assemble(3.0 * (weights.c + weights.l));
  const Eigen::MatrixXd L = lower.selfadjointView<Eigen::Lower>();
  const auto value = [&](const Points& x) { return (x.transpose() * (L * x - 2.0 * b)).trace(); };
  const Points moved = RandomPoints(n, random);
  CHECK_NEAR(energy.Evaluate(moved, R).Total() - energy.Evaluate(Q, R).Total(),
    value(moved) - value(Q), 1e-12 * size, "the change of E with Q");
}
}

int main()
{
  TestTopology();
  TestMatrix();
  TestSteps();
  return CheckResult();
}
