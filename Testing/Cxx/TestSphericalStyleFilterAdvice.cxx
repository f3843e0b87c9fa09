// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// What the filter says of its result: the warning of thinned parts, and the advice, which comes in
/// every execution, in method and table alike, and changes nothing.
#include "ArrayTesting.h"

#include "vtkCubeSource.h"
#include "vtkDoubleArray.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <sstream>

using namespace FilterTesting;

namespace
{
/// The wall between two spheres of radius 1 and .9, behind `loose` points of no face.
Surface MakeHollowBall(vtkIdType loose)
{
  const Surface outer = MakeEllipsoid({ 1.0, 1.0, 1.0 });
  const Surface inner = MakeEllipsoid({ 0.9, 0.9, -0.9 }); // turned, so facing inward
  const Surface ball = Together({ outer, inner });
  std::vector<Vector> points(loose, { 5.0, 5.0, 5.0 });
  for (vtkIdType i = 0; i < ball->GetNumberOfPoints(); ++i)
  {
    points.push_back(PointOf(ball, i));
  }
  std::vector<Cell> polygons;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < ball->GetNumberOfPolys(); ++c)
  {
    ball->GetPolys()->GetCellAtId(c, ids);
    polygons.push_back({ ids->GetId(0) + loose, ids->GetId(1) + loose, ids->GetId(2) + loose });
  }
  return MakeSurface(points, polygons);
}

void Thinned(Checker& check)
{
  for (const vtkIdType loose : { 0, 3 })
  {
    check.About("a wall behind " + Text(loose) + " points");
    WatchedEnergy filter(MakeHollowBall(loose));
    filter.Output();
    check(filter.Warnings.empty(), "a little roundness should leave it thick enough");
    filter->SetRoundness(10.0);
    filter.Output();
    if (check(filter.Warnings.size() == 1, "there should be one warning"))
    {
      for (const std::string& part :
        std::vector<std::string>{ "less than a tenth of the thickness is left at 292 points",
          "of 292 looked at", "the first is point " + Text(loose) + ";" })
      {
        check(Contains(filter.Warnings[0], part),
          "the warning should say \"" + part + "\" and says " + filter.Warnings[0]);
      }
    }
    filter.Warnings.clear();
    filter->SetInputData(MakeEllipsoid({ 1.0, 0.8, 2.0 })); // nothing kept of the old mesh
    filter.Output();
    check(filter.Warnings.empty(), "a body has no wall to lose");
    filter->SetInputData(MakeHollowBall(loose));
    filter->SetRoundness(5.0);
    filter.Output();
    check(filter.Warnings.empty(), "a tenth is left");
    filter->SetDetailSize(0.03);
    filter.Output();
    check(filter.Warnings.empty(), "stitches and details should hold two sheets apart");
  }
}

/// With details nothing is looked at, for walls are held together: so look at it here.
void WallsStay(Checker& check)
{
  for (const double size : { 0.03, 0.06 })
  {
    for (const double roundness : { 1.0, 10.0 })
    {
      check.About("a wall with DetailSize " + vtkVariant(size).ToString() + ", Roundness " +
        vtkVariant(roundness).ToString());
      const Surface ball = MakeHollowBall(0);
      WatchedDefaults filter(ball);
      filter->SetDetailSize(size);
      filter->SetRoundness(roundness);
      vtkPolyData* output = filter.Output();
      check(filter.Warnings.empty(), "there should be no warning");
      const vtkIdType half = ball->GetNumberOfPoints() / 2;
      double least = HUGE_VAL;
      for (vtkIdType i = 0; i < half; ++i) // its z is mirrored: the other pole is first
      {
        const Vector p = PointOf(ball, i);
        for (vtkIdType j = half; j < 2 * half; ++j)
        {
          if (Distance(p, PointOf(ball, j)) < 0.1001)
          {
            least = std::min(least, Distance(PointOf(output, i), PointOf(output, j)) / 0.1);
          }
        }
      }
      check(least < HUGE_VAL, "the test should have pairs of points");
      check.AtMost(-least, -0.1, "minus the least share of the thickness");
    }
  }
}

