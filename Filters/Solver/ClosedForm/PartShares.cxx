// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PartShares.h"

namespace SphericalStyle
{
namespace
{
constexpr double LeastSum = 1e-6; // less: the grid knows nothing there, as around what has no area
}

Fields PartShares(const std::vector<int>& parts, int count)
{
  Fields shares = Fields::Zero(static_cast<Eigen::Index>(parts.size()), count);
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    shares(static_cast<Eigen::Index>(i), parts[i]) = 1.0;
  }
  return shares;
}

Fields SmoothShares(const SurfaceGrid& grid, const Fields& shares, const Points& P, int threads)
{
  const Fields coefficients = grid.SmoothTwice(grid.Means(shares, threads), threads);
  Fields smooth = grid.AtPoints(coefficients, P, threads).cwiseMax(0.0);
  for (Eigen::Index i = 0; i < smooth.rows(); ++i)
  {
    const double sum = smooth.row(i).sum();
    if (sum > LeastSum)
    {
      smooth.row(i) /= sum;
    }
    else
    {
      smooth.row(i) = shares.row(i);
    }
  }
  return smooth;
}
} // namespace SphericalStyle
