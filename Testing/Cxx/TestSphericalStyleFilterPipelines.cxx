// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// The filter among others, as people put pipelines together.
#include "FilterTesting.h"

#include "vtkCurvatures.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntersectionPolyDataFilter.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

using namespace FilterTesting;

namespace
{
/// An ellipsoid that grows longer with time; its triangles stay the same until the last step.
class vtkGrowingEllipsoid : public vtkPolyDataAlgorithm
{
public:
  static vtkGrowingEllipsoid* New();
  vtkTypeMacro(vtkGrowingEllipsoid, vtkPolyDataAlgorithm);

  static Surface Shape(double time)
  {
    return MakeEllipsoid({ 1.0, 0.8, 1.0 + time }, Faces::Triangles, time < 3.0 ? 48 : 52, 33);
  }

protected:
  vtkGrowingEllipsoid() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override
  {
    vtkInformation* info = outputVector->GetInformationObject(0);
    const double steps[] = { 0.0, 1.0, 2.0, 3.0 };
    const double range[] = { 0.0, 3.0 };
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), steps, 4);
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
    return 1;
  }

  int RequestData(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override
  {
    vtkInformation* info = outputVector->GetInformationObject(0);
    const double time = info->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
      ? info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
      : 0.0;
    vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
    output->ShallowCopy(Shape(time));
    output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
    return 1;
  }
};
vtkStandardNewMacro(vtkGrowingEllipsoid);

/// Standard deviation of an array over the size of its mean.
double RelativeDeviation(vtkDataArray* array)
{
  double sum = 0.0;
  double squares = 0.0;
  const auto n = static_cast<double>(array->GetNumberOfTuples());
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    sum += array->GetTuple1(i);
    squares += array->GetTuple1(i) * array->GetTuple1(i);
  }
  return std::sqrt(squares / n - sum * sum / (n * n)) / std::abs(sum / n);
}

void ToCurvatures(Checker& check, int argc, char* argv[])
{
  // Whether the curvature should be more even than before: it is on bodies without parts. Ears and
  // paws get smaller with everything else, hence more curved.
  const std::pair<const char*, bool> models[] = { { "creature.vtp", false },
    { "go-stone.vtp", true }, { "icosahedron.vtp", true }, { "cuboid.vtp", true } };
  for (const auto& model : models)
  {
    check.About(std::string("reader -> filter -> vtkCurvatures, ") + model.first);
    char* path = vtkTestUtilities::ExpandDataFileName(argc, argv, model.first);
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path);
    delete[] path;
    WatchedEnergy filter;
    filter->SetInputConnection(reader->GetOutputPort());
    filter->SetRoundness(5.0);
    vtkNew<vtkCurvatures> curvatures;
    curvatures->SetCurvatureTypeToMean();
    curvatures->SetInputConnection(reader->GetOutputPort());
    curvatures->Update();
    const double before =
      RelativeDeviation(curvatures->GetOutput()->GetPointData()->GetArray("Mean_Curvature"));
    curvatures->SetInputConnection(filter->GetOutputPort());
    curvatures->Update();
    vtkDataArray* mean = curvatures->GetOutput()->GetPointData()->GetArray("Mean_Curvature");
    check(filter.Errors.empty() && filter.Warnings.empty(), "the filter should say nothing");
    check(mean && AllFinite(mean), "mean curvature of the result should be finite");
    if (model.second)
    {
      check.AtMost(RelativeDeviation(mean), 0.5 * before, "deviation of the mean curvature");
    }
    check(curvatures->GetOutput()->GetPointData()->HasArray("Displacement"),
      "arrays of the filter should come through");
  }
}

void IntersectionWithModel(Checker& check, int argc, char* argv[])
{
  check.About("filter -> vtkIntersectionPolyDataFilter with the model");
  for (const char* name : { "creature.vtp", "icosahedron.vtp", "cuboid.vtp" })
  {
    const Surface model = ReadModel(argc, argv, name);
    WatchedFilter filter(model);
    vtkNew<vtkIntersectionPolyDataFilter> intersection;
    intersection->SetInputData(0, model);
    intersection->SetInputConnection(1, filter->GetOutputPort());
    intersection->SplitFirstOutputOff();
    intersection->SplitSecondOutputOff();
    intersection->Update();
    vtkPolyData* lines = intersection->GetOutput();
    check(lines->GetNumberOfLines() > 10, std::string(name) + " should meet its rounded self");
    check(lines->GetNumberOfPoints() > 0 && AllFinite(lines->GetPoints()->GetData()),
      std::string(name) + ": the lines should be finite");
  }
}

