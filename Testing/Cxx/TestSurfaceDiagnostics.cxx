// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// What vtkSurfaceDiagnostics says of surfaces with defects made by hand, in table and arrays; what
/// it takes, refuses and passes on.
#include "ArrayTesting.h"
#include "PropertyTesting.h"

#include "vtkMultiBlockDataSet.h"
#include "vtkSurfaceDiagnostics.h"
#include "vtkTable.h"

#include <limits>
#include <sstream>

using namespace FilterTesting;

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// In the order of the table; the first 13 are the bits of Diagnosis.
const std::vector<std::string> AllNames = { "NonFinitePoints", "CoincidentPoints", "UnusedPoints",
  "NonManifoldPoints", "DegenerateTriangles", "DuplicateTriangles", "Slivers", "ObtuseTriangles",
  "NonManifoldEdges", "BorderEdges", "MisorientedEdges", "NegativeWeights", "InsideOutComponents",
  "BorderLoops", "Components", "UncutPolygons", "ExtremeScale", "FewDigits", "ManyTriangles" };
constexpr int Bits = 13;
constexpr int PointBits = 4; // and edges
constexpr int FirstEdgeBit = 8;
constexpr int LastEdgeBit = 11;

class Diagnostics : public Watched<vtkSurfaceDiagnostics>
{
public:
  explicit Diagnostics(vtkPolyData* input) { this->Get()->SetInputData(input); }

  vtkTable* Table()
  {
    this->Get()->Update();
    return vtkTable::SafeDownCast(this->Get()->GetOutputDataObject(1));
  }

  vtkVariant Entry(const std::string& name, const char* column)
  {
    for (vtkIdType row = 0; row < this->Table()->GetNumberOfRows(); ++row)
    {
      if (this->Table()->GetValueByName(row, "Name").ToString() == name)
      {
        return this->Table()->GetValueByName(row, column);
      }
    }
    return {};
  }

  void Expect(Checker& check, const std::string& name, vtkIdType count, vtkIdType first)
  {
    const vtkIdType counted = this->Entry(name, "Count").ToTypeInt64();
    const vtkIdType id = this->Entry(name, "FirstId").ToTypeInt64();
    check(counted == count && id == first,
      name + " should be " + Text(count) + " from " + Text(first) + " on and is " + Text(counted) +
        " from " + Text(id) + " on");
  }

  double OfPoint(const std::string& name, vtkIdType i)
  {
    return this->Output()->GetPointData()->GetArray(name.c_str())->GetComponent(i, 0);
  }

  double OfCell(const std::string& name, vtkIdType i)
  {
    return this->Output()->GetCellData()->GetArray(name.c_str())->GetComponent(i, 0);
  }
};

/// The arrays of 0 and 1 say what Diagnosis says, and so does the table.
void CheckMarks(Checker& check, Diagnostics& d, vtkDataSetAttributes* attributes, vtkIdType n,
  const std::function<bool(int)>& there)
{
  vtkDataArray* mask = attributes->GetArray("Diagnosis");
  if (!check(mask && mask->GetNumberOfTuples() == n, "there should be a Diagnosis of all"))
  {
    return;
  }
  for (int k = 0; k < Bits; ++k)
  {
    vtkDataArray* array = attributes->GetArray(AllNames[k].c_str());
    check((array != nullptr) == there(k), AllNames[k] + " should be there where it can be marked");
    vtkIdType first = -1;
    for (vtkIdType i = 0; array && i < n; ++i)
    {
      const bool bit = (static_cast<int>(mask->GetComponent(i, 0)) >> k & 1) != 0;
      check(array->GetComponent(i, 0) == (bit ? 1.0 : 0.0), AllNames[k] + " should be its bit");
      first = first < 0 && bit ? i : first;
    }
    const bool named = (d.Entry(AllNames[k], "Association").ToString() == "point") ==
      (attributes == d.Output()->GetPointData());
    check(!array || !named || d.Entry(AllNames[k], "FirstId").ToTypeInt64() == first,
      AllNames[k] + " should name the first that is marked");
  }
}

