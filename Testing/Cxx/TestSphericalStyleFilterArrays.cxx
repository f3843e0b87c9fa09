// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// What comes in with the points goes out with them; what the filter adds is what its formulas say,
/// evaluated here a second time; what it takes as arrays does what the property does.
#include "ArrayTesting.h"
#include "FilterTesting.h"

#include "vtkPolyDataNormals.h"
#include "vtkTable.h"

#include <set>

using namespace FilterTesting;

namespace
{
/// Tolerance for two evaluations of one formula in double, relative to its size.
constexpr double Rounding = 1e-12;

Vector Minus(const Vector& x, const Vector& y)
{
  return { x[0] - y[0], x[1] - y[1], x[2] - y[2] };
}

double Dot(const Vector& x, const Vector& y)
{
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

Vector Cross(const Vector& x, const Vector& y)
{
  return { x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0] };
}

double Length(const Vector& x)
{
  return std::sqrt(Dot(x, x));
}

Vector Times(double a, const Vector& x)
{
  return { a * x[0], a * x[1], a * x[2] };
}

Vector Plus(const Vector& x, const Vector& y)
{
  return { x[0] + y[0], x[1] + y[1], x[2] + y[2] };
}

void EveryArray(Checker& check, vtkPolyData* icosahedron)
{
  check.About("arrays of the input");
  auto input = Surface::New();
  input->DeepCopy(icosahedron);
  AddArrays(input);
  const vtkIdType n = input->GetNumberOfPoints();
  input->SetVerts(MakeCells({ { 3 }, { n - 1 } }));
  input->SetLines(MakeCells({ { 1, 2, 3 } }));
  vtkCellData* cells = input->GetCellData();
  for (int i = 0; i < cells->GetNumberOfArrays(); ++i) // three cells more
  {
    cells->GetAbstractArray(i)->Resize(input->GetNumberOfCells());
    cells->GetAbstractArray(i)->SetNumberOfTuples(input->GetNumberOfCells());
  }
  check(input->GetPointData()->GetTCoords(), "the model should have texture coordinates");
  WatchedDefaults filter(input);
  vtkPolyData* output = filter.Output();
  check(SameCells(input, output), "cells should come out byte for byte");
  CheckPassedOn(check, input->GetPointData(), output->GetPointData(), "my normals");
  CheckPassedOn(check, input->GetCellData(), output->GetCellData(), "");
  CheckPassedOn(check, input->GetFieldData(), output->GetFieldData(), "");
  check(SameActiveAttributes(input->GetPointData(), output->GetPointData()),
    "active point attributes should stay active");
  check(SameActiveAttributes(input->GetCellData(), output->GetCellData()),
    "active cell attributes should stay active");
  check(
    output->GetPointData()->GetNumberOfArrays() == input->GetPointData()->GetNumberOfArrays() + 2,
    "only TargetDirection and Displacement should be new");

  check.About("point order");
  vtkDataArray* displacement = output->GetPointData()->GetArray("Displacement");
  double largest = 0.0;
  for (vtkIdType i = 0; i < n; ++i)
  {
    const Vector moved = Plus(PointOf(input, i), TupleOf(displacement, i));
    largest = std::max(largest, Distance(moved, PointOf(output, i)));
  }
  check.AtMost(largest, 1e-6 * Diagonal(input), "input + Displacement - output");

  check.About("no attribute is active");
  auto plain = Surface::New();
  plain->DeepCopy(icosahedron);
  for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
  {
    plain->GetPointData()->SetActiveAttribute(-1, type);
  }
  filter->SetInputData(plain);
  check(SameActiveAttributes(plain->GetPointData(), filter.Output()->GetPointData()),
    "none should become active");
}

/// The default of the switches, and each of them turned.
void Switches(Checker& check)
{
  check.About("switches of the output arrays");
  WatchedDefaults filter(MakeEllipsoid({ 1.0, 0.8, 2.0 }));
  const auto has = [&](const char* name)
  { return filter.Output()->GetPointData()->HasArray(name); };
  check(has("TargetDirection") && has("Displacement"), "two arrays should be there by default");
  check(!has("Normals") && !has("CellEnergy") && !has("Rotation"), "others should be absent");
  check(!filter.Output()->GetPointData()->GetNormals(), "there should be no normals");
  filter->GenerateDisplacementOff();
  check(filter.Output()->GetPointData()->GetNumberOfArrays() == 1 && has("TargetDirection"),
    "all off: one array");
  filter->GenerateNormalsOn();
  check(filter.Output()->GetPointData()->GetNumberOfArrays() == 2 && has("Normals") &&
      filter.Output()->GetPointData()->GetNormals(),
    "GenerateNormals should add active normals");
  filter->GenerateRotationOn();
  const auto components = [&](const char* name)
  {
    return has(name) ? filter.Output()->GetPointData()->GetArray(name)->GetNumberOfComponents() : 0;
  };
  check(components("Rotation") == 9, "rotation should have 9 components");
  filter->SetSphericalWeightingToUniform();
  filter->GenerateCellEnergyOn();
  check(components("CellEnergy") == 1 && components("Rotation") == 9,
    "energy should have 1 component and rotation 9");
}

/// There is no energy in a closed form, and no trace of the last one.
void NoEnergy(Checker& check)
{
  check.About("no energy in a closed form");
  WatchedDefaults filter(MakeEllipsoid({ 1.0, 0.8, 2.0 }));
  filter->SetSphericalWeightingToUniform();
  filter.Output();
  check(filter->GetFinalEnergy() > 0.0 && filter->GetNumberOfIterations() > 0, "the other has it");
  filter->SetSphericalWeightingToCotangent();
  filter->GenerateRotationOn();
  filter.Output();
  check(filter->GetFinalEnergy() == 0.0 && filter->GetNumberOfIterations() == 0 &&
      filter->GetConverged(),
    "nothing iterates");
  auto* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
  check(table && table->GetNumberOfColumns() == 8 && table->GetNumberOfRows() == 0,
    "the table should have columns and no rows");
  for (const char* name : { "StageSeconds", "Spheres", "NumberOfStitches", "Advice" })
  {
    check(table->GetFieldData()->HasArray(name), std::string(name) + " should be there");
  }
  filter->GenerateCellEnergyOn();
  vtkPolyData* output = filter.Output();
  check(filter.Errors.empty() && output->GetNumberOfPoints() == 146, "it should work");
  check(!output->GetPointData()->HasArray("CellEnergy"), "there should be no CellEnergy");
  check(filter.Warnings.size() == 1 && Contains(filter.Warnings[0], "GenerateCellEnergy"),
    "a warning should say so" + Joined(filter.Warnings));
  filter->SetInitialGuessToRest();
  check(
    filter.Output()->GetPointData()->HasArray("CellEnergy"), "with an energy it should be back");
}

//------------------------------------------------------------------------------------------------
/// Unit normals weighted by angles. Points at one place whose `before` are equal (or all of them,
/// without it) have one normal.
std::vector<Vector> NormalsOf(vtkPolyData* surface, vtkPolyData* rest, vtkDataArray* before)
{
  using Key = std::pair<Vector, Vector>;
  const auto keyOf = [&](vtkIdType i) {
    return Key(PointOf(rest, i), before ? TupleOf(before, i) : Vector{ 0.0, 0.0, 0.0 });
  };
  std::map<Key, Vector> sums;
  for (const auto& t : TriangleCorners(surface))
  {
    const Vector x[3] = { PointOf(surface, t[0]), PointOf(surface, t[1]), PointOf(surface, t[2]) };
    const Vector normal = Cross(Minus(x[1], x[0]), Minus(x[2], x[0]));
    for (int k = 0; k < 3; ++k)
    {
      const Vector a = Minus(x[(k + 1) % 3], x[k]);
      const Vector b = Minus(x[(k + 2) % 3], x[k]);
      const double angle = std::atan2(Length(Cross(a, b)), Dot(a, b));
      Vector& sum = sums.emplace(keyOf(t[k]), Vector{ 0.0, 0.0, 0.0 }).first->second;
      sum = Plus(sum, Times(angle / Length(normal), normal));
    }
  }
  std::vector<Vector> normals;
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    const Vector sum = sums[keyOf(i)];
    normals.push_back(Times(1.0 / Length(sum), sum));
  }
  return normals;
}

