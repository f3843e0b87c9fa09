// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// vtkNormalAnalogyFilter: the contract, its properties, the styles and their closest normals, and
/// bad styles.
#include "ComparatorTesting.h"
#include "PropertyTesting.h"

#include "vtkNormalAnalogyFilter.h"
#include "vtkPlatonicSolidSource.h"
#include "vtkReverseSense.h"

#include <tuple>

using namespace FilterTesting;

namespace
{
using FilterType = vtkNormalAnalogyFilter;

void Properties(Checker& check)
{
  check.About("properties");
  vtkNew<FilterType> filter;
  RoundTrip(Style, 1, 4);
  RoundTrip(Weight, 1.0, 10.0);
  RoundTrip(StopRule, 0, 1);
  RoundTrip(Tolerance, 1e-4, 1e-5);
  RoundTrip(MaximumNumberOfIterations, 200, 7);
  RoundTrip(NumberOfThreads, 0, 2);
  RoundTrip(OutputPointsPrecision, 2, 1);
  OnOff(GenerateTargetNormal, true);
  OnOff(GenerateNormals, false);
  Mode(Style, Tetrahedron, TETRAHEDRON, 0);
  Mode(Style, Cube, CUBE, 1);
  Mode(Style, Octahedron, OCTAHEDRON, 2);
  Mode(Style, Icosahedron, ICOSAHEDRON, 3);
  Mode(Style, Dodecahedron, DODECAHEDRON, 4);
  Mode(Style, Mesh, MESH, 5);
  Mode(StopRule, Converged, CONVERGED, 0);
  Mode(StopRule, Thesis, THESIS, 1);
  Mode(StopRule, FixedIterations, FIXED_ITERATIONS, 2);
  Clamped(Style, 6, 5);
  Clamped(Tolerance, 1.0, 0.5);
  for (const double bad : { -1.0, NaN, HUGE_VAL })
  {
    ExpectError<FilterType>(
      check, "Weight " + vtkVariant(bad).ToString(), { "Weight" },
      [bad](FilterType* self, vtkPolyData*) { self->SetWeight(bad); },
      [](FilterType* self) { self->SetWeight(1.0); });
  }
}

Vector NormalOf(vtkPolyData* surface, const std::array<vtkIdType, 3>& t)
{
  const Vector a = PointOf(surface, t[0]);
  Vector u = PointOf(surface, t[1]);
  Vector v = PointOf(surface, t[2]);
  Vector n;
  vtkMath::Subtract(u.data(), a.data(), u.data());
  vtkMath::Subtract(v.data(), a.data(), v.data());
  vtkMath::Cross(u.data(), v.data(), n.data());
  vtkMath::Normalize(n.data());
  return n;
}

/// Normals of the triangles at each point, weighted by their angles there.
std::vector<Vector> PointNormals(vtkPolyData* surface)
{
  std::vector<Vector> normals(surface->GetNumberOfPoints(), Vector{ 0.0, 0.0, 0.0 });
  for (const auto& t : TriangleCorners(surface))
  {
    const Vector n = NormalOf(surface, t);
    for (int k = 0; k < 3; ++k)
    {
      const Vector p = PointOf(surface, t[k]);
      Vector u = PointOf(surface, t[(k + 1) % 3]);
      Vector v = PointOf(surface, t[(k + 2) % 3]);
      vtkMath::Subtract(u.data(), p.data(), u.data());
      vtkMath::Subtract(v.data(), p.data(), v.data());
      const double angle = vtkMath::AngleBetweenVectors(u.data(), v.data());
      for (int d = 0; d < 3; ++d)
      {
        normals[t[k]][d] += angle * n[d];
      }
    }
  }
  for (Vector& n : normals)
  {
    vtkMath::Normalize(n.data());
  }
  return normals;
}

/// Each target is one of the style's normals, and none of these is nearer to the point's normal.
void CheckTargets(
  Checker& check, Watched<FilterType>& filter, vtkPolyData* input, const std::vector<Vector>& style)
{
  filter->SetGenerateTargetNormal(true);
  vtkDataArray* targets = filter.Output()->GetPointData()->GetArray("TargetNormal");
  const std::vector<Vector> normals = PointNormals(input);
  if (!check(targets && targets->GetNumberOfComponents() == 3, "there should be TargetNormal"))
  {
    return;
  }
  int differ = 0;
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    const Vector t = TupleOf(targets, i);
    const Vector n = normals[i];
    double nearest = -1.0;
    double exact = 2.0;
    for (const Vector& s : style)
    {
      nearest = std::max(nearest, vtkMath::Dot(s.data(), n.data()));
      exact = std::min(exact, Distance(s, t));
    }
    check.AtMost(exact, 2e-6, "distance of a target from the style's normals");
    differ += vtkMath::Dot(t.data(), n.data()) < nearest - 1e-6 ? 1 : 0;
  }
  check(differ == 0, Text(differ) + " targets are not the closest normals");
}

