// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Every kind of input that people have: what comes out, and that the input stays as it was.
#include "FilterTesting.h"
#include "PropertyTesting.h"

#include <numeric>
#include <sstream>

using namespace FilterTesting;

namespace
{
const Vector LongAxes = { 1.0, 0.8, 2.0 };

/// Tolerance for equal results of solves that differ in rounding only, of the diagonal.
constexpr double Rounding = 1e-9;

/// What holds for every good input. @return the output
vtkPolyData* CheckSound(Checker& check, WatchedFilter& filter, vtkPolyData* input)
{
  vtkNew<vtkPolyData> before;
  before->DeepCopy(input);
  filter->SetInputData(input);
  vtkPolyData* output = filter.Output();
  check(filter.Errors.empty(), "no error should be reported");
  check(SamePolyData(before, input), "the input should be unchanged to the bit");
  check(output->GetNumberOfPoints() == input->GetNumberOfPoints(), "no point should come or go");
  check(SameCells(input, output), "cells should come out as they went in");
  if (output->GetNumberOfPoints() > 0)
  {
    check(AllFinite(output->GetPoints()->GetData()), "points should be finite");
    for (const char* name : { "TargetDirection", "Displacement" })
    {
      vtkDataArray* array = output->GetPointData()->GetArray(name);
      check(array && array->GetNumberOfTuples() == output->GetNumberOfPoints() && AllFinite(array),
        std::string(name) + " should be there and finite");
    }
  }
  return output;
}

/// CheckSound of an input that gives no reason for a warning.
Surface CheckRound(Checker& check, vtkPolyData* input)
{
  Tested filter;
  vtkPolyData* output = CheckSound(check, filter, input);
  check(filter.Warnings.empty(), "no warning should be given");
  check(filter->GetConverged(), "the solve should converge");
  return output;
}

void CheckStill(
  Checker& check, vtkPolyData* input, vtkPolyData* output, const std::vector<vtkIdType>& points)
{
  for (const vtkIdType i : points)
  {
    check(SamePoint(input, i, output, i), "point " + Text(i) + " should keep its bits");
  }
}

void CheckCentroid(
  Checker& check, vtkPolyData* input, vtkPolyData* output, vtkIdType first, vtkIdType last)
{
  std::vector<vtkIdType> points(last - first);
  std::iota(points.begin(), points.end(), first);
  check.AtMost(MoveOfCentroid(input, output, points), 1e-12 * Diagonal(input),
    "move of the centroid of points " + Text(first) + " and on");
}

/// With cotangent weights, the default, and without details the shape does not depend on how planar
/// faces are cut, nor does its place by one of the points. (Details are carried on what is linear
/// on each triangle.)
Surface Rounded(Checker& check, vtkPolyData* input)
{
  Tested filter;
  filter->SetDetailSize(0.0);
  filter->SetAnchorToLastPoint();
  Surface output = CheckSound(check, filter, input);
  return output;
}

//------------------------------------------------------------------------------------------------
void Triangles(Checker& check)
{
  check.About("triangles");
  const Surface input = MakeEllipsoid(LongAxes);
  const Surface output = CheckRound(check, input);
  check(RadiusSpread(output) < 0.8 * RadiusSpread(input), "the ellipsoid should be rounder");
  CheckCentroid(check, input, output, 0, input->GetNumberOfPoints());
}

void RoundnessZero(Checker& check)
{
  check.About("roundness 0");
  const Surface input = MakeEllipsoid(LongAxes);
  Tested filter;
  filter->SetRoundness(0.0);
  vtkPolyData* output = CheckSound(check, filter, input);
  check.AtMost(LargestDistance(input, output), 1e-12 * Diagonal(input), "movement");
  check(filter->GetConverged(), "nothing moves: that is convergence");
}

void Quads(Checker& check)
{
  check.About("quads");
  const Surface input = MakeEllipsoid(LongAxes, Faces::Quads);
  const Surface output = CheckRound(check, input);
  check(RadiusSpread(output) < 0.8 * RadiusSpread(input), "the ellipsoid should be rounder");
  CheckCentroid(check, input, output, 0, input->GetNumberOfPoints());
}

void Strips(Checker& check)
{
  check.About("strips");
  const Surface strips = MakeEllipsoid(LongAxes, Faces::Strips);
  check(strips->GetNumberOfStrips() == 8, "the test should have strips");
  CheckRound(check, strips);
  for (const double blend : { 0.0, 1.0 }) // with normals the sense of every triangle counts
  {
    Tested filter;
    filter->SetNormalBlend(blend);
    vtkPolyData* output = CheckSound(check, filter, strips);
    Tested same(MakeEllipsoid(LongAxes, Faces::Triangles));
    same->SetNormalBlend(blend);
    check.AtMost(LargestDistance(output, same.Output()), 1e-12 * Diagonal(strips),
      "difference between strips and the same triangles");
  }
}

void PlanarPolygons(Checker& check)
{
  check.About("polygons, also concave ones");
  // A prism on an L; its corners once more on each face would change nothing.
  const std::vector<Vector> l = { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 1, 1, 0 }, { 1, 3, 0 },
    { 0, 3, 0 } };
  std::vector<Vector> points = l;
  for (Vector x : l)
  {
    x[2] = 0.7;
    points.push_back(x);
  }
  std::vector<Cell> polygons = { { 5, 4, 3, 2, 1, 0 }, { 6, 7, 8, 9, 10, 11 } };
  std::vector<Cell> triangles = { { 0, 2, 1 }, { 0, 3, 2 }, { 0, 5, 3 }, { 5, 4, 3 }, { 6, 7, 8 },
    { 6, 8, 9 }, { 6, 9, 11 }, { 11, 9, 10 } };
  for (vtkIdType i = 0; i < 6; ++i)
  {
    const vtkIdType j = (i + 1) % 6;
    polygons.push_back({ i, j, j + 6, i + 6 });
    triangles.push_back({ i, j, j + 6 });
    triangles.push_back({ i, j + 6, i + 6 });
  }
  const Surface input = MakeSurface(points, polygons);
  const Surface output = CheckRound(check, input);
  CheckCentroid(check, input, output, 0, 12);
  // Normals at the corners and samples of triangles as long as the model depend on the cut, of the
  // defaults.
  const double within = Begin == SetUpDefaults ? 0.02 : Rounding;
  check.AtMost(
    LargestDistance(Rounded(check, input), Rounded(check, MakeSurface(points, triangles))),
    within * Diagonal(input), "cotangent weights: difference to the same faces cut by hand");
}