/// What always holds.
void CheckSound(Checker& check, Diagnostics& d, vtkPolyData* input)
{
  const auto before = Surface::New();
  before->DeepCopy(input);
  vtkPolyData* output = d.Output();
  check(d.Errors.empty() && d.Warnings.empty(), "it should say nothing" + Joined(d.Errors));
  check(SamePolyData(before, input), "the input should be unchanged to the bit");
  check(SamePoints(input, output) && SameCells(input, output), "points and cells should stay");
  check(SameArrays(input->GetPointData(), output->GetPointData()) &&
      SameArrays(input->GetCellData(), output->GetCellData()) &&
      SameArrays(input->GetFieldData(), output->GetFieldData()),
    "and all arrays");
  vtkTable* table = d.Table();
  if (check(table->GetNumberOfRows() == static_cast<vtkIdType>(AllNames.size()),
        "all rows should be there"))
  {
    for (std::size_t row = 0; row < AllNames.size(); ++row)
    {
      const auto at = static_cast<vtkIdType>(row);
      check(table->GetValueByName(at, "Name").ToString() == AllNames[row], "rows in their order");
      check(std::isfinite(table->GetValueByName(at, "Value").ToDouble()), "values are finite");
      check(table->GetValueByName(at, "Meaning").ToString().size() > 10 &&
          table->GetValueByName(at, "Consequence").ToString().size() > 10,
        "there should be words for " + AllNames[row]);
    }
  }
  CheckMarks(check, d, output->GetPointData(), output->GetNumberOfPoints(),
    [](int k) { return k < PointBits || (k >= FirstEdgeBit && k <= LastEdgeBit); });
  CheckMarks(check, d, output->GetCellData(), output->GetNumberOfCells(),
    [](int k) { return k >= PointBits; });
  check(output->GetCellData()->GetArray("Component") &&
      output->GetCellData()->GetArray("Component")->GetNumberOfTuples() ==
        output->GetNumberOfCells(),
    "there should be a Component for all cells");
}

void Sound(Checker& check)
{
  check.About("a sound surface");
  const Surface input = MakeEllipsoid({ 1.0, 1.0, 1.0 }, Faces::Quads);
  AddArrays(input);
  Diagnostics d(input);
  CheckSound(check, d, input);
  for (const char* name :
    { "NonFinitePoints", "CoincidentPoints", "UnusedPoints", "NonManifoldPoints",
      "DegenerateTriangles", "DuplicateTriangles", "Slivers", "NonManifoldEdges", "BorderEdges",
      "MisorientedEdges", "InsideOutComponents", "BorderLoops", "UncutPolygons" })
  {
    d.Expect(check, name, 0, -1);
  }
  d.Expect(check, "Components", 1, -1);
  check.AtMost(std::abs(d.Entry("ExtremeScale", "Value").ToDouble() / Diagonal(input) - 1.0), 1e-14,
    "difference of the diagonal");
}