void Chain(Checker& check, int argc, char* argv[])
{
  check.About("filter after filter");
  const Surface bottle = ReadModel(argc, argv, "bottle.vtp");
  WatchedFilter filters[3];
  filters[0]->SetInputData(bottle);
  filters[1]->SetInputConnection(filters[0]->GetOutputPort());
  filters[2]->SetInputConnection(filters[1]->GetOutputPort());
  filters[2]->Update();
  double spread = RadiusSpread(bottle);
  for (WatchedFilter& filter : filters)
  {
    check(filter.Errors.empty() && filter.Starts.size() == 1, "each should execute once");
    check(RadiusSpread(filter->GetOutput()) < spread, "each should be rounder than the one before");
    spread = RadiusSpread(filter->GetOutput());
  }
  filters[1]->SetRoundness(2.0);
  filters[2]->Update();
  check(
    filters[0].Starts.size() == 1 && filters[1].Starts.size() == 2 && filters[2].Starts.size() == 2,
    "a change in the middle should execute what comes after it");
  WatchedFilter fresh(filters[1]->GetOutput());
  check(SamePoints(fresh.Output(), filters[2]->GetOutput()),
    "the last should give what it gives alone");

  check.About("rounded by the targets of the filter before");
  WatchedFilter before(bottle);
  before->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  WatchedFilter after;
  after->SetInputConnection(before->GetOutputPort());
  after->SetInputArrayToProcess(
    3, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "TargetDirection");
  after->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "CellEnergy");
  before->SetSphericalWeightingToUniform(); // an energy
  before->GenerateCellEnergyOn();
  check(after.Output()->GetNumberOfPoints() == bottle->GetNumberOfPoints() && after.Errors.empty(),
    "arrays of one should do for the other");
}

void Blocks(Checker& check)
{
  check.About("multi-block input");
  const Surface model = MakeEllipsoid({ 1.0, 0.8, 2.0 });
  const Surface other = MakeEllipsoid({ 3.0, 0.8, 1.0 }, Faces::Quads);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, model);
  blocks->SetBlock(1, Surface::New());
  blocks->SetBlock(2, nullptr);
  blocks->SetBlock(3, other);
  Tested filter;
  filter->SetInputDataObject(blocks);
  filter->Update();
  check(filter.Errors.empty() && filter.Warnings.empty(), "the filter should say nothing");
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  if (!check(output && output->GetNumberOfBlocks() == 4, "blocks should come out as blocks"))
  {
    return;
  }
  const auto block = [&](unsigned int i) { return vtkPolyData::SafeDownCast(output->GetBlock(i)); };
  Tested alone(model);
  check(block(0) && SamePolyData(block(0), alone.Output()), "block 0 should be as it is alone");
  check(!block(1) || block(1)->GetNumberOfPoints() == 0, "the empty block should be empty");
  check(!block(2), "a block that is not there should not be there");
  Tested otherAlone(other);
  check(
    block(3) && SamePolyData(block(3), otherAlone.Output()), "block 3 should be as it is alone");
  auto* tables = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(1));
  auto* table = tables ? vtkTable::SafeDownCast(tables->GetBlock(3)) : nullptr;
  const bool iterates = otherAlone->GetNumberOfIterations() > 0;
  check(iterates == (Begin == SetUpUniform), "an energy should iterate, and no closed form");
  check(
    table && table->GetNumberOfRows() == (iterates ? otherAlone->GetNumberOfIterations() + 1 : 0),
    "each block should have its history");

  filter->SetInputDataObject(model);
  filter->Update();
  auto* single = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
  check(single && SamePolyData(single, alone->GetOutput()), "then one surface should work again");
}

