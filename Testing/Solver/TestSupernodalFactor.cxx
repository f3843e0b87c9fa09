// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Solving with a supernodal factor, against the dense matrix that the factor stands for. Any lower
// triangular blocks make a factor: they need not come from a factorisation.
#include "Check.h"
#include "Meshes.h"
#include "SupernodalFactor.h"

#include <Eigen/Dense>

#include <algorithm>
#include <numeric>

using namespace SphericalStyle;
using Eigen::MatrixXd;
using RowMajor3 = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

namespace
{
/// Owns what a SupernodalFactor views.
struct Blocks
{
  std::vector<int> FirstColumn = { 0 };
  std::vector<int> FirstRow = { 0 };
  std::vector<int> FirstValue = { 0 };
  std::vector<int> Rows;
  std::vector<double> Values;
  std::vector<int> Permutation;
  MatrixXd Dense; // L

  /// @param widths  of the supernodes @param fill  share of the rows below that they reach
  Blocks(const std::vector<int>& widths, double fill, Meshes::Random& random)
  {
    const int n = std::accumulate(widths.begin(), widths.end(), 0);
    this->Dense = MatrixXd::Zero(n, n);
    for (const int width : widths)
    {
      const int first = this->FirstColumn.back();
      std::vector<int> rows;
      for (int i = first; i < n; ++i)
      {
        if (i < first + width || random.Unit() < fill)
        {
          rows.push_back(i);
        }
      }
      for (int j = first; j < first + width; ++j)
      {
        for (const int i : rows)
        {
          const double value = i == j ? 1.5 + random.Unit() : random.Signed() / n;
          this->Values.push_back(i < j ? std::nan("") : value); // means nothing above the diagonal
          this->Dense(i, j) = i < j ? 0.0 : value;
        }
      }
      this->Rows.insert(this->Rows.end(), rows.begin(), rows.end());
      this->FirstColumn.push_back(first + width);
      this->FirstRow.push_back(static_cast<int>(this->Rows.size()));
      this->FirstValue.push_back(static_cast<int>(this->Values.size()));
    }
    this->Permutation.resize(n);
    std::iota(this->Permutation.begin(), this->Permutation.end(), 0);
    for (int i = n - 1; i > 0; --i)
    {
      std::swap(this->Permutation[i], this->Permutation[static_cast<int>(random.Unit() * (i + 1))]);
    }
  }

  SupernodalFactor View() const
  {
    return { static_cast<int>(this->Dense.rows()), static_cast<int>(this->FirstColumn.size()) - 1,
      this->FirstColumn.data(), this->FirstRow.data(), this->Rows.data(), this->FirstValue.data(),
      this->Values.data(), this->Permutation.data() };
  }
};

void CheckSolve(const std::vector<int>& widths, double fill, Meshes::Random& random)
{
  const Blocks blocks(widths, fill, random);
  const auto n = static_cast<int>(blocks.Dense.rows());
  // Row k of P A P^T is row permutation[k] of A.
  const MatrixXd permuted = blocks.Dense * blocks.Dense.transpose();
  MatrixXd A(n, n);
  A(blocks.Permutation, blocks.Permutation) = permuted;
  RowMajor3 x(n, 3);
  for (int i = 0; i < n; ++i)
  {
    x.row(i) = random.InCube();
  }
  RowMajor3 solved = A * x;
  std::vector<double> work(3, std::nan("")); // what is left in it must not matter
  SolveSupernodal(blocks.View(), solved, work);
  CHECK((solved - x).cwiseAbs().maxCoeff() <= 1e-13,
    "supernodes of " << widths.front() << ".." << widths.back() << " columns, fill " << fill
                     << ": off by " << (solved - x).cwiseAbs().maxCoeff());
  RowMajor3 again = A * x;
  SolveSupernodal(blocks.View(), again, work);
  CHECK(again == solved, "a second solve should give the same bits");
}
}

int main()
{
  Meshes::Random random(1);
  for (const double fill : { 0.0, 0.2, 1.0 })
  {
    for (int width = 1; width <= 13; ++width)
    {
      CheckSolve({ width }, fill, random);
      CheckSolve({ width, width, width }, fill, random);
    }
    CheckSolve({ 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 }, fill, random);
    CheckSolve({ 9, 1, 8, 2, 7, 3, 6, 4, 5 }, fill, random);
    CheckSolve({ 1, 40, 1 }, fill, random);
  }
  return CheckResult();
}