/// Cells of all kinds with one defect each; ids count vertices and lines, too.
void Dirty(Checker& check)
{
  check.About("one of each");
  const Surface input = MakeEllipsoid({ 1.0, 1.0, 1.0 });
  const vtkIdType n = input->GetNumberOfPoints();
  const vtkIdType m = input->GetNumberOfPolys();
  vtkPoints* points = input->GetPoints();
  points->InsertNextPoint(0.0, NaN, 0.0);      // n: of a triangle
  points->InsertNextPoint(input->GetPoint(5)); // n + 1: on point 5, of a triangle
  points->InsertNextPoint(9.0, 9.0, 9.0);      // n + 2: of a line alone
  points->InsertNextPoint(4.0, 0.0, 0.0);      // n + 3 ... n + 6: a quad, bent a little
  points->InsertNextPoint(5.0, 0.0, 0.0);
  points->InsertNextPoint(5.0, 1.0, 0.1);
  points->InsertNextPoint(4.0, 1.0, 0.0);
  points->InsertNextPoint(6.0, 0.0, 0.0); // n + 7 ... n + 9: a sliver, apart
  points->InsertNextPoint(7.0, 0.0, 0.0);
  points->InsertNextPoint(6.5, 0.001, 0.0);
  input->SetVerts(MakeCells({ { 0 }, { n, 3 } }));
  input->SetLines(MakeCells({ { n + 2, 1 } }));
  vtkNew<vtkIdList> corners;
  input->GetPolys()->GetCellAtId(3, corners);
  const Cell again(corners->begin(), corners->end());
  for (const Cell& cell : { Cell{ 0, 1, n }, Cell{ 5, n + 1, 7 }, again,
         Cell{ n + 3, n + 4, n + 5, n + 6 }, Cell{ n + 7, n + 8, n + 9 } })
  {
    input->GetPolys()->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
  }
  const vtkIdType first = 3 + m; // cell id of the first that was added
  Diagnostics d(input);
  CheckSound(check, d, input);
  d.Expect(check, "NonFinitePoints", 1, n);
  d.Expect(check, "CoincidentPoints", 1, n + 1);
  d.Expect(check, "UnusedPoints", 1, n + 2);
  d.Expect(check, "NonManifoldPoints", 0, -1);
  d.Expect(check, "DegenerateTriangles", 1, first + 1);
  d.Expect(check, "DuplicateTriangles", 1, first + 2);
  d.Expect(check, "Slivers", 1, first + 4);
  check(d.OfCell("ObtuseTriangles", first + 4) == 1.0, "the sliver is obtuse");
  d.Expect(check, "BorderEdges", 4 + 3, first + 3);
  d.Expect(check, "BorderLoops", 2, n + 3);
  d.Expect(check, "Components", 3, first + 3);
  check(d.Entry("NonManifoldEdges", "Count").ToInt() == 3, "three edges of three triangles");
  check(d.OfCell("NonManifoldEdges", first + 2) == 1.0, "on the triangle that is there twice");
  check(d.OfCell("Component", first) == -1.0 && d.OfCell("Component", 0) == -1.0 &&
      d.OfCell("Component", 3) == 0.0 && d.OfCell("Component", first + 4) == 2.0,
    "components should be those of the cells");
  check(d.OfPoint("BorderEdges", n + 3) == 1.0 && d.OfPoint("BorderEdges", 0) == 0.0,
    "border points should be marked");

  check.About("not welded");
  d->WeldCoincidentPointsOff();
  CheckSound(check, d, input);
  d.Expect(check, "CoincidentPoints", 1, n + 1);
  d.Expect(check, "DegenerateTriangles", 1, first + 1);
  d.Expect(check, "UnusedPoints", 2, n + 1);

  check.About("SliverAngle");
  d->SetSliverAngle(0.1); // the sliver has 0.115 degrees
  d.Expect(check, "Slivers", 0, -1);
  d->SetSliverAngle(60.0);
  check(d.Entry("Slivers", "Value").ToDouble() > 0.9, "nearly all have less than 60 degrees");
}

void Numbers(Checker& check)
{
  const Surface ball = MakeEllipsoid({ 1.0, 1.0, 1.0 });
  struct Case
  {
    double scale;
    double offset;
    int type;
    int extreme;
    int few;
  };
  for (const Case& c : { Case{ 1.0, 0.0, VTK_FLOAT, 0, 0 }, Case{ 1.0, 1e6, VTK_FLOAT, 0, 1 },
         Case{ 1.0, 1e6, VTK_DOUBLE, 0, 0 }, Case{ 1.0, 1e14, VTK_DOUBLE, 0, 1 },
         Case{ 1e30, 0.0, VTK_FLOAT, 1, 0 }, Case{ 1e-30, 0.0, VTK_DOUBLE, 1, 0 },
         Case{ 1000.0, 0.0, VTK_INT, 0, 1 }, Case{ 100000.0, 0.0, VTK_INT, 0, 0 } })
  {
    check.About("scale " + vtkVariant(c.scale).ToString() + ", offset " +
      vtkVariant(c.offset).ToString() + ", type " + Text(c.type));
    Diagnostics d(Mapped(
      ball,
      [&](const Vector& x) {
        return Vector{ c.scale * x[0] + c.offset, c.scale * x[1], c.scale * x[2] };
      },
      c.type));
    d.Expect(check, "ExtremeScale", c.extreme, -1);
    d.Expect(check, "FewDigits", c.few, -1);
  }
}