void BentPolygons(Checker& check)
{
  check.About("polygons that are not planar or cross themselves");
  Surface input = MakeEllipsoid(LongAxes, Faces::Quads);
  input = Mapped(input,
    [](const Vector& x) {
      return Vector{ x[0] + 0.4 * x[1] * x[2], x[1], x[2] + 0.3 * x[0] };
    });
  CheckRound(check, input);

  const Surface crossed =
    MakeSurface({ { 0, 0, 0 }, { 2, 1, 0 }, { 2, 0, 0 }, { 0, 1, 0 }, { 1, 3, 1 }, { -1, 2, 1 } },
      { { 0, 1, 2, 3 }, { 3, 1, 4 }, { 0, 1, 2, 4, 3, 5 } });
  Tested filter;
  CheckSound(check, filter, crossed);
}

void MixedCells(Checker& check)
{
  check.About("polygons, strips, lines and vertices together");
  const Surface input = MakeEllipsoid(LongAxes, Faces::Strips);
  const vtkIdType n = input->GetNumberOfPoints();
  // Points of lines and vertices alone.
  vtkPoints* points = input->GetPoints();
  points->InsertNextPoint(5.0, 0.1, 0.3);
  points->InsertNextPoint(-4.0, 0.7, 1.0 / 3.0);
  points->InsertNextPoint(0.0, 0.0, 0.0);
  input->SetVerts(MakeCells({ { n }, { 3 }, { n + 2, 4 } }));
  input->SetLines(MakeCells({ { n, n + 1, 5 }, { 1, 2 } }));
  const Surface output = CheckRound(check, input);
  CheckStill(check, input, output, { n, n + 1, n + 2 });

  const Surface alone = CheckRound(check, MakeEllipsoid(LongAxes, Faces::Strips));
  check(alone->GetNumberOfPoints() == n, "the faces should have the same points");
  check.AtMost(LargestDistanceInPart(alone, output), 1e-12 * Diagonal(alone),
    "effect of lines and vertices on the faces");
}

void SeveralComponents(Checker& check)
{
  check.About("several components");
  const Surface first = MakeEllipsoid(LongAxes);
  const Surface second = Shifted(MakeEllipsoid({ 0.5, 0.2, 0.2 }), { 3.0, 1.0, 0.0 });
  const Surface third = MakeSurface({ { 0, 0, 4 }, { 1, 0, 4 }, { 0, 1, 5 } }, { { 0, 1, 2 } });
  const Surface input = Together({ first, second, third });
  const vtkIdType n = first->GetNumberOfPoints();
  const auto stitches = [](WatchedFilter& filter, const char* name = "NumberOfStitches")
  {
    filter.Output();
    return filter->GetOutputDataObject(1)->GetFieldData()->GetArray(name)->GetComponent(0, 0);
  };
  CheckCentroid(check, input, CheckRound(check, input), 0, 2 * n + 3); // of the whole
  WatchedEnergy stitched(input);
  stitched->SetSphericalWeightingToUniform(); // closed forms have no stitches
  check(stitches(stitched) >= 6.0, "three parts should hold each other by three stitches");

  WatchedEnergy apart(input);
  apart->SetSphericalWeightingToUniform();
  apart->SetComponentCouplingToIndependent();
  const Surface output = apart.Output();
  check(stitches(apart) == 0.0, "independent parts should have no stitches");
  CheckCentroid(check, input, output, 0, n);
  CheckCentroid(check, input, output, n, 2 * n);
  CheckCentroid(check, input, output, 2 * n, 2 * n + 3);

  // The two sides of thin walls hold each other when details are kept.
  WatchedEnergy plate(MakeEllipsoid({ 1.0, 1.0, 0.02 }));
  check(stitches(plate, "NumberOfWallStitches") == 0.0, "without details there should be none");
  plate->SetDetailSize(0.03);
  check(stitches(plate, "NumberOfWallStitches") > 0.0, "a plate should have stitches through it");
  check(stitches(plate) == 0.0, "a plate is one part");
  plate->SetSphericalWeightingToUniform();
  check(stitches(plate, "NumberOfWallStitches") > 0.0, "where an energy is minimized too");

  Tested anchored(input);
  anchored->SetAnchorToLastPoint();
  anchored->SetKeepSizeToOff(); // it scales about the mean
  check.About("several components, last point of the whole anchored");
  check.AtMost(Distance(PointOf(input, 2 * n + 2), PointOf(anchored.Output(), 2 * n + 2)),
    1e-12 * Diagonal(input), "move of the last point");
  stitched->SetAnchorToLastPoint();
  check.AtMost(Distance(PointOf(input, 2 * n + 2), PointOf(stitched.Output(), 2 * n + 2)),
    1e-12 * Diagonal(input), "move of the last point of an energy");
  apart->SetAnchorToLastPoint();
  check.About("several components, last point anchored");
  for (const vtkIdType last : { n - 1, 2 * n - 1, 2 * n + 2 })
  {
    check.AtMost(Distance(PointOf(input, last), PointOf(apart.Output(), last)),
      1e-12 * Diagonal(input), "move of point " + Text(last) + ", the last of its component");
  }
}

