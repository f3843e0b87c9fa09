// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Every way to ask for what cannot be done: one error that names the cause, an empty output, and
/// a filter that works again once the cause is gone. Then the bound on iterations, and abort.
#include "ArrayTesting.h"

#include "vtkDoubleArray.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <cmath>
#include <limits>

using namespace FilterTesting;

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinite = std::numeric_limits<double>::infinity();

enum Arrays
{
  Normals = 0,
  RoundnessFactor = 1,
  NormalBlend = 2,
  TargetDirections = 3
};

Surface MakeModel()
{
  return MakeEllipsoid({ 1.0, 0.8, 2.0 });
}

using Change = std::function<void(vtkThesisStyleFilter*, vtkPolyData*)>;

/// Executes after `spoil`, expects one error with all `words`, then executes after `repair` and
/// expects what a new filter gives.
void ExpectError(Checker& check, const std::string& about, const std::vector<std::string>& words,
  const Change& spoil, const Change& repair)
{
  check.About(about);
  const Surface input = MakeModel();
  WatchedDefaults filter(input);
  filter.Output(); // there is an old result that must go
  check(filter.Errors.empty(), "the model should be good before");
  spoil(filter.Get(), input);
  input->Modified();
  vtkPolyData* output = filter.Output();
  if (check(filter.Errors.size() == 1,
        "there should be one error, not " + Text(static_cast<vtkIdType>(filter.Errors.size()))))
  {
    for (const std::string& word : words)
    {
      check(Contains(filter.Errors[0], word),
        "the error should say \"" + word + "\" and says " + filter.Errors[0]);
    }
  }
  check(output->GetNumberOfPoints() == 0 && output->GetNumberOfCells() == 0 &&
      output->GetPointData()->GetNumberOfArrays() == 0,
    "the output should be empty");
  check(vtkTable::SafeDownCast(filter->GetOutputDataObject(1))->GetNumberOfRows() == 0,
    "the history should be empty");

  filter.Errors.clear();
  filter.Warnings.clear();
  repair(filter.Get(), input);
  input->Modified();
  output = filter.Output();
  check(filter.Errors.empty() && filter.Warnings.empty(), "repaired, it should say nothing");
  WatchedDefaults fresh(MakeModel());
  check(SamePoints(output, fresh.Output()), "repaired, it should give what a new filter gives");
}

void MovePoint(vtkPolyData* surface, vtkIdType i, int axis, double to)
{
  Vector x = PointOf(surface, i);
  x[axis] = to;
  surface->GetPoints()->SetPoint(i, x.data());
  surface->GetPoints()->Modified();
}

void Coordinates(Checker& check)
{
  for (const double bad : { NaN, Infinite, -Infinite })
  {
    for (const vtkIdType i : { 0, 7, 145 })
    {
      Vector good;
      ExpectError(
        check, "coordinate " + vtkVariant(bad).ToString() + " of point " + Text(i),
        { "point " + Text(i) + " " },
        [&](vtkSphericalStyleFilter*, vtkPolyData* input)
        {
          good = PointOf(input, i);
          MovePoint(input, i, static_cast<int>(i % 3), bad);
        },
        [&](vtkSphericalStyleFilter*, vtkPolyData* input)
        { MovePoint(input, i, static_cast<int>(i % 3), good[i % 3]); });
    }
  }
  for (const vtkIdType bad :
    { vtkIdType(-1), MakeModel()->GetNumberOfPoints(), vtkIdType(1) << 40 })
  {
    vtkNew<vtkCellArray> faces;
    ExpectError(
      check, "a cell with point id " + Text(bad), { "cell 3 ", "point " + Text(bad) },
      [&](vtkSphericalStyleFilter*, vtkPolyData* input)
      {
        faces->DeepCopy(input->GetPolys());
        const vtkIdType ids[] = { 0, 1, bad };
        input->GetPolys()->ReplaceCellAtId(3, 3, ids);
      },
      [&](vtkSphericalStyleFilter*, vtkPolyData* input) { input->SetPolys(faces); });
  }
  ExpectError(
    check, "too few active normals", { "Normals", "\"few\"", "7 tuples" },
    [](vtkSphericalStyleFilter*, vtkPolyData* input)
    {
      vtkNew<vtkDoubleArray> few;
      few->SetName("few");
      few->SetNumberOfComponents(3);
      few->SetNumberOfTuples(7);
      input->GetPointData()->SetNormals(few);
    },
    [](vtkSphericalStyleFilter*, vtkPolyData* input)
    { input->GetPointData()->RemoveArray("few"); });
  Vector good[2];
  ExpectError(
    check, "two bad points", { "point 11 " },
    [&](vtkSphericalStyleFilter*, vtkPolyData* input)
    {
      good[0] = PointOf(input, 11);
      good[1] = PointOf(input, 30);
      MovePoint(input, 30, 0, NaN);
      MovePoint(input, 11, 2, Infinite);
    },
    [&](vtkSphericalStyleFilter*, vtkPolyData* input)
    {
      MovePoint(input, 11, 2, good[0][2]);
      MovePoint(input, 30, 0, good[1][0]);
    });
}

