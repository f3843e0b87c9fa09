// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// vtkBlockStyleFilter: the contract and its properties.
#include "ComparatorTesting.h"
#include "PropertyTesting.h"

#include "vtkBlockStyleFilter.h"

using namespace FilterTesting;

namespace
{
using FilterType = vtkBlockStyleFilter;

void Properties(Checker& check)
{
  check.About("properties");
  vtkNew<FilterType> filter;
  RoundTrip(Blockiness, 1.0, 2.0);
  RoundTrip(StopRule, 0, 1);
  RoundTrip(Tolerance, 1e-4, 1e-5);
  RoundTrip(MaximumNumberOfIterations, 200, 7);
  RoundTrip(NumberOfThreads, 0, 2);
  RoundTrip(OutputPointsPrecision, 2, 1);
  OnOff(GenerateNormals, false);
  OnOff(TransformAllInputVectors, false);
  for (const double bad : { -1.0, NaN, HUGE_VAL })
  {
    ExpectError<FilterType>(
      check, "Blockiness " + vtkVariant(bad).ToString(), { "Blockiness" },
      [bad](FilterType* self, vtkPolyData*) { self->SetBlockiness(bad); },
      [](FilterType* self) { self->SetBlockiness(1.0); });
  }
}
}

int TestBlockStyleFilter(int, char*[])
{
  Checker check;
  Properties(check);
  CheckContract<FilterType>(check,
    { "Blockiness", "StopRule", "Tolerance", "MaximumNumberOfIterations", "OutputPointsPrecision",
      "NumberOfThreads", "GenerateNormals", "TransformAllInputVectors", "NumberOfIterations",
      "Converged", "FinalEnergy" });
  CheckIteration<FilterType>(check, "Block");
  return check.Result();
}
