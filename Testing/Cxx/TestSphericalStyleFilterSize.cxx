// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// KeepSize, KeepOnGround and UpAxis: area, volume, extent and ground are what they were, measured
/// here a second time, whatever the method; what cannot be kept is an error; nothing outside of a
/// region moves; and Roundness 0 moves nothing at all.
#include "ArrayTesting.h"

using namespace FilterTesting;

namespace
{
using Filter = vtkThesisStyleFilter;
using Change = std::function<void(Filter*)>;

constexpr double Kept = 1e-6; // relative
constexpr int RegionArray = 4;
constexpr int CenterIdArray = 5;
constexpr int AllSizes[] = { Filter::NO_SIZE, Filter::AREA, Filter::VOLUME, Filter::EXTENT };
constexpr int AllAxes[] = { Filter::X_AXIS, Filter::Y_AXIS, Filter::Z_AXIS };

Vector Minus(const Vector& x, const Vector& y)
{
  return { x[0] - y[0], x[1] - y[1], x[2] - y[2] };
}

Vector Cross(const Vector& x, const Vector& y)
{
  return { x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0] };
}

double Dot(const Vector& x, const Vector& y)
{
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/// What KeepSize keeps, of the triangles and points that are chosen.
double Measure(
  vtkPolyData* surface, int size, int axis,
  const std::function<bool(vtkIdType)>& chosen = [](vtkIdType) { return true; })
{
  double sum = 0.0;
  const Vector apex = PointOf(surface, 0);
  for (const auto& t : TriangleCorners(surface))
  {
    if (chosen(t[0]) && chosen(t[1]) && chosen(t[2]))
    {
      const Vector a = PointOf(surface, t[0]);
      const Vector n = Cross(Minus(PointOf(surface, t[1]), a), Minus(PointOf(surface, t[2]), a));
      sum += size == Filter::AREA ? 0.5 * std::sqrt(Dot(n, n)) : Dot(n, Minus(a, apex)) / 6.0;
    }
  }
  if (size != Filter::EXTENT)
  {
    return sum;
  }
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    if (chosen(i))
    {
      low = std::min(low, PointOf(surface, i)[axis]);
      high = std::max(high, PointOf(surface, i)[axis]);
    }
  }
  return high - low;
}

double Lowest(vtkPolyData* surface, int axis)
{
  double low = HUGE_VAL;
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    low = std::min(low, PointOf(surface, i)[axis]);
  }
  return low;
}

/// A ball with bumps that is longest along z, away from the origin, and lies on no ground.
Surface Model(int type = VTK_DOUBLE)
{
  Surface model = Mapped(
    MakeEllipsoid({ 1.0, 0.8, 2.0 }, Faces::Triangles, 24, 19),
    [](const Vector& x)
    {
      const double r = 1.0 + 0.3 * std::sin(5.0 * x[0]) * std::cos(3.0 * x[2]);
      return Vector{ r * x[0] + 0.3, r * x[1] - 5.0 + 0.1 * x[2] * x[2], x[2] + 0.2 * x[0] + 1.7 };
    },
    type);
  const auto height = [&](double above, double inside, double outside)
  {
    return [&model, above, inside, outside](vtkIdType i, int)
    { return PointOf(model, i)[2] > above ? inside : outside; };
  };
  model->GetPointData()->AddArray(MakeArray("region", model, 1, height(1.2, 1.0, 0.0)));
  model->GetPointData()->AddArray(MakeArray("part", model, 1, height(1.9, 4.0, 2.0)));
  return model;
}

const std::vector<std::pair<const char*, Change>>& Methods()
{
  static const std::vector<std::pair<const char*, Change>> methods = {
    { "defaults", [](Filter* f) { SetUpDefaults(f); } },
    { "without details",
      [](Filter* f)
      {
        SetUpDefaults(f);
        f->SetDetailSize(0.0);
      } },
    { "radius of the whole model",
      [](Filter* f)
      {
        SetUpDefaults(f);
        f->SetNormalRadiusToWholeModel();
        f->SetRoundness(5.0);
      } },
    { "two centers",
      [](Filter* f)
      {
        SetUpDefaults(f);
        f->SetInputArrayToProcess(CenterIdArray, 0, 0, OfPoints, "part");
      } },
    { "long edges split",
      [](Filter* f)
      {
        f->SetRefineLongEdgesToOn();
        f->SetMaximumEdgeLength(0.07);
      } },
    { "energy", [](Filter* f) { SetUpUniform(f); } },
    { "energy and details",
      [](Filter* f)
      {
        SetUpDefaults(f);
        f->SetSphericalWeightingToUniform();
        f->SetMaximumNumberOfIterations(20);
      } },
    { "energy with hollows turned",
      [](Filter* f)
      {
        SetUpDefaults(f);
        f->SetConcaveEdgesToFlip();
        f->SetMaximumNumberOfIterations(20);
      } },
  };
  return methods;
}

