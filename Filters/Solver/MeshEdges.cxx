// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshEdges.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace SphericalStyle
{
MeshEdges::MeshEdges(const Triangles& F)
{
  using Entry = std::pair<std::int64_t, int>; // edge and half-edge
  std::vector<Entry> entries(F.size());
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const auto ends = std::minmax(F(f, HalfEdgeStart(k)), F(f, HalfEdgeEnd(k)));
      const int h = static_cast<int>(3 * f) + k;
      entries[h] = { (static_cast<std::int64_t>(ends.first) << 32) | ends.second, h };
    }
  }
  std::sort(entries.begin(), entries.end());
  this->HalfEdges.reserve(entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i)
  {
    this->HalfEdges.push_back(entries[i].second);
    if (i + 1 == entries.size() || entries[i + 1].first != entries[i].first)
    {
      this->Offset.push_back(static_cast<int>(i) + 1);
    }
  }
}
} // namespace SphericalStyle
