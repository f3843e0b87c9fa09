// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Properties, history and arrays of the nonlinear feature, and its failure in the form as written.
#include "FilterTesting.h"
#include "PropertyTesting.h"

#include "vtkNonlinearStyleFilter.h"

#include "vtkDoubleArray.h"
#include "vtkReverseSense.h"
#include "vtkTable.h"

#include <cmath>
#include <functional>
#include <sstream>

using namespace FilterTesting;

namespace
{
using F = vtkNonlinearStyleFilter;
using Nonlinear = Watched<F>;
using Change = std::function<void(F*)>;

constexpr int Normals = 0;
constexpr int RoundnessFactor = 1;

vtkDataArray* Column(Nonlinear& filter, const char* name)
{
  auto* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
  return vtkArrayDownCast<vtkDataArray>(table->GetColumnByName(name));
}

void SetUp(Nonlinear& filter, double roundness, int iterations)
{
  filter->SetCenterModeToPointMean(); // the thesis' center
  filter->SetRoundness(roundness);
  filter->SetStopRuleToFixedIterations();
  filter->SetMaximumNumberOfIterations(iterations);
}

/// Columns that belong together, and how often each of them rises by more than rounding.
struct Counts
{
  int totals = 0;
  int globalSteps = 0;
  int localSteps = 0;
};

Counts CheckHistory(Checker& check, Nonlinear& filter)
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
    Nonlinear filter(model);
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
  Nonlinear filter(stone);
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

  check.About("ReproduceThesis");
  Nonlinear thesis(stone);
  thesis->ReproduceThesisOn();
  thesis->SetCenterModeToAreaCentroid(); // overridden
  Nonlinear byHand(stone);
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
  check.About("properties");
  Nonlinear plain(model);
  SetUp(plain, 0.5, 5);
  const auto same = [&](const Change& change)
  {
    Nonlinear filter(model);
    SetUp(filter, 0.5, 5);
    change(filter.Get());
    const bool result = SamePoints(filter.Output(), plain.Output());
    check(filter.Errors.empty(), "there should be no error");
    return result;
  };
  plain.Output();
  check(same([](F* f) { f->SetNumberOfThreads(3); }), "NumberOfThreads should not matter");
  const std::pair<const char*, Change> used[] = {
    { "Roundness", [](F* f) { f->SetRoundness(0.6); } },
    { "CenterMode",
      [](F* f)
      {
        f->SetCenterModeToCustom();
        f->SetCenter(0.1, 0.0, 0.0);
      } },
    { "CenterConstraint", [](F* f) { f->SetCenterConstraintToAsWritten(); } },
    { "MaximumNumberOfIterations", [](F* f) { f->SetMaximumNumberOfIterations(6); } },
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

  check.About("defaults");
  Nonlinear filter(model);
  filter.Output();
  check(filter->GetConverged(), "it should converge with the defaults");
}

void PropertiesOfTheClass(Checker& check)
{
  check.About("get and set");
  Nonlinear filter;
  using FilterType = F;
  RoundTrip(Roundness, 1.0, 3.0);
  RoundTrip(CenterConstraint, 0, 1);
  RoundTrip(CenterMode, 1, 2);
  RoundTrip(StopRule, 0, 2);
  RoundTrip(Tolerance, 1e-4, 1e-6);
  RoundTrip(MaximumNumberOfIterations, 200, 3);
  OnOff(ReproduceThesis, false);
  OnOff(GenerateNormals, false);
  OnOff(GenerateCellEnergy, false);
  OnOff(GenerateRotation, false);
  OnOff(GenerateAuxiliaryScale, false);
  Clamped(CenterConstraint, 2, 1);
  Mode(CenterConstraint, Corrected, CORRECTED, 0);
  Mode(CenterConstraint, AsWritten, AS_WRITTEN, 1);
  Mode(CenterMode, PointMean, POINT_MEAN, 0);
  Mode(CenterMode, AreaCentroid, AREA_CENTROID, 1);
  Mode(CenterMode, Custom, CUSTOM_CENTER, 2);
  std::ostringstream printed;
  filter->Print(printed);
  for (const char* name :
    { "Roundness", "CenterConstraint", "CenterMode", "Center", "StopRule", "Tolerance",
      "MaximumNumberOfIterations", "ReproduceThesis", "OutputPointsPrecision", "NumberOfThreads",
      "GenerateNormals", "GenerateCellEnergy", "GenerateRotation", "GenerateAuxiliaryScale",
      "NumberOfIterations", "Converged", "FinalEnergy", "EffectiveCenter", "EffectiveRadius" })
  {
    check(Contains(printed.str(), std::string(" ") + name + ": "),
      std::string("PrintSelf should print ") + name);
  }
}

void Errors(Checker& check, vtkPolyData* model)
{
  const auto fails = [&](const char* about, vtkPolyData* input, const Change& change,
                       const std::vector<std::string>& words)
  {
    check.About(about);
    Nonlinear filter(input);
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
  // The last point has 700 neighbors, each with a dense row.
  const Surface fan = MakeEllipsoid({ 1.0, 1.0, 0.5 }, Faces::Triangles, 700, 3);
  fails("as written, dense rows", fan, [](F* f) { f->SetCenterConstraintToAsWritten(); },
    { "AsWritten", "2102 points", "700 neighbors", "Corrected" });
  fails("no such normals", model,
    [](F* f) { f->SetInputArrayToProcess(Normals, 0, 0, OfPoints, "mine"); },
    { "ormals", "\"mine\"" });
  fails("bad roundness", model, [](F* f) { f->SetRoundness(-1.0); }, { "Roundness" });

  check.About("faces turned inward");
  vtkNew<vtkReverseSense> reverse;
  reverse->SetInputData(model);
  reverse->Update();
  Nonlinear inward(reverse->GetOutput());
  SetUp(inward, 0.1, 5);
  check(AllFinite(inward.Output()->GetPoints()->GetData()), "points should be finite");
  check(inward.Warnings.size() == 1 && Contains(inward.Warnings[0], "normal"),
    "one warning should name the normals");

  check.About("no triangle");
  Nonlinear bare(MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 } }, {}));
  bare->GenerateAuxiliaryScaleOn();
  bare->GenerateRotationOn();
  bare->GenerateCellEnergyOn();
  check(bare.Output()->GetNumberOfPoints() == 2 && bare.Errors.empty() &&
      bare.Warnings.size() == 1 && bare.Output()->GetPointData()->HasArray("AuxiliaryScale"),
    "the input should come out, with one warning");
}

/// The model with normals that lean over, and factors.
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
  return copy;
}
}

int TestNonlinearStyleFilter(int argc, char* argv[])
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
  PropertiesOfTheClass(check);
  return check.Result();
}
