// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// What vtkSurfaceMetrics takes, what it refuses and with which words, and what it passes on.
#include "ArrayTesting.h"
#include "PropertyTesting.h"
#include "SurfaceMetricsTesting.h"

#include "vtkMultiBlockDataSet.h"

#include <sstream>

using namespace FilterTesting;

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

Surface MakeModel()
{
  return MakeEllipsoid({ 1.0, 0.8, 2.0 });
}

using Change = std::function<void(vtkSurfaceMetrics*, vtkPolyData* input, vtkPolyData* reference)>;

/// Executes after `spoil`, expects one error with all words and empty outputs; then as new after
/// `repair`.
void ExpectError(Checker& check, const std::string& about, const std::vector<std::string>& words,
  const Change& spoil, const Change& repair)
{
  check.About(about);
  const Surface input = MakeModel();
  const Surface reference = MakeModel();
  WatchedMetrics m(input, reference);
  m.ExpectSilence(check);
  spoil(m.Get(), input, reference);
  input->Modified();
  reference->Modified();
  vtkPolyData* output = m.Output();
  if (check(m.Errors.size() == 1, "there should be one error"))
  {
    for (const std::string& word : words)
    {
      check(Contains(m.Errors[0], word),
        "the error should say \"" + word + "\" and says " + m.Errors[0]);
    }
  }
  check(output->GetNumberOfPoints() == 0 && output->GetFieldData()->GetNumberOfArrays() == 0 &&
      m.Table()->GetNumberOfColumns() == 0,
    "the outputs should be empty");
  m.Errors.clear();
  repair(m.Get(), input, reference);
  input->Modified();
  reference->Modified();
  m.ExpectSilence(check);
  const Surface fresh = MakeModel();
  WatchedMetrics other(MakeModel(), fresh);
  check(SamePolyData(m.Output(), other.Output()), "repaired, it should give what a new one gives");
}

void MovePoint(vtkPolyData* surface, vtkIdType i, double z)
{
  Vector x = PointOf(surface, i);
  surface->GetPoints()->SetPoint(i, x[0], x[1], z);
  surface->GetPoints()->Modified();
}

void Errors(Checker& check)
{
  using Metrics = vtkSurfaceMetrics;
  ExpectError(
    check, "Roundness", { "Roundness", "-1" },
    [](Metrics* m, vtkPolyData*, vtkPolyData*) { m->SetRoundness(-1.0); },
    [](Metrics* m, vtkPolyData*, vtkPolyData*) { m->SetRoundness(0.5); });
  ExpectError(
    check, "Center", { "Center", "finite" },
    [](Metrics* m, vtkPolyData*, vtkPolyData*)
    {
      m->SetCenterModeToCustom();
      m->SetCenter(0.0, NaN, 0.0);
    },
    [](Metrics* m, vtkPolyData*, vtkPolyData*) { m->SetCenterModeToPointMean(); });
  const double z = PointOf(MakeModel(), 7)[2];
  ExpectError(
    check, "a point that is not finite", { "Points: point 7" },
    [](Metrics*, vtkPolyData* input, vtkPolyData*) { MovePoint(input, 7, NaN); },
    [z](Metrics*, vtkPolyData* input, vtkPolyData*) { MovePoint(input, 7, z); });
  ExpectError(
    check, "a point of the reference that is not finite", { "Reference: Points: point 7" },
    [](Metrics*, vtkPolyData*, vtkPolyData* reference) { MovePoint(reference, 7, NaN); },
    [z](Metrics*, vtkPolyData*, vtkPolyData* reference) { MovePoint(reference, 7, z); });

  const auto with = [](const Surface& other)
  { return [other](Metrics* m, vtkPolyData*, vtkPolyData*) { m->SetReferenceData(other); }; };
  const auto back = [](Metrics* m, vtkPolyData*, vtkPolyData* reference)
  { m->SetReferenceData(reference); };
  const vtkIdType n = MakeModel()->GetNumberOfPoints();
  ExpectError(check, "a reference of more points",
    { "Reference: it has " + Text(2 * n) + " points, the input " + Text(n) },
    with(Together({ MakeModel(), MakeModel() })), back);
  ExpectError(
    check, "an empty reference", { "Reference: it has 0 points" }, with(Surface::New()), back);
  ExpectError(check, "a reference of other cells", { "Reference: it has", "polygons, the input" },
    with(MakeEllipsoid({ 1.0, 0.8, 2.0 }, Faces::Quads)), back);
  Surface other = MakeModel();
  Cell cell = { 0, 1, 2 };
  other->GetPolys()->ReplaceCellAtId(5, 3, cell.data());
  ExpectError(check, "a reference with another cell", { "Reference: cell 5 has other points" },
    with(other), back);
  const Surface flat = Mapped(MakeModel(), [](const Vector&) { return Vector{ 0, 0, 0 }; });
  ExpectError(check, "a reference without an area", { "Reference", "area" }, with(flat), back);
  for (const double size : { 1e299, 1e-299 })
  {
    check.About("coordinates of " + vtkVariant(size).ToString());
    WatchedMetrics m(Mapped(MakeModel(),
      [size](const Vector& x) {
        return Vector{ size * x[0], size * x[1], size * x[2] };
      }));
    check(m.Output()->GetNumberOfPoints() == 0 && m.Errors.size() == 1 &&
        Contains(m.Errors[0], "the area of the surface is 0 or not finite"),
      "areas have no number there" + Joined(m.Errors));
  }
}

