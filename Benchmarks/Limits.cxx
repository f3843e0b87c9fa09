// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What this machine can do at most, to hold the stages against: bytes read a second from memory,
// bytes read and written (a = b + s c, as STREAM's triad counts them), and floating-point
// operations a second in registers, with the widest instructions that the solver has here. And what
// a loop costs that has next to nothing to do.
#include "Parallel.h"
#include "Stages.h"
#include "Vector4.h"

#include <cstdlib>
#include <numeric>
#include <vector>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace Benchmarks
{
namespace
{
using SphericalStyle::ParallelFor;
using SphericalStyle::ParallelTasks;

constexpr std::size_t HugePage = std::size_t(1) << 21;
constexpr int Doubles = 1 << 26; // 512 MB: more than any cache

struct Free
{
  void operator()(double* data) const { std::free(data); }
};
using Buffer = std::unique_ptr<double[], Free>;

/// @param huge  ask for pages of 2 MB, which take fewer look-ups of addresses
Buffer Allocate(int count, [[maybe_unused]] bool huge)
{
  const std::size_t size = count * sizeof(double);
  Buffer buffer(static_cast<double*>(std::aligned_alloc(HugePage, size)));
  if (!buffer)
  {
    throw std::bad_alloc();
  }
#ifdef __linux__
  madvise(buffer.get(), size, huge ? MADV_HUGEPAGE : MADV_NOHUGEPAGE);
#endif
  std::fill_n(buffer.get(), count, 1.0);
  return buffer;
}

/// Sixteen sums at once, so that additions do not wait for each other.
double Sum(const double* x, int count)
{
  double sums[16] = {};
  for (int i = 0; i < count; i += 16)
  {
    for (int k = 0; k < 16; ++k)
    {
      sums[k] += x[i + k];
    }
  }
  return std::accumulate(sums, sums + 16, 0.0);
}

void Read(benchmark::State& state, int threads, bool huge)
{
  const Buffer x = Allocate(Doubles, huge);
  for (auto _ : state)
  {
    // ParallelFor gives small numbers of items to one thread: count in blocks of 1024.
    ParallelFor(Doubles / 1024, threads,
      [&](int begin, int end)
      { benchmark::DoNotOptimize(Sum(x.get() + 1024 * begin, 1024 * (end - begin))); });
  }
  ReportRate(state, "bytes", double(Doubles) * sizeof(double));
}

void Triad(benchmark::State& state, int threads)
{
  constexpr int count = Doubles / 4;
  const Buffer a = Allocate(count, true);
  const Buffer b = Allocate(count, true);
  const Buffer c = Allocate(count, true);
  for (auto _ : state)
  {
    ParallelFor(count, threads,
      [&](int begin, int end)
      {
        for (int i = begin; i < end; ++i)
        {
          a[i] = b[i] + 0.5 * c[i];
        }
      });
    benchmark::ClobberMemory();
  }
  ReportRate(state, "bytes", 3.0 * count * sizeof(double));
}

constexpr int Chains = 12; // enough to hide the latency of a multiplication with addition
constexpr int Rounds = 1 << 20;

/// Rounds of x = x * a + b on each chain of vectors. @return something that depends on them all
template <typename Vector>
SPHERICALSTYLE_INLINE double MultiplyAdd()
{
  constexpr int width = sizeof(Vector) / sizeof(double);
  volatile double seed = 0.3; // nothing of this is known before it runs
  Vector x[Chains];
  Vector a;
  Vector b;
  for (int lane = 0; lane < width; ++lane)
  {
    a[lane] = 1.0 - 0.001 * seed;
    b[lane] = seed;
    for (Vector& chain : x)
    {
      chain[lane] = seed * lane;
    }
  }
  for (int round = 0; round < Rounds; ++round)
  {
    for (Vector& chain : x)
    {
      chain = chain * a + b;
    }
  }
  Vector sum = x[0];
  for (int chain = 1; chain < Chains; ++chain)
  {
    sum += x[chain];
  }
  double total = 0.0;
  for (int lane = 0; lane < width; ++lane)
  {
    total += sum[lane];
  }
  return total;
}

struct Kernel
{
  double (*run)();
  int width; // doubles in a vector
};

#ifdef SPHERICALSTYLE_INSTRUCTION_SETS
SPHERICALSTYLE_FOR_AVX512 double MultiplyAdd512()
{
  return MultiplyAdd<SphericalStyle::Vector8>();
}
SPHERICALSTYLE_FOR_AVX2 double MultiplyAdd256()
{
  return MultiplyAdd<SphericalStyle::Vector4>();
}
#endif

double MultiplyAdd128()
{
  return MultiplyAdd<SphericalStyle::Vector2>();
}

Kernel WidestKernel()
{
#ifdef SPHERICALSTYLE_INSTRUCTION_SETS
  if (SphericalStyle::HasAvx512())
  {
    return { MultiplyAdd512, 8 };
  }
  if (SphericalStyle::HasAvx2())
  {
    return { MultiplyAdd256, 4 };
  }
#endif
  return { MultiplyAdd128, 2 };
}

void Arithmetic(benchmark::State& state, int threads)
{
  const Kernel kernel = WidestKernel();
  constexpr int perThread = 4096; // as many items as ParallelFor gives to a thread of its own
  for (auto _ : state)
  {
    ParallelFor(
      perThread * threads, threads, [&](int, int) { benchmark::DoNotOptimize(kernel.run()); });
  }
  ReportRate(state, "flops", 2.0 * kernel.width * Chains * double(Rounds) * threads);
  state.SetLabel(std::to_string(64 * kernel.width) + "-bit vectors");
}

/// x = a x + b on so few numbers that they stay in the cache: little more than the loop itself.
void ShortLoop(benchmark::State& state, int threads)
{
  constexpr int count = 8192;
  std::vector<double> x(count, 1.0);
  for (auto _ : state)
  {
    ParallelFor(count, threads,
      [&](int begin, int end)
      {
        for (int i = begin; i < end; ++i)
        {
          x[i] = 0.999 * x[i] + 0.001;
        }
      });
    benchmark::ClobberMemory();
  }
}

/// The same in small tasks.
void ShortTasks(benchmark::State& state, int threads)
{
  constexpr int tasks = 64;
  constexpr int count = 512;
  std::vector<double> x(tasks * count, 1.0);
  for (auto _ : state)
  {
    ParallelTasks(tasks, threads,
      [&](int task)
      {
        for (int i = task * count; i < (task + 1) * count; ++i)
        {
          x[i] = 0.999 * x[i] + 0.001;
        }
      });
    benchmark::ClobberMemory();
  }
}

template <typename Body>
void Register(const std::string& name, int threads, Body body)
{
  const std::string full = "Limit:" + name + "/threads:" + std::to_string(threads);
  benchmark::RegisterBenchmark(full.c_str(), body)->Unit(benchmark::kMillisecond)->UseRealTime();
}
}

void RegisterLimits(int threads)
{
  Register("Read", threads, [=](benchmark::State& state) { Read(state, threads, false); });
  Register("ReadHugePages", threads, [=](benchmark::State& state) { Read(state, threads, true); });
  Register("Triad", threads, [=](benchmark::State& state) { Triad(state, threads); });
  Register("Arithmetic", threads, [=](benchmark::State& state) { Arithmetic(state, threads); });
  Register("ShortLoop", threads, [=](benchmark::State& state) { ShortLoop(state, threads); });
  Register("ShortTasks", threads, [=](benchmark::State& state) { ShortTasks(state, threads); });
}
} // namespace Benchmarks