void OpenBorder(Checker& check)
{
  check.About("open border");
  const Surface closed = MakeEllipsoid(LongAxes);
  std::vector<Vector> points;
  for (vtkIdType i = 0; i < closed->GetNumberOfPoints(); ++i)
  {
    points.push_back(PointOf(closed, i));
  }
  std::vector<Cell> half;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < closed->GetNumberOfPolys(); c += c < 40 ? 1 : 3) // a bowl full of holes
  {
    closed->GetPolys()->GetCellAtId(c, ids);
    half.emplace_back(ids->begin(), ids->end());
  }
  Tested filter;
  CheckSound(check, filter, MakeSurface(points, half));
}

void NonManifold(Checker& check)
{
  check.About("edge of three triangles");
  CheckRound(check,
    MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, 1, 0 }, { 0.5, -0.8, 0.5 }, { 0.4, 0, -1 } },
      { { 0, 1, 2 }, { 0, 1, 3 }, { 1, 0, 4 } }));

  check.About("fin on an ellipsoid, twice the same triangle");
  const Surface input = MakeEllipsoid(LongAxes);
  const vtkIdType fin = input->GetPoints()->InsertNextPoint(0.1, 0.0, -3.0);
  const Cell edge = { 0, 1, fin };
  input->GetPolys()->InsertNextCell(3, edge.data());
  input->GetPolys()->InsertNextCell(3, edge.data());
  const Surface output = CheckRound(check, input);
  CheckCentroid(check, input, output, 0, input->GetNumberOfPoints());

  check.About("two tetrahedra with one point in common");
  CheckRound(check,
    MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { -1, 0, 0 }, { 0, -1.5, 0 },
                  { 0, 0, -1 } },
      { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 }, { 0, 5, 4 }, { 0, 4, 6 }, { 0, 6, 5 },
        { 4, 5, 6 } }));
}

void PointsOfNoCell(Checker& check)
{
  check.About("points of no cell");
  const Surface alone = MakeEllipsoid(LongAxes);
  std::vector<Vector> points = { { 1e6, -7.0, 1.0 / 3.0 } }; // one far away in front
  for (vtkIdType i = 0; i < alone->GetNumberOfPoints(); ++i)
  {
    points.push_back(PointOf(alone, i));
  }
  points.push_back({ 0.0, 0.0, 0.0 });
  points.push_back(points[5]); // at the place of a point that moves
  std::vector<Cell> polygons;
  for (const auto& t : TriangleCorners(alone))
  {
    polygons.push_back({ t[0] + 1, t[1] + 1, t[2] + 1 });
  }
  const Surface input = MakeSurface(points, polygons);
  const Surface output = CheckRound(check, input);
  const auto n = static_cast<vtkIdType>(points.size());
  CheckStill(check, input, output, { 0, n - 2 });
  check(AllFinite(output->GetPoints()->GetData()), "points should be finite");

  const Surface same = CheckRound(check, alone);
  check.AtMost(
    LargestDistanceInPart(same, output, 1), 1e-12 * Diagonal(alone), "their effect on the surface");
}

void TextureSeam(Checker& check, vtkPolyData* icosahedron)
{
  check.About("texture seam");
  const std::vector<Cell> seam = CoincidentPoints(icosahedron);
  check(seam.size() > 10, "the model should have a seam");
  for (const double blend : { 0.0, 1.0 })
  {
    Tested filter;
    filter->SetNormalBlend(blend);
    vtkPolyData* output = CheckSound(check, filter, icosahedron);
    check.AtMost(-LargestDistance(icosahedron, output), -0.01, "minus the largest movement");
    for (const Cell& group : seam)
    {
      for (const vtkIdType i : group)
      {
        check(SamePoint(output, group[0], output, i),
          "points " + Text(group[0]) + " and " + Text(i) + " should stay together to the bit");
      }
    }
  }
}

