// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// One run of vtkSphericalStyleFilter in a process of its own: the first result, then, if asked for,
// what a user feels who drags the center and the slider of Roundness.
#include "BenchmarkMesh.h"
#include "BenchmarkProgram.h"
#include "vtkSphericalStyleFilter.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>

namespace
{
constexpr const char* Usage =
  "usage: RoundMesh MESH [options]\n"
  "  --method closed-form|energy  the filter with its defaults, or the energy of the thesis: one\n"
  "                               ball, without details, in the size that this leads to\n"
  "  --iterations N               energy: exactly N plain ones; 0: to Tolerance (default)\n"
  "  --updates N                  after the first result N positions of the center, then N values\n"
  "                               of Roundness (default 0)\n"
  "  --threads N                  default 1";

vtkSmartPointer<vtkPolyData> ToPolyData(const SphericalStyle::TriangleMesh& mesh)
{
  vtkNew<vtkPoints> points; // single precision, as readers give them
  points->SetNumberOfPoints(mesh.P.rows());
  for (vtkIdType i = 0; i < mesh.P.rows(); ++i)
  {
    points->SetPoint(i, mesh.P.row(i).data());
  }
  vtkNew<vtkCellArray> triangles;
  triangles->AllocateExact(mesh.F.rows(), 3 * mesh.F.rows());
  for (vtkIdType t = 0; t < mesh.F.rows(); ++t)
  {
    const vtkIdType corners[3] = { mesh.F(t, 0), mesh.F(t, 1), mesh.F(t, 2) };
    triangles->InsertNextCell(3, corners);
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  return surface;
}

/// The pull toward one ball, of the model as it is.
void AskForEnergy(vtkSphericalStyleFilter* filter, int iterations)
{
  filter->SetSphericalWeightingToUniform();
  filter->SetRoundness(0.5);
  filter->SetNormalBlend(0.0);
  filter->SetDetailSize(0.0);
  filter->SetKeepSizeToOff();
  filter->SetMaximumNumberOfIterations(1000);
  if (iterations > 0)
  {
    filter->SetStopRuleToFixedIterations();
    filter->SetMaximumNumberOfIterations(iterations);
  }
}

vtkSmartPointer<vtkSphericalStyleFilter> MakeFilter(
  vtkPolyData* surface, const Benchmarks::Arguments& arguments)
{
  auto filter = vtkSmartPointer<vtkSphericalStyleFilter>::New();
  filter->SetInputData(surface);
  filter->SetNumberOfThreads(arguments.Integer("--threads"));
  const std::string& method = arguments.Text("--method");
  if (method == "energy")
  {
    AskForEnergy(filter, arguments.Integer("--iterations"));
  }
  else if (method != "closed-form")
  {
    throw std::invalid_argument("no method is called \"" + method + "\"");
  }
  return filter;
}

/// Loads what libraries need for a run, so that it is not counted as memory of the model.
void WarmUp(const Benchmarks::Arguments& arguments)
{
  constexpr int Few = 2000; // points
  const auto surface = ToPolyData(Benchmarks::MakeMesh(Benchmarks::Family::Even, Few));
  MakeFilter(surface, arguments)->Update();
}

/// Seconds of the last execution that an update redoes: all but grid, base and factor.
double IterationSeconds(vtkSphericalStyleFilter* filter)
{
  auto* stages = filter->GetOutputDataObject(1)->GetFieldData()->GetArray("StageSeconds");
  for (int k = 0; k < stages->GetNumberOfComponents(); ++k)
  {
    if (std::string(stages->GetComponentName(k)) == "Iterate")
    {
      return stages->GetComponent(0, k);
    }
  }
  throw std::runtime_error("the filter does not tell the seconds of its iterations");
}

std::string HashOfPoints(vtkSphericalStyleFilter* filter)
{
  vtkDataArray* data = filter->GetOutput()->GetPoints()->GetData();
  return Benchmarks::Hash(data->GetVoidPointer(0),
    static_cast<std::size_t>(data->GetNumberOfValues()) * data->GetDataTypeSize());
}

/// Of the output what it does not share with the input.
double OutputMegabytes(vtkPolyData* output)
{
  return (output->GetPoints()->GetActualMemorySize() +
           output->GetPointData()->GetActualMemorySize()) /
    1024.0;
}

double Median(std::vector<double> values)
{
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Adds median and largest seconds of so many updates. @param set  sets a property to its k-th
/// value
template <typename Set>
void Drag(vtkSphericalStyleFilter* filter, int updates, const std::string& name, Set set,
  Benchmarks::Record& record)
{
  std::vector<double> seconds;
  for (int k = 1; k <= updates; ++k)
  {
    set(k);
    const Benchmarks::Timer watch;
    filter->Update();
    seconds.push_back(watch.Seconds());
  }
  record.Add(name + "_seconds", Median(seconds))
    .Add(name + "_slowest_seconds", *std::max_element(seconds.begin(), seconds.end()));
}

void DragCenterAndRoundness(
  vtkSphericalStyleFilter* filter, int updates, Benchmarks::Record& record)
{
  constexpr double Step = 0.2; // radians
  const Eigen::Vector3d center(filter->GetEffectiveCenter());
  const double circle = 0.2 * filter->GetEffectiveRadius();
  filter->SetCenterModeToCustom();
  const auto moveCenter = [&](int k)
  {
    filter->SetCenter(
      center[0] + circle * std::cos(Step * k), center[1] + circle * std::sin(Step * k), center[2]);
  };
  Drag(filter, updates, "center", moveCenter, record);
  const double roundness = filter->GetRoundness();
  const auto moveSlider = [&](int k)
  { filter->SetRoundness(roundness * (1.0 + 0.5 * std::sin(Step * k))); };
  Drag(filter, updates, "roundness", moveSlider, record);
}
}

int main(int argc, char* argv[])
{
  return Benchmarks::Main(Usage,
    [&]
    {
      const Benchmarks::Arguments arguments(argc, argv,
        { { "--method", "closed-form" }, { "--iterations", "0" }, { "--updates", "0" },
          { "--threads", "1" } });
      WarmUp(arguments);
      const double atStart = Benchmarks::PeakMegabytes();
      const auto surface = ToPolyData(Benchmarks::ReadMesh(arguments.At(0)));
      const auto filter = MakeFilter(surface, arguments);

      const Benchmarks::Timer total;
      filter->Update();
      const double all = total.Seconds();
      const double processor = total.ProcessorSeconds();
      if (filter->GetOutput()->GetNumberOfPoints() != surface->GetNumberOfPoints())
      {
        throw std::runtime_error(
          "the filter gave no result, or has split edges of a mesh too coarse to measure with");
      }
      const double iterating = IterationSeconds(filter);
      const int iterations = filter->GetNumberOfIterations();
      Benchmarks::Record record;
      record.Add("points", static_cast<double>(surface->GetNumberOfPoints()))
        .Add("setup_seconds", all - iterating)
        .Add("iterations", iterations)
        .Add("seconds_per_iteration", iterating / std::max(1, iterations))
        .Add("total_seconds", all)
        .Add("processor_seconds", processor)
        .Add("hash", HashOfPoints(filter));
      if (const int updates = arguments.Integer("--updates"))
      {
        DragCenterAndRoundness(filter, updates, record);
      }
      record.Add("start_megabytes", atStart)
        .Add("input_megabytes", surface->GetActualMemorySize() / 1024.0)
        .Add("output_megabytes", OutputMegabytes(filter->GetOutput()))
        .Add("peak_megabytes", Benchmarks::PeakMegabytes())
        .Print();
    });
}