void Empty(Checker& check)
{
  check.About("empty input");
  WatchedMetrics m(Surface::New());
  m.ExpectSilence(check);
  check(m.Output()->GetNumberOfPoints() == 0 && m.Table()->GetNumberOfColumns() == 0,
    "the outputs should be empty");
  check.About("points without triangles");
  auto points = MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } }, { { 0, 1, 2 } });
  WatchedMetrics flat(points);
  check(flat.Output()->GetNumberOfPoints() == 3 && flat.Errors.empty(), "they should come out");
  check(flat.Warnings.size() == 1 && Contains(flat.Warnings[0], "no triangle"), "with a warning");
  check(flat.Table()->GetNumberOfColumns() == 0, "and nothing measured");
}

void PassedOn(Checker& check)
{
  check.About("arrays and points of the input");
  const Surface input = MakeModel();
  AddArrays(input);
  const auto copy = Surface::New();
  copy->DeepCopy(input);
  WatchedMetrics m(input, MakeModel());
  vtkPolyData* output = m.Output();
  m.ExpectSilence(check);
  check(SamePoints(output, input) && SameCells(output, input), "points and cells should stay");
  check(SameArrays(input->GetPointData(), output->GetPointData()) &&
      SameArrays(input->GetCellData(), output->GetCellData()) &&
      SameArrays(input->GetFieldData(), output->GetFieldData()) &&
      SameActiveAttributes(input->GetPointData(), output->GetPointData()),
    "and all arrays");
  check(SamePolyData(input, copy), "the input should not be touched");
  for (const char* name : { "SmallestAngle", "LargestAngle", "AreaRatio", "TurnedOver" })
  {
    vtkDataArray* array = output->GetCellData()->GetArray(name);
    check(array && array->GetNumberOfTuples() == output->GetNumberOfCells() && AllFinite(array),
      std::string("there should be the cell array ") + name);
  }
  for (const char* name : { "RadialCosine", "Opposition" })
  {
    vtkDataArray* array = output->GetPointData()->GetArray(name);
    check(array && array->GetNumberOfTuples() == output->GetNumberOfPoints() && AllFinite(array),
      std::string("there should be the point array ") + name);
  }
}