double LargestDifference(vtkDataArray* array, const std::vector<Vector>& expected)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    const double d = Distance(TupleOf(array, static_cast<vtkIdType>(i)), expected[i]);
    largest = d <= largest ? largest : d;
  }
  return largest;
}

void NormalsOfResult(Checker& check, vtkPolyData* cube, vtkPolyData* icosahedron)
{
  constexpr double Single = 1e-6; // normals are in single precision
  check.About("GenerateNormals");
  WatchedDefaults generating(icosahedron);
  generating->GenerateNormalsOn();
  generating->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkPolyData* output = generating.Output();
  check.AtMost(LargestDifference(
                 output->GetPointData()->GetNormals(), NormalsOf(output, icosahedron, nullptr)),
    Single, "difference to normals weighted by angles, one per place");

  check.About("smooth normals along a texture seam");
  auto smooth = Surface::New();
  smooth->DeepCopy(icosahedron);
  vtkNew<vtkDoubleArray> radial;
  radial->SetName("radial");
  radial->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < smooth->GetNumberOfPoints(); ++i)
  {
    radial->InsertNextTuple(PointOf(smooth, i).data());
  }
  smooth->GetPointData()->SetNormals(radial);
  WatchedDefaults filter(smooth);
  vtkDataArray* normals = filter.Output()->GetPointData()->GetNormals();
  if (check(normals && std::string(normals->GetName()) == "radial", "normals keep their name"))
  {
    for (const Cell& group : CoincidentPoints(icosahedron))
    {
      for (const vtkIdType i : group)
      {
        check(TupleOf(normals, group[0]) == TupleOf(normals, i),
          "points " + Text(group[0]) + " and " + Text(i) + " should share their normal");
      }
    }
  }

  check.About("creases");
  vtkNew<vtkPolyDataNormals> creases;
  creases->SetInputData(cube);
  creases->SplittingOn();
  creases->SetFeatureAngle(30.0);
  creases->Update();
  vtkPolyData* sharp = creases->GetOutput();
  vtkDataArray* before = sharp->GetPointData()->GetNormals();
  const std::vector<Cell> edges = CoincidentPoints(sharp);
  check(edges.size() > 8, "the test should have creases");
  WatchedDefaults filterOfSharp(sharp);
  filterOfSharp->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  output = filterOfSharp.Output();
  normals = output->GetPointData()->GetNormals();
  check.AtMost(LargestDifference(normals, NormalsOf(output, sharp, before)), Single,
    "difference to normals weighted by angles, one per place and normal before");
  for (const Cell& group : edges)
  {
    check(Dot(TupleOf(normals, group[0]), TupleOf(normals, group[1])) < 0.9,
      "points " + Text(group[0]) + " and " + Text(group[1]) + " should keep their crease");
    check(SamePoint(output, group[0], output, group[1]), "creases should stay closed");
  }

  check.About("normals of cells");
  creases->SplittingOff();
  creases->ComputePointNormalsOff();
  creases->ComputeCellNormalsOn();
  creases->Update();
  WatchedDefaults filterOfCells(creases->GetOutput());
  filterOfCells->SetRoundness(5.0);
  output = filterOfCells.Output();
  normals = output->GetCellData()->GetNormals();
  check(
    normals && !output->GetPointData()->GetNormals(), "cells should keep them, points have none");
  const auto corners = TriangleCorners(output);
  double largest = 0.0;
  for (vtkIdType c = 0; normals && c < output->GetNumberOfCells(); ++c)
  {
    const auto& t = corners[c];
    const Vector n = Cross(Minus(PointOf(output, t[1]), PointOf(output, t[0])),
      Minus(PointOf(output, t[2]), PointOf(output, t[0])));
    largest = std::max(largest, Distance(Times(1.0 / Length(n), n), TupleOf(normals, c)));
  }
  check.AtMost(largest, 1e-5, "difference to normals of the moved cells");
}

