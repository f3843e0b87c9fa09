// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// What vtkSurfacePartsFilter says of surfaces whose parts are known, in arrays and table; what it
/// takes, refuses and passes on. Testing/Quality/parts.py looks at real models.
#include "ArrayTesting.h"
#include "PropertyTesting.h"

#include "vtkIntArray.h"
#include "vtkSurfacePartsFilter.h"
#include "vtkTable.h"

#include <set>
#include <sstream>

using namespace FilterTesting;

namespace
{
constexpr double BallRadius = 1.0;

class Parts : public Watched<vtkSurfacePartsFilter>
{
public:
  explicit Parts(vtkPolyData* input) { this->Get()->SetInputData(input); }

  vtkTable* Table()
  {
    this->Get()->Update();
    return vtkTable::SafeDownCast(this->Get()->GetOutputDataObject(1));
  }
  vtkIdType Count() { return this->Table()->GetNumberOfRows(); }
  double Entry(vtkIdType part, const char* column, int component = 0)
  {
    return vtkDataArray::SafeDownCast(this->Table()->GetColumnByName(column))
      ->GetComponent(part, component);
  }
  int OfPoint(vtkIdType i)
  {
    return static_cast<int>(this->Output()->GetPointData()->GetArray("PartId")->GetComponent(i, 0));
  }
  int OfCell(vtkIdType i)
  {
    return static_cast<int>(this->Output()->GetCellData()->GetArray("PartId")->GetComponent(i, 0));
  }
};

Surface Ball(double radius, double x, Faces faces = Faces::Triangles)
{
  return Shifted(MakeEllipsoid({ radius, radius, radius }, faces, 32, 17), { x, 0.0, 0.0 });
}

/// A large and a small ball that run through each other, in one surface of loose pieces.
Surface Snowman()
{
  return Together({ Ball(BallRadius, 0.0), Ball(0.6, 1.35) });
}

/// Ids, areas and counts agree with each other, and the input passes.
void CheckTable(Checker& check, Parts& parts, vtkPolyData* input)
{
  check(parts.Errors.empty(), "there should be no error" + Joined(parts.Errors));
  vtkPolyData* output = parts.Output();
  check(SamePoints(output, input) && SameCells(output, input), "the surface should pass");
  const vtkIdType count = parts.Count();
  std::vector<vtkIdType> points(count, 0);
  std::vector<vtkIdType> cells(count, 0);
  bool inRange = true;
  const auto add = [&](std::vector<vtkIdType>& to, int part)
  {
    inRange = inRange && part >= -1 && part < count;
    if (part >= 0 && part < count)
    {
      ++to[part];
    }
  };
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    add(points, parts.OfPoint(i));
  }
  for (vtkIdType i = 0; i < input->GetNumberOfCells(); ++i)
  {
    add(cells, parts.OfCell(i));
  }
  check(inRange, "ids should be from 0 on, or -1");
  for (vtkIdType p = 0; p < count; ++p)
  {
    check(parts.Entry(p, "Part") == static_cast<double>(p), "rows should be in order");
    check(parts.Entry(p, "Points") == static_cast<double>(points[p]) &&
        parts.Entry(p, "Cells") == static_cast<double>(cells[p]),
      "points and cells of part " + Text(p) + " should be counted");
    check(p == 0 || parts.Entry(p - 1, "Area") >= parts.Entry(p, "Area"),
      "the largest part should come first");
  }
}

