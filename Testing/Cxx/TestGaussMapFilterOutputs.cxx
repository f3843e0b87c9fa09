// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// The three outputs of vtkGaussMapFilter against counting by hand and against each other.
#include "GaussMapTesting.h"

#include "vtkDoubleArray.h"
#include "vtkFeatureEdges.h"
#include "vtkFloatArray.h"

using namespace FilterTesting;

namespace
{
Surface MakeTurned()
{
  return Mapped(MakeEllipsoid({ 1.0, 0.7, 1.6 }, Faces::Triangles, 40, 31),
    [](const Vector& x) {
      return Vector{ x[0] + 0.3 * x[1] - 0.1, x[1] - 0.2 * x[2], x[2] + 0.25 * x[0] + 5.0 };
    });
}

/// Area vector of a triangle.
Vector AreaVector(vtkPolyData* surface, const std::array<vtkIdType, 3>& t)
{
  const Vector a = PointOf(surface, t[0]);
  const Vector b = PointOf(surface, t[1]);
  const Vector c = PointOf(surface, t[2]);
  Vector u, v, n;
  vtkMath::Subtract(b.data(), a.data(), u.data());
  vtkMath::Subtract(c.data(), a.data(), v.data());
  vtkMath::Cross(u.data(), v.data(), n.data());
  vtkMath::MultiplyScalar(n.data(), 0.5);
  return n;
}

void CountsOfFaces(Checker& check)
{
  const Surface input = MakeTurned();
  const auto triangles = TriangleCorners(input);
  double totalArea = 0.0;
  for (const auto& t : triangles)
  {
    totalArea += vtkMath::Norm(AreaVector(input, t).data());
  }
  for (const bool weighted : { false, true })
  {
    check.About(weighted ? "areas of faces" : "faces");
    std::vector<double> expected(360 * 180, 0.0);
    for (const auto& t : triangles)
    {
      const Vector n = AreaVector(input, t);
      expected[UnitOf(n)] += weighted
        ? vtkMath::Norm(n.data()) * static_cast<double>(triangles.size()) / totalArea
        : 1.0;
    }
    WatchedGaussMap filter(input);
    filter->SetAreaWeighted(weighted);
    filter->SetOftenThreshold(1.0);
    filter.Output();
    check(filter.Errors.empty() && filter.Warnings.empty(), "nothing should be said");
    vtkDataArray* counts = Image(filter.Get())->GetPointData()->GetArray("Count");
    double largest = 0.0;
    int hit = 0;
    int often = 0;
    for (vtkIdType i = 0; i < 360 * 180; ++i)
    {
      largest = std::max(largest, std::abs(counts->GetComponent(i, 0) - expected[i]));
      hit += expected[i] > 0.0;
      often += expected[i] > 1.0;
    }
    check.AtMost(largest, 1e-11, "difference of a count");
    check(hit > 500 && often > 10, "the test should have units with and without");
    check(filter->GetNumberOfNormals() == static_cast<int>(triangles.size()), "one per triangle");
    check(filter->GetUnitsHit() == hit, "UnitsHit should be " + Text(hit));
    check(filter->GetUnitsHitOften() == often, "UnitsHitOften should be " + Text(often));
    check.AtMost(std::abs(Sum(counts) - static_cast<double>(triangles.size())), 1e-9,
      "sum of the counts minus normals");
  }
}

void CountsOfPoints(Checker& check)
{
  const Surface input = MakeTurned();
  const vtkIdType n = input->GetNumberOfPoints();
  vtkNew<vtkDoubleArray> normals; // not those of the surface
  normals->SetName("own");
  normals->SetNumberOfComponents(3);
  std::vector<double> expected(360 * 180, 0.0);
  for (vtkIdType i = 0; i < n; ++i)
  {
    const Vector x = { std::sin(3.0 * i), std::cos(5.0 * i), 0.1 + std::sin(7.0 * i) };
    normals->InsertNextTuple(x.data());
    expected[UnitOf(x)] += 1.0;
  }
  const auto compare = [&](WatchedGaussMap& filter)
  {
    filter->SetNormalSourceToPointNormals();
    filter.Output();
    check(filter.Errors.empty() && filter.Warnings.empty(), "nothing should be said");
    check(filter->GetNumberOfNormals() == n, "one per point");
    vtkDataArray* counts = Image(filter.Get())->GetPointData()->GetArray("Count");
    bool same = true;
    for (vtkIdType i = 0; i < 360 * 180; ++i)
    {
      same = same && counts->GetComponent(i, 0) == expected[i];
    }
    check(same, "each should be counted in its unit");
  };
  check.About("active normals");
  input->GetPointData()->SetNormals(normals);
  WatchedGaussMap active(input);
  compare(active);

  check.About("named normals");
  const Surface other = MakeTurned();
  other->GetPointData()->AddArray(normals);
  WatchedGaussMap named(other);
  named->SetInputArrayToProcess(0, 0, 0, OfPoints, "own");
  compare(named);

  check.About("None as array");
  named->SetInputArrayToProcess(0, 0, 0, OfPoints, "None");
  other->GetPointData()->SetNormals(normals);
  compare(named);
}

/// Unit cube around the origin, its faces with points of their own or with shared ones.
Surface MakeCube(bool shared)
{
  std::vector<Vector> points;
  std::vector<Cell> polygons;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double side : { -1.0, 1.0 })
    {
      Cell polygon;
      for (int k = 0; k < 4; ++k)
      {
        Vector x;
        x[axis] = side;
        x[(axis + 1) % 3] = (k == 0 || k == 3 ? -1.0 : 1.0) * side;
        x[(axis + 2) % 3] = k < 2 ? -1.0 : 1.0;
        const auto found = shared ? std::find(points.begin(), points.end(), x) : points.end();
        polygon.push_back(found - points.begin());
        if (found == points.end())
        {
          points.push_back(x);
        }
      }
      polygons.push_back(polygon);
    }
  }
  return MakeSurface(points, polygons);
}

