// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Parts of a model: what may move (mask, selection, border) and several centers (ids, given
// points).
#include "ArrayTesting.h"

#include <limits>

using namespace FilterTesting;

namespace
{
constexpr int RegionArray = 4;
constexpr int CenterIdArray = 5;

// Smoothly across the ellipsoid's long axis, with points inside and outside.
bool Inside(const Vector& x)
{
  return x[2] + 0.2 * x[0] > 0.1;
}

Surface Model()
{
  Surface model = MakeEllipsoid({ 0.7, 0.6, 1.0 }, Faces::Triangles, 32, 19);
  model->GetPointData()->AddArray(MakeArray(
    "region", model, 1, [&](vtkIdType i, int) { return Inside(PointOf(model, i)) ? 1.0 : 0.0; }));
  model->GetPointData()->AddArray(MakeArray("part", model, 1,
    [&](vtkIdType i, int)
    {
      const double z = PointOf(model, i)[2];
      return z < -0.3 ? -7.0 : z < 0.4 ? 2.0 : 40.0;
    }));
  return model;
}

void Outside(Checker& check)
{
  for (const int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    const Surface model = WithPointsOf(Model(), type);
    for (const double width : { 0.0, 0.1 })
    {
      for (const double a : { 0.0, 1.0 })
      {
        check.About("region, width " + std::to_string(width) + ", a " + std::to_string(a));
        Tested filter(model);
        filter->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "region");
        filter->SetBorderWidth(width);
        filter->SetNormalBlend(a);
        filter->SetRoundness(2.0);
        vtkPolyData* output = filter.Output();
        check(filter.Errors.empty() && filter.Warnings.empty(), "no message expected");
        int moved = 0, inside = 0;
        for (vtkIdType i = 0; i < model->GetNumberOfPoints(); ++i)
        {
          const bool in = Inside(PointOf(model, i));
          inside += in;
          moved += in && !SamePoint(model, i, output, i);
          check(in || SamePoint(model, i, output, i), "outside every bit should stay");
        }
        // Next to the border weights are near 0, and single precision may round to the rest point.
        check(moved > 0.95 * inside, "inside points should move");
      }
    }
  }
}

// RegionWeight against distances by brute force; and p' = p + w (p'_solved - p).
void Border(Checker& check)
{
  check.About("border");
  const Surface model = Model();
  Tested filter(model);
  filter->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "region");
  filter->SetBorderWidth(0.0);
  auto step = Surface::New();
  step->DeepCopy(filter.Output());
  filter->SetBorderWidth(0.15);
  vtkPolyData* output = filter.Output();
  const double width = 0.15 * Diagonal(model);
  vtkDataArray* weights = PointArray(output, "RegionWeight");
  if (!check(weights && weights->GetNumberOfComponents() == 1, "there should be RegionWeight"))
  {
    return;
  }
  for (vtkIdType i = 0; i < model->GetNumberOfPoints(); ++i)
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (vtkIdType j = 0; j < model->GetNumberOfPoints(); ++j)
    {
      if (!Inside(PointOf(model, j)))
      {
        nearest = std::min(nearest, Distance(PointOf(model, i), PointOf(model, j)));
      }
    }
    const double y = 1.0 - std::min(1.0, nearest / width);
    const double expected = Inside(PointOf(model, i))
      ? 1.0 - y * y * y * (1.0 + 3.0 * (1.0 - y) + 6.0 * (1.0 - y) * (1.0 - y))
      : 0.0;
    const double w = weights->GetComponent(i, 0);
    check.AtMost(std::abs(w - expected), 1e-13, "error of the weight of point " + Text(i));
    const Vector p = PointOf(model, i), q = PointOf(step, i);
    const Vector faded = { p[0] + w * (q[0] - p[0]), p[1] + w * (q[1] - p[1]),
      p[2] + w * (q[2] - p[2]) };
    check.AtMost(Distance(PointOf(output, i), faded), 1e-14, "error of point " + Text(i));
  }
  check(PointArray(filter.Output(), "RegionWeight") != nullptr, "still there");
  filter->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "");
  check(!PointArray(filter.Output(), "RegionWeight"), "without a region there should be none");
}