void Numbers(Checker& check)
{
  for (const double bad : { -1.0, -1e-300, NaN, Infinite })
  {
    ExpectError(
      check, "Roundness " + vtkVariant(bad).ToString(), { "Roundness" },
      [&](vtkSphericalStyleFilter* filter, vtkPolyData*) { filter->SetRoundness(bad); },
      [](vtkSphericalStyleFilter* filter, vtkPolyData*) { filter->SetRoundness(1.0); });
  }
  for (const double bad : { 0.0, -1.0, NaN, Infinite })
  {
    ExpectError(
      check, "custom Radius " + vtkVariant(bad).ToString(), { "Radius" },
      [&](vtkSphericalStyleFilter* filter, vtkPolyData*)
      {
        filter->SetRadiusModeToCustom();
        filter->SetRadius(bad);
      },
      [](vtkSphericalStyleFilter* filter, vtkPolyData*) { filter->SetRadiusModeToEqualArea(); });
  }
  for (const double bad : { NaN, Infinite })
  {
    ExpectError(
      check, "custom Center " + vtkVariant(bad).ToString(), { "Center" },
      [&](vtkSphericalStyleFilter* filter, vtkPolyData*)
      {
        filter->SetCenterModeToCustom();
        filter->SetCenter(0.0, bad, 0.0);
      },
      [](vtkSphericalStyleFilter* filter, vtkPolyData*) { filter->SetCenterModeToAreaCentroid(); });
  }
  // NaN passes a clamp.
  ExpectError(
    check, "NormalBlend NaN", { "NormalBlend" },
    [](vtkSphericalStyleFilter* filter, vtkPolyData*) { filter->SetNormalBlend(NaN); },
    [](vtkSphericalStyleFilter* filter, vtkPolyData*) { filter->SetNormalBlend(0.6); });
  ExpectError(
    check, "DetailSize NaN", { "DetailSize" },
    [](vtkSphericalStyleFilter* filter, vtkPolyData*) { filter->SetDetailSize(NaN); },
    [](vtkSphericalStyleFilter* filter, vtkPolyData*) { filter->SetDetailSize(0.06); });
  ExpectError(
    check, "Tolerance NaN", { "Tolerance" },
    [](vtkSphericalStyleFilter* filter, vtkPolyData*) { filter->SetTolerance(NaN); },
    [](vtkSphericalStyleFilter* filter, vtkPolyData*) { filter->SetTolerance(1e-4); });
}

/// The opposite of SetUpEnergy with Uniform weights and a radius.
void WithDefaults(vtkSphericalStyleFilter* filter, vtkPolyData*)
{
  filter->SetRoundness(1.0);
  filter->SetNormalBlend(0.6);
  filter->SetNormalRadiusToOwnThickness();
  filter->SetDetailSize(0.06);
  filter->SetKeepSizeToArea();
  filter->SetSphericalWeightingToCotangent();
  filter->SetRadiusModeToEqualArea();
}