void WeldOff(Checker& check, vtkPolyData* car)
{
  check.About("two halves at one seam");
  // The points of the upper half once more, also those of the ring they share.
  const Surface closed = MakeEllipsoid(LongAxes);
  const vtkIdType n = closed->GetNumberOfPoints();
  std::vector<Cell> polygons[2];
  for (const auto& t : TriangleCorners(closed))
  {
    const double height =
      PointOf(closed, t[0])[2] + PointOf(closed, t[1])[2] + PointOf(closed, t[2])[2];
    polygons[height > 0.0].push_back({ t[0], t[1], t[2] });
  }
  std::vector<Vector> points;
  std::map<vtkIdType, vtkIdType> number;
  vtkIdType lower = 0;
  for (int part = 0; part < 2; ++part)
  {
    number.clear();
    for (Cell& cell : polygons[part])
    {
      for (vtkIdType& id : cell)
      {
        const auto known = number.emplace(id, static_cast<vtkIdType>(points.size()));
        if (known.second)
        {
          points.push_back(PointOf(closed, id));
        }
        id = known.first->second;
      }
    }
    lower = part == 0 ? static_cast<vtkIdType>(points.size()) : lower;
  }
  polygons[0].insert(polygons[0].end(), polygons[1].begin(), polygons[1].end());
  const Surface input = MakeSurface(points, polygons[0]);
  const auto all = static_cast<vtkIdType>(points.size());
  const std::vector<Cell> seam = CoincidentPoints(input);
  check(all == n + 16 && seam.size() == 16, "the test should have a seam of 16 points");
  const auto opening = [&](vtkPolyData* output)
  {
    double largest = 0.0;
    for (const Cell& pair : seam)
    {
      largest = std::max(largest, Distance(PointOf(output, pair[0]), PointOf(output, pair[1])));
    }
    return largest;
  };
  Tested welded;
  check(opening(CheckSound(check, welded, input)) == 0.0, "welded, the seam should stay closed");
  WatchedEnergy filter;
  filter->SetSphericalWeightingToUniform(); // in closed form they do not know of each other anyway
  check(opening(CheckSound(check, filter, input)) == 0.0, "of an energy too");
  filter->WeldCoincidentPointsOff();
  const double stitched = opening(CheckSound(check, filter, input));
  filter->SetComponentCouplingToIndependent();
  vtkPolyData* output = CheckSound(check, filter, input);
  check(opening(output) > 0.01, "not welded, the seam should open");
  check(stitched < 0.2 * opening(output), "stitched, it should open less");
  CheckCentroid(check, input, output, 0, lower);
  CheckCentroid(check, input, output, lower, all);

  check.About("panels of a car, not welded");
  vtkDataArray* panels = car->GetCellData()->GetArray("PanelIds");
  WatchedEnergy filterOfCar;
  filterOfCar->SetSphericalWeightingToUniform();
  filterOfCar->WeldCoincidentPointsOff();
  filterOfCar->SetComponentCouplingToIndependent();
  filterOfCar->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkPolyData* apart = CheckSound(check, filterOfCar, car);
  const auto corners = TriangleCorners(car);
  std::map<int, std::map<vtkIdType, int>> pointsOfPanel;
  for (std::size_t c = 0; c < corners.size(); ++c)
  {
    for (const vtkIdType i : corners[c])
    {
      pointsOfPanel[static_cast<int>(panels->GetTuple1(static_cast<vtkIdType>(c)))][i] = 1;
    }
  }
  check(pointsOfPanel.size() == 24, "the car should have 24 panels");
  for (const auto& panel : pointsOfPanel)
  {
    std::vector<vtkIdType> points;
    for (const auto& point : panel.second)
    {
      points.push_back(point.first);
    }
    check.AtMost(MoveOfCentroid(car, apart, points), 1e-10 * Diagonal(car),
      "move of the centroid of panel " + Text(panel.first));
  }
}

void DegenerateTriangles(Checker& check)
{
  check.About("degenerate triangles");
  const Surface clean = MakeEllipsoid(LongAxes);
  const Surface input = MakeEllipsoid(LongAxes);
  const vtkIdType n = input->GetNumberOfPoints();
  input->GetPoints()->InsertNextPoint(input->GetPoint(7));  // n: on point 7
  input->GetPoints()->InsertNextPoint(9.0, 9.0, 1.0 / 3.0); // n + 1 ... n + 3: on one line
  input->GetPoints()->InsertNextPoint(10.0, 9.0, 1.0 / 3.0);
  input->GetPoints()->InsertNextPoint(12.0, 9.0, 1.0 / 3.0);
  const vtkIdType first = input->GetNumberOfPolys() + 2;
  input->SetVerts(MakeCells({ { 0 } }));
  input->SetLines(MakeCells({ { 0, 1 } }));
  for (const Cell& cell :
    { Cell{ 3, 3, 4 }, Cell{ 7, n, 8 }, Cell{ 5, 5, 5 }, Cell{ n + 1, n + 2, n + 3 } })
  {
    input->GetPolys()->InsertNextCell(3, cell.data());
  }
  Tested filter;
  vtkPolyData* output = CheckSound(check, filter, input);
  check(filter.Warnings.size() == 1, "there should be one warning");
  check(!filter.Warnings.empty() && Contains(filter.Warnings[0], "4 degenerate triangles") &&
      Contains(filter.Warnings[0], "cell " + Text(first)),
    "the warning should count 4 triangles and name cell " + Text(first));
  CheckStill(check, input, output, { n + 1, n + 2, n + 3 });
  const Surface same = CheckRound(check, clean);
  check(same->GetNumberOfPoints() == n, "the surface should have the same points");
  check.AtMost(
    LargestDistanceInPart(same, output), 1e-12 * Diagonal(clean), "their effect on the surface");
}

void NumberTypes(Checker& check)
{
  check.About("number type of the points");
  const Surface single = MakeEllipsoid(LongAxes, Faces::Triangles, 16, 9, VTK_FLOAT);
  const Surface twice = WithPointsOf(single, VTK_DOUBLE);
  const Surface exact = CheckRound(check, twice);
  const Surface rounded = WithPointsOf(exact, VTK_FLOAT);
  struct Case
  {
    vtkPolyData* input;
    int precision;
    int type;
  };
  for (const Case& c : { Case{ single, vtkAlgorithm::DEFAULT_PRECISION, VTK_FLOAT },
         Case{ single, vtkAlgorithm::SINGLE_PRECISION, VTK_FLOAT },
         Case{ single, vtkAlgorithm::DOUBLE_PRECISION, VTK_DOUBLE },
         Case{ twice, vtkAlgorithm::DEFAULT_PRECISION, VTK_DOUBLE },
         Case{ twice, vtkAlgorithm::SINGLE_PRECISION, VTK_FLOAT },
         Case{ twice, vtkAlgorithm::DOUBLE_PRECISION, VTK_DOUBLE } })
  {
    Tested filter;
    filter->SetOutputPointsPrecision(c.precision);
    vtkPolyData* output = CheckSound(check, filter, c.input);
    check(output->GetPoints()->GetDataType() == c.type,
      "precision " + Text(c.precision) + " should give points of type " + Text(c.type));
    check(SamePoints(output, c.type == VTK_FLOAT ? rounded : exact),
      "the solve should be in double whatever the types");
  }
}

