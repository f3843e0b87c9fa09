// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Every way to ask for what cannot be done: one error that names the cause, empty outputs, and a
/// filter that works again once the cause is gone. Then warnings, and abort.
#include "ConvexProxyTesting.h"

#include "vtkStringArray.h"

#include <limits>

using namespace FilterTesting;

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinite = std::numeric_limits<double>::infinity();

using Change = std::function<void(vtkConvexProxyDeformFilter*, vtkPolyData*)>;

/// Back to what a new filter has, and the model without arrays.
void Repair(vtkConvexProxyDeformFilter* filter, vtkPolyData* input)
{
  filter->SetProxyMesherToIsotropicRemeshing();
  filter->SetRoundness(5.0);
  filter->SetCenterModeToAreaCentroid();
  filter->SetRadiusModeToEqualArea();
  filter->SetProjectionToClosestPoint();
  filter->SetBlendFunctionToConstant();
  filter->SetBlend(0.5);
  filter->SetBlendAxis(0.0, 1.0, 0.0);
  filter->SetBlendRange(0.0, 1.0);
  filter->SetBlendAtStart(0.0);
  filter->SetBlendAtEnd(1.0);
  filter->SetTanhSteepness(3.0);
  filter->SetAxisGain(1.0, 1.0, 1.0);
  filter->SetBorderWidth(0.2);
  filter->SetProxyConnection(nullptr);
  filter->SetSelectionConnection(nullptr);
  filter->SetInputArrayToProcess(NormalsArray, 0, 0, OfPoints, vtkDataSetAttributes::NORMALS);
  for (const int index : { DirectionsArray, BlendArray, RegionArray })
  {
    filter->SetInputArrayToProcess(index, 0, 0, OfPoints, "");
  }
  const Surface good = MakeDented();
  input->DeepCopy(good);
}

/// Executes after `spoil`, expects one error with all `words`, then executes after Repair and
/// expects what a new filter gives.
void ExpectError(Checker& check, const std::string& about, const std::vector<std::string>& words,
  const Change& spoil)
{
  check.About(about);
  const Surface input = MakeDented();
  WatchedProxyFilter filter(input);
  filter.Output(); // there is an old result that must go
  check(filter.Errors.empty(), "the model should be good before");
  filter.Warnings.clear();
  spoil(filter.Get(), input);
  input->Modified();
  filter.Output();
  if (check(filter.Errors.size() == 1,
        "there should be one error, not " + Text(static_cast<vtkIdType>(filter.Errors.size())) +
          Joined(filter.Errors)))
  {
    for (const std::string& word : words)
    {
      check(Contains(filter.Errors[0], word),
        "the error should say \"" + word + "\" and says " + filter.Errors[0]);
    }
  }
  for (int port = 0; port < 3; ++port)
  {
    vtkPolyData* output = filter.Output(port);
    check(output->GetNumberOfPoints() == 0 && output->GetNumberOfCells() == 0 &&
        output->GetPointData()->GetNumberOfArrays() == 0,
      "output " + Text(port) + " should be empty");
  }
  check(filter->GetEffectiveNumberOfProxyPoints() == 0 && filter->GetEffectiveProxyMesher() == -1,
    "the facts should be those of nothing");

  filter.Errors.clear();
  filter.Warnings.clear();
  Repair(filter.Get(), input);
  vtkPolyData* output = filter.Output();
  check(filter.Errors.empty() && filter.Warnings.empty(),
    "repaired, it should say nothing, says" + Joined(filter.Errors) + Joined(filter.Warnings));
  WatchedProxyFilter fresh(MakeDented());
  check(SamePolyData(output, fresh.Output()), "repaired, it should give what a new filter gives");
}

void MovePoint(vtkPolyData* surface, vtkIdType i, int axis, double to)
{
  Vector x = PointOf(surface, i);
  x[axis] = to;
  surface->GetPoints()->SetPoint(i, x.data());
  surface->GetPoints()->Modified();
}

