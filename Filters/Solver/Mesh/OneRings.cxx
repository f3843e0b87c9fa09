// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "OneRings.h"

#include <algorithm>

namespace SphericalStyle
{
OneRings::OneRings(const MeshTopology& topology, const HalfEdgeScalars& c)
{
  const Triangles& F = topology.GetTriangles();
  const std::vector<int>& offset = topology.GetCornerOffset();
  std::vector<Neighbor> ring;
  for (int i = 0; i < topology.GetNumberOfPoints(); ++i)
  {
    ring.clear();
    for (int at = offset[i]; at < offset[i + 1]; ++at)
    {
      const int f = topology.GetCorners()[at] / 3;
      const int k = topology.GetCorners()[at] % 3;
      // The edge to either other corner lies opposite the third one.
      ring.push_back({ F(f, HalfEdgeStart(k)), c(f, HalfEdgeEnd(k)) });
      ring.push_back({ F(f, HalfEdgeEnd(k)), c(f, HalfEdgeStart(k)) });
    }
    // Stable: the weight of an edge is added up in the order of the triangles, from both ends.
    std::stable_sort(ring.begin(), ring.end(),
      [](const Neighbor& a, const Neighbor& b) { return a.point < b.point; });
    for (const Neighbor& entry : ring)
    {
      if (static_cast<int>(this->Neighbors.size()) > this->Offset.back() &&
        this->Neighbors.back().point == entry.point)
      {
        this->Neighbors.back().weight += entry.weight;
      }
      else
      {
        this->Neighbors.push_back(entry);
      }
    }
    this->Offset.push_back(static_cast<int>(this->Neighbors.size()));
  }
}
} // namespace SphericalStyle
