// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The whole filter: first result, and what follows a changed property.
#include "BenchmarkFilter.h"
#include "Stages.h"

#include <benchmark/benchmark.h>

namespace Benchmarks
{
namespace
{
using Filter = vtkSmartPointer<vtkSphericalStyleFilter>;

struct Variant
{
  const char* name;
  double detailSize;
  int weighting;
};

/// The surface that was asked for last.
vtkPolyData* SurfaceOf(const MeshKey& key)
{
  static vtkSmartPointer<vtkPolyData> surface;
  static MeshKey current = { "", 0 };
  if (!(current == key))
  {
    surface = ToPolyData(MakeMesh(FamilyNamed(key.family), key.numberOfPoints));
    current = key;
  }
  return surface;
}

Filter MakeFilter(const MeshKey& key, const Variant& variant, int threads)
{
  auto filter = Filter::New();
  filter->SetInputData(SurfaceOf(key));
  filter->SetDetailSize(variant.detailSize);
  filter->SetSphericalWeighting(variant.weighting);
  filter->SetNumberOfThreads(threads);
  return filter;
}

void Report(benchmark::State& state, vtkSphericalStyleFilter* filter)
{
  state.counters["points"] = static_cast<double>(filter->GetOutput()->GetNumberOfPoints());
  state.counters["iterations"] = filter->GetNumberOfIterations();
  state.SetLabel(HashOfPoints(filter));
}

void FirstResult(benchmark::State& state, const MeshKey& key, const Variant& variant, int threads)
{
  Filter filter;
  while (state.KeepRunning())
  {
    state.PauseTiming(); // the end of the last one is not waited for
    filter = MakeFilter(key, variant, threads);
    state.ResumeTiming();
    filter->Update();
  }
  Report(state, filter);
}

/// Updates after a change that alternates between two values.
template <typename Change>
void AfterChange(
  benchmark::State& state, const MeshKey& key, const Variant& variant, int threads, Change change)
{
  const Filter filter = MakeFilter(key, variant, threads);
  filter->Update();
  const Eigen::Vector3d center(filter->GetEffectiveCenter());
  filter->SetCenter(center.data());
  filter->SetCenterModeToCustom();
  filter->Update();
  bool odd = false;
  while (state.KeepRunning())
  {
    odd = !odd;
    change(filter, center, odd);
    filter->Update();
  }
  Report(state, filter);
  state.SetLabel(""); // depends on how often it ran
}

void ChangeCenter(vtkSphericalStyleFilter* filter, const Eigen::Vector3d& center, bool odd)
{
  filter->SetCenter(
    center[0] + (odd ? 0.1 : 0.0) * filter->GetEffectiveRadius(), center[1], center[2]);
}

void ChangeRoundness(vtkSphericalStyleFilter* filter, const Eigen::Vector3d&, bool odd)
{
  filter->SetRoundness(odd ? 0.6 : 0.5);
}

template <typename Body>
void Register(const std::string& stage, const MeshKey& key, int threads, Body body)
{
  benchmark::RegisterBenchmark(NameOf(stage, key, threads).c_str(), body)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
}
}

void RegisterFilter(const MeshKey& key, int threads)
{
  const Variant variants[] = { { "default", 0.0, vtkSphericalStyleFilter::COTANGENT },
    { "details", 0.03, vtkSphericalStyleFilter::COTANGENT },
    { "uniform", 0.0, vtkSphericalStyleFilter::UNIFORM } };
  for (const Variant& variant : variants)
  {
    const std::string name = variant.name;
    Register("Filter:" + name, key, threads,
      [=](benchmark::State& state) { FirstResult(state, key, variant, threads); });
    Register("FilterCenter:" + name, key, threads,
      [=](benchmark::State& state) { AfterChange(state, key, variant, threads, ChangeCenter); });
    Register("FilterRoundness:" + name, key, threads,
      [=](benchmark::State& state) { AfterChange(state, key, variant, threads, ChangeRoundness); });
  }
}
} // namespace Benchmarks
