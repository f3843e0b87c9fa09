// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Patterns and numbers of Cholesky factors: L L^T against the matrix that was factored, the pattern
// against elimination on a dense matrix of zeros and ones.
#include "Check.h"
#include "Meshes.h"
#include "MultifrontalCholesky.h"

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include <algorithm>
#include <mutex>
#include <numeric>
#include <utility>

using namespace SphericalStyle;
using Eigen::MatrixXd;
using Edges = std::vector<std::pair<int, int>>;
using Matrix = SupernodalPattern::Matrix;

namespace
{
/// A Laplacian of random weights, held: positive definite.
Matrix FromEdges(int n, const Edges& edges, Meshes::Random& random)
{
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(n, 0.1);
  for (const auto& [u, v] : edges)
  {
    const double weight = 0.5 + random.Unit();
    entries.emplace_back(std::max(u, v), std::min(u, v), -weight);
    diagonal[u] += weight;
    diagonal[v] += weight;
  }
  for (int i = 0; i < n; ++i)
  {
    entries.emplace_back(i, i, diagonal[i]);
  }
  Matrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

/// Of a mesh of squares with one diagonal each; neighbors across the border if it is closed.
Edges GridEdges(int side, bool closed)
{
  Edges edges;
  for (int i = 0; i < side; ++i)
  {
    for (int j = 0; j < side; ++j)
    {
      for (const auto& [di, dj] : Edges{ { 1, 0 }, { 0, 1 }, { 1, 1 } })
      {
        if (closed || (i + di < side && j + dj < side))
        {
          edges.emplace_back(i * side + j, (i + di) % side * side + (j + dj) % side);
        }
      }
    }
  }
  return edges;
}

struct Factor
{
  bool definite = false;
  std::vector<std::vector<double>> panels;
};

Factor Run(const Matrix& A, const SupernodalPattern& pattern, int threads = 1,
  InstructionSet set = InstructionSet::Best)
{
  Factor factor;
  std::vector<int> times(pattern.GetNumberOfSupernodes(), 0);
  factor.panels.resize(times.size());
  std::mutex mutex;
  factor.definite = MultifrontalCholesky(
    A, pattern, SupernodalTasks(pattern), threads,
    [&](int s, const double* panel)
    {
      const std::lock_guard lock(mutex);
      const SupernodePanel layout(pattern.GetColumns(s), pattern.GetRowsBelow(s));
      factor.panels[s].assign(panel, panel + layout.GetSize());
      ++times[s];
    },
    set);
  CHECK(!factor.definite ||
      std::all_of(times.begin(), times.end(), [](int count) { return count == 1; }),
    "every supernode should be handed over once");
  return factor;
}

/// Calls body(row, column, value) for every number of L that means something.
template <typename Body>
void ForEach(const SupernodalPattern& pattern, const Factor& factor, const Body& body)
{
  for (int s = 0; s < pattern.GetNumberOfSupernodes(); ++s)
  {
    const SupernodePanel layout(pattern.GetColumns(s), pattern.GetRowsBelow(s));
    for (int j = 0; j < layout.columns; ++j)
    {
      for (int k = j; k < pattern.GetRows(s); ++k)
      {
        const int slot = k < layout.columns ? k : 8 * layout.ownTiles + k - layout.columns;
        body(pattern.rows[pattern.firstRow[s] + k], pattern.firstColumn[s] + j,
          factor.panels[s][layout.GetOffset(slot / 8, j) + slot % 8]);
      }
    }
  }
}

/// What the numbers of a factor promise beside themselves: zeros where slots stand for no row.
void CheckPadding(const SupernodalPattern& pattern, const Factor& factor)
{
  for (int s = 0; s < pattern.GetNumberOfSupernodes(); ++s)
  {
    const SupernodePanel layout(pattern.GetColumns(s), pattern.GetRowsBelow(s));
    bool zero = true;
    for (int tile = 0; tile < layout.tiles; ++tile)
    {
      const int row = 8 * (tile < layout.ownTiles ? tile : tile - layout.ownTiles);
      const int rows = tile < layout.ownTiles ? layout.columns : layout.rowsBelow;
      for (int j = 0; j < 8 * layout.ownTiles; ++j)
      {
        for (int r = 0; r < 8; ++r)
        {
          const bool used = row + r < rows && j < layout.columns;
          zero = zero && (used || factor.panels[s][layout.GetOffset(tile, j) + r] == 0.0);
        }
      }
    }
    CHECK(zero, "supernode " << s << " should be filled up with zeros");
  }
}

/// The pattern is a factor's: with every row that elimination fills, ascending, parents last.
void CheckPattern(const Matrix& A, const SupernodalPattern& pattern)
{
  const int n = pattern.GetNumberOfColumns();
  CHECK(n == A.rows() && pattern.firstColumn.back() == n, "every column should be there");
  std::vector<int> sorted = pattern.permutation;
  std::sort(sorted.begin(), sorted.end());
  std::vector<int> all(n);
  std::iota(all.begin(), all.end(), 0);
  CHECK(sorted == all, "the permutation should be one");

  const MatrixXd dense = MatrixXd(A).selfadjointView<Eigen::Lower>();
  MatrixXd filled = dense(pattern.permutation, pattern.permutation)
                      .unaryExpr([](double x) { return x != 0.0 ? 1.0 : 0.0; });
  for (int j = 0; j < n; ++j)
  {
    for (int i = j + 1; i < n; ++i)
    {
      if (filled(i, j) != 0.0)
      {
        filled.col(i).tail(n - i) = filled.col(i).tail(n - i).cwiseMax(filled.col(j).tail(n - i));
      }
    }
  }
  const std::vector<int> parents = pattern.GetParents();
  std::vector<int> first(parents.size()); // supernode of the subtree
  for (int s = 0; s < pattern.GetNumberOfSupernodes(); ++s)
  {
    first[s] = s;
    const auto begin = pattern.rows.begin() + pattern.firstRow[s];
    const auto end = pattern.rows.begin() + pattern.firstRow[s + 1];
    CHECK(std::is_sorted(begin, end), "rows should be ascending");
    CHECK(std::adjacent_find(begin, end) == end, "rows should be there once");
    MatrixXd covered = MatrixXd::Zero(n, 1);
    std::for_each(begin, end, [&](int row) { covered(row) = 1.0; });
    double zeros = 0.0;
    double all = 0.0;
    for (int j = 0; j < pattern.GetColumns(s); ++j)
    {
      const int column = pattern.firstColumn[s] + j;
      CHECK(begin[j] == column, "a supernode's columns should be its first rows");
      const Eigen::ArrayXd missing =
        filled.col(column).tail(n - column) - covered.bottomRows(n - column);
      CHECK((missing <= 0.0).all(), "column " << column << " should have every row it needs");
      zeros -= missing.sum();
      all += covered.bottomRows(n - column).sum();
    }
    const int columns = pattern.GetColumns(s);
    const double most = columns <= 8 ? 1.0 : columns <= 16 ? 0.3 : columns <= 48 ? 0.1 : 0.05;
    CHECK(zeros < most * all,
      columns << " columns should not have " << zeros << " zeros among " << all << " numbers");
  }
  for (int s = 0; s < pattern.GetNumberOfSupernodes(); ++s)
  {
    CHECK(parents[s] < 0 || parents[s] > s, "parents should come after their children");
  }
  for (int s = 0; s < pattern.GetNumberOfSupernodes(); ++s)
  {
    if (parents[s] >= 0)
    {
      first[parents[s]] = std::min(first[parents[s]], first[s]);
    }
  }
  for (int s = 0; s < pattern.GetNumberOfSupernodes(); ++s)
  {
    for (int k = first[s]; k < s; ++k)
    {
      int ancestor = k;
      while (ancestor >= 0 && ancestor < s)
      {
        ancestor = parents[ancestor];
      }
      CHECK(ancestor == s, "descendants should stand together before supernode " << s);
    }
  }
}

void CheckFactor(const char* name, const Matrix& A, int threads = 1)
{
  const SupernodalPattern pattern(A);
  CheckPattern(A, pattern);
  const MatrixXd dense = MatrixXd(A).selfadjointView<Eigen::Lower>();
  const MatrixXd permuted = dense(pattern.permutation, pattern.permutation);
  for (const InstructionSet set :
    { InstructionSet::Best, InstructionSet::Avx2, InstructionSet::Baseline })
  {
    const Factor factor = Run(A, pattern, threads, set);
    CHECK(factor.definite, name << " is positive definite");
    if (!factor.definite)
    {
      return;
    }
    CheckPadding(pattern, factor);
    MatrixXd L = MatrixXd::Zero(A.rows(), A.rows());
    ForEach(pattern, factor, [&](int row, int column, double value) { L(row, column) = value; });
    const double error = (L * L.transpose() - permuted).cwiseAbs().maxCoeff();
    CHECK(error <= 1e-14 * dense.cwiseAbs().maxCoeff() * std::sqrt(A.rows()),
      name << ": off by " << error);
    CHECK((L.diagonal().array() > 0.0).all(), name << ": its diagonal should be positive");
  }
}

void TestShapes()
{
  Meshes::Random random(1);
  const auto check = [&](const char* name, int n, const Edges& edges)
  { CheckFactor(name, FromEdges(n, edges, random)); };
  const Matrix nothing(0, 0);
  const SupernodalPattern pattern(nothing);
  CHECK(pattern.GetNumberOfSupernodes() == 0, "nothing has no supernodes");
  CHECK(Run(nothing, pattern).definite, "nothing is positive definite");
  check("one row", 1, {});
  check("rows without any other", 50, {});
  check("a pair", 2, { { 0, 1 } });
  Edges chain, star, two;
  for (int i = 1; i < 100; ++i)
  {
    chain.emplace_back(i - 1, i);
    star.emplace_back(0, i);
    two.emplace_back(i % 2, i == 1 ? 2 : i);
  }
  check("a chain", 100, chain);
  check("a star", 100, star);
  check("two stars", 100, two);
  check("a grid", 19 * 19, GridEdges(19, false));
  check("a torus", 23 * 23, GridEdges(23, true));
  for (int n = 3; n < 40; ++n)
  {
    Edges complete;
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        complete.emplace_back(i, j);
      }
    }
    check("a full matrix", n, complete);
  }
  for (int density = 1; density < 8; ++density)
  {
    Edges edges;
    for (int i = 0; i < 60 * density; ++i)
    {
      const int u = static_cast<int>(random.Unit() * 120);
      const int v = static_cast<int>(random.Unit() * 120);
      if (u != v &&
        std::find(edges.begin(), edges.end(), std::pair(std::max(u, v), std::min(u, v))) ==
          edges.end())
      {
        edges.emplace_back(std::max(u, v), std::min(u, v));
      }
    }
    check("at random", 120, edges);
  }
}

