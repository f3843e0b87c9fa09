// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// What there is to look at of the target sphere: the third output lies on it, and the filter tells
/// whether its center is in the model and its volume that of one.
#include "EveryFilter.h"

#include "vtkIntArray.h"

#include <sstream>
#include <tuple>

using namespace FilterTesting;

namespace
{
void Output(Checker& check)
{
  check.About("third output");
  WatchedFilter filter(MakeEllipsoid({ 1.0, 2.0, 3.0 }));
  filter->SetCenterModeToCustom();
  filter->SetCenter(0.1, -0.2, 0.3);
  filter->SetRadiusModeToCustom();
  filter->SetRadius(1.7);
  vtkPolyData* sphere = filter.Output(2);
  const vtkIdType n = sphere->GetNumberOfPoints();
  check(
    n > 0 && sphere->GetNumberOfLines() > 0 && sphere->GetNumberOfPolys() == 0, "should be lines");
  double off = 0.0;
  double low[3] = { 9.0, 9.0, 9.0 };
  double high[3] = { -9.0, -9.0, -9.0 };
  for (vtkIdType i = 0; i < n; ++i)
  {
    const Vector x = PointOf(sphere, i);
    off = std::max(off, std::abs(Distance(x, { 0.1, -0.2, 0.3 }) - 1.7));
    for (int k = 0; k < 3; ++k)
    {
      low[k] = std::min(low[k], x[k]);
      high[k] = std::max(high[k], x[k]);
    }
  }
  check.AtMost(off, 1e-14, "distance to the sphere");
  for (int k = 0; k < 3; ++k)
  {
    check.AtMost(std::abs(high[k] - low[k] - 2.0 * 1.7), 1e-14, "diameter along an axis");
  }

  // The mean of a symmetric body, and the radius of its area.
  filter->SetCenterModeToAreaCentroid();
  filter->SetRadiusModeToEqualArea();
  sphere = filter.Output(2);
  check.AtMost(
    std::abs(Distance(PointOf(sphere, 0), { 0.0, 0.0, 0.0 }) - filter->GetEffectiveRadius()), 1e-12,
    "distance of the sphere in effect");

  check.About("third output of nothing");
  WatchedFilter empty(Surface::New());
  check(empty.Output(2)->GetNumberOfPoints() == 0, "should be empty");
}

void SeveralCenters(Checker& check)
{
  check.About("several centers");
  WatchedEnergy one(MakeEllipsoid({ 1.0, 1.0, 1.0 }));
  const vtkIdType points = one.Output(2)->GetNumberOfPoints();
  const Surface apart = Together({ MakeEllipsoid({ 1.0, 1.0, 1.0 }),
    Shifted(MakeEllipsoid({ 1.0, 1.0, 1.0 }), { 5.0, 0.0, 0.0 }) });
  vtkNew<vtkIntArray> ids;
  ids->SetName("CenterId");
  for (vtkIdType i = 0; i < apart->GetNumberOfPoints(); ++i)
  {
    ids->InsertNextValue(2 * i < apart->GetNumberOfPoints() ? 0 : 1);
  }
  apart->GetPointData()->AddArray(ids);
  WatchedEnergy two(apart);
  two->SetInputArrayToProcess(5, 0, 0, OfPoints, "CenterId");
  vtkPolyData* spheres = two.Output(2);
  check(spheres->GetNumberOfPoints() == 2 * points, "should be a sphere for each");
  check.AtMost(std::abs(PointOf(spheres, points)[0] - PointOf(spheres, 0)[0] - 5.0), 1e-9,
    "distance of the second from where it should be");
}

/// RadiusMode EqualVolume is warned of where there is no volume, and no other mode is.
/// @param set  gives the filter the surface
template <typename FilterType>
void Volume(Checker& check, const std::function<void(FilterType*, vtkPolyData*)>& set)
{
  const Surface ball = MakeEllipsoid({ 1.0, 1.1, 1.2 }, Faces::Triangles, 24, 15);
  Surface half = Surface::New();
  half->DeepCopy(ball);
  vtkNew<vtkCellArray> lower;
  Surface turned = Surface::New();
  turned->DeepCopy(ball);
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < ball->GetNumberOfPolys(); ++c)
  {
    ball->GetPolys()->GetCellAtId(c, ids);
    const vtkIdType backward[] = { ids->GetId(2), ids->GetId(1), ids->GetId(0) };
    if (PointOf(ball, ids->GetId(0))[2] < 0.0)
    {
      lower->InsertNextCell(ids);
    }
    else
    {
      turned->GetPolys()->ReplaceCellAtId(c, 3, backward);
    }
  }
  half->SetPolys(lower);
  Watched<FilterType> filter;
  for (const auto& [name, surface, closed] : { std::tuple("closed", ball, true),
         std::tuple("open", half, false), std::tuple("half turned round", turned, false) })
  {
    check.About(std::string(filter->GetClassName()) + ", volume of a surface, " + name);
    set(filter.Get(), surface);
    for (const bool ofVolume : { true, false })
    {
      filter->SetRadiusMode(ofVolume ? FilterType::EQUAL_VOLUME : FilterType::EQUAL_AREA);
      filter.Warnings.clear();
      filter.Output();
      const auto told = std::count_if(filter.Warnings.begin(), filter.Warnings.end(),
        [](const std::string& text) { return Contains(text, "RadiusMode EqualVolume: the "); });
      check(filter.Errors.empty() && told == (ofVolume && !closed ? 1 : 0),
        ofVolume ? "EqualVolume should be warned of if open" : "EqualArea should not");
    }
  }
}

