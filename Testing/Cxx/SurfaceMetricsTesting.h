// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the tests of vtkSurfaceMetrics share beyond FilterTesting.h.
#ifndef SurfaceMetricsTesting_h
#define SurfaceMetricsTesting_h

#include "FilterTesting.h"

#include "vtkSurfaceMetrics.h"
#include "vtkTable.h"

#include <limits>

namespace FilterTesting
{
#ifdef SPHERICALSTYLE_WITH_CGAL
constexpr bool WithCgal = true;
#else
constexpr bool WithCgal = false;
#endif

class WatchedMetrics : public Watched<vtkSurfaceMetrics>
{
public:
  explicit WatchedMetrics(vtkPolyData* input, vtkPolyData* reference = nullptr)
  {
    this->Get()->SetInputData(input);
    this->Get()->SetReferenceData(reference);
    this->Get()->SetFindSelfIntersections(WithCgal); // where it must be silent
  }

  vtkTable* Table()
  {
    this->Get()->Update();
    return vtkTable::SafeDownCast(this->Get()->GetOutputDataObject(1));
  }

  bool Has(const char* measure) { return this->Table()->GetColumnByName(measure) != nullptr; }

  /// NaN where the table has no such column.
  double operator[](const char* measure)
  {
    auto* column = vtkArrayDownCast<vtkDataArray>(this->Table()->GetColumnByName(measure));
    return column && column->GetNumberOfTuples() == 1 ? column->GetComponent(0, 0)
                                                      : std::numeric_limits<double>::quiet_NaN();
  }

  double OfCell(const char* array, vtkIdType cell)
  {
    vtkDataArray* values = this->Output()->GetCellData()->GetArray(array);
    return values && cell < values->GetNumberOfTuples() ? values->GetComponent(cell, 0)
                                                        : std::numeric_limits<double>::quiet_NaN();
  }

  double OfPoint(const char* array, vtkIdType point)
  {
    vtkDataArray* values = this->Output()->GetPointData()->GetArray(array);
    return values && point < values->GetNumberOfTuples() ? values->GetComponent(point, 0)
                                                         : std::numeric_limits<double>::quiet_NaN();
  }

  void Expect(Checker& check, const char* measure, double expected, double tolerance = 0.0)
  {
    const double value = (*this)[measure];
    check(std::abs(value - expected) <= tolerance,
      std::string(measure) + " should be " + vtkVariant(expected).ToString() + " and is " +
        vtkVariant(value).ToString());
  }

  void ExpectSilence(Checker& check)
  {
    this->Output();
    for (const auto* messages : { &this->Errors, &this->Warnings })
    {
      check(messages->empty(), messages->empty() ? "" : "it said " + messages->front());
    }
  }
};
}

#endif
