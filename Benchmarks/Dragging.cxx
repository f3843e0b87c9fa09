// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a user feels who drags the center, or the slider of Roundness: updates a second of the real
// filter, and how far from the minimum each one is where an energy is minimised.
#include "BenchmarkFilter.h"

#include <algorithm>
#include <cmath>

namespace
{
constexpr const char* Usage =
  "usage: Dragging MESH [options]\n"
  "  --detail-size S, --weighting cotangent|uniform, --tolerance T, --threads N\n"
  "                       as the properties of the filter\n"
  "  --updates N          how many (default 24)\n"
  "  --reference-every N  every Nth is held against a run to 1e-9, where an energy is minimised;\n"
  "                       0: none (default 4)";

using Filter = vtkSmartPointer<vtkSphericalStyleFilter>;

Filter MakeFilter(vtkPolyData* surface, const Benchmarks::Arguments& arguments, double tolerance)
{
  auto filter = Filter::New();
  filter->SetInputData(surface);
  filter->SetDetailSize(arguments.Number("--detail-size"));
  filter->SetSphericalWeighting(arguments.Text("--weighting") == "uniform"
      ? vtkSphericalStyleFilter::UNIFORM
      : vtkSphericalStyleFilter::COTANGENT);
  filter->SetTolerance(tolerance);
  filter->SetMaximumNumberOfIterations(1000);
  filter->SetNumberOfThreads(arguments.Integer("--threads"));
  return filter;
}

/// (E - E*) / (E_0 - E*), E* the energy of the reference.
double Gap(vtkSphericalStyleFilter* filter, vtkSphericalStyleFilter* reference)
{
  const Benchmarks::Energies given(filter);
  const Benchmarks::Energies tight(reference);
  const double energy = given.Totals.back();
  const double lowest = std::min(energy, tight.Totals.back());
  return (energy - lowest) / (tight.Rest - lowest);
}

double Median(std::vector<double> values)
{
  const std::size_t middle = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + middle, values.end());
  return values[middle];
}

/// @param set  sets the property of a filter to its k-th value
template <typename Set>
void Drag(const Benchmarks::Arguments& arguments, vtkPolyData* surface, const std::string& name,
  Set set, Benchmarks::Record& record)
{
  const Filter filter = MakeFilter(surface, arguments, arguments.Number("--tolerance"));
  set(filter, 0);
  filter->Update();
  const Filter reference = MakeFilter(surface, arguments, 1e-9);
  const bool minimises = !Benchmarks::Energies(filter).Totals.empty();
  const int every = minimises ? arguments.Integer("--reference-every") : 0;
  std::vector<double> seconds;
  std::vector<double> gaps;
  for (int k = 1; k <= arguments.Integer("--updates"); ++k)
  {
    const Benchmarks::Timer watch;
    set(filter, k);
    filter->Update();
    seconds.push_back(watch.Seconds());
    if (every > 0 && k % every == 0)
    {
      set(reference, k);
      reference->Update();
      gaps.push_back(Gap(filter, reference));
    }
  }
  record.Add(name + "_updates_per_second", 1.0 / Median(seconds))
    .Add(name + "_slowest_seconds", *std::max_element(seconds.begin(), seconds.end()))
    .Add(name + "_gaps", gaps);
}
}

int main(int argc, char* argv[])
{
  return Benchmarks::Main(Usage,
    [&]
    {
      const Benchmarks::Arguments arguments(argc, argv,
        { { "--detail-size", "0" }, { "--weighting", "cotangent" }, { "--tolerance", "1e-4" },
          { "--threads", "1" }, { "--updates", "24" }, { "--reference-every", "4" } });
      const auto surface = Benchmarks::ToPolyData(Benchmarks::ReadMesh(arguments.At(0)));
      Benchmarks::Record record;
      record.Add("points", static_cast<double>(surface->GetNumberOfPoints()));

      // Around a circle of a fifth of the radius.
      const Filter still = MakeFilter(surface, arguments, 0.5);
      still->Update();
      const Eigen::Vector3d center(still->GetEffectiveCenter());
      const double radius = 0.2 * still->GetEffectiveRadius();
      const auto moveCenter = [&](vtkSphericalStyleFilter* filter, int k)
      {
        filter->SetCenterModeToCustom();
        filter->SetCenter(center[0] + radius * std::cos(0.2 * k),
          center[1] + radius * std::sin(0.2 * k), center[2]);
      };
      Drag(arguments, surface, "center", moveCenter, record);
      const auto moveSlider = [](vtkSphericalStyleFilter* filter, int k)
      { filter->SetRoundness(0.5 + 0.3 * std::sin(0.2 * k)); };
      Drag(arguments, surface, "roundness", moveSlider, record);
      record.Print();
    });
}
