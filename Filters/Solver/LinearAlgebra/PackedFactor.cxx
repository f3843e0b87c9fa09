// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "PackedFactor.h"

#include "AlignedArray.h"
#include "Parallel.h"
#include "UnitScale.h"
#include "Vector4.h"

#include <algorithm>
#include <type_traits>
#include <vector>

namespace SphericalStyle
{
namespace
{
constexpr int TileRows = SupernodePanel::TileRows;
constexpr int BlockColumns = 4;
constexpr int PointSize = 4;
constexpr int InverseSize = BlockColumns * BlockColumns;
constexpr int TileValues = TileRows * BlockColumns;

template <typename Scalar>
struct VectorsOf;

template <>
struct VectorsOf<float>
{
  using Rows = Float8;
  using Point = Float4;
};

template <>
struct VectorsOf<double>
{
  using Rows = Vector8;
  using Point = Vector4;
};

/// The same number of the eight rows of a tile.
template <typename Scalar>
using EightRows = typename VectorsOf<Scalar>::Rows;
/// A row of X: three numbers and one more.
template <typename Scalar>
using Point = typename VectorsOf<Scalar>::Point;

/// A supernode. Its slots are the rows of its panel.
struct Node : SupernodePanel
{
  using SupernodePanel::SupernodePanel;

  int firstColumn = 0;
  std::size_t firstSlot = 0; // in the lists of what row of X each slot is
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
    count += InverseSize + static_cast<std::size_t>(node.tiles - FirstTile(node, j)) * TileValues;
  }
  return count;
}

template <typename Scalar>
struct Packed
{
  std::vector<Node> nodes;
  std::vector<int> slots;   // row of X of each slot; its size where there is none
  std::vector<int> targets; // row of X that forward substitution adds each slot to: see Part
  AlignedArray<Scalar> values;

