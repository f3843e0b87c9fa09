// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockSystem.h"

#include "Parallel.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace SphericalStyle
{
namespace
{
constexpr int GainsToLookAt = 4; // steps whose gain stands for what is left

double DotProduct(const BlockSystem::Rows& a, const BlockSystem::Rows& b, int threads)
{
  return ParallelSum(static_cast<int>(a.rows()), threads,
    [&](int begin, int end) {
      return a.middleRows(begin, end - begin).cwiseProduct(b.middleRows(begin, end - begin)).sum();
    });
}

/// L^-1 with L L^T the block; of a block that is not positive definite, of its size.
Eigen::Matrix3d InverseFactor(const Eigen::Matrix3d& block)
{
  const Eigen::LLT<Eigen::Matrix3d> factor(block);
  Eigen::Matrix3d inverse = factor.matrixL().solve(Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  if (factor.info() == Eigen::Success && inverse.allFinite())
  {
    return inverse;
  }
  const double size = block.trace() / 3.0;
  return Eigen::Matrix3d::Identity() * (size > 0.0 ? 1.0 / std::sqrt(size) : 1.0);
}
} // namespace

PairPattern::PairPattern(int numberOfUnknowns, const std::vector<Element>& elements)
{
  // Lists of fixed room for each column, then without what is there twice.
  const auto forPairs = [&](const auto& body)
  {
    for (const Element& element : elements)
    {
      for (const int row : element)
      {
        for (const int column : element)
        {
          if (column >= 0 && row > column)
          {
            body(row, column);
          }
        }
      }
    }
  };
  std::vector<std::size_t> room(static_cast<std::size_t>(numberOfUnknowns) + 1, 0);
  forPairs([&](int, int column) { ++room[column + 1]; });
  std::partial_sum(room.begin(), room.end(), room.begin());
  std::vector<int> all(room.back());
  std::vector<std::size_t> next(room.begin(), room.end() - 1);
  forPairs([&](int row, int column) { all[next[column]++] = row; });
  this->Starts.push_back(0);
  for (int j = 0; j < numberOfUnknowns; ++j)
  {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(room[j]);
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(room[j + 1]);
    std::sort(begin, end);
    this->Rows.push_back(j);
    this->Rows.insert(this->Rows.end(), begin, std::unique(begin, end));
    this->Starts.push_back(static_cast<int>(this->Rows.size()));
  }
}

int PairPattern::PlaceOf(int a, int b) const
{
  const int column = std::min(a, b);
  const auto begin = this->Rows.begin() + this->Starts[column];
  const auto end = this->Rows.begin() + this->Starts[column + 1];
  return static_cast<int>(std::lower_bound(begin, end, std::max(a, b)) - this->Rows.begin());
}

ConjugateGradients::Matrix PairPattern::MakeMatrix() const
{
  const int n = this->GetNumberOfUnknowns();
  ConjugateGradients::Matrix matrix(n, n);
  matrix.resizeNonZeros(static_cast<Eigen::Index>(this->Rows.size()));
  std::copy(this->Starts.begin(), this->Starts.end(), matrix.outerIndexPtr());
  std::copy(this->Rows.begin(), this->Rows.end(), matrix.innerIndexPtr());
  std::fill_n(matrix.valuePtr(), this->Rows.size(), 0.0);
  return matrix;
}

BlockSystem::BlockSystem(const PairPattern& pattern)
  : Pattern(&pattern)
  , Values(9 * pattern.GetNumberOfPairs(), 0.0)
{
  const int n = pattern.GetNumberOfUnknowns();
  this->Starts.assign(static_cast<std::size_t>(n) + 1, 0);
  const auto forBoth = [&](const auto& body)
  {
    for (int j = 0; j < n; ++j)
    {
      for (int place = pattern.Starts[j]; place < pattern.Starts[j + 1]; ++place)
      {
        const int i = pattern.Rows[place];
        body(i, j, place);
        if (i != j)
        {
          body(j, i, ~place);
        }
      }
    }
  };
  forBoth([&](int row, int, int) { ++this->Starts[row + 1]; });
  std::partial_sum(this->Starts.begin(), this->Starts.end(), this->Starts.begin());
  this->Columns.resize(this->Starts.back());
  this->Sources.resize(this->Starts.back());
  std::vector<int> next(this->Starts.begin(), this->Starts.end() - 1);
  forBoth(
    [&](int row, int column, int source)
    {
      const int at = next[row]++;
      this->Columns[at] = column;
      this->Sources[at] = source;
    });
  this->Scaled.resize(9 * this->Columns.size());
  this->Inverses.resize(n);
}

void BlockSystem::SetZero()
{
  std::fill(this->Values.begin(), this->Values.end(), 0.0);
}

void BlockSystem::Scale(int threads)
{
  using Block = Eigen::Map<const Eigen::Matrix3d>;
  const int n = this->Pattern->GetNumberOfUnknowns();
  ParallelFor(n, threads,
    [&](int begin, int end)
    {
      for (int j = begin; j < end; ++j)
      {
        const auto diagonal = static_cast<std::size_t>(this->Pattern->Starts[j]);
        this->Inverses[j] = InverseFactor(Block(&this->Values[9 * diagonal]));
      }
    });
  ParallelFor(n, threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        for (int k = this->Starts[i]; k < this->Starts[i + 1]; ++k)
        {
          const int source = this->Sources[k];
          const auto place = static_cast<std::size_t>(source >= 0 ? source : ~source);
          const Block block(&this->Values[9 * place]);
          const Eigen::Matrix3d& left = this->Inverses[i];
          const Eigen::Matrix3d& right = this->Inverses[this->Columns[k]];
          const Eigen::Matrix3d scaled = source >= 0
            ? Eigen::Matrix3d(left * block * right.transpose())
            : Eigen::Matrix3d(left * block.transpose() * right.transpose());
          Eigen::Map<Eigen::Matrix3f>(&this->Scaled[9 * static_cast<std::size_t>(k)]) =
            scaled.cast<float>();
        }
      }
    });
}

