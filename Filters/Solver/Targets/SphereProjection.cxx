// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SphereProjection.h"

#include "Parallel.h"

namespace SphericalStyle
{
double OuterRadius(const Points& P, const Eigen::Vector3d& center)
{
  return P.rows() > 0 ? (P.rowwise() - center.transpose()).rowwise().stableNorm().maxCoeff() : 0.0;
}

Points ProjectToSphere(
  const Points& P, const Sphere& sphere, double s, int threads, std::vector<int>& onCenter)
{
  const double smallest = 1e-12 * OuterRadius(P, sphere.center);
  const Eigen::RowVector3d O = sphere.center.transpose();
  const int n = static_cast<int>(P.rows());
  Points Q = P;
  std::vector<char> hasRay(n, 0);
  ParallelFor(n, threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        const Eigen::RowVector3d offset = P.row(i) - O;
        const double distance = offset.stableNorm();
        hasRay[i] = distance > smallest;
        if (hasRay[i])
        {
          Q.row(i) = (1.0 - s) * P.row(i) + s * (O + sphere.radius / distance * offset);
        }
      }
    });
  onCenter.clear();
  for (int i = 0; i < n; ++i)
  {
    if (!hasRay[i])
    {
      onCenter.push_back(i);
    }
  }
  return Q;
}
} // namespace SphericalStyle
