// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Symmetry: the plane is found however a model lies, mirror images stay mirror images, what is on
/// one side only stays there, and what cannot be is said.
#include "ArrayTesting.h"

#include <vtkFieldData.h>
#include <vtkReverseSense.h>
#include <vtkTable.h>
#include <vtkTransform.h>

using namespace FilterTesting;

namespace
{
using Filter = vtkSphericalStyleFilter;

std::string Figure(double number)
{
  return vtkVariant(number).ToString();
}

/// Symmetric where x changes its sign, but for the bump.
Surface Body(double bump)
{
  return Mapped(MakeEllipsoid({ 1.0, 0.4, 0.3 }, Faces::Triangles, 64, 47),
    [&](const Vector& p)
    {
      const double square = p[0] * p[0];
      const double away = (p[0] - 0.85) / 0.06;
      return Vector{ p[0], p[1] * (1.0 + 0.5 * square) + 0.3 * square,
        p[2] * (1.0 + 0.1 * std::sin(20.0 * p[1])) + 0.4 * square + bump * std::exp(-away * away) };
    });
}

/// The point of the body that is nearest to the mirror image of each.
std::vector<vtkIdType> Twins(vtkPolyData* body)
{
  std::vector<vtkIdType> twins;
  for (vtkIdType i = 0; i < body->GetNumberOfPoints(); ++i)
  {
    Vector image = PointOf(body, i);
    image[0] = -image[0];
    vtkIdType nearest = 0;
    for (vtkIdType j = 1; j < body->GetNumberOfPoints(); ++j)
    {
      if (Distance(image, PointOf(body, j)) < Distance(image, PointOf(body, nearest)))
      {
        nearest = j;
      }
    }
    twins.push_back(nearest);
  }
  return twins;
}

struct Plane
{
  Vector origin;
  Vector normal;

  Vector Mirror(const Vector& p) const
  {
    double along = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      along += this->normal[k] * (p[k] - this->origin[k]);
    }
    Vector image = p;
    for (int k = 0; k < 3; ++k)
    {
      image[k] -= 2.0 * along * this->normal[k];
    }
    return image;
  }
};

/// That of the field data.
Plane PlaneOf(Filter* filter)
{
  vtkDataArray* array = vtkTable::SafeDownCast(filter->GetOutputDataObject(1))
                          ->GetFieldData()
                          ->GetArray("SymmetryPlane");
  return array ? Plane{ TupleOf(array, 0), TupleOf(array, 1) } : Plane{};
}

/// Turned, moved and scaled, with the plane x = 0.
std::pair<Surface, Plane> Placed(vtkPolyData* body, double angle)
{
  vtkNew<vtkTransform> transform;
  transform->Translate(3.0, -2.0, 5.0);
  transform->RotateWXYZ(angle, 0.3, 0.5, 0.7);
  transform->Scale(2.0, 2.0, 2.0);
  const auto apply = [&](const Vector& p)
  {
    Vector q;
    transform->TransformPoint(p.data(), q.data());
    return q;
  };
  Plane plane;
  plane.origin = apply({ 0.0, 0.1, 0.2 });
  const Vector tip = apply({ 0.5, 0.1, 0.2 });
  for (int k = 0; k < 3; ++k)
  {
    plane.normal[k] = tip[k] - plane.origin[k];
  }
  return { Mapped(body, apply), plane };
}

/// Of points that no bump is near.
double Asymmetry(
  vtkPolyData* result, vtkPolyData* body, const std::vector<vtkIdType>& twins, const Plane& plane)
{
  double most = 0.0;
  for (vtkIdType i = 0; i < result->GetNumberOfPoints(); ++i)
  {
    if (std::abs(PointOf(body, i)[0]) < 0.4)
    {
      most = std::max(most, Distance(plane.Mirror(PointOf(result, i)), PointOf(result, twins[i])));
    }
  }
  return most / Diagonal(result);
}