//------------------------------------------------------------------------------------------------
/// O and r of the defaults: mean of the places, sqrt(A / 4 pi).
void SphereOf(vtkPolyData* surface, Vector& center, double& radius)
{
  std::set<Vector> places;
  double area = 0.0;
  for (const auto& t : TriangleCorners(surface))
  {
    const Vector a = PointOf(surface, t[0]);
    const Vector b = PointOf(surface, t[1]);
    const Vector c = PointOf(surface, t[2]);
    places.insert({ a, b, c });
    area += 0.5 * Length(Cross(Minus(b, a), Minus(c, a)));
  }
  center = { 0.0, 0.0, 0.0 };
  for (const Vector& x : places)
  {
    center = Plus(center, Times(1.0 / static_cast<double>(places.size()), x));
  }
  radius = std::sqrt(area / (4.0 * vtkMath::Pi()));
}

void Directions(Checker& check, vtkPolyData* model, const char* name)
{
  Vector center;
  double radius;
  SphereOf(model, center, radius);
  const std::vector<Vector> normals = NormalsOf(model, model, nullptr);
  for (const double a : { 0.0, 0.5, 1.0 })
  {
    check.About(
      std::string("TargetDirection of ") + name + ", NormalBlend " + vtkVariant(a).ToString());
    WatchedEnergy filter(model);
    filter->SetNormalBlend(a);
    filter->SetCenterModeToPointMean();
    filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    vtkPolyData* output = filter.Output();
    std::vector<Vector> expected;
    for (vtkIdType i = 0; i < model->GetNumberOfPoints(); ++i)
    {
      const Vector d = Minus(PointOf(model, i), center);
      expected.push_back(Plus(Times((1.0 - a) / Length(d), d), Times(a, normals[i])));
    }
    check.AtMost(LargestDifference(output->GetPointData()->GetArray("TargetDirection"), expected),
      1e-10, "difference to (1 - a) d + a n");
    check.AtMost(Distance(Vector{ filter->GetEffectiveCenter()[0], filter->GetEffectiveCenter()[1],
                            filter->GetEffectiveCenter()[2] },
                   center),
      Rounding * Diagonal(model), "difference of EffectiveCenter to the mean of the places");
    check.AtMost(std::abs(filter->GetEffectiveRadius() / radius - 1.0), Rounding,
      "relative difference of EffectiveRadius to sqrt(A / 4 pi)");

    vtkDataArray* displacement = output->GetPointData()->GetArray("Displacement");
    double largest = 0.0;
    for (vtkIdType i = 0; i < model->GetNumberOfPoints(); ++i)
    {
      largest = std::max(
        largest, Distance(TupleOf(displacement, i), Minus(PointOf(output, i), PointOf(model, i))));
    }
    check.AtMost(largest, Rounding * Diagonal(model), "Displacement - (output - input)");
  }
}

