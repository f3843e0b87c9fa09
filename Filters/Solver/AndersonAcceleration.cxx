// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "AndersonAcceleration.h"

#include <Eigen/QR>

namespace SphericalStyle
{
bool AndersonAcceleration::Mix(const Points& x, const Points& g, Points& mixed)
{
  const Points residual = g - x;
  if (!this->HasLast)
  {
    this->LastResidual = residual;
    this->LastImage = g;
    this->HasLast = true;
    return false;
  }
  if (static_cast<int>(this->ResidualSteps.size()) == this->Window)
  {
    this->ResidualSteps.erase(this->ResidualSteps.begin());
    this->ImageSteps.erase(this->ImageSteps.begin());
  }
  this->ResidualSteps.emplace_back(residual - this->LastResidual);
  this->ImageSteps.emplace_back(g - this->LastImage);
  this->LastResidual = residual;
  this->LastImage = g;

  // min | residual - sum gamma_j step_j |: normal equations of at most Window unknowns, columns
  // scaled to one, nearly dependent ones dropped by the rank-revealing factorisation.
  const int m = static_cast<int>(this->ResidualSteps.size());
  Eigen::MatrixXd gram(m, m);
  Eigen::VectorXd right(m);
  for (int i = 0; i < m; ++i)
  {
    for (int j = 0; j <= i; ++j)
    {
      gram(i, j) = gram(j, i) = this->ResidualSteps[i].cwiseProduct(this->ResidualSteps[j]).sum();
    }
    right(i) = this->ResidualSteps[i].cwiseProduct(residual).sum();
  }
  const Eigen::VectorXd size = gram.diagonal().cwiseSqrt();
  if (!(size.minCoeff() > 0.0))
  {
    return false;
  }
  const Eigen::VectorXd scale = size.cwiseInverse();
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(1e-12);
  solver.compute(scale.asDiagonal() * gram * scale.asDiagonal());
  const Eigen::VectorXd gamma = scale.cwiseProduct(solver.solve(scale.cwiseProduct(right)));
  mixed = g;
  for (int j = 0; j < m; ++j)
  {
    mixed -= gamma(j) * this->ImageSteps[j];
  }
  return mixed.allFinite();
}

void AndersonAcceleration::Reset()
{
  this->HasLast = false;
  this->ResidualSteps.clear();
  this->ImageSteps.clear();
}
} // namespace SphericalStyle
