// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ProxyTransfer.h"

#include "EdgeWeights.h"
#include "LocalStep.h"
#include "Parallel.h"

#include <Eigen/Geometry>

namespace SphericalStyle
{
Matrices SurfaceRotations(const TriangleMesh& rest, const Points& rounded, int threads)
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
        c(f, k) * (rest.P.row(u) - rest.P.row(v)).transpose() * (rounded.row(u) - rounded.row(v));
    }
    for (int k = 0; k < 3; ++k)
    {
      S[rest.F(f, k)] += sum;
    }
  }
  Matrices R(S.size(), Eigen::Matrix3d::Identity());
  FitRotations(S, R, threads);
  return R;
}

Matrices RotationsAtFeet(const DeformedProxy& proxy, const Feet& feet, int threads)
{
  Matrices R(feet.cell.size());
  ParallelFor(static_cast<int>(R.size()), threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
        for (int k = 0; k < 3; ++k)
        {
          mean += feet.barycentric(i, k) * proxy.rotations[proxy.rest.F(feet.cell[i], k)];
        }
        R[i] = ClosestRotation(mean.transpose()); // maximises tr(R mean^T)
      }
    });
  return R;
}

Points TransferFromProxy(const Points& P, const DeformedProxy& proxy, const Feet& feet,
  const Matrices& rotations, const Points& t, const TransferOptions& options)
{
  Points target = Interpolate(proxy.rest.F, feet, proxy.rounded);
  if (options.gain != Eigen::Vector3d::Ones())
  {
    const Eigen::RowVector3d O = options.center.transpose();
    target = ((target.rowwise() - O) * options.gain.asDiagonal()).rowwise() + O;
  }
  if (options.transfer == Transfer::Offset)
  {
    const Points q = Interpolate(proxy.rest.F, feet, proxy.rest.P);
    for (Eigen::Index i = 0; i < P.rows(); ++i)
    {
      target.row(i) += (P.row(i) - q.row(i)) * rotations[i].transpose();
    }
  }
  Points Q(P.rows(), 3);
  for (Eigen::Index k = 0; k < P.size(); ++k)
  {
    const double s = t.data()[k];
    const double p = P.data()[k];
    Q.data()[k] = s == 1.0 ? p : (1.0 - s) * target.data()[k] + s * p;
  }
  return Q;
}

int CountTurnedOver(const Points& P, const Points& Q, const Triangles& F, const Matrices& rotations)
{
  const auto normal = [&F](const Points& x, Eigen::Index f) -> Eigen::Vector3d
  {
    const Eigen::Vector3d a = x.row(F(f, 1)) - x.row(F(f, 0));
    const Eigen::Vector3d b = x.row(F(f, 2)) - x.row(F(f, 0));
    return a.cross(b);
  };
  constexpr double NoArea = 1e-9; // against the area before: rounding decides on its side
  int count = 0;
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    const Eigen::Vector3d before = normal(P, f);
    const Eigen::Vector3d after = normal(Q, f);
    const Eigen::Vector3d turned =
      (rotations[F(f, 0)] + rotations[F(f, 1)] + rotations[F(f, 2)]) * before.stableNormalized();
    count += after.stableNorm() > NoArea * before.stableNorm() &&
      turned.dot(after.stableNormalized()) < 0.0;
  }
  return count;
}
} // namespace SphericalStyle