void TimeSteps(Checker& check)
{
  vtkNew<vtkGrowingEllipsoid> source;
  Tested filter;
  filter->SetInputConnection(source->GetOutputPort());
  filter->UpdateInformation();
  check.About("time steps");
  check(
    filter->GetOutputInformation(0)->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()) == 4,
    "the filter should pass them on");
  for (const double time : { 0.0, 1.0, 2.0, 0.0, 3.0, 1.0 })
  {
    check.About("time " + vtkVariant(time).ToString());
    filter->UpdateTimeStep(time);
    check(filter.Errors.empty(), "the filter should say nothing");
    vtkPolyData* output = filter->GetOutput();
    Tested fresh(vtkGrowingEllipsoid::Shape(time));
    check(SamePolyData(output, fresh.Output()), "the result should be that of a new filter");
    check(output->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()) == time,
      "the output should know its time");
  }
  const std::size_t starts = filter.Starts.size();
  filter->UpdateTimeStep(1.0);
  check(filter.Starts.size() == starts, "the same time again should not execute");
}

/// A model that changes over time is told of the rest pose, unless it has one; and its own is none.
void RestPoseOverTime(Checker& check)
{
  vtkNew<vtkGrowingEllipsoid> source;
  Tested filter;
  filter->SetRefineLongEdgesToOn(); // what else would be advised
  filter->SetInputConnection(source->GetOutputPort());
  filter->UpdateTimeStep(1.0);
  check.About("no rest pose");
  check(Contains(filter->GetAdvice(), "RestPose"),
    "it should be advised, not '" + std::string(filter->GetAdvice()) + "'");
  check(filter.Warnings.empty(), "nothing is wrong");
  check.About("the rest pose of time 0");
  filter->SetRestPoseData(vtkGrowingEllipsoid::Shape(0.0));
  filter->UpdateTimeStep(2.0);
  check(std::string(filter->GetAdvice()).empty(), "it was followed");
  check(filter.Warnings.empty(), "nothing is wrong");
  check.About("the model as its rest pose");
  filter->SetRestPoseConnection(source->GetOutputPort());
  filter->UpdateTimeStep(1.0);
  check(filter.Warnings.size() == 1 && Contains(filter.Warnings[0], "Force Time"),
    "a warning should say so");
  check.About("one that does not change, as its rest pose");
  Tested still(vtkGrowingEllipsoid::Shape(0.0));
  still->SetRestPoseConnection(still->GetInputConnection(0, 0));
  still.Output();
  check(still.Warnings.empty() && still.Errors.empty(), "that is its rest pose");
}

/// Time spent to order and to factor the matrix; exactly 0 where the factor was kept.
double SecondsToFactor(vtkSphericalStyleFilter* filter)
{
  filter->Update();
  vtkDataArray* stages = filter->GetOutputDataObject(1)->GetFieldData()->GetArray("StageSeconds");
  return stages->GetComponent(0, 2) + stages->GetComponent(0, 3);
}

/// What is dragged in the window must not factor again.
void FactorIsKept(Checker& check)
{
  check.About("the factor");
  const Surface ellipsoid = vtkGrowingEllipsoid::Shape(0.0);
  WatchedFilter filter(ellipsoid);
  SetUpUniform(filter.Get());
  check(SecondsToFactor(filter.Get()) > 0.0, "the first execution should factor");
  filter->SetCenterModeToCustom();
  filter->SetCenter(0.1, 0.2, 0.3);
  check(SecondsToFactor(filter.Get()) == 0.0, "a moved center should not factor");
  filter->SetRadiusModeToCustom();
  filter->SetRadius(0.7);
  check(SecondsToFactor(filter.Get()) == 0.0, "a new radius should not factor");
  filter->SetRoundness(3.0);
  check(SecondsToFactor(filter.Get()) > 0.0, "another roundness should factor");
}
}

int TestSphericalStyleFilterPipelines(int argc, char* argv[])
{
  Checker check;
  ToCurvatures(check, argc, argv);
  IntersectionWithModel(check, argc, argv);
  Chain(check, argc, argv);
  FactorIsKept(check);
  RestPoseOverTime(check);
  WithEach({ { "energy", SetUpUniform }, { "defaults", SetUpDefaults } },
    [&]
    {
      Blocks(check);
      TimeSteps(check);
    });
  return check.Result();
}