void Selections(Checker& check)
{
  check.About("selection");
  const Surface model = Model();
  const std::vector<vtkIdType> some = { 40, 41, 42, 43, 72, 73, 74, 75, 104, 105, 106, 107 };
  const auto moved = [&](vtkSelection* selection, bool mask)
  {
    Tested filter(model);
    filter->SetBorderWidth(0.0);
    filter->SetSelectionData(selection);
    if (mask)
    {
      filter->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "region");
    }
    vtkPolyData* output = filter.Output();
    check(filter.Errors.empty(), "no error expected" + Joined(filter.Errors));
    std::vector<vtkIdType> ids;
    for (vtkIdType i = 0; i < model->GetNumberOfPoints(); ++i)
    {
      if (!SamePoint(model, i, output, i))
      {
        ids.push_back(i);
      }
    }
    return ids;
  };
  check(moved(MakeSelection(some, vtkSelectionNode::POINT), false) == some, "these should move");
  check(moved(MakeSelection({}, vtkSelectionNode::POINT), false).empty(), "nothing should move");
  std::vector<vtkIdType> both = some;
  both.erase(std::remove_if(
               both.begin(), both.end(), [&](vtkIdType i) { return !Inside(PointOf(model, i)); }),
    both.end());
  check(moved(MakeSelection(some, vtkSelectionNode::POINT), true) == both,
    "with a mask too, a point should have to be in both");
  // A selection of everything, with the sphere of the region, is the filter without a region.
  std::vector<vtkIdType> all(model->GetNumberOfPoints());
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    all[i] = static_cast<vtkIdType>(i);
  }
  Tested whole(model), chosen(model);
  chosen->SetSelectionData(MakeSelection(all, vtkSelectionNode::POINT));
  check.AtMost(LargestDistance(whole.Output(), chosen.Output()), 1e-14, "everything selected");
}

void SphereOf(Checker& check)
{
  check.About("SphereOf");
  const Surface model = Model();
  WatchedEnergy none(model), filter(model); // or the center is that of the base
  none->SetCenterModeToPointMean();
  none->Update();
  filter->SetCenterModeToPointMean();
  filter->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "region");
  filter->Update();
  Vector mean = { 0.0, 0.0, 0.0 };
  int inside = 0;
  for (vtkIdType i = 0; i < model->GetNumberOfPoints(); ++i)
  {
    const Vector x = PointOf(model, i);
    if (Inside(x))
    {
      ++inside;
      mean = { mean[0] + x[0], mean[1] + x[1], mean[2] + x[2] };
    }
  }
  mean = { mean[0] / inside, mean[1] / inside, mean[2] / inside };
  Vector center;
  filter->GetEffectiveCenter(center.data());
  check.AtMost(Distance(center, mean), 1e-13, "distance of the center from the region's mean");
  check(filter->GetEffectiveRadius() < 0.9 * none->GetEffectiveRadius(), "a smaller radius");
  filter->SetSphereOfToWholeModel();
  filter->Update();
  filter->GetEffectiveCenter(center.data());
  Vector whole;
  none->GetEffectiveCenter(whole.data());
  check.AtMost(Distance(center, whole), 1e-15, "distance from the center of the whole model");
  check(filter->GetEffectiveRadius() == none->GetEffectiveRadius(), "the radius of the model");
}

