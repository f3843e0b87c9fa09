// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "NormalAnalogy.h"

#include "LocalStep.h"
#include "Parallel.h"
#include "SurfaceMeasures.h"

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
  : Map(std::move(map))
  , Lambda(lambda)
{
  if (!std::isfinite(lambda) || lambda < 0.0)
  {
    throw std::invalid_argument("the weight of the normals must be finite and not negative");
  }
}

void NormalAnalogy::SetMesh(const Points& P, const Triangles& F)
{
  this->Normals = PointNormals(P, F);
  this->Weights = this->Lambda * PointAreas(P, F);
  this->Targets = this->Map(this->Normals);
  for (Eigen::Index i = 0; i < this->Normals.rows(); ++i)
  {
    if (this->Normals.row(i).isZero(0.0))
    {
      this->Targets.row(i).setZero();
    }
  }
}

double NormalAnalogy::Fit(Matrices& S, Matrices& R, int threads)
{
  ParallelFor(static_cast<int>(S.size()), threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        S[i] += this->Weights[i] * this->Normals.row(i).transpose() * this->Targets.row(i);
      }
    });
  return FitRotations(S, R, threads);
}

double NormalAnalogy::Evaluate(const Matrices& R) const
{
  double sum = 0.0;
  for (std::size_t i = 0; i < R.size(); ++i)
  {
    const auto row = static_cast<Eigen::Index>(i);
    sum += this->Weights[row] *
      (R[i] * this->Normals.row(row).transpose() - this->Targets.row(row).transpose())
        .squaredNorm();
  }
  return sum;
}
} // namespace SphericalStyle
