// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Every kind of input that people have, what cannot be done and says so, and the properties.
#include "ArrayTesting.h"
#include "GaussMapTesting.h"
#include "PropertyTesting.h"

#include "vtkDoubleArray.h"

#include <limits>
#include <sstream>

using namespace FilterTesting;

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
const Vector Axes = { 1.0, 0.8, 2.0 };

/// What holds for every good input.
void CheckSound(Checker& check, WatchedGaussMap& filter, vtkPolyData* input)
{
  vtkNew<vtkPolyData> before;
  before->DeepCopy(input);
  filter->SetInputData(input);
  filter.Output();
  check(filter.Errors.empty(), "no error should be reported");
  check(SamePolyData(before, input), "the input should be unchanged to the bit");
  vtkDataArray* counts = Image(filter.Get())->GetPointData()->GetScalars();
  const auto normals = static_cast<double>(filter->GetNumberOfNormals());
  check(AllFinite(counts) && AllFinite(SphereArray(filter.Get(), "Density")),
    "counts and densities should be finite");
  check.AtMost(std::abs(Sum(counts) - normals), 1e-9 * normals, "sum of the counts minus normals");
}

void KindsOfFaces(Checker& check)
{
  for (const int source : { 0, 1 })
  {
    for (const bool weighted : { false, true })
    {
      check.About("kinds of faces, source " + Text(source) + (weighted ? ", weighted" : ""));
      const auto run = [&](vtkPolyData* input)
      {
        auto filter = std::make_unique<WatchedGaussMap>();
        (*filter)->SetNormalSource(source);
        (*filter)->SetAreaWeighted(weighted);
        CheckSound(check, *filter, input);
        check(filter->Warnings.empty(), "no warning should be given");
        return filter;
      };
      const auto triangles = run(MakeEllipsoid(Axes));
      const auto strips = run(MakeEllipsoid(Axes, Faces::Strips));
      check(triangles->Get()->GetNumberOfNormals() == strips->Get()->GetNumberOfNormals() &&
          triangles->Get()->GetUnitsHit() == strips->Get()->GetUnitsHit() &&
          triangles->Get()->GetEqualAreaUnitsHit() == strips->Get()->GetEqualAreaUnitsHit(),
        "triangles and the same ones in strips");
      const auto quads = run(MakeEllipsoid(Axes, Faces::Quads));
      check(quads->Get()->GetNumberOfNormals() == triangles->Get()->GetNumberOfNormals(),
        "quads are cut in two");

      const Surface more = MakeEllipsoid(Axes);
      more->SetLines(MakeCells({ { 0, 1, 2 } }));
      more->SetVerts(MakeCells({ { 5 } }));
      more->GetPoints()->InsertNextPoint(9.0, 9.0, 9.0);
      AddArrays(more);
      more->GetPointData()->SetActiveNormals(nullptr);
      more->GetFieldData()->Initialize(); // the pipeline itself passes it on
      const auto lines = run(more);
      check(SameMap(lines->Get(), triangles->Get()), "lines and spare points should not count");
      check(lines->Output()->GetPointData()->GetNumberOfArrays() == 1 &&
          lines->Output()->GetCellData()->GetNumberOfArrays() == 2,
        "arrays of the surface mean nothing on the sphere");
    }
  }
}

void Open(Checker& check)
{
  check.About("open surface");
  WatchedGaussMap filter;
  CheckSound(check, filter,
    MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, { { 0, 1, 2, 3 } }));
  check(filter.Warnings.empty(), "no warning should be given");
  check(filter->GetNumberOfNormals() == 2 && filter->GetUnitsHit() == 1, "a square has one normal");
  check(filter->GetEntropy() == 0.0 && filter->GetRelativeEntropy() == 0.0, "no entropy");
  // The north pole is in the last row, at longitude 0.
  check(Image(filter.Get())->GetPointData()->GetScalars()->GetComponent(360 * 179 + 180, 0) == 2.0,
    "it should point up");
}

void Scales(Checker& check)
{
  for (const int source : { 0, 1 })
  {
    WatchedGaussMap unit;
    unit->SetNormalSource(source);
    unit->AreaWeightedOn();
    CheckSound(check, unit, MakeEllipsoid(Axes));
    for (const double scale : { 1e-299, 1e-30, 1e-6, 1e6, 1e30, 1e299 })
    {
      check.About("scale " + vtkVariant(scale).ToString());
      WatchedGaussMap filter;
      filter->SetNormalSource(source);
      filter->AreaWeightedOn();
      CheckSound(
        check, filter, MakeEllipsoid({ scale * Axes[0], scale * Axes[1], scale * Axes[2] }));
      check(filter->GetUnitsHit() == unit->GetUnitsHit(), "the same units should be hit");
      check.AtMost(std::abs(filter->GetEntropy() - unit->GetEntropy()), 1e-9, "change of entropy");
    }
    check.About("single precision, far away");
    WatchedGaussMap filter;
    filter->SetNormalSource(source);
    CheckSound(
      check, filter, WithPointsOf(Shifted(MakeEllipsoid(Axes), { 100, -50, 20 }), VTK_FLOAT));
    check(filter->GetNumberOfNormals() == unit->GetNumberOfNormals(), "all should count");
  }
}