/// Results that their number type cannot hold.
void Ranges(Checker& check)
{
  ExpectError(
    check, "points beyond single precision",
    { "point 0 of the result", "beyond the range of single precision" },
    [](vtkSphericalStyleFilter* filter, vtkPolyData*)
    {
      filter->SetKeepSizeToOff();
      filter->SetRadiusModeToCustom();
      filter->SetRadius(1e40); // a part of it, as NormalBlend and Roundness say
      filter->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
    },
    [](vtkSphericalStyleFilter* filter, vtkPolyData*)
    {
      filter->SetKeepSizeToArea();
      filter->SetRadiusModeToEqualArea();
      filter->SetOutputPointsPrecision(vtkAlgorithm::DEFAULT_PRECISION);
    });
  ExpectError(
    check, "an energy, the square of a length, beyond double precision",
    { "the energy is beyond the range of double precision" },
    [](vtkSphericalStyleFilter* filter, vtkPolyData*)
    {
      SetUpEnergy(filter);
      filter->SetSphericalWeightingToUniform();
      filter->SetRadiusModeToCustom();
      filter->SetRadius(1e200);
    },
    WithDefaults);
  const auto scale = [](vtkPolyData* input, int exponent)
  {
    for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        MovePoint(input, i, k, std::ldexp(PointOf(input, i)[k], exponent));
      }
    }
  };
  ExpectError(
    check, "energies of a model so large that they have no number",
    { "CellEnergy at point 0", "beyond the range of double precision" },
    [&](vtkThesisStyleFilter* filter, vtkPolyData* input)
    {
      SetUpEnergy(filter);
      filter->SetSphericalWeightingToUniform();
      scale(input, 600);
      filter->GenerateCellEnergyOn();
    },
    [&](vtkThesisStyleFilter* filter, vtkPolyData* input)
    {
      scale(input, -600);
      filter->GenerateCellEnergyOff();
      WithDefaults(filter, input);
    });
}

void UnusedNumbers(Checker& check)
{
  check.About("numbers of modes that are not chosen");
  WatchedFilter filter(MakeModel());
  filter->SetRadius(-1.0);
  filter->SetCenter(NaN, 0.0, 0.0);
  filter.Output();
  check(filter.Errors.empty(), "they should not matter");
  WatchedFilter plain(MakeModel());
  check(SamePoints(filter.Output(), plain.Output()), "they should not change the result");
}

void NoVolume(Checker& check)
{
  check.About("RadiusMode EqualVolume of a planar patch");
  WatchedDefaults filter(MakeSurface(
    { { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 2, 1 } }, { { 0, 1, 2 }, { 0, 2, 3 } }));
  filter->SetRadiusModeToEqualVolume();
  vtkPolyData* output = filter.Output();
  check(filter.Errors.size() == 1 && Contains(filter.Errors[0], "RadiusMode"),
    "one error should name RadiusMode");
  check(output->GetNumberOfPoints() == 0, "the output should be empty");
  filter->SetRadiusModeToEqualArea();
  check(filter.Output()->GetNumberOfPoints() == 4 && filter.Errors.size() == 1,
    "with EqualArea it should work");
}

/// A double array of `components` for all points or cells of the model, all values `value`.
vtkSmartPointer<vtkDataArray> MakeArray(
  const char* name, vtkIdType tuples, int components, double value)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  for (int k = 0; k < components; ++k)
  {
    array->FillComponent(k, value);
  }
  return array;
}

/// No array wanted, none there.
void WithoutArrays(vtkSphericalStyleFilter* filter, vtkPolyData* input)
{
  filter->SetInputArrayToProcess(Normals, 0, 0, OfPoints, vtkDataSetAttributes::NORMALS);
  for (const int index : { RoundnessFactor, NormalBlend, TargetDirections })
  {
    filter->SetInputArrayToProcess(index, 0, 0, OfPoints, "");
  }
  filter->SetNormalBlend(0.6);
  input->GetPointData()->Initialize();
  input->GetCellData()->Initialize();
}