void Centers(Checker& check)
{
  check.About("several centers");
  const Surface model = Model();
  Tested filter(model);
  filter->SetCenterModeToPointMean();
  filter->SetInputArrayToProcess(CenterIdArray, 0, 0, OfPoints, "part");
  vtkPolyData* output = filter.Output();
  check(filter.Errors.empty() && filter.Warnings.empty(),
    "no message expected" + Joined(filter.Errors));
  const auto spheres = [&]() -> vtkDataArray*
  { return filter->GetOutputDataObject(1)->GetFieldData()->GetArray("Spheres"); };
  check(spheres() && spheres()->GetNumberOfTuples() == 3, "there should be three spheres");
  // By ascending id: -7, 2, 40. Each the mean of its points, or of those of the base.
  vtkDataArray* part = PointArray(model, "part");
  const double ids[] = { -7.0, 2.0, 40.0 };
  for (int k = 0; k < 3; ++k)
  {
    double z = 0.0;
    int n = 0;
    for (vtkIdType i = 0; i < model->GetNumberOfPoints(); ++i)
    {
      if (part->GetComponent(i, 0) == ids[k])
      {
        z += PointOf(model, i)[2];
        ++n;
      }
    }
    check.AtMost(std::abs(spheres()->GetComponent(k, 2) - z / n),
      filter->GetDetailSize() == 0.0 ? 1e-13 : 0.12, "height of a center");
  }
  auto byMeans = Surface::New();
  byMeans->DeepCopy(output);

  // The same centers given, in ascending order and by an array.
  std::vector<Vector> means;
  for (int k = 0; k < 3; ++k)
  {
    means.push_back({ spheres()->GetComponent(k, 0), spheres()->GetComponent(k, 1),
      spheres()->GetComponent(k, 2) });
  }
  filter->SetCentersData(MakeSurface(means, {}));
  check.AtMost(LargestDistance(filter.Output(), byMeans), 1e-14, "given in order");
  const Surface named = MakeSurface({ means[2], { 9.0, 9.0, 9.0 }, means[0], means[1] }, {});
  named->GetPointData()->AddArray(MakeArray("part", named, 1,
    [](vtkIdType i, int) {
      return std::array<double, 4>{ 40.0, 5.0, -7.0, 2.0 }[i];
    }));
  filter->SetCentersData(named);
  check.AtMost(LargestDistance(filter.Output(), byMeans), 1e-14, "given by ids");
  const Surface moved = MakeSurface({ means[0], means[1], { 0.0, 0.2, 0.8 } }, {});
  filter->SetCentersData(moved);
  check(LargestDistance(filter.Output(), byMeans) > 0.01, "another center should matter");
  filter->SetCentersConnection(nullptr);
  check.AtMost(LargestDistance(filter.Output(), byMeans), 1e-14, "without given ones again");
  const double before = filter->GetCenterBlendWidth();
  filter->SetCenterBlendWidth(0.2);
  check(LargestDistance(filter.Output(), byMeans) > 1e-3, "the blend width should matter");
  filter->SetCenterBlendWidth(before);

  // The ids of coincident points: that of the first of them.
  Surface twice = Together({ Model(), Model() });
  const vtkIdType n = model->GetNumberOfPoints();
  twice->GetPointData()->AddArray(MakeArray(
    "part", twice, 1, [&](vtkIdType i, int) { return i < n ? part->GetComponent(i, 0) : 1.0; }));
  Tested seam(twice);
  seam->SetInputArrayToProcess(CenterIdArray, 0, 0, OfPoints, "part");
  seam->Update();
  check(seam.Errors.empty() &&
      seam->GetOutputDataObject(1)->GetFieldData()->GetArray("Spheres")->GetNumberOfTuples() == 3,
    "the later points' id should not count");
}