/// All that can come in without a triangle, and what cannot be cut.
void Kinds(Checker& check)
{
  check.About("empty");
  Diagnostics empty(Surface::New());
  check(empty.Output()->GetNumberOfPoints() == 0 && empty.Table()->GetNumberOfRows() == 0 &&
      empty.Errors.empty(),
    "the outputs should be empty");
  const std::vector<Vector> x = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { NaN, 1, 0 } };
  const std::vector<std::pair<const char*, std::vector<Cell>>> kinds = { { "points alone", {} },
    { "a triangle with NaN", { { 0, 1, 3 } } }, { "a polygon with NaN", { { 0, 1, 2, 3 } } },
    { "a point thrice", { { 0, 0, 0 } } }, { "polygons of too few points", { { 0, 1 }, { 2 } } },
    { "a polygon of no points", { {} } }, { "a quad of one place", { { 1, 1, 1, 1 } } } };
  for (const auto& [name, cells] : kinds)
  {
    check.About(name);
    const Surface input = MakeSurface(x, cells);
    Diagnostics d(input);
    CheckSound(check, d, input);
    d.Expect(check, "NonFinitePoints", 1, 3);
  }

  check.About("a polygon that cannot be cut");
  const Surface bad = MakeSurface(x, { { 0, 1, 2 }, { 0, 1, 2, 3 } });
  Diagnostics d(bad);
  CheckSound(check, d, bad);
  d.Expect(check, "UncutPolygons", 1, 1);
}

void Errors(Checker& check)
{
  const auto make = [] { return MakeEllipsoid({ 1.0, 1.0, 1.0 }); };
  const vtkIdType n = make()->GetNumberOfPoints();
  struct Case
  {
    const char* about;
    std::function<void(vtkPolyData*)> spoil;
    std::string message;
  };
  const auto cells = [&](vtkIdType bad) { return MakeCells({ { 0, 1, 2 }, { 1, bad, 2 } }); };
  for (const Case& c : { Case{ "verts", [&](vtkPolyData* s) { s->SetVerts(cells(n)); },
                           "cell 1 names point " + Text(n) + ", the input has " + Text(n) },
         Case{ "lines", [&](vtkPolyData* s) { s->SetLines(cells(-1)); }, "cell 1 names point -1" },
         Case{ "polygons", [&](vtkPolyData* s) { s->SetPolys(cells(n)); }, "cell 1 names" },
         Case{ "short polygons",
           [&](vtkPolyData* s) {
             s->SetPolys(MakeCells({ { n, n } }));
           },
           "cell 0 names" },
         Case{ "strips", [&](vtkPolyData* s) { s->SetStrips(cells(n)); },
           "cell " + Text(make()->GetNumberOfPolys() + 1) + " names" },
         Case{ "no points", [&](vtkPolyData* s) { s->SetPoints(nullptr); }, "the input has 0" } })
  {
    check.About(std::string("ids out of range: ") + c.about);
    const Surface input = make();
    c.spoil(input);
    Diagnostics d(input);
    vtkPolyData* output = d.Output();
    check(d.Errors.size() == 1 && Contains(d.Errors[0], c.message),
      "one error should say \"" + c.message + "\"" + Joined(d.Errors));
    check(output->GetNumberOfPoints() == 0 && output->GetNumberOfCells() == 0 &&
        d.Table()->GetNumberOfRows() == 0,
      "the outputs should be empty");
    d.Errors.clear();
    const Surface good = make();
    d->SetInputData(good);
    CheckSound(check, d, good);
  }
  check.About("SliverAngle");
  Diagnostics d(make());
  d->SetSliverAngle(NaN);
  d.Output();
  check(d.Errors.size() == 1 && Contains(d.Errors[0], "SliverAngle"), "the error should name it");
}

void Properties(Checker& check)
{
  check.About("properties");
  using FilterType = vtkSurfaceDiagnostics;
  vtkNew<FilterType> filter;
  RoundTrip(SliverAngle, 1.0, 5.0);
  OnOff(WeldCoincidentPoints, true);
  Clamped(SliverAngle, -1.0, 0.0);
  Clamped(SliverAngle, 70.0, 60.0);
  std::ostringstream printed;
  filter->Print(printed);
  for (const char* name : { "SliverAngle", "WeldCoincidentPoints" })
  {
    check(Contains(printed.str(), std::string(" ") + name + ": "),
      std::string("PrintSelf should print ") + name);
  }
}
}

int TestSurfaceDiagnostics(int, char*[])
{
  Checker check;
  Sound(check);
  Dirty(check);
  Numbers(check);
  Kinds(check);
  Errors(check);
  Properties(check);
  return check.Result();
}
