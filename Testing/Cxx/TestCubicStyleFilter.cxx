// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// vtkCubicStyleFilter: the contract, its properties, and that the surface looks along the axes.
#include "ComparatorTesting.h"
#include "PropertyTesting.h"

#include "vtkCubicStyleFilter.h"

using namespace FilterTesting;

namespace
{
using FilterType = vtkCubicStyleFilter;

void Properties(Checker& check)
{
  check.About("properties");
  vtkNew<FilterType> filter;
  RoundTrip(Cubeness, 0.5, 2.0);
  RoundTrip(StopRule, 0, 1);
  RoundTrip(Tolerance, 1e-3, 1e-5);
  RoundTrip(MaximumNumberOfIterations, 500, 7);
  RoundTrip(NumberOfThreads, 0, 2);
  RoundTrip(OutputPointsPrecision, 2, 1);
  OnOff(GenerateNormals, false);
  Mode(StopRule, Converged, CONVERGED, 0);
  Mode(StopRule, Thesis, THESIS, 1);
  Mode(StopRule, FixedIterations, FIXED_ITERATIONS, 2);
  Clamped(Tolerance, 0.0, 1e-14);
  Clamped(StopRule, 3, 2);
  Clamped(MaximumNumberOfIterations, -1, 0);
  for (const double bad : { -1.0, NaN, HUGE_VAL })
  {
    ExpectError<FilterType>(
      check, "Cubeness " + vtkVariant(bad).ToString(), { "Cubeness" },
      [bad](FilterType* self, vtkPolyData*) { self->SetCubeness(bad); },
      [](FilterType* self) { self->SetCubeness(0.5); });
  }
  ExpectError<FilterType>(
    check, "Cubeness beyond an energy", { "energy is beyond the range" },
    [](FilterType* self, vtkPolyData*) { self->SetCubeness(1.7e308); },
    [](FilterType* self) { self->SetCubeness(0.5); });
}

/// sum over the triangles of the area times |n|_1, over the area: 1 for boxes along the axes.
double MeanNorm(vtkPolyData* surface)
{
  double norms = 0.0;
  double areas = 0.0;
  for (const auto& t : TriangleCorners(surface))
  {
    const Vector a = PointOf(surface, t[0]);
    Vector u = PointOf(surface, t[1]);
    Vector v = PointOf(surface, t[2]);
    Vector n;
    vtkMath::Subtract(u.data(), a.data(), u.data());
    vtkMath::Subtract(v.data(), a.data(), v.data());
    vtkMath::Cross(u.data(), v.data(), n.data());
    norms += std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);
    areas += vtkMath::Norm(n.data());
  }
  return norms / areas;
}

void Creature(Checker& check, int argc, char* argv[])
{
  check.About("creature");
  const Surface creature = ReadModel(argc, argv, "creature.vtp");
  Watched<FilterType> filter(creature);
  filter->SetMaximumNumberOfIterations(30);
  filter->SetStopRuleToFixedIterations();
  double mean = MeanNorm(creature);
  std::cout << "creature: mean |n|_1 " << mean;
  filter->SetCubeness(0.0);
  check.AtMost(LargestDistance(creature, filter.Output()), 1e-7 * Diagonal(creature), "0, moved");
  for (const double cubeness : { 0.1, 0.5, 2.0 })
  {
    filter->SetCubeness(cubeness);
    const double next = MeanNorm(filter.Output());
    std::cout << ", " << next << " with " << cubeness;
    check(next < mean - 0.02, "the mean |n|_1 should fall from " + vtkVariant(mean).ToString());
    mean = next;
  }
  std::cout << "\n";
}

/// A cube is at its minimum from the start.
void Cube(Checker& check, int argc, char* argv[])
{
  check.About("cube");
  const Surface cube = ReadModel(argc, argv, "cube.vtp");
  Watched<FilterType> filter(cube);
  check.AtMost(LargestDistance(cube, filter.Output()), 1e-7 * Diagonal(cube), "moved");
  check(filter.Warnings.empty() && filter->GetConverged() && filter->GetNumberOfIterations() < 20,
    "after " + vtkVariant(filter->GetNumberOfIterations()).ToString() +
      " iterations: " + Joined(filter.Warnings));
}
}

int TestCubicStyleFilter(int argc, char* argv[])
{
  Checker check;
  Properties(check);
  CheckContract<FilterType>(check,
    { "Cubeness", "StopRule", "Tolerance", "MaximumNumberOfIterations", "OutputPointsPrecision",
      "NumberOfThreads", "GenerateNormals", "NumberOfIterations", "Converged", "FinalEnergy" });
  CheckIteration<FilterType>(check, "Cubic");
  Creature(check, argc, argv);
  Cube(check, argc, argv);
  return check.Result();
}
