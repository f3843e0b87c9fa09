// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Every kind of input that people have: what comes out, and that the input stays as it was.
#include "ConvexProxyTesting.h"
#include "PropertyTesting.h"

#include "vtkInformation.h"

#include <sstream>
#include <tuple>

using namespace FilterTesting;

namespace
{
const Vector LongAxes = { 1.0, 0.8, 2.0 };

/// Tolerance for equal results of calculations that differ in rounding only, of the diagonal.
constexpr double Rounding = 1e-9;

using Setup = std::function<void(vtkConvexProxyDeformFilter*)>;

/// What holds for every good input. @return the output
vtkPolyData* CheckSound(Checker& check, WatchedProxyFilter& filter, vtkPolyData* input)
{
  vtkNew<vtkPolyData> before;
  before->DeepCopy(input);
  filter->SetInputData(input);
  filter->GenerateProjectionArraysOn();
  vtkPolyData* output = filter.Output();
  const vtkIdType n = input->GetNumberOfPoints();
  check(filter.Errors.empty(), "no error should be reported" + Joined(filter.Errors));
  check(SamePolyData(before, input), "the input should be unchanged to the bit");
  check(SameCells(input, output), "cells should come out as they went in");
  if (!check(output->GetNumberOfPoints() == n, "no point should come or go") || n == 0)
  {
    return output;
  }
  check(AllFinite(output->GetPoints()->GetData()), "points should be finite");
  for (const char* name : { "t", "Displacement", "ProxyCell", "Barycentric" })
  {
    vtkDataArray* array = PointArray(output, name);
    check(array && array->GetNumberOfTuples() == n && AllFinite(array),
      std::string(name) + " should be there and finite");
  }
  check(LargestGap(input, output) == 0.0, "coincident points should stay together");
  vtkPolyData* proxy = filter.Output(1);
  check(proxy->GetNumberOfPoints() == filter->GetEffectiveNumberOfProxyPoints() &&
      proxy->GetNumberOfPoints() >= 3 && AllFinite(proxy->GetPoints()->GetData()),
    "output 1 should be the proxy");
  vtkPolyData* lines = filter.Output(2);
  check(lines->GetNumberOfLines() == n && lines->GetNumberOfPoints() == 2 * n &&
      AllFinite(lines->GetPoints()->GetData()),
    "output 2 should be a line per point");
  return output;
}

/// CheckSound of an input that gives no reason for a warning, with all projections.
Surface CheckQuiet(
  Checker& check, vtkPolyData* input, const Setup& setup = [](auto*) {})
{
  for (const int projection : { 1, 2, 0 })
  {
    WatchedProxyFilter filter;
    filter->SetProjection(projection);
    setup(filter.Get());
    vtkPolyData* output = CheckSound(check, filter, input);
    check(filter.Warnings.empty(), "no warning should be given" + Joined(filter.Warnings));
    if (projection == 0)
    {
      return output;
    }
  }
  return nullptr;
}

/// Moves towards the rounded proxy: rounder with less t.
void CheckRounder(Checker& check, vtkPolyData* input)
{
  double spread = RadiusSpread(input);
  for (const double t : { 0.8, 0.5, 0.2, 0.0 })
  {
    WatchedProxyFilter filter;
    filter->SetBlend(t);
    const double now = RadiusSpread(CheckSound(check, filter, input));
    check(now < spread, "less t should be rounder");
    spread = now;
  }
}

//------------------------------------------------------------------------------------------------
void KindsOfFaces(Checker& check)
{
  Surface results[3];
  for (const auto faces : { Faces::Triangles, Faces::Quads, Faces::Strips })
  {
    const int k = static_cast<int>(faces);
    check.About("faces of kind " + Text(k));
    const Surface input = MakeEllipsoid(LongAxes, faces);
    results[k] = CheckQuiet(check, input);
    CheckRounder(check, input);
    // The closest point does not know of cells.
    check(SamePoints(results[0], results[k]), "the kind of faces should not matter");
  }

  check.About("polygons");
  const Surface polygons = MakeSurface({ { 0, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 1, 1, 0 },
                                         { 1, 3, 0 }, { 0, 3, 0 }, { 0.5, 0.5, 1.5 } },
    { { 0, 1, 2, 3, 4, 5 }, { 0, 6, 1 }, { 1, 6, 2 }, { 2, 6, 3, 4 }, { 5, 6, 0 } });
  CheckQuiet(check, polygons);
  check.About("polygons that cross themselves");
  CheckQuiet(check,
    MakeSurface({ { 0, 0, 0 }, { 2, 1, 0 }, { 2, 0, 0 }, { 0, 1, 0 }, { 1, 3, 1 }, { -1, 2, 1 } },
      { { 0, 1, 2, 3 }, { 3, 1, 4 }, { 0, 1, 2, 4, 3, 5 } }),
    [](auto* filter) { filter->SetBlend(0.9); });
}

/// Every point takes part, whatever uses it.
void PointsWithoutFaces(Checker& check)
{
  const Surface faces = MakeEllipsoid(LongAxes);
  check.About("points of no cell");
  const Surface cloud = MakeEllipsoid(LongAxes);
  cloud->SetPolys(MakeCells({}));
  const Surface expected = CheckQuiet(check, faces);
  check(SamePoints(CheckQuiet(check, cloud), expected), "faces should not matter");
  check.About("lines and vertices");
  cloud->SetLines(MakeCells({ { 0, 1, 2, 3 }, { 7, 90 } }));
  cloud->SetVerts(MakeCells({ { 5 }, { 9, 11 } }));
  check(SamePoints(CheckQuiet(check, cloud), expected), "lines should not matter");
  check.About("faces, lines, strips and vertices together");
  const Surface mixed = MakeEllipsoid(LongAxes, Faces::Strips);
  mixed->SetLines(MakeCells({ { 0, 1, 2, 3 }, { 7, 90 } }));
  mixed->SetVerts(MakeCells({ { 5 }, { 9, 11 } }));
  check(SamePoints(CheckQuiet(check, mixed), expected), "cells should not matter");
}

void Pieces(Checker& check)
{
  check.About("open shell");
  Surface open = MakeEllipsoid(LongAxes);
  std::vector<Cell> half;
  for (const auto& t : TriangleCorners(open))
  {
    if (PointOf(open, t[0])[2] > 0.1)
    {
      half.push_back({ t[0], t[1], t[2] });
    }
  }
  open->SetPolys(MakeCells(half));
  CheckQuiet(check, open);

  check.About("several parts");
  const Surface parts = Together(
    { MakeEllipsoid(LongAxes), Shifted(MakeEllipsoid({ 0.4, 0.4, 0.4 }), { 1.0, 0.0, 0.0 }),
      Shifted(MakeEllipsoid({ 0.3, 0.4, 0.2 }), { 0.0, 1.0, 1.0 }) });
  CheckQuiet(check, parts, [](auto* filter) { filter->SetBlend(0.95); });

  check.About("non-manifold");
  const Surface fin = MakeEllipsoid(LongAxes);
  const vtkIdType tip = fin->GetPoints()->InsertNextPoint(0.1, 0.0, -2.1);
  const Cell edge = { 0, 1, tip };
  fin->GetPolys()->InsertNextCell(3, edge.data());
  fin->GetPolys()->InsertNextCell(3, edge.data());
  CheckQuiet(check, fin);

  check.About("degenerate triangles");
  const Surface bad = MakeEllipsoid(LongAxes);
  const vtkIdType n = bad->GetNumberOfPoints();
  bad->GetPoints()->InsertNextPoint(bad->GetPoint(7));
  for (const Cell& cell : { Cell{ 3, 3, 4 }, Cell{ 7, n, 8 }, Cell{ 5, 5, 5 } })
  {
    bad->GetPolys()->InsertNextCell(3, cell.data());
  }
  const Surface result = CheckQuiet(check, bad);
  check(SamePoint(result, 7, result, n), "the copy of point 7 should stay on it");
}

/// Every triangle with corners of its own: a crack along each edge.
Surface Exploded(vtkPolyData* surface)
{
  std::vector<Vector> points;
  std::vector<Cell> polygons;
  for (const auto& t : TriangleCorners(surface))
  {
    const auto first = static_cast<vtkIdType>(points.size());
    for (const vtkIdType i : t)
    {
      points.push_back(PointOf(surface, i));
    }
    polygons.push_back({ first, first + 1, first + 2 });
  }
  return MakeSurface(points, polygons);
}

void Cracks(Checker& check)
{
  const Surface input = Exploded(MakeEllipsoid(LongAxes));
  const std::vector<Cell> groups = CoincidentPoints(input);
  check(groups.size() == 146, "the test should have cracks");
  // Arrays that differ between the points of a group.
  input->GetPointData()->AddArray(
    MakeArray("normals", input, 3, [](vtkIdType i, int k) { return std::sin(1.0 * i + 2.0 * k); }));
  input->GetPointData()->AddArray(
    MakeArray("t", input, 1, [](vtkIdType i, int) { return (i % 11) / 10.0; }));
  input->GetPointData()->AddArray(
    MakeArray("t3", input, 3, [](vtkIdType i, int k) { return ((i + 3 * k) % 11) / 10.0; }));
  input->GetPointData()->AddArray(
    MakeArray("region", input, 1, [](vtkIdType i, int) { return i % 7 == 0 ? 0.0 : 1.0; }));
  for (const int projection : { 0, 1, 2, 3 })
  {
    for (const char* t : { "t", "t3", "" })
    {
      for (const bool region : { false, true })
      {
        for (const int transfer : { 0, 1 })
        {
          check.About("cracks, projection " + Text(projection) + ", t array \"" + t +
            "\", region " + Text(region) + ", transfer " + Text(transfer));
          WatchedProxyFilter filter;
          filter->SetProjection(projection);
          filter->SetTransfer(transfer);
          filter->SetInputArrayToProcess(NormalsArray, 0, 0, OfPoints, "normals");
          filter->SetInputArrayToProcess(DirectionsArray, 0, 0, OfPoints, "normals");
          if (*t)
          {
            filter->SetBlendFunctionToArray();
            filter->SetInputArrayToProcess(BlendArray, 0, 0, OfPoints, t);
          }
          if (region)
          {
            filter->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "region");
          }
          CheckSound(check, filter, input); // looks for gaps
        }
      }
    }
  }

