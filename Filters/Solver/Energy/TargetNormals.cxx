// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "TargetNormals.h"

#include "LocalStep.h"
#include "Parallel.h"
#include "SurfaceMeasures.h"

#include <cmath>
#include <stdexcept>

namespace SphericalStyle
{
TargetNormals::TargetNormals(double lambda)
  : Lambda(lambda)
{
  if (!std::isfinite(lambda) || lambda < 0.0)
  {
    throw std::invalid_argument("the weight of the normals must be finite and not negative");
  }
}

void TargetNormals::SetMesh(const Points& P, const Triangles& F)
{
  this->Normals = PointNormals(P, F);
  this->Weights = this->Lambda * PointAreas(P, F);
  this->Targets = this->MakeTargets(P, F, this->Normals);
  for (Eigen::Index i = 0; i < this->Normals.rows(); ++i)
  {
    if (this->Normals.row(i).isZero(0.0))
    {
      this->Targets.row(i).setZero();
    }
  }
}

double TargetNormals::Fit(Matrices& S, Matrices& R, int threads)
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

double TargetNormals::Evaluate(const Matrices& R) const
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