struct ArrayOf
{
  int index;
  const char* property;
  int components;
  double good;
};

constexpr ArrayOf AllArrays[] = { { Normals, "ormals", 3, 0.5 },
  { RoundnessFactor, "oundness factor", 1, 1.0 }, { NormalBlend, "ormal blend", 1, 0.5 },
  { TargetDirections, "arget directions", 3, 0.5 } };

void WrongArrays(Checker& check)
{
  for (const ArrayOf& a : AllArrays)
  {
    const std::string about = std::string("array of ") + a.property + ": ";
    const auto ask = [&](vtkSphericalStyleFilter* filter, int association)
    {
      filter->SetNormalBlend(a.index == Normals ? 0.5 : 0.0);
      filter->SetInputArrayToProcess(a.index, 0, 0, association, "mine");
    };
    ExpectError(
      check, about + "not there", { a.property, "\"mine\"" },
      [&](vtkSphericalStyleFilter* filter, vtkPolyData*) { ask(filter, OfPoints); }, WithoutArrays);
    ExpectError(
      check, about + "only as a cell array", { a.property, "\"mine\"" },
      [&](vtkSphericalStyleFilter* filter, vtkPolyData* input)
      {
        ask(filter, OfPoints);
        input->GetCellData()->AddArray(
          MakeArray("mine", input->GetNumberOfCells(), a.components, a.good));
      },
      WithoutArrays);
    ExpectError(
      check, about + "a cell array asked for", { a.property, "\"mine\"" },
      [&](vtkSphericalStyleFilter* filter, vtkPolyData* input)
      {
        ask(filter, OfCells);
        input->GetCellData()->AddArray(
          MakeArray("mine", input->GetNumberOfCells(), a.components, a.good));
      },
      WithoutArrays);
    ExpectError(
      check, about + "one component too many", { a.property, "\"mine\"", "component" },
      [&](vtkSphericalStyleFilter* filter, vtkPolyData* input)
      {
        ask(filter, OfPoints);
        input->GetPointData()->AddArray(
          MakeArray("mine", input->GetNumberOfPoints(), a.components + 1, a.good));
      },
      WithoutArrays);
    ExpectError(
      check, about + "of too few tuples", { a.property, "\"mine\"", "tuples" },
      [&](vtkSphericalStyleFilter* filter, vtkPolyData* input)
      {
        ask(filter, OfPoints);
        input->GetPointData()->AddArray(
          MakeArray("mine", input->GetNumberOfPoints() - 1, a.components, a.good));
      },
      WithoutArrays);
    ExpectError(
      check, about + "strings", { a.property, "\"mine\"" },
      [&](vtkSphericalStyleFilter* filter, vtkPolyData* input)
      {
        ask(filter, OfPoints);
        vtkNew<vtkStringArray> array;
        array->SetName("mine");
        array->SetNumberOfValues(input->GetNumberOfPoints());
        input->GetPointData()->AddArray(array);
      },
      WithoutArrays);
  }
}

void WrongAttributes(Checker& check)
{
  for (const ArrayOf& a : AllArrays)
  {
    for (const int attribute :
      { -1, static_cast<int>(vtkDataSetAttributes::NUM_ATTRIBUTES), 99999 })
    {
      const auto ask = [&](vtkSphericalStyleFilter* filter, int blend, const char* name)
      {
        filter->SetNormalBlend(blend);
        filter->SetInputArrayToProcess(a.index, 0, 0, OfPoints, name);
      };
      ExpectError(
        check, std::string("attribute of ") + a.property + " " + Text(attribute),
        { a.property, "attribute type " + Text(attribute) },
        [&](vtkSphericalStyleFilter* filter, vtkPolyData*)
        {
          ask(filter, a.index == Normals ? 1 : 0, "");
          filter->SetInputArrayToProcess(a.index, 0, 0, OfPoints, attribute);
        },
        [&](vtkSphericalStyleFilter* filter, vtkPolyData*)
        {
          ask(filter, 0, "");
          filter->SetNormalBlend(0.6);
        });
    }
  }
}