  check.About("a selection of some of the points at one place");
  std::vector<vtkIdType> ids;
  for (std::size_t g = 0; g < groups.size(); g += 2)
  {
    ids.push_back(groups[g].back());
  }
  WatchedProxyFilter filter;
  filter->SetBorderWidth(0.0);
  filter->SetBlend(0.0);
  filter->SetSelectionData(MakeSelection(ids, vtkSelectionNode::POINT));
  vtkPolyData* output = CheckSound(check, filter, input);
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    for (const vtkIdType i : groups[g])
    {
      check(SamePoint(input, i, output, i) == (g % 2 == 1),
        "point " + Text(i) + " should move with a selected one at its place");
    }
  }

  check.About("cracks close up");
  const Surface closed = MakeEllipsoid(LongAxes);
  const Surface whole = CheckQuiet(check, closed);
  WatchedProxyFilter cracked;
  vtkPolyData* same = CheckSound(check, cracked, input);
  vtkIdType at = 0;
  for (const auto& t : TriangleCorners(closed))
  {
    for (const vtkIdType i : t)
    {
      check.AtMost(Distance(PointOf(same, at++), PointOf(whole, i)), Rounding * Diagonal(closed),
        "difference of a cracked model");
    }
  }
}

void Few(Checker& check)
{
  check.About("no points");
  for (const Surface& empty : { Surface::New(), MakeSurface({}, {}) })
  {
    WatchedProxyFilter filter;
    CheckSound(check, filter, empty);
    check(filter.Warnings.empty(), "no warning should be given");
    check(filter.Output(1)->GetNumberOfPoints() == 0 && filter.Output(2)->GetNumberOfPoints() == 0,
      "all outputs should be empty");
  }
  // One and two points, equal and collinear ones are errors: see there.

  check.About("four points");
  CheckQuiet(check, MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }, {}));
  check.About("facts after an execution without points");
  WatchedProxyFilter filter(MakeEllipsoid(LongAxes));
  filter.Output();
  check(filter->GetEffectiveNumberOfProxyPoints() > 0 && filter->GetEffectiveRadius() > 0.0,
    "there should be some");
  filter->SetInputData(Surface::New());
  filter.Output();
  check(filter->GetEffectiveNumberOfProxyPoints() == 0 && filter->GetEffectiveProxyMesher() == -1 &&
      filter->GetEffectiveRadius() == 0.0,
    "they should be of the last execution");
}

