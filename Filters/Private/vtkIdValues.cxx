// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIdValues.h"

#include "vtkSurfaceMeshConversion.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

vtkIdValues::vtkIdValues(
  vtkDataArray* array, const char* purpose, vtkIdType count, const char* noun)
  : Array(array)
  , Name(std::string(purpose) + ": array '" + (array->GetName() ? array->GetName() : "") + "'")
  , Noun(noun)
{
  if (array->GetNumberOfComponents() != 1 || array->GetNumberOfTuples() != count)
  {
    throw std::invalid_argument(
      this->Name + " must have 1 component and a value for every " + this->Noun);
  }
}

vtkIdType vtkIdValues::operator[](vtkIdType i) const
{
  const double value = this->Array->GetComponent(i, 0);
  if (value != std::floor(value) || std::abs(value) > 1e15)
  {
    throw std::invalid_argument(this->Name + " must hold whole numbers; " + this->Noun + " " +
      std::to_string(i) + " has " + std::to_string(value));
  }
  return static_cast<vtkIdType>(value);
}

std::vector<vtkIdType> vtkIdValues::OfMesh(const vtkSurfaceMesh& surface) const
{
  const std::vector<vtkIdType> first = surface.FirstInputPoints();
  std::vector<vtkIdType> ids(first.size());
  for (vtkIdType i = 0; i < static_cast<vtkIdType>(surface.MeshPoint.size()); ++i)
  {
    const int point = surface.MeshPoint[i];
    if (point != vtkSurfaceMesh::NotMoved)
    {
      const vtkIdType id = (*this)[i]; // checked, also of points that are not the first at a place
      ids[point] = first[point] == i ? id : ids[point];
    }
  }
  return ids;
}

std::vector<int> vtkIdValues::Ranks(
  const std::vector<vtkIdType>& ids, std::vector<vtkIdType>& values)
{
  values = ids;
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  std::vector<int> ranks(ids.size());
  std::transform(ids.begin(), ids.end(), ranks.begin(),
    [&](vtkIdType id) {
      return static_cast<int>(std::lower_bound(values.begin(), values.end(), id) - values.begin());
    });
  return ranks;
}