std::string Name(int size, int axis)
{
  const char* const sizes[] = { "Off", "Area", "Volume", "Extent" };
  return std::string(", KeepSize ") + sizes[size] + ", UpAxis " + "XYZ"[axis];
}

void Enumerators(Checker& check)
{
  check.About("enumerators");
  check(Filter::NO_SIZE == 0 && Filter::AREA == 1 && Filter::VOLUME == 2 && Filter::EXTENT == 3,
    "KeptSizes should be 0 to 3");
  check(Filter::OWN_THICKNESS == 0 && Filter::WHOLE_MODEL_RADIUS == 1, "NormalRadii: 0 and 1");
  check(Filter::X_AXIS == 0 && Filter::Y_AXIS == 1 && Filter::Z_AXIS == 2, "UpAxes: 0 to 2");
  check(Filter::NEVER == 0 && Filter::WHERE_COARSE == 1 && Filter::ALWAYS == 2,
    "Refinements should be 0 to 2");
  vtkNew<Filter> filter;
  check(filter->GetRoundness() == 1.0 && filter->GetNormalBlend() == 0.6 &&
      filter->GetDetailSize() == 0.06 && filter->GetKeepSize() == Filter::AREA &&
      filter->GetNormalRadius() == Filter::OWN_THICKNESS && !filter->GetKeepOnGround() &&
      filter->GetUpAxis() == Filter::Y_AXIS && filter->GetRefineLongEdges() == Filter::WHERE_COARSE,
    "the defaults");
}

/// Area, volume and extent stay; Off is their result without the factor.
void SizeStays(Checker& check, const char* method, const Change& set)
{
  const Surface model = Model();
  WatchedFilter off(model);
  set(off.Get());
  off->SetKeepSizeToOff();
  const Surface unscaled = off.Output();
  WatchedFilter filter(model);
  set(filter.Get());
  for (const int size : AllSizes)
  {
    for (const int axis : AllAxes)
    {
      check.About(method + Name(size, axis));
      filter->SetKeepSize(size);
      filter->SetUpAxis(axis);
      vtkPolyData* output = filter.Output();
      check(filter.Errors.empty(), "no error expected" + Joined(filter.Errors));
      if (size == Filter::NO_SIZE)
      {
        check(SamePoints(output, unscaled), "Off should know no axis");
        check(std::abs(Measure(output, Filter::AREA, axis) / Measure(model, Filter::AREA, axis) -
                1.0) > 1e-3,
          "or the test is none: rounding should change the area");
        continue;
      }
      const double before = Measure(model, size, axis);
      check.AtMost(
        std::abs(Measure(output, size, axis) / before - 1.0), Kept, "relative change of the size");
      // One factor for all distances: scaled, and not deformed.
      const double factor =
        std::sqrt(Measure(output, Filter::AREA, axis) / Measure(unscaled, Filter::AREA, axis));
      const vtkIdType last = unscaled->GetNumberOfPoints() - 1;
      double largest = 0.0;
      for (vtkIdType i = 0; i < last; ++i)
      {
        const Vector d = Minus(PointOf(unscaled, i), PointOf(unscaled, last));
        const Vector scaled = { factor * d[0], factor * d[1], factor * d[2] };
        largest =
          std::max(largest, Distance(scaled, Minus(PointOf(output, i), PointOf(output, last))));
      }
      check.AtMost(largest / Diagonal(model), 1e-10, "difference to the scaled result of Off");
    }
  }
}