/// A sphere is the size of triangles; one point has none.
void PartsWithoutSphere(Checker& check)
{
  const auto without = [](vtkSphericalStyleFilter* filter, vtkPolyData* input)
  {
    filter->SetSelectionData(nullptr);
    filter->SetInputArrayToProcess(5, 0, 0, OfPoints, "");
    input->GetPointData()->Initialize();
  };
  ExpectError(
    check, "a region of one point", { "Region", "no triangle", "SphereOf WholeModel" },
    [](vtkSphericalStyleFilter* filter, vtkPolyData*)
    { filter->SetSelectionData(MakeSelection({ 5 }, vtkSelectionNode::POINT)); },
    without);
  ExpectError(
    check, "a center id of one point", { "Center id 9", "no triangle" },
    [](vtkSphericalStyleFilter* filter, vtkPolyData* input)
    {
      const auto ids = MakeArray("mine", input->GetNumberOfPoints(), 1, 7.0);
      ids->SetComponent(5, 0, 9.0);
      input->GetPointData()->AddArray(ids);
      filter->SetInputArrayToProcess(5, 0, 0, OfPoints, "mine");
    },
    without);
}

/// VTK looks at them when they are set, and not when they are changed afterwards.
void WrongComponents(Checker& check)
{
  for (const int components : { 1, 2, 4, 9 })
  {
    ExpectError(
      check, "normals of " + Text(components) + " components", { "Normals", "\"mine\"", "not 3" },
      [components](vtkSphericalStyleFilter*, vtkPolyData* input)
      {
        const auto array = MakeArray("mine", input->GetNumberOfPoints(), 3, 1.0);
        input->GetPointData()->SetNormals(array);
        array->SetNumberOfComponents(components);
        array->SetNumberOfTuples(input->GetNumberOfPoints());
      },
      WithoutArrays);
    ExpectError(
      check, "points of " + Text(components) + " components", { "Points", "not 3" },
      [components](vtkSphericalStyleFilter*, vtkPolyData* input)
      {
        vtkDataArray* array = input->GetPoints()->GetData();
        const vtkIdType n = array->GetNumberOfTuples();
        array->SetNumberOfComponents(components);
        array->SetNumberOfTuples(n);
      },
      [](vtkSphericalStyleFilter*, vtkPolyData* input) { input->DeepCopy(MakeModel()); });
  }
}

void WrongValues(Checker& check)
{
  std::vector<std::pair<ArrayOf, double>> cases;
  for (const ArrayOf& a : AllArrays)
  {
    for (const double bad : { NaN, Infinite, -Infinite })
    {
      cases.emplace_back(a, bad);
    }
  }
  cases.emplace_back(AllArrays[RoundnessFactor], -0.5);
  cases.emplace_back(AllArrays[NormalBlend], -0.01);
  cases.emplace_back(AllArrays[NormalBlend], 1.01);
  for (const auto& c : cases)
  {
    const ArrayOf& a = c.first;
    ExpectError(
      check, std::string("array of ") + a.property + " with " + vtkVariant(c.second).ToString(),
      { a.property, "\"mine\"", "point 23;" },
      [&](vtkSphericalStyleFilter* filter, vtkPolyData* input)
      {
        filter->SetNormalBlend(a.index == Normals ? 0.5 : 0.0);
        filter->SetInputArrayToProcess(a.index, 0, 0, OfPoints, "mine");
        auto array = MakeArray("mine", input->GetNumberOfPoints(), a.components, a.good);
        array->SetComponent(23, a.components - 1, c.second);
        array->SetComponent(64, 0, NaN);
        input->GetPointData()->AddArray(array);
      },
      WithoutArrays);
  }
}

