// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshEdges.h"

#include <algorithm>
#include <numeric>

namespace SphericalStyle
{
namespace
{
/// Half-edges in the order of keys 0..n-1, those of one key as they were.
template <typename Key>
std::vector<int> CountingSort(const std::vector<int>& halfEdges, int n, const Key& key)
{
  std::vector<int> next(n + 1, 0);
  for (const int h : halfEdges)
  {
    ++next[key(h) + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<int> sorted(halfEdges.size());
  for (const int h : halfEdges)
  {
    sorted[next[key(h)]++] = h;
  }
  return sorted;
}
}

MeshEdges::MeshEdges(const Triangles& F)
{
  const auto start = [&F](int h) { return StartPoint(F, h); };
  const auto end = [&F](int h) { return EndPoint(F, h); };
  const auto smaller = [&](int h) { return std::min(start(h), end(h)); };
  const auto larger = [&](int h) { return std::max(start(h), end(h)); };
  const int n = F.size() > 0 ? F.maxCoeff() + 1 : 0;
  this->HalfEdges.resize(F.size());
  std::iota(this->HalfEdges.begin(), this->HalfEdges.end(), 0);
  this->HalfEdges = CountingSort(this->HalfEdges, n, larger);
  this->HalfEdges = CountingSort(this->HalfEdges, n, smaller);
  for (std::size_t i = 0; i < this->HalfEdges.size(); ++i)
  {
    const int h = this->HalfEdges[i];
    const bool last = i + 1 == this->HalfEdges.size();
    const int next = last ? h : this->HalfEdges[i + 1];
    if (last || smaller(next) != smaller(h) || larger(next) != larger(h))
    {
      this->Offset.push_back(static_cast<int>(i) + 1);
    }
  }
}
} // namespace SphericalStyle
