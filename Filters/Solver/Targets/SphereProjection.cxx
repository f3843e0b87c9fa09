// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SphereProjection.h"

namespace SphericalStyle
{
double OuterRadius(const Points& P, const Eigen::Vector3d& center)
{
  return P.rows() > 0 ? (P.rowwise() - center.transpose()).rowwise().stableNorm().maxCoeff() : 0.0;
}

Points ProjectToSphere(const Points& P, const Sphere& sphere, double s, std::vector<int>& onCenter)
{
  const double smallest = 1e-12 * OuterRadius(P, sphere.center);
  const Eigen::RowVector3d O = sphere.center.transpose();
  Points Q = P;
  onCenter.clear();
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    const Eigen::RowVector3d offset = P.row(i) - O;
    const double distance = offset.stableNorm();
    if (distance > smallest)
    {
      Q.row(i) = (1.0 - s) * P.row(i) + s * (O + sphere.radius / distance * offset);
    }
    else
    {
      onCenter.push_back(static_cast<int>(i));
    }
  }
  return Q;
}
} // namespace SphericalStyle
