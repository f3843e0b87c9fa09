// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// vtkMeshMorphingFilter: the chain that it is made for over every kind of data set, what is exact,
/// qualities against those of VTK, cells that only it keeps from inverting, and every error.
#include "FilterTesting.h"

#include "vtkMeshMorphingFilter.h"

#include "vtkCell.h"
#include "vtkClipDataSet.h"
#include "vtkDataSetSurfaceFilter.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkGenericCell.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkRectilinearGrid.h"
#include "vtkSMPTools.h"
#include "vtkSphere.h"
#include "vtkSphereSource.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"

#include <limits>

using namespace FilterTesting;

namespace
{
std::string NameOf(int cellType)
{
  return vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(cellType))->GetClassName();
}

using Grid = vtkSmartPointer<vtkUnstructuredGrid>;
using Motion = std::function<Vector(const Vector&)>;

Vector PointOf(vtkDataSet* data, vtkIdType i)
{
  Vector x;
  data->GetPoint(i, x.data());
  return x;
}

double Distance(const Vector& a, const Vector& b)
{
  return std::sqrt(vtkMath::Distance2BetweenPoints(a.data(), b.data()));
}

/// n x n x n cubes in the unit cube, as hexahedra, voxels, wedges, tetrahedra or pyramids.
Grid MakeCube(int n, int type, int precision = VTK_DOUBLE)
{
  auto grid = Grid::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(precision);
  for (int k = 0; k <= n; ++k)
  {
    for (int j = 0; j <= n; ++j)
    {
      for (int i = 0; i <= n; ++i)
      {
        points->InsertNextPoint(1.0 * i / n, 1.0 * j / n, 1.0 * k / n);
      }
    }
  }
  const std::map<int, std::vector<Cell>> pieces = { { VTK_HEXAHEDRON,
                                                      { { 0, 1, 2, 3, 4, 5, 6, 7 } } },
    { VTK_VOXEL, { { 0, 1, 3, 2, 4, 5, 7, 6 } } },
    { VTK_WEDGE, { { 0, 1, 2, 4, 5, 6 }, { 0, 2, 3, 4, 6, 7 } } },
    { VTK_TETRA,
      { { 0, 1, 2, 6 }, { 0, 2, 3, 6 }, { 0, 3, 7, 6 }, { 0, 7, 4, 6 }, { 0, 4, 5, 6 },
        { 0, 5, 1, 6 } } },
    { VTK_PYRAMID,
      { { 0, 1, 2, 3, 8 }, { 4, 7, 6, 5, 8 }, { 0, 4, 5, 1, 8 }, { 1, 5, 6, 2, 8 },
        { 2, 6, 7, 3, 8 }, { 3, 7, 4, 0, 8 } } } };
  grid->Allocate(n * n * n);
  for (int cube = 0; cube < n * n * n; ++cube)
  {
    const vtkIdType i = cube % n;
    const vtkIdType j = cube / n % n;
    const vtkIdType k = cube / n / n;
    const auto id = [&](vtkIdType a, vtkIdType b, vtkIdType c)
    { return ((k + c) * (n + 1) + j + b) * (n + 1) + i + a; };
    Cell corners = { id(0, 0, 0), id(1, 0, 0), id(1, 1, 0), id(0, 1, 0), id(0, 0, 1), id(1, 0, 1),
      id(1, 1, 1), id(0, 1, 1) };
    if (type == VTK_PYRAMID)
    {
      corners.push_back(points->InsertNextPoint((static_cast<double>(i) + 0.5) / n,
        (static_cast<double>(j) + 0.5) / n, (static_cast<double>(k) + 0.5) / n));
    }
    for (const Cell& piece : pieces.at(type))
    {
      Cell ids;
      for (const vtkIdType corner : piece)
      {
        ids.push_back(corners[corner]);
      }
      grid->InsertNextCell(type, static_cast<vtkIdType>(ids.size()), ids.data());
    }
  }
  grid->SetPoints(points);
  vtkNew<vtkDoubleArray> numbers;
  numbers->SetName("Pressure");
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    numbers->InsertNextValue(0.5 * static_cast<double>(i));
  }
  grid->GetPointData()->SetScalars(numbers);
  vtkNew<vtkDoubleArray> ofCells;
  ofCells->DeepCopy(numbers);
  ofCells->SetName("Material");
  ofCells->Resize(grid->GetNumberOfCells());
  ofCells->SetNumberOfTuples(grid->GetNumberOfCells());
  grid->GetCellData()->AddArray(ofCells);
  return grid;
}

