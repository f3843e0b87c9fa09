// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PackedFactor.h"

#include "AlignedArray.h"
#include "Parallel.h"
#include "Vector4.h"

#include <algorithm>
#include <vector>

namespace SphericalStyle
{
namespace
{
constexpr int TileRows = SupernodePanel::TileRows;
constexpr int BlockColumns = 4;
constexpr int PointSize = 4;
constexpr int InverseSize = BlockColumns * BlockColumns;
constexpr int TileSize = TileRows * BlockColumns;

template <typename Scalar>
struct VectorsOf;

template <>
struct VectorsOf<float>
{
  using Rows = float __attribute__((vector_size(32), aligned(32)));
  using Point = float __attribute__((vector_size(16), aligned(16)));
  using Unaligned = float __attribute__((vector_size(16), aligned(4), may_alias));
};

template <>
struct VectorsOf<double>
{
  using Rows = double __attribute__((vector_size(64), aligned(64)));
  using Point = double __attribute__((vector_size(32), aligned(32)));
  using Unaligned = double __attribute__((vector_size(32), aligned(8), may_alias));
};

/// The same number of the eight rows of a tile.
template <typename Scalar>
using Rows = typename VectorsOf<Scalar>::Rows;
/// A row of X: three numbers and one more.
template <typename Scalar>
using Point = typename VectorsOf<Scalar>::Point;
template <typename Scalar>
using Unaligned = typename VectorsOf<Scalar>::Unaligned;

/// A supernode. Its slots are the rows of its panel.
struct Node : SupernodePanel
{
  using SupernodePanel::SupernodePanel;

  int firstColumn = 0;
  int firstSlot = 0; // in the list of what row of X each slot is
  std::size_t firstValue = 0;
};

/// The first tile that a block starting at this column of the node reaches below itself.
SPHERICALSTYLE_INLINE int FirstTile(const Node& node, int column)
{
  const int next = column + BlockColumns;
  return next < node.columns ? next / TileRows : node.ownTiles;
}

std::size_t CountValues(const Node& node)
{
  std::size_t count = 0;
  for (int j = 0; j < node.columns; j += BlockColumns)
  {
    count += InverseSize + static_cast<std::size_t>(node.tiles - FirstTile(node, j)) * TileSize;
  }
  return count;
}

template <typename Scalar>
struct Packed
{
  std::vector<Node> nodes;
  std::vector<int> slots; // row of X of each slot; its size where there is none
  AlignedArray<Scalar> values;

