// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Orientation.h"

#include "MeshEdges.h"
#include "SurfaceMeasures.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace SphericalStyle
{
namespace
{
/// A half-edge between two points that several processes have.
struct SharedHalfEdge
{
  std::array<int, 2> points; // by their numbers, ascending
  int triangle;
  int direction; // 1 from the first to the second, -1 back
};

std::vector<SharedHalfEdge> SharedHalfEdges(const Triangles& F, const SurfacePart& part)
{
  std::vector<SharedHalfEdge> edges;
  std::vector<int> numbers(F.size() > 0 ? F.maxCoeff() + 1 : 0, -1);
  for (std::size_t k = 0; k < part.shared.size(); ++k)
  {
    if (part.shared[k] < static_cast<int>(numbers.size()))
    {
      numbers[part.shared[k]] = part.numbers[k];
    }
  }
  for (int h = 0; !part.shared.empty() && h < static_cast<int>(F.size()); ++h)
  {
    const int u = numbers[StartPoint(F, h)];
    const int v = numbers[EndPoint(F, h)];
    if (u >= 0 && v >= 0)
    {
      edges.push_back({ { std::min(u, v), std::max(u, v) }, h / 3, u < v ? 1 : -1 });
    }
  }
  return edges;
}

/// For each half-edge (3 * triangle + k) the other one on its edge; -1 where there is not exactly
/// one, or where other processes may have more.
std::vector<int> OppositeHalfEdges(const Triangles& F, const SurfacePart& part)
{
  const MeshEdges edges(F);
  std::vector<char> isShared(F.size() > 0 ? F.maxCoeff() + 1 : 0, 0);
  for (const int i : part.shared)
  {
    if (i < static_cast<int>(isShared.size()))
    {
      isShared[i] = 1;
    }
  }
  std::vector<int> opposite(F.size(), -1);
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    const int* sides = edges.GetHalfEdges().data() + edges.GetOffset()[e];
    const auto elsewhere = [&](int h)
    { return isShared[StartPoint(F, h)] && isShared[EndPoint(F, h)]; };
    if (edges.GetValence(e) == 2 && !elsewhere(sides[0]))
    {
      opposite[sides[0]] = sides[1];
      opposite[sides[1]] = sides[0];
    }
  }
  return opposite;
}

/// The triangles that hang together with `first`, with their sides: 1 if they agree with it.
/// @param oneSided  set where they do not all agree in the end
std::vector<int> Patch(int first, const Triangles& F, const std::vector<int>& opposite,
  std::vector<int>& side, bool& oneSided)
{
  const auto start = [&F](int h) { return StartPoint(F, h); };
  std::vector<int> patch = { first };
  side[first] = 1;
  for (std::size_t at = 0; at < patch.size(); ++at)
  {
    const int f = patch[at];
    for (int h = 3 * f; h < 3 * f + 3; ++h)
    {
      if (opposite[h] < 0)
      {
        continue;
      }
      const int g = opposite[h] / 3;
      const int agreed = start(h) == start(opposite[h]) ? -side[f] : side[f];
      if (side[g] == 0)
      {
        side[g] = agreed;
        patch.push_back(g);
      }
      oneSided |= side[g] != agreed;
    }
  }
  return patch;
}

/// Patches of all processes that hang together.
class JoinedPatches
{
public:
  explicit JoinedPatches(std::size_t count)
    : Root(count)
    , Side(count, 1)
    , Members(count)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      this->Root[i] = i;
      this->Members[i] = { i };
    }
  }

  /// @param side  1 if both agree, else -1 @return whether they can
  bool Join(std::size_t a, std::size_t b, int side)
  {
    const int turn = this->Side[a] * this->Side[b] * side;
    std::size_t into = this->Root[a];
    std::size_t from = this->Root[b];
    if (into == from)
    {
      return turn == 1;
    }
    if (this->Members[into].size() < this->Members[from].size())
    {
      std::swap(into, from);
    }
    for (const std::size_t member : this->Members[from])
    {
      this->Root[member] = into;
      this->Side[member] *= turn;
    }
    this->Members[into].insert(
      this->Members[into].end(), this->Members[from].begin(), this->Members[from].end());
    this->Members[from] = {};
    return true;
  }

  std::size_t GetRoot(std::size_t patch) const { return this->Root[patch]; }
  int GetSide(std::size_t patch) const { return this->Side[patch]; }

private:
  std::vector<std::size_t> Root;
  std::vector<int> Side; // as the root has it
  std::vector<std::vector<std::size_t>> Members;
};

