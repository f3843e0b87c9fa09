// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Loops on threads: every item once, the same sums for any number of threads, and what a body
/// throws comes out where the loop was called.
#include "Check.h"
#include "Parallel.h"

#include <atomic>
#include <cmath>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

using namespace SphericalStyle;

namespace
{
void EveryItemOnce(int n, int threads)
{
  std::vector<int> visits(n, 0);
  ParallelFor(n, threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        ++visits[i];
      }
    });
  ParallelTasks(n, threads, [&](int task) { ++visits[task]; });
  CHECK(visits == std::vector<int>(n, 2), n << " items, " << threads << " threads: each once");
}

void SameSums(int n)
{
  const auto sum = [n](int threads)
  {
    return ParallelSum(n, threads,
      [](int begin, int end)
      {
        double part = 0.0;
        for (int i = begin; i < end; ++i)
        {
          part += std::sin(i);
        }
        return part;
      });
  };
  for (const int threads : { 2, 3, 8 })
  {
    CHECK(sum(threads) == sum(1), n << " items: the sum should not depend on the threads");
  }
}

/// What the loop throws, as text.
template <typename Loop>
std::string Thrown(const Loop& loop)
{
  try
  {
    loop();
  }
  catch (const std::bad_alloc&)
  {
    return "no memory";
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
  return "";
}

void CarriesExceptions(int threads)
{
  constexpr int n = 40000;
  std::atomic<int> visited = 0;
  const std::string fromFor = Thrown(
    [&]
    {
      ParallelFor(n, threads,
        [&](int begin, int end)
        {
          visited += end - begin;
          throw std::runtime_error("from " + std::to_string(begin));
        });
    });
  CHECK(fromFor == "from 0", threads << " threads: the first exception in order, not " << fromFor);
  CHECK(visited == n, threads << " threads: all have ended");
  const std::string fromLast = Thrown(
    [&]
    {
      ParallelBlocks(n, threads,
        [&](int, int, int end)
        {
          if (end == n)
          {
            throw std::bad_alloc();
          }
        });
    });
  CHECK(fromLast == "no memory", threads << " threads: the last block throws, not " << fromLast);
  const std::string fromTask = Thrown(
    [&]
    {
      ParallelTasks(5, threads,
        [](int task)
        {
          if (task == 3)
          {
            throw std::runtime_error("task 3");
          }
        });
    });
  CHECK(fromTask == "task 3", threads << " threads: task 3 throws, not " << fromTask);
}
}

int main()
{
  for (const int threads : { 1, 2, 3, 8 })
  {
    for (const int n : { 0, 1, 5000, 40000 })
    {
      EveryItemOnce(n, threads);
    }
    CarriesExceptions(threads);
  }
  SameSums(5000);
  SameSums(40000);
  return CheckResult();
}
