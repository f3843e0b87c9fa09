// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Distances along edges.
#ifndef SphericalStyle_ShortestPaths_h
#define SphericalStyle_ShortestPaths_h

#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace SphericalStyle
{
/// Dijkstra's shortest paths from several points: lowers the value of each point to the smallest
/// that a path from a start brings there, which is the value of the start and the lengths on the
/// way; a point whose value is lower than that keeps it, and no path goes on through it.
/// @param values  of the points, in and out: those of the starts, and elsewhere what to stay below
/// @param starts  no point twice
/// @param forNeighbors  forNeighbors(i, visit) calls visit(j, length) with the length, 0 or more,
/// of each edge of point i; visit returns whether that lowers the value of j
/// @param limit  paths end before they reach it
/// @return the points that paths reach, the starts among them, values ascending
/// Cost: n log n with n points reached.
template <typename Values, typename ForNeighbors>
std::vector<int> LowerAlongPaths(Values& values, const std::vector<int>& starts,
  const ForNeighbors& forNeighbors, double limit = std::numeric_limits<double>::infinity())
{
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  for (const int i : starts)
  {
    front.push({ values[i], i });
  }
  std::vector<int> reached;
  while (!front.empty())
  {
    const auto [value, point] = front.top();
    front.pop();
    if (value > values[point])
    {
      continue; // was lowered since
    }
    reached.push_back(point);
    forNeighbors(point,
      [&, from = value](int j, double length)
      {
        const double lowered = from + length;
        const bool isLower = lowered < values[j] && lowered < limit;
        if (isLower)
        {
          values[j] = lowered;
          front.push({ lowered, j });
        }
        return isLower;
      });
  }
  return reached;
}
} // namespace SphericalStyle

#endif