Surface SurfaceOf(vtkDataSet* data)
{
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputData(data);
  surface->Update();
  return surface->GetOutput();
}

/// A surface, moved, with the array Displacement, as the filters of this module leave it.
Surface Moved(vtkPolyData* rest, const Motion& motion)
{
  auto moved = Surface::New();
  moved->DeepCopy(rest);
  vtkNew<vtkDoubleArray> displacement;
  displacement->SetName("Displacement");
  displacement->SetNumberOfComponents(3);
  displacement->SetNumberOfTuples(rest->GetNumberOfPoints());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(rest->GetNumberOfPoints());
  for (vtkIdType i = 0; i < rest->GetNumberOfPoints(); ++i)
  {
    const Vector x = PointOf(rest, i);
    const Vector y = motion(x);
    points->SetPoint(i, y.data());
    displacement->SetTuple3(i, y[0] - x[0], y[1] - x[1], y[2] - x[2]);
  }
  moved->SetPoints(points);
  moved->GetPointData()->AddArray(displacement);
  return moved;
}

Surface Rounded(vtkPolyData* surface, double roundness = 1.0)
{
  vtkNew<vtkSphericalStyleFilter> style;
  style->SetInputData(surface);
  style->SetRoundness(roundness);
  style->SetDetailSize(0.0);
  style->Update();
  return style->GetOutput();
}

/// The filter, with its messages caught.
class Morphing : public Watched<vtkMeshMorphingFilter>
{
public:
  Morphing(vtkDataObject* input, vtkPolyData* surface)
  {
    (*this)->SetInputDataObject(0, input);
    (*this)->SetSurfaceData(surface);
    (*this)->Update();
  }
  vtkPointSet* Result() { return vtkPointSet::SafeDownCast((*this)->GetOutputDataObject(0)); }
};

Vector Same(const Vector& x)
{
  return x;
}

Vector Rigid(const Vector& x)
{
  const double c = std::cos(2.0);
  const double s = std::sin(2.0);
  return { c * x[0] - s * x[2] + 3.0, x[1] - 1.0, s * x[0] + c * x[2] + 0.5 };
}

/// A dent in the top that is deeper than the points below it.
Vector Dent(const Vector& x)
{
  const double r = (x[0] - 0.5) * (x[0] - 0.5) + (x[1] - 0.5) * (x[1] - 0.5);
  return { x[0], x[1], x[2] > 0.99 ? x[2] - 0.6 * std::exp(-12.0 * r) : x[2] };
}

constexpr int VolumeTypes[] = { VTK_TETRA, VTK_PYRAMID, VTK_WEDGE, VTK_HEXAHEDRON, VTK_VOXEL };

void CheckSame(Checker& check, vtkPointSet* result, vtkDataSet* input)
{
  check(result->GetNumberOfCells() == input->GetNumberOfCells() &&
      result->GetNumberOfPoints() == input->GetNumberOfPoints(),
    "there should be the same points and cells");
  bool same = true;
  for (vtkIdType c = 0; c < input->GetNumberOfCells(); ++c)
  {
    vtkNew<vtkIdList> a;
    vtkNew<vtkIdList> b;
    input->GetCellPoints(c, a);
    result->GetCellPoints(c, b);
    same = same && a->GetNumberOfIds() == b->GetNumberOfIds() &&
      std::equal(a->GetPointer(0), a->GetPointer(0) + a->GetNumberOfIds(), b->GetPointer(0));
  }
  // The cells of an image become hexahedra, which have another order than voxels.
  check(same || !vtkPointSet::SafeDownCast(input), "cells should have the same points");
  for (int k = 0; k < input->GetPointData()->GetNumberOfArrays(); ++k)
  {
    vtkDataArray* array = input->GetPointData()->GetArray(k);
    check(result->GetPointData()->GetArray(array->GetName()) == array ||
        array == input->GetPointData()->GetNormals(), // which turn
      std::string("the array should be handed on: ") + array->GetName());
  }
  vtkDataArray* displacement = result->GetPointData()->GetArray("Displacement");
  check(displacement && displacement->GetNumberOfComponents() == 3, "there should be Displacement");
}