void Models(Checker& check)
{
  const vtkIdType last = MakeDented()->GetNumberOfPoints() - 1;
  for (const double bad : { NaN, Infinite, -Infinite })
  {
    for (const vtkIdType i : { vtkIdType(0), vtkIdType(7), last })
    {
      ExpectError(check, "coordinate " + vtkVariant(bad).ToString() + " of point " + Text(i),
        { "Points", "point " + Text(i) + " " },
        [&](vtkConvexProxyDeformFilter*, vtkPolyData* input)
        {
          MovePoint(input, i, static_cast<int>(i % 3), bad);
          MovePoint(input, last, 0, NaN);
        });
    }
  }
  for (const vtkIdType bad :
    { vtkIdType(-1), MakeDented()->GetNumberOfPoints(), vtkIdType(1) << 40 })
  {
    ExpectError(check, "a cell with point id " + Text(bad), { "cell 3 ", "point " + Text(bad) },
      [&](vtkConvexProxyDeformFilter*, vtkPolyData* input)
      {
        const vtkIdType ids[] = { 0, 1, bad };
        input->GetPolys()->ReplaceCellAtId(3, 3, ids);
      });
  }
  ExpectError(check, "too few active normals", { "Normals", "\"few\"", "7 tuples" },
    [](vtkConvexProxyDeformFilter*, vtkPolyData* input)
    {
      vtkNew<vtkDoubleArray> few;
      few->SetName("few");
      few->SetNumberOfComponents(3);
      few->SetNumberOfTuples(7);
      input->GetPointData()->SetNormals(few);
    });
  const auto flatten = [](const std::function<Vector(const Vector&)>& map)
  {
    return [map](vtkConvexProxyDeformFilter*, vtkPolyData* input)
    { input->SetPoints(Mapped(input, map)->GetPoints()); };
  };
  ExpectError(check, "all points on a line", { "line" },
    flatten(
      [](const Vector& x) {
        return Vector{ x[0], 2.0 * x[0] + 1.0, -x[0] };
      }));
  ExpectError(check, "all points at one place", { "one place" },
    flatten(
      [](const Vector&) {
        return Vector{ 0.1, 1e5, 3.0 };
      }));
  for (const vtkIdType n : { 1, 2 })
  {
    ExpectError(check, Text(n) + " points", { n == 1 ? "one place" : "line" },
      [n](vtkConvexProxyDeformFilter*, vtkPolyData* input)
      {
        input->Initialize();
        vtkNew<vtkPoints> points;
        for (vtkIdType i = 0; i < n; ++i)
        {
          points->InsertNextPoint(1.0 * i, 2.0, 3.0);
        }
        input->SetPoints(points);
      });
  }
}

void Numbers(Checker& check)
{
  const auto set = [&](const std::string& name, double bad,
                     const std::function<void(vtkConvexProxyDeformFilter*)>& change)
  {
    ExpectError(check, name + " " + vtkVariant(bad).ToString(), { name },
      [&](vtkConvexProxyDeformFilter* filter, vtkPolyData*) { change(filter); });
  };
  for (const double bad : { -1.0, -1e-300, NaN, Infinite })
  {
    set("Roundness", bad, [&](auto* filter) { filter->SetRoundness(bad); });
    set("AxisGain", bad, [&](auto* filter) { filter->SetAxisGain(1.0, bad, 1.0); });
  }
  for (const double bad : { 0.0, -1.0, NaN, Infinite })
  {
    set("Radius", bad,
      [&](auto* filter)
      {
        filter->SetRadiusModeToCustom();
        filter->SetRadius(bad);
      });
    set("TanhSteepness", bad,
      [&](auto* filter)
      {
        filter->SetBlendFunctionToTanh();
        filter->SetTanhSteepness(bad);
      });
  }
  for (const double bad : { NaN, Infinite })
  {
    set("Center", bad,
      [&](auto* filter)
      {
        filter->SetCenterModeToCustom();
        filter->SetCenter(0.0, bad, 0.0);
      });
    set("BlendAxis", bad,
      [&](auto* filter)
      {
        filter->SetBlendFunctionToLinear();
        filter->SetBlendAxis(0.0, bad, 1.0);
      });
    set("BlendRange", bad,
      [&](auto* filter)
      {
        filter->SetBlendFunctionToQuadratic();
        filter->SetBlendRange(0.0, bad);
      });
  }
  set("BlendAxis", 0.0,
    [&](auto* filter)
    {
      filter->SetBlendFunctionToSmoothstep();
      filter->SetBlendAxis(0.0, 0.0, 0.0);
    });
  set("BlendRange", 0.5,
    [&](auto* filter)
    {
      filter->SetBlendFunctionToLinear();
      filter->SetBlendRange(0.5, 0.5);
    });
  // NaN passes a clamp.
  set("Blend", NaN, [](auto* filter) { filter->SetBlend(NaN); });
  set("BorderWidth", NaN, [](auto* filter) { filter->SetBorderWidth(NaN); });
  set("BlendAtStart", NaN,
    [](auto* filter)
    {
      filter->SetBlendFunctionToLinear();
      filter->SetBlendAtStart(NaN);
    });
  set("BlendAtEnd", NaN,
    [](auto* filter)
    {
      filter->SetBlendFunctionToLinear();
      filter->SetBlendAtEnd(NaN);
    });
}