  std::size_t EndOfValues(int s) const
  {
    return s + 1 < static_cast<int>(this->nodes.size()) ? this->nodes[s + 1].firstValue
                                                        : this->values.GetSize();
  }
};

//---------------------------------------------------------------------------------------- packing
/// The inverse of a lower triangle of the block, filled up with the identity, row by row.
/// @param columns  of eight numbers each, at the first row of the triangle
template <typename Scalar>
void PackInverse(const double* columns, int width, Scalar* out)
{
  Eigen::Matrix4d triangle = Eigen::Matrix4d::Identity();
  for (int j = 0; j < width; ++j)
  {
    for (int i = j; i < width; ++i)
    {
      triangle(i, j) = columns[j * TileRows + i];
    }
  }
  const Eigen::Matrix4d inverse =
    triangle.triangularView<Eigen::Lower>().solve(Eigen::Matrix4d::Identity());
  Eigen::Map<Eigen::Matrix<Scalar, BlockColumns, BlockColumns, Eigen::RowMajor>> target(out);
  target = inverse.cast<Scalar>();
}

template <typename Scalar>
void PackNode(const Node& node, const double* panel, Scalar* out)
{
  for (int j = 0; j < node.columns; j += BlockColumns)
  {
    PackInverse(panel + node.GetOffset(j / TileRows, j) + j % TileRows,
      std::min(BlockColumns, node.columns - j), out);
    out += InverseSize;
    for (int tile = FirstTile(node, j); tile < node.tiles; ++tile, out += TileSize)
    {
      const double* from = panel + node.GetOffset(tile, j);
      std::transform(
        from, from + TileSize, out, [](double value) { return static_cast<Scalar>(value); });
      if (tile == j / TileRows) // the rows of the triangle are in it, too
      {
        for (int k = 0; k < TileSize; ++k)
        {
          out[k] = k % TileRows < BlockColumns ? Scalar(0) : out[k];
        }
      }
    }
  }
}

template <typename Scalar>
void LayOut(const SupernodalPattern& L, Packed<Scalar>& packed)
{
  packed.nodes.reserve(L.GetNumberOfSupernodes());
  std::size_t size = 0;
  for (int s = 0; s < L.GetNumberOfSupernodes(); ++s)
  {
    Node node(L.GetColumns(s), L.GetRowsBelow(s));
    node.firstColumn = L.firstColumn[s];
    node.firstSlot = static_cast<int>(packed.slots.size());
    node.firstValue = size;
    const auto add = [&](const int* first, int count)
    {
      packed.slots.insert(packed.slots.end(), first, first + count);
      packed.slots.resize(
        packed.slots.size() + SupernodePanel::CountTiles(count) * TileRows - count,
        L.GetNumberOfColumns());
    };
    add(L.rows.data() + L.firstRow[s], node.columns);
    add(L.GetBelow(s), node.rowsBelow);
    size += CountValues(node);
    packed.nodes.push_back(node);
  }
  packed.values.Resize(size);
}

//---------------------------------------------------------------------------------------- solving
/// x, y and z of the eight rows of a tile.
template <typename Scalar>
SPHERICALSTYLE_INLINE void Gather(const Point<Scalar>* X, const int* slot, Rows<Scalar>* w)
{
  const Point<Scalar>&a = X[slot[0]], &b = X[slot[1]], &c = X[slot[2]], &d = X[slot[3]],
        &e = X[slot[4]], &f = X[slot[5]], &g = X[slot[6]], &h = X[slot[7]];
  for (int k = 0; k < 3; ++k)
  {
    w[k] = Rows<Scalar>{ a[k], b[k], c[k], d[k], e[k], f[k], g[k], h[k] };
  }
}

/// The sum of each of four.
template <typename Scalar>
SPHERICALSTYLE_INLINE Point<Scalar> SumRows(const Rows<Scalar>* a)
{
  Point<Scalar> half[BlockColumns];
  for (int i = 0; i < BlockColumns; ++i)
  {
    half[i] = __builtin_shufflevector(a[i], a[i], 0, 1, 2, 3) +
      __builtin_shufflevector(a[i], a[i], 4, 5, 6, 7);
  }
  const Point<Scalar> first = __builtin_shufflevector(half[0], half[1], 0, 4, 2, 6) +
    __builtin_shufflevector(half[0], half[1], 1, 5, 3, 7);
  const Point<Scalar> second = __builtin_shufflevector(half[2], half[3], 0, 4, 2, 6) +
    __builtin_shufflevector(half[2], half[3], 1, 5, 3, 7);
  return __builtin_shufflevector(first, second, 0, 1, 4, 5) +
    __builtin_shufflevector(first, second, 2, 3, 6, 7);
}

/// Where what a supernode adds to later rows goes: to X, but to `top` where these belong to the top
/// and several subtrees add to them.
template <typename Scalar>
struct Sums
{
  Point<Scalar>* X;
  Point<Scalar>* top = nullptr; // by column of the top, or nullptr: all to X
  const int* topColumns = nullptr;
};

/// X := L^-1 X for the columns of one supernode. @param w  room for three vectors a tile
template <typename Scalar>
SPHERICALSTYLE_INLINE void SolveForward(
  const Packed<Scalar>& L, int s, const Sums<Scalar>& sums, Rows<Scalar>* w)
{
  const Node& node = L.nodes[s];
  const int* slot = L.slots.data() + node.firstSlot;
  for (int t = 0; t < node.ownTiles; ++t)
  {
    Gather<Scalar>(sums.X, slot + t * TileRows, w + 3 * t);
  }
  std::fill(w + 3 * node.ownTiles, w + 3 * node.tiles, Rows<Scalar>{});
  const Scalar* values = L.values.Get() + node.firstValue;
  for (int j = 0; j < node.columns; j += BlockColumns)
  {
    Rows<Scalar> y[3][BlockColumns];
    Point<Scalar> solved[BlockColumns] = {};
    for (int k = 0; k < 3; ++k)
    {
      const Scalar* own = reinterpret_cast<Scalar*>(w + 3 * (j / TileRows) + k) + j % TileRows;
      for (int i = 0; i < BlockColumns; ++i)
      {
        Scalar sum = 0;
        for (int q = 0; q <= i; ++q)
        {
          sum += values[i * BlockColumns + q] * own[q];
        }
        solved[i][k] = sum;
        y[k][i] = Rows<Scalar>{} + sum;
      }
    }
    const int width = std::min(BlockColumns, node.columns - j);
    std::copy(solved, solved + width, sums.X + node.firstColumn + j);
    values += InverseSize;
    for (int t = FirstTile(node, j); t < node.tiles; ++t, values += TileSize)
    {
      const auto* c = reinterpret_cast<const Rows<Scalar>*>(values);
      for (int k = 0; k < 3; ++k)
      {
        w[3 * t + k] -= c[0] * y[k][0] + c[1] * y[k][1] + c[2] * y[k][2] + c[3] * y[k][3];
      }
    }
  }
  const int* below = slot + node.ownTiles * TileRows;
  for (int i = 0; i < node.rowsBelow; ++i)
  {
    const auto* added =
      reinterpret_cast<Scalar*>(w + 3 * (node.ownTiles + i / TileRows)) + i % TileRows;
    const int top = sums.top ? sums.topColumns[below[i]] : -1;
    (top < 0 ? sums.X[below[i]] : sums.top[top]) +=
      Point<Scalar>{ added[0], added[TileRows], added[2 * TileRows], 0 };
  }
}

/// X := L^-T X for the columns of one supernode.
template <typename Scalar>
SPHERICALSTYLE_INLINE void SolveBackward(
  const Packed<Scalar>& L, int s, Point<Scalar>* X, Rows<Scalar>* w)
{
  const Node& node = L.nodes[s];
  const int* slot = L.slots.data() + node.firstSlot;
  for (int t = 0; t < node.tiles; ++t)
  {
    Gather<Scalar>(X, slot + t * TileRows, w + 3 * t);
  }
  const Scalar* values = L.values.Get() + L.EndOfValues(s);
  for (int j = (node.columns - 1) / BlockColumns * BlockColumns; j >= 0; j -= BlockColumns)
  {
    Rows<Scalar> sum[3][BlockColumns] = {};
    for (int t = node.tiles - 1; t >= FirstTile(node, j); --t) // addresses only ever fall
    {
      values -= TileSize;
      const auto* c = reinterpret_cast<const Rows<Scalar>*>(values);
      for (int k = 0; k < 3; ++k)
      {
        for (int i = 0; i < BlockColumns; ++i)
        {
          sum[k][i] += c[i] * w[3 * t + k];
        }
      }
    }
    values -= InverseSize;
    Point<Scalar> y[3];
    for (int k = 0; k < 3; ++k)
    {
      const auto* inverse = reinterpret_cast<const Unaligned<Scalar>*>(values);
      auto* own = reinterpret_cast<Unaligned<Scalar>*>(
        reinterpret_cast<Scalar*>(w + 3 * (j / TileRows) + k) + j % TileRows);
      const Point<Scalar> right = *own - SumRows<Scalar>(sum[k]);
      y[k] = inverse[0] * right[0] + inverse[1] * right[1] + inverse[2] * right[2] +
        inverse[3] * right[3];
      *own = y[k];
    }
    const int width = std::min(BlockColumns, node.columns - j);
    for (int i = 0; i < width; ++i)
    {
      X[node.firstColumn + j + i] = Point<Scalar>{ y[0][i], y[1][i], y[2][i], 0 };
    }
  }
}

template <typename Scalar>
SPHERICALSTYLE_INLINE void SolveForward(
  const Packed<Scalar>& L, SupernodalTasks::Range range, const Sums<Scalar>& sums, Rows<Scalar>* w)
{
  for (int s = range.first; s < range.last; ++s)
  {
    SolveForward(L, s, sums, w);
  }
}

template <typename Scalar>
SPHERICALSTYLE_INLINE void SolveBackward(
  const Packed<Scalar>& L, SupernodalTasks::Range range, Point<Scalar>* X, Rows<Scalar>* w)
{
  for (int s = range.last - 1; s >= range.first; --s)
  {
    SolveBackward(L, s, X, w);
  }
}

/// Up the top and down again.
template <typename Scalar>
SPHERICALSTYLE_INLINE void SolveTop(
  const Packed<Scalar>& L, const std::vector<int>& top, Point<Scalar>* X, Rows<Scalar>* w)
{
  for (const int s : top)
  {
    SolveForward<Scalar>(L, s, { X }, w);
  }
  for (auto s = top.rbegin(); s != top.rend(); ++s)
  {
    SolveBackward<Scalar>(L, *s, X, w);
  }
}

// Templates cannot be compiled once per instruction set; these are.
#define SPHERICALSTYLE_COMPILE_SOLVES(Scalar)                                                      \
  SPHERICALSTYLE_PER_INSTRUCTION_SET void ForwardSubtree(const Packed<Scalar>& L,                  \
    SupernodalTasks::Range range, const Sums<Scalar>& sums, Rows<Scalar>* w)                       \
  {                                                                                                \
    SolveForward<Scalar>(L, range, sums, w);                                                       \
  }                                                                                                \
  SPHERICALSTYLE_PER_INSTRUCTION_SET void BackwardSubtree(                                         \
    const Packed<Scalar>& L, SupernodalTasks::Range range, Point<Scalar>* X, Rows<Scalar>* w)      \
  {                                                                                                \
    SolveBackward<Scalar>(L, range, X, w);                                                         \
  }                                                                                                \
  SPHERICALSTYLE_PER_INSTRUCTION_SET void UpAndDownTop(                                            \
    const Packed<Scalar>& L, const std::vector<int>& top, Point<Scalar>* X, Rows<Scalar>* w)       \
  {                                                                                                \
    SolveTop<Scalar>(L, top, X, w);                                                                \
  }

SPHERICALSTYLE_COMPILE_SOLVES(float)
SPHERICALSTYLE_COMPILE_SOLVES(double)
#undef SPHERICALSTYLE_COMPILE_SOLVES
}

//------------------------------------------------------------------------------------------------
template <typename Scalar>
struct PackedFactor<Scalar>::Data : Packed<Scalar>
{
  explicit Data(const SupernodalPattern& pattern)
    : tasks(pattern)
    , permutation(pattern.permutation)
  {
  }