double LargestDifference(vtkPointSet* result, vtkDataSet* input, const Motion& motion)
{
  double largest = 0.0;
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    largest = std::max(largest, Distance(PointOf(result, i), motion(PointOf(input, i))));
  }
  return largest;
}

void TestExact(Checker& check)
{
  for (const int type : VolumeTypes)
  {
    for (const int precision : { VTK_DOUBLE, VTK_FLOAT })
    {
      check.About(std::string("exact: ") + NameOf(type));
      const Grid grid = MakeCube(4, type, precision);
      const Surface surface = SurfaceOf(grid);
      Morphing still(grid, Moved(surface, Same));
      check(LargestDifference(still.Result(), grid, Same) == 0.0, "nothing should move");
      check(still->GetNumberOfIterations() == 0, "no step should be taken");
      CheckSame(check, still.Result(), grid);
      Morphing rigid(grid, Moved(surface, Rigid));
      check.AtMost(LargestDifference(rigid.Result(), grid, Rigid),
        precision == VTK_FLOAT ? 1e-6 : 1e-11, "difference from a rigid motion");
      check(rigid.Result()->GetPoints()->GetDataType() == precision, "the type of points stays");
      check(still.Errors.empty() && rigid.Errors.empty() && rigid.Warnings.empty(), "no message");
    }
  }
}

/// The chain, with long edges split, so that the surface has more points.
void TestChain(Checker& check)
{
  for (const int type : VolumeTypes)
  {
    check.About(std::string("chain: ") + NameOf(type));
    const Grid grid = MakeCube(6, type);
    const Surface surface = Rounded(SurfaceOf(grid));
    Morphing morphing(grid, surface);
    if (!check(morphing.Errors.empty(), morphing.Errors.empty() ? "" : morphing.Errors[0]))
    {
      continue;
    }
    CheckSame(check, morphing.Result(), grid);
    check(morphing->GetNumberOfVolumeCells() == grid->GetNumberOfCells(), "all cells count");
    check(morphing->GetSmallestScaledJacobianAfter() > 0.0, "no cell is inverted");
    check(morphing->GetNumberOfInvertedCells() == 0, "and none counted");
    vtkFieldData* facts = morphing.Result()->GetFieldData();
    check(facts->GetArray("SmallestScaledJacobianBefore")->GetTuple1(0) ==
          morphing->GetSmallestScaledJacobianBefore() &&
        facts->GetArray("SmallestScaledJacobianAfter")->GetTuple1(0) ==
          morphing->GetSmallestScaledJacobianAfter(),
      "field data should say the same");
    // Each point of the boundary is where a point of the surface is.
    const Surface own = SurfaceOf(morphing.Result());
    double largest = 0.0;
    for (vtkIdType i = 0; i < own->GetNumberOfPoints(); ++i)
    {
      Vector x = PointOf(own, i);
      largest = std::max(largest, Distance(x, PointOf(surface, surface->FindPoint(x.data()))));
    }
    check.AtMost(largest, 1e-6, "distance of the boundary from the surface");
  }
}

/// Known values: cubes sheared by 45 degrees, and a cube cut into six tetrahedra, by hand.
void TestJacobians(Checker& check)
{
  check.About("scaled Jacobians");
  const Grid grid = MakeCube(3, VTK_HEXAHEDRON);
  const Motion shear = [](const Vector& x) { return Vector{ x[0] + x[2], x[1], x[2] }; };
  Morphing morphing(grid, Moved(SurfaceOf(grid), shear));
  check.AtMost(std::abs(morphing->GetSmallestScaledJacobianBefore() - 1.0), 1e-12, "of cubes");
  check.AtMost(std::abs(morphing->GetSmallestScaledJacobianAfter() - std::sqrt(0.5)), 1e-9,
    "of cubes sheared by 45 degrees");
  // Edges at 0 of 0 1 2 6: 1, sqrt(2), sqrt(3); at 1: 1, 1, sqrt(2); the smallest is at 0 or 6.
  Morphing tetrahedra(MakeCube(2, VTK_TETRA), Moved(SurfaceOf(MakeCube(2, VTK_TETRA)), Same));
  check.AtMost(
    std::abs(tetrahedra->GetSmallestScaledJacobianBefore() - std::sqrt(2.0) / std::sqrt(6.0)),
    1e-12, "of tetrahedra");
}

