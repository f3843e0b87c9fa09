// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the tests of faults share: all that a filter gives, and whether it is the same.
#ifndef FaultTesting_h
#define FaultTesting_h

#include "ArrayTesting.h"
#include "EveryFilter.h"

#include "vtkImageData.h"
#include "vtkTable.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SANITIZED            ///< memory is the sanitizer's
#elif defined(__has_feature) // Clang
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SANITIZED
#endif
#endif

namespace FilterTesting
{
/// A copy of every output, without the seconds it took.
inline std::vector<vtkSmartPointer<vtkDataObject>> AllOutputs(vtkAlgorithm* filter)
{
  std::vector<vtkSmartPointer<vtkDataObject>> all;
  for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    vtkDataObject* output = filter->GetOutputDataObject(port);
    all.push_back(vtkSmartPointer<vtkDataObject>::Take(output->NewInstance()));
    all.back()->DeepCopy(output);
    all.back()->GetFieldData()->RemoveArray("StageSeconds");
  }
  return all;
}

/// The same to the bit.
inline bool SameOutputs(const std::vector<vtkSmartPointer<vtkDataObject>>& a,
  const std::vector<vtkSmartPointer<vtkDataObject>>& b)
{
  const auto same = [](vtkFieldData* x, vtkFieldData* y)
  { return x->GetNumberOfArrays() == y->GetNumberOfArrays() && SameArrays(x, y); };
  bool all = a.size() == b.size();
  for (std::size_t port = 0; all && port < a.size(); ++port)
  {
    if (auto* surface = vtkPolyData::SafeDownCast(a[port]))
    {
      all = SamePolyData(surface, vtkPolyData::SafeDownCast(b[port]));
    }
    else if (auto* table = vtkTable::SafeDownCast(a[port]))
    {
      all = same(table->GetRowData(), vtkTable::SafeDownCast(b[port])->GetRowData());
    }
    else if (auto* image = vtkImageData::SafeDownCast(a[port]))
    {
      all = same(image->GetPointData(), vtkImageData::SafeDownCast(b[port])->GetPointData());
    }
  }
  return all;
}

inline bool IsEmpty(vtkPolyDataAlgorithm* filter)
{
  vtkPolyData* output = filter->GetOutput();
  return output->GetNumberOfPoints() == 0 && output->GetNumberOfCells() == 0;
}

/// A ball with a bump, so that no filter is done at once.
inline Surface MakeBumpyBall(vtkIdType around, vtkIdType rings)
{
  return Mapped(MakeEllipsoid({ 1.0, 0.8, 2.0 }, Faces::Triangles, around, rings),
    [](const Vector& x)
    {
      const double r = 1.0 + 0.3 * std::sin(5.0 * x[0]) * std::cos(3.0 * x[2]);
      return Vector{ r * x[0], r * x[1], x[2] };
    });
}
}

#endif