/// With the thickness of limbs the normal in t is as long as a limb is thick, and at most r.
void ThickDirections(Checker& check, vtkPolyData* model, const char* name)
{
  Vector center;
  double radius;
  SphereOf(model, center, radius);
  const std::vector<Vector> normals = NormalsOf(model, model, nullptr);
  for (const double a : { 0.5, 1.0 })
  {
    check.About(
      std::string("thick TargetDirection of ") + name + ", blend " + vtkVariant(a).ToString());
    WatchedDefaults filter(model);
    filter->SetNormalBlend(a);
    filter->SetDetailSize(0.0);
    filter->SetCenterModeToPointMean();
    filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    vtkDataArray* t = filter.Output()->GetPointData()->GetArray("TargetDirection");
    double off = 0.0;
    double thinnest = HUGE_VAL;
    double thickest = 0.0;
    for (vtkIdType i = 0; i < model->GetNumberOfPoints(); ++i)
    {
      const Vector d = Minus(PointOf(model, i), center);
      const Vector ofNormal = Minus(TupleOf(t, i), Times((1.0 - a) / Length(d), d));
      const double share = Dot(ofNormal, normals[i]) / a;
      off = std::max(off, Distance(ofNormal, Times(a * share, normals[i])));
      thinnest = std::min(thinnest, share);
      thickest = std::max(thickest, share);
    }
    check.AtMost(off, 1e-10, "difference of t to (1 - a) d + a rho / r n");
    check(thinnest > 0.0, "every limb should have a thickness");
    check.AtMost(thickest, 1.0 + Rounding, "largest rho / r");
  }
}

/// Normals of the input take the place of computed ones, of any length.
void GivenNormals(Checker& check)
{
  check.About("normals of the input as directions");
  const Surface input = MakeEllipsoid({ 1.0, 0.8, 2.0 });
  vtkNew<vtkDoubleArray> normals;
  normals->SetName("elsewhere");
  normals->SetNumberOfComponents(3);
  std::vector<Vector> expected;
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    const Vector n = { std::sin(1.0 * i), std::cos(1.0 * i), 1.0 };
    normals->InsertNextTuple(Times(3.0, n).data());
    expected.push_back(Times(1.0 / Length(n), n));
  }
  WatchedEnergy filter(input);
  filter->SetNormalBlend(1.0);
  const Surface computed = MakeEllipsoid({ 1.0, 0.8, 2.0 });
  check.AtMost(LargestDifference(filter.Output()->GetPointData()->GetArray("TargetDirection"),
                 NormalsOf(computed, computed, nullptr)),
    1e-10, "without normals, difference to computed ones");
  input->GetPointData()->SetNormals(normals);
  check.AtMost(
    LargestDifference(filter.Output()->GetPointData()->GetArray("TargetDirection"), expected),
    Rounding, "active normals, difference to them at length 1");
  for (const char* unset : { "", "None" })
  {
    filter->SetInputArrayToProcess(0, 0, 0, OfPoints, unset);
    check.AtMost(
      LargestDifference(filter.Output()->GetPointData()->GetArray("TargetDirection"), expected),
      Rounding, "name unset again, difference to the active normals");
  }
  input->GetPointData()->SetActiveNormals(nullptr);
  input->GetPointData()->SetNormals(nullptr);
  input->GetPointData()->AddArray(normals);
  filter->SetInputArrayToProcess(0, 0, 0, OfPoints, "elsewhere");
  check.AtMost(
    LargestDifference(filter.Output()->GetPointData()->GetArray("TargetDirection"), expected),
    Rounding, "normals by name, difference to them at length 1");
  filter->SetInputArrayToProcess(0, 0, 0, OfPoints, "");
  check.AtMost(LargestDifference(filter.Output()->GetPointData()->GetArray("TargetDirection"),
                 NormalsOf(computed, computed, nullptr)),
    1e-10, "without them again, difference to computed ones");
}