void TestRepairs(Checker& check)
{
  for (const int type : VolumeTypes)
  {
    check.About(std::string("dent: ") + NameOf(type));
    const Grid grid = MakeCube(6, type);
    const Surface dent = Moved(SurfaceOf(grid), Dent);
    Morphing morphing(grid, dent);
    check(morphing.Errors.empty(), "there should be no error");
    check(morphing->GetSmallestScaledJacobianAfter() > 0.0, "no cell should be inverted");
    const auto with = [&](int threads)
    {
      Surface points;
      vtkSMPTools::LocalScope(vtkSMPTools::Config{ threads },
        [&]
        {
          Morphing again(grid, dent);
          points = Surface::New();
          points->SetPoints(again.Result()->GetPoints());
        });
      return points;
    };
    check(LargestDifference(with(1), with(2), Same) == 0.0, "the same bits on two threads");
  }
}

/// Images, rectilinear grids, surfaces, points: carried near the surface.
void TestNear(Checker& check)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(32);
  source->SetPhiResolution(16);
  source->Update();
  const Surface ball = source->GetOutput();
  vtkNew<vtkImageData> image;
  image->SetExtent(-2, 5, 0, 6, 1, 8);
  image->SetOrigin(-0.5, -0.7, -0.9);
  image->SetSpacing(0.2, 0.2, 0.2);
  image->AllocateScalars(VTK_FLOAT, 1);
  image->GetPointData()->GetScalars()->Fill(1.0);
  vtkNew<vtkRectilinearGrid> rectilinear;
  rectilinear->SetDimensions(4, 2, 3);
  const auto coordinates = [](int n)
  {
    auto array = vtkSmartPointer<vtkDoubleArray>::New();
    for (int i = 0; i < n; ++i)
    {
      array->InsertNextValue(0.3 * i * i);
    }
    return array;
  };
  rectilinear->SetXCoordinates(coordinates(4));
  rectilinear->SetYCoordinates(coordinates(2));
  rectilinear->SetZCoordinates(coordinates(3));
  const Grid lines = Grid::New();
  lines->Allocate(1);
  lines->SetPoints(ball->GetPoints());
  const vtkIdType ends[] = { 0, 1 };
  lines->InsertNextCell(VTK_LINE, 2, ends);
  for (vtkDataSet* input : { static_cast<vtkDataSet*>(image), static_cast<vtkDataSet*>(rectilinear),
         static_cast<vtkDataSet*>(ball), static_cast<vtkDataSet*>(lines) })
  {
    check.About(std::string("near: ") + input->GetClassName());
    Morphing still(input, Moved(ball, Same));
    check(LargestDifference(still.Result(), input, Same) == 0.0, "nothing should move");
    CheckSame(check, still.Result(), input);
    Morphing rigid(input, Moved(ball, Rigid));
    check.AtMost(LargestDifference(rigid.Result(), input, Rigid), 3e-7, "rigid motion");
    check(std::isnan(rigid->GetSmallestScaledJacobianAfter()), "no Jacobian without volume cells");
    check(!rigid.Result()->GetFieldData()->HasArray("SmallestScaledJacobianAfter"), "nor array");
    const bool isGrid = !vtkPointSet::SafeDownCast(input);
    check(rigid.Result()->IsA(isGrid ? "vtkStructuredGrid" : input->GetClassName()), "the kind");
  }
  check.About("near: on the surface");
  const Motion egg = [](const Vector& x) { return Vector{ x[0] + x[2] * x[2], x[1], 1.5 * x[2] }; };
  Morphing onIt(ball, Moved(ball, egg));
  check.AtMost(
    LargestDifference(onIt.Result(), ball, egg), 1e-6, "points of the surface go with it");
}