/// Off scales nothing: the closed form, evaluated here.
void OffIsTheBlend(Checker& check)
{
  check.About("Off is the blend");
  const Surface model = Model();
  WatchedEnergy filter(model);
  filter->SetRoundness(2.0);
  vtkPolyData* output = filter.Output();
  const double* center = filter->GetEffectiveCenter();
  const double mu = std::sqrt(3.0) * 2.0;
  Surface expected = Mapped(model,
    [&](const Vector& x)
    {
      const Vector d = Minus(x, { center[0], center[1], center[2] });
      const double length = std::sqrt(Dot(d, d));
      Vector y;
      for (int k = 0; k < 3; ++k)
      {
        const double target = center[k] + filter->GetEffectiveRadius() / length * d[k];
        y[k] = (x[k] + mu * target) / (1.0 + mu);
      }
      return y;
    });
  // The mean of the points stays, by areas.
  const std::vector<double> areas = PointAreas(model);
  Vector move = { 0.0, 0.0, 0.0 };
  double all = 0.0;
  for (vtkIdType i = 0; i < model->GetNumberOfPoints(); ++i)
  {
    const Vector d = Minus(PointOf(model, i), PointOf(expected, i));
    for (int k = 0; k < 3; ++k)
    {
      move[k] += areas[i] * d[k];
    }
    all += areas[i];
  }
  expected = Shifted(expected, { move[0] / all, move[1] / all, move[2] / all });
  check.AtMost(LargestDistance(output, expected), 1e-12 * Diagonal(model), "difference");
}

void GroundStays(Checker& check, const char* method, const Change& set)
{
  const Surface model = Model();
  WatchedFilter filter(model);
  set(filter.Get());
  WatchedFilter floating(model);
  set(floating.Get());
  filter->KeepOnGroundOn();
  for (const int size : AllSizes)
  {
    for (const int axis : AllAxes)
    {
      check.About(method + Name(size, axis) + ", on the ground");
      for (WatchedFilter* each : { &filter, &floating })
      {
        (*each)->SetKeepSize(size);
        (*each)->SetUpAxis(axis);
      }
      vtkPolyData* output = filter.Output();
      check.AtMost(std::abs(Lowest(output, axis) - Lowest(model, axis)) / Diagonal(model), Kept,
        "move of the lowest point");
      if (size != Filter::NO_SIZE)
      {
        check.AtMost(std::abs(Measure(output, size, axis) / Measure(model, size, axis) - 1.0), Kept,
          "relative change of the size");
      }
      // It has moved along the axis and not otherwise.
      vtkPolyData* before = floating.Output();
      const double rise = PointOf(output, 0)[axis] - PointOf(before, 0)[axis];
      check(std::abs(rise) > 1e-4, "or the test is none: rounding should leave the ground");
      Vector by = { 0.0, 0.0, 0.0 };
      by[axis] = rise;
      check.AtMost(LargestDistance(output, Shifted(before, by)), 1e-12 * Diagonal(model),
        "difference to the same, moved");
    }
  }
}

/// Surfaces that are inside out, of parts, open, of single precision, tiny and huge.
void OtherSurfaces(Checker& check)
{
  const Surface ball = MakeEllipsoid({ 1.0, 0.8, 2.0 }, Faces::Triangles, 24, 19);
  const auto scaled = [&](double by, int type)
  {
    return Mapped(
      ball,
      [by](const Vector& x) {
        return Vector{ by * x[0], by * x[1], by * x[2] };
      },
      type);
  };
  const std::pair<const char*, Surface> surfaces[] = {
    { "inside out", MakeEllipsoid({ 1.0, 0.8, -2.0 }, Faces::Triangles, 24, 19) },
    { "of two parts", Together({ ball, Shifted(MakeEllipsoid({ 0.5, 0.5, 0.3 }), { 0, 2, 0 }) }) },
    { "single precision", WithPointsOf(ball, VTK_FLOAT) },
    { "tiny", scaled(1e-30, VTK_DOUBLE) },
    { "huge", scaled(1e30, VTK_DOUBLE) },
  };
  for (const auto& [name, surface] : surfaces)
  {
    WatchedDefaults filter(surface);
    for (const int size : { Filter::AREA, Filter::VOLUME, Filter::EXTENT })
    {
      check.About(name + Name(size, Filter::Y_AXIS));
      filter->SetKeepSize(size);
      vtkPolyData* output = filter.Output();
      check(filter.Errors.empty(), "no error expected" + Joined(filter.Errors));
      check.AtMost(std::abs(Measure(output, size, 1) / Measure(surface, size, 1) - 1.0), Kept,
        "relative change of the size");
    }
  }
}