/// Degenerate triangles, points of no triangle, seams, single precision.
void Dirty(Checker& check)
{
  check.About("degenerate triangles and free points");
  const Surface input =
    MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 2, 0, 0 }, { 9, 9, 9 } },
      { { 0, 1, 2 }, { 0, 1, 3 }, { 1, 1, 2 }, { 1, 3, 2 } });
  WatchedMetrics m(input, input);
  m->EstimateConditionOn();
  m.ExpectSilence(check);
  m.Expect(check, "Triangles", 2);
  m.Expect(check, "DegenerateTriangles", 2);
  m.Expect(check, "Points", 4);
  m.Expect(check, "Area", 1.0, 1e-14);
  check(m.OfCell("AreaRatio", 0) == 1.0 && m.OfCell("AreaRatio", 1) == 0.0, "area ratios");
  check(m.OfCell("SmallestAngle", 2) == 0.0, "no angle without a triangle");
  check(m.OfPoint("RadialCosine", 4) == 0.0, "no direction without a triangle");

  check.About("a triangle that the deformation flattens");
  const Surface flattened =
    MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0.5, 0.5, 0 }, { 9, 9, 9 } },
      { { 0, 1, 2 }, { 0, 1, 3 }, { 1, 1, 2 }, { 1, 3, 2 } });
  WatchedMetrics squeezed(flattened, input);
  squeezed->EstimateConditionOn();
  squeezed.ExpectSilence(check);
  check(squeezed.OfCell("AreaRatio", 0) == 1.0 && squeezed.OfCell("AreaRatio", 3) == 0.0,
    "its ratio should be 0");
  check(squeezed["LargestAreaRatio"] == 1.0 && squeezed["AreaRatioSpread"] == 0.0,
    "and it should not take part");

  check.About("a seam");
  const Surface whole = MakeModel();
  std::vector<Vector> x;
  std::vector<Cell> cells;
  for (const auto& t : TriangleCorners(whole))
  {
    cells.push_back({});
    for (const vtkIdType i : t)
    {
      cells.back().push_back(static_cast<vtkIdType>(x.size()));
      x.push_back(PointOf(whole, i));
    }
  }
  const Surface cut = MakeSurface(x, cells); // every triangle with points of its own
  WatchedMetrics uncut(whole, whole);
  WatchedMetrics welded(cut, cut);
  welded.ExpectSilence(check);
  for (vtkIdType i = 0; i < uncut.Table()->GetNumberOfColumns(); ++i)
  {
    const char* name = uncut.Table()->GetColumnName(i);
    welded.Expect(check, name, uncut[name], 1e-9 * (1.0 + std::abs(uncut[name])));
  }
  welded->WeldCoincidentPointsOff();
  welded.Expect(check, "BorderEdges", 3.0 * static_cast<double>(cells.size()));
  welded.Expect(check, "Components", static_cast<double>(cells.size()));

  check.About("single precision");
  WatchedMetrics single(WithPointsOf(whole, VTK_FLOAT), whole);
  single.ExpectSilence(check);
  single.Expect(check, "AreaRatio", 1.0, 1e-6);
  single.Expect(check, "TurnedOver", 0);
}

void Blocks(Checker& check)
{
  check.About("multi-block input");
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeModel());
  blocks->SetBlock(1, Surface::New());
  WatchedMetrics m(nullptr);
  m->SetInputDataObject(blocks);
  m->Update();
  check(m.Errors.empty() && m.Warnings.empty(), "the filter should say nothing");
  auto* output = vtkMultiBlockDataSet::SafeDownCast(m->GetOutputDataObject(0));
  auto* tables = vtkMultiBlockDataSet::SafeDownCast(m->GetOutputDataObject(1));
  if (check(output && tables && tables->GetNumberOfBlocks() == 2, "blocks should give blocks"))
  {
    WatchedMetrics alone(MakeModel());
    check(SamePolyData(vtkPolyData::SafeDownCast(output->GetBlock(0)), alone.Output()),
      "block 0 should be as it is alone");
    auto* table = vtkTable::SafeDownCast(tables->GetBlock(0));
    check(table && table->GetNumberOfRows() == 1, "with a table of its own");
  }
}

void WithoutCgal(Checker& check)
{
  check.About("self-intersections in a build without CGAL");
  WatchedMetrics m(MakeModel());
  m->FindSelfIntersectionsOn();
  m.Output();
  check(m.Warnings.size() == 1 && Contains(m.Warnings[0], "CGAL"), "it should say why not");
  check(m.Has("Area") && !m.Has("SelfIntersectionPairs"), "and measure the rest");
}

void Properties(Checker& check)
{
  check.About("properties");
  using FilterType = vtkSurfaceMetrics;
  vtkNew<FilterType> filter;
  RoundTrip(CenterMode, FilterType::POINT_MEAN, FilterType::CUSTOM_CENTER);
  RoundTrip(Roundness, 0.5, 2.0);
  OnOff(FindSelfIntersections, true);
  OnOff(EstimateCondition, false);
  OnOff(WeldCoincidentPoints, true);
  Clamped(CenterMode, -1, FilterType::POINT_MEAN);
  Clamped(CenterMode, 7, FilterType::CUSTOM_CENTER);
  Mode(CenterMode, PointMean, POINT_MEAN, 0);
  Mode(CenterMode, AreaCentroid, AREA_CENTROID, 1);
  Mode(CenterMode, Custom, CUSTOM_CENTER, 2);
  std::ostringstream printed;
  filter->Print(printed);
  for (const char* name : { "CenterMode", "Center", "FindSelfIntersections", "EstimateCondition",
         "Roundness", "WeldCoincidentPoints" })
  {
    check(Contains(printed.str(), std::string(" ") + name + ": "),
      std::string("PrintSelf should print ") + name);
  }
}
}

int TestSurfaceMetricsInputs(int, char*[])
{
  Checker check;
  Errors(check);
  Empty(check);
  PassedOn(check);
  Dirty(check);
  Blocks(check);
  Properties(check);
  if (!WithCgal)
  {
    WithoutCgal(check);
  }
  return check.Result();
}