//------------------------------------------------------------------------------------------------
struct Energies
{
  double rigid = 0.0;
  double spherical = 0.0;
  std::vector<double> ofPoint;
};

Vector Turned(vtkDataArray* rotations, vtkIdType i, const Vector& x, bool transposed)
{
  double r[9];
  rotations->GetTuple(i, r);
  Vector y = { 0.0, 0.0, 0.0 };
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      y[row] += (transposed ? r[3 * column + row] : r[3 * row + column]) * x[column];
    }
  }
  return y;
}

/// [energy], from what is on the output.
Energies EnergiesOf(vtkPolyData* input, vtkPolyData* output, double roundness, bool cotangent,
  double radius, bool transposed = false)
{
  vtkDataArray* rotations = output->GetPointData()->GetArray("Rotation");
  vtkDataArray* t = output->GetPointData()->GetArray("TargetDirection");
  Energies energies;
  energies.ofPoint.resize(input->GetNumberOfPoints());
  for (const auto& f : TriangleCorners(input))
  {
    for (int h = 0; h < 3; ++h)
    {
      const vtkIdType u = f[h];
      const vtkIdType v = f[(h + 1) % 3];
      const Vector opposite = PointOf(input, f[(h + 2) % 3]);
      const Vector a = Minus(PointOf(input, u), opposite);
      const Vector b = Minus(PointOf(input, v), opposite);
      const double c = 0.5 * Dot(a, b) / Length(Cross(a, b));
      const double l = cotangent ? std::sqrt(3.0) * roundness * c : 0.5 * roundness;
      const Vector rest = Minus(PointOf(input, u), PointOf(input, v));
      const Vector moved = Minus(PointOf(output, u), PointOf(output, v));
      const Vector target = Times(radius, Minus(TupleOf(t, u), TupleOf(t, v)));
      for (const vtkIdType y : f)
      {
        const Vector rigid = Minus(moved, Turned(rotations, y, rest, transposed));
        const Vector spherical = Minus(Turned(rotations, y, target, transposed), moved);
        energies.rigid += c * Dot(rigid, rigid);
        energies.spherical += l * Dot(spherical, spherical);
        energies.ofPoint[y] += c * Dot(rigid, rigid) + l * Dot(spherical, spherical);
      }
    }
  }
  return energies;
}

void RotationsAndEnergies(Checker& check, vtkPolyData* model)
{
  for (const double blend : { 0.0, 1.0 })
  {
    for (const bool cotangent : { false, true })
    {
      check.About(std::string("energies, NormalBlend ") + vtkVariant(blend).ToString() +
        (cotangent ? ", cotangent" : ", uniform"));
      WatchedEnergy filter(model);
      filter->SetRoundness(2.0);
      filter->SetNormalBlend(blend);
      filter->SetSphericalWeighting(cotangent);
      filter->SetInitialGuessToRest(); // so that rotations are not all the identity
      filter->SetStopRuleToFixedIterations();
      filter->SetMaximumNumberOfIterations(4);
      filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
      filter->GenerateCellEnergyOn();
      filter->GenerateRotationOn();
      vtkPolyData* output = filter.Output();
      vtkDataArray* rotations = output->GetPointData()->GetArray("Rotation");
      vtkDataArray* cells = output->GetPointData()->GetArray("CellEnergy");
      double worst = 0.0;
      double angle = 0.0;
      for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
      {
        double r[9];
        rotations->GetTuple(i, r);
        const Vector x = { r[0], r[1], r[2] };
        const Vector y = { r[3], r[4], r[5] };
        const Vector z = { r[6], r[7], r[8] };
        for (const double d : { Dot(Cross(x, y), z) - 1.0, Dot(x, x) - 1.0, Dot(y, y) - 1.0,
               Dot(z, z) - 1.0, Dot(x, y), Dot(y, z), Dot(z, x) })
        {
          worst = std::abs(d) <= worst ? worst : std::abs(d);
        }
        angle = std::max(angle, Distance(x, { 1.0, 0.0, 0.0 }));
      }
      check.AtMost(worst, 1e-9, "Rotation: determinant - 1, and rows from orthonormal ones");
      check(angle > 0.05, "some cells should turn");

      const double energy = filter->GetFinalEnergy();
      double sum = 0.0;
      for (vtkIdType i = 0; i < cells->GetNumberOfTuples(); ++i)
      {
        sum += cells->GetTuple1(i);
      }
      check.AtMost(std::abs(sum / energy - 1.0), 1e-10, "sum of CellEnergy / FinalEnergy - 1");
      const double radius = filter->GetEffectiveRadius();
      const Energies direct = EnergiesOf(model, output, 2.0, cotangent, radius);
      vtkTable* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
      const vtkIdType last = table->GetNumberOfRows() - 1;
      check.AtMost(std::abs((direct.rigid + direct.spherical) / energy - 1.0), 1e-9,
        "the formula evaluated on the output / FinalEnergy - 1");
      check.AtMost(std::abs(direct.rigid / table->GetValueByName(last, "Rigid").ToDouble() - 1.0),
        1e-9, "rigid part / column Rigid - 1");
      check.AtMost(
        std::abs(direct.spherical / table->GetValueByName(last, "Spherical").ToDouble() - 1.0),
        1e-9, "spherical part / column Spherical - 1");
      double largest = 0.0;
      for (std::size_t i = 0; i < direct.ofPoint.size(); ++i)
      {
        largest = std::max(
          largest, std::abs(direct.ofPoint[i] - cells->GetTuple1(static_cast<vtkIdType>(i))));
      }
      check.AtMost(largest, 1e-9 * energy, "difference of a CellEnergy to the formula");
      const Energies transposed = EnergiesOf(model, output, 2.0, cotangent, radius, true);
      check(transposed.rigid + transposed.spherical > (1.0 + 1e-6) * energy,
        "columns instead of rows should not fit");

      vtkSmartPointer<vtkDataArray> before = rotations;
      filter->SetKeepSizeToArea();
      output = filter.Output();
      check(SameArray(before, output->GetPointData()->GetArray("Rotation")),
        "KeepSize should not turn a cell");
      check(filter->GetFinalEnergy() == energy, "nor change the energy");
    }
  }
}