/// Faces of a cube: six units of two triangles each. Points: eight corners, also where they are
/// split; with normals of its faces, six units again.
void Cube(Checker& check)
{
  for (const bool shared : { false, true })
  {
    check.About(shared ? "cube" : "cube with split points");
    const Surface cube = MakeCube(shared);
    check(cube->GetNumberOfPoints() == (shared ? 8 : 24), "the test's own points");
    WatchedGaussMap filter(cube);
    filter->SetOftenThreshold(1.5);
    filter.Output();
    check(filter->GetNumberOfNormals() == 12, "two triangles a face");
    check(filter->GetUnitsHit() == 6 && filter->GetUnitsHitOften() == 6, "six units, twice each");
    check(filter->GetEqualAreaUnitsHit() == 6 && filter->GetEqualAreaUnitsHitOften() == 0,
      "six of the larger ones, but not often for their size");
    check.AtMost(std::abs(filter->GetEntropy() - std::log(6.0)), 1e-12, "entropy minus ln 6");
    check.AtMost(
      std::abs(filter->GetDistanceToUniform() - 0.994), 1e-12, "distance minus 1 - 6/1000");
    filter->SetNormalSourceToPointNormals();
    filter.Output();
    check(filter->GetNumberOfNormals() == 8 && filter->GetUnitsHit() == 8, "eight corners");
    vtkDataArray* counts = Image(filter.Get())->GetPointData()->GetScalars();
    for (int k = 0; k < 8; ++k)
    {
      const Vector corner = { k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0 };
      check(counts->GetComponent(UnitOf(corner), 0) == 1.0, "corner " + Text(k));
    }
    filter->AreaWeightedOn();
    filter.Output();
    counts = Image(filter.Get())->GetPointData()->GetScalars();
    check.AtMost(std::abs(Sum(counts) - 8.0), 1e-12, "sum of the counts minus corners");
  }
  check.About("cube with normals of its faces");
  const Surface cube = MakeCube(false);
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < 24; ++i)
  {
    Vector n = { 0.0, 0.0, 0.0 };
    n[i / 8] = i % 8 < 4 ? -3.0 : 3.0; // of any length
    normals->InsertNextTuple(n.data());
  }
  cube->GetPointData()->SetNormals(normals);
  WatchedGaussMap filter(cube);
  filter->SetNormalSourceToPointNormals();
  filter->SetOftenThreshold(3.0);
  filter.Output();
  check(filter->GetNumberOfNormals() == 24 && filter->GetUnitsHit() == 6 &&
      filter->GetUnitsHitOften() == 6,
    "six units of four points");
}

