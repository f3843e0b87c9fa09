// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the tests of vtkConvexProxyDeformFilter share beyond ArrayTesting.h.
#ifndef ConvexProxyTesting_h
#define ConvexProxyTesting_h

#include "ArrayTesting.h"

#include "vtkConvexProxyDeformFilter.h"

namespace FilterTesting
{
/// Indices of the input arrays to process.
enum ProxyArrays
{
  NormalsArray = 0,
  DirectionsArray = 1,
  BlendArray = 2,
  RegionArray = 3
};

/// Small proxies, so that tests are quick, and the points of the input and no more.
class WatchedProxyFilter : public Watched<vtkConvexProxyDeformFilter>
{
public:
  explicit WatchedProxyFilter(vtkPolyData* input = nullptr)
  {
    this->Get()->SetInputData(input);
    this->Get()->SetNumberOfProxyPoints(300);
    this->Get()->SetRefineLongEdgesToOff();
  }
};

/// sum_k b_k x_k at the foot of point i, by the arrays of the filter.
inline Vector AtFoot(vtkPolyData* output, vtkPolyData* proxy, vtkIdType i,
  const std::function<Vector(vtkIdType)>& x, vtkIdList* ids)
{
  const auto cell = static_cast<vtkIdType>(PointArray(output, "ProxyCell")->GetComponent(i, 0));
  const Vector b = TupleOf(PointArray(output, "Barycentric"), i);
  Vector sum = { 0.0, 0.0, 0.0 };
  proxy->GetPolys()->GetCellAtId(cell, ids);
  for (int k = 0; k < 3; ++k)
  {
    const Vector corner = x(ids->GetId(k));
    for (int d = 0; d < 3; ++d)
    {
      sum[d] += b[k] * corner[d];
    }
  }
  return sum;
}

/// Largest distance of an output point from sum b q'_k: 0 where t is 0.
inline double LargestDistanceFromProxy(vtkPolyData* output, vtkPolyData* proxy)
{
  vtkNew<vtkIdList> ids;
  double largest = 0.0;
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const Vector q = AtFoot(
      output, proxy, i, [&](vtkIdType k) { return PointOf(proxy, k); }, ids);
    const double d = Distance(q, PointOf(output, i));
    largest = d <= largest ? largest : d;
  }
  return largest;
}

/// Largest distance between points that coincide in `before`.
inline double LargestGap(vtkPolyData* before, vtkPolyData* after)
{
  double largest = 0.0;
  for (const Cell& group : CoincidentPoints(before))
  {
    for (const vtkIdType i : group)
    {
      const double d = Distance(PointOf(after, group[0]), PointOf(after, i));
      largest = d <= largest ? largest : d;
    }
  }
  return largest;
}

/// The model of which a change of the same filter is checked: an ellipsoid with a dent and a few
/// loose points.
inline Surface MakeDented(int type = VTK_DOUBLE)
{
  Surface surface = Mapped(
    MakeEllipsoid({ 1.0, 0.8, 2.0 }),
    [](const Vector& x)
    {
      const double dent = x[0] > 0.5 ? 0.85 : 1.0;
      return Vector{ dent * x[0] + 0.1, x[1] - 0.2, x[2] + 0.3 };
    },
    type);
  surface->GetPoints()->InsertNextPoint(0.0, 0.1, 0.2);
  surface->GetPoints()->InsertNextPoint(-0.3, 0.1, 1.2);
  return surface;
}
}

#endif