/// Those of a ball that point along its axis only are off by more than 60 degrees where |z| is less
/// than half the radius: at the 20 rings in the middle of 60, which stand for the zone from 60.5 to
/// 119.5 degrees, cos 60.5 = 49 % of the area.
void NormalsThatDoNotFit(Checker& check)
{
  const Surface ball = MakeEllipsoid({ 1.0, 1.0, 1.0 }, Faces::Triangles, 60, 60);
  const auto expect = [&](const char* about, double side, bool axis, double detailSize,
                        double normalBlend, bool warns)
  {
    check.About(about);
    vtkNew<vtkDoubleArray> normals;
    normals->SetName("Given");
    normals->SetNumberOfComponents(3);
    for (vtkIdType i = 0; i < ball->GetNumberOfPoints(); ++i)
    {
      const Vector p = PointOf(ball, i);
      axis ? normals->InsertNextTuple3(0.0, 0.0, p[2] < 0.0 ? -side : side)
           : normals->InsertNextTuple3(side * p[0], side * p[1], side * p[2]);
    }
    ball->GetPointData()->SetNormals(normals);
    WatchedFilter filter(ball);
    filter->SetDetailSize(detailSize);
    filter->SetNormalBlend(normalBlend);
    filter.Output();
    check(filter.Warnings.size() == (warns ? 1 : 0), "there should be a warning, or none");
    for (const char* part : { "on 49 % of the area", "the first at point ", "DetailSize above 0",
           "Generate Surface Normals" })
    {
      check(!warns || filter.Warnings.empty() || Contains(filter.Warnings[0], part),
        std::string("it should say ") + part + ": " + (warns ? filter.Warnings[0] : ""));
    }
    filter.Warnings.clear();
    filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Given");
    filter.Output();
    check(filter.Warnings.empty(), "what the user has chosen is not advised against");
  };
  expect("normals along an axis", 1.0, true, 0.0, 0.6, true);
  expect("the same inward", -1.0, true, 0.0, 0.6, true);
  expect("the same with details", 1.0, true, 0.06, 0.6, false);
  expect("the same that are not needed", 1.0, true, 0.0, 0.0, false);
  expect("normals of the ball", 1.0, false, 0.0, 0.6, false);
  expect("the same inward", -1.0, false, 0.0, 0.6, false);
  expect("no normals", 0.0, false, 0.0, 0.6, false);
}

/// That of the method; it must be that of the table and of PrintSelf too.
std::string AdviceOf(Checker& check, WatchedFilter& filter)
{
  filter.Output();
  std::string advice = filter->GetAdvice();
  auto* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
  auto* ofTable =
    vtkArrayDownCast<vtkStringArray>(table->GetFieldData()->GetAbstractArray("Advice"));
  check(ofTable ? ofTable->GetNumberOfValues() == 1 && ofTable->GetValue(0) == advice
                : advice.empty() && table->GetNumberOfRows() == 0,
    "the table should hold the advice '" + advice + "'");
  std::ostringstream text;
  filter->Print(text);
  check(Contains(text.str(), "Advice: " + advice + "\n"), "PrintSelf should print it");
  return advice;
}

void Expect(
  Checker& check, const std::string& about, WatchedFilter& filter, const std::string& beginning)
{
  check.About(about);
  const std::string advice = AdviceOf(check, filter);
  check(beginning.empty() ? advice.empty() : advice.rfind(beginning, 0) == 0,
    "the advice should begin with '" + beginning + "' and is '" + advice + "'");
}

