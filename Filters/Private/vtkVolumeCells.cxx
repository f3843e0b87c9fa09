// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVolumeCells.h"

#include "vtkCellType.h"
#include "vtkCellTypes.h"
#include "vtkDataSet.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointSet.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

using SphericalStyle::CellShape;

namespace
{
constexpr double FarthestCoordinate = 1e300;

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

/// Dimension of the cells of a type, asked once.
class Dimensions
{
public:
  int Of(int type)
  {
    if (type < 0 || type >= VTK_NUMBER_OF_CELL_TYPES)
    {
      return 3; // not a type: refused
    }
    if (this->Known[type] < 0)
    {
      this->Cell->SetCellType(type);
      this->Known[type] = type == VTK_EMPTY_CELL ? 0 : this->Cell->GetCellDimension();
    }
    return this->Known[type];
  }

  Dimensions() { this->Known.fill(-1); }

private:
  vtkNew<vtkGenericCell> Cell;
  std::array<int, VTK_NUMBER_OF_CELL_TYPES> Known = {};
};

void AddCell(
  SphericalStyle::VolumeMesh& mesh, vtkIdType cell, int type, CellShape shape, vtkIdList* ids)
{
  const std::string name = "cell " + std::to_string(cell);
  const int count = NumberOfPoints(shape);
  if (ids->GetNumberOfIds() != count)
  {
    throw std::invalid_argument(name + " has " + std::to_string(ids->GetNumberOfIds()) +
      " points; a " + vtkCellTypes::GetClassNameFromTypeId(type) + " has " + std::to_string(count));
  }
  std::array<int, 8> points = {};
  for (int k = 0; k < count; ++k)
  {
    const vtkIdType id = ids->GetId(k);
    if (id < 0 || id >= mesh.P.rows())
    {
      throw std::invalid_argument(name + " names point " + std::to_string(id) + "; there are " +
        std::to_string(mesh.P.rows()) + " points");
    }
    points[k] = static_cast<int>(id);
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
SphericalStyle::Points PointsOf(vtkDataSet* input)
{
  SphericalStyle::Points P(input->GetNumberOfPoints(), 3);
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    input->GetPoint(i, P.row(i).data());
    const double largest = P.row(i).cwiseAbs().maxCoeff();
    if (!P.row(i).allFinite())
    {
      throw std::invalid_argument("point " + std::to_string(i) + " is not finite");
    }
    if (largest > FarthestCoordinate)
    {
      throw std::invalid_argument(
        "point " + std::to_string(i) + " is farther from the origin than 1e300");
    }
  }
  return P;
}

Volume FromDataSet(vtkDataSet* input, const SphericalStyle::Points& P)
{
  Volume volume;
  volume.Mesh.P = P;
  volume.Mesh.Offsets.push_back(0);
  if (!vtkPointSet::SafeDownCast(input))
  {
    return volume;
  }
  Dimensions dimensions;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell)
  {
    const int type = input->GetCellType(cell);
    auto shape = CellShape::Tetrahedron;
    if (FindShape(type, shape))
    {
      input->GetCellPoints(cell, ids);
      AddCell(volume.Mesh, cell, type, shape, ids);
      volume.Cells.push_back(cell);
    }
    else if (dimensions.Of(type) == 3)
    {
      throw std::invalid_argument("cell " + std::to_string(cell) + " is a " +
        vtkCellTypes::GetClassNameFromTypeId(type) + " (type " + std::to_string(type) +
        "); only linear tetrahedra, pyramids, wedges, hexahedra and voxels can be morphed: make "
        "such cells with Tetrahedralize in ParaView, vtkDataSetTriangleFilter in VTK");
    }
  }
  OrientCells(volume.Mesh);
  return volume;
}
}