/// Points of a grid that no volume cell has: a line that sticks out.
void TestMixedDimensions(Checker& check)
{
  check.About("a line that sticks out");
  const Grid grid = MakeCube(3, VTK_HEXAHEDRON);
  const vtkIdType ends[] = { 0, grid->GetPoints()->InsertNextPoint(-1.0, -1.0, -1.0) };
  grid->InsertNextCell(VTK_LINE, 2, ends);
  grid->GetPointData()->Initialize();
  grid->GetCellData()->Initialize();
  Morphing rigid(grid, Moved(SurfaceOf(MakeCube(3, VTK_HEXAHEDRON)), Rigid));
  check.AtMost(LargestDifference(rigid.Result(), grid, Rigid), 1e-11, "rigid motion");
}

void TestInvertedInput(Checker& check)
{
  check.About("cells that are inverted in the input");
  const Grid more = MakeCube(1, VTK_TETRA);
  const Grid both = Grid::New();
  both->SetPoints(more->GetPoints());
  both->Allocate(more->GetNumberOfCells());
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < more->GetNumberOfCells(); ++c)
  {
    more->GetCellPoints(c, ids);
    if (c == 3)
    {
      std::swap(*ids->GetPointer(0), *ids->GetPointer(1));
    }
    both->InsertNextCell(VTK_TETRA, ids);
  }
  {
    Morphing morphing(both, Moved(SurfaceOf(both), Rigid));
    check(morphing.Errors.empty() && morphing.Warnings.empty() &&
        morphing->GetNumberOfInvertedCells() == 0,
      "a cell that is only numbered the other way round is none");
  }
  for (const int type : { VTK_HEXAHEDRON, VTK_TETRA }) // some of what Clip makes of these is, too
  {
    vtkNew<vtkSphere> ball;
    ball->SetCenter(0.4, 0.5, 0.6);
    ball->SetRadius(0.37);
    vtkNew<vtkClipDataSet> clip;
    clip->SetInputData(MakeCube(5, type));
    clip->SetClipFunction(ball);
    clip->InsideOutOn();
    clip->Update();
    const Grid part = clip->GetOutput();
    Morphing morphing(part, Moved(SurfaceOf(part), Rigid));
    check(morphing.Errors.empty() && morphing.Warnings.empty() &&
        morphing->GetSmallestScaledJacobianBefore() > 0.0,
      "no cell of a part that was clipped is inverted");
  }
  // A corner of the cube, pulled through the faces opposite to it in its two tetrahedra.
  both->GetPoints()->SetPoint(1, -0.4, 0.6, 0.6);
  Morphing morphing(both, Moved(SurfaceOf(both), Rigid));
  check(morphing.Errors.empty(), "that is no error");
  check(morphing.Warnings.size() == 1 &&
      Contains(morphing.Warnings[0], "as in the input, 2 cells") &&
      Contains(morphing.Warnings[0], "cell 0"),
    "a warning should name the cell");
  check(morphing->GetNumberOfInvertedCells() == 2, "and the fact count them");
}

struct Bad
{
  const char* name;
  vtkSmartPointer<vtkDataSet> input;
  Surface surface;
  std::vector<const char*> words; ///< of the message
};

Surface Without(const Surface& surface)
{
  auto bare = Surface::New();
  bare->DeepCopy(surface);
  bare->GetPointData()->RemoveArray("Displacement");
  return bare;
}