/// Normals that are not used are not looked at.
void UnusedNormals(Checker& check)
{
  check.About("normals with NaN while NormalBlend is 0");
  const Surface input = MakeModel();
  auto normals = MakeArray("Normals", input->GetNumberOfPoints(), 3, 0.5);
  normals->SetComponent(3, 0, NaN);
  normals->SetComponent(4, 0, NaN);
  input->GetPointData()->SetNormals(normals);
  WatchedDefaults filter(input);
  filter->SetNormalBlend(0.0);
  vtkPolyData* output = filter.Output();
  check(filter.Errors.empty() && output->GetNumberOfPoints() > 0, "they should not matter");
  check(output->GetPointData()->GetNormals() && AllFinite(output->GetPointData()->GetNormals()),
    "they should be computed anew");
}

//------------------------------------------------------------------------------------------------
void TooFewIterations(Checker& check)
{
  check.About("MaximumNumberOfIterations reached");
  WatchedEnergy filter(MakeModel());
  filter->SetSphericalWeightingToUniform(); // the default has a closed form
  filter->SetTolerance(1e-12);
  filter->SetMaximumNumberOfIterations(2);
  vtkPolyData* output = filter.Output();
  check(filter.Errors.empty(), "it should be no error");
  check(filter.Warnings.size() == 1 && Contains(filter.Warnings[0], "MaximumNumberOfIterations"),
    "one warning should name MaximumNumberOfIterations");
  check(!filter->GetConverged(), "Converged should be false");
  check(filter->GetNumberOfIterations() == 2, "there should be 2 iterations");
  check(AllFinite(output->GetPoints()->GetData()), "the output should be usable");
  check(RadiusSpread(output) < RadiusSpread(MakeModel()), "the output should be rounder");

  filter.Warnings.clear();
  filter->SetMaximumNumberOfIterations(10000);
  filter.Output();
  check(
    filter.Warnings.empty() && filter->GetConverged(), "with enough of them it should converge");

  check.About("no iterations");
  filter->SetMaximumNumberOfIterations(0);
  check(AllFinite(filter.Output()->GetPoints()->GetData()), "the output should be usable");
  check(filter->GetNumberOfIterations() == 0, "there should be none");

  check.About("fixed iterations");
  filter.Warnings.clear();
  filter->SetStopRuleToFixedIterations();
  filter->SetMaximumNumberOfIterations(5);
  filter.Output();
  check(filter->GetNumberOfIterations() == 5 && filter.Warnings.empty(),
    "there should be 5 iterations and no warning");
  check(filter->GetConverged(), "the stop rule is met");
}

/// An open sheet of obtuse triangles, as CAD gives them.
Surface MakeSkewSheet(int side)
{
  std::vector<Vector> points;
  std::vector<std::vector<vtkIdType>> faces;
  for (int i = 0; i < side * side; ++i)
  {
    const int x = i % side;
    const int y = i / side;
    points.push_back({ x + 1.6 * y, static_cast<double>(y), 0.1 * std::sin(x) });
    if (x + 1 < side && y + 1 < side)
    {
      faces.push_back({ i, i + 1, i + side + 1 });
      faces.push_back({ i, i + side + 1, i + side });
    }
  }
  return MakeSurface(points, faces);
}

