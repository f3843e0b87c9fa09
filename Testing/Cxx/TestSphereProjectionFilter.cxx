// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// vtkSphereProjectionFilter: the contract, its properties, and the closed form (A4.37).
#include "ComparatorTesting.h"
#include "PropertyTesting.h"

#include "vtkMassProperties.h"
#include "vtkSphereProjectionFilter.h"

using namespace FilterTesting;

namespace
{
using FilterType = vtkSphereProjectionFilter;

void Properties(Checker& check)
{
  check.About("properties");
  vtkNew<FilterType> filter;
  RoundTrip(Coefficient, 0.5, 1.0);
  RoundTrip(CenterMode, 0, 2);
  RoundTrip(RadiusMode, 0, 3);
  RoundTrip(Radius, 1.0, 4.0);
  RoundTrip(OutputPointsPrecision, 2, 0);
  OnOff(GenerateNormals, false);
  Mode(CenterMode, PointMean, POINT_MEAN, 0);
  Mode(CenterMode, AreaCentroid, AREA_CENTROID, 1);
  Mode(CenterMode, Custom, CUSTOM_CENTER, 2);
  Mode(RadiusMode, Outer, OUTER, 0);
  Mode(RadiusMode, EqualArea, EQUAL_AREA, 1);
  Mode(RadiusMode, EqualVolume, EQUAL_VOLUME, 2);
  Mode(RadiusMode, Custom, CUSTOM_RADIUS, 3);
  Clamped(Coefficient, -0.1, 0.0);
  Clamped(Coefficient, 1.1, 1.0);
  const auto repair = [](FilterType* self)
  {
    self->SetCoefficient(0.5);
    self->SetCenterModeToPointMean();
    self->SetRadiusModeToOuter();
  };
  for (const double bad : { 0.0, -1.0, NaN, HUGE_VAL })
  {
    ExpectError<FilterType>(
      check, "Radius " + vtkVariant(bad).ToString(), { "Radius" },
      [bad](FilterType* self, vtkPolyData*)
      {
        self->SetRadiusModeToCustom();
        self->SetRadius(bad);
      },
      repair);
  }
  ExpectError<FilterType>(
    check, "Center", { "Center" },
    [](FilterType* self, vtkPolyData*)
    {
      self->SetCenterModeToCustom();
      self->SetCenter(0.0, NaN, 0.0);
    },
    repair);
  const auto loose = [](vtkPolyData* input) { input->SetPolys(MakeCells({})); };
  ExpectError<FilterType>(
    check, "area of points", { "RadiusMode", "no triangle" },
    [&](FilterType* self, vtkPolyData* input)
    {
      self->SetRadiusModeToEqualArea();
      loose(input);
    },
    repair);
  ExpectError<FilterType>(
    check, "centroid of points", { "CenterMode", "no triangle" },
    [&](FilterType* self, vtkPolyData* input)
    {
      self->SetCenterModeToAreaCentroid();
      loose(input);
    },
    repair);
  ExpectError<FilterType>(
    check, "volume of a sheet", { "EqualVolume" },
    [](FilterType* self, vtkPolyData* input)
    {
      self->SetRadiusModeToEqualVolume();
      input->DeepCopy(
        MakeSurface({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, { { 0, 1, 2, 3 } }));
    },
    repair);
}

/// p' = (1 - s) p + s (O + r (p - O) / |p - O|), to 1e-12 of the diagonal.
void CheckFormula(
  Checker& check, vtkPolyData* input, vtkPolyData* output, const Vector& O, double r, double s)
{
  const double size = Diagonal(input);
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    const Vector p = PointOf(input, i);
    const double distance = Distance(p, O);
    Vector expected;
    for (int k = 0; k < 3; ++k)
    {
      expected[k] = (1.0 - s) * p[k] + s * (O[k] + r * (p[k] - O[k]) / distance);
    }
    check.AtMost(Distance(expected, PointOf(output, i)), 1e-12 * size, "point " + Text(i));
  }
}

void ClosedForm(Checker& check)
{
  const Surface model = MakeModel();
  const vtkIdType n = model->GetNumberOfPoints();
  const Vector mean = MeanPoint(model, 0, n);
  const Vector custom = { 0.3, -0.1, 0.6 };
  double outer = 0.0;
  for (vtkIdType i = 0; i < n; ++i)
  {
    outer = std::max(outer, Distance(PointOf(model, i), mean));
  }
  vtkNew<vtkMassProperties> mass;
  mass->SetInputData(model);
  mass->Update();
  const double ofArea = std::sqrt(mass->GetSurfaceArea() / (4.0 * vtkMath::Pi()));
  const double ofVolume = std::cbrt(3.0 * mass->GetVolume() / (4.0 * vtkMath::Pi()));
  const double radii[] = { outer, ofArea, ofVolume, 3.0 };
  // VTK's volume is exact for closed surfaces up to its own sums.
  const double tolerances[] = { 1e-14, 1e-12, 1e-6, 0.0 };
  for (int mode = 0; mode < 4; ++mode)
  {
    for (const double s : { 0.0, 0.25, 0.5, 1.0 })
    {
      check.About("RadiusMode " + Text(mode) + ", Coefficient " + vtkVariant(s).ToString());
      Watched<FilterType> filter(model);
      filter->SetRadiusMode(mode);
      filter->SetRadius(3.0);
      filter->SetCoefficient(s);
      vtkPolyData* output = filter.Output();
      const double* center = filter->GetEffectiveCenter();
      check.AtMost(Distance({ center[0], center[1], center[2] }, mean), 1e-14, "center");
      check.AtMost(std::abs(filter->GetEffectiveRadius() / radii[mode] - 1.0), tolerances[mode],
        "radius, relative");
      CheckFormula(check, model, output, mean, filter->GetEffectiveRadius(), s);
      check(s > 0.0 || SamePoints(model, output), "0 should be the model to the last bit");
    }
  }
  check.About("Custom center");
  Watched<FilterType> filter(model);
  filter->SetCenterModeToCustom();
  filter->SetCenter(custom.data());
  filter->SetCoefficient(1.0);
  vtkPolyData* output = filter.Output();
  CheckFormula(check, model, output, custom, filter->GetEffectiveRadius(), 1.0);
  check.About("center of area");
  filter->SetCenterModeToAreaCentroid();
  filter.Output();
  check(Distance(mean,
          { filter->GetEffectiveCenter()[0], filter->GetEffectiveCenter()[1],
            filter->GetEffectiveCenter()[2] }) > 0.01,
    "it should be another point than the mean");
}

void AllPoints(Checker& check)
{
  check.About("points of no face");
  const Surface model = MakeModel();
  const vtkIdType alone = model->GetPoints()->InsertNextPoint(0.0, 0.0, 9.0);
  Watched<FilterType> filter(model);
  filter->SetCoefficient(1.0);
  vtkPolyData* output = filter.Output();
  const double* O = filter->GetEffectiveCenter();
  check.AtMost(
    std::abs(
      Distance({ O[0], O[1], O[2] }, PointOf(output, alone)) / filter->GetEffectiveRadius() - 1.0),
    1e-14, "they go to the sphere, too");
  model->SetPolys(MakeCells({}));
  Watched<FilterType> cloud(model);
  cloud->SetCoefficient(1.0);
  check(SamePoints(cloud.Output(), output) && cloud.Errors.empty() && cloud.Warnings.empty(),
    "a cloud of points should do as well");

  check.About("a point on the center");
  const Surface star = MakeModel();
  const vtkIdType middle = star->GetPoints()->InsertNextPoint(0.1, 0.2, 0.3);
  Watched<FilterType> custom(star);
  custom->SetCenterModeToCustom();
  custom->SetCenter(0.1, 0.2, 0.3);
  check(SamePoint(custom.Output(), middle, star, middle), "it should stay");
  check(custom.Warnings.size() == 1 && Contains(custom.Warnings[0], "1 point ") &&
      Contains(custom.Warnings[0], "point " + Text(middle)),
    "with a warning that counts it");

  check.About("coordinates of 1e299");
  Watched<FilterType> huge(Mapped(MakeModel(),
    [](const Vector& x) {
      return Vector{ 1e299 * x[0], 1e299 * x[1], 1e299 * x[2] };
    }));
  huge->SetCenterModeToAreaCentroid();
  check(huge.Output()->GetNumberOfPoints() == 0 && huge.Errors.size() == 1 &&
      Contains(huge.Errors[0], "the center of the surface is not finite"),
    "areas have no number there" + Joined(huge.Errors));

  check.About("all points at one place");
  const Surface same = MakeSurface({ { 1, 2, 3 }, { 1, 2, 3 }, { 1, 2, 3 } }, { { 0, 1, 2 } });
  Watched<FilterType> still(same);
  check(SamePoints(still.Output(), same) && still.Errors.empty() && still.Warnings.size() == 1,
    "they should stay, with a warning");
}
}

int TestSphereProjectionFilter(int, char*[])
{
  Checker check;
  Properties(check);
  CheckContract<FilterType>(check,
    { "Coefficient", "CenterMode", "Center", "RadiusMode", "Radius", "OutputPointsPrecision",
      "GenerateNormals", "EffectiveCenter", "EffectiveRadius" });
  ClosedForm(check);
  AllPoints(check);
  return check.Result();
}
