// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "CarriedDetails.h"

#include "LocalStep.h"
#include "Parallel.h"
#include "Smoothstep.h"

#include <algorithm>
#include <cmath>

namespace SphericalStyle
{
namespace
{
/// Of the area of B' to that of what is carried on it, seen along the turned normal: below it
/// details give way.
constexpr double SmallestStretch = 0.5;
/// Of the area that a place usually has in B': what is smaller makes details give way less, so that
/// they never jump.
constexpr double LeastArea = 0.2;
/// Smooth share of yielding places below which their say fades: how far from a crease details give
/// way.
constexpr double FewYields = 0.01;
using Gradient = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
}

double CertainShare(const Eigen::Matrix3d& S, const Eigen::Matrix3d& R)
{
  return Smoothstep(RotationCertainty(S, R));
}

Fields DetailCovariances(
  const SurfaceGrid& grid, const BaseSlopes& before, const BaseSlopes& after, int threads)
{
  const int samples = grid.GetNumberOfSamples();
  Fields S(samples, 9);
  ParallelFor(samples, threads,
    [&](int begin, int end)
    {
      for (int k = begin; k < end; ++k)
      {
        const Gradient G(before.gradients.row(k).data());
        const Gradient H(after.gradients.row(k).data());
        Eigen::Matrix3d covariance = G * H.transpose();
        const auto& N = before.areaVectors.row(k);
        const auto& M = after.areaVectors.row(k);
        const double size = std::sqrt(N.norm() * M.norm());
        if (size > 0.0)
        {
          covariance += N.transpose() * M / (size * grid.GetWeights()(k));
        }
        Eigen::Map<Eigen::Matrix3d>(S.row(k).data()) = covariance; // column by column
      }
    });
  return S;
}

Fields DetailYields(const Fields& S, const DetailAreas& areas, int threads)
{
  const Points& atRest = areas.atRest;
  const Points& ofBase = areas.ofBase;
  const Points& carried = areas.carried;
  const double usual = ofBase.rowwise().norm().sum() / atRest.rowwise().norm().sum();
  const int samples = static_cast<int>(S.rows());
  Fields yields = Fields::Zero(samples, 2);
  ParallelFor(samples, threads,
    [&](int begin, int end)
    {
      for (int k = begin; k < end; ++k)
      {
        const Eigen::Map<const Eigen::Matrix3d> covariance(S.row(k).data());
        const Eigen::Matrix3d R = ClosestRotation(covariance);
        const Eigen::Vector3d normal = R * atRest.row(k).transpose();
        const double a = ofBase.row(k).dot(normal);
        const double gap = SmallestStretch * a - carried.row(k).dot(normal);
        const double least = LeastArea * usual * normal.squaredNorm();
        if (gap > 0.0 && a > -least)
        {
          const double way = std::max(gap + (1.0 - SmallestStretch) * a, -SmallestStretch * a);
          const double y = CertainShare(covariance, R) * std::min(1.0, 1.0 + a / least) *
            std::min(1.0, gap / least) * std::min(1.0, gap / way);
          yields.row(k) << y, y * y;
        }
      }
    });
  return yields;
}

void CarryDetails(const SurfaceGrid& grid, const Fields& smooth, const DetailPoints& points,
  const Points& moved, int threads, Points& positions, Matrices* rotations)
{
  const int n = static_cast<int>(points.P.rows());
  if (rotations)
  {
    rotations->resize(n);
  }
  positions.resize(n, 3);
  constexpr int Packet = 4096; // so that the covariances of all points are never kept
  ParallelTasks((n + Packet - 1) / Packet, threads,
    [&](int task)
    {
      const int begin = Packet * task;
      const int count = std::min(Packet, n - begin);
      const Fields at = grid.AtPoints(smooth, points.P.middleRows(begin, count), 1);
      Matrices R(count, Eigen::Matrix3d::Identity());
      FitRotations(at.data(), count, R.data());
      for (int i = 0; i < count; ++i)
      {
        const Eigen::Vector3d detail =
          (points.X.row(begin + i) - points.B.row(begin + i)).transpose();
        const double kept = CertainShare(Eigen::Map<const Eigen::Matrix3d>(at.row(i).data()), R[i]);
        positions.row(begin + i) = moved.row(begin + i) + kept * (R[i] * detail).transpose();
      }
      if (rotations)
      {
        std::copy(R.begin(), R.end(), rotations->begin() + begin);
      }
    });
}

void GiveWay(const SurfaceGrid& grid, const Fields& smooth, const Points& P, const Points& moved,
  int threads, Points& positions)
{
  const Fields yield = grid.AtPoints(smooth, P, threads);
  ParallelFor(static_cast<int>(yield.rows()), threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        const double share =
          std::clamp(yield(i, 1) / (std::max(0.0, yield(i, 0)) + FewYields), 0.0, 1.0);
        positions.row(i) -= share * (positions.row(i) - moved.row(i));
      }
    });
}
} // namespace SphericalStyle
