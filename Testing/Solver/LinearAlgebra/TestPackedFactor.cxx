// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Solving with a packed supernodal factor, against the dense matrix that the factor stands for. Any
// lower triangular blocks make a factor: they need not come from a factorization.
#include "Check.h"
#include "Meshes.h"
#include "PackedFactor.h"
#include "SparseCholesky.h"

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include <algorithm>
#include <numeric>
#include <utility>

using namespace SphericalStyle;
using Eigen::MatrixXd;
using RowMajor3 = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

namespace
{
/// A factor and its pattern.
struct Blocks
{
  SupernodalPattern Pattern;
  std::vector<std::vector<double>> Panels;
  std::vector<Eigen::Triplet<double>> Entries; // of L

  Blocks()
  {
    this->Pattern.firstColumn = { 0 };
    this->Pattern.firstRow = { 0 };
  }

  /// A supernode with these rows, its own columns first. @param size  of what is off the diagonal
  void Add(const std::vector<int>& rows, int width, double size, Meshes::Random& random)
  {
    const int first = this->Pattern.firstColumn.back();
    const SupernodePanel panel(width, static_cast<int>(rows.size()) - width);
    std::vector<double> values(panel.GetSize(), 0.0);
    for (int j = 0; j < width; ++j)
    {
      for (int k = 0; k < static_cast<int>(rows.size()); ++k)
      {
        const double value = k == j ? 1.5 + random.Unit() : size * random.Signed();
        const int slot = k < width ? k : panel.ownTiles * 8 + k - width;
        values[panel.GetOffset(slot / 8, j) + slot % 8] =
          k < j ? std::nan("") : value; // means nothing above the diagonal
        if (k >= j)
        {
          this->Entries.emplace_back(rows[k], first + j, value);
        }
      }
    }
    this->Panels.push_back(values);
    std::vector<int>& all = this->Pattern.rows;
    all.insert(all.end(), rows.begin(), rows.end());
    this->Pattern.firstColumn.push_back(first + width);
    this->Pattern.firstRow.push_back(static_cast<int>(all.size()));
  }

  void Permute(Meshes::Random& random)
  {
    std::vector<int>& permutation = this->Pattern.permutation;
    permutation.resize(this->Pattern.firstColumn.back());
    std::iota(permutation.begin(), permutation.end(), 0);
    for (int i = this->Pattern.firstColumn.back() - 1; i > 0; --i)
    {
      std::swap(permutation[i], permutation[static_cast<int>(random.Unit() * (i + 1))]);
    }
  }

  Eigen::SparseMatrix<double> Sparse() const
  {
    const int n = this->Pattern.GetNumberOfColumns();
    Eigen::SparseMatrix<double> L(n, n);
    L.setFromTriplets(this->Entries.begin(), this->Entries.end());
    return L;
  }