void BlockSystem::Multiply(const Rows& X, Rows& Y, int threads) const
{
  ParallelFor(static_cast<int>(X.rows()), threads,
    [&](int begin, int end)
    {
      const double* x = X.data();
      for (int i = begin; i < end; ++i)
      {
        double sum[3] = { 0.0, 0.0, 0.0 };
        for (int k = this->Starts[i]; k < this->Starts[i + 1]; ++k)
        {
          const float* a = &this->Scaled[9 * static_cast<std::size_t>(k)];
          const double* v = x + 3 * static_cast<std::size_t>(this->Columns[k]);
          for (int row = 0; row < 3; ++row)
          {
            sum[row] += a[row] * v[0] + a[3 + row] * v[1] + a[6 + row] * v[2];
          }
        }
        Y.row(i) << sum[0], sum[1], sum[2];
      }
    });
}

int BlockSystem::Solve(const Rows& B, Rows& X, double share, int threads)
{
  this->Scale(threads);
  const auto n = static_cast<int>(B.rows());
  const auto each = [n, threads](const auto& body)
  {
    ParallelFor(n, threads,
      [&](int begin, int end)
      {
        for (int i = begin; i < end; ++i)
        {
          body(i);
        }
      });
  };
  Rows residual(n, 3);
  Rows AP(n, 3);
  each([&](int i) { residual.row(i) = B.row(i) * this->Inverses[i].transpose(); });
  Rows direction = residual;
  X.setZero(n, 3);
  std::array<double, GainsToLookAt> gains = {};
  double gained = 0.0;
  double rr = DotProduct(residual, residual, threads);
  int step = 0;
  while (step < LargestNumberOfSteps && rr > 0.0)
  {
    this->Multiply(direction, AP, threads);
    const double curvature = DotProduct(direction, AP, threads);
    if (!(curvature > 0.0)) // rounding: what there is must do
    {
      X = step == 0 ? residual : X;
      break;
    }
    const double alpha = rr / curvature;
    each(
      [&](int i)
      {
        X.row(i) += alpha * direction.row(i);
        residual.row(i) -= alpha * AP.row(i);
      });
    gains[step % GainsToLookAt] = alpha * rr;
    gained += alpha * rr;
    ++step;
    if (step >= GainsToLookAt && std::accumulate(gains.begin(), gains.end(), 0.0) <= share * gained)
    {
      break;
    }
    const double next = DotProduct(residual, residual, threads);
    const double beta = next / rr;
    rr = next;
    each([&](int i) { direction.row(i) = residual.row(i) + beta * direction.row(i); });
  }
  each([&](int i) { X.row(i) = X.row(i) * this->Inverses[i]; });
  return step;
}
} // namespace SphericalStyle