  std::size_t EndOfValues(int s) const
  {
    return s + 1 < static_cast<int>(this->nodes.size()) ? this->nodes[s + 1].firstValue
                                                        : this->values.GetSize();
  }
};

/// A subtree, and what it works in. Several subtrees add to rows of the top: each to rows of X of
/// its own first, after those of the columns and of what is no row.
struct Part
{
  SupernodalTasks::Range supernodes;
  std::vector<int> columns;     // of the top that it adds to
  int firstRow = 0;             // of its own in X, one for each of the columns
  std::ptrdiff_t firstTile = 0; // of one supernode at a time
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
    for (int tile = FirstTile(node, j); tile < node.tiles; ++tile, out += TileValues)
    {
      const double* from = panel + node.GetOffset(tile, j);
      std::transform(
        from, from + TileValues, out, [](double value) { return static_cast<Scalar>(value); });
      if (tile == j / TileRows) // the rows of the triangle are in it, too
      {
        for (int k = 0; k < TileValues; ++k)
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
    node.firstSlot = packed.slots.size();
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
  packed.targets = packed.slots;
  packed.values.Resize(size);
}

/// Gives a subtree rows of its own, from firstRow on. @param ownRow  of each column, where it had
/// one last
template <typename Scalar>
void SetTargets(Packed<Scalar>& packed, std::vector<int>& ownRow, Part& part)
{
  const Node& root = packed.nodes[part.supernodes.last - 1];
  const int beyond = root.firstColumn + root.columns;
  for (int s = part.supernodes.first; s < part.supernodes.last; ++s)
  {
    const Node& node = packed.nodes[s];
    int* below = packed.targets.data() + node.firstSlot + node.ownTiles * TileRows;
    for (int* target = below; target != below + node.rowsBelow; ++target)
    {
      if (const int column = *target; column >= beyond)
      {
        if (ownRow[column] < part.firstRow)
        {
          ownRow[column] = part.firstRow + static_cast<int>(part.columns.size());
          part.columns.push_back(column);
        }
        *target = ownRow[column];
      }
    }
  }
}

//---------------------------------------------------------------------------------------- solving
/// x, y and z of the eight rows of a tile.
template <typename Scalar>
SPHERICALSTYLE_INLINE void Gather(const Point<Scalar>* X, const int* slot, EightRows<Scalar>* w)
{
  const Point<Scalar>& a = X[slot[0]];
  const Point<Scalar>& b = X[slot[1]];
  const Point<Scalar>& c = X[slot[2]];
  const Point<Scalar>& d = X[slot[3]];
  const Point<Scalar>& e = X[slot[4]];
  const Point<Scalar>& f = X[slot[5]];
  const Point<Scalar>& g = X[slot[6]];
  const Point<Scalar>& h = X[slot[7]];
  for (int k = 0; k < 3; ++k)
  {
    w[k] = EightRows<Scalar>{ a[k], b[k], c[k], d[k], e[k], f[k], g[k], h[k] };
  }
}

/// X := L^-1 X for the columns of one supernode. @param w  room for three vectors a tile
template <typename Scalar>
SPHERICALSTYLE_INLINE void SolveForward(
  const Packed<Scalar>& L, int s, Point<Scalar>* X, EightRows<Scalar>* w)
{
  const Node& node = L.nodes[s];
  const int* slot = L.slots.data() + node.firstSlot;
  for (int t = 0; t < node.ownTiles; ++t)
  {
    Gather<Scalar>(X, slot + t * TileRows, w + 3 * t);
  }
  std::fill(w + 3 * node.ownTiles, w + 3 * node.tiles, EightRows<Scalar>{});
  const Scalar* values = L.values.Get() + node.firstValue;
  for (int j = 0; j < node.columns; j += BlockColumns)
  {
    EightRows<Scalar> y[3][BlockColumns];
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
        y[k][i] = EightRows<Scalar>{} + sum;
      }
    }
    const int width = std::min(BlockColumns, node.columns - j);
    std::copy(solved, solved + width, X + node.firstColumn + j);
    values += InverseSize;
    for (int t = FirstTile(node, j); t < node.tiles; ++t, values += TileValues)
    {
      const auto* c = reinterpret_cast<const EightRows<Scalar>*>(values);
      for (int k = 0; k < 3; ++k)
      {
        w[3 * t + k] -= c[0] * y[k][0] + c[1] * y[k][1] + c[2] * y[k][2] + c[3] * y[k][3];
      }
    }
  }
  const int* below = L.targets.data() + node.firstSlot + node.ownTiles * TileRows;
  for (int i = 0; i < node.rowsBelow; ++i)
  {
    const auto* added =
      reinterpret_cast<Scalar*>(w + 3 * (node.ownTiles + i / TileRows)) + i % TileRows;
    X[below[i]] += Point<Scalar>{ added[0], added[TileRows], added[2 * TileRows], 0 };
  }
}

/// X := L^-T X for the columns of one supernode.
template <typename Scalar>
SPHERICALSTYLE_INLINE void SolveBackward(
  const Packed<Scalar>& L, int s, Point<Scalar>* X, EightRows<Scalar>* w)
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
    EightRows<Scalar> sum[3][BlockColumns] = {};
    for (int t = node.tiles - 1; t >= FirstTile(node, j); --t) // addresses only ever fall
    {
      values -= TileValues;
      const auto* c = reinterpret_cast<const EightRows<Scalar>*>(values);
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
      Scalar* own = reinterpret_cast<Scalar*>(w + 3 * (j / TileRows) + k) + j % TileRows;
      const Point<Scalar> right = Load4(own) - SumEach<Point<Scalar>>(sum[k]);
      y[k] = Load4(values) * right[0] + Load4(values + BlockColumns) * right[1] +
        Load4(values + 2 * BlockColumns) * right[2] + Load4(values + 3 * BlockColumns) * right[3];
      Store4(own, y[k]);
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
  const Packed<Scalar>& L, SupernodalTasks::Range range, Point<Scalar>* X, EightRows<Scalar>* w)
{
  for (int s = range.first; s < range.last; ++s)
  {
    SolveForward(L, s, X, w);
  }
}

template <typename Scalar>
SPHERICALSTYLE_INLINE void SolveBackward(
  const Packed<Scalar>& L, SupernodalTasks::Range range, Point<Scalar>* X, EightRows<Scalar>* w)
{
  for (int s = range.last - 1; s >= range.first; --s)
  {
    SolveBackward(L, s, X, w);
  }
}

/// Up the top and down again.
template <typename Scalar>
SPHERICALSTYLE_INLINE void SolveTop(
  const Packed<Scalar>& L, const std::vector<int>& top, Point<Scalar>* X, EightRows<Scalar>* w)
{
  for (const int s : top)
  {
    SolveForward<Scalar>(L, s, X, w);
  }
  for (auto s = top.rbegin(); s != top.rend(); ++s)
  {
    SolveBackward<Scalar>(L, *s, X, w);
  }
}

// Templates cannot be compiled once per instruction set; these are.
#define SPHERICALSTYLE_COMPILE_SOLVES(Scalar)                                                      \
  SPHERICALSTYLE_PER_INSTRUCTION_SET void ForwardSubtree(                                          \
    const Packed<Scalar>& L, SupernodalTasks::Range range, Point<Scalar>* X, EightRows<Scalar>* w) \
  {                                                                                                \
    SolveForward<Scalar>(L, range, X, w);                                                          \
  }                                                                                                \
  SPHERICALSTYLE_PER_INSTRUCTION_SET void BackwardSubtree(                                         \
    const Packed<Scalar>& L, SupernodalTasks::Range range, Point<Scalar>* X, EightRows<Scalar>* w) \
  {                                                                                                \
    SolveBackward<Scalar>(L, range, X, w);                                                         \
  }                                                                                                \
  SPHERICALSTYLE_PER_INSTRUCTION_SET void UpAndDownTop(                                            \
    const Packed<Scalar>& L, const std::vector<int>& top, Point<Scalar>* X, EightRows<Scalar>* w)  \
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