void Planar(Checker& check)
{
  const Surface ellipsoid = MakeEllipsoid(LongAxes);
  std::vector<std::pair<const char*, Surface>> models;
  models.emplace_back("flattened",
    Mapped(ellipsoid,
      [](const Vector& x) {
        return Vector{ x[2], 2.5, x[0] };
      }));
  models.emplace_back("flattened and turned",
    Mapped(ellipsoid,
      [](const Vector& x) {
        return Vector{ x[2], x[0], 0.3 * x[2] - 0.7 * x[0] };
      }));
  models.emplace_back("a grid, turned, in single precision",
    Mapped(
      ellipsoid,
      [](const Vector& x)
      {
        const double u = std::round(3 * x[2]);
        const double v = std::round(3 * x[0]);
        return Vector{ 0.8 * u - 0.6 * v, 0.6 * u + 0.8 * v, 0.3 * u + 0.2 * v };
      },
      VTK_FLOAT));
  models.emplace_back("three points", MakeSurface({ { 0, 0, 0 }, { 3, 0, 0 }, { 0, 1, 1 } }, {}));
  for (const auto& model : models)
  {
    for (const int radius : { 0, 1 })
    {
      for (const double blend : { 0.5, 0.0 })
      {
        check.About(std::string("planar, ") + model.first + ", radius mode " + Text(radius));
        WatchedProxyFilter filter;
        filter->SetRadiusMode(radius);
        filter->SetBlend(blend);
        vtkPolyData* output = CheckSound(check, filter, model.second);
        check(!filter.Warnings.empty() && Contains(filter.Warnings[0], "plane"),
          "the first warning should tell of the plane" + Joined(filter.Warnings));
        // The plane by its largest triangle of three corners among the points.
        vtkPolyData* in = model.second;
        const Vector a = PointOf(in, 0);
        Vector n = { 0.0, 0.0, 0.0 };
        for (vtkIdType i = 1; i < in->GetNumberOfPoints(); ++i)
        {
          for (vtkIdType k = 1; k < i; ++k)
          {
            Vector u;
            Vector v;
            Vector w;
            vtkMath::Subtract(PointOf(in, i), a, u);
            vtkMath::Subtract(PointOf(in, k), a, v);
            vtkMath::Cross(u.data(), v.data(), w.data());
            n = vtkMath::Norm(w.data()) > vtkMath::Norm(n.data()) ? w : n;
          }
        }
        vtkMath::Normalize(n.data());
        double off = 0.0;
        for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
        {
          Vector d;
          vtkMath::Subtract(PointOf(output, i), a, d);
          off = std::max(off, std::abs(vtkMath::Dot(d, n)));
        }
        check.AtMost(off,
          (in->GetPoints()->GetDataType() == VTK_FLOAT ? 2e-6 : 1e-12) * Diagonal(in),
          "way out of the plane");
      }
    }
  }
}