void Spheres(Checker& check)
{
  const Surface input = MakeTurned();
  for (const int kind : { 0, 1 })
  {
    for (const int number : { 10, 1000, 4321 })
    {
      for (const bool weighted : { false, true })
      {
        check.About("sphere " + Text(kind) + ", " + Text(number) + " equal-area units");
        WatchedGaussMap filter(input);
        filter->SetSphereUnits(kind);
        filter->SetNumberOfEqualAreaUnits(number);
        filter->SetAreaWeighted(weighted);
        vtkPolyData* sphere = filter.Output();
        const vtkIdType units = kind == 0 ? 360 * 180 : number;
        check(sphere->GetNumberOfCells() == units, "one cell per unit");
        check(sphere->GetCellData()->GetNumberOfArrays() == 2, "two arrays");
        check(sphere->GetCellData()->GetScalars() == SphereArray(filter.Get(), "Density"),
          "Density should be what it is colored by");
        double farthest = 0.0;
        for (vtkIdType i = 0; i < sphere->GetNumberOfPoints(); ++i)
        {
          farthest = std::max(farthest, std::abs(Distance(PointOf(sphere, i), {}) - 1.0));
          check(TupleOf(sphere->GetPointData()->GetNormals(), i) == PointOf(sphere, i),
            "the normals should be those of the sphere");
        }
        check.AtMost(farthest, 1e-7, "distance of a point from the unit sphere");
        vtkNew<vtkFeatureEdges> edges;
        edges->SetInputData(sphere);
        edges->FeatureEdgesOff();
        edges->Update();
        check(edges->GetOutput()->GetNumberOfCells() == 0, "it should be closed");

        vtkDataArray* count = SphereArray(filter.Get(), "Count");
        vtkDataArray* density = SphereArray(filter.Get(), "Density");
        const auto normals = static_cast<double>(filter->GetNumberOfNormals());
        check.AtMost(std::abs(Sum(count) - normals), 1e-9, "sum of the counts minus normals");
        double integral = 0.0;
        double entropy = 0.0;
        double distance = 0.0;
        for (vtkIdType i = 0; i < units; ++i)
        {
          const vtkIdType row = i / 360;
          const double low = vtkMath::RadiansFromDegrees(static_cast<double>(row) - 90.0);
          const double solidAngle = kind == 0
            ? vtkMath::Pi() / 180.0 * (std::sin(low + vtkMath::Pi() / 180.0) - std::sin(low))
            : 4.0 * vtkMath::Pi() / static_cast<double>(number);
          integral += density->GetComponent(i, 0) * solidAngle;
          const double p = count->GetComponent(i, 0) / normals;
          check(
            std::abs(p * 4.0 * vtkMath::Pi() - density->GetComponent(i, 0) * solidAngle) < 1e-12,
            "density of unit " + Text(i));
          entropy -= p > 0.0 ? p * std::log(p) : 0.0;
          distance += 0.5 * std::abs(p - 1.0 / static_cast<double>(number));
        }
        check.AtMost(std::abs(integral - 4.0 * vtkMath::Pi()), 1e-9, "integral minus 4 pi");
        if (kind == 1)
        {
          const double largest = std::log(static_cast<double>(number));
          check.AtMost(std::abs(filter->GetEntropy() - entropy), 1e-10, "entropy");
          check.AtMost(
            std::abs(filter->GetRelativeEntropy() - entropy / largest), 1e-11, "relative entropy");
          check.AtMost(std::abs(filter->GetKullbackLeiblerDivergence() - (largest - entropy)),
            1e-10, "divergence");
          check.AtMost(std::abs(filter->GetDistanceToUniform() - distance), 1e-11, "distance");
          int often = 0;
          for (vtkIdType i = 0; i < units; ++i)
          {
            often += count->GetComponent(i, 0) > 5.0 * 64800.0 / static_cast<double>(number);
          }
          check(filter->GetEqualAreaUnitsHitOften() == often, "hit often for their size");
        }
        else
        {
          check(SameArray(count, Image(filter.Get())->GetPointData()->GetArray("Count")),
            "the image should have the same counts");
        }
      }
    }
  }
}