void Errors(Checker& check)
{
  const auto expect = [&](const std::string& about, const std::vector<std::string>& words,
                        const std::function<void(vtkSphericalStyleFilter*, vtkPolyData*)>& setup)
  {
    check.About(about);
    const Surface model = Model();
    WatchedDefaults filter(model);
    setup(filter.Get(), model);
    filter->Update();
    if (check(filter.Errors.size() == 1, "there should be one error"))
    {
      for (const std::string& word : words)
      {
        check(Contains(filter.Errors[0], word), "'" + word + "' expected in: " + filter.Errors[0]);
      }
    }
    check(vtkPolyData::SafeDownCast(filter->GetOutput())->GetNumberOfPoints() == 0, "no output");
  };
  const auto withIds = [](const std::function<double(vtkIdType)>& value, int components = 1)
  {
    return [=](vtkSphericalStyleFilter* filter, vtkPolyData* model)
    {
      model->GetPointData()->AddArray(
        MakeArray("ids", model, components, [&](vtkIdType i, int) { return value(i); }));
      filter->SetInputArrayToProcess(CenterIdArray, 0, 0, OfPoints, "ids");
    };
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect("half an id", { "Center id", "ids", "point 5", "2.5" },
    withIds([](vtkIdType i) { return i == 5 ? 2.5 : 1.0; }));
  expect(
    "NaN", { "Center id", "point 7" }, withIds([=](vtkIdType i) { return i == 7 ? nan : 1.0; }));
  expect("infinite", { "Center id", "point 3" },
    withIds([](vtkIdType i) { return i == 3 ? -std::numeric_limits<double>::infinity() : 1.0; }));
  expect("an id per point", { "Center id", "different values", "256" },
    withIds([](vtkIdType i) { return static_cast<double>(i); }));
  expect(
    "three components", { "Center id", "1 component" }, withIds([](vtkIdType) { return 1.0; }, 3));
  expect("a part of one point", { "Center id 1", "triangle" },
    withIds([](vtkIdType i) { return i == 100 ? 1.0 : 0.0; }));
  expect("no such array", { "Center id", "nowhere" },
    [](vtkSphericalStyleFilter* filter, vtkPolyData*)
    { filter->SetInputArrayToProcess(CenterIdArray, 0, 0, OfPoints, "nowhere"); });
  expect("no such region", { "Region", "nowhere" },
    [](vtkSphericalStyleFilter* filter, vtkPolyData*)
    { filter->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "nowhere"); });
  expect("centers without ids", { "Centers", "center ids" },
    [](vtkSphericalStyleFilter* filter, vtkPolyData*) {
      filter->SetCentersData(MakeSurface({ { 0.0, 0.0, 0.0 } }, {}));
    });
  expect("too few centers", { "Centers", "center id 40" },
    [](vtkSphericalStyleFilter* filter, vtkPolyData*)
    {
      filter->SetInputArrayToProcess(CenterIdArray, 0, 0, OfPoints, "part");
      filter->SetCentersData(MakeSurface({ { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.5 } }, {}));
    });
  expect("a center not finite", { "centers must be finite" },
    [&](vtkSphericalStyleFilter* filter, vtkPolyData*)
    {
      filter->SetInputArrayToProcess(CenterIdArray, 0, 0, OfPoints, "part");
      filter->SetCentersData(MakeSurface({ { 0, 0, 0 }, { nan, 0, 0 }, { 0, 0, 1 } }, {}));
    });
}

// The region and the centers follow the model's place and size.
void Invariance(Checker& check)
{
  check.About("scale and place");
  const Surface model = Model();
  const auto run = [](vtkPolyData* input)
  {
    Tested filter(input);
    filter->SetInputArrayToProcess(RegionArray, 0, 0, OfPoints, "region");
    filter->SetInputArrayToProcess(CenterIdArray, 0, 0, OfPoints, "part");
    auto output = Surface::New();
    output->DeepCopy(filter.Output());
    return output;
  };
  const Surface expected = run(model);
  for (const double scale : { 1e-6, 1e6, 1e-60, 1e60 })
  {
    const auto scaled = [&](const Vector& x) -> Vector {
      return { scale * (x[0] + 3.0), scale * x[1], scale * x[2] };
    };
    const Surface here = Mapped(expected, scaled);
    check.AtMost(LargestDistance(run(Mapped(model, scaled)), here) / scale, 1e-11,
      "difference at the scale " + std::to_string(scale));
  }
}
}

int TestSphericalStyleFilterRegions(int, char*[])
{
  Checker check;
  SphereOf(check);
  Errors(check);
  WithEach(
    { { "closed form", SetUpEnergy }, { "energy", SetUpUniform }, { "defaults", SetUpDefaults } },
    [&]
    {
      Outside(check);
      Border(check);
      Selections(check);
      Centers(check);
      Invariance(check);
    });
  return check.Result();
}
