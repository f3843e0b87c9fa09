// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// What vtkPrintableFilter makes of arrays, what its table says, where it puts the result, and what
/// it refuses. TestPrintable looks at the shape.
#include "ArrayTesting.h"
#include "PropertyTesting.h"

#include "vtkAppendPolyData.h"
#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkCubeSource.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkPrintableFilter.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>

using namespace FilterTesting;

namespace
{
class Printed : public Watched<vtkPrintableFilter>
{
public:
  explicit Printed(vtkPolyData* input) { this->Get()->SetInputData(input); }

  /// Of the table, by the name of its row.
  double Entry(const char* name, const char* column = "After")
  {
    this->Get()->Update();
    auto* table = vtkTable::SafeDownCast(this->Get()->GetOutputDataObject(1));
    auto* names = vtkStringArray::SafeDownCast(table->GetColumnByName("Name"));
    const vtkIdType row = names ? names->LookupValue(name) : -1;
    return row < 0
      ? std::nan("")
      : vtkDataArray::SafeDownCast(table->GetColumnByName(column))->GetComponent(row, 0);
  }
};

Surface Ball()
{
  Surface ball = MakeEllipsoid({ 1.0, 1.5, 1.0 }, Faces::Triangles, 48, 25);
  vtkNew<vtkDoubleArray> height;
  height->SetName("HeightOfPoint");
  for (vtkIdType i = 0; i < ball->GetNumberOfPoints(); ++i)
  {
    height->InsertNextValue(ball->GetPoint(i)[1]);
  }
  ball->GetPointData()->AddArray(height);
  vtkNew<vtkIntArray> numbers;
  numbers->SetName("Number");
  for (vtkIdType i = 0; i < ball->GetNumberOfCells(); ++i)
  {
    numbers->InsertNextValue(static_cast<int>(i) + 1);
  }
  ball->GetCellData()->AddArray(numbers);
  return ball;
}

void CheckArrays(Checker& check)
{
  const Surface ball = Ball();
  Printed printed(ball);
  printed.Get()->SetStabilityAngle(0.0);
  printed.Get()->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkPolyData* output = printed.Output();
  check(output->GetNumberOfPolys() > 100 && printed.Errors.empty(), "there is a result");
  const double factor = printed.Entry("Factor");
  const double level = printed.Entry("FootLevel");
  vtkDataArray* height = output->GetPointData()->GetArray("HeightOfPoint");
  vtkDataArray* foot = output->GetCellData()->GetArray("Foot");
  vtkDataArray* numbers = output->GetCellData()->GetArray("Number");
  double worst = 0.0;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    // Scaled about the level of the foot: interpolated heights are those of the points.
    const double before = (output->GetPoint(i)[1] - level) / factor + level;
    worst = std::max(worst, std::abs(before - height->GetTuple1(i)));
  }
  check(worst < 0.01, "arrays of points are interpolated: " + std::to_string(worst));
  vtkIdType flat = 0;
  bool good = true;
  for (vtkIdType f = 0; f < output->GetNumberOfCells(); ++f)
  {
    flat += foot->GetTuple1(f) > 0.0 ? 1 : 0;
    good = good && (foot->GetTuple1(f) > 0.0) == (numbers->GetTuple1(f) == 0.0);
  }
  check(flat > 10 && flat < output->GetNumberOfCells(), "the foot is marked");
  check(good, "arrays of cells are those of the cells, 0 on the foot");
}

/// A toy that is shaded smoothly stays so, and a box with its edges does not become smeared.
void CheckNormals(Checker& check)
{
  const Surface ball = MakeEllipsoid({ 1.0, 1.0, 1.0 }, Faces::Triangles, 48, 25);
  ball->GetPointData()->SetNormals(
    MakeArray("N", ball, 3, [&ball](vtkIdType i, int k) { return ball->GetPoint(i)[k]; }));
  Printed printed(ball);
  printed.Get()->SetFootArea(0.3); // at its border the ball and the foot differ by 38 degrees
  printed.Get()->SetHeight(10.0);
  printed.Get()->PlaceOnPlateOn();
  vtkPolyData* output = printed.Output();
  vtkDataArray* normals = output->GetPointData()->GetNormals();
  check(normals && std::string(normals->GetName()) == "N", "normals come out");
  const double radius = 0.5 * output->GetBounds()[1] - 0.5 * output->GetBounds()[0];
  double worst = 1.0;
  for (vtkIdType i = 0; normals && i < output->GetNumberOfPoints(); ++i)
  {
    double p[3], n[3];
    output->GetPoint(i, p);
    normals->GetTuple(i, n);
    p[2] -= 10.0 - radius;
    worst = std::min(worst, vtkMath::Dot(p, n) / vtkMath::Norm(p));
  }
  check(worst > 0.99, "they are those of the ball, at its foot, too: " + std::to_string(worst));
  vtkNew<vtkCubeSource> cube;
  cube->Update();
  Printed edged(cube->GetOutput());
  check(!edged.Output()->GetPointData()->GetNormals(), "none where there are creases");
}

