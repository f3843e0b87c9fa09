// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Loops on threads: every item once, the same sums for any number of threads, what a body throws
/// comes out where the loop was called, nobody waits for a thread that is busy elsewhere, and
/// several processes share the cores.
#include "Check.h"
#include "Parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

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

/// 1 + 2 + ... + n, by a loop of tasks that run loops.
long long NestedSum(int n, int threads)
{
  std::atomic<long long> sum = 0;
  ParallelTasks(4, threads,
    [&](int task)
    {
      ParallelFor(n / 4, threads,
        [&](int begin, int end)
        {
          long long part = 0;
          for (int i = begin; i < end; ++i)
          {
            part += 4LL * i + task + 1;
          }
          sum += part;
        });
    });
  return sum;
}

void NestedLoopsOfSeveralThreads()
{
  constexpr int n = 80000;
  constexpr long long expected = static_cast<long long>(n) * (n + 1) / 2;
  std::atomic<int> wrong = 0;
  std::vector<std::thread> callers;
  for (int k = 0; k < 4; ++k)
  {
    callers.emplace_back(
      [&wrong, k]
      {
        for (int repeat = 0; repeat < 100; ++repeat)
        {
          wrong += NestedSum(n, 1 + (k + repeat) % 4) != expected ? 1 : 0;
        }
      });
  }
  for (std::thread& caller : callers)
  {
    caller.join();
  }
  CHECK(wrong == 0, wrong << " of 400 sums by nested loops of four threads are wrong");
}

/// All threads are held up in a loop of another caller: this one must get on without them.
void WaitsForNobody()
{
  std::atomic<int> held = 0;
  std::atomic<bool> free = false;
  std::thread other(
    [&]
    {
      ParallelTasks(8, 8,
        [&](int)
        {
          ++held;
          while (!free)
          {
            std::this_thread::yield();
          }
        });
    });
  while (held < 8)
  {
    std::this_thread::yield();
  }
  EveryItemOnce(40000, 8);
  CHECK(!free, "the others are still held up");
  free = true;
  other.join();
}

/// @return whether the check holds in a child, and all that it checks itself
bool HoldsInChild(const std::function<bool()>& check)
{
  const pid_t child = fork();
  if (child == 0)
  {
    alarm(600); // ends it if it hangs; it takes milliseconds
    const int failures = Check::Failures;
    const bool holds = check();
    std::exit(holds && Check::Failures == failures ? EXIT_SUCCESS : EXIT_FAILURE);
  }
  int status = -1;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) &&
    WEXITSTATUS(status) == EXIT_SUCCESS;
}

/// A child has none of its parent's threads, and must neither miss them nor wait for them at exit.
void WorksAfterFork()
{
  constexpr int n = 80000;
  const long long expected = NestedSum(n, 4);
  CHECK(HoldsInChild([&] { return NestedSum(n, 4) == expected; }),
    "a forked process should run loops and end");
}

/// A process takes the cores that it may run on; those of one machine share them.
void SharesCores()
{
  constexpr const char* names[] = { "OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS",
    "MV2_COMM_WORLD_LOCAL_SIZE" };
  for (const char* name : names)
  {
    unsetenv(name);
  }
  const int cores = ThreadsOfThisProcess();
  CHECK(cores >= 1, "a thread at least");
  for (const char* name : names)
  {
    const auto with = [name](const char* text)
    {
      setenv(name, text, 1);
      const int threads = ThreadsOfThisProcess();
      unsetenv(name);
      return threads;
    };
    const int machine = std::max(cores, static_cast<int>(std::thread::hardware_concurrency()));
    CHECK(with("1") == cores, name << ": alone on the machine");
    CHECK(with("2") == std::max(1, std::min(cores, machine / 2)), name << ": two processes");
    CHECK(with("100000") == 1, name << ": more processes than cores");
    for (const char* text : { "", "0", "-3", "many" })
    {
      CHECK(with(text) == cores, name << "=" << text << " says nothing");
    }
  }
}

void FollowsAffinity()
{
  CHECK(HoldsInChild(
          []
          {
            cpu_set_t one;
            CPU_ZERO(&one);
            CPU_SET(sched_getcpu(), &one);
            return sched_setaffinity(0, sizeof(one), &one) == 0 && ThreadsOfThisProcess() == 1;
          }),
    "a process on one core should take one thread");
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
  NestedLoopsOfSeveralThreads();
  WaitsForNobody();
  WorksAfterFork();
  SharesCores();
  FollowsAffinity();
  return CheckResult();
}