void ByShape(Checker& check)
{
  check.About("by shape");
  const Surface snowman = Snowman();
  Parts parts(snowman);
  CheckTable(check, parts, snowman);
  const vtkIdType n = Ball(1.0, 0.0)->GetNumberOfPoints();
  if (!check(parts.Count() == 2, "a snowman should have 2 parts, not " + Text(parts.Count())))
  {
    return;
  }
  check(parts.OfPoint(0) == 0 && parts.OfPoint(snowman->GetNumberOfPoints() - 1) == 1,
    "body and head should be parts 0 and 1");
  vtkIdType wrong = 0;
  for (vtkIdType i = 0; i < snowman->GetNumberOfPoints(); ++i)
  {
    const double x = PointOf(snowman, i)[0];
    wrong += std::abs(x - 0.9) > 0.2 && parts.OfPoint(i) != (x > 0.9 ? 1 : 0) ? 1 : 0;
  }
  check.AtMost(static_cast<double>(wrong), 0.02 * static_cast<double>(n), "wrong points");
  check(parts.Entry(0, "Thickness") > 0.7 && parts.Entry(0, "Thickness") < 1.05,
    "the thickness of a ball should be near its radius");
  // At another place and size the same, lengths with it.
  const Surface moved = Mapped(snowman,
    [](const Vector& x) {
      return Vector{ 1e3 * x[0] + 7e3, 1e3 * x[1] - 2e3, 1e3 * x[2] };
    });
  Parts far(moved);
  check(SameArray(far.Output()->GetPointData()->GetArray("PartId"),
          parts.Output()->GetPointData()->GetArray("PartId")),
    "parts should not depend on place and size");
  const double ratio = far.Entry(1, "Area") / parts.Entry(1, "Area");
  check.AtMost(
    std::abs(ratio / 1e6 - 1.0), 1e-9, "change of the area beside the square of lengths");

  check.About("a wanted number");
  parts->SetNumberOfParts(1);
  check(parts.Count() == 1 && parts->GetEffectiveNumberOfParts() == 1 && parts.Warnings.empty(),
    "there should be one part");
  const Surface apart = Together({ Ball(1.0, 0.0), Ball(1.0, 9.0) });
  Parts loose(apart);
  loose->SetNumberOfParts(1);
  check(loose.Count() == 2 && loose->GetEffectiveNumberOfParts() == 2 &&
      loose.Warnings.size() == 1 &&
      Contains(loose.Warnings[0], "NumberOfParts is 1, and there are 2"),
    "a warning should say that two are loose" + Joined(loose.Warnings));
  Parts many(apart);
  many->SetNumberOfParts(200);
  check(many.Count() < 200 && many.Warnings.size() == 1 &&
      Contains(many.Warnings[0], "nothing more can be cut off"),
    "a warning should say that there are fewer" + Joined(many.Warnings));
}

void ByConnectivity(Checker& check)
{
  check.About("by connectivity");
  const Surface three = Together({ Ball(1.0, 0.0), Ball(2.0, 1.0), Ball(0.5, -9.0, Faces::Quads) });
  Parts parts(three);
  parts->SetMethodToConnectivity();
  CheckTable(check, parts, three);
  check(parts.Count() == 3, "there should be 3 parts, not " + Text(parts.Count()));
  const vtkIdType n = Ball(1.0, 0.0)->GetNumberOfPoints();
  check(parts.OfPoint(0) == 1 && parts.OfPoint(n) == 0 && parts.OfPoint(2 * n) == 2,
    "the largest should be the first");
  const double area = parts.Entry(0, "Area") / (16.0 * vtkMath::Pi());
  check(area > 0.95 && area < 1.0, "the area should be that of a ball");
  check.AtMost(std::abs(parts.Entry(2, "Center", 0) + 9.0), 1e-9, "place of the third");
  check(vtkMath::IsNan(parts.Entry(0, "Thickness")), "there should be no thickness");
}

vtkSmartPointer<vtkIntArray> Numbers(const char* name, vtkIdType n, int every)
{
  auto numbers = vtkSmartPointer<vtkIntArray>::New();
  numbers->SetName(name);
  for (vtkIdType i = 0; i < n; ++i)
  {
    numbers->InsertNextValue(static_cast<int>(10 * (i / every)));
  }
  return numbers;
}

