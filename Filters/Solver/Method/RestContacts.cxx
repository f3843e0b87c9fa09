// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "RestContacts.h"

#include "MeshTopology.h"
#include "OneRings.h"

#include <algorithm>
#include <functional>
#include <map>
#include <queue>
#include <set>
#include <unordered_map>
#include <utility>

namespace SphericalStyle
{
namespace
{
constexpr double ContactWidth = 0.03; // of the diagonal

/// The points whose shortest path along edges from one of the starts is no longer than `reach`.
std::vector<int> PointsWithin(
  double reach, const std::set<int>& starts, const Points& P, const OneRings& rings)
{
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::unordered_map<int, double> lengths;
  for (const int i : starts)
  {
    lengths[i] = 0.0;
    queue.push({ 0.0, i });
  }
  while (!queue.empty())
  {
    const auto [length, i] = queue.top();
    queue.pop();
    if (length > lengths[i])
    {
      continue; // was reached by a shorter path since
    }
    for (const OneRings::Neighbor& neighbor : rings[i])
    {
      const double next = length + (P.row(i) - P.row(neighbor.point)).norm();
      const auto [at, isNew] = lengths.emplace(neighbor.point, next);
      if (next <= reach && (isNew || next < at->second))
      {
        at->second = next;
        queue.push({ next, neighbor.point });
      }
      else if (isNew)
      {
        lengths.erase(at);
      }
    }
  }
  std::vector<int> points;
  points.reserve(lengths.size());
  for (const auto& entry : lengths)
  {
    points.push_back(entry.first);
  }
  return points;
}
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
  for (const auto& [parts, starts] : corners) // the other part ascends
  {
    for (const int i : PointsWithin(ContactWidth * diagonal, starts, rest.P, rings))
    {
      this->Parts[i].push_back(parts.second);
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