void History(Checker& check, vtkPolyData* model)
{
  const std::vector<std::string> columns = { "Iteration", "Total", "Rigid", "Spherical",
    "LocalChange", "GlobalChange", "Residual", "Gap" };
  for (const bool acceleration : { true, false })
  {
    check.About(std::string("history, acceleration ") + (acceleration ? "on" : "off"));
    WatchedEnergy filter(model);
    filter->SetAcceleration(acceleration);
    filter->SetInitialGuessToRest();
    filter->SetTolerance(1e-6);
    filter->SetMaximumNumberOfIterations(2000);
    filter.Output();
    vtkTable* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
    if (!check(table && table->GetNumberOfColumns() == 8, "there should be 8 columns"))
    {
      return;
    }
    for (int k = 0; k < 8; ++k)
    {
      check(
        columns[k] == table->GetColumnName(k), "column " + Text(k) + " should be " + columns[k]);
    }
    const auto value = [&](vtkIdType row, const char* column)
    { return table->GetValueByName(row, column).ToDouble(); };
    const vtkIdType rows = table->GetNumberOfRows();
    check(rows == filter->GetNumberOfIterations() + 1, "one row for the start, one per iteration");
    check(filter->GetConverged(), "it should converge");
    const double scale = value(0, "Total");
    for (vtkIdType i = 0; i < rows; ++i)
    {
      const std::string row = "row " + Text(i) + ": ";
      check(value(i, "Iteration") == static_cast<double>(i), row + "Iteration should count");
      check.AtMost(std::abs(value(i, "Rigid") + value(i, "Spherical") - value(i, "Total")),
        1e-12 * scale, row + "|Rigid + Spherical - Total|");
      if (i > 0)
      {
        check.AtMost(
          value(i, "Total") - value(i - 1, "Total"), 1e-12 * scale, row + "rise of Total");
        check.AtMost(std::abs(value(i, "Total") - value(i - 1, "Total") - value(i, "LocalChange") -
                       value(i, "GlobalChange")),
          1e-11 * scale, row + "|change of Total - LocalChange - GlobalChange|");
        check.AtMost(value(i, "LocalChange"), 1e-12 * scale, row + "LocalChange");
        check(value(i, "Residual") >= 0.0, row + "Residual should be 0 or more");
      }
      const double gap = value(i, "Gap");
      check(std::isnan(gap) || gap >= 0.0, row + "Gap should be 0 or more, or NaN");
    }
    check(std::isnan(value(0, "Gap")), "the gap should be unknown at the start");
    check(value(rows - 1, "Gap") <= 1e-6, "the last gap should be below Tolerance");
    check(value(rows - 1, "Total") == filter->GetFinalEnergy(), "the last Total is FinalEnergy");
  }
}