/// The method's; it must be that of PrintSelf too.
std::string Position(Checker& check, WatchedFilter& filter)
{
  std::string position = filter->GetCenterPosition();
  std::ostringstream text;
  filter->Print(text);
  check(Contains(text.str(), "CenterPosition: " + position + "\n"), "PrintSelf should print it");
  return position;
}

void Inside(Checker& check, const std::string& about, vtkPolyData* model)
{
  check.About(about);
  WatchedFilter filter(model);
  check(Position(check, filter).empty(), "nothing is known before the first execution");
  filter.Output();
  check(Position(check, filter) == "Inside", "the centroid should be inside");
  filter->SetRoundness(1.0);
  check(Position(check, filter) == "Inside", "the center has not moved");
  filter->SetRoundness(-1.0);
  filter.Output();
  check(filter.Errors.size() == 1 && filter->GetEffectiveRadius() == 0.0 &&
      Position(check, filter).empty(),
    "after an error nothing should be known of the sphere");
  filter.Errors.clear();
  filter->SetRoundness(1.0);
  filter.Output();
  check(Position(check, filter) == "Inside", "and it should be known again");
  filter->SetCenterModeToCustom();
  // The ball ends at 1, so half of the radius from there the surface is near.
  const double border = 1.0 - 0.5 * filter->GetEffectiveRadius();
  check(border > 0.2 && border < 0.8, "the sphere should be of the ball's size");
  for (const auto& [z, position] :
    { std::pair(border - 0.02, "Inside"), std::pair(border + 0.02, "NearSurface"),
      std::pair(0.95, "NearSurface"), std::pair(1.05, "Outside"),
      std::pair(0.02 - border, "Inside"), std::pair(-9.0, "Outside") })
  {
    filter->SetCenter(0.0, 0.0, z);
    const std::string where = "z = " + vtkVariant(z).ToString() + " should be " + position;
    check(Position(check, filter) == position, where + " before the execution");
    filter.Output();
    check(Position(check, filter) == position, where);
  }
  filter->SetCenterModeToPointMean();
  check(
    Position(check, filter).empty(), "another mode's center is not known before it is executed");
  filter.Output();
  check(Position(check, filter) == "Inside", "the mean of the points should be inside");
}
}

int TestSphericalStyleFilterTargetSphere(int, char*[])
{
  Checker check;
  Output(check);
  SeveralCenters(check);
  Volume<vtkSphericalStyleFilter>(
    check, [](auto* filter, vtkPolyData* surface) { filter->SetInputData(surface); });
  Volume<vtkSphereProjectionFilter>(
    check, [](auto* filter, vtkPolyData* surface) { filter->SetInputData(surface); });
#ifdef SPHERICALSTYLE_WITH_CGAL
  Volume<vtkConvexProxyDeformFilter>(check,
    [](auto* filter, vtkPolyData* surface)
    {
      filter->SetInputData(MakeEllipsoid({ 1.0, 1.0, 1.0 }));
      filter->SetProxyData(surface);
    });
#endif
  const Surface ball = MakeEllipsoid({ 1.0, 1.0, 1.0 }, Faces::Triangles, 32, 31);
  Inside(check, "closed", ball);
  Inside(check, "inside out", MakeEllipsoid({ 1.0, 1.0, -1.0 }, Faces::Triangles, 32, 31));
  // Without a few triangles at the side: open, and not symmetric.
  vtkNew<vtkCellArray> fewer;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < ball->GetNumberOfPolys(); ++c)
  {
    ball->GetPolys()->GetCellAtId(c, ids);
    if (c < 600 || c >= 606)
    {
      fewer->InsertNextCell(ids);
    }
  }
  auto open = Surface::New();
  open->SetPoints(ball->GetPoints());
  open->SetPolys(fewer);
  Inside(check, "open", open);
  return check.Result();
}