  SupernodalTasks tasks;
  std::vector<int> permutation;
  int largestNumberOfTiles = 0;
  // Kept between solves: X and a row of zeros; and for each subtree and for the top, the tiles of
  // one supernode and what is to be added to the top.
  AlignedArray<Scalar> X;
  AlignedArray<Scalar> tiles;
  AlignedArray<Scalar> top;
};

template <typename Scalar>
PackedFactor<Scalar>::PackedFactor(const SupernodalPattern& pattern)
  : D(std::make_unique<Data>(pattern))
{
  Data& d = *this->D;
  LayOut<Scalar>(pattern, d);
  for (const Node& node : d.nodes)
  {
    d.largestNumberOfTiles = std::max(d.largestNumberOfTiles, node.tiles);
  }
  const std::size_t subtrees = d.tasks.GetSubtrees().size();
  d.X.Resize(PointSize * (d.permutation.size() + 1));
  d.tiles.Resize(3 * TileRows * (subtrees + 1) * d.largestNumberOfTiles);
  d.top.Resize(PointSize * subtrees * d.tasks.GetNumberOfTopColumns());
}

template <typename Scalar>
const SupernodalTasks& PackedFactor<Scalar>::GetTasks() const
{
  return this->D->tasks;
}

template <typename Scalar>
void PackedFactor<Scalar>::Set(int s, const double* panel)
{
  const Node& node = this->D->nodes[s];
  PackNode(node, panel, this->D->values.Get() + node.firstValue);
}

template <typename Scalar>
void PackedFactor<Scalar>::Solve(RightHandSides B, int threads) const
{
  const Data& d = *this->D;
  const auto n = static_cast<int>(d.permutation.size());
  const std::vector<SupernodalTasks::Range>& subtrees = d.tasks.GetSubtrees();
  const auto count = static_cast<int>(subtrees.size());
  const std::vector<int>& topColumns = d.tasks.GetTopColumns();
  auto* X = reinterpret_cast<Point<Scalar>*>(d.X.Get());
  const auto tiles = [&](std::ptrdiff_t k)
  { return reinterpret_cast<Rows<Scalar>*>(d.tiles.Get()) + 3 * k * d.largestNumberOfTiles; };
  const auto sums = [&](std::ptrdiff_t k)
  { return reinterpret_cast<Point<Scalar>*>(d.top.Get()) + k * d.tasks.GetNumberOfTopColumns(); };

  X[n] = Point<Scalar>{};
  ParallelFor(n, threads,
    [&](int begin, int end)
    {
      for (int k = begin; k < end; ++k)
      {
        const auto row = B.row(d.permutation[k]);
        X[k] = Point<Scalar>{ static_cast<Scalar>(row[0]), static_cast<Scalar>(row[1]),
          static_cast<Scalar>(row[2]), 0 };
      }
    });
  ParallelTasks(count, threads,
    [&](int k)
    {
      std::fill(sums(k), sums(k) + d.tasks.GetNumberOfTopColumns(), Point<Scalar>{});
      ForwardSubtree(d, subtrees[k], { X, sums(k), topColumns.data() }, tiles(k));
    });
  for (const int s : d.tasks.GetTop())
  {
    const Node& node = d.nodes[s];
    for (int column = node.firstColumn; column < node.firstColumn + node.columns; ++column)
    {
      for (int k = 0; k < count; ++k)
      {
        X[column] += sums(k)[topColumns[column]];
      }
    }
  }
  UpAndDownTop(d, d.tasks.GetTop(), X, tiles(count));
  ParallelTasks(count, threads, [&](int k) { BackwardSubtree(d, subtrees[k], X, tiles(k)); });
  ParallelFor(n, threads,
    [&](int begin, int end)
    {
      for (int k = begin; k < end; ++k)
      {
        B.row(d.permutation[k]) = Eigen::RowVector3d(X[k][0], X[k][1], X[k][2]);
      }
    });
}

template <typename Scalar>
std::size_t PackedFactor<Scalar>::GetMemorySize(const SupernodalPattern& pattern)
{
  std::size_t size = 0;
  for (int s = 0; s < pattern.GetNumberOfSupernodes(); ++s)
  {
    size += CountValues(Node(pattern.GetColumns(s), pattern.GetRowsBelow(s)));
  }
  return size * sizeof(Scalar);
}

template <typename Scalar>
PackedFactor<Scalar>::PackedFactor() = default;
template <typename Scalar>
PackedFactor<Scalar>::~PackedFactor() = default;
template <typename Scalar>
PackedFactor<Scalar>::PackedFactor(PackedFactor&&) noexcept = default;
template <typename Scalar>
PackedFactor<Scalar>& PackedFactor<Scalar>::operator=(PackedFactor&&) noexcept = default;

template class PackedFactor<float>;
template class PackedFactor<double>;
} // namespace SphericalStyle
