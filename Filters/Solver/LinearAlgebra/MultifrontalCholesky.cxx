// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "MultifrontalCholesky.h"

#include "AlignedArray.h"
#include "Parallel.h"
#include "Vector4.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace SphericalStyle
{
namespace
{
using Matrix = SupernodalPattern::Matrix;

constexpr int Tile = SupernodePanel::TileRows;
constexpr int TileSize = Tile * Tile;

/// The tiles of the rows below against each other, the lower triangle of them, row by row.
std::size_t UpdateOffset(int row, int column)
{
  return (static_cast<std::size_t>(row) * (row + 1) / 2 + column) * TileSize;
}

//----------------------------------------------------------------------------------------- fronts
/// One supernode while it is factored.
struct Front : SupernodePanel
{
  using SupernodePanel::SupernodePanel;

  SPHERICALSTYLE_INLINE double* At(int tile, int column) const
  {
    return this->panel + this->GetOffset(tile, column);
  }
  SPHERICALSTYLE_INLINE int GetWidth(int tile) const
  {
    return std::min(Tile, this->columns - tile * Tile);
  }
  int GetUpdateTiles() const { return this->tiles - this->ownTiles; }
  double GetOperations() const
  {
    return static_cast<double>(this->columns) * this->tiles * this->tiles * TileSize;
  }

  double* panel = nullptr;
  double* inverse = nullptr; // of the diagonal, by column
  double* update = nullptr;  // what is left for the parent: UpdateOffset
};

template <int Width>
struct VectorOf;

template <>
struct VectorOf<2>
{
  using Type = Vector2;
};

template <>
struct VectorOf<4>
{
  using Type = Vector4;
};

template <>
struct VectorOf<8>
{
  using Type = Vector8;
};

/// Eight numbers in registers: as many as that takes.
template <int Width>
struct Eight
{
  using Vector = typename VectorOf<Width>::Type;
  static constexpr int Parts = Tile / Width;

  SPHERICALSTYLE_INLINE void Load(const double* from)
  {
    for (int k = 0; k < Parts; ++k)
    {
      this->part[k] = reinterpret_cast<const Vector*>(from)[k];
    }
  }
  SPHERICALSTYLE_INLINE void Store(double* to) const
  {
    for (int k = 0; k < Parts; ++k)
    {
      reinterpret_cast<Vector*>(to)[k] = this->part[k];
    }
  }
  SPHERICALSTYLE_INLINE void Scale(double factor)
  {
    for (int k = 0; k < Parts; ++k)
    {
      this->part[k] *= factor;
    }
  }
  SPHERICALSTYLE_INLINE void Subtract(const Eight& x, double factor)
  {
    for (int k = 0; k < Parts; ++k)
    {
      this->part[k] -= x.part[k] * factor;
    }
  }

  Vector part[Parts];
};

/// What one instruction set works with. @tparam Width  of its vectors @tparam Columns  of a tile
/// that are worked on at once, so that their sums stay in registers
template <int Width, int Columns>
struct Kernel
{
  using Row = Eight<Width>;

  /// c -= a b^T for tiles of `depth` columns.
  SPHERICALSTYLE_INLINE static void SubtractProduct(
    const double* a, const double* b, int depth, double* c)
  {
    for (int first = 0; first < Tile; first += Columns)
    {
      Row sum[Columns];
      for (int q = 0; q < Columns; ++q)
      {
        sum[q].Load(c + (first + q) * Tile);
      }
      for (int p = 0; p < depth; ++p)
      {
        Row x;
        x.Load(a + p * Tile);
        for (int q = 0; q < Columns; ++q)
        {
          sum[q].Subtract(x, b[p * Tile + first + q]);
        }
      }
      for (int q = 0; q < Columns; ++q)
      {
        sum[q].Store(c + (first + q) * Tile);
      }
    }
  }

  /// Column j of c without what the columns before it take, by the triangle beside them.
  SPHERICALSTYLE_INLINE static Row WithoutBefore(const double* triangle, int j, const double* c)
  {
    Row x;
    x.Load(c + j * Tile);
    for (int q = 0; q < j; ++q)
    {
      Row before;
      before.Load(c + q * Tile);
      x.Subtract(before, triangle[q * Tile + j]);
    }
    return x;
  }

  /// c := c L^-T for the triangle L of `width` columns.
  SPHERICALSTYLE_INLINE static void SolveTile(
    const double* triangle, const double* inverse, int width, double* c)
  {
    for (int j = 0; j < width; ++j)
    {
      Row x = WithoutBefore(triangle, j, c);
      x.Scale(inverse[j]);
      x.Store(c + j * Tile);
    }
  }

  /// The triangle on the diagonal of an own tile row. False if it is not positive definite.
  SPHERICALSTYLE_INLINE static bool Diagonal(const Front& front, int tile)
  {
    double* c = front.At(tile, tile * Tile);
    const double* row = front.At(tile, 0);
    SubtractProduct(row, row, tile * Tile, c);
    const int width = front.GetWidth(tile);
    double* inverse = front.inverse + tile * Tile;
    for (int j = 0; j < width; ++j)
    {
      Row x = WithoutBefore(c, j, c);
      x.Store(c + j * Tile);
      const double pivot = c[j * Tile + j];
      if (!(pivot > 0.0))
      {
        return false;
      }
      inverse[j] = 1.0 / std::sqrt(pivot);
      x.Scale(inverse[j]);
      x.Store(c + j * Tile);
    }
    return true;
  }

  /// A tile under the diagonal of the columns of an own tile row.
  SPHERICALSTYLE_INLINE static void Below(const Front& front, int tile, int column)
  {
    double* c = front.At(tile, column * Tile);
    SubtractProduct(front.At(tile, 0), front.At(column, 0), column * Tile, c);
    SolveTile(
      front.At(column, column * Tile), front.inverse + column * Tile, front.GetWidth(column), c);
  }

  SPHERICALSTYLE_INLINE static void BelowRow(const Front& front, int tile)
  {
    for (int column = 0; column < front.ownTiles; ++column)
    {
      Below(front, tile, column);
    }
  }

  SPHERICALSTYLE_INLINE static void UpdateRow(const Front& front, int row)
  {
    const double* a = front.At(front.ownTiles + row, 0);
    for (int column = 0; column <= row; ++column)
    {
      SubtractProduct(a, front.At(front.ownTiles + column, 0), front.columns,
        front.update + UpdateOffset(row, column));
    }
  }

  SPHERICALSTYLE_INLINE static bool Whole(const Front& front)
  {
    for (int column = 0; column < front.ownTiles; ++column)
    {
      if (!Diagonal(front, column))
      {
        return false;
      }
      for (int tile = column + 1; tile < front.ownTiles; ++tile)
      {
        Below(front, tile, column);
      }
    }
    for (int tile = front.ownTiles; tile < front.tiles; ++tile)
    {
      BelowRow(front, tile);
      UpdateRow(front, tile - front.ownTiles);
    }
    return true;
  }
};

/// The steps of a front for one instruction set.
struct Steps
{
  bool (*Whole)(const Front&);
  bool (*Diagonal)(const Front&, int tile);
  void (*Below)(const Front&, int tile, int column);
  void (*BelowRow)(const Front&, int tile);
  void (*UpdateRow)(const Front&, int row);
};

// Templates cannot be compiled for an instruction set; these are.
#define SPHERICALSTYLE_COMPILE_STEPS(Name, Attribute, ...)                                         \
  namespace Name                                                                                   \
  {                                                                                                \
  using K = Kernel<__VA_ARGS__>;                                                                   \
  Attribute bool Whole(const Front& f)                                                             \
  {                                                                                                \
    return K::Whole(f);                                                                            \
  }                                                                                                \
  Attribute bool Diagonal(const Front& f, int tile)                                                \
  {                                                                                                \
    return K::Diagonal(f, tile);                                                                   \
  }                                                                                                \
  Attribute void Below(const Front& f, int tile, int column)                                       \
  {                                                                                                \
    K::Below(f, tile, column);                                                                     \
  }                                                                                                \
  Attribute void BelowRow(const Front& f, int tile)                                                \
  {                                                                                                \
    K::BelowRow(f, tile);                                                                          \
  }                                                                                                \
  Attribute void UpdateRow(const Front& f, int row)                                                \
  {                                                                                                \
    K::UpdateRow(f, row);                                                                          \
  }                                                                                                \
  constexpr Steps All = { Whole, Diagonal, Below, BelowRow, UpdateRow };                           \
  }

SPHERICALSTYLE_COMPILE_STEPS(Baseline, , 2, 2)
#ifdef SPHERICALSTYLE_INSTRUCTION_SETS
SPHERICALSTYLE_COMPILE_STEPS(Avx2, SPHERICALSTYLE_FOR_AVX2, 4, 4)
SPHERICALSTYLE_COMPILE_STEPS(Avx512, SPHERICALSTYLE_FOR_AVX512, 8, 8)
#endif
#undef SPHERICALSTYLE_COMPILE_STEPS

const Steps& StepsFor([[maybe_unused]] InstructionSet set)
{
#ifdef SPHERICALSTYLE_INSTRUCTION_SETS
  if (set == InstructionSet::Best && HasAvx512())
  {
    return Avx512::All;
  }
  if (set != InstructionSet::Baseline && HasAvx2())
  {
    return Avx2::All;
  }
#endif
  return Baseline::All;
}

//---------------------------------------------------------------------------------- factorization
constexpr double SmallestShared = 4e6; // operations of a front that is worth several threads

class Factorization
{
public:
  using Keep = std::function<void(int, const double*)>;

  Factorization(const Matrix& A, const SupernodalPattern& L, const Keep& keep, InstructionSet set)
    : L(L)
    , KeepPanel(keep)
    , Kernels(StepsFor(set))
    , FirstChild(L.GetNumberOfSupernodes(), -1)
    , NextSibling(L.GetNumberOfSupernodes(), -1)
    , Updates(L.GetNumberOfSupernodes())
    , A(A, L.permutation)
  {
    const std::vector<int> parents = L.GetParents();
    for (int s = L.GetNumberOfSupernodes() - 1; s >= 0; --s)
    {
      if (parents[s] >= 0)
      {
        this->NextSibling[s] = this->FirstChild[parents[s]];
        this->FirstChild[parents[s]] = s;
      }
    }
  }

  bool Run(const SupernodalTasks& tasks, int threads)
  {
    const std::vector<SupernodalTasks::Range>& subtrees = tasks.GetSubtrees();
    std::atomic<bool> definite = true;
    ParallelTasks(static_cast<int>(subtrees.size()), threads,
      [&](int k)
      {
        Room room;
        for (int s = subtrees[k].first; definite && s < subtrees[k].last; ++s)
        {
          if (!this->Factor(s, 1, room))
          {
            definite = false;
          }
        }
      });
    Room room;
    for (const int s : tasks.GetTop())
    {
      if (!definite || !this->Factor(s, threads, room))
      {
        return false;
      }
    }
    return definite;
  }

private:
  /// What a thread works in, kept from front to front.
  struct Room
  {
    AlignedArray<double> panel;
    std::vector<double> inverse;
    std::vector<int> slots;              // of the rows of a child
    std::vector<std::ptrdiff_t> offsets; // where those go
  };

  bool Factor(int s, int threads, Room& room)
  {
    Front front(this->L.GetColumns(s), this->L.GetRowsBelow(s));
    if (room.panel.GetSize() < front.GetSize())
    {
      room.panel.Resize(front.GetSize());
    }
    front.panel = room.panel.Get();
    std::fill_n(front.panel, front.GetSize(), 0.0);
    room.inverse.resize(
      std::max(room.inverse.size(), static_cast<std::size_t>(front.ownTiles) * Tile));
    front.inverse = room.inverse.data();
    AlignedArray<double>& update = this->Updates[s];
    update.Resize(UpdateOffset(front.GetUpdateTiles(), 0));
    front.update = update.Get();
    std::fill_n(front.update, update.GetSize(), 0.0);

    this->AddMatrix(s, front);
    for (int child = this->FirstChild[s]; child >= 0; child = this->NextSibling[child])
    {
      this->AddChild(s, child, front, threads, room);
      this->Updates[child] = {};
    }
    if (!this->Eliminate(front, threads))
    {
      return false;
    }
    this->KeepPanel(s, front.panel);
    return true;
  }

  /// Adds the columns of A.
  void AddMatrix(int s, const Front& front) const
  {
    const int first = this->L.firstColumn[s];
    const int* below = this->L.GetBelow(s);
    for (int j = 0; j < front.columns; ++j)
    {
      for (const auto* entry = this->A.Begin(first + j); entry != this->A.End(first + j); ++entry)
      {
        const int own = entry->row - first;
        const auto slot = own < front.columns ? own
                                              : front.ownTiles * Tile +
            (std::lower_bound(below, below + front.rowsBelow, entry->row) - below);
        front.At(static_cast<int>(slot / Tile), j)[slot % Tile] += entry->value;
      }
    }
  }

  /// Adds what a child has left for the rows of its parent.
  void AddChild(int s, int child, const Front& front, int threads, Room& room) const
  {
    const int count = this->L.GetRowsBelow(child);
    this->FindSlots(s, child, front, room);
    const int* slots = room.slots.data();
    const int ownSlots = front.ownTiles * Tile;
    // Rows are ascending, so the columns of the parent's own come first.
    const auto own = static_cast<int>(std::lower_bound(slots, slots + count, ownSlots) - slots);
    room.offsets.resize(2 * static_cast<std::size_t>(count));
    std::ptrdiff_t* inPanel = room.offsets.data();
    std::ptrdiff_t* inUpdate = inPanel + count;
    for (int i = 0; i < count; ++i)
    {
      inPanel[i] =
        static_cast<std::ptrdiff_t>(front.GetOffset(slots[i] / Tile, 0)) + slots[i] % Tile;
      const int below = slots[i] - ownSlots;
      inUpdate[i] =
        i < own ? 0 : static_cast<std::ptrdiff_t>(UpdateOffset(below / Tile, 0)) + below % Tile;
    }
    const double* update = this->Updates[child].Get();
    const int tiles = SupernodePanel::CountTiles(count);
    const auto add = [&](int column)
    {
      for (int j = column * Tile; j < std::min(column * Tile + Tile, count); ++j)
      {
        double* to = j < own ? front.panel + slots[j] * Tile
                             : front.update + (slots[j] - ownSlots) / Tile * TileSize +
            (slots[j] - ownSlots) % Tile * Tile;
        const std::ptrdiff_t* offsets = (j < own ? inPanel : inUpdate) + column * Tile;
        const double* from = update + UpdateOffset(column, column) + j % Tile * Tile;
        AddRows(from, offsets, j % Tile, std::min(Tile, count - column * Tile), to);
        for (int row = column + 1; row < tiles; ++row)
        {
          from += static_cast<std::ptrdiff_t>(row) * TileSize; // to the next row of the triangle
          offsets += Tile;
          if (const int rows = count - row * Tile; rows >= Tile)
          {
            AddRows(from, offsets, 0, Tile, to); // known when it is compiled: unrolled
          }
          else
          {
            AddRows(from, offsets, 0, rows, to);
          }
        }
      }
    };
    if (threads > 1 && static_cast<double>(count) * count > 0.01 * SmallestShared)
    {
      ParallelTasks(tiles, threads, add);
    }
    else
    {
      for (int column = 0; column < tiles; ++column)
      {
        add(column);
      }
    }
  }

  SPHERICALSTYLE_INLINE static void AddRows(
    const double* from, const std::ptrdiff_t* offsets, int begin, int end, double* to)
  {
    for (int r = begin; r < end; ++r)
    {
      to[offsets[r]] += from[r];
    }
  }

  /// The rows of the parent's front that those below a child are.
  void FindSlots(int s, int child, const Front& front, Room& room) const
  {
    const int count = this->L.GetRowsBelow(child);
    const int* rows = this->L.GetBelow(child);
    const int first = this->L.firstColumn[s];
    const int* below = this->L.GetBelow(s);
    room.slots.resize(count);
    int next = 0;
    for (int i = 0; i < count; ++i)
    {
      if (const int own = rows[i] - first; own < front.columns)
      {
        room.slots[i] = own;
        continue;
      }
      while (below[next] != rows[i])
      {
        ++next;
      }
      room.slots[i] = front.ownTiles * Tile + next;
    }
  }

  bool Eliminate(const Front& front, int threads) const
  {
    if (threads <= 1 || front.GetOperations() < SmallestShared)
    {
      return this->Kernels.Whole(front);
    }
    for (int column = 0; column < front.ownTiles; ++column)
    {
      if (!this->Kernels.Diagonal(front, column))
      {
        return false;
      }
      ParallelTasks(front.ownTiles - column - 1, threads,
        [&](int k) { this->Kernels.Below(front, column + 1 + k, column); });
    }
    const int below = front.GetUpdateTiles();
    ParallelTasks(
      below, threads, [&](int k) { this->Kernels.BelowRow(front, front.ownTiles + k); });
    // The long rows first: whoever is late then waits for a short one.
    ParallelTasks(below, threads, [&](int k) { this->Kernels.UpdateRow(front, below - 1 - k); });
    return true;
  }

  const SupernodalPattern& L;
  const Keep& KeepPanel;
  const Steps& Kernels;
  std::vector<int> FirstChild;
  std::vector<int> NextSibling;
  std::vector<AlignedArray<double>> Updates; // of the supernodes whose parents are still to come
  PermutedTriangle A;
};
}

bool MultifrontalCholesky(const Matrix& A, const SupernodalPattern& pattern,
  const SupernodalTasks& tasks, int threads,
  const std::function<void(int s, const double* panel)>& keep, InstructionSet set)
{
  return Factorization(A, pattern, keep, set).Run(tasks, threads);
}
} // namespace SphericalStyle
