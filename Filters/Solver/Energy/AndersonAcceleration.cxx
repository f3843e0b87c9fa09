// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "AndersonAcceleration.h"

#include "Parallel.h"

#include <Eigen/QR>

#include <algorithm>
#include <utility>

namespace SphericalStyle
{
AndersonAcceleration::AndersonAcceleration(int window, int threads)
  : Window(std::clamp(window, 1, LargestWindow))
  , Threads(threads)
{
}

/// Room for one more step; the oldest one goes when the window is full.
AndersonAcceleration::Step& AndersonAcceleration::NextStep()
{
  const auto size = static_cast<Eigen::Index>(this->Steps.size());
  if (size == this->Window)
  {
    std::rotate(this->Steps.begin(), this->Steps.begin() + 1, this->Steps.end());
    this->Gram.topLeftCorner(size - 1, size - 1) =
      this->Gram.bottomRightCorner(size - 1, size - 1).eval();
  }
  else
  {
    this->Steps.emplace_back();
    this->Gram.conservativeResize(size + 1, size + 1);
    this->Right.resize(size + 1);
  }
  return this->Steps.back();
}

/// One pass over memory: the step, its products with all others, and theirs with the residual.
void AndersonAcceleration::AddStep(const Points& x, const Points& g)
{
  using Floats = Eigen::Map<Eigen::VectorXf>;
  using Doubles = Eigen::Map<Eigen::VectorXd>;
  using Products = Eigen::Matrix<double, LargestWindow, 2>;
  Step& step = this->NextStep();
  step.residual.resize(g.size());
  step.image.resize(g.size());
  const int count = static_cast<int>(this->Steps.size());
  const Products products =
    ParallelSum(static_cast<int>(g.rows()), this->Threads, Products(Products::Zero()),
      [&](int begin, int end)
      {
        const auto first = 3 * static_cast<std::ptrdiff_t>(begin);
        const auto size = 3 * static_cast<std::ptrdiff_t>(end - begin);
        Floats residualStep(step.residual.data() + first, size);
        Doubles imageStep(step.image.data() + first, size);
        Doubles lastResidual(this->LastResidual.data() + first, size);
        Doubles lastImage(this->LastImage.data() + first, size);
        const Eigen::Map<const Eigen::VectorXd> from(x.data() + first, size);
        const Eigen::Map<const Eigen::VectorXd> to(g.data() + first, size);
        residualStep = (to - from - lastResidual).cast<float>();
        imageStep = to - lastImage;
        lastResidual = to - from;
        lastImage = to;
        Products sums = Products::Zero();
        for (int k = 0; k < count; ++k)
        {
          const Floats other(this->Steps[k].residual.data() + first, size);
          sums(k, 0) = other.cast<double>().dot(residualStep.cast<double>());
          sums(k, 1) = other.cast<double>().dot(lastResidual);
        }
        return sums;
      });
  this->Gram.row(count - 1) = products.col(0).head(count).transpose();
  this->Gram.col(count - 1) = products.col(0).head(count);
  this->Right = products.col(1).head(count);
}

bool AndersonAcceleration::Mix(const Points& x, const Points& g, Points& mixed)
{
  if (!this->HasLast)
  {
    this->LastResidual = g - x;
    this->LastImage = g;
    this->HasLast = true;
    return false;
  }
  this->AddStep(x, g);
  // min | residual - sum gamma_j step_j |: normal equations of at most Window unknowns, columns
  // scaled to one, nearly dependent ones dropped by the rank-revealing factorization.
  const Eigen::VectorXd size = this->Gram.diagonal().cwiseSqrt();
  if (!(size.minCoeff() > 0.0))
  {
    return false;
  }
  const Eigen::VectorXd scale = size.cwiseInverse();
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(1e-12);
  solver.compute(scale.asDiagonal() * this->Gram * scale.asDiagonal());
  const Eigen::VectorXd gamma = scale.cwiseProduct(solver.solve(scale.cwiseProduct(this->Right)));
  mixed.resize(g.rows(), 3);
  ParallelFor(static_cast<int>(g.rows()), this->Threads,
    [&](int begin, int end)
    {
      for (auto e = 3 * static_cast<std::ptrdiff_t>(begin);
           e < 3 * static_cast<std::ptrdiff_t>(end); ++e)
      {
        double sum = 0.0;
        for (Eigen::Index k = 0; k < gamma.size(); ++k)
        {
          sum += gamma[k] * this->Steps[k].image[e];
        }
        mixed.data()[e] = g.data()[e] - sum;
      }
    });
  return gamma.allFinite();
}

void AndersonAcceleration::Reset()
{
  this->HasLast = false;
  this->Steps.clear();
  this->Gram.resize(0, 0);
}
} // namespace SphericalStyle