/// The solid with all faces outward; in VTK 9.2 and earlier those of tetrahedron and icosahedron
/// face inward.
Surface MakeSolid(int style)
{
  vtkNew<vtkPlatonicSolidSource> source;
  source->SetSolidType(style);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  Surface solid = source->GetOutput();
  vtkNew<vtkIdList> ids;
  solid->GetCellPoints(0, ids);
  const Vector normal = NormalOf(solid, { ids->GetId(0), ids->GetId(1), ids->GetId(2) });
  if (vtkMath::Dot(normal.data(), solid->GetPoint(ids->GetId(0))) < 0.0)
  {
    vtkNew<vtkReverseSense> reverse;
    reverse->SetInputData(solid);
    reverse->Update();
    solid = reverse->GetOutput();
  }
  return solid;
}

void Styles(Checker& check)
{
  const int normals[] = { 4, 6, 8, 20, 12 };
  const Surface model = MakeModel();
  std::vector<Surface> results;
  for (int style = 0; style < 5; ++style)
  {
    check.About("style " + Text(style));
    const Surface solid = MakeSolid(style);
    Watched<FilterType> filter(model);
    filter->SetStyle(style);
    vtkPolyData* output = filter.Output();
    check(filter->GetNumberOfStyleNormals() == normals[style],
      "it should have " + Text(normals[style]) + " normals, not " +
        Text(filter->GetNumberOfStyleNormals()));
    for (const Surface& other : results)
    {
      check(LargestDistance(other, output) > 1e-3, "each style should give another shape");
    }
    results.emplace_back(Surface::New());
    results.back()->DeepCopy(output);

    std::vector<Vector> all;
    vtkNew<vtkIdList> ids;
    for (vtkIdType c = 0; c < solid->GetNumberOfCells(); ++c)
    {
      solid->GetCellPoints(c, ids);
      all.push_back(NormalOf(solid, { ids->GetId(0), ids->GetId(1), ids->GetId(2) }));
    }
    CheckTargets(check, filter, model, all);

    Watched<FilterType> mesh(model);
    mesh->SetStyleToMesh();
    mesh->SetStyleMeshData(solid);
    check(SamePolyData(output, mesh.Output()), "the solid as a mesh should do the same");
    check(mesh.Errors.empty(), "no error");
  }
}

/// Thousands of normals, all in one plane, and only one: the search has to find the closest of
/// each.
void MeshStyles(Checker& check)
{
  const Surface model = MakeModel();
  const Surface fine = MakeEllipsoid({ 1.0, 1.0, 1.0 }, Faces::Triangles, 80, 59);
  const Surface tube = MakeEllipsoid({ 1.0, 1.0, 1.0 }, Faces::Triangles, 32, 3);
  tube->SetPoints(Mapped(tube,
    [](const Vector& x)
    {
      const double r = std::hypot(x[0], x[1]);
      return r > 0.0 ? Vector{ x[0] / r, x[1] / r, x[2] } : x;
    })->GetPoints());
  std::vector<Cell> sides; // without the caps: all normals are in one plane
  for (const auto& t : TriangleCorners(tube))
  {
    if (std::abs(NormalOf(tube, t)[2]) < 1e-9)
    {
      sides.push_back({ t[0], t[1], t[2] });
    }
  }
  tube->SetPolys(MakeCells(sides));
  const Surface sheet =
    MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, { { 0, 1, 2, 3 } });
  const Surface fold =
    MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 } },
      { { 0, 1, 2, 3 }, { 0, 1, 5, 4 } });
  for (const auto& [name, style, count] :
    { std::tuple<const char*, Surface, int>{ "fine sphere", fine, 0 }, { "tube", tube, 32 },
      { "sheet", sheet, 1 }, { "fold", fold, 2 } })
  {
    check.About(std::string("mesh as style: ") + name);
    Watched<FilterType> filter(model);
    filter->SetStyleToMesh();
    filter->SetStyleMeshData(style);
    filter.Output();
    check(filter.Errors.empty() && AllFinite(filter.Output()->GetPoints()->GetData()), "no error");
    check(count == 0 || filter->GetNumberOfStyleNormals() == count,
      Text(count) + " normals, not " + Text(filter->GetNumberOfStyleNormals()));
    std::vector<Vector> all;
    vtkNew<vtkIdList> ids;
    for (vtkIdType c = 0; c < style->GetNumberOfPolys(); ++c)
    {
      style->GetPolys()->GetCellAtId(c, ids);
      all.push_back(NormalOf(style, { ids->GetId(0), ids->GetId(1), ids->GetId(2) }));
    }
    CheckTargets(check, filter, model, all);
  }

  check.About("a fine sphere as style");
  Watched<FilterType> cube(model);
  Watched<FilterType> sphere(model);
  cube->SetWeight(10.0);
  sphere->SetWeight(10.0);
  sphere->SetStyleToMesh();
  sphere->SetStyleMeshData(fine);
  check.AtMost(LargestDistance(model, sphere.Output()), 0.2 * LargestDistance(model, cube.Output()),
    "what 9,000 normals move, against a cube");
}

