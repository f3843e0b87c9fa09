// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Surfaces that no program writes on purpose, from bytes. They hold together as vtkPolyData and
/// need not make any other sense: ids, numbers and sizes of arrays are what the bytes say. Few
/// points and cells, so that a filter takes milliseconds.
#ifndef SurfaceFromBytes_h
#define SurfaceFromBytes_h

#include "ArrayTesting.h"
#include "Bytes.h"

namespace FilterTesting
{
constexpr const char* ArrayNames[] = { "a", "b", "c", "d" };

/// One of ArrayNames, or of an array that is not there.
inline const char* ArrayName(Bytes& bytes)
{
  const int k = bytes.Below(5);
  return k < 4 ? ArrayNames[k] : "missing";
}

inline vtkSmartPointer<vtkAbstractArray> ArrayFromBytes(
  Bytes& bytes, const char* name, vtkIdType tuples)
{
  constexpr int types[] = { VTK_DOUBLE, VTK_FLOAT, VTK_INT, VTK_UNSIGNED_CHAR, VTK_ID_TYPE, VTK_BIT,
    VTK_STRING };
  const int shape = bytes.Byte();
  auto array = vtkSmartPointer<vtkAbstractArray>::Take(
    vtkAbstractArray::CreateArray(types[bytes.Below(sizeof(types) / sizeof(types[0]))]));
  array->SetName(name);
  array->SetNumberOfComponents(shape % 2 == 0 ? 1 : 1 + shape / 2 % 4);
  array->SetNumberOfTuples(shape < 240 ? tuples : shape % 5);
  if (auto* numbers = vtkArrayDownCast<vtkDataArray>(array))
  {
    const int kind = bytes.Below(3); // whole numbers as masks and ids have, or others
    std::vector<double> values(1 + bytes.Below(12));
    for (double& value : values)
    {
      value = kind == 0                                     ? bytes.Below(3)
        : kind == 1 || numbers->GetDataType() != VTK_DOUBLE ? std::abs(bytes.Small())
                                                            : bytes.Any();
    }
    std::size_t next = 0;
    for (vtkIdType i = 0; i < numbers->GetNumberOfTuples(); ++i)
    {
      for (int k = 0; k < numbers->GetNumberOfComponents(); ++k)
      {
        numbers->SetComponent(i, k, values[next++ % values.size()]);
      }
    }
  }
  return array;
}

inline void AddArraysFromBytes(Bytes& bytes, vtkDataSetAttributes* to, vtkIdType tuples)
{
  const int which = bytes.Byte();
  for (int k = 0; k < 4; ++k)
  {
    if (which >> k & 1)
    {
      to->AddArray(ArrayFromBytes(bytes, ArrayNames[k], tuples));
    }
  }
  if (which & 16)
  {
    to->SetActiveNormals(ArrayNames[bytes.Below(4)]);
  }
  if (which & 32)
  {
    to->AddArray(ArrayFromBytes(bytes, "vtkGhostType", tuples));
  }
}

inline void AddCellsFromBytes(Bytes& bytes, vtkPolyData* surface)
{
  const auto n = static_cast<int>(surface->GetNumberOfPoints());
  const bool wild = bytes.Below(16) == 1;
  std::array<std::vector<Cell>, 4> cells;
  const int count = bytes.Below(40);
  for (int c = 0; c < count && bytes.Left() > 0; ++c)
  {
    const int shape = bytes.Byte();
    constexpr int kinds[] = { 2, 2, 2, 2, 2, 3, 1, 0 };
    Cell cell(shape % 8 < 4 ? 3 : shape / 8 % 9);
    for (vtkIdType& id : cell)
    {
      const int byte = bytes.Byte();
      id = wild ? byte - 3 : byte % std::max(1, n);
    }
    if (n > 0 || wild)
    {
      cells[kinds[shape % 8]].push_back(cell);
    }
  }
  vtkCellArray* of[] = { surface->GetVerts(), surface->GetLines(), surface->GetPolys(),
    surface->GetStrips() };
  const bool short32 = bytes.Flag();
  for (int kind = 0; kind < 4; ++kind)
  {
    vtkNew<vtkCellArray> all;
    all->DeepCopy(of[kind]);
    if (short32)
    {
      all->ConvertTo32BitStorage();
    }
    for (const Cell& cell : cells[kind])
    {
      all->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
    }
    of[kind] == surface->GetVerts()     ? surface->SetVerts(all)
      : of[kind] == surface->GetLines() ? surface->SetLines(all)
      : of[kind] == surface->GetPolys() ? surface->SetPolys(all)
                                        : surface->SetStrips(all);
  }
}

/// A ball, a sheet, two balls or nothing to begin with, some points moved and some added.
inline Surface PointsFromBytes(Bytes& bytes)
{
  constexpr int types[] = { VTK_DOUBLE, VTK_FLOAT, VTK_INT };
  const int type = types[bytes.Below(3)];
  Surface surface;
  switch (bytes.Below(6))
  {
    case 0:
      surface = MakeSurface({}, {}, type);
      break;
    case 1:
      surface = MakeEllipsoid({ 1, 0.8, 2 }, Faces::Triangles, 8, 5, type);
      break;
    case 2:
      surface = MakeEllipsoid({ 3, 3, 3 }, Faces::Quads, 6, 4, type);
      break;
    case 3:
      surface = MakeEllipsoid({ 2, 1, 1 }, Faces::Strips, 6, 4, type);
      break;
    case 4:
      surface = MakeSurface({ { 0, 0, 0 }, { 4, 0, 0 }, { 4, 4, 0 }, { 0, 4, 0 }, { 2, 2, 1 } },
        { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 0, 4 } }, type);
      break;
    default:
      surface =
        WithPointsOf(Together({ MakeEllipsoid({ 1, 1, 1 }, Faces::Triangles, 5, 3),
                       Shifted(MakeEllipsoid({ 1, 2, 1 }, Faces::Triangles, 5, 3), { 3, 0, 0 }) }),
          type);
  }
  const int wild = bytes.Below(4);
  const auto place = [&bytes, wild, type]
  {
    const auto coordinate = [&]
    { return wild == 1 && type != VTK_INT ? bytes.Any() : bytes.Small(); };
    const double x = coordinate();
    const double y = coordinate();
    return Vector{ x, y, coordinate() };
  };
  const int moved = bytes.Below(16);
  for (int k = 0; k < moved && surface->GetNumberOfPoints() > 0; ++k)
  {
    const vtkIdType at = bytes.Byte() % surface->GetNumberOfPoints();
    surface->GetPoints()->SetPoint(at, place().data());
  }
  const int added = bytes.Below(48);
  for (int k = 0; k < added && bytes.Left() > 0; ++k)
  {
    surface->GetPoints()->InsertNextPoint(place().data());
  }
  return surface;
}

inline Surface SurfaceFromBytes(Bytes& bytes)
{
  Surface surface = PointsFromBytes(bytes);
  AddCellsFromBytes(bytes, surface);
  AddArraysFromBytes(bytes, surface->GetPointData(), surface->GetNumberOfPoints());
  AddArraysFromBytes(bytes, surface->GetCellData(), surface->GetNumberOfCells());
  return surface;
}

inline vtkSmartPointer<vtkSelection> SelectionFromBytes(Bytes& bytes)
{
  std::vector<vtkIdType> ids(bytes.Below(12));
  for (vtkIdType& id : ids)
  {
    id = bytes.Byte() - 3;
  }
  return MakeSelection(ids, bytes.Flag() ? vtkSelectionNode::POINT : vtkSelectionNode::CELL,
    bytes.Below(8) == 1 ? bytes.Below(12) : vtkSelectionNode::INDICES);
}
}

#endif