void TestErrors(Checker& check)
{
  const Grid cube = MakeCube(3, VTK_HEXAHEDRON);
  const Surface good = Moved(SurfaceOf(cube), Rigid);
  std::vector<Bad> all;
  const Grid quadratic = Grid::New();
  quadratic->DeepCopy(MakeCube(1, VTK_HEXAHEDRON));
  quadratic->GetPoints()->InsertNextPoint(0.5, 0.5, 0.5);
  quadratic->GetPoints()->InsertNextPoint(0.2, 0.5, 0.5);
  const vtkIdType ten[] = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9 };
  quadratic->InsertNextCell(VTK_QUADRATIC_TETRA, 10, ten);
  all.push_back(
    { "quadratic", quadratic, good, { "cell 1", "vtkQuadraticTetra", "Tetrahedralize" } });
  all.push_back(
    { "no array", cube, Without(good), { "Surface:", "Displacement", "Spherical Style" } });
  all.push_back(
    { "no surface", cube, nullptr, { "Surface: choose", "Spherical Style", "Extract Surface" } });
  all.push_back({ "no points", cube, Surface::New(), { "Surface:", "no points" } });
  const Surface other = Moved(SurfaceOf(MakeCube(2, VTK_HEXAHEDRON)), Rigid);
  all.push_back(
    { "another surface", cube, other, { "point 1 on the boundary", "away", "Extract Surface" } });
  const Grid infinite = Grid::New();
  infinite->DeepCopy(cube);
  infinite->GetPoints()->SetPoint(5, 0.0, std::numeric_limits<double>::infinity(), 0.0);
  all.push_back({ "infinite", infinite, good, { "point 5 is not finite" } });
  const Grid ids = Grid::New();
  ids->DeepCopy(MakeCube(1, VTK_HEXAHEDRON));
  const vtkIdType wrong[] = { 0, 1, 2, 77 };
  ids->InsertNextCell(VTK_TETRA, 4, wrong);
  all.push_back({ "ids", ids, good, { "cell 1 names point 77" } });
  const Grid few = Grid::New();
  few->DeepCopy(MakeCube(1, VTK_HEXAHEDRON));
  few->InsertNextCell(VTK_TETRA, 3, wrong);
  all.push_back({ "few points", few, good, { "cell 1 has 3 points" } });
  const Grid line = Grid::New();
  line->DeepCopy(MakeCube(1, VTK_HEXAHEDRON));
  const vtkIdType away[] = { 0, -1 };
  line->InsertNextCell(VTK_LINE, 2, away);
  all.push_back({ "ids of a line", line, good, { "cell 1 names point -1" } });
  const Grid unknown = Grid::New();
  unknown->DeepCopy(MakeCube(1, VTK_HEXAHEDRON));
  unknown->InsertNextCell(200, 4, wrong);
  all.push_back({ "type", unknown, good, { "cell 1 is a", "type 200", "Tetrahedralize" } });
  const Grid sizes = Grid::New();
  sizes->DeepCopy(cube);
  sizes->GetPointData()->GetArray("Pressure")->SetNumberOfTuples(3);
  all.push_back({ "sizes", sizes, good, { "array \"Pressure\" has 3 tuples for 64 points" } });
  const Surface beyond = Moved(SurfaceOf(cube), Same);
  beyond->GetPointData()->GetArray("Displacement")->SetComponent(4, 0, 1e301);
  all.push_back({ "too far", cube, beyond, { "Surface: Displacement of point 4", "too far" } });
  const Surface nan = Moved(SurfaceOf(cube), Same);
  nan->GetPointData()->GetArray("Displacement")->SetComponent(2, 1, std::nan(""));
  all.push_back({ "NaN", cube, nan, { "Surface: Displacement of point 2", "not finite" } });
  // The corner of the cube beyond its neighbors: no inner point helps.
  const Motion corner = [](const Vector& x) {
    return x[0] + x[1] + x[2] == 0.0 ? Vector{ 0.5, 0.5, 0.5 } : x;
  };
  all.push_back({ "corner", cube, Moved(SurfaceOf(cube), corner),
    { "1 cell is inverted", "cell 0", "scaled Jacobian", "no motion of inner points",
      "Roundness" } });
  // The surface turned inside out, but for flat corners: what is inside cannot follow.
  const Grid fine = MakeCube(4, VTK_HEXAHEDRON);
  const Motion through = [](const Vector& x)
  {
    return Vector{ x[0], x[1],
      x[2] > 0.99 && std::abs(x[0] - 0.5) < 0.3 && std::abs(x[1] - 0.5) < 0.3 ? -0.5 : x[2] };
  };
  all.push_back({ "through", fine, Moved(SurfaceOf(fine), through),
    { "inverted, the first is cell", "Roundness" } });
  const Surface bare = Surface::New();
  bare->DeepCopy(good);
  bare->SetPolys(nullptr);
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 2);
  all.push_back({ "no triangle", image, bare, { "Surface:", "no triangle" } });
  for (const Bad& bad : all)
  {
    check.About(std::string("error: ") + bad.name);
    Morphing morphing(bad.input, bad.surface);
    if (!check(morphing.Errors.size() == 1,
          "there should be one error, not " + Text(static_cast<vtkIdType>(morphing.Errors.size()))))
    {
      continue;
    }
    for (const char* word : bad.words)
    {
      check(Contains(morphing.Errors[0], word),
        std::string("the message should have \"") + word + "\"; it is " + morphing.Errors[0]);
    }
    check(morphing.Result()->GetNumberOfPoints() == 0, "there should be no output");
    morphing->SetInputDataObject(0, cube);
    morphing->SetSurfaceData(good);
    morphing->Update();
    check.AtMost(LargestDifference(morphing.Result(), cube, Rigid), 1e-11, "then it works again");
  }
}