void NoMinimum(Checker& check)
{
  const Surface sheet = MakeSkewSheet(8);
  for (const bool thesis : { false, true })
  {
    check.About(thesis ? "no minimum, thesis" : "no minimum");
    WatchedEnergy filter(sheet);
    filter->SetRoundness(0.01);
    filter->SetEdgeWeightingToFullEdge();
    filter->SetSphericalWeightingToUniform();
    filter->SetReproduceThesis(thesis);
    filter->SetMaximumNumberOfIterations(5);
    vtkPolyData* output = filter.Output();
    check(filter.Errors.empty() && AllFinite(output->GetPoints()->GetData()),
      "it should be no error" + Joined(filter.Errors));
    check(filter.Warnings.size() == 1 && Contains(filter.Warnings[0], "not positive definite") &&
        Contains(filter.Warnings[0], "EdgeWeighting HalfEdge") &&
        Contains(filter.Warnings[0], "without ReproduceThesis") == thesis,
      "one warning should say so" + Joined(filter.Warnings));

    filter.Warnings.clear();
    filter->SetRoundness(5.0);
    filter->SetMaximumNumberOfIterations(10000);
    filter.Output();
    check(filter.Warnings.empty(),
      "with uniform weights this large there is one, without a word" + Joined(filter.Warnings));
    filter.Warnings.clear();
    filter->SetRoundness(0.01);
    filter->SetReproduceThesis(false);
    filter->SetEdgeWeightingToHalfEdge();
    filter.Output();
    check(filter.Warnings.empty(), "nor a word with half-edge weights" + Joined(filter.Warnings));
  }
}

struct AbortAt
{
  double progress;
  int events = 0;
};

/// Aborts from a progress observer at `progress`, as a window's abort button does.
void Abort(Checker& check, vtkPolyData* model, double progress)
{
  check.About("abort at " + vtkVariant(progress).ToString());
  WatchedFilter filter(model);
  filter->SetStopRuleToFixedIterations();
  filter->SetMaximumNumberOfIterations(10000); // minutes
  vtkNew<vtkCallbackCommand> command;
  AbortAt at{ progress };
  command->SetClientData(&at);
  command->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void* value)
    {
      auto* abort = static_cast<AbortAt*>(data);
      ++abort->events;
      if (*static_cast<double*>(value) >= abort->progress)
      {
        vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
      }
    });
  const unsigned long tag = filter->AddObserver(vtkCommand::ProgressEvent, command);
  WatchedFilter downstream;
  downstream->SetInputConnection(filter->GetOutputPort());
  downstream.Output();
  vtkPolyData* output = filter->GetOutput();
  check(filter.Errors.empty(), "abort should be no error");
  check(at.events > 0 && at.events < 1000, "it should end soon after the abort");
  check(!filter->GetConverged(), "an aborted solve should not count as converged");
  if (output->GetNumberOfPoints() > 0)
  {
    check(AllFinite(output->GetPoints()->GetData()), "what is there should be finite");
  }

  filter->RemoveObserver(tag);
  filter->SetAbortExecute(0); // VTK 9.1 does that by itself
  filter->SetStopRuleToConverged();
  filter->SetMaximumNumberOfIterations(200);
  WatchedFilter fresh(model);
  check(SamePoints(filter.Output(), fresh.Output()),
    "the next execution should give what a new filter gives");
  check(filter.Errors.empty() && filter->GetConverged(), "the next execution should be good");
  WatchedFilter freshDownstream(fresh->GetOutput());
  check(SamePoints(downstream.Output(), freshDownstream.Output()),
    "downstream the next execution should be good, too");
}

void ProgressRises(Checker& check)
{
  check.About("progress");
  WatchedEnergy filter(MakeModel());
  filter->SetSphericalWeightingToUniform(); // the default has a closed form
  filter->SetTolerance(1e-10);
  CheckProgress(check, filter.Get(), 6);

  check.About("progress of a closed form");
  WatchedFilter closed(MakeModel());
  CheckProgress(check, closed.Get(), 3);
}
}

int TestSphericalStyleFilterErrors(int argc, char* argv[])
{
  const Surface creature = ReadModel(argc, argv, "creature.vtp");
  Checker check;
  Coordinates(check);
  Numbers(check);
  Ranges(check);
  UnusedNumbers(check);
  NoVolume(check);
  WrongArrays(check);
  WrongComponents(check);
  WrongAttributes(check);
  PartsWithoutSphere(check);
  WrongValues(check);
  UnusedNormals(check);
  TooFewIterations(check);
  NoMinimum(check);
  for (const double progress : { 0.0, 0.1, 0.5 })
  {
    Abort(check, creature, progress);
  }
  ProgressRises(check);
  return check.Result();
}