/// A sheet of quads in the plane of two directions.
Surface Sheet(const Vector& u, const Vector& v)
{
  std::vector<Vector> points;
  std::vector<Cell> cells;
  for (vtkIdType j = 0; j < 12; ++j)
  {
    for (vtkIdType i = 0; i < 14; ++i)
    {
      const double s = 0.1 * static_cast<double>(i);
      const double t = 0.1 * static_cast<double>(j);
      points.push_back(
        { 0.7 + s * u[0] + t * v[0], 2.5 + s * u[1] + t * v[1], -0.3 + s * u[2] + t * v[2] });
      if (i > 0 && j > 0)
      {
        const vtkIdType at = 14 * j + i;
        cells.push_back({ at - 15, at - 14, at });
        cells.push_back({ at - 15, at, at - 1 });
      }
    }
  }
  return MakeSurface(points, cells);
}

void Errors(Checker& check)
{
  const Surface tilted = Sheet({ 0.8, 0.36, 0.48 }, { -0.6, 0.48, 0.64 });
  struct Case
  {
    const char* name;
    Surface surface;
    int size;
    int axis;
    std::vector<std::string> words;
  };
  const std::vector<std::string> volume = { "KeepSize Volume", "KeepSize Area" };
  const std::vector<std::string> extent = { "KeepSize Extent", "UpAxis" };
  const Case cases[] = {
    { "volume of a flat sheet", Sheet({ 1, 0, 0 }, { 0, 0, 1 }), Filter::VOLUME, 1, volume },
    { "volume of a tilted sheet", tilted, Filter::VOLUME, 1, volume },
    { "extent of a sheet across x", Sheet({ 0, 1, 0 }, { 0, 0, 1 }), Filter::EXTENT, 0, extent },
    { "extent of a sheet across y", Sheet({ 1, 0, 0 }, { 0, 0, 1 }), Filter::EXTENT, 1, extent },
    { "extent of a sheet across z", Sheet({ 1, 0, 0 }, { 0, 1, 0 }), Filter::EXTENT, 2, extent },
  };
  for (const auto& [method, set] : Methods())
  {
    for (const Case& c : cases)
    {
      check.About(std::string(method) + ", " + c.name);
      const Surface surface = Surface::New();
      surface->DeepCopy(c.surface);
      surface->GetPointData()->AddArray(
        MakeArray("part", surface, 1, [](vtkIdType i, int) { return i < 84 ? 1.0 : 2.0; }));
      WatchedFilter filter(surface);
      set(filter.Get());
      filter->SetKeepSize(c.size);
      filter->SetUpAxis(c.axis);
      vtkPolyData* output = filter.Output();
      if (check(filter.Errors.size() == 1,
            "there should be one error, not " + Text(static_cast<vtkIdType>(filter.Errors.size())) +
              Joined(filter.Errors)))
      {
        for (const std::string& word : c.words)
        {
          check(Contains(filter.Errors[0], word),
            "the error should say \"" + word + "\" and says " + filter.Errors[0]);
        }
      }
      check(output->GetNumberOfPoints() == 0 && output->GetNumberOfCells() == 0,
        "the output should be empty");
      filter.Errors.clear();
      filter->SetKeepSizeToArea();
      output = filter.Output();
      check(filter.Errors.empty() && output->GetNumberOfPoints() >= surface->GetNumberOfPoints() &&
          AllFinite(output->GetPoints()->GetData()),
        "with Area it should work" + Joined(filter.Errors));
    }
  }
}

/// A region is measured and scaled in itself, and stands on the rest.
void Regions(Checker& check)
{
  for (const int type : { VTK_DOUBLE, VTK_FLOAT })
  {
    const Surface model = Model(type);
    vtkDataArray* region = PointArray(model, "region");
    for (vtkIdType i = 0; i < model->GetNumberOfPoints(); i += 3) // zeros of either sign
    {
      Vector x = PointOf(model, i);
      x[1] = region->GetComponent(i, 0) == 0.0 && x[1] > -5.2 && x[1] < -4.8 ? -0.0 : x[1];
      model->GetPoints()->SetPoint(i, x.data());
    }
    const auto inside = [&](vtkIdType i) { return region->GetComponent(i, 0) > 0.0; };
    for (const auto& [method, set] : Methods())
    {
      if (Contains(method, "long edges")) // there are other points
      {
        continue;
      }
      for (const int size : AllSizes)
      {
        check.About(method + Name(size, Filter::Z_AXIS) + ", region, type " + Text(type));
        WatchedFilter filter(model);
        set(filter.Get());
        filter->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "region");
        filter->SetKeepSize(size);
        filter->SetUpAxisToZ();
        filter->SetBorderWidth(0.0);
        vtkPolyData* output = filter.Output();
        check(filter.Errors.empty(), "no error expected" + Joined(filter.Errors));
        int moved = 0;
        for (vtkIdType i = 0; i < model->GetNumberOfPoints(); ++i)
        {
          moved += SamePoint(model, i, output, i) ? 0 : 1;
          check(inside(i) || SamePoint(model, i, output, i),
            "point " + Text(i) + " is outside and should keep its bits");
        }
        check(moved > 50, "the region should move");
        if (size == Filter::AREA || size == Filter::EXTENT) // it encloses no volume of its own
        {
          check.AtMost(
            std::abs(Measure(output, size, 2, inside) / Measure(model, size, 2, inside) - 1.0),
            Kept, "relative change of the size of the region");
        }
        const Surface without = Surface::New();
        without->DeepCopy(output);
        filter->KeepOnGroundOn();
        check(SamePoints(without, filter.Output()), "there is no ground for a region");
      }
    }
  }
}

