// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "NormalAnalogy.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace SphericalStyle
{
Points DistinctNormals(const Points& P, const Triangles& F)
{
  constexpr double Steps =
    1e6; // normals of one plane differ by rounding, often of single precision
  std::set<std::array<long, 3>> seen;
  Points distinct(F.rows(), 3);
  Eigen::Index count = 0;
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    const Eigen::Vector3d u = (P.row(F(f, 1)) - P.row(F(f, 0))).stableNormalized();
    const Eigen::Vector3d v = (P.row(F(f, 2)) - P.row(F(f, 0))).stableNormalized();
    const Eigen::Vector3d n = u.cross(v).stableNormalized();
    if (n.squaredNorm() > 0.5 &&
      seen
        .insert({ std::lround(Steps * n[0]), std::lround(Steps * n[1]), std::lround(Steps * n[2]) })
        .second)
    {
      distinct.row(count++) = n;
    }
  }
  distinct.conservativeResize(count, 3);
  return distinct;
}

NormalAnalogy::NormalAnalogy(NormalMap map, double lambda)
  : TargetNormals(lambda)
  , Map(std::move(map))
{
}

Points NormalAnalogy::MakeTargets(const Points&, const Triangles&, const Points& normals) const
{
  return this->Map(normals);
}
} // namespace SphericalStyle