void CheckPlaces(Checker& check)
{
  const Surface ball = Ball();
  Printed printed(ball);
  printed.Get()->SetHeight(60.0);
  printed.Get()->PlaceOnPlateOn();
  double bounds[6];
  printed.Output()->GetBounds(bounds);
  check(printed.Get()->GetFactor() == printed.Entry("Factor") && printed.Entry("Factor") > 1.0,
    "how much larger it is");
  check(bounds[4] == 0.0 && std::abs(bounds[5] - 60.0) < 1e-5, "z points up, from 0 to the height");
  Printed nosed(Together({ ball, Shifted(MakeEllipsoid({ 0.1, 0.1, 0.1 }), { 0.0, 0.0, 9.0 }) }));
  nosed.Get()->PlaceOnPlateOn();
  nosed.Output()->GetBounds(bounds);
  check(bounds[3] - bounds[2] > 3.0 * (bounds[1] - bounds[0]), "what was along z is along y");
  for (vtkIdType i = 0; i < nosed.Output()->GetNumberOfPoints(); ++i)
  {
    const Vector p = PointOf(nosed.Output(), i);
    check(
      std::abs(p[0]) < 0.5 || p[1] > 0.0, "what faced z faces the front, and the ball is behind");
  }
  check(std::abs(bounds[0] + bounds[1]) < 1e-5 && std::abs(bounds[2] + bounds[3]) < 1e-5,
    "in the middle of the plate");
  check(printed.Entry("TiltAngle", "Before") < 0.0 && printed.Entry("TiltAngle") >= 10.0,
    "the table says how it stood and stands");
  check(printed.Entry("FootArea", "Before") == 0.0 && printed.Entry("FootArea") > 0.0 &&
      printed.Entry("CutDepth") > 0.0,
    "and what was cut");
  const double height = printed.Entry("Height", "Before") * printed.Entry("Factor");
  check(printed.Entry("Lean") == 0.0 &&
      std::abs(height - printed.Entry("CutDepth") - printed.Entry("Height")) < 1e-9 * height,
    "in the unit of the result");
}

void CheckWalls(Checker& check)
{
  const Surface leaf = MakeEllipsoid({ 1.0, 1.0, 0.02 }, Faces::Triangles, 48, 25);
  Printed printed(leaf);
  printed.Get()->SetHeight(100.0);
  printed.Get()->SetStabilityAngle(0.0); // it stands on its edge
  printed.Get()->SetMinimumThickness(3.0);
  vtkPolyData* output = printed.Output();
  check(printed.Errors.empty() && printed.Warnings.empty(), "walls are made thicker");
  check(printed.Entry("MinimumThickness", "Before") < 0.04 &&
      printed.Entry("MinimumThickness") >= 3.0 && printed.Entry("Thickened") > 1.0,
    "the table says how thick they were and are");
  vtkDataArray* thickness = output->GetPointData()->GetArray("WallThickness");
  double least = HUGE_VAL;
  for (vtkIdType i = 0; thickness && i < output->GetNumberOfPoints(); ++i)
  {
    least = std::fmin(least, thickness->GetTuple1(i)); // NaN where there is no other side
  }
  check(std::abs(least - printed.Entry("MinimumThickness")) < 1e-5,
    "WallThickness is an array of the points");

  // Two that are nearer to each other than they have to grow have no room.
  const Surface other = MakeEllipsoid({ 1.0, 1.0, 0.02 }, Faces::Triangles, 48, 25);
  for (vtkIdType i = 0; i < other->GetNumberOfPoints(); ++i)
  {
    double x[3];
    other->GetPoint(i, x);
    other->GetPoints()->SetPoint(i, x[0], x[1], x[2] + 0.045);
  }
  vtkNew<vtkAppendPolyData> append;
  append->AddInputData(leaf);
  append->AddInputData(other);
  append->Update();
  Printed tight(append->GetOutput());
  tight.Get()->SetMinimumThickness(0.1);
  tight.Get()->SetStabilityAngle(0.0);
  tight.Output();
  check(tight.Errors.empty() && tight.Warnings.size() == 1 &&
      Contains(tight.Warnings.front(), "MinimumThickness: walls stay thinner than 0.1 at ") &&
      Contains(tight.Warnings.front(), "the thinnest with "),
    "a warning says where there is no room" +
      (tight.Warnings.empty() ? "" : ", not " + tight.Warnings.front()));
}

