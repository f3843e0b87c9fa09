// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "DeformationMeasures.h"

#include "EdgeWeights.h"
#include "LocalStep.h"
#include "MeshQuality.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace SphericalStyle
{
namespace
{
Points CotangentLaplacianVectors(const Points& P, const Triangles& F, const HalfEdgeScalars& c)
{
  Points result = Points::Zero(P.rows(), 3);
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int u = F(f, HalfEdgeStart(k));
      const int v = F(f, HalfEdgeEnd(k));
      const Eigen::RowVector3d flow = c(f, k) * (P.row(u) - P.row(v));
      result.row(u) += flow;
      result.row(v) -= flow;
    }
  }
  return result;
}
}

Matrices SurfaceRotations(
  const TriangleMesh& rest, const Points& deformed, int threads, const SurfacePart& part)
{
  const HalfEdgeScalars c = HalfEdgeCotangents(rest.P, rest.F);
  Matrices S(rest.P.rows(), Eigen::Matrix3d::Zero());
  for (Eigen::Index f = 0; f < rest.F.rows(); ++f)
  {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (int k = 0; k < 3; ++k)
    {
      const int u = rest.F(f, HalfEdgeStart(k));
      const int v = rest.F(f, HalfEdgeEnd(k));
      sum +=
        c(f, k) * (rest.P.row(u) - rest.P.row(v)).transpose() * (deformed.row(u) - deformed.row(v));
    }
    for (int k = 0; k < 3; ++k)
    {
      S[rest.F(f, k)] += sum;
    }
  }
  part.SumAtShared(S.empty() ? nullptr : S.front().data(), 9);
  Matrices R(S.size(), Eigen::Matrix3d::Identity());
  FitRotations(S, R, threads);
  return R;
}

std::vector<char> TurnedOver(
  const Points& P, const Points& Q, const Triangles& F, const Matrices& rotations)
{
  const auto normal = [&F](const Points& x, Eigen::Index f) -> Eigen::Vector3d
  {
    const Eigen::Vector3d a = x.row(F(f, 1)) - x.row(F(f, 0));
    const Eigen::Vector3d b = x.row(F(f, 2)) - x.row(F(f, 0));
    return a.cross(b);
  };
  constexpr double NoArea = 1e-9; // against the area before: rounding decides on its side
  std::vector<char> turnedOver(F.rows());
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    const Eigen::Vector3d before = normal(P, f);
    const Eigen::Vector3d after = normal(Q, f);
    const Eigen::Vector3d turned =
      (rotations[F(f, 0)] + rotations[F(f, 1)] + rotations[F(f, 2)]) * before.stableNormalized();
    const bool over = after.stableNorm() > NoArea * before.stableNorm() &&
      turned.dot(after.stableNormalized()) < 0.0;
    turnedOver[f] = over ? 1 : 0;
  }
  return turnedOver;
}

int CountTurnedOver(const Points& P, const Points& Q, const Triangles& F, const Matrices& rotations)
{
  const std::vector<char> turnedOver = TurnedOver(P, Q, F, rotations);
  return static_cast<int>(std::count(turnedOver.begin(), turnedOver.end(), 1));
}

double DetailError(
  const Points& P, const Points& Q, const Triangles& F, const Matrices& R, const SurfacePart& part)
{
  const HalfEdgeScalars c = HalfEdgeCotangents(P, F);
  Points rest = CotangentLaplacianVectors(P, F, c);
  Points deformed = CotangentLaplacianVectors(Q, F, c);
  part.SumAtShared(rest.data(), 3);
  part.SumAtShared(deformed.data(), 3);
  Eigen::Vector2d sums = Eigen::Vector2d::Zero(); // of squares, of points
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    if (part.Counts(i))
    {
      sums(0) += (deformed.row(i).transpose() - R[i] * rest.row(i).transpose()).squaredNorm();
      sums(1) += 1.0;
    }
  }
  part.Sum(sums);
  const auto [low, high] = BoundsOf(P, part);
  return std::sqrt(sums(0) / sums(1)) / (high - low).norm();
}

double DihedralChange(const Points& P, const Points& Q, const Triangles& F, const MeshEdges& edges,
  const EdgePart& part)
{
  const Eigen::ArrayXd change =
    DihedralAngles(Q, F, edges, part) - DihedralAngles(P, F, edges, part);
  Eigen::Vector2d sums = Eigen::Vector2d::Zero(); // of squares, of edges
  for (const double angle : change)
  {
    const double around = std::remainder(angle, 2.0 * Pi);
    sums += Eigen::Vector2d(around * around, 1.0);
  }
  part.GetProcesses().Sum(sums);
  return sums(1) > 0.0 ? std::sqrt(sums(0) / sums(1)) : 0.0;
}

double LogSpread(const Eigen::VectorXd& ratios, const SurfacePart& part)
{
  const Eigen::ArrayXd logarithm = ratios.array().log();
  Eigen::Vector2d sums(logarithm.sum(), static_cast<double>(logarithm.size()));
  part.Sum(sums);
  if (sums(1) == 0.0)
  {
    return 0.0;
  }
  const double mean = sums(0) / sums(1);
  return std::sqrt(part.Sum((logarithm - mean).square().sum()) / sums(1));
}
} // namespace SphericalStyle