void NumberTypes(Checker& check)
{
  const Surface single = MakeEllipsoid(LongAxes, Faces::Triangles, 16, 9, VTK_FLOAT);
  const Surface twice = WithPointsOf(single, VTK_DOUBLE);
  check.About("number type of the points");
  const Surface exact = CheckQuiet(check, twice);
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
    WatchedProxyFilter filter;
    filter->SetOutputPointsPrecision(c.precision);
    vtkPolyData* output = CheckSound(check, filter, c.input);
    check(output->GetPoints()->GetDataType() == c.type &&
        PointArray(output, "Displacement")->GetDataType() == c.type,
      "precision " + Text(c.precision) + " should give type " + Text(c.type));
    check(SamePoints(output, c.type == VTK_FLOAT ? rounded : exact),
      "everything inside should be double whatever the types");
    check(filter.Output(1)->GetPoints()->GetDataType() == VTK_DOUBLE, "the proxy is double");
  }
  const auto coarse = [](const Vector& x) {
    return Vector{ std::round(100 * x[0]), std::round(100 * x[1]), std::round(100 * x[2]) };
  };
  for (const int type : { VTK_INT, VTK_SHORT, VTK_LONG_LONG })
  {
    check.About("whole-numbered points of type " + Text(type));
    WatchedProxyFilter filter;
    vtkPolyData* output = CheckSound(check, filter, Mapped(single, coarse, type));
    const int result = output->GetPoints()->GetDataType();
    check(result == VTK_FLOAT || result == VTK_DOUBLE, "moved points are not whole numbers");
    WatchedProxyFilter same(Mapped(single, coarse));
    check.AtMost(
      LargestDistance(output, same.Output()), 1e-6 * Diagonal(output), "effect of the type");
  }
}

void Scales(Checker& check)
{
  const Surface model = MakeDented();
  // Nowhere as far from one side as from the other: equals could go either way.
  const Surface proxy = Shifted(MakeEllipsoid({ 1.3, 1.1, 2.4 }), { 0.013, 0.027, 0.041 });
  const auto scaled = [](double by) {
    return [by](const Vector& x) { return Vector{ by * x[0], by * x[1], by * x[2] }; };
  };
  for (const double scale : { 1e-100, 1e-30, 1e-6, 1e6, 1e30, 1e100 })
  {
    check.About("scale " + vtkVariant(scale).ToString());
    const Surface input = Mapped(model, scaled(scale));
    CheckQuiet(check, input);
    for (const int projection : { 0, 1, 2 })
    {
      if (projection == 2 && std::abs(std::log10(scale)) > 50.0)
      {
        continue; // squares of areas leave the range of numbers
      }
      const auto setup = [&](WatchedProxyFilter& filter, double by)
      {
        filter->SetProjection(projection);
        filter->SetProxyData(Mapped(proxy, scaled(by)));
        filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
      };
      WatchedProxyFilter filter;
      setup(filter, scale);
      WatchedProxyFilter plain(model);
      setup(plain, 1.0);
      vtkPolyData* output = CheckSound(check, filter, input);
      check(filter.Warnings.empty(), "no warning should be given" + Joined(filter.Warnings));
      check.AtMost(LargestDistance(Mapped(output, scaled(1.0 / scale)), plain.Output()),
        Rounding * Diagonal(model),
        "own proxy, projection " + Text(projection) + ": difference to scale 1");
    }
  }
  for (const double scale : { 1e-30, 1e30 })
  {
    check.About("scale " + vtkVariant(scale).ToString() + ", single precision");
    CheckQuiet(check, Mapped(model, scaled(scale), VTK_FLOAT));
  }

  check.About("1e6 from the origin");
  const Surface far = Shifted(model, { 1e6, -1e6, 1e6 });
  CheckQuiet(check, far);
  CheckRounder(check, far);
  check.About("1e6 from the origin, points that fall together in single precision");
  WatchedProxyFilter filter;
  CheckSound(check, filter, WithPointsOf(far, VTK_FLOAT));
}