/// What is not chosen does not matter.
void UnusedNumbers(Checker& check)
{
  check.About("numbers of modes that are not chosen");
  WatchedProxyFilter filter(MakeDented());
  filter->SetRadius(-1.0);
  filter->SetCenter(NaN, 0.0, 0.0);
  filter->SetTanhSteepness(-1.0);
  filter->SetBlendAxis(0.0, 0.0, 0.0);
  filter->SetBlendRange(1.0, 0.0);
  filter.Output();
  check(filter.Errors.empty(), "they should not matter" + Joined(filter.Errors));
  WatchedProxyFilter plain(MakeDented());
  check(SamePoints(filter.Output(), plain.Output()), "they should not change the result");
}

struct ArrayOf
{
  int index;
  const char* purpose;
  int components;
};

constexpr ArrayOf AllArrays[] = { { NormalsArray, "Normals", 3 },
  { DirectionsArray, "Directions", 3 }, { BlendArray, "Blend array", 1 },
  { RegionArray, "Region", 1 } };

/// Asks for the array "mine", and for what uses it.
void Ask(vtkConvexProxyDeformFilter* filter, const ArrayOf& a, int association = OfPoints)
{
  filter->SetInputArrayToProcess(a.index, 0, 0, association, "mine");
  if (a.index == NormalsArray)
  {
    filter->SetProjectionToSmallestAngle();
  }
  else if (a.index == DirectionsArray)
  {
    filter->SetProjectionToDirectionArray();
  }
  else if (a.index == BlendArray)
  {
    filter->SetBlendFunctionToArray();
  }
}

vtkSmartPointer<vtkDoubleArray> Mine(vtkPolyData* input, int components, double value = 0.5)
{
  return MakeArray("mine", input, components, [value](vtkIdType, int) { return value; });
}

void WrongArrays(Checker& check)
{
  for (const ArrayOf& a : AllArrays)
  {
    const std::string about = std::string("array of ") + a.purpose + ": ";
    ExpectError(check, about + "not there", { a.purpose, "\"mine\"" },
      [&](vtkConvexProxyDeformFilter* filter, vtkPolyData*) { Ask(filter, a); });
    for (const int association : { OfPoints, OfCells })
    {
      ExpectError(check, about + "only as a cell array", { a.purpose, "\"mine\"" },
        [&](vtkConvexProxyDeformFilter* filter, vtkPolyData* input)
        {
          Ask(filter, a, association);
          auto array = Mine(input, a.components);
          array->SetNumberOfTuples(input->GetNumberOfCells());
          input->GetCellData()->AddArray(array);
        });
    }
    for (const int components : { 2, 4 })
    {
      ExpectError(check, about + Text(components) + " components",
        { a.purpose, "\"mine\"", Text(components) + " component" },
        [&](vtkConvexProxyDeformFilter* filter, vtkPolyData* input)
        {
          Ask(filter, a);
          input->GetPointData()->AddArray(Mine(input, components));
        });
    }
    ExpectError(check, about + "too few tuples", { a.purpose, "\"mine\"", "9 tuples" },
      [&](vtkConvexProxyDeformFilter* filter, vtkPolyData* input)
      {
        Ask(filter, a);
        auto array = Mine(input, a.components);
        array->SetNumberOfTuples(9);
        input->GetPointData()->AddArray(array);
      });
    ExpectError(check, about + "strings", { a.purpose, "\"mine\"" },
      [&](vtkConvexProxyDeformFilter* filter, vtkPolyData* input)
      {
        Ask(filter, a);
        vtkNew<vtkStringArray> array;
        array->SetName("mine");
        array->SetNumberOfValues(input->GetNumberOfPoints());
        input->GetPointData()->AddArray(array);
      });
  }
  ExpectError(check, "BlendFunction Array without an array", { "Blend array", "index 2" },
    [](vtkConvexProxyDeformFilter* filter, vtkPolyData*) { filter->SetBlendFunctionToArray(); });
  ExpectError(check, "Projection DirectionArray without an array", { "Directions", "index 1" },
    [](vtkConvexProxyDeformFilter* filter, vtkPolyData*)
    { filter->SetProjectionToDirectionArray(); });
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
  for (const double bad : { -0.01, 1.01, 7.0, -1e-300 })
  {
    cases.emplace_back(AllArrays[BlendArray], bad);
    cases.emplace_back(ArrayOf{ BlendArray, "Blend array", 3 }, bad);
  }
  for (const auto& c : cases)
  {
    const ArrayOf& a = c.first;
    ExpectError(check,
      std::string("array of ") + a.purpose + " with " + vtkVariant(c.second).ToString(),
      { a.purpose, "\"mine\"", "point 23;" },
      [&](vtkConvexProxyDeformFilter* filter, vtkPolyData* input)
      {
        Ask(filter, a);
        auto array = Mine(input, a.components);
        array->SetComponent(23, a.components - 1, c.second);
        array->SetComponent(64, 0, NaN);
        input->GetPointData()->AddArray(array);
      });
  }
}

