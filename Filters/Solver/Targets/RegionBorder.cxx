// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RegionBorder.h"

namespace SphericalStyle
{
Eigen::VectorXd BorderWeights(const Eigen::VectorXd& distances, double width)
{
  return distances.unaryExpr(
    [width](double distance)
    {
      if (!(distance > 0.0))
      {
        return 0.0;
      }
      const double x = distance / width;
      return x < 1.0 ? x * x * x * (x * (6.0 * x - 15.0) + 10.0) : 1.0;
    });
}
} // namespace SphericalStyle