void Advice(Checker& check)
{
  const Surface slivers = MakeEllipsoid({ 1.0, 0.7, 0.4 }, Faces::Triangles, 36, 40);
  WatchedFilter filter(slivers);
  check(std::string(filter->GetAdvice()).empty(), "before an execution there is none");
  Expect(check, "defaults", filter, "");
  SetUpEnergy(filter.Get());
  Expect(check, "closed form", filter, "");
  filter->SetSphericalWeightingToUniform();
  const vtkMTimeType before = filter->GetMTime();
  Expect(check, "uniform weights", filter, "SphericalWeighting Cotangent: ");
  check(filter->GetMTime() == before &&
      filter->GetSphericalWeighting() == vtkSphericalStyleFilter::UNIFORM,
    "nothing should change by itself");
  filter->SetRoundness(0.6);
  check(std::string(filter->GetAdvice()).empty(), "after a change there should be none");
  Expect(check, "another roundness", filter, "SphericalWeighting Cotangent: ");
  filter->ReproduceThesisOn();
  Expect(check, "the thesis", filter, "");
  filter->ReproduceThesisOff();
  Expect(check, "uniform weights again", filter, "SphericalWeighting Cotangent: ");
  filter->SetRoundness(-1.0);
  Expect(check, "after an error", filter, "");
  check(filter.Errors.size() == 1, "there should have been an error");
  filter->SetRoundness(0.5);
  filter->SetSphericalWeightingToCotangent();
  Expect(check, "followed", filter, "");

  filter->SetCenterModeToCustom();
  for (const double z : { 0.0, 3.0, 0.1, -3.0 })
  {
    filter->SetCenter(0.0, 0.0, z);
    Expect(check, "center at " + vtkVariant(z).ToString(), filter,
      std::abs(z) > 1.0 ? "CenterMode AreaCentroid: " : "");
  }
  filter->SetCenterModeToAreaCentroid();
  filter->SetInputData(MakeEllipsoid({ 1.0, 0.7, 0.4 }, Faces::Triangles, 8, 6));
  Expect(check, "large triangles", filter, "RefineLongEdges On: 100 % of the area");
  filter->SetRefineLongEdgesToAutomatic();
  Expect(check, "large triangles found", filter, "Input LoopSubdivision: the model has only 50");
  filter->SetRefineLongEdgesToOn();
  Expect(check, "large triangles split", filter, "Input LoopSubdivision: the model has only 50");

  // A bar of twelve triangles. The advice is followed, and neither it nor its opposite comes.
  vtkNew<vtkCubeSource> bar;
  bar->SetXLength(3.0);
  bar->Update();
  filter->SetInputData(bar->GetOutput());
  filter->SetDetailSize(0.06);
  filter->SetRoundness(1.0);
  const std::string faces = ": 98 % of the area is flat faces";
  for (const double normalBlend : { 0.6, 1.0 })
  {
    filter->SetNormalBlend(normalBlend);
    filter->SetDetailSize(0.06);
    Expect(check, "flat faces", filter, "NormalBlend 0" + faces);
    filter->SetNormalBlend(0.0);
    Expect(check, "flat faces around one center", filter, "DetailSize 0" + faces);
    filter->SetDetailSize(0.0);
    Expect(check, "flat faces without details", filter, "");
  }
  filter->SetRefineLongEdgesToOff();
  filter->SetInputData(vtkNew<vtkPolyData>());
  Expect(check, "empty input", filter, "");
}

/// The warning names a DetailSize that the grid is fine enough for.
void DetailsTooSmall(Checker& check)
{
  check.About("DetailSize too small");
  Watched<vtkSphericalStyleFilter> filter;
  filter->SetInputData(MakeEllipsoid({ 1.0, 1.0, 1.0 }, Faces::Triangles, 24, 13));
  filter->SetDetailSize(0.01);
  filter->SetNormalBlend(0.0);
  filter->Update();
  const std::string before = "the base is as smooth as with DetailSize ";
  const std::string said = filter.Warnings.empty() ? "" : filter.Warnings.front();
  const std::size_t at = said.find(before);
  if (!check(filter.Warnings.size() == 1 && at != std::string::npos &&
          Contains(said, "DetailSize 0.01 is too small for the area of this model"),
        "there should be one warning" + Joined(filter.Warnings)))
  {
    return;
  }
  filter->SetDetailSize(std::stod(said.substr(at + before.size())));
  check(filter->GetDetailSize() > 0.01, "it should name a larger one: " + said);
  filter.Warnings.clear();
  filter->Update();
  check(filter.Warnings.empty(), "its advice should be good" + Joined(filter.Warnings));
}
}

int TestSphericalStyleFilterAdvice(int, char*[])
{
  Checker check;
  Thinned(check);
  WallsStay(check);
  NormalsThatDoNotFit(check);
  Advice(check);
  DetailsTooSmall(check);
  return check.Result();
}
