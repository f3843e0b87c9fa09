// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRestPose.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace
{
/// No array of a model has this name.
constexpr const char* OwnPoints = "vtkRestPose::OwnPoints";

/// The first cell that differs, or -1.
vtkIdType FirstDifference(vtkCellArray* one, vtkCellArray* other)
{
  const vtkIdType count = one->GetNumberOfCells();
  vtkNew<vtkIdList> ids;
  vtkNew<vtkIdList> others;
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    if (cell >= other->GetNumberOfCells())
    {
      return cell;
    }
    one->GetCellAtId(cell, ids);
    other->GetCellAtId(cell, others);
    if (!std::equal(ids->begin(), ids->end(), others->begin(), others->end()))
    {
      return cell;
    }
  }
  return other->GetNumberOfCells() > count ? count : -1;
}

void Check(vtkPolyData* model, vtkPolyData* rest)
{
  if (model->GetNumberOfPoints() != rest->GetNumberOfPoints())
  {
    throw std::invalid_argument("The rest pose has " + std::to_string(rest->GetNumberOfPoints()) +
      " points and the model has " + std::to_string(model->GetNumberOfPoints()) +
      "; it must be the same surface, as a time step of it is");
  }
  vtkIdType before = 0; // cells in the arrays before
  for (const auto cells : { &vtkPolyData::GetVerts, &vtkPolyData::GetLines, &vtkPolyData::GetPolys,
         &vtkPolyData::GetStrips })
  {
    vtkCellArray* own = (model->*cells)();
    vtkCellArray* others = (rest->*cells)();
    const vtkIdType first = own == others ? -1 : FirstDifference(own, others);
    if (first >= 0)
    {
      throw std::invalid_argument(
        "The rest pose has other cells than the model, the first is cell " +
        std::to_string(before + first) + "; it must be the same surface, as a time step of it is");
    }
    before += own->GetNumberOfCells();
  }
}
}

vtkSmartPointer<vtkPolyData> vtkRestPose::AtRest(vtkPolyData* model, vtkPolyData* rest)
{
  vtkSurfaceMeshConversion::CheckPiece(model);
  Check(model, rest);
  vtkDataArray* points = model->GetPoints()->GetData();
  const auto own = vtkSmartPointer<vtkDataArray>::Take(points->NewInstance());
  own->DeepCopy(points);
  own->SetName(OwnPoints);
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->ShallowCopy(model);
  result->SetPoints(rest->GetPoints());
  result->GetPointData()->AddArray(own);
  return result;
}

std::shared_ptr<const SphericalStyle::TriangleMesh> vtkRestPose::TakeBack(
  vtkStyleModel::Solved& solved)
{
  auto model = vtkSmartPointer<vtkPolyData>::New();
  model->ShallowCopy(solved.Model);
  vtkSmartPointer<vtkDataArray> own = model->GetPointData()->GetArray(OwnPoints);
  model->GetPointData()->RemoveArray(OwnPoints);
  own->SetName("Points");
  vtkNew<vtkPoints> points;
  points->SetData(own);
  model->SetPoints(points);

  std::shared_ptr<const SphericalStyle::TriangleMesh> rest = solved.ShareMesh();
  auto posed = std::make_shared<vtkSurfaceMesh>(*solved.Surface);
  // Backward, so that of points that were welded the first one counts.
  std::size_t notMoved = posed->NotMovedPoints.size();
  for (vtkIdType i = own->GetNumberOfTuples() - 1; i >= 0; --i)
  {
    const int point = posed->MeshPoint[i];
    own->GetTuple(i,
      point == vtkSurfaceMesh::NotMoved ? &posed->NotMovedPoints[notMoved -= 3]
                                        : posed->Mesh.P.row(point).data());
  }
  solved.Model = model;
  solved.Surface = posed;
  return rest;
}