/// What the patches of this process agree with once those of all processes are joined: for each its
/// area that faces as its first triangle does minus the rest, in the end that of all it hangs
/// together with.
/// @param patchOf, side  of the triangles
void JoinAcross(const Triangles& F, const SurfacePart& part, const std::vector<int>& patchOf,
  const std::vector<int>& side, bool oneSided, std::vector<double>& agree)
{
  const int rank = part.processes->GetRank();
  std::vector<double> rows;
  for (const double ofPatch : agree)
  {
    rows.insert(rows.end(), { static_cast<double>(rank), ofPatch });
  }
  rows = part.Concatenate(rows);
  std::vector<double> all;
  std::vector<std::size_t> firstOfRank; // patches
  for (std::size_t k = 0; k < rows.size(); k += 2)
  {
    firstOfRank.resize(static_cast<std::size_t>(rows[k]) + 1, all.size());
    all.push_back(rows[k + 1]);
  }
  firstOfRank.resize(std::max(firstOfRank.size(), static_cast<std::size_t>(rank) + 1), all.size());
  const std::size_t own = firstOfRank[rank];

  rows.clear();
  for (const SharedHalfEdge& edge : SharedHalfEdges(F, part))
  {
    rows.insert(rows.end(),
      { static_cast<double>(edge.points[0]), static_cast<double>(edge.points[1]),
        static_cast<double>(own + patchOf[edge.triangle]),
        static_cast<double>(edge.direction * side[edge.triangle]) });
  }
  rows = part.Concatenate(rows);
  std::vector<std::array<double, 4>> edges(rows.size() / 4);
  for (std::size_t k = 0; k < edges.size(); ++k)
  {
    std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(4 * k), 4, edges[k].begin());
  }
  std::stable_sort(edges.begin(), edges.end(),
    [](const auto& a, const auto& b) { return std::tie(a[0], a[1]) < std::tie(b[0], b[1]); });
  JoinedPatches joined(all.size());
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end)
  {
    while (
      end < edges.size() && edges[end][0] == edges[begin][0] && edges[end][1] == edges[begin][1])
    {
      ++end;
    }
    if (end - begin == 2) // two that agree run along their edge in opposite directions
    {
      oneSided |= !joined.Join(static_cast<std::size_t>(edges[begin][2]),
        static_cast<std::size_t>(edges[begin + 1][2]),
        edges[begin][3] == edges[begin + 1][3] ? -1 : 1);
    }
  }
  if (part.Max(oneSided ? 1.0 : 0.0) > 0.0)
  {
    throw WholeSurfaceNeeded("the surface has one side only");
  }
  std::vector<double> sums(all.size(), 0.0);
  for (std::size_t k = 0; k < all.size(); ++k)
  {
    sums[joined.GetRoot(k)] += joined.GetSide(k) * all[k];
  }
  for (std::size_t k = 0; k < agree.size(); ++k)
  {
    agree[k] = joined.GetSide(own + k) * sums[joined.GetRoot(own + k)];
  }
}
}

Triangles OrientAlike(const Points& P, const Triangles& F, const SurfacePart& part)
{
  const std::vector<int> opposite = OppositeHalfEdges(F, part);
  const Eigen::VectorXd areas = TriangleAreas(P, F);
  std::vector<int> side(F.rows(), 0);
  std::vector<int> patchOf(F.rows(), -1);
  std::vector<double> agree;
  bool oneSided = false;
  for (int first = 0; first < static_cast<int>(F.rows()); ++first)
  {
    if (side[first] != 0)
    {
      continue;
    }
    double sum = 0.0;
    for (const int f : Patch(first, F, opposite, side, oneSided))
    {
      patchOf[f] = static_cast<int>(agree.size());
      sum += side[f] * areas(f);
    }
    agree.push_back(sum);
  }
  if (!part.IsWhole())
  {
    JoinAcross(F, part, patchOf, side, oneSided, agree);
  }
  Triangles oriented = F;
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    if (side[f] * agree[patchOf[f]] < 0.0)
    {
      std::swap(oriented(f, 1), oriented(f, 2));
    }
  }
  return oriented;
}

Triangles OrientOutward(const Points& P, const Triangles& F, const SurfacePart& part)
{
  Triangles oriented = OrientAlike(P, F, part);
  if (EnclosedVolume(P, oriented, part) < 0.0)
  {
    oriented.col(1).swap(oriented.col(2));
  }
  return oriented;
}
} // namespace SphericalStyle
