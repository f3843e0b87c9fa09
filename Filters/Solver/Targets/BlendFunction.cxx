// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlendFunction.h"

#include "Smoothstep.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace SphericalStyle
{
namespace
{
void Require(bool good, const char* message)
{
  if (!good)
  {
    throw std::invalid_argument(message);
  }
}

bool IsShare(double x)
{
  return x >= 0.0 && x <= 1.0;
}
} // namespace

double BlendShape(BlendFunction function, double steepness, double s)
{
  s = std::clamp(s, 0.0, 1.0);
  switch (function)
  {
    case BlendFunction::Linear:
      return s;
    case BlendFunction::Quadratic:
      return s * s;
    case BlendFunction::Tanh:
      return 0.5 * (1.0 + std::tanh(steepness * (2.0 * s - 1.0)) / std::tanh(steepness));
    case BlendFunction::Smoothstep:
      return Smoothstep(s);
    case BlendFunction::Constant:
      break;
  }
  return 1.0;
}

Eigen::VectorXd BlendAlongAxis(const Points& P, const BlendOptions& options)
{
  if (options.function == BlendFunction::Constant)
  {
    Require(IsShare(options.constant), "Blend must lie in 0..1");
    return Eigen::VectorXd::Constant(P.rows(), options.constant);
  }
  Require(options.axis.allFinite() && !options.axis.isZero(0.0),
    "BlendAxis must be finite and not (0, 0, 0)");
  Require(options.range.allFinite() && options.range[0] < options.range[1],
    "BlendRange must be finite, its start below its end");
  Require(IsShare(options.atStart), "BlendAtStart must lie in 0..1");
  Require(IsShare(options.atEnd), "BlendAtEnd must lie in 0..1");
  Require(options.function != BlendFunction::Tanh ||
      (std::isfinite(options.steepness) && options.steepness > 0.0),
    "TanhSteepness must be finite and above 0");
  if (P.rows() == 0)
  {
    return {};
  }
  Eigen::VectorXd t = P * options.axis.stableNormalized();
  const double low = t.minCoeff();
  const double extent = t.maxCoeff() - low;
  // What rounding leaves of a plane across the axis is no extent.
  const bool flat = !(extent > 1e-14 * P.cwiseAbs().maxCoeff());
  const double length = options.range[1] - options.range[0];
  for (double& x : t)
  {
    const double fraction = flat ? 0.0 : (x - low) / extent;
    const double g =
      BlendShape(options.function, options.steepness, (fraction - options.range[0]) / length);
    // At the ends exactly what was asked for: t = 1 leaves a point as it is.
    x = g < 1.0 ? options.atStart + (options.atEnd - options.atStart) * g : options.atEnd;
  }
  return t;
}
} // namespace SphericalStyle