void WholeNumbers(Checker& check)
{
  check.About("whole-numbered points");
  const Surface model = MakeEllipsoid(LongAxes);
  const auto coarse = [](const Vector& x) {
    return Vector{ std::round(100 * x[0]), std::round(100 * x[1]), std::round(100 * x[2]) };
  };
  for (const int type : { VTK_INT, VTK_SHORT, VTK_LONG_LONG })
  {
    Tested filter;
    vtkPolyData* output = CheckSound(check, filter, Mapped(model, coarse, type));
    const int result = output->GetPoints()->GetDataType();
    check(result == VTK_FLOAT || result == VTK_DOUBLE, "moved points should not be whole numbers");
    const Surface same = CheckRound(check, Mapped(model, coarse));
    check.AtMost(LargestDistance(output, same), 1e-6 * Diagonal(same), "effect of the type");
  }
}

void OneTriangle(Checker& check)
{
  check.About("one triangle");
  const Surface input = MakeSurface({ { 0, 0, 0 }, { 3, 0, 0 }, { 0, 1, 1 } }, { { 0, 1, 2 } });
  const Surface output = CheckRound(check, input);
  CheckCentroid(check, input, output, 0, 3);
  check(RadiusSpread(output) < RadiusSpread(input), "it should be more equilateral");
}

void PlanarPatch(Checker& check)
{
  check.About("planar patch");
  std::vector<Vector> points;
  std::vector<Cell> polygons;
  for (vtkIdType j = 0; j < 4; ++j)
  {
    for (vtkIdType i = 0; i < 6; ++i)
    {
      points.push_back({ 1.0 * i, 1.0 * j, 2.5 });
      if (i > 0 && j > 0)
      {
        const vtkIdType at = 6 * j + i;
        polygons.push_back({ at - 7, at - 6, at, at - 1 });
      }
    }
  }
  const Surface input = MakeSurface(points, polygons);
  for (const double blend : { 0.0, 0.7 })
  {
    Tested filter;
    filter->SetNormalBlend(blend);
    vtkPolyData* output = CheckSound(check, filter, input);
    double bounds[6];
    output->GetPoints()->GetBounds(bounds);
    check.AtMost(std::max(2.5 - bounds[4], bounds[5] - 2.5), 1e-9, "way out of the plane");
  }
}

void NothingToRound(Checker& check)
{
  check.About("no points");
  for (const Surface& empty : { Surface::New(), MakeSurface({}, {}) })
  {
    Tested filter;
    vtkPolyData* output = CheckSound(check, filter, empty);
    check(output->GetNumberOfPoints() == 0 && output->GetNumberOfCells() == 0,
      "the output should be empty");
  }

  check.About("only lines and vertices");
  const Surface lines = MakeSurface({ { 0, 0, 0 }, { 1, 1, 1 }, { 3, 1.0 / 3.0, 0 } }, {});
  lines->SetLines(MakeCells({ { 0, 1 } }));
  lines->SetVerts(MakeCells({ { 2 } }));
  Tested filterOfLines;
  check(SamePoints(lines, CheckSound(check, filterOfLines, lines)), "nothing should move");

  check.About("points without cells");
  const Surface cloud = MakeSurface({ { 0, 0, 0 }, { 1, 1, 1 }, { 3, 1.0 / 3.0, 0 } }, {});
  Tested filterOfCloud;
  check(SamePoints(cloud, CheckSound(check, filterOfCloud, cloud)), "nothing should move");

  check.About("all points equal");
  const Surface dot = Mapped(MakeEllipsoid(LongAxes),
    [](const Vector&) {
      return Vector{ 0.1, 1e5, 3.0 };
    });
  Tested filterOfDot;
  check(SamePoints(dot, CheckSound(check, filterOfDot, dot)), "nothing should move");
  check(!filterOfDot.Warnings.empty(), "a warning should say why");

  check.About("all points on a line");
  const Surface needle = Mapped(MakeEllipsoid(LongAxes),
    [](const Vector& x) {
      return Vector{ x[2], 2 * x[2], -x[2] };
    });
  Tested filterOfNeedle;
  check(SamePoints(needle, CheckSound(check, filterOfNeedle, needle)), "nothing should move");
  check(!filterOfNeedle.Warnings.empty(), "a warning should say why");
}

void FactsOfEmptyExecution(Checker& check)
{
  check.About("facts after an execution without a solve");
  Tested filter(MakeEllipsoid(LongAxes));
  filter.Output();
  check(filter->GetFinalEnergy() == 0.0 && filter->GetNumberOfIterations() == 0 &&
      filter->GetConverged(),
    "a closed form has neither energy nor iterations");
  filter->SetSphericalWeightingToUniform();
  filter.Output();
  check(filter->GetFinalEnergy() > 0.0 && filter->GetNumberOfIterations() > 0,
    "rounding should leave some energy");
  filter->SetInputData(Surface::New());
  filter.Output();
  check(filter->GetFinalEnergy() == 0.0 && filter->GetNumberOfIterations() == 0,
    "they should be of the last execution, which had an empty input");
}

