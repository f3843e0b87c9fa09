// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Grids and moved surfaces for vtkMeshMorphingFilter, from bytes: a few cubes in cells of one
/// kind, some points moved, some cells of any type added, and a surface with all, some or none of
/// their points.
#ifndef GridFromBytes_h
#define GridFromBytes_h

#include "SurfaceFromBytes.h"

#include "vtkImageData.h"
#include "vtkUnstructuredGrid.h"

namespace FilterTesting
{
/// Of 0 to 3 cubes along each axis.
inline vtkSmartPointer<vtkUnstructuredGrid> CubesFromBytes(Bytes& bytes)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(bytes.Flag() ? VTK_FLOAT : VTK_DOUBLE);
  const int n = (bytes.Byte() + 3) % 4; // 3 of a zero
  for (int k = 0; k <= n && n > 0; ++k)
  {
    for (int j = 0; j <= n; ++j)
    {
      for (int i = 0; i <= n; ++i)
      {
        points->InsertNextPoint(i, j, k);
      }
    }
  }
  const std::pair<int, std::vector<Cell>> kinds[] = {
    { VTK_HEXAHEDRON, { { 0, 1, 2, 3, 4, 5, 6, 7 } } },
    { VTK_VOXEL, { { 0, 1, 3, 2, 4, 5, 7, 6 } } },
    { VTK_WEDGE, { { 0, 1, 2, 4, 5, 6 }, { 0, 2, 3, 4, 6, 7 } } },
    { VTK_TETRA,
      { { 0, 1, 2, 6 }, { 0, 2, 3, 6 }, { 0, 3, 7, 6 }, { 0, 7, 4, 6 }, { 0, 4, 5, 6 },
        { 0, 5, 1, 6 } } },
    { VTK_PYRAMID, { { 0, 1, 2, 3, 6 }, { 0, 3, 7, 4, 6 }, { 0, 4, 5, 1, 6 } } } // around a corner
  };
  const auto& [type, pieces] = kinds[bytes.Below(5)];
  grid->Allocate(n * n * n);
  for (int cube = 0; cube < n * n * n; ++cube)
  {
    const auto id = [&](int a, int b, int c) -> vtkIdType
    {
      const int i = cube % n + a;
      const int j = cube / n % n + b;
      const int k = cube / n / n + c;
      return (k * (n + 1) + j) * (n + 1) + i;
    };
    const Cell corners = { id(0, 0, 0), id(1, 0, 0), id(1, 1, 0), id(0, 1, 0), id(0, 0, 1),
      id(1, 0, 1), id(1, 1, 1), id(0, 1, 1) };
    for (const Cell& piece : pieces)
    {
      Cell ids;
      for (const vtkIdType corner : piece)
      {
        ids.push_back(corners[corner]);
      }
      grid->InsertNextCell(type, static_cast<vtkIdType>(ids.size()), ids.data());
    }
  }
  grid->SetPoints(points);
  return grid;
}

inline void AddAnyCells(Bytes& bytes, vtkUnstructuredGrid* grid)
{
  constexpr int types[] = { VTK_TETRA, VTK_HEXAHEDRON, VTK_WEDGE, VTK_PYRAMID, VTK_VOXEL, VTK_LINE,
    VTK_TRIANGLE, VTK_QUAD, VTK_VERTEX, VTK_POLY_LINE, VTK_EMPTY_CELL, VTK_QUADRATIC_TETRA,
    VTK_CONVEX_POINT_SET, VTK_LAGRANGE_HEXAHEDRON, 200 };
  constexpr int sizes[] = { 4, 8, 6, 5, 8, 2, 3, 4, 1, 3, 0, 10, 6, 8, 4 };
  const auto n = static_cast<int>(grid->GetNumberOfPoints());
  const bool wild = bytes.Below(16) == 1;
  const int count = bytes.Below(8);
  for (int c = 0; c < count && bytes.Left() > 0 && (n > 0 || wild); ++c)
  {
    const int kind = bytes.Below(bytes.Below(4) == 1 ? 15 : 10);
    Cell ids(wild && bytes.Flag() ? bytes.Below(9) : sizes[kind]);
    for (vtkIdType& id : ids)
    {
      const int byte = bytes.Byte();
      id = wild ? byte - 3 : byte % n;
    }
    grid->InsertNextCell(types[kind], static_cast<vtkIdType>(ids.size()), ids.data());
  }
}

/// Cubes with moved points and more cells, an image, or a surface.
inline vtkSmartPointer<vtkDataSet> GridFromBytes(Bytes& bytes)
{
  const int kind = bytes.Below(8);
  if (kind == 6)
  {
    return SurfaceFromBytes(bytes);
  }
  vtkSmartPointer<vtkDataSet> made;
  if (kind == 7)
  {
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(bytes.Below(4), bytes.Below(4), bytes.Below(4));
    image->SetSpacing(bytes.Any(), bytes.Small(), 1.0);
    made = image;
  }
  else
  {
    const auto grid = CubesFromBytes(bytes);
    const bool wild = bytes.Below(8) == 1;
    for (int k = bytes.Below(8); k > 0 && grid->GetNumberOfPoints() > 0; --k)
    {
      double x[3];
      const vtkIdType i = bytes.Byte() % grid->GetNumberOfPoints();
      grid->GetPoint(i, x);
      x[bytes.Below(3)] += wild ? bytes.Any() : 0.25 * bytes.Small();
      grid->GetPoints()->SetPoint(i, x);
    }
    AddAnyCells(bytes, grid);
    made = grid;
  }
  AddArraysFromBytes(bytes, made->GetPointData(), made->GetNumberOfPoints());
  AddArraysFromBytes(bytes, made->GetCellData(), made->GetNumberOfCells());
  return made;
}

/// All points of the grid, bent and some of them moved by themselves; or any surface, with or
/// without Displacement.
inline Surface MovedFromBytes(Bytes& bytes, vtkDataSet* grid)
{
  const int kind = bytes.Below(16);
  Surface surface = Surface::New();
  if (kind == 1 || kind == 2)
  {
    surface = SurfaceFromBytes(bytes);
  }
  else
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
    {
      points->InsertNextPoint(grid->GetPoint(i));
    }
    surface->SetPoints(points);
    AddCellsFromBytes(bytes, surface);
  }
  if (kind == 3)
  {
    return surface;
  }
  const vtkIdType n = surface->GetNumberOfPoints();
  vtkNew<vtkDoubleArray> displacement;
  displacement->SetName("Displacement");
  displacement->SetNumberOfComponents(kind == 4 ? 2 : 3);
  displacement->SetNumberOfTuples(n);
  const double bend = 0.05 * bytes.Small();
  const double shift = bytes.Small();
  for (vtkIdType i = 0; i < n; ++i)
  {
    double x[3];
    surface->GetPoint(i, x);
    const double d[] = { shift + bend * x[2] * x[2], bend * x[0], shift };
    displacement->SetTuple(i, d);
  }
  const bool wild = bytes.Below(8) == 1;
  for (int k = bytes.Below(6); k > 0 && n > 0; --k)
  {
    const vtkIdType i = bytes.Byte() % n;
    displacement->SetComponent(i, 0, wild ? bytes.Any() : 0.25 * bytes.Small());
  }
  for (vtkIdType i = 0; i < n && kind != 1 && kind != 4; ++i)
  {
    double x[3];
    surface->GetPoint(i, x);
    for (int k = 0; k < 3; ++k)
    {
      x[k] += displacement->GetComponent(i, k);
    }
    surface->GetPoints()->SetPoint(i, x);
  }
  surface->GetPointData()->AddArray(displacement);
  return surface;
}
}

#endif