/// Arrays that are not used are not looked at.
void UnusedArrays(Checker& check)
{
  check.About("bad arrays that nothing uses");
  const Surface input = MakeDented();
  auto bad = Mine(input, 3, NaN);
  bad->SetName("Normals");
  input->GetPointData()->SetNormals(bad);
  WatchedProxyFilter filter(input);
  filter->SetInputArrayToProcess(DirectionsArray, 0, 0, OfPoints, "nowhere");
  filter->SetInputArrayToProcess(BlendArray, 0, 0, OfPoints, "nowhere");
  vtkPolyData* output = filter.Output();
  check(filter.Errors.empty() && output->GetNumberOfPoints() > 0,
    "they should not matter" + Joined(filter.Errors));
}

void Proxies(Checker& check)
{
  const auto with =
    [&](const std::string& about, vtkPolyData* proxy, const std::vector<std::string>& words)
  {
    ExpectError(check, "own proxy: " + about, words,
      [proxy](vtkConvexProxyDeformFilter* filter, vtkPolyData*) { filter->SetProxyData(proxy); });
  };
  with("nothing at all", Surface::New(), { "Proxy" });
  with("no points", MakeSurface({}, {}), { "Proxy" });
  with("only points", MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, {}), { "Proxy" });
  const Surface lines = MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, {});
  lines->SetLines(MakeCells({ { 0, 1, 2 } }));
  lines->SetVerts(MakeCells({ { 0 } }));
  with("only lines", lines, { "Proxy" });
  with("only degenerate triangles",
    MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } }, { { 0, 1, 2 }, { 0, 0, 1 } }),
    { "Proxy" });
  Surface nan = MakeEllipsoid({ 1.2, 1.0, 2.2 });
  MovePoint(nan, 11, 1, NaN);
  with("a point that is not finite", nan, { "Proxy", "point 11 " });
  Surface wrong = MakeEllipsoid({ 1.2, 1.0, 2.2 });
  const vtkIdType ids[] = { 0, 1, 4711 };
  wrong->GetPolys()->ReplaceCellAtId(5, 3, ids);
  with("a cell with a wrong point id", wrong, { "Proxy", "cell 5 ", "point 4711" });
  ExpectError(check, "own proxy: no volume", { "RadiusMode" },
    [](vtkConvexProxyDeformFilter* filter, vtkPolyData*)
    {
      filter->SetRadiusModeToEqualVolume();
      filter->SetProxyData(
        MakeSurface({ { 0, 0, 0 }, { 3, 0, 0 }, { 3, 3, 0 }, { 0, 3, 0 } }, { { 0, 1, 2, 3 } }));
    });
}

