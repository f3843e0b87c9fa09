// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVolumeCells.h"

#include "vtkCell.h"
#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

using SphericalStyle::CellShape;

namespace
{
/// @return whether cells of the type are taken
bool FindShape(int type, CellShape& shape)
{
  switch (type)
  {
    case VTK_TETRA:
      shape = CellShape::Tetrahedron;
      return true;
    case VTK_PYRAMID:
      shape = CellShape::Pyramid;
      return true;
    case VTK_WEDGE:
      shape = CellShape::Wedge;
      return true;
    case VTK_HEXAHEDRON:
    case VTK_VOXEL:
      shape = CellShape::Hexahedron;
      return true;
    default:
      return false;
  }
}

/// Dimension of the cells of a type; 3 of a type that VTK does not know, which is refused.
int DimensionOf(int type)
{
  if (type == VTK_EMPTY_CELL)
  {
    return 0;
  }
  const auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(type));
  return cell ? cell->GetCellDimension() : 3;
}

/// @throw std::invalid_argument naming the first point that is not there
void CheckIds(vtkIdType cell, vtkIdList* ids, vtkIdType numberOfPoints)
{
  for (const vtkIdType id : *ids)
  {
    if (id < 0 || id >= numberOfPoints)
    {
      throw std::invalid_argument("cell " + std::to_string(cell) + " names point " +
        std::to_string(id) + "; there are " + std::to_string(numberOfPoints) +
        " points: the file or the program that the grid is from has numbered them wrongly");
    }
  }
}

std::string NameOf(int type)
{
  const auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(type));
  return cell ? cell->GetClassName() : "cell of an unknown type";
}

void AddCell(
  SphericalStyle::VolumeMesh& mesh, vtkIdType cell, int type, CellShape shape, vtkIdList* ids)
{
  const int count = NumberOfPoints(shape);
  if (ids->GetNumberOfIds() != count)
  {
    throw std::invalid_argument("cell " + std::to_string(cell) + " has " +
      std::to_string(ids->GetNumberOfIds()) + " points; a " + NameOf(type) + " has " +
      std::to_string(count) + ": leave the cell out, or give it the type that it is");
  }
  std::array<int, 8> points = {};
  for (int k = 0; k < count; ++k)
  {
    points[k] = static_cast<int>(ids->GetId(k));
  }
  if (type == VTK_VOXEL)
  {
    std::swap(points[2], points[3]);
    std::swap(points[6], points[7]);
  }
  mesh.Shapes.push_back(shape);
  mesh.Ids.insert(mesh.Ids.end(), points.begin(), points.begin() + count);
  mesh.Offsets.push_back(static_cast<int>(mesh.Ids.size()));
}
}

namespace vtkVolumeCells
{
Volume FromDataSet(vtkDataSet* input, const SphericalStyle::Points& P)
{
  Volume volume;
  volume.Mesh.P = P;
  volume.Mesh.Offsets.push_back(0);
  // A surface has no volume, and its links to cells may be older than these.
  if (vtkPolyData::SafeDownCast(input) || !vtkPointSet::SafeDownCast(input))
  {
    return volume;
  }
  std::map<int, int> dimensions; // of the types without a shape
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    const int type = input->GetCellType(cell);
    auto shape = CellShape::Tetrahedron;
    if (FindShape(type, shape))
    {
      input->GetCellPoints(cell, ids);
      CheckIds(cell, ids, P.rows());
      AddCell(volume.Mesh, cell, type, shape, ids);
      volume.Cells.push_back(cell);
    }
    else
    {
      const auto [known, isNew] = dimensions.try_emplace(type, 0);
      if (isNew)
      {
        known->second = DimensionOf(type);
      }
      if (known->second == 3)
      {
        throw std::invalid_argument("cell " + std::to_string(cell) + " is a " + NameOf(type) +
          " (type " + std::to_string(type) +
          "); only linear tetrahedra, pyramids, wedges, hexahedra and voxels can be morphed: make "
          "such cells with Tetrahedralize in ParaView, vtkDataSetTriangleFilter in VTK");
      }
      input->GetCellPoints(cell, ids);
      CheckIds(cell, ids, P.rows());
    }
  }
  OrientCells(volume.Mesh);
  return volume;
}
}