//------------------------------------------------------------------------------------------------
/// Other triangles inside: the output's cells are the input's, and the table tells of the flips.
void IntrinsicDelaunay(Checker& check)
{
  const Surface model = MakeEllipsoid({ 4.0, 0.2, 1.0 });
  WatchedEnergy filter(model);
  const auto count = [&](const char* name)
  {
    filter.Output();
    vtkDataArray* array = filter->GetOutputDataObject(1)->GetFieldData()->GetArray(name);
    return array ? array->GetComponent(0, 0) : -1.0;
  };
  check.About("EdgeWeighting");
  check(count("EdgeFlips") == -1.0, "half edges should not tell of flips");
  WatchedEnergy half(model);
  half->SetSphericalWeightingToUniform(); // cotangent weights have one minimum, the blend
  filter->SetSphericalWeightingToUniform();
  filter->SetEdgeWeightingToIntrinsicDelaunay();
  check(!SamePoints(filter.Output(), half.Output()),
    "IntrinsicDelaunay should change an obtuse ellipsoid");
  check(count("EdgeFlips") > 0.0, "flips should be told");
  check(count("NegativeEdges") == 0.0, "a closed surface should keep no negative edge");
  check(filter->GetConverged(), "it should converge");
  filter->SetSphericalWeightingToCotangent();
  filter.Output();
  check(filter->GetNumberOfIterations() == 0, "proportional weights should stay a closed form");
}

//------------------------------------------------------------------------------------------------
void Thesis(Checker& check, vtkPolyData* model)
{
  for (const double blend : { 0.0, 1.0 })
  {
    check.About("ReproduceThesis, NormalBlend " + vtkVariant(blend).ToString());
    WatchedFilter thesis(model);
    thesis->SetRoundness(0.5);
    thesis->SetNormalBlend(blend);
    thesis->ReproduceThesisOn();
    // What it overrides, with what is the default.
    thesis->SetRefineLongEdgesToOn();
    thesis->KeepOnGroundOn();
    thesis->SetKeepSizeToVolume();
    thesis->SetCenterModeToAreaCentroid();
    thesis->SetDetailSize(0.1);
    thesis->SetSphericalWeightingToCotangent();
    thesis->SetEdgeWeightingToIntrinsicDelaunay();
    WatchedEnergy byHand(model);
    byHand->SetNormalBlend(blend);
    byHand->SetEdgeWeightingToFullEdge();
    byHand->SetSphericalWeightingToUniform();
    byHand->SetStopRuleToThesis();
    byHand->SetInitialGuessToRest();
    byHand->SetAnchorToLastPoint();
    byHand->SetComponentCouplingToIndependent();
    byHand->AccelerationOff();
    byHand->SetCenterModeToPointMean();
    byHand->SetDetailSize(0.0);
    check(SamePoints(thesis.Output(), byHand.Output()), "it should be the sum of its parts");
    check(thesis->GetNumberOfIterations() == byHand->GetNumberOfIterations() &&
        thesis->GetFinalEnergy() == byHand->GetFinalEnergy() && thesis->GetConverged(),
      "iterations and energy should be those of its parts");
    check(thesis->GetDetailSize() == 0.1 && thesis->GetCenterMode() == 1,
      "it should leave the properties as they are");
    thesis->ReproduceThesisOff();
    check(!SamePoints(thesis.Output(), byHand.Output()), "off, the properties should count again");
  }
}

