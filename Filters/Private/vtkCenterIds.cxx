// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCenterIds.h"

#include "vtkSurfaceMeshConversion.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <cmath>
#include <map>
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
  const std::string name = "Center id: array '" + ids.ArrayName + "'";
  if (array->GetNumberOfComponents() != 1 ||
    array->GetNumberOfTuples() != input->GetNumberOfPoints())
  {
    throw std::invalid_argument(name + " must have 1 component and a value for every point");
  }
  std::map<double, int> ranks;
  std::vector<double> values(surface.Mesh.P.rows());
  for (vtkIdType i = input->GetNumberOfPoints() - 1; i >= 0; --i)
  {
    const int point = surface.MeshPoint[i];
    const double value = array->GetComponent(i, 0);
    if (point == vtkSurfaceMesh::NotMoved)
    {
      continue;
    }
    if (value != std::floor(value) || std::abs(value) > 1e15)
    {
      throw std::invalid_argument(name + " must hold whole numbers; point " + std::to_string(i) +
        " has " + std::to_string(value));
    }
    values[point] = value; // the first of coincident points comes last
  }
  for (const double value : values)
  {
    ranks[value] = 0;
  }
  if (ranks.size() > MaximumNumberOfCenters)
  {
    throw std::invalid_argument(name + " has " + std::to_string(ranks.size()) +
      " different values; there can be " + std::to_string(MaximumNumberOfCenters) + " centers");
  }
  for (auto& [value, rank] : ranks)
  {
    rank = static_cast<int>(ids.Values.size());
    ids.Values.push_back(static_cast<vtkIdType>(value));
  }
  for (const double value : values)
  {
    ids.OfPoints.push_back(ranks[value]);
  }
  return ids;
}

Points vtkCenterIds::Centers(vtkPointSet* given) const
{
  if (this->Values.empty())
  {
    throw std::invalid_argument("Centers: points are given, but no array of center ids (index 5)");
  }
  const vtkIdType n = given->GetNumberOfPoints();
  vtkDataArray* own = given->GetPointData()->GetArray(this->ArrayName.c_str());
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
