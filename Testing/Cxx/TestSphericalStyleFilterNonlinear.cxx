// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Feature Nonlinear: what of the filter applies to it and what does not, its history, its arrays,
/// and the failure of the form as written.
#include "FilterTesting.h"

#include "vtkDoubleArray.h"
#include "vtkReverseSense.h"
#include "vtkTable.h"

#include <cmath>
#include <functional>

using namespace FilterTesting;

namespace
{
using Change = std::function<void(vtkSphericalStyleFilter*)>;

constexpr int Normals = 0;
constexpr int RoundnessFactor = 1;
constexpr int CenterId = 5;

vtkDataArray* Column(WatchedFilter& filter, const char* name)
{
  auto* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
  return vtkArrayDownCast<vtkDataArray>(table->GetColumnByName(name));
}

void SetUp(WatchedFilter& filter, double roundness, int iterations)
{
  filter->SetFeatureToNonlinear();
  filter->SetCenterModeToPointMean(); // the thesis' center
  filter->SetRoundness(roundness);
  filter->SetStopRuleToFixedIterations();
  filter->SetMaximumNumberOfIterations(iterations);
  filter->AccelerationOff();
}

/// Columns that belong together, and how often each of them rises by more than rounding.
struct Counts
{
  int totals = 0;
  int globalSteps = 0;
  int localSteps = 0;
};

Counts CheckHistory(Checker& check, WatchedFilter& filter)
{
  Counts rises;
  vtkDataArray* total = Column(filter, "Total");
  vtkDataArray* local = Column(filter, "LocalChange");
  vtkDataArray* global = Column(filter, "GlobalChange");
  const double first = total->GetTuple1(0);
  for (vtkIdType k = 1; k < total->GetNumberOfTuples(); ++k)
  {
    const double change = total->GetTuple1(k) - total->GetTuple1(k - 1);
    check.AtMost(std::abs(local->GetTuple1(k) + global->GetTuple1(k) - change), 1e-11 * first,
      "difference of row " + Text(k) + " and its changes");
    rises.totals += change > 1e-12 * first ? 1 : 0;
    rises.localSteps += local->GetTuple1(k) > 1e-12 * first ? 1 : 0;
    rises.globalSteps += global->GetTuple1(k) > 1e-12 * first ? 1 : 0;
  }
  return rises;
}

void Corrected(Checker& check, vtkPolyData* model, const char* name)
{
  for (const double roundness : { 0.1, 1.0, 5.0 })
  {
    check.About(std::string("corrected, ") + name + ", " + vtkVariant(roundness).ToString());
    WatchedFilter filter(model);
    SetUp(filter, roundness, 30);
    filter->GenerateAuxiliaryScaleOn();
    filter->GenerateCellEnergyOn();
    filter->GenerateRotationOn();
    filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    vtkPolyData* output = filter.Output();
    check(filter.Errors.empty() && filter.Warnings.empty(), "it should say nothing");
    const Counts rises = CheckHistory(check, filter);
    check(rises.totals + rises.globalSteps + rises.localSteps == 0, "the energy should not rise");
    check(filter->GetNumberOfIterations() == 30 && filter->GetConverged(), "30 iterations");
    vtkPointData* data = output->GetPointData();
    check(!data->HasArray("TargetDirection") && data->HasArray("Displacement") &&
        data->HasArray("Rotation"),
      "arrays of the nonlinear feature");
    vtkDataArray* energies = data->GetArray("CellEnergy");
    vtkDataArray* scales = data->GetArray("AuxiliaryScale");
    if (!check(energies && scales && scales->GetNumberOfComponents() == 1 &&
            scales->GetDataType() == VTK_DOUBLE && scales->GetRange()[0] >= 0.0,
          "AuxiliaryScale and CellEnergy, s not negative"))
    {
      continue;
    }
    double sum = 0.0;
    double product = 0.0;
    Vector center;
    filter->GetEffectiveCenter(center.data());
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      sum += energies->GetTuple1(i);
      product += scales->GetTuple1(i) * Distance(PointOf(output, i), center);
    }
    check.AtMost(std::abs(sum - filter->GetFinalEnergy()), 1e-11 * sum, "energy minus its cells");
    check.AtMost(product / output->GetNumberOfPoints(), 1.0, "mean of s |p' - O|, a mean cosine");
    check(product > 0.9 * output->GetNumberOfPoints(), "s should be near 1 / |p' - O|");
    auto* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
    vtkDataArray* stages = table->GetFieldData()->GetArray("StageSeconds");
    check(stages && stages->GetComponent(0, 3) > 0.0, "the time to factor should be told");
  }
}

