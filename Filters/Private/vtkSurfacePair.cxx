// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfacePair.h"

#include "SurfaceMeasures.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace
{
[[noreturn]] void Refuse(const std::string& why)
{
  throw std::invalid_argument("Reference: " + why);
}

void RequireSameNumber(vtkIdType inReference, vtkIdType inInput, const std::string& what)
{
  if (inReference != inInput)
  {
    Refuse("it has " + std::to_string(inReference) + " " + what + ", the input " +
      std::to_string(inInput));
  }
}

void RequireSameCells(vtkPolyData* reference, vtkPolyData* input)
{
  using Kind = std::pair<const char*, vtkCellArray* (vtkPolyData::*)()>;
  const Kind kinds[] = { { "vertices", &vtkPolyData::GetVerts },
    { "lines", &vtkPolyData::GetLines }, { "polygons", &vtkPolyData::GetPolys },
    { "triangle strips", &vtkPolyData::GetStrips } };
  vtkIdType cell = 0;
  vtkNew<vtkIdList> a;
  vtkNew<vtkIdList> b;
  for (const Kind& kind : kinds)
  {
    vtkCellArray* before = (reference->*kind.second)();
    vtkCellArray* now = (input->*kind.second)();
    RequireSameNumber(before->GetNumberOfCells(), now->GetNumberOfCells(), kind.first);
    for (vtkIdType i = 0; i < now->GetNumberOfCells(); ++i, ++cell)
    {
      before->GetCellAtId(i, a);
      now->GetCellAtId(i, b);
      if (!std::equal(a->begin(), a->end(), b->begin(), b->end()))
      {
        Refuse("cell " + std::to_string(cell) + " has other points than that of the input");
      }
    }
  }
}

/// One number per pair of mesh points that a triangle uses, in the order of the input points.
std::vector<int> NumberPairs(const vtkSurfaceMesh& surface, const vtkSurfaceMesh& reference,
  std::vector<vtkIdType>& firstPoint)
{
  std::vector<int> number(surface.MeshPoint.size(), vtkSurfaceMesh::NotMoved);
  std::map<std::pair<int, int>, int> numbers;
  for (std::size_t i = 0; i < number.size(); ++i)
  {
    if (surface.MeshPoint[i] >= 0)
    {
      const auto found = numbers.insert(
        { { surface.MeshPoint[i], reference.MeshPoint[i] }, static_cast<int>(firstPoint.size()) });
      number[i] = found.first->second;
      if (found.second)
      {
        firstPoint.push_back(static_cast<vtkIdType>(i));
      }
    }
  }
  return number;
}
}

vtkSurfacePair vtkMakeSurfacePair(
  vtkPolyData* input, const vtkSurfaceMesh& surface, vtkPolyData* reference, bool weld)
{
  RequireSameNumber(reference->GetNumberOfPoints(), input->GetNumberOfPoints(), "points");
  RequireSameCells(reference, input);
  vtkSurfaceMesh before;
  try
  {
    before = vtkSurfaceMeshConversion::FromPolyData(
      reference, weld, vtkSurfaceMeshConversion::TakePoints::All);
  }
  catch (const std::invalid_argument& error)
  {
    Refuse(error.what());
  }

  vtkSurfacePair pair;
  std::vector<vtkIdType> firstPoint;
  pair.Point = NumberPairs(surface, before, firstPoint);
  const auto n = static_cast<Eigen::Index>(firstPoint.size());
  pair.Rest.P.resize(n, 3);
  pair.Deformed.resize(n, 3);
  for (Eigen::Index i = 0; i < n; ++i)
  {
    pair.Rest.P.row(i) = before.Mesh.P.row(before.MeshPoint[firstPoint[i]]);
    pair.Deformed.row(i) = surface.Mesh.P.row(surface.MeshPoint[firstPoint[i]]);
  }
  pair.Rest.F.resize(surface.Mesh.F.rows(), 3);
  for (Eigen::Index f = 0; f < surface.Mesh.F.rows(); ++f)
  {
    const auto kept = static_cast<Eigen::Index>(pair.Triangle.size());
    auto corners = pair.Rest.F.row(kept);
    corners = surface.GetCorners().row(f).unaryExpr([&](int i) { return pair.Point[i]; });
    if (!SphericalStyle::IsDegenerate(
          pair.Rest.P.row(corners(0)), pair.Rest.P.row(corners(1)), pair.Rest.P.row(corners(2))))
    {
      pair.Triangle.push_back(static_cast<int>(f));
    }
  }
  if (pair.Triangle.empty())
  {
    Refuse("it has no triangle with an area");
  }
  pair.Rest.F.conservativeResize(static_cast<Eigen::Index>(pair.Triangle.size()), 3);
  pair.Reference = std::move(before.Mesh);
  return pair;
}
