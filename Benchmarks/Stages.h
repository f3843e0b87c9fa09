// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the program Stages registers, and how a stage is registered and reported.
#ifndef SphericalStyle_Stages_h
#define SphericalStyle_Stages_h

#include "BenchmarkMesh.h"
#include "BenchmarkProgram.h"

#include <benchmark/benchmark.h>

#include <memory>

namespace Benchmarks
{
struct MeshKey
{
  std::string family;
  int numberOfPoints;
  bool operator==(const MeshKey& other) const
  {
    return this->family == other.family && this->numberOfPoints == other.numberOfPoints;
  }
};

void RegisterLimits(int threads);
void RegisterClosedFormStages(const MeshKey& key, int threads);
void RegisterEnergyStages(const MeshKey& key, int threads);

/// The mesh in its frame, as the solver has it.
SphericalStyle::TriangleMesh MakeFramedMesh(const MeshKey& key);

/// Milliseconds of wall time under the name "stage/family/points/threads:N".
/// @param body  called with the state, the data of the mesh and the number of threads
/// @tparam Data  what the stages of one file take, made from a MeshKey. Kept for the mesh that was
/// asked for last: benchmarks run mesh by mesh, and two large ones do not fit everywhere
template <typename Data>
void Register(const std::string& stage, const MeshKey& key, int threads,
  void (*body)(benchmark::State&, Data&, int))
{
  const std::string name = stage + '/' + key.family + '/' + std::to_string(key.numberOfPoints) +
    "/threads:" + std::to_string(threads);
  benchmark::RegisterBenchmark(name.c_str(),
    [key, threads, body](benchmark::State& state)
    {
      static std::unique_ptr<Data> data;
      static MeshKey current = { "", 0 };
      if (!(current == key))
      {
        data.reset();
        data = std::make_unique<Data>(key);
        current = key;
      }
      body(state, *data, threads);
    })
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
}

/// What every stage reports beside its time. @param hash  of the result
inline void Report(benchmark::State& state, Eigen::Index points, const std::string& hash)
{
  using benchmark::Counter;
  const auto count = static_cast<double>(points);
  state.counters["points"] = count;
  state.counters["s_per_point"] =
    Counter(count, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.SetLabel(hash);
}

/// Adds how many of something a stage works through in a second. @param each  in one run of it
inline void ReportRate(benchmark::State& state, const char* name, double each)
{
  state.counters[name] = benchmark::Counter(each, benchmark::Counter::kIsIterationInvariantRate);
}

template <typename Dense>
std::string HashOf(const Dense& x)
{
  return Hash(x.data(), static_cast<std::size_t>(x.size()) * sizeof(*x.data()));
}
} // namespace Benchmarks

#endif
