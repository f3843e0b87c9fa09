// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfacePair.h"

#include "SharedNumbers.h"
#include "SurfaceMeasures.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
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

/// The reference with the marks of the input: what another process owns is the same in both.
vtkSmartPointer<vtkPolyData> WithMarksOf(vtkPolyData* input, vtkPolyData* reference)
{
  auto marked = vtkSmartPointer<vtkPolyData>::New();
  marked->ShallowCopy(reference);
  if (!marked->GetPoints())
  {
    marked->SetPoints(vtkNew<vtkPoints>());
  }
  using Attributes = std::pair<vtkDataSetAttributes*, vtkDataSetAttributes*>;
  for (const auto& [from, to] : { Attributes(input->GetPointData(), marked->GetPointData()),
         Attributes(input->GetCellData(), marked->GetCellData()) })
  {
    const char* name = vtkDataSetAttributes::GhostArrayName();
    to->RemoveArray(name);
    if (vtkAbstractArray* marks = from->GetAbstractArray(name))
    {
      to->AddArray(marks);
    }
  }
  return marked;
}

/// @throw std::invalid_argument, or WholeSurfaceNeeded on all processes where it is spread
void RequireSameParts(vtkPolyData* reference, vtkPolyData* input, const vtkSurfaceMesh& surface)
{
  const auto require = [&]
  {
    RequireSameNumber(reference->GetNumberOfPoints(), input->GetNumberOfPoints(), "points");
    RequireSameCells(reference, input);
  };
  if (surface.Part.IsWhole())
  {
    require();
    return;
  }
  double differ = 0.0;
  try
  {
    require();
  }
  catch (const std::invalid_argument&)
  {
    differ = 1.0;
  }
  if (surface.Part.Max(differ) > 0.0)
  {
    throw SphericalStyle::WholeSurfaceNeeded("the parts of the reference are others");
  }
}

/// Points of Rest that several processes have: those that they have in the input and in the
/// reference.
SphericalStyle::SurfacePart PartOfPair(const vtkSurfaceMesh& surface, const vtkSurfaceMesh& before,
  const std::vector<vtkIdType>& firstPoint)
{
  const auto numbers = [](const vtkSurfaceMesh& mesh)
  {
    std::vector<int> numberOf(mesh.Mesh.P.rows(), -1);
    for (std::size_t k = 0; k < mesh.Part.shared.size(); ++k)
    {
      numberOf[mesh.Part.shared[k]] = mesh.Part.numbers[k];
    }
    return numberOf;
  };
  const std::vector<int> now = numbers(surface);
  const std::vector<int> then = numbers(before);
  std::vector<std::array<double, 2>> names;
  std::vector<int> points;
  for (std::size_t i = 0; i < firstPoint.size(); ++i)
  {
    const int here = now[surface.MeshPoint[firstPoint[i]]];
    const int there = then[before.MeshPoint[firstPoint[i]]];
    if (here >= 0 && there >= 0)
    {
      names.push_back({ static_cast<double>(here), static_cast<double>(there) });
      points.push_back(static_cast<int>(i));
    }
  }
  return SphericalStyle::PartByNames(names, points, firstPoint.size(), surface.Part);
}
}

vtkSurfacePair vtkMakeSurfacePair(
  vtkPolyData* input, const vtkSurfaceMesh& surface, vtkPolyData* reference, bool weld)
{
  RequireSameParts(reference, input, surface);
  vtkSurfaceMesh before;
  try
  {
    const vtkSmartPointer<vtkPolyData> marked = surface.Part.IsWhole()
      ? vtkSmartPointer<vtkPolyData>(reference)
      : WithMarksOf(input, reference);
    before = vtkSurfaceMeshConversion::FromPolyData(
      marked, weld, vtkSurfaceMeshConversion::TakePoints::All, surface.Part.processes);
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
  if (surface.Part.Max(pair.Triangle.empty() ? 0.0 : 1.0) == 0.0)
  {
    Refuse("it has no triangle with an area");
  }
  pair.Rest.F.conservativeResize(static_cast<Eigen::Index>(pair.Triangle.size()), 3);
  pair.Part = PartOfPair(surface, before, firstPoint);
  pair.Reference = std::move(before.Mesh);
  pair.ReferencePart = std::move(before.Part);
  return pair;
}