/// What an array gives and what the property gives: the same to rounding.
void PerPointArrays(Checker& check, vtkPolyData* model, const std::string& name,
  const std::function<void(vtkSphericalStyleFilter*)>& setUp)
{
  const vtkIdType n = model->GetNumberOfPoints();
  const double tolerance = Rounding * Diagonal(model);
  const auto withArray = [&](vtkDataArray* array)
  {
    auto copy = Surface::New();
    copy->ShallowCopy(model);
    copy->GetPointData()->AddArray(array);
    return copy;
  };
  const auto constant = [&](double value)
  {
    auto array = vtkSmartPointer<vtkFloatArray>::New();
    array->SetName("mine");
    array->SetNumberOfTuples(n);
    array->FillValue(static_cast<float>(value));
    return array;
  };
  const auto compare = [&](int index, vtkDataArray* array, const char* what,
                         const std::function<void(vtkSphericalStyleFilter*)>& property)
  {
    check.About(name + ", " + what);
    WatchedFilter byArray(withArray(array));
    setUp(byArray.Get());
    byArray->SetRoundness(0.5);
    byArray->SetInputArrayToProcess(index, 0, 0, OfPoints, array->GetName());
    WatchedFilter byProperty(model);
    setUp(byProperty.Get());
    byProperty->SetRoundness(0.5);
    property(byProperty.Get());
    for (WatchedFilter* filter : { &byArray, &byProperty })
    {
      (*filter)->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
      filter->Output();
      check(filter->Errors.empty() && (*filter)->GetConverged(), "it should work");
    }
    check.AtMost(LargestDistance(byArray->GetOutput(), byProperty->GetOutput()), tolerance,
      "difference of array and property");
  };
  compare(1, constant(0.0), "factor 0 as Roundness 0",
    [](vtkSphericalStyleFilter* filter) { filter->SetRoundness(0.0); });
  compare(1, constant(2.0), "factor 2 as twice the Roundness",
    [](vtkSphericalStyleFilter* filter) { filter->SetRoundness(1.0); });
  compare(1, MakeAny<vtkUnsignedCharArray>("other", n, 1), "any factor as any factor",
    [&](vtkSphericalStyleFilter* filter)
    {
      filter->SetRoundness(1.0);
      auto halves = MakeAny<vtkDoubleArray>("halves", n, 1);
      for (vtkIdType i = 0; i < n; ++i)
      {
        halves->SetValue(i, 0.5 * std::floor(halves->GetValue(i)));
      }
      filter->SetInputData(withArray(halves));
      filter->SetInputArrayToProcess(1, 0, 0, OfPoints, "halves");
    });
  compare(2, constant(0.25), "blend .25 as NormalBlend .25",
    [](vtkSphericalStyleFilter* filter) { filter->SetNormalBlend(0.25); });
  compare(2, constant(1.0), "blend 1 as NormalBlend 1",
    [](vtkSphericalStyleFilter* filter) { filter->SetNormalBlend(1.0); });

  for (const double blend : { 0.0, 0.5 })
  {
    WatchedFilter other(model);
    setUp(other.Get());
    other->SetNormalBlend(blend);
    other->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    vtkSmartPointer<vtkDataArray> t = other.Output()->GetPointData()->GetArray("TargetDirection");
    t->SetName("t");
    compare(3, t, "target directions of another run",
      [&](vtkSphericalStyleFilter* filter) { filter->SetNormalBlend(blend); });
  }

  check.About(name + ", factor 1 on one half and 0 on the other");
  auto factor = constant(0.0);
  double bounds[6];
  model->GetPoints()->GetBounds(bounds);
  const double middle = 0.5 * (bounds[2] + bounds[3]);
  for (vtkIdType i = 0; i < n; ++i)
  {
    factor->SetValue(i, PointOf(model, i)[1] > middle ? 1.0f : 0.0f);
  }
  WatchedFilter half(withArray(factor));
  setUp(half.Get());
  half->SetRoundness(5.0);
  half->SetInputArrayToProcess(1, 0, 0, OfPoints, "mine");
  double stretch[2] = { 0.0, 0.0 }; // largest relative change of an edge
  vtkPolyData* output = half.Output();
  for (const auto& t : TriangleCorners(model))
  {
    for (int k = 0; k < 3; ++k)
    {
      const vtkIdType u = t[k];
      const vtkIdType v = t[(k + 1) % 3];
      const double before = Distance(PointOf(model, u), PointOf(model, v));
      const double change =
        std::abs(Distance(PointOf(output, u), PointOf(output, v)) / before - 1.0);
      if (factor->GetValue(u) == factor->GetValue(v))
      {
        double& largest = stretch[factor->GetValue(u) > 0.0f];
        largest = std::max(largest, change);
      }
    }
  }
  check(stretch[0] < stretch[1], "the half with factor 0 should keep its shape better");
}
}

int TestSphericalStyleFilterArrays(int argc, char* argv[])
{
  const Surface icosahedron = ReadModel(argc, argv, "icosahedron.vtp");
  const Surface cube = ReadModel(argc, argv, "cube.vtp");
  const Surface bottle = ReadModel(argc, argv, "bottle.vtp");
  const Surface house = ReadModel(argc, argv, "stone-house.vtp");
  Checker check;
  EveryArray(check, icosahedron);
  Switches(check);
  NormalsOfResult(check, cube, icosahedron);
  Directions(check, bottle, "bottle");
  Directions(check, icosahedron, "icosahedron");
  GivenNormals(check);
  RotationsAndEnergies(check, house);
  History(check, bottle);
  IntrinsicDelaunay(check);
  Thesis(check, house);
  ThickDirections(check, bottle, "bottle");
  ThickDirections(check, icosahedron, "icosahedron");
  const auto energy = [](vtkSphericalStyleFilter* filter)
  {
    SetUpEnergy(filter);
    filter->SetSphericalWeightingToUniform();
  };
  PerPointArrays(check, bottle, "bottle", SetUpEnergy);
  PerPointArrays(check, bottle, "bottle with defaults", SetUpDefaults);
  PerPointArrays(check, bottle, "bottle with an energy", energy);
  PerPointArrays(check, icosahedron, "icosahedron", SetUpEnergy);
  PerPointArrays(check, icosahedron, "icosahedron with defaults", SetUpDefaults);
  NoEnergy(check);
  return check.Result();
}