void ByArray(Checker& check)
{
  const Surface ball = Ball(1.0, 0.0);
  ball->GetPointData()->AddArray(Numbers("OfPoints", ball->GetNumberOfPoints(), 200));
  ball->GetCellData()->AddArray(Numbers("OfCells", ball->GetNumberOfCells(), 400));
  check.About("by an array of points");
  Parts points(ball);
  points->SetMethodToArray();
  points->SetInputArrayToProcess(0, 0, 0, OfPoints, "OfPoints");
  CheckTable(check, points, ball);
  std::set<std::pair<int, int>> pairs;
  for (vtkIdType i = 0; i < ball->GetNumberOfPoints(); ++i)
  {
    pairs.emplace(static_cast<int>(i / 200), points.OfPoint(i));
  }
  check(static_cast<vtkIdType>(pairs.size()) == points.Count(), "each value should be a part");
  check.About("by an array of cells");
  Parts cells(ball);
  cells->SetMethodToArray();
  cells->SetInputArrayToProcess(0, 0, 0, OfCells, "OfCells");
  CheckTable(check, cells, ball);
  check(cells.Count() == (ball->GetNumberOfCells() + 399) / 400, "each value should be a part");
  check(cells.OfCell(0) == cells.OfCell(399) && cells.OfCell(0) != cells.OfCell(400),
    "cells should keep together");
}

void Refused(Checker& check)
{
  const Surface ball = Ball(1.0, 0.0);
  vtkNew<vtkDoubleArray> bad;
  bad->SetName("Bad");
  bad->SetNumberOfValues(ball->GetNumberOfPoints());
  bad->FillValue(1.0);
  bad->SetValue(5, 0.5);
  bad->SetValue(6, vtkMath::Nan());
  ball->GetPointData()->AddArray(bad);
  const auto refuse = [&](const char* name, const std::string& words)
  {
    Parts parts(ball);
    parts->SetMethodToArray();
    if (name)
    {
      parts->SetInputArrayToProcess(0, 0, 0, OfPoints, name);
    }
    parts.Output();
    check(parts.Errors.size() == 1 && Contains(parts.Errors[0], words),
      "one error should say \"" + words + "\"" + Joined(parts.Errors));
    check(
      parts.Output()->GetNumberOfPoints() == 0 && parts.Count() == 0, "nothing should come out");
    parts->SetMethodToShape();
    check(parts.Count() == 1, "by shape it should work again");
  };
  check.About("no array");
  refuse(nullptr, "PartArray");
  refuse("Missing", "PartArray");
  check.About("no whole numbers");
  refuse("Bad", "point 5 has 0.5");
  bad->SetValue(5, 1.0);
  refuse("Bad", "point 6 has nan");
}

void WithoutTriangles(Checker& check)
{
  check.About("no polygon");
  const Surface ball = Ball(1.0, 0.0);
  vtkNew<vtkPolyData> points;
  points->SetPoints(ball->GetPoints());
  for (const int method : { 0, 1 })
  {
    Parts parts(points);
    parts->SetMethod(method);
    check(parts.Errors.empty() && parts.Count() == 0, "there should be no part");
    check(parts.OfPoint(3) == -1, "points should be of no part");
  }
  check.About("a point of no polygon");
  const Surface more = Ball(1.0, 0.0);
  more->GetPoints()->InsertNextPoint(3.0, 3.0, 3.0);
  Parts parts(more);
  CheckTable(check, parts, more);
  check(parts.OfPoint(more->GetNumberOfPoints() - 1) == -1, "it should be of no part");
}

void Properties(Checker& check)
{
  check.About("properties");
  using FilterType = vtkSurfacePartsFilter;
  vtkNew<FilterType> filter;
  RoundTrip(Method, 0, 1);
  RoundTrip(NumberOfParts, 0, 5);
  Mode(Method, Shape, SHAPE, 0);
  Mode(Method, Connectivity, CONNECTIVITY, 1);
  Mode(Method, Array, ARRAY, 2);
  Clamped(NumberOfParts, -1, 0);
  Clamped(NumberOfParts, 1000, 256);
  std::ostringstream printed;
  filter->Print(printed);
  for (const char* name : { "Method", "NumberOfParts" })
  {
    check(Contains(printed.str(), std::string(" ") + name + ": "),
      std::string("PrintSelf should print ") + name);
  }
}
}

int TestSurfacePartsFilter(int, char*[])
{
  Checker check;
  ByShape(check);
  ByConnectivity(check);
  ByArray(check);
  Refused(check);
  WithoutTriangles(check);
  Properties(check);
  return check.Result();
}
