// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "LocalStep.h"

#include "Parallel.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <cmath>

namespace SphericalStyle
{
Eigen::Matrix3d ClosestRotationSVD(const Eigen::Matrix3d& S)
{
  const double size = S.cwiseAbs().maxCoeff();
  if (!(size > 0.0))
  {
    return Eigen::Matrix3d::Identity();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(S / size, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  if ((svd.matrixV() * U.transpose()).determinant() < 0.0)
  {
    U.col(2) = -U.col(2); // Eq. 4.15: the last column belongs to the smallest singular value
  }
  return svd.matrixV() * U.transpose();
}

Eigen::Matrix3d ClosestRotation(const Eigen::Matrix3d& S)
{
  const double size = S.norm();
  if (!(size > 0.0) || !std::isfinite(size))
  {
    return Eigen::Matrix3d::Identity();
  }
  const Eigen::Matrix3d M = S.transpose() / size; // a = |M|^2 = 1
  Eigen::Matrix3d cofactor;
  cofactor.col(0) = M.col(1).cross(M.col(2));
  cofactor.col(1) = M.col(2).cross(M.col(0));
  cofactor.col(2) = M.col(0).cross(M.col(1));
  const double d = M.col(0).dot(cofactor.col(0));
  const double b = cofactor.squaredNorm();

  // Newton from above the largest root (x <= sqrt(3 a)): monotone, since the quartic is convex
  // there.
  double x = std::sqrt(3.0);
  double slope = 0.0;
  for (int step = 0; step < 20; ++step)
  {
    const double y = x * x - 1.0;
    slope = 4.0 * (x * y - 2.0 * d);
    const double dx = (y * y - 8.0 * d * x - 4.0 * b) / slope;
    x -= dx;
    if (!(std::abs(dx) > 1e-15 * x))
    {
      break;
    }
  }
  // x^3 - a x - 2 d = 2 (s1 + s2)(s2 + s3)(s3 + s1): small where the rotation is ill defined.
  const double denominator = x * (x * x - 1.0) - 2.0 * d;
  if (denominator > 1e-3)
  {
    Eigen::Matrix3d R =
      ((x * x + 1.0) * M + 2.0 * x * cofactor - 2.0 * M * (M.transpose() * M)) / denominator;
    const Eigen::Matrix3d gram = R.transpose() * R;
    if ((gram - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-10)
    {
      return R * (1.5 * Eigen::Matrix3d::Identity() - 0.5 * gram); // one Newton-Schulz step: 1e-20
    }
  }
  return ClosestRotationSVD(S);
}

double FitRotations(const Matrices& S, Matrices& R, int threads)
{
  return ParallelSum(static_cast<int>(S.size()), threads,
    [&](int begin, int end)
    {
      double change = 0.0;
      for (int i = begin; i < end; ++i)
      {
        const Eigen::Matrix3d fitted = ClosestRotation(S[i]);
        change -= 2.0 * ((fitted - R[i]).cwiseProduct(S[i].transpose())).sum();
        R[i] = fitted;
      }
      return change;
    });
}
} // namespace SphericalStyle
