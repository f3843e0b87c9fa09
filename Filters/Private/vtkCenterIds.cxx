// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCenterIds.h"

#include "vtkIdValues.h"
#include "vtkSurfaceMeshConversion.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <stdexcept>

using SphericalStyle::Points;

namespace
{
// More are a mistake, such as the array of another purpose; each costs one more field to smooth.
constexpr std::size_t MaximumNumberOfCenters = 256;
}

vtkCenterIds vtkCenterIds::Find(
  vtkInformation* wanted, const vtkSurfaceMesh& surface, vtkPolyData* input)
{
  vtkCenterIds ids;
  vtkDataArray* array = vtkSurfaceMeshConversion::FindPointArray(wanted, input, "Center id");
  if (!array)
  {
    return ids;
  }
  ids.ArrayName = array->GetName() ? array->GetName() : "";
  const vtkIdValues given(array, "Center id", input->GetNumberOfPoints(), "point");
  ids.OfPoints = vtkIdValues::Ranks(given.OfMesh(surface), ids.Values);
  if (ids.Values.size() > MaximumNumberOfCenters)
  {
    throw std::invalid_argument(given.GetName() + " has " + std::to_string(ids.Values.size()) +
      " different values; there can be " + std::to_string(MaximumNumberOfCenters) + " centers");
  }
  return ids;
}

Points vtkCenterIds::Centers(vtkPointSet* given) const
{
  if (this->Values.empty())
  {
    throw std::invalid_argument("Centers: points are given, but no array of center ids (index 5)");
  }
  vtkDataArray* own = given->GetPointData()->GetArray(this->ArrayName.c_str());
  const vtkIdType n =
    std::min(given->GetNumberOfPoints(), own ? own->GetNumberOfTuples() : VTK_ID_MAX);
  Points centers(this->Values.size(), 3);
  for (std::size_t k = 0; k < this->Values.size(); ++k)
  {
    vtkIdType at = own ? 0 : static_cast<vtkIdType>(k);
    while (own && at < n && own->GetComponent(at, 0) != static_cast<double>(this->Values[k]))
    {
      ++at;
    }
    if (at >= n)
    {
      throw std::invalid_argument(
        "Centers: there is no point for center id " + std::to_string(this->Values[k]));
    }
    given->GetPoint(at, centers.row(static_cast<Eigen::Index>(k)).data());
  }
  return centers;
}

void vtkCenterIds::Refuse(const SphericalStyle::PartWithoutSphere& error) const
{
  throw std::invalid_argument(this->Values.empty()
      ? "Region: " + error.Why + "; SphereOf WholeModel takes that of the whole model"
      : "Center id " + std::to_string(this->Values[error.Part]) + ": " + error.Why);
}