void CheckMessages(Checker& check)
{
  const auto refuses = [&](Printed& printed, const char* words)
  {
    printed.Errors.clear();
    printed.Output();
    check(printed.Errors.size() == 1 && Contains(printed.Errors.front(), words) &&
        printed.Get()->GetOutput()->GetNumberOfPoints() == 0,
      std::string("an error says ") + words +
        (printed.Errors.empty() ? "" : ", not " + printed.Errors.front()));
  };
  const Surface ball = Ball();
  Printed both(ball);
  both.Get()->SetVolume(1.0);
  both.Get()->SetHeight(1.0);
  refuses(both, "set one of them to 0");
  both.Get()->SetVolume(-1.0);
  refuses(both, "Volume must be 0 or more");
  both.Get()->SetVolume(0.0);
  both.Get()->SetHeight(std::nan(""));
  refuses(both, "Height must be 0 or more");
  both.Get()->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
  both.Get()->SetHeight(1e39);
  refuses(both, "beyond what single precision can hold");
  both.Get()->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  both.Get()->SetHeight(1e300);
  refuses(both, "beyond what double precision can hold and measure; make Height");
  both.Get()->SetOutputPointsPrecision(vtkAlgorithm::DEFAULT_PRECISION);
  both.Get()->SetHeight(0.0);
  both.Get()->SetMinimumThickness(-1.0);
  refuses(both, "MinimumThickness must be 0 or more");
  both.Get()->SetMinimumThickness(0.0);
  // Of a ball of radius r, pi (2 z r - z^2) is .35 of 4 r^2 at z = .255 r.
  both.Get()->SetFootArea(0.35);
  both.Warnings.clear();
  both.Output();
  check(both.Warnings.size() == 1 &&
      Contains(both.Warnings.front(),
        "takes 13 % of the height along Y off the model: a smaller FootArea takes less, and "
        "UpAxis"),
    "a warning says how much is cut off" + Joined(both.Warnings));
  // On a smaller foot it would fall over.
  both.Get()->SetFootArea(0.01);
  both.Get()->SetStabilityAngle(32.0);
  both.Warnings.clear();
  both.Output();
  check(both.Warnings.size() == 1 &&
      Contains(both.Warnings.front(),
        "off the model to make it stand, and 0 % with StabilityAngle 0; UpAxis"),
    "a warning says what the cut is for" + Joined(both.Warnings));
  both.Get()->SetStabilityAngle(10.0);
  const auto warns = [&](const std::string& text)
  {
    both.Warnings.clear();
    both.Errors.clear();
    vtkPolyData* made = both.Output();
    check(both.Errors.empty() && made->GetNumberOfCells() > 0,
      "there is a result" + Joined(both.Errors));
    check(!both.Warnings.empty() && Contains(both.Warnings.front(), text),
      "'" + text + "' is not warned of" + Joined(both.Warnings));
  };
  both.Get()->SetFootArea(1.0);
  warns("makes a foot of 0.499");
  both.Get()->SetFootArea(0.0);
  warns("stands on a point or a line");
  both.Get()->SetStabilityAngle(0.0);
  both.Errors.clear();
  vtkPolyData* same = both.Output();
  check(both.Errors.empty() && LargestDistance(same, ball) == 0.0,
    "where nothing is asked for, points stay to the bit");

  const Surface shorter = Ball();
  shorter->GetCellData()->GetArray("Number")->SetNumberOfTuples(7);
  Printed numbered(shorter);
  refuses(numbered, "array \"Number\" has 7 tuples for ");
  shorter->GetPointData()->GetArray("HeightOfPoint")->SetNumberOfTuples(9);
  shorter->Modified();
  refuses(numbered, "array \"HeightOfPoint\" has 9 tuples for ");

  // One cell is missing: its first corner, as the input numbers it, is where the hole is.
  const Surface open = Ball();
  open->BuildCells();
  open->DeleteCell(200);
  open->RemoveDeletedCells();
  Printed holes(open);
  holes.Get()->CloseHolesOff();
  refuses(holes, "3 border edges, the first at point ");
  holes.Get()->CloseHolesOn();
  holes.Errors.clear();
  holes.Output();
  check(holes.Errors.empty() && holes.Entry("HolesClosed") == 1.0, "the hole is closed");

  const Surface three =
    MakeSurface({ { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, .4 }, { -.6, .8, .5 }, { -.5, -.9, .6 } },
      { { 0, 1, 2 }, { 1, 0, 3 }, { 0, 1, 4 } });
  Printed fan(three); // two become a leaf, the third one comes off
  fan.Get()->CloseHolesOff();
  refuses(fan, "7 border edges, the first at point 0");
  const Surface strip =
    MakeSurface({ { 1, 0, -1 }, { 1, 0, 1 }, { -1, 1, 0 }, { -1, 0, 1 }, { 0, -1, 0 } },
      { { 0, 1, 2 }, { 1, 2, 3 }, { 2, 3, 4 }, { 3, 4, 0 }, { 4, 0, 1 } });
  Printed moebius(strip);
  moebius.Get()->CloseHolesOff();
  refuses(moebius, "7 border edges, the first at point "); // with its seam
}