/// Roundness 0 is the input, to the bit.
void NothingMoves(Checker& check)
{
  for (const int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    const Surface model = Model(type);
    WatchedDefaults filter(model);
    filter->SetRoundness(0.0);
    for (const double details : { 0.0, 0.03, 0.06 })
    {
      filter->SetDetailSize(details);
      for (const int size : AllSizes)
      {
        filter->SetKeepSize(size);
        for (const int axis : AllAxes)
        {
          filter->SetUpAxis(axis);
          for (const int more : { 0, 3 })
          {
            filter->SetKeepOnGround(more % 2 == 1);
            filter->SetNormalRadius(more / 2);
            check.About("Roundness 0, type " + Text(type) + ", DetailSize " +
              vtkVariant(details).ToString() + Name(size, axis) + ", " + Text(more));
            check(SamePoints(model, filter.Output()), "the points should keep their bits");
            check(filter.Errors.empty() && filter.Warnings.empty() && filter->GetConverged(),
              "it should say nothing" + Joined(filter.Errors) + Joined(filter.Warnings));
          }
        }
      }
    }
    check.About("a factor of 0, type " + Text(type));
    model->GetPointData()->AddArray(
      MakeArray("none", model, 1, [](vtkIdType, int) { return 0.0; }));
    filter->SetRoundness(3.0);
    filter->SetInputArrayToProcess(1, 0, 0, OfPoints, "none");
    filter->Modified();
    check(SamePoints(model, filter.Output()), "the points should keep their bits");

    // Where an energy is minimized, rounding may move them.
    for (const auto& [method, set] : Methods())
    {
      if (Contains(method, "long edges"))
      {
        continue;
      }
      check.About(std::string("Roundness 0, ") + method + ", type " + Text(type));
      WatchedFilter still(model);
      set(still.Get());
      still->SetRoundness(0.0);
      still->KeepOnGroundOn();
      check.AtMost(LargestDistance(model, still.Output()),
        (type == VTK_FLOAT ? 1e-6 : 1e-12) * Diagonal(model), "movement");
    }
  }
}

/// As large as before, whatever the threads and what was before.
void Bits(Checker& check)
{
  const Surface model = Model();
  for (const auto& [method, set] : Methods())
  {
    for (const int size : AllSizes)
    {
      check.About(method + Name(size, Filter::Y_AXIS) + ", bits");
      WatchedFilter one(model);
      set(one.Get());
      one->SetKeepSize(size);
      one->KeepOnGroundOn();
      one->SetNumberOfThreads(1);
      WatchedFilter three(model);
      set(three.Get());
      three->SetKeepSize(size);
      three->KeepOnGroundOn();
      three->SetNumberOfThreads(3);
      const Surface first = Surface::New();
      first->DeepCopy(one.Output());
      check(SamePoints(first, three.Output()), "one and three threads should give the same bits");
      one->SetUpAxisToX();
      one.Output();
      one->SetUpAxisToY();
      check(SamePoints(first, one.Output()), "there and back, too");
    }
  }
}
}

int TestSphericalStyleFilterSize(int, char*[])
{
  Checker check;
  Enumerators(check);
  OffIsTheBlend(check);
  for (const auto& [method, set] : Methods())
  {
    SizeStays(check, method, set);
    GroundStays(check, method, set);
  }
  OtherSurfaces(check);
  Errors(check);
  Regions(check);
  NothingMoves(check);
  Bits(check);
  return check.Result();
}