//------------------------------------------------------------------------------------------------
void OwnProxies(Checker& check)
{
  const Surface input = MakeDented();
  const Surface closed = MakeEllipsoid({ 1.3, 1.1, 2.4 });
  const auto with = [&](const std::string& about, const Surface& proxy, vtkIdType points)
  {
    check.About("own proxy, " + about);
    vtkNew<vtkPolyData> before;
    before->DeepCopy(proxy);
    for (const int projection : { 0, 1, 2 })
    {
      WatchedProxyFilter filter;
      filter->SetProxyData(proxy);
      filter->SetProjection(projection);
      filter->SetBlend(0.9);
      CheckSound(check, filter, input);
      check(filter->GetEffectiveProxyMesher() == -1 && std::isnan(filter->GetConvexityRatio()),
        "the facts should be those of an own proxy");
      check(filter.Output(1)->GetNumberOfPoints() == points,
        "the proxy should have its " + Text(points) + " points, has " +
          Text(filter.Output(1)->GetNumberOfPoints()));
      check(SamePolyData(before, proxy), "it should be unchanged to the bit");
    }
  };
  const vtkIdType n = closed->GetNumberOfPoints();
  with("closed", closed, n);
  with("quads", MakeEllipsoid({ 1.3, 1.1, 2.4 }, Faces::Quads), n);
  with("strips", MakeEllipsoid({ 1.3, 1.1, 2.4 }, Faces::Strips), n);
  with("cracked", Exploded(closed), n);
  with("single precision", WithPointsOf(closed, VTK_FLOAT), n);
  with("flat",
    MakeSurface({ { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } }, { { 0, 1, 2, 3 } }), 4);
  with("one triangle", MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 } }), 3);
  with("two parts", Together({ closed, Shifted(closed, { 5, 0, 0 }) }), 2 * n);
  with("not convex",
    Together({ MakeEllipsoid({ 0.3, 0.3, 2.0 }), MakeEllipsoid({ 2.0, 0.3, 0.3 }) }), 2 * n);
  Surface open = MakeEllipsoid({ 1.3, 1.1, 2.4 });
  std::vector<Cell> cells;
  for (const auto& t : TriangleCorners(open))
  {
    if (PointOf(open, t[0])[2] >= 0.0 && PointOf(open, t[1])[2] >= 0.0 &&
      PointOf(open, t[2])[2] >= 0.0)
    {
      cells.push_back({ t[0], t[1], t[2] });
    }
  }
  open->SetPolys(MakeCells(cells));
  with("open, with points to spare", open, 16 * 4 + 1);
  Surface degenerate = MakeEllipsoid({ 1.3, 1.1, 2.4 });
  for (const Cell& cell : { Cell{ 3, 3, 4 }, Cell{ 5, 5, 5 } })
  {
    degenerate->GetPolys()->InsertNextCell(3, cell.data());
  }
  degenerate->SetLines(MakeCells({ { 0, 1, 2 } }));
  with("with degenerate triangles and lines", degenerate, n);
}

std::vector<vtkIdType> MovedPoints(vtkPolyData* input, vtkPolyData* output)
{
  std::vector<vtkIdType> moved;
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    if (!SamePoint(input, i, output, i))
    {
      moved.push_back(i);
    }
  }
  return moved;
}