void CenterOnPoint(Checker& check)
{
  const Surface input = MakeEllipsoid(LongAxes);
  for (const double blend : { 0.0, 0.5 })
  {
    check.About("center on point 17");
    Tested filter;
    filter->SetDetailSize(0.0); // or the base has no point there
    filter->SetNormalBlend(blend);
    filter->SetCenterModeToCustom();
    filter->SetCenter(input->GetPoint(17));
    vtkPolyData* output = CheckSound(check, filter, input);
    check(filter.Warnings.size() == 1 && Contains(filter.Warnings[0], "center") &&
        Contains(filter.Warnings[0], "point 17;"),
      "one warning should name the center and point 17");
    const auto first = Surface::New();
    first->DeepCopy(output);
    filter->Modified();
    check(SamePoints(first, filter.Output()), "the result should be defined: same bits again");
    check.AtMost(LargestDistance(input, output), Diagonal(input), "movement");
  }

  check.About("center on two points at one place, which is also that of the mean");
  const Surface fan =
    MakeSurface({ { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 0 }, { -1, 0, 0 }, { 0, -1, 0 }, { 0, 0, 0 } },
      { { 2, 0, 1 }, { 2, 1, 3 }, { 5, 3, 4 }, { 5, 4, 0 } });
  Tested filter;
  filter->SetDetailSize(0.0);
  vtkPolyData* output = CheckSound(check, filter, fan);
  check(filter.Warnings.size() == 1 && Contains(filter.Warnings[0], "point 2;"),
    "one warning should name point 2, the first");
  check(SamePoint(output, 2, output, 5), "the two should stay together");
}

/// The result of a scaled model, scaled back, is that of the model.
void Scales(Checker& check)
{
  const Surface quads = MakeEllipsoid(LongAxes, Faces::Quads);
  const Surface triangles = MakeEllipsoid(LongAxes, Faces::Triangles);
  struct Case
  {
    vtkPolyData* model;
    double scale;
    int type;
    double tolerance;
  };
  for (const double blend : { 0.0, 0.5 })
  {
    for (const Case& c :
      { Case{ quads, 1e-30, VTK_DOUBLE, Rounding }, Case{ quads, 1e30, VTK_DOUBLE, Rounding },
        Case{ triangles, 1e-100, VTK_DOUBLE, Rounding },
        Case{ triangles, 1e100, VTK_DOUBLE, Rounding }, Case{ quads, 1e-30, VTK_FLOAT, 1e-5 },
        Case{ quads, 1e30, VTK_FLOAT, 1e-5 } })
    {
      vtkPolyData* model = c.model;
      Tested plain(model);
      plain->SetNormalBlend(blend);
      const Surface expected = plain.Output();
      check.About("scale " + vtkVariant(c.scale).ToString() + ", type " + Text(c.type));
      const auto scaled = [&](double by) {
        return [by](const Vector& x) { return Vector{ by * x[0], by * x[1], by * x[2] }; };
      };
      Tested filter;
      filter->SetNormalBlend(blend);
      vtkPolyData* output = CheckSound(check, filter, Mapped(model, scaled(c.scale), c.type));
      check(filter.Warnings.empty(), "no warning should be given");
      check(filter->GetConverged(), "the solve should converge");
      check.AtMost(LargestDistance(Mapped(output, scaled(1.0 / c.scale)), expected),
        c.tolerance * Diagonal(model), "difference to scale 1");
    }
  }
}

void FarAway(Checker& check)
{
  check.About("1e6 from the origin");
  const Surface model = MakeEllipsoid(LongAxes);
  const Vector offset = { 1e6, -1e6, 1e6 };
  const Surface expected = Shifted(CheckRound(check, model), offset);
  check.AtMost(LargestDistance(CheckRound(check, Shifted(model, offset)), expected),
    Rounding * Diagonal(model), "difference to the result at the origin");

  check.About("1e6 from the origin, points that fall together in single precision");
  Tested filter;
  CheckSound(check, filter, WithPointsOf(Shifted(model, offset), VTK_FLOAT));
}

void FilterAfterFilter(Checker& check)
{
  check.About("filter after filter");
  Tested first(MakeEllipsoid(LongAxes));
  Tested second;
  second->SetInputConnection(first->GetOutputPort());
  vtkPolyData* output = second.Output();
  check(first.Errors.empty() && second.Errors.empty(), "no error should be reported");
  check(RadiusSpread(output) < RadiusSpread(first.Output()), "the second should round more");
  int displacements = 0;
  for (int i = 0; i < output->GetPointData()->GetNumberOfArrays(); ++i)
  {
    displacements += std::string(output->GetPointData()->GetArrayName(i)) == "Displacement";
  }
  check(displacements == 1, "there should be one Displacement");
  vtkDataArray* displacement = output->GetPointData()->GetArray("Displacement");
  const Vector x = PointOf(first.Output(), 3);
  const Vector y = PointOf(output, 3);
  Vector d;
  displacement->GetTuple(3, d.data());
  check.AtMost(Distance({ x[0] + d[0], x[1] + d[1], x[2] + d[2] }, y), 1e-12,
    "difference of Displacement to that of the second filter");
}

void CellStorage(Checker& check)
{
  check.About("ids of 32 and 64 bits");
  const Surface narrow = MakeEllipsoid(LongAxes, Faces::Strips);
  const Surface wide = MakeEllipsoid(LongAxes, Faces::Strips);
  for (vtkCellArray* cells : { narrow->GetPolys(), narrow->GetStrips() })
  {
    cells->ConvertTo32BitStorage();
  }
  for (vtkCellArray* cells : { wide->GetPolys(), wide->GetStrips() })
  {
    cells->ConvertTo64BitStorage();
  }
  const Surface a = CheckRound(check, narrow);
  const Surface b = CheckRound(check, wide);
  check(SamePoints(a, b), "the result should have the same bits");
  check(!a->GetPolys()->IsStorage64Bit() && b->GetPolys()->IsStorage64Bit(),
    "the storage should be that of the input");
}