void TestEmptyAndBlocks(Checker& check)
{
  check.About("nothing");
  const Grid cube = MakeCube(2, VTK_TETRA);
  Morphing nothing(Grid::New(), Moved(SurfaceOf(cube), Same));
  check(nothing.Errors.empty() && nothing.Result()->GetNumberOfPoints() == 0, "it stays empty");
  check.About("blocks");
  vtkNew<vtkMultiBlockDataSet> blocks;
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 3, 3);
  blocks->SetBlock(0, cube);
  blocks->SetBlock(1, image);
  Watched<vtkMeshMorphingFilter> filter;
  filter->SetInputDataObject(0, blocks);
  filter->SetSurfaceData(Moved(SurfaceOf(cube), Rigid));
  filter->Update();
  auto* out = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  if (check(out && out->GetNumberOfBlocks() == 2, "there should be two blocks"))
  {
    check.AtMost(
      LargestDifference(vtkPointSet::SafeDownCast(out->GetBlock(0)), cube, Rigid), 1e-11, "grid");
    check.AtMost(
      LargestDifference(vtkPointSet::SafeDownCast(out->GetBlock(1)), image, Rigid), 1e-9, "image");
  }
}

void TestProgressAndAbort(Checker& check)
{
  check.About("progress");
  const Grid cube = MakeCube(5, VTK_HEXAHEDRON);
  const Surface dent = Moved(SurfaceOf(cube), Dent);
  vtkNew<vtkMeshMorphingFilter> filter;
  filter->SetInputData(cube);
  filter->SetSurfaceData(dent);
  CheckProgress(check, filter, 6);
  check.About("abort");
  vtkNew<vtkCallbackCommand> command;
  command->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void* value)
    {
      if (*static_cast<double*>(value) > 0.1)
      {
        static_cast<vtkAlgorithm*>(caller)->AbortExecuteOn();
      }
    });
  Watched<vtkMeshMorphingFilter> aborted;
  aborted->SetInputData(cube);
  aborted->SetSurfaceData(dent);
  const unsigned long tag = aborted->AddObserver(vtkCommand::ProgressEvent, command);
  aborted->Update();
  check(aborted.Errors.empty(), "it is no error");
  check(aborted->GetOutput()->GetNumberOfPoints() == 0, "there should be no output");
  aborted->RemoveObserver(tag);
  aborted->AbortExecuteOff();
  aborted->Modified();
  aborted->Update();
  filter->Update();
  check(LargestDifference(aborted->GetOutput(), filter->GetOutput(), Same) == 0.0,
    "the next execution gives what one without an abort gives");
}
}

int TestMeshMorphingFilter(int, char*[])
{
  Checker check;
  TestExact(check);
  TestChain(check);
  TestJacobians(check);
  TestRepairs(check);
  TestNear(check);
  TestMixedDimensions(check);
  TestInvertedInput(check);
  TestErrors(check);
  TestEmptyAndBlocks(check);
  TestProgressAndAbort(check);
  return check.Result();
}