  void MakeParts();
  int CountTiles(SupernodalTasks::Range range) const;

  SupernodalTasks tasks;
  std::vector<int> permutation;
  std::vector<Part> parts;
  std::ptrdiff_t firstTopTile = 0;
  // Kept between solves: X, a row of zeros and the rows of the subtrees; and for each subtree and
  // for the top, the tiles of one supernode.
  AlignedArray<Scalar> X;
  AlignedArray<Scalar> tiles;
};

template <typename Scalar>
int PackedFactor<Scalar>::Data::CountTiles(SupernodalTasks::Range range) const
{
  int most = 0;
  for (int s = range.first; s < range.last; ++s)
  {
    most = std::max(most, this->nodes[s].tiles);
  }
  return most;
}

template <typename Scalar>
void PackedFactor<Scalar>::Data::MakeParts()
{
  const auto n = static_cast<int>(this->permutation.size());
  std::vector<int> ownRow(n, 0);
  int row = n + 1;
  for (const SupernodalTasks::Range& range : this->tasks.GetSubtrees())
  {
    Part part;
    part.supernodes = range;
    part.firstRow = row;
    part.firstTile = this->firstTopTile;
    SetTargets<Scalar>(*this, ownRow, part);
    row += static_cast<int>(part.columns.size());
    this->firstTopTile += this->CountTiles(range);
    this->parts.push_back(std::move(part));
  }
  int most = 0;
  for (const int s : this->tasks.GetTop())
  {
    most = std::max(most, this->nodes[s].tiles);
  }
  this->X.Resize(PointSize * static_cast<std::size_t>(row));
  this->tiles.Resize(3 * TileRows * static_cast<std::size_t>(this->firstTopTile + most));
}

template <typename Scalar>
PackedFactor<Scalar>::PackedFactor(const SupernodalPattern& pattern)
  : D(std::make_unique<Data>(pattern))
{
  LayOut<Scalar>(pattern, *this->D);
  this->D->MakeParts();
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
  const auto count = static_cast<int>(d.parts.size());
  auto* X = reinterpret_cast<Point<Scalar>*>(d.X.Get());
  const auto tiles = [&d](std::ptrdiff_t first)
  { return reinterpret_cast<EightRows<Scalar>*>(d.tiles.Get()) + 3 * first; };

  // Into the range of single precision.
  const double scale = std::is_same_v<Scalar, double> ? 1.0 : UnitScale(B);
  X[n] = Point<Scalar>{};
  ParallelFor(n, threads,
    [&](int begin, int end)
    {
      for (int k = begin; k < end; ++k)
      {
        const Eigen::RowVector3d row = scale * B.row(d.permutation[k]);
        X[k] = Point<Scalar>{ static_cast<Scalar>(row[0]), static_cast<Scalar>(row[1]),
          static_cast<Scalar>(row[2]), 0 };
      }
    });
  ParallelTasks(count, threads,
    [&](int k)
    {
      const Part& part = d.parts[k];
      std::fill_n(X + part.firstRow, part.columns.size(), Point<Scalar>{});
      ForwardSubtree(d, part.supernodes, X, tiles(part.firstTile));
    });
  for (const Part& part : d.parts)
  {
    const Point<Scalar>* added = X + part.firstRow;
    for (const int column : part.columns)
    {
      X[column] += *added++;
    }
  }
  UpAndDownTop(d, d.tasks.GetTop(), X, tiles(d.firstTopTile));
  ParallelTasks(count, threads,
    [&](int k) { BackwardSubtree(d, d.parts[k].supernodes, X, tiles(d.parts[k].firstTile)); });
  ParallelFor(n, threads,
    [&](int begin, int end)
    {
      for (int k = begin; k < end; ++k)
      {
        B.row(d.permutation[k]) = Eigen::RowVector3d(X[k][0], X[k][1], X[k][2]) / scale;
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
