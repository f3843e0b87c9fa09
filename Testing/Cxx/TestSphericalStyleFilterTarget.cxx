// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Target: a model becomes the shape that it is drawn toward, shapes turn with the model, and what
/// cannot be is said.
#include "ArrayTesting.h"

#include <vtkCubeSource.h>
#include <vtkPlaneSource.h>
#include <vtkTransform.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace FilterTesting;

namespace
{
using Filter = vtkSphericalStyleFilter;

constexpr std::array<double, 3> Lengths = { 1.0, 2.0, 0.7 };
constexpr double Edges = 0.4;

struct Shape
{
  int target;
  const char* name;
  /// Below 0 inside of the shape with these half lengths, above 0 outside.
  std::function<double(const Vector&)> level;
};

/// Distance from what is within rho of a box of these half lengths.
double FromRoundedBox(const Vector& x, const Vector& inner, double rho)
{
  double outside = 0.0;
  double inside = -INFINITY;
  for (int k = 0; k < 3; ++k)
  {
    const double beyond = std::abs(x[k]) - inner[k];
    outside = std::hypot(outside, std::max(beyond, 0.0));
    inside = std::max(inside, beyond);
  }
  return outside + std::min(inside, 0.0) - rho;
}

std::vector<Shape> Shapes()
{
  constexpr double radius = 0.5 * (Lengths[0] + Lengths[2]); // of what lies along y
  constexpr double rho = Edges * radius;
  constexpr double rhoOfBox = Edges * Lengths[2];
  const auto quadric = [](double power)
  {
    return [power](const Vector& x)
    {
      double sum = 0.0;
      for (int k = 0; k < 3; ++k)
      {
        sum += std::pow(std::abs(x[k]) / Lengths[k], power);
      }
      return std::pow(sum, 1.0 / power) - 1.0;
    };
  };
  return { { Filter::ELLIPSOID, "ellipsoid", quadric(2.0) },
    { Filter::SUPERQUADRIC, "superquadric", quadric(2.0 / Edges) },
    { Filter::CAPSULE, "capsule",
      [](const Vector& x) {
        return FromRoundedBox(x, { 0.0, Lengths[1] - radius, 0.0 }, radius);
      } },
    { Filter::CYLINDER, "cylinder",
      [](const Vector& x)
      {
        return FromRoundedBox(
          { std::hypot(x[0], x[2]), x[1], 0.0 }, { radius - rho, Lengths[1] - rho, 0.0 }, rho);
      } },
    { Filter::ROUNDED_BOX, "rounded box",
      [](const Vector& x)
      {
        return FromRoundedBox(
          x, { Lengths[0] - rhoOfBox, Lengths[1] - rhoOfBox, Lengths[2] - rhoOfBox }, rhoOfBox);
      } } };
}

/// By how much x has to shrink to lie on the shape.
double SizeOf(const Shape& shape, const Vector& x)
{
  double low = 1e-6;
  double high = 1e6;
  for (int k = 0; k < 200; ++k)
  {
    const double middle = std::sqrt(low * high);
    const double level = shape.level({ x[0] / middle, x[1] / middle, x[2] / middle });
    (level > 0.0 ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

/// Nothing but the target: neither details nor limbs nor another size.
void SetUpShape(Filter* filter)
{
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->SetRoundness(1e300);
  filter->SetNormalBlend(0.0);
  filter->SetDetailSize(0.0);
  filter->SetKeepSizeToOff();
  filter->SetCenterModeToCustom();
  filter->SetCenter(0.1, 0.05, 0.0);
  filter->SetTargetEdges(Edges);
}

Surface Body()
{
  return Mapped(MakeEllipsoid({ 1.0, 0.6, 0.4 }, Faces::Triangles, 40, 29),
    [](const Vector& p) {
      return Vector{ p[0], p[1] + 0.2 * p[0] * p[0], p[2] };
    });
}

/// The output is moved so that the mean stays, so positions are compared with the directions.
void BecomesTheShape(Checker& check)
{
  for (const Shape& shape : Shapes())
  {
    check.About(shape.name);
    Watched<Filter> filter(Body());
    SetUpShape(filter.Get());
    filter->SetTarget(shape.target);
    filter->SetTargetLengths(Lengths[0], Lengths[1], Lengths[2]);
    vtkPolyData* output = filter.Output();
    check(filter.Errors.empty() && filter.Warnings.empty(),
      "it should say nothing" + Joined(filter.Errors) + Joined(filter.Warnings));
    vtkDataArray* t = PointArray(output, "TargetDirection");
    const double radius = filter->GetEffectiveRadius();
    const double size = SizeOf(shape, TupleOf(t, 0));
    const auto moved = [&](vtkIdType i)
    {
      const Vector p = PointOf(output, i);
      const Vector toward = TupleOf(t, i);
      return Vector{ p[0] - radius * toward[0], p[1] - radius * toward[1],
        p[2] - radius * toward[2] };
    };
    double residual = 0.0;
    double spread = 0.0;
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      const Vector x = TupleOf(t, i);
      residual =
        std::max(residual, std::abs(shape.level({ x[0] / size, x[1] / size, x[2] / size })));
      spread = std::max(spread, Distance(moved(i), moved(0)));
    }
    check.AtMost(residual, 1e-9, "residual of the equation");
    check.AtMost(spread, 1e-9, "distance of the result from the target");
    // The third output is drawn on the shape, about the center.
    vtkPolyData* lines = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(2));
    double off = 0.0;
    for (vtkIdType i = 0; i < lines->GetNumberOfPoints(); ++i)
    {
      const Vector p = PointOf(lines, i);
      const double unit = radius * size;
      off = std::max(
        off, std::abs(shape.level({ (p[0] - 0.1) / unit, (p[1] - 0.05) / unit, p[2] / unit })));
    }
    check.AtMost(off, 1e-9, "distance of the lines from the target");
  }
}

void BecomesTheMesh(Checker& check)
{
  check.About("mesh");
  vtkNew<vtkCubeSource> cube;
  cube->SetCenter(10.0, 20.0, 30.0);
  Watched<Filter> filter(Body());
  SetUpShape(filter.Get());
  filter->SetTargetToMesh();
  filter->SetTargetMeshConnection(cube->GetOutputPort());
  vtkPolyData* output = filter.Output();
  check(filter.Errors.empty(), "it should be taken" + Joined(filter.Errors));
  const auto halfLengths = [&]
  {
    Vector most = { 0.0, 0.0, 0.0 };
    vtkDataArray* t = PointArray(filter.Output(), "TargetDirection");
    double residual = 0.0;
    for (vtkIdType i = 0; i < t->GetNumberOfTuples(); ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        most[k] = std::max(most[k], std::abs(TupleOf(t, i)[k]));
      }
    }
    for (vtkIdType i = 0; i < t->GetNumberOfTuples(); ++i)
    {
      double largest = 0.0;
      for (int k = 0; k < 3; ++k)
      {
        largest = std::max(largest, std::abs(TupleOf(t, i)[k]) / most[k]);
      }
      residual = std::max(residual, std::abs(largest - 1.0));
    }
    check.AtMost(residual, 1e-9, "distance from the sides");
    return most;
  };
  check(output->GetNumberOfPoints() > 0, "there should be a result");
  // Six sides, 2 h long, with the area of the unit sphere.
  const double h = std::sqrt(3.14159265358979 / 6.0);
  check.AtMost(Distance(halfLengths(), { h, h, h }), 1e-9, "difference of the half lengths");
  // Another mesh is another target.
  cube->SetXLength(2.0);
  const Vector longer = halfLengths();
  check.AtMost(std::abs(longer[0] / longer[1] - 2.0), 1e-9, "ratio of the longer cube");
}

/// With proportions of the model, the target turns and scales with it.
void FollowsTheModel(Checker& check)
{
  vtkNew<vtkTransform> transform; // no axis comes near another one
  transform->RotateWXYZ(40.0, 1.0, 1.0, -2.0);
  const auto apply = [&](const Vector& p)
  {
    Vector q;
    transform->TransformPoint(p.data(), q.data());
    return q;
  };
  const Surface body = Mapped(Body(), apply);
  transform->Identity(); // now to other axes
  transform->Translate(3.0, -2.0, 5.0);
  transform->RotateWXYZ(120.0, 1.0, 1.0, 1.0);
  transform->Scale(2.0, 2.0, 2.0);
  for (const Shape& shape : Shapes())
  {
    check.About(std::string(shape.name) + " of the model");
    const auto rounded = [&](vtkPolyData* model)
    {
      Watched<Filter> filter(model);
      filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
      filter->SetDetailSize(0.0);
      filter->SetNormalBlend(0.3);
      filter->SetTarget(shape.target);
      Surface result = Surface::New();
      result->DeepCopy(filter.Output());
      check(filter.Errors.empty(), "it should be taken" + Joined(filter.Errors));
      return result;
    };
    const Surface body = Body();
    check.AtMost(
      LargestDistance(Mapped(rounded(body), apply), rounded(Mapped(body, apply))) / Diagonal(body),
      1e-9, "difference between turned before and after");
  }
}

/// The energy has the same minimum where the closed form knows it.
void MinimizesToo(Checker& check)
{
  check.About("energy");
  const Surface body = Body();
  const auto rounded = [&](bool energy)
  {
    Watched<Filter> filter(body);
    filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    filter->SetDetailSize(0.0);
    filter->SetNormalBlend(0.0);
    filter->SetKeepSizeToOff();
    filter->SetTargetToRoundedBox();
    if (energy)
    {
      filter->SetStopRuleToFixedIterations();
      filter->SetMaximumNumberOfIterations(400);
    }
    Surface result = Surface::New();
    result->DeepCopy(filter.Output());
    check(filter.Errors.empty(), "it should be taken" + Joined(filter.Errors));
    return result;
  };
  check.AtMost(LargestDistance(rounded(false), rounded(true)), 1e-3, "difference of the minimum");
}

void StaysSymmetric(Checker& check)
{
  check.About("symmetric");
  Watched<Filter> filter(Body());
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->SetTargetToRoundedBox();
  filter->SetSymmetryToZ();
  filter.Output();
  check(filter.Errors.empty(), "both should go together" + Joined(filter.Errors));
}

void Says(Checker& check)
{
  const auto expectError = [&](const char* word, const std::function<void(Filter*)>& change)
  {
    check.About(word);
    Watched<Filter> filter(Body());
    change(filter.Get());
    vtkPolyData* output = filter.Output();
    check(filter.Errors.size() == 1 && Contains(filter.Errors[0], word),
      "the error should name it" + Joined(filter.Errors));
    check(output->GetNumberOfPoints() == 0, "nothing should come out");
  };
  const auto withMesh = [&](const char* word, vtkPolyData* mesh)
  {
    expectError(word,
      [&](Filter* f)
      {
        f->SetTargetToMesh();
        f->SetTargetMeshData(mesh);
      });
  };
  expectError("Target Mesh needs a mesh", [](Filter* f) { f->SetTargetToMesh(); });
  expectError("TargetLengths must be", [](Filter* f) { f->SetTargetLengths(1.0, 0.0, 1.0); });
  expectError("TargetLengths must be", [](Filter* f) { f->SetTargetLengths(1.0, -1.0, 1.0); });
  expectError("TargetLengths must be", [](Filter* f) { f->SetTargetLengths(1.0, NAN, 1.0); });
  for (const double shortest : { 0.0999, 0.1 })
  {
    check.About("a short target");
    Watched<Filter> filter(Body());
    filter->SetTargetToEllipsoid();
    filter->SetTargetLengths(1.0, 1.0, shortest);
    filter.Output();
    check(filter.Warnings.size() == (shortest < 0.1 ? 1 : 0),
      "the warning of a length below a tenth" + Joined(filter.Warnings));
    filter.Warnings.clear();
    filter->SetTargetToSphere();
    filter.Output();
    check(filter.Warnings.empty(), "the sphere has no lengths" + Joined(filter.Warnings));
  }
  expectError("ReproduceThesis",
    [](Filter* f)
    {
      f->SetTargetToCapsule();
      f->ReproduceThesisOn();
    });
  const Surface banana = Mapped(MakeEllipsoid({ 1.0, 0.2, 0.2 }),
    [](const Vector& p) {
      return Vector{ p[0], p[1] + 2.0 * p[0] * p[0], p[2] };
    });
  withMesh("TargetMesh is not star-shaped: its cell ", banana);
  withMesh("is not seen from its centroid (", banana);
  vtkNew<vtkPlaneSource> sheet;
  sheet->Update();
  withMesh("TargetMesh: it is open", sheet->GetOutput());
  const Surface broken = Body();
  broken->GetPoints()->SetPoint(3, NAN, 0.0, 0.0);
  withMesh("TargetMesh: Points: point 3 is not finite", broken);

  check.About("directions");
  const Surface body = Body();
  body->GetPointData()->AddArray(
    MakeArray("toward", body, 3, [&](vtkIdType i, int k) { return PointOf(body, i)[k]; }));
  Watched<Filter> filter(body);
  filter->SetInputArrayToProcess(3, 0, 0, OfPoints, "toward");
  filter->SetTargetToCapsule();
  filter.Output();
  check(filter.Errors.size() == 1 && Contains(filter.Errors[0], "target directions"),
    "directions and a shape" + Joined(filter.Errors));
  check.About("unused mesh");
  Watched<Filter> unused(Body());
  unused->SetTargetMeshData(Body());
  unused.Output();
  check(unused.Warnings.size() == 1 && Contains(unused.Warnings[0], "TargetMesh has no effect"),
    "a mesh that is not used" + Joined(unused.Warnings));
}
}

int TestSphericalStyleFilterTarget(int, char*[])
{
  Checker check;
  BecomesTheShape(check);
  BecomesTheMesh(check);
  FollowsTheModel(check);
  MinimizesToo(check);
  StaysSymmetric(check);
  Says(check);
  return check.Result();
}
