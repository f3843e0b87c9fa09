// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// The estimated condition number against all eigenvalues of the dense matrix, which is put
/// together here edge by edge as Eq. 4.26 says: -(w + lambda) beside the diagonal.
#include "Check.h"
#include "Dense.h"
#include "EdgeWeights.h"
#include "MatrixCondition.h"
#include "Meshes.h"

#include <algorithm>

using namespace SphericalStyle;
using Eigen::Vector3d;

namespace
{
struct Exact
{
  double nonZero;
  double pinned;
};

/// Largest over smallest eigenvalue of a matrix that has `zeros` zero ones.
double Ratio(const Eigen::MatrixXd& L, int zeros)
{
  const Eigen::VectorXd values = Dense::Eigenvalues(L);
  const double largest = values(values.size() - 1);
  CHECK(zeros == 0 || std::abs(values(zeros - 1)) <= 1e-12 * largest, "no zero eigenvalue");
  return largest / values(zeros);
}

double Cotangent(const Vector3d& a, const Vector3d& b)
{
  return a.dot(b) / a.cross(b).norm();
}

Exact DenseCondition(const TriangleMesh& mesh, double lambda, const std::vector<int>& lastPoints)
{
  const auto n = mesh.P.rows();
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n, n);
  for (const auto& t : mesh.F.rowwise())
  {
    for (int k = 0; k < 3; ++k)
    {
      const int y = t[k], u = t[(k + 1) % 3], v = t[(k + 2) % 3];
      const double half =
        0.5 * Cotangent(mesh.P.row(u) - mesh.P.row(y), mesh.P.row(v) - mesh.P.row(y)) +
        0.5 * lambda;
      L(u, v) -= half;
      L(v, u) -= half;
      L(u, u) += half;
      L(v, v) += half;
    }
  }
  Eigen::MatrixXd pinned = L;
  std::vector<int> kept;
  for (int i = 0; i < n; ++i)
  {
    if (std::find(lastPoints.begin(), lastPoints.end(), i) == lastPoints.end())
    {
      kept.push_back(i);
    }
  }
  return { Ratio(L, static_cast<int>(lastPoints.size())), Ratio(pinned(kept, kept), 0) };
}

MatrixCondition Estimate(const TriangleMesh& mesh, double lambda)
{
  const MeshTopology topology(mesh.F, static_cast<int>(mesh.P.rows()));
  return EstimateCondition(
    topology, HalfEdgeCotangents(mesh.P, mesh.F).array() + 0.5 * lambda, 1e-6);
}

void TestAgainstDense()
{
  const std::vector<Meshes::Named> meshes = { { "tetrahedron", Meshes::Tetrahedron() },
    { "icosphere", Meshes::Icosphere(2) }, { "box", Meshes::Box(5) },
    { "sheet with a border", Meshes::Patch(8, 0.3) }, { "house, obtuse", Meshes::House() },
    { "two parts", Meshes::TwoComponents() }, { "three at an edge", Meshes::ThreeAtAnEdge() },
    { "slivers", Meshes::Slivers() } };
  for (const Meshes::Named& named : meshes)
  {
    const MeshTopology topology(named.mesh.F, static_cast<int>(named.mesh.P.rows()));
    for (const double lambda : { 0.0, 0.1, 0.5, 5.0 })
    {
      const Exact exact = DenseCondition(named.mesh, lambda, topology.GetLastPoints());
      const MatrixCondition estimate = Estimate(named.mesh, lambda);
      CHECK(estimate.accuracy <= 2e-6, named.name << ": known to " << estimate.accuracy);
      CHECK_NEAR(estimate.nonZero / exact.nonZero, 1.0, estimate.accuracy + 1e-9,
        named.name << ", lambda " << lambda << ": condition over the exact one");
      CHECK_NEAR(estimate.pinned / exact.pinned, 1.0, estimate.accuracy + 1e-9,
        named.name << ", lambda " << lambda << ": pinned condition over the exact one");
    }
  }
}

void TestByHand()
{
  // All edges of a regular tetrahedron weigh the same: L is a multiple of 4 I - 1 1^T, whose
  // eigenvalues are 0, 4, 4, 4, and pinned 3 I - 1 1^T + I of size 3: 1, 4, 4.
  for (const double lambda : { 0.0, 0.7 })
  {
    const MatrixCondition estimate = Estimate(Meshes::Tetrahedron(), lambda);
    CHECK_NEAR(estimate.nonZero, 1.0, 1e-12, "condition of a tetrahedron");
    CHECK_NEAR(estimate.pinned, 4.0, 1e-12, "pinned condition of a tetrahedron");
  }
}

void TestInvariance()
{
  const TriangleMesh mesh = Meshes::House();
  const MatrixCondition estimate = Estimate(mesh, 0.5);
  for (const double scale : { 1e-6, 1e6 })
  {
    TriangleMesh scaled = mesh;
    scaled.P = (scale * mesh.P).eval();
    scaled.P.rowwise() += Eigen::RowVector3d(1, 2, 3) * scale;
    CHECK_NEAR(Estimate(scaled, 0.5).nonZero / estimate.nonZero, 1.0, 1e-6, "condition, scaled");
  }
  const MatrixCondition again = Estimate(mesh, 0.5);
  CHECK(again.nonZero == estimate.nonZero && again.pinned == estimate.pinned, "not the same bits");
}

/// Icospheres flattened to half their height: the growth with the mesh (thesis 4.8.2), four times
/// the points and about four times the condition, and what the dense matrices give (A4.47, A8.19).
void TestGrowth()
{
  struct Row
  {
    double nonZero, pinned, pinnedWithoutLambda; // 0: not compared
  };
  const Row dense[] = { { 0.0, 102.0, 131.0 }, { 44.5, 519.0, 685.0 }, { 0.0, 2579.0, 3443.0 } };
  double before = 0.0;
  for (int level = 1; level <= 3; ++level)
  {
    const TriangleMesh mesh = Meshes::Scaled(Meshes::Icosphere(level), { 1.0, 1.0, 0.5 });
    const MatrixCondition with = Estimate(mesh, 0.5);
    const MatrixCondition without = Estimate(mesh, 0.0);
    std::cout << mesh.P.rows() << " points: lambda .5 " << with.nonZero << ", pinned "
              << with.pinned << "; lambda 0 " << without.nonZero << ", pinned " << without.pinned
              << std::endl;
    const Row& row = dense[level - 1];
    CHECK(row.nonZero == 0.0 || std::abs(with.nonZero - row.nonZero) <= 0.05, "without the zeros");
    CHECK_NEAR(with.pinned, row.pinned, 1.0, "pinned, lambda .5");
    CHECK_NEAR(without.pinned, row.pinnedWithoutLambda, 1.0, "pinned, lambda 0");
    CHECK(level == 1 || (with.nonZero > 3.0 * before && with.nonZero < 5.0 * before),
      "condition " << with.nonZero << " after " << before);
    before = with.nonZero;
  }
}
}

int main()
{
  TestAgainstDense();
  TestByHand();
  TestInvariance();
  TestGrowth();
  return CheckResult();
}
