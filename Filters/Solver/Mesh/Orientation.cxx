// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Orientation.h"

#include "MeshEdges.h"
#include "SurfaceMeasures.h"

namespace SphericalStyle
{
namespace
{
/// For each half-edge (3 * triangle + k) the other one on its edge; -1 where there is not exactly
/// one.
std::vector<int> OppositeHalfEdges(const Triangles& F)
{
  const MeshEdges edges(F);
  std::vector<int> opposite(F.size(), -1);
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    if (edges.GetValence(e) == 2)
    {
      const int* sides = edges.GetHalfEdges().data() + edges.GetOffset()[e];
      opposite[sides[0]] = sides[1];
      opposite[sides[1]] = sides[0];
    }
  }
  return opposite;
}

/// The triangles that hang together with `first`, with their sides: 1 if they agree with it.
std::vector<int> Patch(
  int first, const Triangles& F, const std::vector<int>& opposite, std::vector<int>& side)
{
  const auto start = [&F](int h) { return F(h / 3, HalfEdgeStart(h % 3)); };
  std::vector<int> patch = { first };
  side[first] = 1;
  for (std::size_t at = 0; at < patch.size(); ++at)
  {
    const int f = patch[at];
    for (int h = 3 * f; h < 3 * f + 3; ++h)
    {
      const int g = opposite[h] / 3;
      if (opposite[h] >= 0 && side[g] == 0)
      {
        side[g] = start(h) == start(opposite[h]) ? -side[f] : side[f];
        patch.push_back(g);
      }
    }
  }
  return patch;
}
}

Triangles OrientAlike(const Points& P, const Triangles& F)
{
  const std::vector<int> opposite = OppositeHalfEdges(F);
  const Eigen::VectorXd areas = TriangleAreas(P, F);
  std::vector<int> side(F.rows(), 0);
  Triangles oriented = F;
  for (int first = 0; first < static_cast<int>(F.rows()); ++first)
  {
    if (side[first] != 0)
    {
      continue;
    }
    const std::vector<int> patch = Patch(first, F, opposite, side);
    double agree = 0.0;
    for (const int f : patch)
    {
      agree += side[f] * areas(f);
    }
    for (const int f : patch)
    {
      if (side[f] * agree < 0.0)
      {
        std::swap(oriented(f, 1), oriented(f, 2));
      }
    }
  }
  return oriented;
}
} // namespace SphericalStyle