/// What its plane x = 0 is taken for, and how much that is off: direction and place.
std::pair<double, double> ErrorOfPlane(Filter* filter, const Plane& plane, double diagonal)
{
  const Plane found = PlaneOf(filter);
  double cosine = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    cosine += found.normal[k] * plane.normal[k];
  }
  double lean = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    lean = std::max(lean, std::abs(std::copysign(1.0, cosine) * found.normal[k] - plane.normal[k]));
  }
  return { lean, Distance(plane.Mirror(found.origin), found.origin) / diagonal };
}

/// Two bodies, one the mirror image of the other to the last bit.
void FindsItExactly(Checker& check)
{
  const Surface body = Shifted(Body(0.3), { 1.2, 0.0, 0.0 });
  vtkNew<vtkReverseSense> reverse;
  reverse->SetInputData(Mapped(body, [](const Vector& p) { return Vector{ -p[0], p[1], p[2] }; }));
  reverse->Update();
  const Surface both = Together({ body, reverse->GetOutput() });
  const vtkIdType n = body->GetNumberOfPoints();
  for (const double angle : { 0.0, 33.0, 90.0, 200.0 })
  {
    check.About("both sides, turned by " + Figure(angle));
    const auto [model, plane] = Placed(both, angle);
    Watched<Filter> filter(model);
    filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    filter->SetSymmetryToAutomatic();
    vtkPolyData* output = filter.Output();
    const auto [lean, distance] = ErrorOfPlane(filter.Get(), plane, Diagonal(model));
    check.AtMost(lean, 1e-9, "difference of the normals");
    check.AtMost(distance, 1e-9, "distance of the planes");
    double most = 0.0;
    for (vtkIdType i = 0; i < n; ++i)
    {
      most = std::max(most, Distance(plane.Mirror(PointOf(output, i)), PointOf(output, n + i)));
    }
    check.AtMost(most / Diagonal(model), 1e-9, "asymmetry");
  }
}

/// The diagonals of its quadrilaterals are no mirror images.
void FindsThePlane(Checker& check)
{
  const Surface symmetric = Body(0.0);
  const std::vector<vtkIdType> twins = Twins(symmetric);
  for (const double bump : { 0.0, 0.3 })
  {
    const Surface body = Body(bump);
    for (const double angle : { 0.0, 33.0, 90.0, 200.0 })
    {
      check.About("bump " + Figure(bump) + " turned by " + Figure(angle));
      const auto [model, plane] = Placed(body, angle);
      Watched<Filter> filter(model);
      filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
      const double without = Asymmetry(filter.Output(), body, twins, plane);
      check(PlaneOf(filter.Get()).normal == Vector{}, "without symmetry there should be no plane");
      filter->SetSymmetryToAutomatic();
      filter.Output();
      check(filter.Errors.empty() && filter.Warnings.empty(), "it should say nothing");
      const auto [lean, distance] = ErrorOfPlane(filter.Get(), plane, Diagonal(model));
      check.AtMost(lean, bump > 0.0 ? 2e-3 : 2e-4, "difference of the normals");
      check.AtMost(distance, bump > 0.0 ? 2e-3 : 2e-5, "distance of the planes");
      if (bump > 0.0 || angle == 33.0)
      {
        check(without > 1e-5, "without, the result should not be symmetric: " + Figure(without));
      }
    }
  }
}

/// Across an axis only the place is looked for.
void AcrossAnAxis(Checker& check)
{
  const Surface body = Shifted(Body(0.3), { 0.7, 0.0, 0.0 });
  const std::vector<vtkIdType> twins = Twins(Body(0.0));
  Watched<Filter> filter(body);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  for (int axis = 0; axis < 3; ++axis)
  {
    check.About("across " + Text(axis));
    filter->SetSymmetry(Filter::ACROSS_X + axis);
    vtkPolyData* output = filter.Output();
    const Plane found = PlaneOf(filter.Get());
    for (int k = 0; k < 3; ++k)
    {
      check(found.normal[k] == (k == axis ? 1.0 : 0.0), "the normal should be the axis");
    }
    if (axis == 0)
    {
      check.AtMost(std::abs(found.origin[0] - 0.7), 5e-3, "difference of the places");
      // The body is symmetric about x = .7, and the deformation about the plane that was found.
      const double off = std::abs(found.origin[0] - 0.7) / Diagonal(body);
      check.AtMost(Asymmetry(output, Body(0.0), twins, found), 4.0 * off + 1e-12, "asymmetry");
    }
  }
}

