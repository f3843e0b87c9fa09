// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SharedNumbers.h"

#include <algorithm>
#include <numeric>

namespace SphericalStyle
{
std::vector<double> HadBySeveral(const std::vector<double>& own, const Processes& processes)
{
  std::vector<double> all = processes.Concatenate(own);
  std::sort(all.begin(), all.end());
  std::vector<double> several;
  for (std::size_t i = 1; i < all.size(); ++i)
  {
    if (all[i] == all[i - 1] && (several.empty() || several.back() != all[i]))
    {
      several.push_back(all[i]);
    }
  }
  return several;
}

double CountBefore(const SurfacePart& part, double own)
{
  if (part.IsWhole())
  {
    return 0.0;
  }
  const std::vector<double> counts = part.Concatenate({ own });
  return std::accumulate(counts.begin(), counts.begin() + part.processes->GetRank(), 0.0);
}

SurfacePart PartByNames(const std::vector<std::array<double, 2>>& names,
  const std::vector<int>& things, std::size_t size, const SurfacePart& part)
{
  SurfacePart result = part.Apart();
  if (part.IsWhole())
  {
    return result;
  }
  result.counts.assign(size, 1);
  std::vector<double> rows;
  rows.reserve(2 * names.size());
  for (const auto& name : names)
  {
    rows.insert(rows.end(), name.begin(), name.end());
  }
  const auto before =
    static_cast<std::size_t>(CountBefore(part, static_cast<double>(names.size())));
  rows = part.Concatenate(rows);
  std::vector<std::size_t> order(rows.size() / 2);
  std::iota(order.begin(), order.end(), std::size_t(0));
  const auto nameOf = [&rows](std::size_t k) {
    return std::array<double, 2>{ rows[2 * k], rows[2 * k + 1] };
  };
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return nameOf(a) < nameOf(b); });
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end)
  {
    while (end < order.size() && nameOf(order[end]) == nameOf(order[begin]))
    {
      ++end;
    }
    if (end - begin == 1)
    {
      continue;
    }
    for (std::size_t k = begin; k < end; ++k)
    {
      if (order[k] >= before && order[k] < before + names.size())
      {
        const int thing = things[order[k] - before];
        result.shared.push_back(thing);
        result.numbers.push_back(result.numberOfShared);
        result.counts[thing] = k == begin ? 1 : 0;
      }
    }
    ++result.numberOfShared;
  }
  return result;
}
} // namespace SphericalStyle
