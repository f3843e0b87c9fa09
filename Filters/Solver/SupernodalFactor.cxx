// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SupernodalFactor.h"

#include <algorithm>

namespace SphericalStyle
{
namespace
{
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
    if (const int* below = L.rows + L.firstRow[s] + L.GetColumns(s);
        below < L.rows + L.firstRow[s + 1])
    {
      parents[s] = ofColumn[*below];
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
} // namespace SphericalStyle
