// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
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

// Calls work(0) on this thread and work(1), ..., work(count - 1) on others.
void RunOnThreads(int count, const std::function<void(int)>& work)
{
  std::vector<std::exception_ptr> thrown(count);
  const auto run = [&work, &thrown](int k)
  {
    try
    {
      work(k);
    }
    catch (...) // out of a thread it would end the process
    {
      thrown[k] = std::current_exception();
    }
  };
  std::vector<std::thread> others;
  others.reserve(count - 1);
  try
  {
    while (static_cast<int>(others.size()) < count - 1)
    {
      others.emplace_back(run, static_cast<int>(others.size()) + 1);
    }
  }
  catch (const std::exception&) // no more threads, or no memory for one
  {
    for (int k = static_cast<int>(others.size()) + 1; k < count; ++k)
    {
      run(k);
    }
  }
  run(0);
  for (std::thread& other : others)
  {
    other.join();
  }
  for (const std::exception_ptr& exception : thrown)
  {
    if (exception)
    {
      std::rethrow_exception(exception);
    }
  }
}

// Cuts 0..n into one range per share.
void RunShares(int n, int shares, const std::function<void(int, int)>& body)
{
  const auto bound = [n, shares](int s)
  { return static_cast<int>(static_cast<long long>(n) * s / shares); };
  if (shares == 1)
  {
    body(0, n);
    return;
  }
  RunOnThreads(shares, [&](int s) { body(bound(s), bound(s + 1)); });
}
}

void ParallelFor(int n, int threads, const std::function<void(int, int)>& body)
{
  RunShares(n, NumberOfShares(n, threads), body);
}

void ParallelTasks(int count, int threads, const std::function<void(int)>& body)
{
  std::atomic<int> next = 0;
  RunOnThreads(std::max(1, std::min(threads, count)),
    [&](int)
    {
      for (int task = next++; task < count; task = next++)
      {
        body(task);
      }
    });
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
