// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Parallel.h"

#include "Process.h"
#include "Workers.h"

#include <algorithm>
#include <cstdlib>
#include <thread>

namespace SphericalStyle
{
namespace
{
// Below this many items a thread costs more than it brings.
constexpr int SmallestShare = 2048;
// A thread that is late, or is held up by something else, leaves the rest to the others.
constexpr int SharesPerThread = 4;
// Fixed, so that the order of additions does not depend on the number of threads.
constexpr int SumBlock = 1024;

int NumberOfShares(int items, int threads)
{
  return threads > 1 ? std::max(1, std::min(SharesPerThread * threads, items / SmallestShare)) : 1;
}

// Cuts 0..n into one range per share.
void RunShares(int n, int shares, int threads, const std::function<void(int, int)>& body)
{
  const auto bound = [n, shares](int s)
  { return static_cast<int>(static_cast<long long>(n) * s / shares); };
  if (shares == 1)
  {
    body(0, n);
    return;
  }
  RunOnWorkers(shares, threads, [&](int s) { body(bound(s), bound(s + 1)); });
}
}

void ParallelFor(int n, int threads, const std::function<void(int, int)>& body)
{
  RunShares(n, NumberOfShares(n, threads), threads, body);
}

void ParallelTasks(int count, int threads, const std::function<void(int)>& body)
{
  RunOnWorkers(count, threads, body);
}

int ThreadsOfThisProcess()
{
  const int machine = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int allowed = CoresOfProcess(machine);
  // Set by Open MPI; by MPICH and Intel MPI; by MVAPICH.
  for (const char* name :
    { "OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS", "MV2_COMM_WORLD_LOCAL_SIZE" })
  {
    const char* text = std::getenv(name);
    const int processes = text ? std::atoi(text) : 0;
    if (processes > 0)
    {
      return std::clamp(machine / processes, 1, allowed);
    }
  }
  return allowed;
}

int NumberOfBlocks(int n)
{
  return (n + SumBlock - 1) / SumBlock;
}

void ParallelBlocks(int n, int threads, const std::function<void(int, int, int)>& body)
{
  RunShares(NumberOfBlocks(n), NumberOfShares(n, threads), threads,
    [&](int first, int last)
    {
      for (int b = first; b < last; ++b)
      {
        body(b, b * SumBlock, std::min(n, (b + 1) * SumBlock));
      }
    });
}
} // namespace SphericalStyle