/// The thesis' failure (Fig. 3.5) is told, and not taken for convergence.
void AsWritten(Checker& check, vtkPolyData* stone, vtkPolyData* house)
{
  check.About("as written, go stone");
  WatchedFilter filter(stone);
  SetUp(filter, 0.1, 30);
  filter->SetCenterConstraintToAsWritten();
  filter.Output();
  check(filter.Errors.empty() && filter.Warnings.empty(), "it should say nothing");
  check(CheckHistory(check, filter).globalSteps == 0, "the energy should fall in every step");
  check(std::isnan(Column(filter, "Gap")->GetTuple1(30)), "no gap is known");

  check.About("as written, stone house");
  filter->SetInputData(house);
  filter.Output();
  const Counts rises = CheckHistory(check, filter);
  check(rises.globalSteps > 0 && rises.totals > 0, "the energy should rise");
  check(filter.Warnings.size() == 1 &&
      Contains(filter.Warnings[0], "rose in " + Text(rises.globalSteps) + " global") &&
      Contains(filter.Warnings[0], Text(rises.totals) + " of 30") &&
      Contains(filter.Warnings[0], "AsWritten"),
    "one warning should count the steps");

  check.About("ReproduceThesis with Feature Nonlinear");
  WatchedFilter thesis(stone);
  thesis->SetFeatureToNonlinear();
  thesis->ReproduceThesisOn();
  thesis->SetCenterModeToAreaCentroid(); // overridden
  WatchedFilter byHand(stone);
  byHand->SetFeatureToNonlinear();
  byHand->SetCenterConstraintToAsWritten();
  byHand->SetStopRuleToThesis();
  check(SamePoints(thesis.Output(), byHand.Output()) && thesis->GetConverged(),
    "it should be AsWritten with the rule of the thesis");
  byHand->SetStopRuleToConverged();
  check(SamePoints(thesis.Output(), byHand.Output()),
    "as written, Converged should be the rule of the thesis");
}

/// What the documentation says of each property.
void Properties(Checker& check, vtkPolyData* model)
{
  check.About("properties of Feature Nonlinear");
  WatchedFilter plain(model);
  SetUp(plain, 0.5, 5);
  const auto same = [&](const Change& change)
  {
    WatchedFilter filter(model);
    SetUp(filter, 0.5, 5);
    change(filter.Get());
    const bool result = SamePoints(filter.Output(), plain.Output());
    check(filter.Errors.empty(), "there should be no error");
    return result;
  };
  plain.Output();
  using F = vtkSphericalStyleFilter;
  const std::pair<const char*, Change> ignored[] = {
    { "NormalBlend", [](F* f) { f->SetNormalBlend(0.7); } },
    { "DetailSize", [](F* f) { f->SetDetailSize(0.05); } },
    { "RadiusMode", [](F* f) { f->SetRadiusModeToEqualVolume(); } },
    { "SphericalWeighting", [](F* f) { f->SetSphericalWeightingToCotangent(); } },
    { "ConcaveEdges", [](F* f) { f->SetConcaveEdgesToFlip(); } },
    { "EdgeWeighting", [](F* f) { f->SetEdgeWeightingToFullEdge(); } },
    { "Anchor", [](F* f) { f->SetAnchorToLastPoint(); } },
    { "ComponentCoupling", [](F* f) { f->SetComponentCouplingToIndependent(); } },
    { "InitialGuess", [](F* f) { f->SetInitialGuessToRest(); } },
    { "NormalRadius", [](F* f) { f->SetNormalRadiusToWholeModel(); } },
    { "KeepSize", [](F* f) { f->SetKeepSizeToVolume(); } },
    { "KeepOnGround", [](F* f) { f->KeepOnGroundOn(); } },
    { "UpAxis", [](F* f) { f->SetUpAxisToZ(); } },
    { "RefineLongEdges", [](F* f) { f->SetRefineLongEdgesToAutomatic(); } },
    { "NumberOfThreads", [](F* f) { f->SetNumberOfThreads(3); } },
  };
  for (const auto& [name, change] : ignored)
  {
    check(same(change), std::string(name) + " should not matter");
  }
  const std::pair<const char*, Change> used[] = {
    { "Feature", [](F* f) { f->SetFeatureToLinear(); } },
    { "Roundness", [](F* f) { f->SetRoundness(0.6); } },
    { "CenterMode",
      [](F* f)
      {
        f->SetCenterModeToCustom();
        f->SetCenter(0.1, 0.0, 0.0);
      } },
    { "CenterConstraint", [](F* f) { f->SetCenterConstraintToAsWritten(); } },
    { "MaximumNumberOfIterations", [](F* f) { f->SetMaximumNumberOfIterations(6); } },
    { "Acceleration", [](F* f) { f->AccelerationOn(); } },
    { "StopRule",
      [](F* f)
      {
        f->SetStopRuleToThesis();
        f->SetMaximumNumberOfIterations(99);
      } },
    { "normals", [](F* f) { f->SetInputArrayToProcess(Normals, 0, 0, OfPoints, "tilted"); } },
    { "roundness factor",
      [](F* f) { f->SetInputArrayToProcess(RoundnessFactor, 0, 0, OfPoints, "factor"); } },
  };
  for (const auto& [name, change] : used)
  {
    check(!same(change), std::string(name) + " should matter");
  }

  check.About("there and back");
  WatchedFilter linear(model);
  WatchedFilter filter(model);
  filter->SetFeatureToNonlinear();
  const auto nonlinear = Surface::New();
  nonlinear->DeepCopy(filter.Output());
  filter->SetFeatureToLinear();
  check(SamePoints(filter.Output(), linear.Output()), "Linear should be what it always was");
  filter->SetFeatureToNonlinear();
  check(SamePoints(filter.Output(), nonlinear), "Nonlinear again should give the same bits");
  check(filter->GetConverged(), "it should converge with the defaults");
}