void Regions(Checker& check)
{
  const Surface input = MakeDented();
  const vtkIdType n = input->GetNumberOfPoints();
  const auto moved = [&](
                       vtkSelection* selection, const Setup& setup = [](auto*) {})
  {
    WatchedProxyFilter filter;
    filter->SetBlend(0.0);
    filter->SetBorderWidth(0.0);
    if (selection)
    {
      filter->SetSelectionData(selection);
    }
    setup(filter.Get());
    vtkPolyData* output = CheckSound(check, filter, input);
    // A step in t folds triangles; nothing else should be told.
    check(filter.Warnings.empty() ||
        (filter.Warnings.size() == 1 && Contains(filter.Warnings[0], "turned over")),
      "no other warning should be given" + Joined(filter.Warnings));
    for (vtkIdType i = 0; i < n; ++i)
    {
      const double t = PointArray(output, "t")->GetComponent(i, 0);
      check((t == 1.0) == SamePoint(input, i, output, i),
        "t of point " + Text(i) + " should be 1 where it stays");
    }
    return MovedPoints(input, output);
  };
  const std::vector<vtkIdType> some = { 0, 3, 20, 21, 64, n - 1 };
  check.About("selection of points");
  check(moved(MakeSelection(some, vtkSelectionNode::POINT)) == some, "these should move");
  check.About("empty selections");
  check(moved(vtkSmartPointer<vtkSelection>::New()).empty(), "without nodes nothing should move");
  check(
    moved(MakeSelection({}, vtkSelectionNode::POINT)).empty(), "without ids nothing should move");
  check(
    moved(MakeSelection({}, vtkSelectionNode::CELL)).empty(), "without ids nothing should move");
  check.About("ids out of range");
  check(moved(MakeSelection({ 3, n, n + 5, 1LL << 40 }, vtkSelectionNode::POINT)) ==
      std::vector<vtkIdType>{ 3 },
    "they should not matter");
  check(moved(MakeSelection({ -1, 3, -7 }, vtkSelectionNode::POINT)) == std::vector<vtkIdType>{ 3 },
    "negative ones should not matter");
  check(moved(MakeSelection({ -1, 100000 }, vtkSelectionNode::CELL)).empty(), "nor those of cells");

  check.About("selection of cells");
  std::vector<vtkIdType> corners;
  const auto triangles = TriangleCorners(input);
  for (const vtkIdType cell : { 2, 3, 70 })
  {
    for (const vtkIdType i : triangles[cell])
    {
      corners.push_back(i);
    }
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  check(moved(MakeSelection({ 2, 3, 70 }, vtkSelectionNode::CELL)) == corners,
    "their points should move");

  check.About("selection of all but some");
  const auto inverse = MakeSelection(some, vtkSelectionNode::POINT);
  inverse->GetNode(0)->GetProperties()->Set(vtkSelectionNode::INVERSE(), 1);
  check(moved(inverse).size() == static_cast<std::size_t>(n) - some.size(), "the others move");

  check.About("two nodes");
  const auto both = MakeSelection({ 3, 4 }, vtkSelectionNode::POINT);
  both->AddNode(MakeSelection({ 4, 9 }, vtkSelectionNode::POINT)->GetNode(0));
  check(moved(both) == std::vector<vtkIdType>{ 3, 4, 9 }, "one of them is enough");

  check.About("selection by value");
  vtkNew<vtkDoubleArray> range;
  range->SetName("height");
  range->SetNumberOfComponents(2);
  range->InsertNextTuple2(0.5, 9.0);
  input->GetPointData()->AddArray(
    MakeArray("height", input, 1, [&](vtkIdType i, int) { return PointOf(input, i)[2]; }));
  const auto thresholds = MakeSelection({}, vtkSelectionNode::POINT, vtkSelectionNode::THRESHOLDS);
  thresholds->GetNode(0)->SetSelectionList(range);
  std::vector<vtkIdType> high;
  for (vtkIdType i = 0; i < n; ++i)
  {
    if (PointOf(input, i)[2] > 0.5)
    {
      high.push_back(i);
    }
  }
  check(moved(thresholds) == high, "points in the range should move");

  check.About("region array");
  for (const double inside : { 1.0, -3.0, 0.001 })
  {
    input->GetPointData()->AddArray(MakeArray("region", input, 1,
      [&](vtkIdType i, int)
      { return std::binary_search(high.begin(), high.end(), i) ? inside : 0.0; }));
    const Setup byArray = [](vtkConvexProxyDeformFilter* filter)
    { filter->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "region"); };
    check(moved(nullptr, byArray) == high, "points where it is not 0 should move");
    std::vector<vtkIdType> expected;
    for (const vtkIdType i : some)
    {
      if (std::binary_search(high.begin(), high.end(), i))
      {
        expected.push_back(i);
      }
    }
    check(moved(MakeSelection(some, vtkSelectionNode::POINT), byArray) == expected,
      "with a selection, points should be in both");
  }
  check.About("\"None\" as region array");
  check(
    moved(nullptr,
      [](vtkConvexProxyDeformFilter* filter) {
        filter->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "None");
      }).size() == static_cast<std::size_t>(n),
    "then all points should move");

  check.About("t well inside");
  for (const double blend : { 0.1, 0.3, 1e-20, 0.999 })
  {
    WatchedProxyFilter step;
    step->SetBlend(blend);
    step->SetBorderWidth(0.0);
    step->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "region");
    vtkDataArray* t = PointArray(CheckSound(check, step, input), "t");
    for (vtkIdType i = 0; i < n; ++i)
    {
      const bool inside = std::binary_search(high.begin(), high.end(), i);
      check(t->GetComponent(i, 0) == (inside ? blend : 1.0), "t should be Blend inside, 1 outside");
    }
  }

  check.About("border");
  WatchedProxyFilter filter;
  filter->SetBlend(0.0);
  filter->SetBorderWidth(0.2);
  filter->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "region");
  vtkPolyData* output = CheckSound(check, filter, input);
  const double width = 0.2 * Diagonal(input);
  int between = 0;
  for (vtkIdType i = 0; i < n; ++i)
  {
    double nearest = 1e9;
    for (vtkIdType k = 0; k < n; ++k)
    {
      if (!std::binary_search(high.begin(), high.end(), k))
      {
        nearest = std::min(nearest, Distance(PointOf(input, i), PointOf(input, k)));
      }
    }
    const double x = std::min(1.0, nearest / width);
    const double t = PointArray(output, "t")->GetComponent(i, 0);
    check.AtMost(std::abs(t - (1.0 - x * x * x * (x * (6.0 * x - 15.0) + 10.0))), 1e-12,
      "difference of t of point " + Text(i) + " to the formula");
    between += t > 0.0 && t < 1.0;
  }
  check(between > 10, "the test should have a border");
}