void Degenerate(Checker& check)
{
  for (const int source : { 0, 1 })
  {
    check.About("degenerate triangles, source " + Text(source));
    WatchedGaussMap plain;
    plain->SetNormalSource(source);
    CheckSound(check, plain, MakeEllipsoid(Axes));
    const Surface input = MakeEllipsoid(Axes);
    const vtkIdType first = input->GetNumberOfPolys();
    for (const Cell& cell : { Cell{ 3, 3, 4 }, Cell{ 5, 5, 5 } })
    {
      input->GetPolys()->InsertNextCell(3, cell.data());
    }
    WatchedGaussMap filter;
    filter->SetNormalSource(source);
    CheckSound(check, filter, input);
    check(filter.Warnings.size() == 1 && Contains(filter.Warnings[0], "2 degenerate triangles") &&
        Contains(filter.Warnings[0], "cell " + Text(first)),
      "a warning should count them");
    check(SameMap(filter.Get(), plain.Get()), "they should count nothing");
  }

  check.About("normals of length 0");
  const Surface input = MakeEllipsoid(Axes);
  vtkNew<vtkDoubleArray> normals;
  normals->SetName("n");
  normals->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    normals->InsertNextTuple3(i % 5 == 2 ? 0.0 : 1.0, 0.0, i % 5 == 2 ? -0.0 : 0.01 * i);
  }
  input->GetPointData()->SetNormals(normals);
  for (const bool weighted : { false, true })
  {
    WatchedGaussMap filter;
    filter->SetNormalSourceToPointNormals();
    filter->SetAreaWeighted(weighted);
    CheckSound(check, filter, input);
    const vtkIdType n = input->GetNumberOfPoints();
    check(filter->GetNumberOfNormals() == n - (n + 2) / 5, "they should not count");
    check(filter.Warnings.size() == 1 &&
        Contains(filter.Warnings[0], "skipped " + Text((n + 2) / 5) + " normals of length 0"),
      "a warning should count them");
  }
}

void Nothing(Checker& check)
{
  check.About("empty input");
  for (const Surface& empty : { Surface::New(), MakeSurface({}, {}) })
  {
    WatchedGaussMap filter(MakeEllipsoid(Axes));
    filter.Output(); // there is an old result that must go
    filter->SetInputData(empty);
    filter.Output();
    check(filter.Errors.empty() && filter.Warnings.empty(), "nothing should be said");
    check(filter->GetOutput()->GetNumberOfPoints() == 0, "the sphere should be empty");
    check(Image(filter.Get())->GetNumberOfPoints() == 0, "the image should be empty");
    check(Table(filter.Get())->GetNumberOfRows() == 0, "the table should be empty");
    check(filter->GetNumberOfNormals() == 0 && filter->GetUnitsHit() == 0 &&
        std::isnan(filter->GetEntropy()) && std::isnan(filter->GetDistanceToUniform()),
      "facts should be those of nothing");
  }
  for (const int source : { 0, 1 })
  {
    check.About("no faces, source " + Text(source));
    const Surface input = MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 } }, {});
    input->SetLines(MakeCells({ { 0, 1 } }));
    WatchedGaussMap filter;
    filter->SetNormalSource(source);
    filter->AreaWeightedOn();
    CheckSound(check, filter, input);
    check(filter.Warnings.size() == 1 && Contains(filter.Warnings[0], "no normals"),
      "a warning should say why");
    check(filter->GetOutput()->GetNumberOfCells() == 360 * 180, "a sphere without counts");
    check(Sum(SphereArray(filter.Get(), "Density")) == 0.0, "density should be 0");
    check(std::isnan(filter->GetEntropy()) && std::isnan(filter->GetRelativeEntropy()) &&
        std::isnan(filter->GetKullbackLeiblerDivergence()) &&
        std::isnan(filter->GetDistanceToUniform()),
      "measures should be no numbers");
    check(Table(filter.Get())->GetValueByName(0, "Normals").ToInt() == 0, "a row says so");
  }
}

//------------------------------------------------------------------------------------------------
using Change = std::function<void(vtkGaussMapFilter*, vtkPolyData*)>;