void Selections(Checker& check)
{
  ExpectError(check, "selection by a query", { "Selection", "query" },
    [](vtkConvexProxyDeformFilter* filter, vtkPolyData*)
    {
      vtkNew<vtkSelectionNode> node;
      node->SetFieldType(vtkSelectionNode::POINT);
      node->SetContentType(vtkSelectionNode::QUERY);
      node->SetQueryString("id < 7");
      vtkNew<vtkSelection> selection;
      selection->AddNode(node);
      filter->SetSelectionData(selection);
    });
  for (const int field : { vtkSelectionNode::FIELD, vtkSelectionNode::ROW, vtkSelectionNode::EDGE,
         vtkSelectionNode::VERTEX })
  {
    ExpectError(check, "selection of field type " + Text(field), { "Selection" },
      [field](vtkConvexProxyDeformFilter* filter, vtkPolyData*) {
        filter->SetSelectionData(MakeSelection({ 1, 2 }, field));
      });
  }
  // vtkExtractSelection ends the process over the first and selects nothing over the others.
  for (const int content : { vtkSelectionNode::USER, vtkSelectionNode::NUM_CONTENT_TYPES,
         vtkSelectionNode::LOCATIONS, vtkSelectionNode::FRUSTUM, vtkSelectionNode::THRESHOLDS })
  {
    ExpectError(check, "selection of content type " + Text(content), { "Selection" },
      [content](vtkConvexProxyDeformFilter* filter, vtkPolyData*) {
        filter->SetSelectionData(MakeSelection({ 1, 2, 3 }, vtkSelectionNode::POINT, content));
      });
  }
  // It ends the process over lists that are no numbers, and over arrays that are too short.
  for (const int content : { vtkSelectionNode::GLOBALIDS, vtkSelectionNode::PEDIGREEIDS,
         vtkSelectionNode::VALUES, vtkSelectionNode::INDICES, vtkSelectionNode::FRUSTUM,
         vtkSelectionNode::LOCATIONS, vtkSelectionNode::THRESHOLDS, vtkSelectionNode::BLOCKS })
  {
    ExpectError(check, "selection by strings, content type " + Text(content),
      { "Selection", "must be numbers" },
      [content](vtkConvexProxyDeformFilter* filter, vtkPolyData* input)
      {
        input->GetPointData()->AddArray(MakeArray("mine", input, 1, [](auto, int) { return 1.0; }));
        const auto selection = MakeSelection({}, vtkSelectionNode::POINT, content);
        selection->GetNode(0)->SetSelectionList(MakeStrings("mine", 32));
        filter->SetSelectionData(selection);
      });
  }
  for (const int content : { vtkSelectionNode::VALUES, vtkSelectionNode::THRESHOLDS })
  {
    ExpectError(check, "selection by a short array, content type " + Text(content),
      { "\"mine\" has 3 tuples" },
      [content](vtkConvexProxyDeformFilter* filter, vtkPolyData* input)
      {
        input->GetPointData()->AddArray(MakeAny<vtkDoubleArray>("mine", 3, 1));
        const auto selection = MakeSelection({}, vtkSelectionNode::POINT, content);
        selection->GetNode(0)->SetSelectionList(MakeAny<vtkDoubleArray>("mine", 2, 1));
        filter->SetSelectionData(selection);
      });
  }
}

//------------------------------------------------------------------------------------------------
void ExpectWarnings(
  Checker& check, const std::string& about, vtkPolyData* input,
  const std::vector<std::string>& warnings,
  const std::function<void(vtkConvexProxyDeformFilter*)>& change = [](auto*) {})
{
  check.About(about);
  WatchedProxyFilter filter(input);
  change(filter.Get());
  vtkPolyData* output = filter.Output();
  check(filter.Errors.empty(), "there should be no error" + Joined(filter.Errors));
  check(output->GetNumberOfPoints() == input->GetNumberOfPoints() &&
      AllFinite(output->GetPoints()->GetData()),
    "the result should be whole");
  check(filter.Warnings.size() == warnings.size(),
    "there should be " + Text(static_cast<vtkIdType>(warnings.size())) + " warnings, not" +
      Joined(filter.Warnings));
  for (std::size_t i = 0; i < std::min(warnings.size(), filter.Warnings.size()); ++i)
  {
    check(Contains(filter.Warnings[i], warnings[i]),
      "warning " + Text(static_cast<vtkIdType>(i)) + " should say \"" + warnings[i] +
        "\" and says " + filter.Warnings[i]);
  }
}

