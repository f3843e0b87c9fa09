// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ConjugateGradients.h"

#include "Parallel.h"
#include "TriangleMesh.h"

#include <Eigen/IterativeLinearSolvers>

#include <algorithm>
#include <array>
#include <numeric>

namespace SphericalStyle
{
namespace
{
using Rows = ConjugateGradients::Rows;
using Sums = Eigen::Array3d; // one number for each right-hand side

constexpr int Delay = 4;           // steps whose gain stands for what is left
constexpr double Rounding = 1e-15; // of tr X^T B

Sums Products(const Rows& A, const Rows& B, int threads)
{
  return ParallelSum(static_cast<int>(A.rows()), threads, Sums(Sums::Zero()),
    [&](int begin, int end)
    {
      return Sums(A.middleRows(begin, end - begin)
                    .cwiseProduct(B.middleRows(begin, end - begin))
                    .colwise()
                    .sum()
                    .transpose()
                    .array());
    });
}

/// A += B diag(factor)
void Add(const Rows& B, const Sums& factor, Rows& A, int threads)
{
  ParallelFor(static_cast<int>(A.rows()), threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        A.row(i).array() += B.row(i).array() * factor.transpose();
      }
    });
}

/// 0 / 0 is 0: nothing is left to gain in that column.
Sums Quotient(const Sums& a, const Sums& b)
{
  return (b > 0.0).select(a / b, 0.0);
}
}

bool ConjugateGradients::SetMatrix(const Matrix& A)
{
  if (A.rows() > 0 && !(A.diagonal().minCoeff() > 0.0))
  {
    return false;
  }
  Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::AMDOrdering<int>> incomplete;
  incomplete.compute(A);
  if (incomplete.info() != Eigen::Success)
  {
    return false;
  }
  this->L = incomplete.matrixL();
  this->Scale = incomplete.scalingS();
  this->Order = incomplete.permutationP().indices();
  return true;
}

/// Z := (S P^T L L^T P S)^-1 R in the notation of Eigen's incomplete factor.
void ConjugateGradients::Precondition(const Rows& R, Rows& Z, int threads) const
{
  const auto n = static_cast<int>(R.rows());
  Rows& y = this->Work;
  y.resize(n, 3);
  ParallelFor(n, threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        const int row = this->Order.size() > 0 ? this->Order[i] : i;
        y.row(row) = R.row(i) * this->Scale[row];
      }
    });
  const int* start = this->L.outerIndexPtr();
  const int* rows = this->L.innerIndexPtr();
  const double* value = this->L.valuePtr();
  for (int j = 0; j < n; ++j)
  {
    const Eigen::RowVector3d x = y.row(j) / value[start[j]];
    y.row(j) = x;
    for (int k = start[j] + 1; k < start[j + 1]; ++k)
    {
      y.row(rows[k]) -= value[k] * x;
    }
  }
  for (int j = n - 1; j >= 0; --j)
  {
    Eigen::RowVector3d x = y.row(j);
    for (int k = start[j] + 1; k < start[j + 1]; ++k)
    {
      x -= value[k] * y.row(rows[k]);
    }
    y.row(j) = x / value[start[j]];
  }
  ParallelFor(n, threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        const int row = this->Order.size() > 0 ? this->Order[i] : i;
        Z.row(i) = y.row(row) * this->Scale[row];
      }
    });
}

int ConjugateGradients::Solve(
  const FullMatrix& A, const Rows& B, Rows& X, double share, int threads) const
{
  Rows R = A.Residual(B, X, threads);
  Rows Z(R.rows(), 3);
  Rows AP(R.rows(), 3);
  this->Precondition(R, Z, threads);
  Rows P = Z;
  Sums rz = Products(R, Z, threads);
  const double negligible = Rounding * Products(X, B, threads).abs().sum();
  std::array<double, Delay> gains = {}; // twice the energy that each of the last steps took away
  double gained = 0.0;
  int step = 0;
  while (step < LargestNumberOfSteps && (rz > 0.0).any())
  {
    A.Multiply(P, AP, threads);
    const Sums curvature = Products(P, AP, threads);
    if ((curvature < 0.0).any())
    {
      throw SolverError("the system matrix is not positive definite: conjugate gradients cannot "
                        "solve it, a factor can");
    }
    const Sums alpha = Quotient(rz, curvature);
    Add(P, alpha, X, threads);
    gains[step % Delay] = (alpha * rz).sum();
    gained += gains[step % Delay];
    ++step;
    const double last = std::accumulate(gains.begin(), gains.end(), 0.0);
    if (step >= Delay && last <= std::max(share * gained, negligible))
    {
      return std::min(step, LargestNumberOfSteps - 1); // done, if only with the last step
    }
    Add(AP, -alpha, R, threads);
    this->Precondition(R, Z, threads);
    const Sums next = Products(R, Z, threads);
    const Sums beta = Quotient(next, rz);
    rz = next;
    ParallelFor(static_cast<int>(P.rows()), threads,
      [&](int begin, int end)
      {
        for (int i = begin; i < end; ++i)
        {
          P.row(i).array() = Z.row(i).array() + P.row(i).array() * beta.transpose();
        }
      });
  }
  return step;
}
} // namespace SphericalStyle