void Executions(Checker& check)
{
  check.About("executions");
  Tested filter(MakeEllipsoid(LongAxes));
  filter.Output();
  check(filter.Starts.size() == 1, "the first Update should execute");
  const vtkMTimeType time = filter.Output()->GetPoints()->GetMTime();
  check(filter.Starts.size() == 1, "a second Update should not execute");
  check(filter.Output()->GetPoints()->GetMTime() == time, "a second Update should not write");
  filter->SetRoundness(filter->GetRoundness());
  filter.Output();
  check(filter.Starts.size() == 1, "setting the value that is set should not execute");

  std::size_t expected = 1;
  const auto changed = [&](const char* what)
  {
    filter.Output();
    check(filter.Starts.size() == ++expected, std::string(what) + " should execute once more");
    filter.Output();
    check(filter.Starts.size() == expected, std::string(what) + " should execute once");
  };
  filter->SetRoundness(1.3);
  changed("Roundness");
  filter->SetCenter(0.1, 0.0, 0.0);
  changed("Center");
  filter->GenerateNormalsOn();
  changed("GenerateNormals");
  filter->SetNormalRadius(1 - filter->GetNormalRadius());
  changed("NormalRadius");
  filter->SetKeepSizeToExtent();
  changed("KeepSize");
  filter->KeepOnGroundOn();
  changed("KeepOnGround");
  filter->SetUpAxisToZ();
  changed("UpAxis");
  filter->SetSymmetryToX();
  changed("Symmetry");
  filter->SetTargetToRoundedBox();
  changed("Target");
  filter->SetTargetEdges(0.0);
  changed("TargetEdges");
  filter->SetTargetLengths(2.0, 1.0, 1.0);
  changed("TargetLengths");
  filter->SetRefineLongEdgesToAutomatic();
  changed("RefineLongEdges");
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "None");
  changed("array 1");
  vtkPolyData::SafeDownCast(filter->GetInput())->GetPoints()->SetPoint(0, 0.0, 0.0, -2.5);
  vtkPolyData::SafeDownCast(filter->GetInput())->GetPoints()->Modified();
  changed("a moved point");
}