void CellStorage(Checker& check)
{
  check.About("ids of 32 and 64 bits");
  const Surface narrow = MakeEllipsoid(LongAxes);
  const Surface wide = MakeEllipsoid(LongAxes);
  narrow->GetPolys()->ConvertTo32BitStorage();
  wide->GetPolys()->ConvertTo64BitStorage();
  const Surface a = CheckQuiet(check, narrow);
  const Surface b = CheckQuiet(check, wide);
  check(SamePoints(a, b), "the result should have the same bits");
  check(!a->GetPolys()->IsStorage64Bit() && b->GetPolys()->IsStorage64Bit(),
    "the storage should be that of the input");
}

void Meshers(Checker& check, vtkPolyData* car)
{
  for (const int mesher : { 0, 1, 2, 3 })
  {
    for (const int points : { 4, 50, 1000 })
    {
      check.About("car, mesher " + Text(mesher) + ", points " + Text(points));
      WatchedProxyFilter filter;
      filter->SetProxyMesher(mesher);
      filter->SetNumberOfProxyPoints(points);
      CheckSound(check, filter, car);
      const int effective = filter->GetEffectiveProxyMesher();
      check(effective == mesher ||
          (effective == 0 && filter.Warnings.size() == 1 &&
            Contains(filter.Warnings[0], "IsotropicRemeshing")),
        "another mesher should be told of" + Joined(filter.Warnings));
    }
  }
}

/// Panels get points of their own before all else, where there are many; seams stay shut.
void LongEdges(Checker& check)
{
  const Surface coarse = MakeEllipsoid({ 1.0, 0.8, 2.0 }, Faces::Triangles, 8, 5);
  const Surface fine = MakeEllipsoid({ 1.0, 0.8, 2.0 }, Faces::Triangles, 24, 23);
  for (const auto& [name, input, isCoarse] :
    { std::tuple("coarse", coarse, true), std::tuple("fine", fine, false) })
  {
    check.About(std::string("long edges, ") + name);
    const vtkIdType n = input->GetNumberOfPoints();
    WatchedProxyFilter filter(input);
    const Surface off = Surface::New();
    off->DeepCopy(filter.Output());
    check(off->GetNumberOfPoints() == n && SameCells(off, input), "Off should split nothing");
    filter->SetRefineLongEdgesToAutomatic();
    vtkPolyData* output = filter.Output();
    check(filter.Errors.empty(), "no error expected" + Joined(filter.Errors));
    vtkDataArray* isNew = PointArray(output, "RefinedPoint");
    check(isCoarse ? output->GetNumberOfPoints() > n : SamePolyData(output, off),
      "Automatic should split what is coarse only");
    check(
      (isNew != nullptr) == isCoarse && output->GetCellData()->HasArray("OriginalCell") == isCoarse,
      "RefinedPoint and OriginalCell should be there where it has split");
    for (vtkIdType i = 0; isNew && i < isNew->GetNumberOfTuples(); ++i)
    {
      check(isNew->GetComponent(i, 0) == (i < n ? 0.0 : 1.0), "RefinedPoint of " + Text(i));
    }
    check(AllFinite(output->GetPoints()->GetData()), "points should be finite");
    filter->SetRefineLongEdgesToOn();
    check(filter.Output()->GetNumberOfPoints() > n, "On should split");
    filter->SetRefineLongEdgesToOff();
    check(SamePolyData(filter.Output(), off), "off again it should be as at first");
  }
}