/// Large enough for subtrees, and for fronts that several threads work on.
void TestThreads()
{
  Meshes::Random random(2);
  const auto check = [](const char* name, const Matrix& A, bool subtrees)
  {
    const SupernodalPattern pattern(A);
    CHECK((SupernodalTasks(pattern).GetSubtrees().size() > 4) == subtrees,
      name << " should" << (subtrees ? "" : " not") << " have subtrees");
    const Factor one = Run(A, pattern);
    CHECK(one.definite, name << " is positive definite");
    for (const int threads : { 2, 3, 16 })
    {
      CHECK(Run(A, pattern, threads).panels == one.panels,
        name << ": " << threads << " threads should give the same bits as one");
    }
  };
  check("a torus", FromEdges(150 * 150, GridEdges(150, true), random), true);
  const int n = 500;
  Edges complete;
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < i; ++j)
    {
      complete.emplace_back(i, j);
    }
  }
  const Matrix full = FromEdges(n, complete, random);
  check("a full matrix", full, false);
  CheckFactor("a full matrix of several threads", full, 4);
}

void TestIndefinite()
{
  Meshes::Random random(3);
  Matrix A = FromEdges(120 * 120, GridEdges(120, true), random);
  const SupernodalPattern pattern(A);
  for (const double where : { 0.0, 0.3, 0.7, 1.0 })
  {
    Matrix indefinite = A;
    const auto last = static_cast<double>(A.rows() - 1);
    const int row = pattern.permutation[static_cast<int>(where * last)];
    indefinite.coeffRef(row, row) = -1.0;
    for (const int threads : { 1, 3 })
    {
      CHECK(!Run(indefinite, pattern, threads).definite, "a negative diagonal should be found");
      indefinite.coeffRef(row, row) = std::nan("");
      CHECK(!Run(indefinite, pattern, threads).definite, "what is not a number should be found");
    }
  }
}
}

int main()
{
  TestShapes();
  TestThreads();
  TestIndefinite();
  return CheckResult();
}
