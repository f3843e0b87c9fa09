// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the tests of vtkGaussMapFilter share.
#ifndef GaussMapTesting_h
#define GaussMapTesting_h

#include "FilterTesting.h"
#include "vtkGaussMapFilter.h"

#include "vtkImageData.h"
#include "vtkTable.h"

#include <numeric>

namespace FilterTesting
{
using WatchedGaussMap = Watched<vtkGaussMapFilter>;

inline vtkDataArray* SphereArray(vtkGaussMapFilter* filter, const char* name)
{
  return filter->GetOutput()->GetCellData()->GetArray(name);
}

inline vtkImageData* Image(vtkGaussMapFilter* filter)
{
  return vtkImageData::SafeDownCast(filter->GetOutputDataObject(1));
}

inline vtkTable* Table(vtkGaussMapFilter* filter)
{
  return vtkTable::SafeDownCast(filter->GetOutputDataObject(2));
}

inline double Sum(vtkDataArray* array)
{
  double sum = 0.0;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    sum += array->GetComponent(i, 0);
  }
  return sum;
}

/// Number of a direction's equal-angle unit, from its angles.
inline vtkIdType UnitOf(const Vector& n)
{
  const auto degrees = [](double angle) { return vtkMath::DegreesFromRadians(angle) + 0.001; };
  const auto longitude =
    static_cast<vtkIdType>(std::floor(degrees(std::atan2(n[1], n[0])) + 180.0)) % 360;
  const auto latitude =
    static_cast<vtkIdType>(std::floor(degrees(std::atan2(n[2], std::hypot(n[0], n[1]))) + 90.0));
  return 360 * latitude + longitude;
}

/// Counts in the image and facts of two filters, to the bit.
inline bool SameMap(vtkGaussMapFilter* a, vtkGaussMapFilter* b)
{
  const auto facts = [](vtkGaussMapFilter* f)
  {
    return std::vector<double>{ static_cast<double>(f->GetNumberOfNormals()),
      static_cast<double>(f->GetUnitsHit()), static_cast<double>(f->GetUnitsHitOften()),
      static_cast<double>(f->GetEqualAreaUnitsHit()),
      static_cast<double>(f->GetEqualAreaUnitsHitOften()), f->GetEntropy(), f->GetRelativeEntropy(),
      f->GetKullbackLeiblerDivergence(), f->GetDistanceToUniform() };
  };
  return facts(a) == facts(b) &&
    SameArray(Image(a)->GetPointData()->GetScalars(), Image(b)->GetPointData()->GetScalars()) &&
    SamePolyData(a->GetOutput(), b->GetOutput());
}
}

#endif