/// A bottle whose sections are figures of eight, one half larger than the other: where it is cut,
/// nobody can say what is inside.
void CheckCrossingFoot(Checker& check)
{
  constexpr vtkIdType Around = 24;
  constexpr vtkIdType Rings = 5;
  std::vector<Vector> points;
  std::vector<Cell> triangles;
  for (vtkIdType ring = 0; ring < Rings; ++ring)
  {
    for (vtkIdType i = 0; i < Around; ++i)
    {
      const double phi = 2.0 * vtkMath::Pi() * static_cast<double>(i) / Around;
      const double r = (1.0 + 0.5 * std::sin(phi)) * std::sin(0.5 * (1.0 + ring));
      points.push_back({ r * std::sin(phi), 1.0 * ring, r * std::sin(phi) * std::cos(phi) });
      const vtkIdType a = ring * Around + i;
      const vtkIdType b = ring * Around + (i + 1) % Around;
      if (ring == 0)
      {
        triangles.push_back({ Rings * Around, a, b });
      }
      if (ring == Rings - 1)
      {
        triangles.push_back({ Rings * Around + 1, b, a });
        continue;
      }
      triangles.push_back({ a, a + Around, b + Around });
      triangles.push_back({ a, b + Around, b });
    }
  }
  points.push_back({ 0.0, -1.0, 0.0 });
  points.push_back({ 0.0, 1.0 * Rings, 0.0 });
  Printed printed(MakeSurface(points, triangles));
  vtkPolyData* output = printed.Output();
  check(printed.Errors.size() == 1 && output->GetNumberOfPoints() == 0 &&
      Contains(printed.Errors.front(), "the model runs through itself where it would be cut, ") &&
      Contains(printed.Errors.front(), "or 0 for no cut"),
    "a foot that crosses itself should be refused" + Joined(printed.Errors));
  printed.Get()->SetFootArea(0.0);
  printed.Get()->SetStabilityAngle(0.0);
  printed.Errors.clear();
  output = printed.Output();
  check(printed.Errors.empty() && output->GetNumberOfPoints() == Rings * Around + 2 &&
      printed.Entry("SelfIntersectingTriangles") > 0.0,
    "without a cut it should come out as it is" + Joined(printed.Errors));
}