/// Three arms without a symmetry.
Surface Screw()
{
  return Mapped(MakeEllipsoid({ 1.0, 1.0, 1.0 }, Faces::Triangles, 24, 161),
    [](const Vector& p)
    {
      const double along = 10.0 * std::acos(std::clamp(p[2], -1.0, 1.0)) / 3.14159265;
      const double thick = 0.22 * std::sqrt(std::max(0.0, 1.0 - p[2] * p[2]));
      const double angle = std::atan2(p[1], p[0]);
      const double radius = 1.0 + 0.2 * along + thick * std::cos(angle);
      return Vector{ radius * std::cos(along), radius * std::sin(along),
        0.35 * along + thick * std::sin(angle) };
    });
}

void Says(Checker& check)
{
  const Surface body = Body(0.2);
  const auto expectError =
    [&](const char* word, vtkPolyData* model, const std::function<void(Filter*)>& change)
  {
    check.About(word);
    Watched<Filter> filter(model);
    filter->SetSymmetryToAutomatic();
    change(filter.Get());
    vtkPolyData* output = filter.Output();
    check(filter.Errors.size() == 1 && Contains(filter.Errors[0], word),
      "the error should name it" + Joined(filter.Errors));
    check(output->GetNumberOfPoints() == 0, "nothing should come out");
  };
  expectError("there is no plane of symmetry", Screw(), [](Filter*) {});
  expectError("AvoidSelfIntersections", body, [](Filter* f) { f->AvoidSelfIntersectionsOn(); });
  expectError("ReproduceThesis", body, [](Filter* f) { f->ReproduceThesisOn(); });
  expectError("closed form", body, [](Filter* f) { f->SetSphericalWeightingToUniform(); });
  expectError("rest pose", body, [&](Filter* f) { f->SetRestPoseData(body); });
  const Surface parts = Surface::New();
  parts->DeepCopy(body);
  parts->GetPointData()->AddArray(MakeArray(
    "part", parts, 1, [&](vtkIdType i, int) { return PointOf(body, i)[1] > 0.0 ? 1.0 : 0.0; }));
  expectError(
    "center id", parts, [](Filter* f) { f->SetInputArrayToProcess(5, 0, 0, OfPoints, "part"); });

  check.About("warnings");
  Watched<Filter> filter(body);
  filter->SetInputData(Screw());
  filter->SetSymmetryToX();
  filter.Output();
  check(filter.Warnings.size() == 1 && Contains(filter.Warnings[0], "across this axis, only "),
    "a plane without a symmetry" + Joined(filter.Warnings));
  filter.Warnings.clear();
  filter->SetInputData(Body(0.0));
  filter->SetCenterModeToCustom();
  filter->SetCenter(0.25, 0.1, 0.0);
  filter.Output();
  check(filter.Warnings.size() == 1 && Contains(filter.Warnings[0], "Center is 0.2"),
    "a center off the plane" + Joined(filter.Warnings));
  check.AtMost(std::abs(filter->GetEffectiveCenter()[0]), 1e-4, "distance of the center");
  check.AtMost(std::abs(filter->GetEffectiveCenter()[1] - 0.1), 1e-12, "move along the plane");
}
}

int TestSphericalStyleFilterSymmetry(int, char*[])
{
  Checker check;
  FindsItExactly(check);
  FindsThePlane(check);
  AcrossAnAxis(check);
  Says(check);
  return check.Result();
}
