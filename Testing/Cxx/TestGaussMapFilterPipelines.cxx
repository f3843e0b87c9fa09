// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// vtkGaussMapFilter among other filters: after the rounding, before an image filter, with blocks,
/// executed when something has changed and not else.
#include "GaussMapTesting.h"

#include "vtkImageAppend.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

using namespace FilterTesting;

namespace
{
/// The rounder, the more even: A4.34 on our model.
void Rounding(Checker& check, vtkPolyData* creature)
{
  check.About("rounding");
  vtkNew<vtkSphericalStyleFilter> style;
  SetUpEnergy(style); // rounder as a whole, and not every limb in itself
  style->SetInputData(creature);
  WatchedGaussMap map;
  map->SetInputConnection(style->GetOutputPort());
  map->SetNumberOfEqualAreaUnits(100);
  map->AreaWeightedOn(); // a ball whose triangles are small in one place has more normals there
  double before = 1.0;
  for (const double roundness : { 0.0, 0.1, 0.5, 2.0, 5.0 })
  {
    style->SetRoundness(roundness);
    map.Output();
    std::cout << "creature, Roundness " << roundness << ": " << map->GetUnitsHit() << " units hit, "
              << map->GetUnitsHitOften() << " often, distance to uniform "
              << map->GetDistanceToUniform() << "\n";
    check(map.Errors.empty(), "no error should be reported");
    check(map->GetDistanceToUniform() < before, "it should come closer to uniform");
    before = map->GetDistanceToUniform();
  }
  check(map.Starts.size() == 5, "it should execute once for each Roundness");
}

/// A8.26: a turned model hits another number of equal-angle units; equal-area measures stay.
void Turns(Checker& check)
{
  check.About("turned model");
  vtkNew<vtkTransform> transform;
  vtkNew<vtkTransformPolyDataFilter> turned;
  turned->SetTransform(transform);
  turned->SetInputData(MakeEllipsoid({ 1.0, 1.0, 0.3 }, Faces::Triangles, 120, 99));
  WatchedGaussMap map;
  map->SetInputConnection(turned->GetOutputPort());
  std::vector<double> hit, distance;
  for (int i = 0; i < 6; ++i)
  {
    transform->RotateWXYZ(37.0, 1.0, 0.3 * i, 0.2);
    map.Output();
    hit.push_back(map->GetUnitsHit());
    distance.push_back(map->GetDistanceToUniform());
  }
  const auto range = [](const std::vector<double>& x)
  {
    const auto ends = std::minmax_element(x.begin(), x.end());
    return (*ends.second - *ends.first) / *ends.second;
  };
  check(range(hit) > 0.05, "the number of equal-angle units hit should change");
  check(range(distance) < 0.5 * range(hit), "the distance should change less");
}

void ImagePipeline(Checker& check)
{
  check.About("image filter behind");
  WatchedGaussMap map(MakeEllipsoid({ 1, 1, 2 }));
  vtkNew<vtkImageAppend> twice;
  twice->SetAppendAxis(1);
  twice->AddInputConnection(map->GetOutputPort(1));
  twice->AddInputConnection(map->GetOutputPort(1));
  twice->Update();
  check(map.Errors.empty() && map.Starts.size() == 1, "it should execute once");
  check(twice->GetOutput()->GetDimensions()[0] == 360 &&
      twice->GetOutput()->GetDimensions()[1] == 2 * 180,
    "the whole image should come");
  check(Sum(twice->GetOutput()->GetPointData()->GetScalars()) ==
      2.0 * static_cast<double>(map->GetNumberOfNormals()),
    "with its values");
  map->UpdateInformation();
  int extent[6];
  map->GetOutputInformation(1)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
  check(
    extent[1] == 359 && extent[3] == 179 && extent[5] == 0, "its extent should be known before");
}

void Blocks(Checker& check)
{
  check.About("multi-block input");
  const Surface model = MakeEllipsoid({ 1.0, 1.0, 2.0 });
  const Surface other = MakeEllipsoid({ 3.0, 0.8, 1.0 }, Faces::Quads);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, model);
  blocks->SetBlock(1, Surface::New());
  blocks->SetBlock(2, nullptr);
  blocks->SetBlock(3, other);
  WatchedGaussMap filter;
  filter->SetInputDataObject(blocks);
  filter->Update();
  check(filter.Errors.empty() && filter.Warnings.empty(), "the filter should say nothing");
  const std::vector<Surface> surfaces = { model, nullptr, nullptr, other };
  for (unsigned int i : { 0u, 3u })
  {
    WatchedGaussMap alone(surfaces[i]);
    alone.Output();
    const auto block = [&](int port)
    {
      auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(port));
      return output && output->GetNumberOfBlocks() == 4 ? output->GetBlock(i) : nullptr;
    };
    auto* sphere = vtkPolyData::SafeDownCast(block(0));
    auto* image = vtkImageData::SafeDownCast(block(1));
    auto* table = vtkTable::SafeDownCast(block(2));
    if (check(sphere && image && table, "each output should have the block"))
    {
      check(SamePolyData(sphere, alone->GetOutput()), "sphere as alone");
      check(SameArray(image->GetPointData()->GetScalars(),
              Image(alone.Get())->GetPointData()->GetScalars()),
        "image as alone");
      check(
        table->GetValueByName(0, "Entropy").ToDouble() == alone->GetEntropy(), "table as alone");
    }
  }
}

void Executions(Checker& check)
{
  check.About("executions");
  const Surface input = MakeEllipsoid({ 1.0, 0.8, 2.0 });
  WatchedGaussMap filter(input);
  filter.Output();
  filter.Output();
  filter->SetOftenThreshold(filter->GetOftenThreshold());
  filter.Output();
  check(filter.Starts.size() == 1, "it should execute once");
  std::size_t expected = 1;
  const auto changed = [&](const char* what)
  {
    filter.Output();
    check(filter.Starts.size() == ++expected, std::string(what) + " should execute once more");
    WatchedGaussMap fresh(input);
    fresh->SetNormalSource(filter->GetNormalSource());
    fresh->SetAreaWeighted(filter->GetAreaWeighted());
    fresh->SetOftenThreshold(filter->GetOftenThreshold());
    fresh->SetNumberOfEqualAreaUnits(filter->GetNumberOfEqualAreaUnits());
    fresh->SetSphereUnits(filter->GetSphereUnits());
    fresh.Output();
    check(
      SameMap(filter.Get(), fresh.Get()), std::string(what) + ": the same bits as a new filter");
  };
  filter->SetOftenThreshold(0.0);
  changed("OftenThreshold");
  check(filter->GetUnitsHitOften() == filter->GetUnitsHit(), "more than 0 is hit");
  filter->AreaWeightedOn();
  changed("AreaWeighted");
  filter->SetNormalSourceToPointNormals();
  changed("NormalSource");
  filter->SetNumberOfEqualAreaUnits(77);
  changed("NumberOfEqualAreaUnits");
  filter->SetSphereUnitsToEqualArea();
  changed("SphereUnits");
  input->GetPoints()->SetPoint(0, 0.0, 0.0, -2.5);
  input->GetPoints()->Modified();
  changed("a moved point");
}
}

int TestGaussMapFilterPipelines(int argc, char* argv[])
{
  Checker check;
  Rounding(check, ReadModel(argc, argv, "creature.vtp"));
  Turns(check);
  ImagePipeline(check);
  Blocks(check);
  Executions(check);
  return check.Result();
}