void Warnings(Checker& check)
{
  const Surface flat = Mapped(MakeDented(),
    [](const Vector& x) {
      return Vector{ x[0], x[1], 0.5 * x[0] };
    });
  ExpectWarnings(check, "planar", flat, { "plane" });
  for (const int mesher : { 1, 2 })
  {
    ExpectWarnings(check, "planar, sampled", flat, { "IsotropicRemeshing", "plane" },
      [mesher](auto* filter) { filter->SetProxyMesher(mesher); });
    const Surface plate = Mapped(MakeDented(),
      [](const Vector& x) {
        return Vector{ x[0], x[1], 1e-3 * x[2] };
      });
    ExpectWarnings(check, "a thin plate, sampled", plate, { "IsotropicRemeshing" },
      [mesher](auto* filter) { filter->SetProxyMesher(mesher); });
  }
  // Two balls far apart fill little of their hull.
  const Surface ball = MakeEllipsoid({ 1.0, 1.0, 1.0 });
  ExpectWarnings(check, "far from convex",
    Together(
      { Shifted(ball, { -9, 0, 0 }), Shifted(ball, { 9, 0, 0 }), Shifted(ball, { 0, 9, 0 }) }),
    { "convex hull" }, [](auto* filter) { filter->SetBlend(0.95); });
  const Surface missing = MakeDented();
  auto directions = MakeArray("d", missing, 3, [](vtkIdType, int k) { return k == 0 ? 1.0 : 0.0; });
  missing->GetPointData()->AddArray(directions);
  ExpectWarnings(check, "directions that meet no proxy", missing, { "point 0;" },
    [](auto* filter)
    {
      filter->SetInputArrayToProcess(DirectionsArray, 0, 0, OfPoints, "d");
      filter->SetProjectionToDirectionArray();
      filter->SetProxyData(Shifted(MakeEllipsoid({ 1.0, 1.0, 1.0 }), { 0, 50, 0 }));
      filter->SetBlend(0.99);
    });
}

//------------------------------------------------------------------------------------------------
struct AbortAt
{
  double progress;
  int events = 0;
};

/// Aborts from a progress observer at `progress`, as a window's abort button does.
int Abort(Checker& check, vtkPolyData* model, double progress)
{
  check.About("abort at " + vtkVariant(progress).ToString());
  WatchedProxyFilter filter(model);
  filter->SetProjectionToSmallestAngle();
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
  WatchedProxyFilter downstream;
  downstream->SetInputConnection(filter->GetOutputPort());
  downstream.Output();
  check(filter.Errors.empty(), "abort should be no error" + Joined(filter.Errors));
  check(downstream.Errors.empty(), "downstream should bear it" + Joined(downstream.Errors));
  check(at.events > 0, "it should tell its progress");
  if (filter->GetOutput()->GetNumberOfPoints() > 0)
  {
    check(AllFinite(filter->GetOutput()->GetPoints()->GetData()), "what is there is finite");
  }
  filter->RemoveObserver(tag);
  filter->SetAbortExecute(0); // VTK 9.1 does that by itself
  filter->Modified();
  WatchedProxyFilter fresh(model);
  fresh->SetProjectionToSmallestAngle();
  check(SamePolyData(filter.Output(), fresh.Output()),
    "the next execution should give what a new filter gives");
  WatchedProxyFilter freshDownstream(fresh->GetOutput());
  check(SamePoints(downstream.Output(), freshDownstream.Output()),
    "downstream the next execution should be good, too");
  return at.events;
}

void ProgressRises(Checker& check)
{
  check.About("progress");
  WatchedProxyFilter filter(MakeDented());
  CheckProgress(check, filter.Get(), 5);
}
}

int TestConvexProxyDeformFilterErrors(int argc, char* argv[])
{
  const Surface creature = ReadModel(argc, argv, "creature.vtp");
  Checker check;
  Models(check);
  Numbers(check);
  UnusedNumbers(check);
  WrongArrays(check);
  WrongValues(check);
  UnusedArrays(check);
  Proxies(check);
  Selections(check);
  Warnings(check);
  for (const double progress : { 0.0, 0.1, 0.37, 0.45, 0.55, 0.8, 0.95 })
  {
    Abort(check, creature, progress);
  }
  ProgressRises(check);
  return check.Result();
}
