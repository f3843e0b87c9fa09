// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ProxyTransfer.h"

#include "LocalStep.h"
#include "Parallel.h"

namespace SphericalStyle
{
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
        R[i] = ClosestRotation(mean.transpose()); // maximizes tr(R mean^T)
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
} // namespace SphericalStyle