void Properties(Checker& check)
{
  Watched<vtkSphericalStyleFilter> filter;
  check.About("properties");
  using FilterType = vtkSphericalStyleFilter;
  RoundTrip(Roundness, 1.0, 3.0);
  RoundTrip(NormalBlend, 0.6, 0.25);
  RoundTrip(NormalRadius, 0, 1);
  RoundTrip(KeepSize, 1, 3);
  OnOff(KeepOnGround, false);
  RoundTrip(UpAxis, 1, 2);
  RoundTrip(Symmetry, 0, 2);
  RoundTrip(Target, 0, 2);
  RoundTrip(TargetEdges, 0.5, 0.25);
  RoundTrip(CenterMode, 1, 2);
  RoundTrip(RadiusMode, 0, 2);
  RoundTrip(Radius, 1.0, 7.0);
  RoundTrip(DetailSize, 0.06, 0.03);
  RoundTrip(SphereOf, 1, 0);
  RoundTrip(BorderWidth, 0.1, 0.3);
  RoundTrip(CenterBlendWidth, 0.02, 0.2);
  RoundTrip(SphericalWeighting, 1, 0);
  OnOff(AvoidSelfIntersections, false);
  RoundTrip(EdgeWeighting, 0, 2);
  RoundTrip(StopRule, 0, 2);
  RoundTrip(Tolerance, 1e-4, 1e-6);
  RoundTrip(MaximumNumberOfIterations, 200, 3);
  RoundTrip(RefineLongEdges, 1, 2);
  RoundTrip(MaximumEdgeLength, 0.04, 0.1);
  OnOff(ReproduceThesis, false);
  RoundTrip(OutputPointsPrecision, vtkAlgorithm::DEFAULT_PRECISION, vtkAlgorithm::DOUBLE_PRECISION);
  RoundTrip(NumberOfThreads, 0, 2);
  OnOff(TransformAllInputVectors, false);
  OnOff(GenerateDisplacement, true);
  OnOff(GenerateNormals, false);
  OnOff(GenerateRotation, false);

  Clamped(NormalBlend, -0.5, 0.0);
  Clamped(NormalBlend, 1.5, 1.0);
  Clamped(DetailSize, -1.0, 0.0);
  Clamped(DetailSize, 1.0, 0.2);
  Clamped(MaximumEdgeLength, 0.0, 0.001);
  Clamped(MaximumEdgeLength, 2.0, 1.0);
  Clamped(BorderWidth, -1.0, 0.0);
  Clamped(CenterBlendWidth, 2.0, 1.0);
  Clamped(Tolerance, 0.0, 1e-14);
  Clamped(MaximumNumberOfIterations, -1, 0);
  Clamped(CenterMode, 3, 2);
  Clamped(EdgeWeighting, 3, 2);
  Clamped(NormalRadius, 2, 1);
  Clamped(KeepSize, 4, 3);
  Clamped(KeepSize, -1, 0);
  Clamped(UpAxis, 3, 2);
  Clamped(Symmetry, 5, 4);
  Clamped(Target, 7, 6);
  Clamped(TargetEdges, 1.5, 1.0);
  filter->SetRefineLongEdges(true); // it was a bool once
  check(filter->GetRefineLongEdges() == 1, "true should be Automatic");
  Clamped(RefineLongEdges, 3, 2);
  Clamped(NumberOfThreads, -1, 0);

  Mode(CenterMode, PointMean, POINT_MEAN, 0);
  Mode(CenterMode, AreaCentroid, AREA_CENTROID, 1);
  Mode(CenterMode, Custom, CUSTOM_CENTER, 2);
  Mode(RadiusMode, EqualArea, EQUAL_AREA, 0);
  Mode(RadiusMode, EqualVolume, EQUAL_VOLUME, 1);
  Mode(RadiusMode, Custom, CUSTOM_RADIUS, 2);
  Mode(SphereOf, WholeModel, WHOLE_MODEL, 0);
  Mode(SphereOf, Region, REGION, 1);
  Mode(SphericalWeighting, Uniform, UNIFORM, 0);
  Mode(SphericalWeighting, Cotangent, COTANGENT, 1);
  Mode(EdgeWeighting, HalfEdge, HALF_EDGE, 0);
  Mode(EdgeWeighting, FullEdge, FULL_EDGE, 1);
  Mode(EdgeWeighting, IntrinsicDelaunay, INTRINSIC_DELAUNAY, 2);
  Mode(StopRule, Converged, CONVERGED, 0);
  Mode(StopRule, Thesis, THESIS, 1);
  Mode(StopRule, FixedIterations, FIXED_ITERATIONS, 2);
  Mode(NormalRadius, OwnThickness, OWN_THICKNESS, 0);
  Mode(NormalRadius, WholeModel, WHOLE_MODEL_RADIUS, 1);
  Mode(KeepSize, Off, NO_SIZE, 0);
  Mode(KeepSize, Area, AREA, 1);
  Mode(KeepSize, Volume, VOLUME, 2);
  Mode(KeepSize, Extent, EXTENT, 3);
  Mode(UpAxis, X, X_AXIS, 0);
  Mode(UpAxis, Y, Y_AXIS, 1);
  Mode(UpAxis, Z, Z_AXIS, 2);
  Mode(Symmetry, Off, NO_SYMMETRY, 0);
  Mode(Symmetry, Automatic, FOUND_PLANE, 1);
  Mode(Symmetry, X, ACROSS_X, 2);
  Mode(Symmetry, Y, ACROSS_Y, 3);
  Mode(Symmetry, Z, ACROSS_Z, 4);
  Mode(Target, Sphere, SPHERE, 0);
  Mode(Target, Ellipsoid, ELLIPSOID, 1);
  Mode(Target, Capsule, CAPSULE, 2);
  Mode(Target, Cylinder, CYLINDER, 3);
  Mode(Target, RoundedBox, ROUNDED_BOX, 4);
  Mode(Target, Superquadric, SUPERQUADRIC, 5);
  Mode(Target, Mesh, TARGET_MESH, 6);
  Mode(RefineLongEdges, Off, NEVER, 0);
  Mode(RefineLongEdges, Automatic, WHERE_COARSE, 1);
  Mode(RefineLongEdges, On, ALWAYS, 2);

  const double* center = filter->GetCenter();
  check(center[0] == 0.0 && center[1] == 0.0 && center[2] == 0.0, "Center should start at 0");
  filter->SetCenter(1.0, 2.0, 3.0);
  double copy[3];
  filter->GetCenter(copy);
  check(copy[0] == 1.0 && copy[1] == 2.0 && copy[2] == 3.0, "Center should be 1 2 3");

  std::ostringstream printed;
  filter->Print(printed);
  for (const char* name : { "Roundness", "NormalBlend", "CenterMode", "Center", "RadiusMode",
         "Radius", "DetailSize", "SphericalWeighting", "EdgeWeighting", "StopRule", "Tolerance",
         "MaximumNumberOfIterations", "NormalRadius", "KeepSize", "KeepOnGround", "UpAxis",
         "Symmetry", "Target", "TargetEdges", "TargetLengths", "RefineLongEdges",
         "MaximumEdgeLength", "ReproduceThesis", "OutputPointsPrecision", "NumberOfThreads",
         "TransformAllInputVectors", "GenerateDisplacement", "GenerateNormals", "GenerateRotation",
         "NumberOfIterations", "Converged", "FinalEnergy", "EffectiveCenter", "EffectiveRadius",
         "AvoidSelfIntersections", "TurnedOverBefore", "TurnedOverAfter", "NewIntersectionsBefore",
         "NewIntersectionsAfter", "FoldSummary", "Advice" })
  {
    check(Contains(printed.str(), std::string(" ") + name + ": "),
      std::string("PrintSelf should print ") + name);
  }
}
}

int TestSphericalStyleFilterInputs(int argc, char* argv[])
{
  const Surface icosahedron = ReadModel(argc, argv, "icosahedron.vtp");
  const Surface car = ReadModel(argc, argv, "car.vtp");
  Checker check;
  Properties(check);
  WithEach({ { "closed form", SetUpEnergy }, { "defaults", SetUpDefaults } },
    [&]
    {
      Triangles(check);
      RoundnessZero(check);
      Quads(check);
      Strips(check);
      PlanarPolygons(check);
      BentPolygons(check);
      MixedCells(check);
      SeveralComponents(check);
      OpenBorder(check);
      NonManifold(check);
      PointsOfNoCell(check);
      TextureSeam(check, icosahedron);
      WeldOff(check, car);
      DegenerateTriangles(check);
      NumberTypes(check);
      OneTriangle(check);
      PlanarPatch(check);
      NothingToRound(check);
      FactsOfEmptyExecution(check);
      CenterOnPoint(check);
      Scales(check);
      FarAway(check);
      FilterAfterFilter(check);
      CellStorage(check);
      Executions(check);
      WholeNumbers(check);
    });
  return check.Result();
}
