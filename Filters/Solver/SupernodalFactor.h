// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A supernodal Cholesky factor, and which parts of it can be worked on at the same time.
#ifndef SphericalStyle_SupernodalFactor_h
#define SphericalStyle_SupernodalFactor_h

#include <vector>

namespace SphericalStyle
{
/// P A P^T = L L^T with L in supernodes: neighbouring columns of one pattern, stored as a dense
/// block. A view: nothing is owned.
///
/// Supernode s holds the columns firstColumn[s] .. firstColumn[s + 1] - 1. Its rows are
/// rows[firstRow[s]] .. rows[firstRow[s + 1] - 1], ascending, the columns themselves first; its
/// values start at values[firstValue[s]], column-major with one column per supernode column and as
/// many rows. Above the diagonal they mean nothing.
struct SupernodalFactor
{
  int numberOfColumns = 0;
  int numberOfSupernodes = 0;
  const int* firstColumn = nullptr;
  const int* firstRow = nullptr;
  const int* rows = nullptr;
  const int* firstValue = nullptr;
  const double* values = nullptr;
  const int* permutation = nullptr; ///< row k of P A P^T is row permutation[k] of A

  int GetColumns(int s) const { return this->firstColumn[s + 1] - this->firstColumn[s]; }
  int GetRows(int s) const { return this->firstRow[s + 1] - this->firstRow[s]; }
};

/// Which supernodes can be worked on at the same time: subtrees of the elimination tree, which
/// touch no column of each other, and the rest, the top. Depends on the factor alone and not on the
/// number of threads, so that sums have one order.
class SupernodalTasks
{
public:
  SupernodalTasks() = default;
  explicit SupernodalTasks(const SupernodalFactor& factor);

  /// Supernodes first..last - 1.
  struct Range
  {
    int first;
    int last;
  };
  const std::vector<Range>& GetSubtrees() const { return this->Subtrees; }
  /// The others, ascending.
  const std::vector<int>& GetTop() const { return this->Top; }
  /// Columns of the top, numbered in their order; -1 for those of a subtree.
  const std::vector<int>& GetTopColumns() const { return this->TopColumns; }
  int GetNumberOfTopColumns() const { return this->NumberOfTopColumns; }

private:
  std::vector<Range> Subtrees;
  std::vector<int> Top;
  std::vector<int> TopColumns;
  int NumberOfTopColumns = 0;
};
} // namespace SphericalStyle

#endif