  template <typename Scalar>
  PackedFactor<Scalar> Pack() const
  {
    PackedFactor<Scalar> packed(this->Pattern);
    for (int s = 0; s < this->Pattern.GetNumberOfSupernodes(); ++s)
    {
      packed.Set(s, this->Panels[s].data());
    }
    return packed;
  }
};

/// @param widths  of the supernodes @param fill  share of the rows below that they reach
Blocks RandomBlocks(const std::vector<int>& widths, double fill, Meshes::Random& random)
{
  Blocks blocks;
  const int n = std::accumulate(widths.begin(), widths.end(), 0);
  for (const int width : widths)
  {
    const int first = blocks.Pattern.firstColumn.back();
    std::vector<int> rows;
    for (int i = first; i < n; ++i)
    {
      if (i < first + width || random.Unit() < fill)
      {
        rows.push_back(i);
      }
    }
    blocks.Add(rows, width, 1.0 / n, random);
  }
  blocks.Permute(random);
  return blocks;
}

void CheckSolve(const std::vector<int>& widths, double fill, Meshes::Random& random)
{
  const Blocks blocks = RandomBlocks(widths, fill, random);
  const MatrixXd L = blocks.Sparse();
  const auto n = static_cast<int>(L.rows());
  // Row k of P A P^T is row permutation[k] of A.
  const MatrixXd permuted = L * L.transpose();
  MatrixXd A(n, n);
  A(blocks.Pattern.permutation, blocks.Pattern.permutation) = permuted;
  RowMajor3 x(n, 3);
  for (int i = 0; i < n; ++i)
  {
    x.row(i) = random.InCube();
  }
  const auto check = [&](const auto& factor, double tolerance)
  {
    RowMajor3 solved = A * x;
    factor.Solve(solved);
    CHECK((solved - x).cwiseAbs().maxCoeff() <= tolerance,
      "supernodes of " << widths.front() << ".." << widths.back() << " columns, fill " << fill
                       << ": off by " << (solved - x).cwiseAbs().maxCoeff());
    RowMajor3 again = A * x;
    factor.Solve(again, 2);
    CHECK(again == solved, "a second solve, on two threads, should give the same bits");
  };
  check(blocks.Pack<double>(), 1e-13);
  check(blocks.Pack<float>(), 1e-5);
}

/// Leaves of a few columns that reach into one supernode at the end, as a tree of many subtrees.
Blocks Arrow(int leaves, int width, int top, Meshes::Random& random)
{
  Blocks blocks;
  const int n = leaves * width + top;
  for (int s = 0; s <= leaves; ++s)
  {
    std::vector<int> rows(s < leaves ? width : top);
    std::iota(rows.begin(), rows.end(), s * width);
    for (int i = n - top; s < leaves && i < n; ++i)
    {
      if (i == n - top || random.Unit() < 0.5)
      {
        rows.push_back(i);
      }
    }
    blocks.Add(rows, s < leaves ? width : top, 0.01, random);
  }
  blocks.Permute(random);
  return blocks;
}

void TestSubtrees()
{
  Meshes::Random random(2);
  const Blocks blocks = Arrow(3000, 3, 11, random);
  const SupernodalTasks tasks(blocks.Pattern);
  CHECK(tasks.GetSubtrees().size() > 10,
    "there should be subtrees, there are " << tasks.GetSubtrees().size());
  std::vector<int> covered(blocks.Pattern.GetNumberOfSupernodes(), 0);
  for (const SupernodalTasks::Range& range : tasks.GetSubtrees())
  {
    for (int s = range.first; s < range.last; ++s)
    {
      ++covered[s];
    }
  }
  for (const int s : tasks.GetTop())
  {
    ++covered[s];
  }
  CHECK(std::all_of(covered.begin(), covered.end(), [](int times) { return times == 1; }),
    "every supernode should be worked on once");

  const Eigen::SparseMatrix<double> L = blocks.Sparse();
  const int n = blocks.Pattern.GetNumberOfColumns();
  RowMajor3 x(n, 3);
  for (int i = 0; i < n; ++i)
  {
    x.row(i) = random.InCube();
  }
  const RowMajor3 permuted = L * (L.transpose() * x);
  RowMajor3 b(n, 3);
  RowMajor3 expected(n, 3);
  b(blocks.Pattern.permutation, AllColumns) = permuted;
  expected(blocks.Pattern.permutation, AllColumns) = x;
  const auto check = [&](const auto& packed, double tolerance)
  {
    RowMajor3 first;
    for (const int threads : { 1, 2, 3, 16 })
    {
      RowMajor3 solved = b;
      packed.Solve(solved, threads);
      CHECK((solved - expected).cwiseAbs().maxCoeff() <= tolerance,
        "off by " << (solved - expected).cwiseAbs().maxCoeff());
      first = threads == 1 ? solved : first;
      CHECK(solved == first, threads << " threads should give the same bits as one");
    }
  };
  check(blocks.Pack<double>(), 1e-12);
  check(blocks.Pack<float>(), 1e-4);
}

/// Springs between points, each also held a little: positive definite.
SparseCholesky::Matrix Springs(int n, const std::vector<std::pair<int, int>>& pairs)
{
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i)
  {
    entries.emplace_back(i, i, 0.01);
  }
  for (const auto& [u, v] : pairs)
  {
    entries.emplace_back(u, u, 1.0);
    entries.emplace_back(v, v, 1.0);
    entries.emplace_back(std::max(u, v), std::min(u, v), -1.0);
  }
  SparseCholesky::Matrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

/// On a sheet of triangles, or a tube of them, from point `first` on.
std::vector<std::pair<int, int>> GridPairs(int first, int around, int along, bool tube)
{
  std::vector<std::pair<int, int>> pairs;
  for (int i = 0; i < along; ++i)
  {
    for (int j = 0; j < around; ++j)
    {
      const auto add = [&](int k, int l)
      {
        if ((tube || l < around) && k < along)
        {
          pairs.emplace_back(first + i * around + j, first + k * around + l % around);
        }
      };
      add(i, j + 1);
      add(i + 1, j);
      add(i + 1, j + 1);
    }
  }
  return pairs;
}

void CheckSystem(const char* name, const SparseCholesky::Matrix& A)
{
  SparseCholesky cholesky;
  cholesky.Analyze(A);
  cholesky.Factor(A);
  Meshes::Random random(3);
  SparseCholesky::RightHandSides x(A.rows(), 3);
  for (Eigen::Index i = 0; i < x.rows(); ++i)
  {
    x.row(i) = random.InCube();
  }
  const SparseCholesky::RightHandSides b = A.selfadjointView<Eigen::Lower>() * x;
  SparseCholesky::RightHandSides first;
  for (const int threads : { 1, 2, 5 })
  {
    SparseCholesky::RightHandSides solved = b;
    cholesky.Solve(solved, threads);
    CHECK((solved - x).cwiseAbs().maxCoeff() <= 1e-11,
      name << ": off by " << (solved - x).cwiseAbs().maxCoeff());
    first = threads == 1 ? solved : first;
    CHECK(solved == first, name << ": " << threads << " threads should give the same bits as one");
  }
}

/// Trees of all forms: nested parts; a chain with a subtree at each link, as of a wire; and very
/// many that have nothing to do with each other beside a large one. For the last two, rows of the
/// top for each subtree would be terabytes.
void TestTrees()
{
  CheckSystem("a sheet", Springs(120 * 120, GridPairs(0, 120, 120, false)));
  CheckSystem("a tube", Springs(8 * 60000, GridPairs(0, 8, 60000, true)));

  const int loose = 200000;
  const int side = 300;
  std::vector<std::pair<int, int>> pairs = GridPairs(2 * loose, side, side, false);
  for (int i = 0; i < loose; ++i)
  {
    pairs.emplace_back(2 * i, 2 * i + 1);
  }
  const SparseCholesky::Matrix A = Springs(2 * loose + side * side, pairs);
  const SupernodalTasks tasks{ SupernodalPattern(A) };
  CHECK(tasks.GetSubtrees().size() > 4 && tasks.GetSubtrees().size() < 100,
    "small subtrees should be taken together, there are " << tasks.GetSubtrees().size());
  CheckSystem("many parts", A);
}
}

int main()
{
  TestSubtrees();
  TestTrees();
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