/// A wide hole gets points of its own: arrays have the values of the nearest point there.
void CheckWideHole(Checker& check)
{
  const Surface open = Ball();
  open->BuildCells();
  std::vector<char> isLeft(open->GetNumberOfPoints(), 0);
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < open->GetNumberOfCells(); ++cell)
  {
    open->GetCellPoints(cell, corners);
    if (open->GetPoint(corners->GetId(0))[1] > 0.9)
    {
      open->DeleteCell(cell);
      continue;
    }
    for (const vtkIdType corner : *corners)
    {
      isLeft[corner] = 1;
    }
  }
  open->RemoveDeletedCells();
  Printed printed(open);
  printed.Get()->SetFootArea(0.0);
  printed.Get()->SetStabilityAngle(0.0);
  vtkPolyData* output = printed.Output();
  const vtkIdType before = std::count(isLeft.begin(), isLeft.end(), 1);
  check(printed.Errors.empty() && printed.Entry("HolesClosed") == 1.0 &&
      output->GetNumberOfPoints() > before + 10,
    "the hole should be filled with points of its own" + Joined(printed.Errors));
  vtkDataArray* heights = output->GetPointData()->GetArray("HeightOfPoint");
  vtkIdType added = 0;
  bool asNearest = true;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    double nearest = HUGE_VAL;
    double height = 0.0;
    for (vtkIdType j = 0; j < open->GetNumberOfPoints(); ++j)
    {
      const double distance = std::sqrt(
        vtkMath::Distance2BetweenPoints(PointOf(output, i).data(), PointOf(open, j).data()));
      if (isLeft[j] && distance < nearest)
      {
        nearest = distance;
        height = PointOf(open, j)[1];
      }
    }
    added += nearest > 0.0 ? 1 : 0;
    asNearest = asNearest && heights->GetTuple1(i) == height;
  }
  check(added == output->GetNumberOfPoints() - before, "all other points should be as they were");
  check(asNearest, "arrays should have the values of the nearest point");
}

/// Two tetrahedra at an edge of four faces.
void CheckEdgesOfMany(Checker& check)
{
  const Surface two = MakeSurface(
    { { 0, 0, 0 }, { 0, 3, 0 }, { 2, 0, 1 }, { 2, 0, -1 }, { -2, 0, 1 }, { -2, 0, -1 } },
    { { 0, 1, 2 }, { 0, 3, 1 }, { 0, 2, 3 }, { 1, 3, 2 }, { 0, 4, 1 }, { 0, 1, 5 }, { 0, 5, 4 },
      { 1, 4, 5 } });
  vtkNew<vtkIntArray> numbers;
  numbers->SetName("Number");
  for (int i = 0; i < 6; ++i)
  {
    numbers->InsertNextValue(10 * i);
  }
  two->GetPointData()->AddArray(numbers);
  Printed printed(two);
  printed.Get()->SetFootArea(0.0);
  printed.Get()->SetStabilityAngle(0.0);
  vtkPolyData* output = printed.Output();
  check(
    printed.Errors.empty() && output->GetNumberOfPoints() == 8 && output->GetNumberOfPolys() == 8,
    "parts that touch along an edge are taken apart" + Joined(printed.Errors));
  check(
    printed.Entry("NonManifoldEdges", "Before") == 1.0 && printed.Entry("NonManifoldEdges") == 0.0,
    "the table counts such edges");
  vtkDataArray* values = output->GetPointData()->GetArray("Number");
  check(values->GetTuple1(6) + values->GetTuple1(7) == 10.0, "new points have the same values");
}

/// Half of a ball's faces twice: the result is that of the ball.
void CheckRepetitions(Checker& check)
{
  const Surface ball = MakeEllipsoid({ 1.0, 1.0, 0.6 });
  const vtkIdType m = ball->GetNumberOfCells();
  std::vector<std::vector<vtkIdType>> faces;
  for (vtkIdType f = 0; f < m + m / 2; ++f)
  {
    const vtkIdType* corners = ball->GetCell(f % m)->GetPointIds()->GetPointer(0);
    faces.emplace_back(corners, corners + 3);
  }
  const Surface twice = MakeSurface({}, faces);
  twice->SetPoints(ball->GetPoints());
  Printed plain(ball);
  Printed printed(twice);
  vtkPolyData* output = printed.Output();
  check(printed.Errors.empty() && SamePolyData(output, plain.Output()),
    "faces that are there twice count once" + Joined(printed.Errors));
}
}

int TestPrintableFilter(int, char*[])
{
  Checker check;
  CheckArrays(check);
  CheckNormals(check);
  CheckPlaces(check);
  CheckWalls(check);
  CheckMessages(check);
  CheckCrossingFoot(check);
  CheckWideHole(check);
  CheckEdgesOfMany(check);
  CheckRepetitions(check);
  return check.Result();
}
