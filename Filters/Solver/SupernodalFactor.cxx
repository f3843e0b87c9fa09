// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SupernodalFactor.h"

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

/// x := L^-1 x. @param x  four numbers per row @param w  room for the rows of one supernode
SPHERICALSTYLE_PER_INSTRUCTION_SET
void SolveForward(const SupernodalFactor& L, Vector4* x, Vector4* w)
{
  for (int s = 0; s < L.numberOfSupernodes; ++s)
  {
    const Supernode node = At(L, s);
    Vector4* own = x + L.firstColumn[s];
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
      x[node.row[i]] += w[i];
    }
  }
}

/// x := L^-T x.
SPHERICALSTYLE_PER_INSTRUCTION_SET
void SolveBackward(const SupernodalFactor& L, Vector4* x, Vector4* w)
{
  for (int s = L.numberOfSupernodes - 1; s >= 0; --s)
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
}

int LargestNumberOfRows(const SupernodalFactor& L)
{
  int rows = 0;
  for (int s = 0; s < L.numberOfSupernodes; ++s)
  {
    rows = std::max(rows, L.firstRow[s + 1] - L.firstRow[s]);
  }
  return rows;
}
}

void SolveSupernodal(const SupernodalFactor& factor,
  Eigen::Ref<Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>> B,
  std::vector<double>& work)
{
  const int n = factor.numberOfColumns;
  const std::size_t size = 4 * (static_cast<std::size_t>(n) + LargestNumberOfRows(factor));
  work.resize(size + 8); // and room to align
  void* memory = work.data();
  std::size_t space = work.size() * sizeof(double);
  auto* x =
    static_cast<Vector4*>(std::align(alignof(Vector4), size * sizeof(double), memory, space));
  for (int k = 0; k < n; ++k)
  {
    const auto row = B.row(factor.permutation[k]);
    x[k] = Vector4{ row[0], row[1], row[2], 0.0 };
  }
  SolveForward(factor, x, x + n);
  SolveBackward(factor, x, x + n);
  for (int k = 0; k < n; ++k)
  {
    auto row = B.row(factor.permutation[k]);
    row[0] = x[k][0];
    row[1] = x[k][1];
    row[2] = x[k][2];
  }
}
} // namespace SphericalStyle
