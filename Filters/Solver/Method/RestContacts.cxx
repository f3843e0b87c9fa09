// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RestContacts.h"

#include "MeshTopology.h"
#include "OneRings.h"
#include "ShortestPaths.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace SphericalStyle
{
namespace
{
constexpr double ContactWidth = 0.03; // of the diagonal
constexpr double Infinity = std::numeric_limits<double>::infinity();

}

RestContacts::RestContacts(const TriangleMesh& rest, const std::vector<std::array<int, 2>>& pairs)
{
  if (pairs.empty())
  {
    return;
  }
  const MeshTopology topology(rest.F, static_cast<int>(rest.P.rows()));
  const OneRings rings(topology, HalfEdgeScalars::Zero(rest.F.rows(), 3));
  this->F = rest.F;
  this->PartOf = topology.GetComponents();
  std::map<std::pair<int, int>, std::set<int>> corners; // of a part, where another one meets it
  for (const auto& [f, g] : pairs)
  {
    for (const auto& [own, other] : { std::make_pair(f, g), std::make_pair(g, f) })
    {
      const std::pair<int, int> parts = { this->GetPart(own), this->GetPart(other) };
      if (parts.first != parts.second)
      {
        corners[parts].insert(this->F.row(own).begin(), this->F.row(own).end());
      }
    }
  }
  const double diagonal = (rest.P.colwise().maxCoeff() - rest.P.colwise().minCoeff()).stableNorm();
  this->Parts.resize(rest.P.rows());
  std::vector<double> lengths(rest.P.rows(), Infinity);
  for (const auto& [parts, starts] : corners) // the other part ascends
  {
    for (const int i : starts)
    {
      lengths[i] = 0.0;
    }
    const std::vector<int> near = LowerAlongPaths(
      lengths, { starts.begin(), starts.end() },
      [&](int i, const auto& visit)
      {
        for (const OneRings::Neighbor& neighbor : rings[i])
        {
          visit(neighbor.point, (rest.P.row(i) - rest.P.row(neighbor.point)).norm());
        }
      },
      ContactWidth * diagonal);
    for (const int i : near)
    {
      this->Parts[i].push_back(parts.second);
      lengths[i] = Infinity;
    }
  }
}

bool RestContacts::IsNear(int f, int part) const
{
  const auto corners = this->F.row(f);
  return std::any_of(corners.begin(), corners.end(),
    [&](int i) { return std::binary_search(this->Parts[i].begin(), this->Parts[i].end(), part); });
}

bool RestContacts::AreNear(const std::array<int, 2>& pair) const
{
  return !this->Parts.empty() && this->IsNear(pair[0], this->GetPart(pair[1])) &&
    this->IsNear(pair[1], this->GetPart(pair[0]));
}
} // namespace SphericalStyle