/// One error with all `words`, empty outputs, and then the filter works again.
void ExpectError(Checker& check, const std::string& about, const std::vector<std::string>& words,
  const Change& spoil)
{
  check.About(about);
  const Surface input = MakeEllipsoid(Axes);
  WatchedGaussMap filter(input);
  filter.Output();
  spoil(filter.Get(), input);
  input->Modified();
  filter.Output();
  if (check(filter.Errors.size() == 1, "there should be one error"))
  {
    for (const std::string& word : words)
    {
      check(Contains(filter.Errors[0], word), "\"" + word + "\" should be in " + filter.Errors[0]);
    }
  }
  check(filter->GetOutput()->GetNumberOfPoints() == 0 &&
      Image(filter.Get())->GetNumberOfPoints() == 0 && Table(filter.Get())->GetNumberOfRows() == 0,
    "the outputs should be empty");
  filter.Errors.clear();
  filter->SetOftenThreshold(5.0);
  filter->SetNormalSourceToFaceNormals();
  filter->SetInputData(MakeEllipsoid(Axes));
  WatchedGaussMap fresh(MakeEllipsoid(Axes));
  filter.Output();
  fresh.Output();
  check(filter.Errors.empty() && SameMap(filter.Get(), fresh.Get()), "then it should work again");
}

void Errors(Checker& check)
{
  for (const double bad : { -1.0, NaN, std::numeric_limits<double>::infinity() })
  {
    ExpectError(check, "threshold", { "OftenThreshold", "0 or more" },
      [bad](vtkGaussMapFilter* filter, vtkPolyData*) { filter->SetOftenThreshold(bad); });
    if (bad != -1.0)
    {
      ExpectError(check, "a coordinate", { "point 7 " },
        [bad](vtkGaussMapFilter*, vtkPolyData* input)
        {
          input->GetPoints()->SetPoint(7, 0.0, bad, 0.0);
          input->GetPoints()->Modified();
        });
    }
  }
  ExpectError(check, "a point id", { "cell 3 ", "point 999" },
    [](vtkGaussMapFilter*, vtkPolyData* input)
    {
      const vtkIdType ids[] = { 0, 1, 999 };
      input->GetPolys()->ReplaceCellAtId(3, 3, ids);
    });
  const auto withArray = [](int components, double value)
  {
    return [=](vtkGaussMapFilter* filter, vtkPolyData* input)
    {
      vtkNew<vtkDoubleArray> array;
      array->SetName("mine");
      array->SetNumberOfComponents(components);
      array->SetNumberOfTuples(input->GetNumberOfPoints());
      array->Fill(1.0);
      array->SetComponent(4, 0, value);
      input->GetPointData()->AddArray(array);
      filter->SetNormalSourceToPointNormals();
      filter->SetInputArrayToProcess(0, 0, 0, OfPoints, "mine");
    };
  };
  ExpectError(check, "components", { "Normals", "\"mine\"", "2 components" }, withArray(2, 1.0));
  ExpectError(check, "a value", { "Normals", "\"mine\"", "point 4" }, withArray(3, NaN));
  ExpectError(check, "no such array", { "Normals", "\"absent\"" },
    [](vtkGaussMapFilter* filter, vtkPolyData*)
    {
      filter->SetNormalSourceToPointNormals();
      filter->SetInputArrayToProcess(0, 0, 0, OfPoints, "absent");
    });

  check.About("an array that is not asked for");
  WatchedGaussMap faces(MakeEllipsoid(Axes));
  faces->SetInputArrayToProcess(0, 0, 0, OfPoints, "absent");
  faces.Output();
  check(faces.Errors.empty(), "it should not matter");
}

void Properties(Checker& check)
{
  WatchedGaussMap filter;
  check.About("properties");
  using FilterType = vtkGaussMapFilter;
  RoundTrip(NormalSource, 0, 1);
  OnOff(AreaWeighted, false);
  RoundTrip(OftenThreshold, 5.0, 3.0);
  RoundTrip(NumberOfEqualAreaUnits, 1000, 50);
  RoundTrip(SphereUnits, 0, 1);
  Clamped(NormalSource, 2, 1);
  Clamped(NumberOfEqualAreaUnits, 1, 10);
  Clamped(NumberOfEqualAreaUnits, 1000000, 100000);
  Clamped(SphereUnits, 2, 1);
  Mode(NormalSource, FaceNormals, FACE_NORMALS, 0);
  Mode(NormalSource, PointNormals, POINT_NORMALS, 1);
  Mode(SphereUnits, EqualAngle, EQUAL_ANGLE, 0);
  Mode(SphereUnits, EqualArea, EQUAL_AREA, 1);
  std::ostringstream printed;
  filter->Print(printed);
  for (const char* name :
    { "NormalSource", "AreaWeighted", "OftenThreshold", "NumberOfEqualAreaUnits", "SphereUnits",
      "NumberOfNormals", "UnitsHit", "UnitsHitOften", "EqualAreaUnitsHit", "EqualAreaUnitsHitOften",
      "Entropy", "RelativeEntropy", "KullbackLeiblerDivergence", "DistanceToUniform" })
  {
    check(Contains(printed.str(), std::string(" ") + name + ": "),
      std::string("PrintSelf should print ") + name);
  }
}
}

int TestGaussMapFilterInputs(int, char*[])
{
  Checker check;
  KindsOfFaces(check);
  Open(check);
  Scales(check);
  Degenerate(check);
  Nothing(check);
  Errors(check);
  Properties(check);
  return check.Result();
}