void Errors(Checker& check, vtkPolyData* model)
{
  const auto fails = [&](const char* about, vtkPolyData* input, const Change& change,
                       const std::vector<std::string>& words)
  {
    check.About(about);
    WatchedFilter filter(input);
    filter->SetFeatureToNonlinear();
    change(filter.Get());
    check(filter.Output()->GetNumberOfPoints() == 0, "the output should be empty");
    if (check(filter.Errors.size() == 1, "there should be one error"))
    {
      for (const std::string& word : words)
      {
        check(Contains(filter.Errors[0], word), "it should say " + word + ": " + filter.Errors[0]);
      }
    }
  };
  using F = vtkSphericalStyleFilter;
  // The last point has 700 neighbours, each with a dense row.
  const Surface fan = MakeEllipsoid({ 1.0, 1.0, 0.5 }, Faces::Triangles, 700, 3);
  fails("as written, dense rows", fan, [](F* f) { f->SetCenterConstraintToAsWritten(); },
    { "AsWritten", "2102 points", "700 neighbours", "Corrected" });
  fails("no such normals", model,
    [](F* f) { f->SetInputArrayToProcess(Normals, 0, 0, OfPoints, "mine"); },
    { "ormals", "\"mine\"" });
  fails("several centers", model,
    [](F* f) { f->SetInputArrayToProcess(CenterId, 0, 0, OfPoints, "id"); },
    { "Nonlinear", "several centers" });
  fails("bad roundness", model, [](F* f) { f->SetRoundness(-1.0); }, { "Roundness" });

  check.About("faces turned inward");
  vtkNew<vtkReverseSense> reverse;
  reverse->SetInputData(model);
  reverse->Update();
  WatchedFilter inward(reverse->GetOutput());
  SetUp(inward, 0.1, 5);
  check(AllFinite(inward.Output()->GetPoints()->GetData()), "points should be finite");
  check(inward.Warnings.size() == 1 && Contains(inward.Warnings[0], "normal"),
    "one warning should name the normals");

  check.About("no triangle");
  WatchedFilter bare(MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 } }, {}));
  bare->SetFeatureToNonlinear();
  bare->GenerateAuxiliaryScaleOn();
  bare->GenerateRotationOn();
  bare->GenerateCellEnergyOn();
  check(bare.Output()->GetNumberOfPoints() == 2 && bare.Errors.empty() &&
      bare.Warnings.size() == 1 && bare.Output()->GetPointData()->HasArray("AuxiliaryScale"),
    "the input should come out, with one warning");
}

/// The model with normals that lean over, factors and ids.
Surface WithArrays(vtkPolyData* model)
{
  auto copy = Surface::New();
  copy->DeepCopy(model);
  const auto add = [&](const char* name, int components, const std::function<double(int)>& value)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(model->GetNumberOfPoints());
    for (int i = 0; i < model->GetNumberOfPoints() * components; ++i)
    {
      array->SetValue(i, value(i));
    }
    copy->GetPointData()->AddArray(array);
  };
  add("tilted", 3, [&](int i) { return PointOf(model, i / 3)[i % 3] + (i % 3 == 0 ? 0.4 : 0.0); });
  add("factor", 1, [](int i) { return i % 2 == 0 ? 1.0 : 0.3; });
  add("id", 1, [](int i) { return i % 2; });
  return copy;
}
}

int TestSphericalStyleFilterNonlinear(int argc, char* argv[])
{
  const Surface stone = ReadModel(argc, argv, "go-stone.vtp");
  const Surface house = ReadModel(argc, argv, "stone-house.vtp");
  Checker check;
  Corrected(check, stone, "go stone");
  Corrected(check, house, "stone house");
  AsWritten(check, stone, house);
  const Surface model = WithArrays(MakeEllipsoid({ 1.0, 0.8, 2.0 }));
  Properties(check, model);
  Errors(check, model);
  return check.Result();
}
