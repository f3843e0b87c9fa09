// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SupernodalPattern.h"

#include "TriangleMesh.h"

#include <Eigen/OrderingMethods>

#include <algorithm>
#include <limits>
#include <numeric>

namespace SphericalStyle
{
namespace
{
// A subtree of less than a twelfth of the work is not cut further; below this many columns all is
// top, since starting threads would take longer.
constexpr double SmallestShare = 1.0 / 12.0;
constexpr int SmallestSize = 8192;

using Matrix = SupernodalPattern::Matrix;

/// order[k] is eliminated as the k-th.
std::vector<int> MinimumDegree(const Matrix& A)
{
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(A.selfadjointView<Eigen::Lower>(), permutation);
  const auto& indices = permutation.indices();
  return { indices.data(), indices.data() + indices.size() };
}

/// Supernodes in the order of elimination, before they are numbered.
struct Supernodes
{
  std::vector<int> ofColumn; // the supernode of each column
  std::vector<int> parent;
  std::vector<int> columns; // how many
  std::vector<int> below;   // how many rows
  std::vector<std::size_t> firstBelow;
  std::vector<int> belowRows; // of all, in any order

  int Count() const { return static_cast<int>(this->parent.size()); }
};

/// Finds supernodes without a zero: a column joins the one that it is the only parent of if it has
/// no row that this one has not.
class Symbolic
{
public:
  explicit Symbolic(const PermutedTriangle& A)
    : A(A)
    , Size(static_cast<int>(A.first.size()) - 1)
    , FirstChild(this->Size, -1)
    , Mark(this->Size, -1)
  {
    this->Result.ofColumn.resize(this->Size);
  }

  Supernodes Run()
  {
    for (int j = 0; j < this->Size; ++j)
    {
      const int child = this->FirstChild[j];
      if (child >= 0 && this->NextSibling[child] < 0 && this->Joins(j, child))
      {
        this->Append(j, child);
      }
      else
      {
        this->Begin(j);
      }
    }
    return std::move(this->Result);
  }

private:
  int* BeginOfBelow(int s) { return this->Result.belowRows.data() + this->Result.firstBelow[s]; }

  bool Joins(int j, int child)
  {
    // Only the supernode that was looked at last is marked.
    if (this->Marked != child)
    {
      this->Marked = child;
      std::for_each(this->BeginOfBelow(child),
        this->BeginOfBelow(child) + this->Result.below[child],
        [&](int row) { this->Mark[row] = child; });
    }
    return std::all_of(this->A.Begin(j), this->A.End(j),
      [&](const PermutedTriangle::Entry& entry) { return this->Mark[entry.row] == child; });
  }

  void Append(int j, int s)
  {
    ++this->Result.columns[s];
    this->Result.ofColumn[j] = s;
    int* below = this->BeginOfBelow(s);
    int& count = this->Result.below[s];
    std::swap(*std::find(below, below + count, j), below[count - 1]);
    --count;
    this->SetParent(s);
  }

  void Begin(int j)
  {
    const int s = this->Result.Count();
    this->Result.parent.push_back(-1);
    this->NextSibling.push_back(-1);
    this->Result.columns.push_back(1);
    this->Result.ofColumn[j] = s;
    const std::size_t first = this->Result.belowRows.size();
    this->Result.firstBelow.push_back(first);
    this->Marked = s;
    this->Mark[j] = s;
    const auto add = [&](int row)
    {
      if (this->Mark[row] != s)
      {
        this->Mark[row] = s;
        this->Result.belowRows.push_back(row);
      }
    };
    std::for_each(this->A.Begin(j), this->A.End(j),
      [&](const PermutedTriangle::Entry& entry) { add(entry.row); });
    for (int child = this->FirstChild[j]; child >= 0; child = this->NextSibling[child])
    {
      this->Result.parent[child] = s;
      for (int k = 0; k < this->Result.below[child]; ++k)
      {
        add(this->BeginOfBelow(child)[k]); // which may move
      }
    }
    this->Result.below.push_back(static_cast<int>(this->Result.belowRows.size() - first));
    this->SetParent(s);
  }

