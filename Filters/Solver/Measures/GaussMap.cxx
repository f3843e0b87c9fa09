// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "GaussMap.h"

#include <cmath>
#include <limits>

namespace SphericalStyle
{
Eigen::VectorXd RelativeWeights(
  Eigen::Index N, const Eigen::VectorXd& weights, const SurfacePart& part)
{
  Eigen::Vector3d sums(weights.sum(), static_cast<double>(N), static_cast<double>(weights.size()));
  part.Sum(sums);
  return sums(2) == 0.0 ? Eigen::VectorXd::Ones(N) : (weights / (sums(0) / sums(1))).eval();
}

Eigen::VectorXd CountNormals(
  const SphereUnits& units, const Points& normals, const Eigen::VectorXd& weights)
{
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(units.NumberOfUnits());
  for (Eigen::Index i = 0; i < normals.rows(); ++i)
  {
    counts(units.Find(normals.row(i))) += weights(i);
  }
  return counts;
}

Eigen::VectorXd Density(const SphereUnits& units, const Eigen::VectorXd& counts)
{
  const double total = counts.sum();
  Eigen::VectorXd density = Eigen::VectorXd::Zero(counts.size());
  for (Eigen::Index k = 0; k < counts.size() && total > 0.0; ++k)
  {
    density(k) = counts(k) / total * 4.0 * Pi / units.SolidAngle(static_cast<int>(k));
  }
  return density;
}

int UnitsAbove(const Eigen::VectorXd& counts, double threshold)
{
  return static_cast<int>((counts.array() > threshold).count());
}

Spread MeasureSpread(const Eigen::VectorXd& counts)
{
  const auto K = static_cast<double>(counts.size());
  const double total = counts.sum();
  if (!(total > 0.0))
  {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return { none, none, none, none };
  }
  Spread spread;
  for (const double count : counts)
  {
    const double p = count / total;
    spread.entropy -= p > 0.0 ? p * std::log(p) : 0.0;
    spread.divergence += p > 0.0 ? p * std::log(K * p) : 0.0;
    spread.distanceToUniform += 0.5 * std::abs(p - 1.0 / K);
  }
  spread.relativeEntropy = spread.entropy / std::log(K);
  return spread;
}
} // namespace SphericalStyle
