// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Parallel.h"

#include <algorithm>
#include <atomic>
#include <thread>

namespace SphericalStyle
{
namespace
{
// Below this many items a thread costs more than it brings.
constexpr int SmallestShare = 2048;
// Fixed, so that the order of additions does not depend on the number of threads.
constexpr int SumBlock = 1024;

int NumberOfShares(int items, int threads)
{
  return std::max(1, std::min(threads, items / SmallestShare));
}

// Cuts 0..n into one range per share and runs each on a thread of its own, the first on this one.
void RunShares(int n, int shares, const std::function<void(int, int)>& body)
{
  const auto bound = [n, shares](int s)
  { return static_cast<int>(static_cast<long long>(n) * s / shares); };
  std::vector<std::thread> workers;
  workers.reserve(shares - 1);
  for (int s = 1; s < shares; ++s)
  {
    workers.emplace_back(body, bound(s), bound(s + 1));
  }
  body(0, bound(1));
  for (std::thread& worker : workers)
  {
    worker.join();
  }
}
}

void ParallelFor(int n, int threads, const std::function<void(int, int)>& body)
{
  RunShares(n, NumberOfShares(n, threads), body);
}

void ParallelTasks(int count, int threads, const std::function<void(int)>& body)
{
  std::atomic<int> next = 0;
  const auto work = [&]
  {
    for (int task = next++; task < count; task = next++)
    {
      body(task);
    }
  };
  std::vector<std::thread> workers;
  for (int t = 1; t < std::min(threads, count); ++t)
  {
    workers.emplace_back(work);
  }
  work();
  for (std::thread& worker : workers)
  {
    worker.join();
  }
}

int NumberOfBlocks(int n)
{
  return (n + SumBlock - 1) / SumBlock;
}

void ParallelBlocks(int n, int threads, const std::function<void(int, int, int)>& body)
{
  RunShares(NumberOfBlocks(n), NumberOfShares(n, threads),
    [&](int first, int last)
    {
      for (int b = first; b < last; ++b)
      {
        body(b, b * SumBlock, std::min(n, (b + 1) * SumBlock));
      }
    });
}
} // namespace SphericalStyle
