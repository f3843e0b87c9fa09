// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Union-find: sets of numbers that grow together.
#ifndef SphericalStyle_DisjointSets_h
#define SphericalStyle_DisjointSets_h

#include <algorithm>
#include <vector>

namespace SphericalStyle
{
/// The number that a set is known by. In `parents` each number leads to another one of its set, and
/// the root to itself; the way there is halved (Tarjan, van Leeuwen, Worst-case analysis of set
/// union algorithms, 1984).
template <typename Number>
Number RootOf(std::vector<Number>& parents, Number i)
{
  while (parents[i] != i)
  {
    parents[i] = parents[parents[i]];
    i = parents[i];
  }
  return i;
}

/// Makes one set of the two of i and j, known by the lower root.
template <typename Number>
void JoinSets(std::vector<Number>& parents, Number i, Number j)
{
  i = RootOf(parents, i);
  j = RootOf(parents, j);
  parents[std::max(i, j)] = std::min(i, j);
}
} // namespace SphericalStyle

#endif