  /// Among the children of the column that is the first row below.
  void SetParent(int s)
  {
    const int count = this->Result.below[s];
    if (count > 0)
    {
      const int column = *std::min_element(this->BeginOfBelow(s), this->BeginOfBelow(s) + count);
      this->NextSibling[s] = this->FirstChild[column];
      this->FirstChild[column] = s;
    }
  }

  const PermutedTriangle& A;
  int Size;
  std::vector<int> FirstChild;  // supernodes whose first row below is this column
  std::vector<int> NextSibling; // by supernode
  std::vector<int> Mark;        // the last supernode that was seen to have the row
  int Marked = -1;
  Supernodes Result;
};

/// Whether a supernode of so many columns, of whose numbers this share are zeros, is better than
/// two: fewer of them take less time, zeros take more.
bool IsWorthIt(double columns, double share)
{
  return columns <= 8.0 || (columns <= 16.0 && share < 0.3) || (columns <= 48.0 && share < 0.1) ||
    share < 0.05;
}

/// Makes small supernodes part of their parents. into[s] is what s became part of, or s.
std::vector<int> Merge(Supernodes& nodes)
{
  const int count = nodes.Count();
  std::vector<int> into(count);
  std::iota(into.begin(), into.end(), 0);
  std::vector<double> zeros(count, 0.0);
  for (int s = 0; s < count; ++s)
  {
    const int parent = nodes.parent[s];
    if (parent < 0)
    {
      continue;
    }
    const double own = nodes.columns[s];
    const double columns = own + nodes.columns[parent];
    const double more = own * (nodes.columns[parent] + nodes.below[parent] - nodes.below[s]);
    const double allZeros = zeros[s] + zeros[parent] + more;
    const double all = columns * (columns + 1.0) / 2.0 + columns * nodes.below[parent];
    if (IsWorthIt(columns, allZeros / all))
    {
      into[s] = parent;
      nodes.columns[parent] += nodes.columns[s];
      zeros[parent] = allZeros;
    }
  }
  for (int s = count - 1; s >= 0; --s)
  {
    into[s] = into[into[s]];
  }
  return into;
}

/// The supernodes that are left, children and all that is under them before their parents.
std::vector<int> Postorder(const Supernodes& nodes, const std::vector<int>& into)
{
  const int count = nodes.Count();
  std::vector<int> firstChild(count, -1);
  std::vector<int> nextSibling(count, -1);
  std::vector<int> stack;
  for (int s = count - 1; s >= 0; --s)
  {
    if (into[s] != s)
    {
      continue;
    }
    if (const int parent = nodes.parent[s]; parent < 0)
    {
      stack.push_back(s);
    }
    else
    {
      nextSibling[s] = firstChild[into[parent]];
      firstChild[into[parent]] = s;
    }
  }
  std::vector<int> order;
  while (!stack.empty())
  {
    const int s = stack.back();
    if (const int child = firstChild[s]; child >= 0)
    {
      firstChild[s] = nextSibling[child];
      stack.push_back(child);
    }
    else
    {
      order.push_back(s);
      stack.pop_back();
    }
  }
  return order;
}
}

PermutedTriangle::PermutedTriangle(const Matrix& A, const std::vector<int>& permutation)
  : first(permutation.size() + 1, 0)
{
  std::vector<int> position(permutation.size());
  for (std::size_t k = 0; k < permutation.size(); ++k)
  {
    position[permutation[k]] = static_cast<int>(k);
  }
  const auto forEach = [&](const auto& body)
  {
    for (int j = 0; j < A.outerSize(); ++j)
    {
      for (Matrix::InnerIterator entry(A, j); entry; ++entry)
      {
        const auto [column, row] = std::minmax(position[entry.row()], position[j]);
        body(column, row, entry.value());
      }
    }
  };
  forEach([&](int column, int, double) { ++this->first[column + 1]; });
  std::partial_sum(this->first.begin(), this->first.end(), this->first.begin());
  this->entries.resize(this->first.back());
  std::vector<int> next(this->first.begin(), this->first.end() - 1);
  forEach(
    [&](int column, int row, double value) {
      this->entries[next[column]++] = { value, row };
    });
}

SupernodalPattern::SupernodalPattern(const Matrix& A)
{
  const std::vector<int> elimination = MinimumDegree(A);
  const auto n = static_cast<int>(elimination.size());
  Supernodes nodes = Symbolic(PermutedTriangle(A, elimination)).Run();
  const std::vector<int> into = Merge(nodes);
  const std::vector<int> order = Postorder(nodes, into);

  this->firstColumn.assign(1, 0);
  this->firstRow.assign(1, 0);
  std::vector<int> next(nodes.Count()); // column of each
  std::size_t size = 0;
  for (const int s : order)
  {
    next[s] = this->firstColumn.back();
    this->firstColumn.push_back(next[s] + nodes.columns[s]);
    size += nodes.columns[s] + nodes.below[s];
  }
  if (size > static_cast<std::size_t>(std::numeric_limits<int>::max()))
  {
    throw SolverError("the factor of the system matrix has too many rows to be counted");
  }
  std::vector<int> column(n); // of what is eliminated as the k-th
  this->permutation.resize(n);
  for (int k = 0; k < n; ++k)
  {
    column[k] = next[into[nodes.ofColumn[k]]]++;
    this->permutation[column[k]] = elimination[k];
  }
  this->rows.reserve(size);
  for (std::size_t s = 0; s < order.size(); ++s)
  {
    for (int k = this->firstColumn[s]; k < this->firstColumn[s + 1]; ++k)
    {
      this->rows.push_back(k);
    }
    const auto first = static_cast<std::ptrdiff_t>(this->rows.size());
    const int* below = nodes.belowRows.data() + nodes.firstBelow[order[s]];
    std::transform(below, below + nodes.below[order[s]], std::back_inserter(this->rows),
      [&](int row) { return column[row]; });
    std::sort(this->rows.begin() + first, this->rows.end());
    this->firstRow.push_back(static_cast<int>(this->rows.size()));
  }
}

std::vector<int> SupernodalPattern::GetParents() const
{
  const int count = this->GetNumberOfSupernodes();
  std::vector<int> ofColumn(this->GetNumberOfColumns());
  for (int s = 0; s < count; ++s)
  {
    std::fill(
      ofColumn.begin() + this->firstColumn[s], ofColumn.begin() + this->firstColumn[s + 1], s);
  }
  std::vector<int> parents(count, -1);
  for (int s = 0; s < count; ++s)
  {
    if (this->GetRowsBelow(s) > 0)
    {
      parents[s] = ofColumn[*this->GetBelow(s)];
    }
  }
  return parents;
}

SupernodalTasks::SupernodalTasks(const SupernodalPattern& L)
{
  const int count = L.GetNumberOfSupernodes();
  const std::vector<int> parents = L.GetParents();
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
    const double own = static_cast<double>(L.GetRows(s)) * L.GetColumns(s);
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
  const bool small = L.GetNumberOfColumns() < SmallestSize;
  double last = 0.0; // work of the subtree that was found last
  for (int s = count - 1; s >= 0;)
  {
    const bool inOnePiece = first[s] + size[s] == s + 1; // as a postordered tree has it
    if (!small && inOnePiece && work[s] <= SmallestShare * total)
    {
      const bool beside = !this->Subtrees.empty() && this->Subtrees.back().first == s + 1;
      if (beside && last + work[s] <= SmallestShare * total)
      {
        last += work[s];
        this->Subtrees.back().first = first[s];
      }
      else
      {
        last = work[s];
        this->Subtrees.push_back({ first[s], s + 1 });
      }
      s = first[s] - 1;
    }
    else
    {
      this->Top.push_back(s--);
    }
  }
  std::reverse(this->Top.begin(), this->Top.end());
}
} // namespace SphericalStyle
