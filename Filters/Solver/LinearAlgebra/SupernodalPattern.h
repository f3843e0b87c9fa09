// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The pattern of a supernodal Cholesky factor, and which parts can be worked on at the same time.
#ifndef SphericalStyle_SupernodalPattern_h
#define SphericalStyle_SupernodalPattern_h

#include <Eigen/SparseCore>

#include <cstddef>
#include <vector>

namespace SphericalStyle
{
/// P A P^T = L L^T with L in supernodes: neighboring columns with nonzeros in the same rows.
///
/// Supernode s holds the columns firstColumn[s] .. firstColumn[s + 1] - 1. Its rows are
/// rows[firstRow[s]] .. rows[firstRow[s + 1] - 1], ascending, the columns themselves first. A
/// parent comes after its children, all of whose descendants stand together before it.
struct SupernodalPattern
{
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

  std::vector<int> firstColumn; ///< of each supernode, and the number of columns
  std::vector<int> firstRow;    ///< of each supernode, and the size of rows
  std::vector<int> rows;
  std::vector<int> permutation; ///< row k of P A P^T is row permutation[k] of A

  SupernodalPattern() = default;
  /// Orders by approximate minimum degree (P. R. Amestoy, T. A. Davis and I. S. Duff, 1996), so
  /// that L stays sparse, and finds the supernodes. Small ones become part of their parents at the
  /// price of some zeros (C. Ashcraft and R. Grimes, The influence of relaxed supernode partitions
  /// on the multifrontal method, 1989).
  /// @param A  its lower triangle; values do not matter
  /// @throw SolverError if there are too many rows to be counted; std::bad_alloc
  explicit SupernodalPattern(const Matrix& A);

  int GetNumberOfColumns() const { return static_cast<int>(this->permutation.size()); }
  int GetNumberOfSupernodes() const { return static_cast<int>(this->firstColumn.size()) - 1; }
  int GetColumns(int s) const { return this->firstColumn[s + 1] - this->firstColumn[s]; }
  int GetRows(int s) const { return this->firstRow[s + 1] - this->firstRow[s]; }
  int GetRowsBelow(int s) const { return this->GetRows(s) - this->GetColumns(s); }
  /// Those after the columns themselves.
  const int* GetBelow(int s) const
  {
    return this->rows.data() + this->firstRow[s] + this->GetColumns(s);
  }
  /// The supernode that holds the first row below each, -1 where there is none.
  std::vector<int> GetParents() const;
};

/// The lower triangle of P A P^T, by columns; rows in any order.
struct PermutedTriangle
{
  struct Entry
  {
    double value;
    int row;
  };
  std::vector<int> first; ///< entry of each column, and their number
  std::vector<Entry> entries;

  /// @param A  its lower triangle @param permutation  row k of P A P^T is row permutation[k] of A
  PermutedTriangle(const SupernodalPattern::Matrix& A, const std::vector<int>& permutation);
  const Entry* Begin(int column) const { return this->entries.data() + this->first[column]; }
  const Entry* End(int column) const { return this->entries.data() + this->first[column + 1]; }
};

/// Where the numbers of a supernode stand: its rows in tiles of eight, its own ones first and
/// filled up to whole tiles, then those below, likewise. A tile row holds its columns one after the
/// other, eight numbers each; columns are filled up like the rows of their own. What fills up is
/// zero, and so need not be what is above the diagonal, which means nothing.
struct SupernodePanel
{
  static constexpr int TileRows = 8;

  SupernodePanel(int columns, int rowsBelow)
    : columns(columns)
    , rowsBelow(rowsBelow)
    , ownTiles(CountTiles(columns))
    , tiles(ownTiles + CountTiles(rowsBelow))
  {
  }

  static int CountTiles(int rows) { return (rows + TileRows - 1) / TileRows; }
  /// Of the eight numbers of a column in a tile row.
  std::size_t GetOffset(int tile, int column) const
  {
    return (static_cast<std::size_t>(tile) * this->ownTiles * TileRows + column) * TileRows;
  }
  std::size_t GetSize() const { return this->GetOffset(this->tiles, 0); }

  int columns;
  int rowsBelow;
  int ownTiles;
  int tiles; ///< own ones and those below
};

/// Which supernodes can be worked on at the same time: subtrees of the elimination tree, which
/// touch no column of each other, and the rest, the top. Small subtrees that stand side by side are
/// one, so that there are few even for a surface of many parts. Depends on the pattern alone and
/// not on the number of threads, so that sums have one order.
class SupernodalTasks
{
public:
  SupernodalTasks() = default;
  explicit SupernodalTasks(const SupernodalPattern& L);

  /// Supernodes first..last - 1.
  struct Range
  {
    int first;
    int last;
  };
  const std::vector<Range>& GetSubtrees() const { return this->Subtrees; }
  /// The others, ascending.
  const std::vector<int>& GetTop() const { return this->Top; }

private:
  std::vector<Range> Subtrees;
  std::vector<int> Top;
};
} // namespace SphericalStyle

#endif
