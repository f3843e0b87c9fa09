// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ModelSize.h"

#include "Parallel.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace SphericalStyle
{
namespace
{
/// Sum of f(a, b, c) over the triangles.
template <typename Function>
double SumOf(const Points& X, const Triangles& F, int threads, const Function& f)
{
  return ParallelSum(static_cast<int>(F.rows()), threads,
    [&](int begin, int end)
    {
      double sum = 0.0;
      for (int t = begin; t < end; ++t)
      {
        sum += f(Eigen::Vector3d(X.row(F(t, 0))), Eigen::Vector3d(X.row(F(t, 1))),
          Eigen::Vector3d(X.row(F(t, 2))));
      }
      return sum;
    });
}

/// Where the model is highest along a direction.
double HighestOf(const Points& X, const std::vector<int>& members, const Eigen::Vector3d& direction,
  int copies, const SurfacePart& part)
{
  double high = -std::numeric_limits<double>::infinity();
  for (const int i : members)
  {
    if (i < X.rows() / copies)
    {
      high = std::max(high, X.row(i).dot(direction));
    }
  }
  return part.Max(high);
}

double LowestOf(const Points& X, const std::vector<int>& members, const SizeOptions& options,
  const SurfacePart& part)
{
  return -HighestOf(X, members, -options.up, options.copies, part);
}

Eigen::RowVector3d MeanOf(const Points& X, const std::vector<int>& members,
  const Eigen::VectorXd& weights, const SurfacePart& part)
{
  Eigen::RowVector4d sums = Eigen::RowVector4d::Zero(); // with the weights
  for (const int i : members)
  {
    sums.head<3>() += weights(i) * X.row(i);
    sums(3) += weights(i);
  }
  part.Sum(sums);
  return sums(3) > 0.0 ? Eigen::RowVector3d(sums.head<3>() / sums(3))
                       : Eigen::RowVector3d(sums.head<3>());
}
}

double LengthOf(const Points& X, const Triangles& F, const std::vector<int>& members,
  const Eigen::VectorXd& weights, const SizeOptions& options, int threads, const SurfacePart& part)
{
  const auto cross = [](const auto& a, const auto& b, const auto& c)
  { return (b - a).cross(c - a).eval(); };
  switch (options.keep)
  {
    case KeepSize::Off:
      break;
    case KeepSize::Area:
      return std::sqrt(part.Sum(SumOf(X, F, threads,
        [&](const auto& a, const auto& b, const auto& c) { return 0.5 * cross(a, b, c).norm(); })));
    case KeepSize::Volume:
    {
      const Eigen::Vector3d apex = MeanOf(X, members, weights, part);
      const double volume = SumOf(X, F, threads,
        [&](const auto& a, const auto& b, const auto& c)
        { return cross(a, b, c).dot(a - apex) / 6.0; });
      return std::cbrt(part.Sum(volume));
    }
    case KeepSize::Extent:
    {
      const double low = LowestOf(X, members, options, part);
      return HighestOf(X, members, options.up, options.copies, part) - low;
    }
  }
  return 1.0;
}

double RestoreSize(const Points& P, const Triangles& F, const std::vector<int>& members,
  const Eigen::VectorXd& weights, const SizeOptions& options, double before, int threads, Points& Q,
  const SurfacePart& part)
{
  // Below, rounding decides; lengths, as fractions of the diagonal. The cube root of a volume has
  // few digits.
  const double nothing = options.keep == KeepSize::Volume ? 1e-5 : 1e-9;
  double factor = 1.0;
  if (options.keep != KeepSize::Off)
  {
    const Eigen::RowVector3d mean = MeanOf(Q, members, weights, part);
    const double after = LengthOf(Q, F, members, weights, options, threads, part);
    factor = before / after;
    if (!(std::abs(before) > nothing && std::abs(after) > nothing && factor > 0.0) ||
      !std::isfinite(factor))
    {
      const std::string what = options.keep == KeepSize::Area ? "Area: the surface has no area"
        : options.keep == KeepSize::Volume
        ? "Volume: the surface, or its rounded copy, encloses no volume; take KeepSize Area"
        : "Extent: the model has no extent along the up axis; take another UpAxis, or KeepSize "
          "Area";
      throw std::invalid_argument("KeepSize " + what);
    }
    for (const int i : members)
    {
      Q.row(i) = mean + factor * (Q.row(i) - mean);
    }
  }
  if (options.keepOnGround)
  {
    const double rise = LowestOf(P, members, options, part) - LowestOf(Q, members, options, part);
    for (const int i : members)
    {
      Q.row(i) += rise * options.up.transpose();
    }
  }
  return factor;
}
} // namespace SphericalStyle
