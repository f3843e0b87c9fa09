// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SupernodalFactor.h"

#include "Parallel.h"
#include "Vector4.h"

#include <algorithm>
#include <cstddef>
#include <memory>

namespace SphericalStyle
{
namespace
{
constexpr int Width = 4; // columns worked on together; a row of x is loaded once for all of them

/// A dense block of the factor.
struct Supernode
{
  int columns;
  int rows;
  const double* values;
  const int* row; // of each row

  const double* Column(int j) const
  {
    return this->values + static_cast<std::ptrdiff_t>(j) * this->rows;
  }
};

SPHERICALSTYLE_INLINE Supernode At(const SupernodalFactor& L, int s)
{
  return { L.firstColumn[s + 1] - L.firstColumn[s], L.firstRow[s + 1] - L.firstRow[s],
    L.values + L.firstValue[s], L.rows + L.firstRow[s] };
}

/// Where what a supernode adds to later rows goes: to x, but to `top` where these belong to the top
/// and several subtrees add to them.
struct Sums
{
  Vector4* x;             // four numbers per row
  Vector4* top = nullptr; // by column of the top, or nullptr: all to x
  const int* topColumns = nullptr;
};

/// x := L^-1 x for the columns of one supernode. @param w  room for its rows
SPHERICALSTYLE_INLINE void SolveForward(
  const SupernodalFactor& L, int s, const Sums& sums, Vector4* w)
{
  const Supernode node = At(L, s);
  Vector4* own = sums.x + L.firstColumn[s];
  std::fill(w + node.columns, w + node.rows, Vector4{});
  std::copy(own, own + node.columns, w);
  int j = 0;
  for (; j + Width <= node.columns; j += Width)
  {
    const double* c[Width] = { node.Column(j), node.Column(j + 1), node.Column(j + 2),
      node.Column(j + 3) };
    for (int k = 0; k < Width; ++k)
    {
      for (int i = 0; i < k; ++i)
      {
        w[j + k] -= c[i][j + k] * w[j + i];
      }
      w[j + k] /= c[k][j + k];
    }
    const Vector4 y[Width] = { w[j], w[j + 1], w[j + 2], w[j + 3] };
    for (int i = j + Width; i < node.rows; ++i)
    {
      w[i] -= c[0][i] * y[0] + c[1][i] * y[1] + c[2][i] * y[2] + c[3][i] * y[3];
    }
  }
  for (; j < node.columns; ++j)
  {
    const double* c = node.Column(j);
    w[j] /= c[j];
    for (int i = j + 1; i < node.rows; ++i)
    {
      w[i] -= c[i] * w[j];
    }
  }
  std::copy(w, w + node.columns, own);
  for (int i = node.columns; i < node.rows; ++i)
  {
    const int row = node.row[i];
    const int top = sums.top ? sums.topColumns[row] : -1;
    (top < 0 ? sums.x[row] : sums.top[top]) += w[i];
  }
}

/// x := L^-T x for the columns of one supernode.
SPHERICALSTYLE_INLINE void SolveBackward(const SupernodalFactor& L, int s, Vector4* x, Vector4* w)
{
  const Supernode node = At(L, s);
  Vector4* own = x + L.firstColumn[s];
  std::copy(own, own + node.columns, w);
  for (int i = node.columns; i < node.rows; ++i)
  {
    w[i] = x[node.row[i]];
  }
  int j = node.columns;
  for (; j % Width != 0; --j)
  {
    const double* c = node.Column(j - 1);
    Vector4 sum = w[j - 1];
    for (int i = j; i < node.rows; ++i)
    {
      sum -= c[i] * w[i];
    }
    w[j - 1] = sum / c[j - 1];
  }
  for (j -= Width; j >= 0; j -= Width)
  {
    const double* c[Width] = { node.Column(j), node.Column(j + 1), node.Column(j + 2),
      node.Column(j + 3) };
    Vector4 y[Width] = { w[j], w[j + 1], w[j + 2], w[j + 3] };
    for (int i = j + Width; i < node.rows; ++i)
    {
      for (int k = 0; k < Width; ++k)
      {
        y[k] -= c[k][i] * w[i];
      }
    }
    for (int k = Width - 1; k >= 0; --k)
    {
      for (int i = k + 1; i < Width; ++i)
      {
        y[k] -= c[k][j + i] * y[i];
      }
      y[k] /= c[k][j + k];
      w[j + k] = y[k];
    }
  }
  std::copy(w, w + node.columns, own);
}

SPHERICALSTYLE_PER_INSTRUCTION_SET
void ForwardSubtree(
  const SupernodalFactor& L, SupernodalTasks::Range range, const Sums& sums, Vector4* w)
{
  for (int s = range.first; s < range.last; ++s)
  {
    SolveForward(L, s, sums, w);
  }
}

SPHERICALSTYLE_PER_INSTRUCTION_SET
void BackwardSubtree(
  const SupernodalFactor& L, SupernodalTasks::Range range, Vector4* x, Vector4* w)
{
  for (int s = range.last - 1; s >= range.first; --s)
  {
    SolveBackward(L, s, x, w);
  }
}

/// Up the top and down again.
SPHERICALSTYLE_PER_INSTRUCTION_SET
void SolveTop(const SupernodalFactor& L, const std::vector<int>& top, Vector4* x, Vector4* w)
{
  for (const int s : top)
  {
    SolveForward(L, s, { x }, w);
  }
  for (auto s = top.rbegin(); s != top.rend(); ++s)
  {
    SolveBackward(L, *s, x, w);
  }
}

// A subtree of less than a twelfth of the work is not cut further; below this many columns all is
// top, since starting threads would take longer.
constexpr double SmallestShare = 1.0 / 12.0;
constexpr int SmallestSize = 8192;

/// The supernode that holds the first row below each, -1 for none.
std::vector<int> Parents(const SupernodalFactor& L)
{
  std::vector<int> ofColumn(L.numberOfColumns);
  for (int s = 0; s < L.numberOfSupernodes; ++s)
  {
    std::fill(ofColumn.begin() + L.firstColumn[s], ofColumn.begin() + L.firstColumn[s + 1], s);
  }
  std::vector<int> parents(L.numberOfSupernodes, -1);
  for (int s = 0; s < L.numberOfSupernodes; ++s)
  {
    const Supernode node = At(L, s);
    if (node.rows > node.columns)
    {
      parents[s] = ofColumn[node.row[node.columns]];
    }
  }
  return parents;
}
}

SupernodalTasks::SupernodalTasks(const SupernodalFactor& L)
  : TopColumns(L.numberOfColumns, -1)
{
  const int count = L.numberOfSupernodes;
  const std::vector<int> parents = Parents(L);
  std::vector<double> work(count); // of the subtree
  std::vector<int> size(count);    // its supernodes
  std::vector<int> first(count);   // the first of them
  double total = 0.0;
  for (int s = 0; s < count; ++s)
  {
    first[s] = s;
  }
  for (int s = 0; s < count; ++s)
  {
    const Supernode node = At(L, s);
    const double own = static_cast<double>(node.rows) * node.columns;
    this->LargestNumberOfRows = std::max(this->LargestNumberOfRows, node.rows);
    total += own;
    work[s] += own;
    ++size[s];
    if (const int parent = parents[s]; parent >= 0)
    {
      work[parent] += work[s];
      size[parent] += size[s];
      first[parent] = std::min(first[parent], first[s]);
    }
  }
  const bool small = L.numberOfColumns < SmallestSize;
  for (int s = count - 1; s >= 0;)
  {
    const bool inOnePiece = first[s] + size[s] == s + 1; // as a postordered tree has it
    if (!small && inOnePiece && work[s] <= SmallestShare * total)
    {
      this->Subtrees.push_back({ first[s], s + 1 });
      s = first[s] - 1;
    }
    else
    {
      this->Top.push_back(s--);
    }
  }
  std::reverse(this->Top.begin(), this->Top.end());
  for (const int s : this->Top)
  {
    for (int column = L.firstColumn[s]; column < L.firstColumn[s + 1]; ++column)
    {
      this->TopColumns[column] = this->NumberOfTopColumns++;
    }
  }
}

void SolveSupernodal(const SupernodalFactor& factor, const SupernodalTasks& tasks,
  Eigen::Ref<Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>> B,
  std::vector<double>& work, int threads)
{
  const int n = factor.numberOfColumns;
  const auto& subtrees = tasks.GetSubtrees();
  const int count = static_cast<int>(subtrees.size());
  const int rows = tasks.GetLargestNumberOfRows();
  const int top = tasks.GetNumberOfTopColumns();
  // x; for each subtree the rows of one supernode and what it adds to the top; and for the top.
  const std::size_t size =
    n + static_cast<std::size_t>(count) * (static_cast<std::size_t>(rows) + top) + rows;
  work.resize(4 * size + 8); // and room to align
  void* memory = work.data();
  std::size_t space = work.size() * sizeof(double);
  auto* x =
    static_cast<Vector4*>(std::align(alignof(Vector4), size * sizeof(Vector4), memory, space));
  const auto scratch = [&](int k)
  { return x + n + static_cast<std::size_t>(k) * (static_cast<std::size_t>(rows) + top); };
  const auto sums = [&](int k) { return scratch(k) + rows; };

  ParallelFor(n, threads,
    [&](int begin, int end)
    {
      for (int k = begin; k < end; ++k)
      {
        const auto row = B.row(factor.permutation[k]);
        x[k] = Vector4{ row[0], row[1], row[2], 0.0 };
      }
    });
  ParallelTasks(count, threads,
    [&](int k)
    {
      std::fill(sums(k), sums(k) + top, Vector4{});
      ForwardSubtree(factor, subtrees[k], { x, sums(k), tasks.GetTopColumns().data() }, scratch(k));
    });
  for (const int s : tasks.GetTop())
  {
    for (int column = factor.firstColumn[s]; column < factor.firstColumn[s + 1]; ++column)
    {
      for (int k = 0; k < count; ++k)
      {
        x[column] += sums(k)[tasks.GetTopColumns()[column]];
      }
    }
  }
  SolveTop(factor, tasks.GetTop(), x, scratch(count));
  ParallelTasks(
    count, threads, [&](int k) { BackwardSubtree(factor, subtrees[k], x, scratch(k)); });
  ParallelFor(n, threads,
    [&](int begin, int end)
    {
      for (int k = begin; k < end; ++k)
      {
        auto row = B.row(factor.permutation[k]);
        row[0] = x[k][0];
        row[1] = x[k][1];
        row[2] = x[k][2];
      }
    });
}
} // namespace SphericalStyle