void BadStyles(Checker& check)
{
  const auto repair = [](FilterType* self)
  {
    self->SetStyleToCube();
    self->SetStyleMeshConnection(nullptr);
  };
  const auto expect =
    [&](const char* about, const std::vector<std::string>& words, const Surface& style)
  {
    ExpectError<FilterType>(
      check, about, words,
      [style](FilterType* self, vtkPolyData*)
      {
        self->SetStyleToMesh();
        if (style)
        {
          self->SetStyleMeshData(style);
        }
      },
      repair);
  };
  expect("no style mesh", { "StyleMesh", "nothing is connected" }, nullptr);
  expect("an empty style mesh", { "StyleMesh", "no triangle" }, Surface::New());
  const Surface points = MakeModel();
  points->SetPolys(MakeCells({}));
  expect("a style mesh of points", { "StyleMesh", "no triangle" }, points);
  const Surface line = MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } }, { { 0, 1, 2 } });
  expect("a style mesh without an area", { "StyleMesh", "no triangle" }, line);
  const Surface infinite = MakeModel();
  infinite->GetPoints()->SetPoint(5, 0.0, HUGE_VAL, 0.0);
  expect("a style mesh that is not finite", { "StyleMesh", "point 5 " }, infinite);

  check.About("a bad style mesh that is not asked for");
  Watched<FilterType> filter(MakeModel());
  filter->SetStyleMeshData(infinite);
  filter.Output();
  check(filter.Errors.empty(), "Style Cube should not look at it");
}

/// Share of the area whose normal is within 10 degrees of an axis.
double ShareAlongAxes(vtkPolyData* surface)
{
  double along = 0.0;
  double all = 0.0;
  for (const auto& t : TriangleCorners(surface))
  {
    const Vector a = PointOf(surface, t[0]);
    Vector u = PointOf(surface, t[1]);
    Vector v = PointOf(surface, t[2]);
    Vector n;
    vtkMath::Subtract(u.data(), a.data(), u.data());
    vtkMath::Subtract(v.data(), a.data(), v.data());
    vtkMath::Cross(u.data(), v.data(), n.data());
    const double area = vtkMath::Norm(n.data());
    const double largest = std::max({ std::abs(n[0]), std::abs(n[1]), std::abs(n[2]) });
    all += area;
    along += largest >= std::cos(vtkMath::RadiansFromDegrees(10.0)) * area ? area : 0.0;
  }
  return along / all;
}

void Creature(Checker& check, int argc, char* argv[])
{
  check.About("creature");
  const Surface creature = ReadModel(argc, argv, "creature.vtp");
  Watched<FilterType> filter(creature);
  filter->SetWeight(0.0);
  check.AtMost(LargestDistance(creature, filter.Output()), 1e-7 * Diagonal(creature), "0, moved");
  filter->SetWeight(10.0);
  const double before = ShareAlongAxes(creature);
  const double after = ShareAlongAxes(filter.Output());
  std::cout << "creature: share of the area along an axis " << before << ", with weight 10 "
            << after << "\n";
  check(after >= before + 0.3, "clusters should form in the Gauss map");
}
}

int TestNormalAnalogyFilter(int argc, char* argv[])
{
  Checker check;
  Properties(check);
  CheckContract<FilterType>(check,
    { "Style", "Weight", "StopRule", "Tolerance", "MaximumNumberOfIterations",
      "OutputPointsPrecision", "NumberOfThreads", "GenerateNormals", "GenerateTargetNormal",
      "NumberOfStyleNormals", "NumberOfIterations", "Converged", "FinalEnergy" });
  CheckIteration<FilterType>(check, "Analogy");
  Styles(check);
  MeshStyles(check);
  BadStyles(check);
  Creature(check, argc, argv);
  return check.Result();
}
