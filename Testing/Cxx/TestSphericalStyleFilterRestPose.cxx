// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// The rest pose: at rest it changes nothing, a turned model gets the turned result, one that waves
/// does not jitter, and what is no pose of the model is refused [pose].
#include "FilterTesting.h"

#include "vtkCubeSource.h"
#include "vtkIntArray.h"

#include <limits>

using namespace FilterTesting;

namespace
{
using Setting = std::pair<const char*, std::function<void(vtkSphericalStyleFilter*)>>;

/// Its upper half has another center id.
Surface Body()
{
  Surface surface = MakeBumps(40);
  vtkNew<vtkIntArray> halves;
  halves->SetName("Half");
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    halves->InsertNextValue(PointOf(surface, i)[1] > 0.0 ? 1 : 0);
  }
  surface->GetPointData()->AddArray(halves);
  return surface;
}

const std::vector<Setting>& Settings()
{
  static const std::vector<Setting> settings = {
    { "defaults", [](vtkSphericalStyleFilter*) {} },
    { "no details", [](vtkSphericalStyleFilter* f) { f->SetDetailSize(0.0); } },
    { "one ball, volume",
      [](vtkSphericalStyleFilter* f)
      {
        f->SetNormalBlend(0.0);
        f->SetKeepSizeToVolume();
      } },
    { "two centers",
      [](vtkSphericalStyleFilter* f)
      { f->SetInputArrayToProcess(5, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Half"); } },
  };
  return settings;
}

Surface Rounded(vtkPolyData* model, vtkPolyData* rest, const Setting& setting)
{
  WatchedDefaults filter(model);
  setting.second(filter.Get());
  filter->SetRestPoseData(rest);
  Surface output = Surface::New();
  output->DeepCopy(filter.Output());
  for (const std::string& error : filter.Errors)
  {
    std::cerr << error << "\n";
  }
  return output;
}

/// A turn about no axis of the grid, and a shift.
Vector Turned(const Vector& x)
{
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  const Vector y = { c * x[0] - s * x[1], s * x[0] + c * x[1], x[2] };
  return { y[0] + 3.0, c * y[1] - s * y[2] - 1.0, s * y[1] + c * y[2] + 0.5 };
}

void StaysAtRest(Checker& check, const Setting& setting)
{
  check.About(std::string(setting.first) + ", at rest");
  const Surface model = Body();
  const Surface alone = Rounded(model, nullptr, setting);
  const Surface posed = Rounded(model, model, setting);
  const double distance = LargestDistance(alone, posed) / Diagonal(model);
  check(distance < 1e-12, "a model at rest should get its result: " + std::to_string(distance));
  check(LargestDistance(alone, model) > 0.02 * Diagonal(model), "it should have moved");
  check(SameArrays(alone->GetCellData(), posed->GetCellData()) &&
      alone->GetPointData()->GetNumberOfArrays() == posed->GetPointData()->GetNumberOfArrays(),
    "the output should have the same arrays");
}

void TurnsWithTheModel(Checker& check, const Setting& setting, vtkPolyData* model)
{
  check.About(std::string(setting.first) + ", turned");
  const Surface turned = Mapped(model, Turned);
  const Surface expected = Mapped(Rounded(model, nullptr, setting), Turned);
  const double diagonal = Diagonal(model);
  const Surface posed = Rounded(turned, model, setting);
  if (check(
        posed->GetNumberOfPoints() == expected->GetNumberOfPoints(), "points should be as many"))
  {
    const double distance = LargestDistance(posed, expected) / diagonal;
    check(distance < 1e-11, "the result should turn: " + std::to_string(distance));
  }
}

Surface Waving(vtkPolyData* model, int step, int steps)
{
  const double a = 2.0 * vtkMath::Pi() * step / steps;
  return Mapped(model,
    [a](const Vector& x)
    {
      const double bend = 0.3 * std::sin(a) * x[1];
      return Vector{ std::cos(bend) * x[0] - std::sin(bend) * x[1],
        std::sin(bend) * x[0] + std::cos(bend) * x[1], x[2] + 0.1 * std::sin(a + 2.0 * x[0]) };
    });
}

/// Root of the mean square of second differences in time, of all points.
double Jitter(const std::vector<Surface>& steps)
{
  double sum = 0.0;
  vtkIdType count = 0;
  for (std::size_t k = 1; k + 1 < steps.size(); ++k)
  {
    for (vtkIdType i = 0; i < steps[k]->GetNumberOfPoints(); ++i)
    {
      const Vector before = PointOf(steps[k - 1], i);
      const Vector now = PointOf(steps[k], i);
      const Vector after = PointOf(steps[k + 1], i);
      for (int axis = 0; axis < 3; ++axis)
      {
        const double second = before[axis] - 2.0 * now[axis] + after[axis];
        sum += second * second;
      }
      ++count;
    }
  }
  return std::sqrt(sum / static_cast<double>(count));
}

void DoesNotJitter(Checker& check)
{
  check.About("a model that waves");
  constexpr int Steps = 60;
  const Surface rest = Body();
  std::vector<Surface> given;
  std::vector<Surface> alone;
  std::vector<Surface> posed;
  WatchedDefaults each(rest);
  WatchedDefaults kept(rest);
  kept->SetRestPoseData(rest);
  const auto copy = [](vtkPolyData* surface)
  {
    Surface result = Surface::New();
    result->DeepCopy(surface);
    return result;
  };
  for (int step = 0; step < Steps; ++step)
  {
    given.push_back(Waving(rest, step, Steps));
    each->SetInputData(given.back());
    kept->SetInputData(given.back());
    alone.push_back(copy(each.Output()));
    posed.push_back(copy(kept.Output()));
  }
  const double without = Jitter(alone) / Jitter(given);
  const double with = Jitter(posed) / Jitter(given);
  std::cerr << "second differences over those of the model: " << with << ", without a rest pose "
            << without << "\n";
  check(with < 1.05, "should not jitter: " + std::to_string(with));
  check(without > 1.1, "the test should see jitter: " + std::to_string(without));
  // What is kept has no say: the last step alone is the same.
  check(SamePoints(posed.back(), Rounded(given.back(), rest, Settings().front())),
    "a step should not depend on those before");
}

void MovesByItsDisplacement(Checker& check)
{
  check.About("Displacement");
  const Surface rest = Body();
  const Surface turned = Mapped(rest, Turned);
  const Surface output =
    Rounded(turned, rest, { "", [](vtkSphericalStyleFilter* f) { f->GenerateDisplacementOn(); } });
  vtkDataArray* moves = output->GetPointData()->GetArray("Displacement");
  double worst = moves ? 0.0 : 1.0;
  for (vtkIdType i = 0; moves && i < output->GetNumberOfPoints(); ++i)
  {
    const Vector from = PointOf(turned, i);
    const Vector by = TupleOf(moves, i);
    worst = std::max(
      worst, Distance(PointOf(output, i), { from[0] + by[0], from[1] + by[1], from[2] + by[2] }));
  }
  check(worst < 1e-12, "should lead from the pose to the result: " + std::to_string(worst));
  const Surface still =
    Rounded(turned, rest, { "", [](vtkSphericalStyleFilter* f) { f->SetRoundness(0.0); } });
  check(SamePoints(still, turned), "without Roundness the pose should stay, to the bit");
}

void IsRefused(
  Checker& check, const std::string& about, vtkPolyData* model, vtkPolyData* rest,
  const std::vector<std::string>& words,
  const std::function<void(vtkSphericalStyleFilter*)>& set = [](vtkSphericalStyleFilter*) {})
{
  check.About(about);
  WatchedDefaults filter(model);
  filter->SetRestPoseData(rest);
  set(filter.Get());
  vtkPolyData* output = filter.Output();
  if (check(filter.Errors.size() == 1, "there should be one error"))
  {
    for (const std::string& word : words)
    {
      check(Contains(filter.Errors[0], word),
        "the error should say \"" + word + "\" and says " + filter.Errors[0]);
    }
  }
  check(output->GetNumberOfPoints() == 0, "the output should be empty");
  filter->SetRestPoseData(nullptr);
  filter->AvoidSelfIntersectionsOff();
  filter->SetSphericalWeightingToCotangent();
  filter.Errors.clear();
  filter.Output();
  check(Contains(about, "model is not finite") || filter.Errors.empty(),
    "should work again without it");
}

void RefusesWhatIsNoPose(Checker& check)
{
  const Surface model = Body();
  const Surface other = MakeEllipsoid({ 1.0, 1.5, 0.8 }, Faces::Triangles, 40, 39);
  IsRefused(check, "other points", model, other,
    { std::to_string(other->GetNumberOfPoints()), std::to_string(model->GetNumberOfPoints()),
      "same surface" });
  Surface turned = Surface::New();
  turned->DeepCopy(model);
  turned->ReverseCell(17);
  IsRefused(check, "other cells", model, turned, { "the first is cell 17", "same surface" });
  const auto spoiled = [&](vtkIdType point)
  {
    Surface result = Surface::New();
    result->DeepCopy(model);
    result->GetPoints()->SetPoint(point, 0.0, std::numeric_limits<double>::quiet_NaN(), 0.0);
    return result;
  };
  IsRefused(check, "the rest pose is not finite", model, spoiled(11), { "11", "finite" });
  IsRefused(check, "the model is not finite", spoiled(12), model, { "12", "finite" });
  IsRefused(check, "no folds", model, model, { "AvoidSelfIntersections" },
    [](vtkSphericalStyleFilter* f) { f->AvoidSelfIntersectionsOn(); });
  IsRefused(check, "the energy", model, model, { "closed form" },
    [](vtkSphericalStyleFilter* f) { f->SetSphericalWeightingToUniform(); });
}
}

int TestSphericalStyleFilterRestPose(int argc, char* argv[])
{
  Checker check;
  // In its creases details give way.
  const Surface creature = WithPointsOf(ReadModel(argc, argv, "creature.vtp"), VTK_DOUBLE);
  for (const Setting& setting : Settings())
  {
    StaysAtRest(check, setting);
    TurnsWithTheModel(check, setting, Body());
  }
  TurnsWithTheModel(check, Settings().front(), creature);
  vtkNew<vtkCubeSource> cube; // coarse: edges are split as at rest
  cube->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  cube->Update();
  TurnsWithTheModel(check, Settings().front(), cube->GetOutput());
  DoesNotJitter(check);
  MovesByItsDisplacement(check);
  RefusesWhatIsNoPose(check);
  return check.Result();
}
