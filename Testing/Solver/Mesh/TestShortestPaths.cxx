// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Shortest paths along edges, beside Bellman and Ford's: every edge again and again, until no value
// changes. Lengths are whole numbers, so that sums are exact.
#include "Check.h"
#include "ShortestPaths.h"

#include <algorithm>
#include <numeric>
#include <random>

using namespace SphericalStyle;

namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();

struct Graph
{
  std::vector<std::vector<std::pair<int, double>>> edges;

  void Join(int i, int j, double length)
  {
    this->edges[i].emplace_back(j, length);
    this->edges[j].emplace_back(i, length);
  }

  std::vector<int> Lower(
    std::vector<double>& values, const std::vector<int>& starts, double limit = Infinity) const
  {
    return LowerAlongPaths(
      values, starts,
      [this](int i, const auto& visit)
      {
        for (const auto& [j, length] : this->edges[i])
        {
          visit(j, length);
        }
      },
      limit);
  }

  /// @return which points are reached
  std::vector<char> LowerByAllEdges(
    std::vector<double>& values, const std::vector<int>& starts, double limit) const
  {
    std::vector<char> reached(values.size(), 0);
    for (const int i : starts)
    {
      reached[i] = 1;
    }
    for (bool changes = true; changes;)
    {
      changes = false;
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        for (const auto& [j, length] : this->edges[i])
        {
          const double lowered = values[i] + length;
          if (reached[i] && lowered < values[j] && lowered < limit)
          {
            values[j] = lowered;
            reached[j] = 1;
            changes = true;
          }
        }
      }
    }
    return reached;
  }
};

/// 60 points, some edges of length 0, some twice, the last three points without any.
Graph RandomGraph(std::mt19937& random)
{
  Graph graph;
  graph.edges.resize(60);
  std::uniform_int_distribution<int> point(0, 56);
  std::uniform_int_distribution<int> length(0, 9);
  for (int e = 0; e < 120; ++e)
  {
    graph.Join(point(random), point(random), length(random));
  }
  return graph;
}

// Starts of many values, bounds of many, a limit or none.
void TestAllPaths()
{
  std::mt19937 random(1);
  std::uniform_int_distribution<int> value(-9, 30);
  for (int trial = 0; trial < 100; ++trial)
  {
    const Graph graph = RandomGraph(random);
    std::vector<double> values(60);
    std::generate(
      values.begin(), values.end(), [&] { return trial % 3 == 0 ? 99 : value(random); });
    std::vector<int> starts(60);
    std::iota(starts.begin(), starts.end(), 0);
    std::shuffle(starts.begin(), starts.end(), random);
    starts.resize(1 + trial % 7);
    for (const int i : starts)
    {
      values[i] = value(random);
    }
    const double limit = trial % 2 == 0 ? Infinity : 8.0;
    std::vector<double> expected = values;
    const std::vector<char> isReached = graph.LowerByAllEdges(expected, starts, limit);
    const std::vector<int> reached = graph.Lower(values, starts, limit);
    CHECK(values == expected, "trial " << trial << ": all paths");
    CHECK(std::is_sorted(
            reached.begin(), reached.end(), [&](int i, int j) { return values[i] < values[j]; }),
      "trial " << trial << ": from the nearest to the farthest");
    std::vector<int> ascending = reached;
    std::sort(ascending.begin(), ascending.end());
    std::vector<int> all;
    for (int i = 0; i < 60; ++i)
    {
      if (isReached[i])
      {
        all.push_back(i);
      }
    }
    CHECK(ascending == all, "trial " << trial << ": each point that a path reaches once");
  }
}

// Along a row of points a unit apart.
void TestEnds()
{
  Graph row;
  row.edges.resize(10);
  for (int i = 0; i + 1 < 10; ++i)
  {
    row.Join(i, i + 1, 1.0);
  }
  std::vector<double> values(10, Infinity);
  values[2] = 0.0;
  CHECK(row.Lower(values, { 2 }, 3.0).size() == 5, "0 to 4");
  CHECK(values[4] == 2.0 && values[5] == Infinity, "paths end before the limit");

  values.assign(10, Infinity);
  values[2] = 0.0;
  values[5] = 1.0; // is no start, and lower than what comes there
  CHECK(row.Lower(values, { 2 }).size() == 5, "no path through 5");
  CHECK(values[5] == 1.0 && values[6] == Infinity, "5 keeps its value and passes none on");

  CHECK(row.Lower(values, {}).empty(), "without a start");
}
}

int main()
{
  TestAllPaths();
  TestEnds();
  return CheckResult();
}