void Properties(Checker& check)
{
  Watched<vtkConvexProxyDeformFilter> filter;
  check.About("properties");
  using FilterType = vtkConvexProxyDeformFilter;
  RoundTrip(ProxyMesher, 0, 3);
  RoundTrip(NumberOfProxyPoints, 5000, 100);
  RoundTrip(Seed, 0, 17);
  RoundTrip(Roundness, 5.0, 3.0);
  RoundTrip(CenterMode, 1, 2);
  RoundTrip(RadiusMode, 0, 2);
  RoundTrip(Radius, 1.0, 7.0);
  RoundTrip(HullOf, 1, 0);
  RoundTrip(SphericalWeighting, 1, 0);
  RoundTrip(Projection, 0, 3);
  RoundTrip(NumberOfNeighbors, 4, 9);
  RoundTrip(BlendFunction, 0, 5);
  RoundTrip(Blend, 0.5, 0.25);
  RoundTrip(BlendAtStart, 0.0, 0.25);
  RoundTrip(BlendAtEnd, 1.0, 0.25);
  RoundTrip(TanhSteepness, 3.0, 1.0);
  RoundTrip(BorderWidth, 0.2, 0.0);
  RoundTrip(Transfer, 0, 1);
  RoundTrip(RefineLongEdges, 1, 2);
  RoundTrip(OutputPointsPrecision, vtkAlgorithm::DEFAULT_PRECISION, vtkAlgorithm::DOUBLE_PRECISION);
  RoundTrip(NumberOfThreads, 0, 2);
  OnOff(GenerateNormals, false);
  OnOff(GenerateProjectionArrays, false);

  Clamped(ProxyMesher, 4, 3);
  Clamped(NumberOfProxyPoints, 3, 4);
  Clamped(NumberOfProxyPoints, 2000000, 1000000);
  Clamped(Seed, -1, 0);
  Clamped(Projection, 4, 3);
  Clamped(NumberOfNeighbors, 0, 1);
  Clamped(NumberOfNeighbors, 101, 100);
  Clamped(BlendFunction, 6, 5);
  Clamped(Blend, -0.5, 0.0);
  Clamped(Blend, 1.5, 1.0);
  Clamped(BlendAtStart, 1.5, 1.0);
  Clamped(BlendAtEnd, -0.5, 0.0);
  Clamped(BorderWidth, 2.0, 1.0);
  Clamped(Transfer, 2, 1);
  Clamped(NumberOfThreads, -1, 0);

  Mode(ProxyMesher, IsotropicRemeshing, ISOTROPIC_REMESHING, 0);
  Mode(ProxyMesher, BallPivoting, BALL_PIVOTING, 1);
  Mode(ProxyMesher, AdvancingFront, ADVANCING_FRONT, 2);
  Mode(ProxyMesher, SubdividedHull, SUBDIVIDED_HULL, 3);
  Mode(HullOf, WholeModel, WHOLE_MODEL, 0);
  Mode(HullOf, Region, REGION, 1);
  Mode(SphericalWeighting, Uniform, UNIFORM, 0);
  Mode(SphericalWeighting, Cotangent, COTANGENT, 1);
  Mode(CenterMode, PointMean, POINT_MEAN, 0);
  Mode(CenterMode, AreaCentroid, AREA_CENTROID, 1);
  Mode(CenterMode, Custom, CUSTOM_CENTER, 2);
  Mode(RadiusMode, EqualArea, EQUAL_AREA, 0);
  Mode(RadiusMode, EqualVolume, EQUAL_VOLUME, 1);
  Mode(RadiusMode, Custom, CUSTOM_RADIUS, 2);
  Mode(Projection, ClosestPoint, CLOSEST_POINT, 0);
  Mode(Projection, NearestVertices, NEAREST_VERTICES, 1);
  Mode(Projection, SmallestAngle, SMALLEST_ANGLE, 2);
  Mode(Projection, DirectionArray, DIRECTION_ARRAY, 3);
  Mode(BlendFunction, Constant, CONSTANT, 0);
  Mode(BlendFunction, Linear, LINEAR, 1);
  Mode(BlendFunction, Quadratic, QUADRATIC, 2);
  Mode(BlendFunction, Tanh, TANH, 3);
  Mode(BlendFunction, Smoothstep, SMOOTHSTEP, 4);
  Mode(BlendFunction, Array, ARRAY, 5);
  Mode(Transfer, Blend, BLEND, 0);
  Mode(Transfer, Offset, OFFSET, 1);
  Mode(RefineLongEdges, Off, NEVER, 0);
  Mode(RefineLongEdges, Automatic, WHERE_COARSE, 1);
  Mode(RefineLongEdges, On, ALWAYS, 2);

  const auto is = [&](const double* x, const Vector& expected, const char* name)
  {
    check(x[0] == expected[0] && x[1] == expected[1] && x[2] == expected[2],
      std::string(name) + " should start as its default");
  };
  is(filter->GetCenter(), { 0, 0, 0 }, "Center");
  is(filter->GetBlendAxis(), { 0, 1, 0 }, "BlendAxis");
  is(filter->GetAxisGain(), { 1, 1, 1 }, "AxisGain");
  check(filter->GetBlendRange()[0] == 0.0 && filter->GetBlendRange()[1] == 1.0,
    "BlendRange should start as its default");

  std::ostringstream printed;
  filter->Print(printed);
  for (const char* name : { "ProxyMesher", "HullOf", "SphericalWeighting", "NumberOfProxyPoints",
         "Seed", "Roundness", "CenterMode", "Center", "RadiusMode", "Radius", "Projection",
         "NumberOfNeighbors", "BlendFunction", "Blend", "BlendAxis", "BlendRange", "BlendAtStart",
         "BlendAtEnd", "TanhSteepness", "AxisGain", "BorderWidth", "Transfer", "RefineLongEdges",
         "OutputPointsPrecision", "NumberOfThreads", "GenerateNormals", "GenerateProjectionArrays",
         "EffectiveNumberOfProxyPoints", "EffectiveProxyMesher", "ConvexityRatio",
         "TrianglesTurnedOver", "ProjectionCaseCounts", "ProjectionError", "EffectiveCenter",
         "EffectiveRadius" })
  {
    check(Contains(printed.str(), std::string(" ") + name + ": "),
      std::string("PrintSelf should print ") + name);
  }
}
}

int TestConvexProxyDeformFilterInputs(int argc, char* argv[])
{
  const Surface car = ReadModel(argc, argv, "car.vtp");
  Checker check;
  KindsOfFaces(check);
  PointsWithoutFaces(check);
  Pieces(check);
  Cracks(check);
  Few(check);
  Planar(check);
  NumberTypes(check);
  Scales(check);
  OwnProxies(check);
  Regions(check);
  CellStorage(check);
  Meshers(check, car);
  LongEdges(check);
  Properties(check);
  return check.Result();
}
