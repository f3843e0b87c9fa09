// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// One run of vtkSphericalStyleFilter in a process of its own, to be held against the peers.
#include "BenchmarkFilter.h"

namespace
{
constexpr const char* Usage =
  "usage: RoundMesh MESH [options]\n"
  "  --detail-size S, --roundness L, --normal-blend A, --weighting cotangent|uniform,\n"
  "  --tolerance T, --threads N, --acceleration 0|1  as the properties of the filter\n"
  "  --iterations N      exactly N iterations instead of the stop rule";

void SetUp(vtkSphericalStyleFilter* filter, const Benchmarks::Arguments& arguments)
{
  filter->SetDetailSize(arguments.Number("--detail-size"));
  filter->SetRoundness(arguments.Number("--roundness"));
  filter->SetNormalBlend(arguments.Number("--normal-blend"));
  filter->SetTolerance(arguments.Number("--tolerance"));
  filter->SetNumberOfThreads(arguments.Integer("--threads"));
  filter->SetAcceleration(arguments.Integer("--acceleration") != 0);
  filter->SetMaximumNumberOfIterations(1000);
  if (arguments.Text("--weighting") == "uniform")
  {
    filter->SetSphericalWeightingToUniform();
  }
  if (const int iterations = arguments.Integer("--iterations"))
  {
    filter->SetStopRuleToFixedIterations();
    filter->SetMaximumNumberOfIterations(iterations);
  }
}
}

int main(int argc, char* argv[])
{
  return Benchmarks::Main(Usage,
    [&]
    {
      const Benchmarks::Arguments arguments(argc, argv,
        { { "--detail-size", "0.06" }, { "--roundness", "1" }, { "--normal-blend", "0.6" },
          { "--weighting", "cotangent" }, { "--tolerance", "1e-4" }, { "--threads", "1" },
          { "--acceleration", "1" }, { "--iterations", "0" } });
      const double atStart = Benchmarks::PeakMegabytes();
      const auto surface = Benchmarks::ToPolyData(Benchmarks::ReadMesh(arguments.At(0)));
      vtkNew<vtkSphericalStyleFilter> filter;
      SetUp(filter, arguments);
      filter->SetInputData(surface);

      const Benchmarks::Timer total;
      filter->Update();
      const double all = total.Seconds();
      const double processor = total.ProcessorSeconds();
      if (filter->GetOutput()->GetNumberOfPoints() != surface->GetNumberOfPoints())
      {
        throw std::runtime_error("the filter gave no result");
      }
      const Benchmarks::Energies energies(filter);
      const auto stages = Benchmarks::StageSeconds(filter);
      const int iterations = filter->GetNumberOfIterations();
      Benchmarks::Record record;
      record.Add("points", static_cast<double>(surface->GetNumberOfPoints()))
        .Add("setup_seconds", all - stages.at("Iterate"))
        .Add("iterations", iterations)
        .Add("seconds_per_iteration", stages.at("Iterate") / std::max(1, iterations))
        .Add("total_seconds", all)
        .Add("processor_seconds", processor);
      for (const auto& [name, seconds] : stages)
      {
        record.Add("stage_" + name, seconds);
      }
      record.Add("rest_energy", energies.Rest)
        .Add("energies", energies.Totals)
        .Add("hash", Benchmarks::HashOfPoints(filter))
        .Add("start_megabytes", atStart)
        .Add("peak_megabytes", Benchmarks::PeakMegabytes())
        .Print();
    });
}