/// Cell i of the sphere is where the normals are that it counts.
void Places(Checker& check)
{
  check.About("places");
  for (const int kind : { 0, 1 })
  {
    for (int i = 0; i < 40; ++i)
    {
      const Vector n = { std::sin(3.0 * i + 1.0), std::cos(5.0 * i), std::sin(7.0 * i + 0.5) };
      Vector u, v;
      vtkMath::Perpendiculars(n.data(), u.data(), v.data(), 0.3);
      WatchedGaussMap filter(MakeSurface({ { 0, 0, 0 }, u, v }, { { 0, 1, 2 } }));
      filter->SetSphereUnits(kind);
      vtkPolyData* sphere = filter.Output();
      vtkIdType hit = -1;
      vtkDataArray* count = SphereArray(filter.Get(), "Count");
      for (vtkIdType c = 0; c < count->GetNumberOfTuples(); ++c)
      {
        hit = count->GetComponent(c, 0) > 0.0 ? c : hit;
      }
      vtkNew<vtkIdList> corners;
      sphere->GetCellPoints(hit, corners);
      Vector middle = { 0.0, 0.0, 0.0 };
      for (const vtkIdType id : *corners)
      {
        const Vector x = PointOf(sphere, id);
        vtkMath::Add(middle.data(), x.data(), middle.data());
      }
      const double angle =
        vtkMath::DegreesFromRadians(vtkMath::AngleBetweenVectors(middle.data(), n.data()));
      check.AtMost(angle, kind == 0 ? 0.75 : 5.0, "degrees from a normal to its unit's middle");

      // The pixel under the normal.
      vtkImageData* image = Image(filter.Get());
      double pixel[3] = { vtkMath::DegreesFromRadians(std::atan2(n[1], n[0])),
        vtkMath::DegreesFromRadians(std::asin(n[2] / vtkMath::Norm(n.data()))), 0.0 };
      const vtkIdType nearest = image->FindPoint(pixel);
      check(image->GetPointData()->GetScalars()->GetComponent(nearest, 0) == 1.0,
        "the image should have it at its longitude and latitude");
    }
  }
}

void ImageAndTable(Checker& check)
{
  check.About("image");
  WatchedGaussMap filter(MakeTurned());
  filter.Output();
  vtkImageData* image = Image(filter.Get());
  check(image->GetDimensions()[0] == 360 && image->GetDimensions()[1] == 180 &&
      image->GetDimensions()[2] == 1,
    "360 x 180 values");
  check(image->GetOrigin()[0] == -179.5 && image->GetOrigin()[1] == -89.5 &&
      image->GetSpacing()[0] == 1.0 && image->GetSpacing()[1] == 1.0,
    "in degrees, the middle of each unit");
  check(image->GetPointData()->GetScalars() == image->GetPointData()->GetArray("Count"),
    "Count should be active");

  check.About("table");
  vtkTable* table = Table(filter.Get());
  const auto normals = static_cast<double>(filter->GetNumberOfNormals());
  const std::vector<std::pair<std::string, double>> expected = { { "Normals", normals },
    { "UnitsHit", filter->GetUnitsHit() }, { "UnitsHitOften", filter->GetUnitsHitOften() },
    { "EqualAreaUnits", filter->GetNumberOfEqualAreaUnits() },
    { "EqualAreaUnitsHit", filter->GetEqualAreaUnitsHit() },
    { "EqualAreaUnitsHitOften", filter->GetEqualAreaUnitsHitOften() },
    { "Entropy", filter->GetEntropy() }, { "RelativeEntropy", filter->GetRelativeEntropy() },
    { "KullbackLeiblerDivergence", filter->GetKullbackLeiblerDivergence() },
    { "DistanceToUniform", filter->GetDistanceToUniform() } };
  check(table->GetNumberOfRows() == 1, "one row");
  if (check(table->GetNumberOfColumns() == static_cast<vtkIdType>(expected.size()), "ten columns"))
  {
    for (vtkIdType k = 0; k < table->GetNumberOfColumns(); ++k)
    {
      check(table->GetColumn(k)->GetName() == expected[k].first, expected[k].first);
      check(table->GetValue(0, k).ToDouble() == expected[k].second,
        expected[k].first + " should be that of the filter");
    }
  }
}

/// The more even, the rounder: distance to uniform falls from cube to ellipsoid to sphere, and with
/// finer spheres.
void Order(Checker& check)
{
  check.About("order");
  const auto distance = [](const Vector& axes, vtkIdType n)
  {
    WatchedGaussMap filter(MakeEllipsoid(axes, Faces::Triangles, 2 * n, n - 1));
    filter->AreaWeightedOn();
    filter->SetNumberOfEqualAreaUnits(200);
    filter.Output();
    return filter->GetDistanceToUniform();
  };
  const double coarse = distance({ 1, 1, 1 }, 50);
  const double fine = distance({ 1, 1, 1 }, 200);
  const double oblong = distance({ 1, 1, 1.5 }, 200);
  const double flat = distance({ 1, 1, 0.2 }, 200);
  check.AtMost(fine, 0.02, "distance of a fine sphere");
  check(fine < coarse && coarse < oblong && oblong < flat,
    "fine sphere, coarse sphere, egg and disc should be in this order");
}
}

int TestGaussMapFilterOutputs(int, char*[])
{
  Checker check;
  CountsOfFaces(check);
  CountsOfPoints(check);
  Cube(check);
  Spheres(check);
  Places(check);
  ImageAndTable(check);
  Order(check);
  return check.Result();
}
