// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "pqSmoothShading.h"

#include "pqPropertyWidget.h"
#include "pqShownValue.h"
#include "pqSourceOf.h"
#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkStaticCleanPolyData.h"
#include "vtkTriangle.h"
#include "vtkTriangleFilter.h"

#include <QTimer>

#include <algorithm>
#include <cmath>

namespace
{
constexpr vtkIdType MostPoints = 200000;
/// Of 50 models ten with hard edges have .34 or more and 38 have .15 or less. A trumpet has .28,
/// and bones of few triangles have .35.
constexpr double MostSharp = 0.2;
/// 40 degrees: at a right angle normals are off by 45, and no rounding should decide about that.
constexpr double SharpCosine = 0.766;

/// Filters of VTK take it for granted.
bool IsValid(vtkPolyData* surface)
{
  const vtkIdType n = surface->GetNumberOfPoints();
  vtkDataArray* ids = surface->GetPolys()->GetConnectivityArray();
  for (vtkIdType k = 0; k < ids->GetNumberOfTuples(); ++k)
  {
    const double id = ids->GetComponent(k, 0);
    if (id < 0 || id >= static_cast<double>(n))
    {
      return false;
    }
  }
  for (vtkIdType i = 0; i < n; ++i)
  {
    const double* p = surface->GetPoint(i);
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
    {
      return false;
    }
  }
  return surface->GetNumberOfStrips() == 0;
}

/// The share of the area in triangles that normals would shade by over 40 degrees too far.
double SharpShare(vtkPolyData* surface)
{
  vtkNew<vtkStaticCleanPolyData> clean;
  clean->SetInputData(surface);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(clean->GetOutputPort());
  triangles->PassVertsOff();
  triangles->PassLinesOff();
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(triangles->GetOutputPort());
  normals->SplittingOff();
  normals->ConsistencyOff();
  normals->Update();
  vtkPolyData* shaded = normals->GetOutput();
  vtkDataArray* smooth = shaded->GetPointData()->GetNormals();
  double sharp = 0.0;
  double all = 0.0;
  vtkNew<vtkIdList> ids;
  for (vtkIdType f = 0; smooth && f < shaded->GetPolys()->GetNumberOfCells(); ++f)
  {
    shaded->GetPolys()->GetCellAtId(f, ids);
    double corners[3][3];
    double n[3];
    for (int k = 0; k < 3; ++k)
    {
      shaded->GetPoint(ids->GetId(k), corners[k]);
    }
    vtkTriangle::ComputeNormal(corners[0], corners[1], corners[2], n);
    double least = 1.0;
    for (int k = 0; k < 3; ++k)
    {
      least = std::min(least, std::abs(vtkMath::Dot(smooth->GetTuple3(ids->GetId(k)), n)));
    }
    const double area = vtkTriangle::TriangleArea(corners[0], corners[1], corners[2]);
    all += area;
    sharp += least < SharpCosine ? area : 0.0;
  }
  return all > 0.0 ? sharp / all : 1.0;
}

/// The model of a filter, where this process has it.
vtkPolyData* ModelOf(vtkSMProxy* filter)
{
  const vtkSMPropertyHelper input(filter, "Input");
  vtkSMProxy* source = input.GetAsProxy();
  auto* algorithm = source ? vtkAlgorithm::SafeDownCast(source->GetClientSideObject()) : nullptr;
  const auto port = static_cast<int>(input.GetOutputPort());
  return algorithm && port < algorithm->GetNumberOfOutputPorts()
    ? vtkPolyData::SafeDownCast(algorithm->GetOutputDataObject(port))
    : nullptr;
}
}

pqSmoothShading::pqSmoothShading(vtkPVXMLElement* xml, pqPropertyWidget* widget)
  : pqPropertyWidgetDecorator(xml, widget)
{
  QTimer::singleShot(0, this, [this] { this->begin(); }); // the panel listens then
}

void pqSmoothShading::begin()
{
  pqPropertyWidget* widget = this->parentWidget();
  const pqPipelineSource* filter = pqSourceOf(widget->proxy());
  vtkPolyData* model = ModelOf(widget->proxy());
  if (filter && filter->modifiedState() == pqProxy::UNINITIALIZED && model &&
    model->GetNumberOfPoints() <= MostPoints && !model->GetPointData()->GetNormals() &&
    IsValid(model) && SharpShare(model) <= MostSharp)
  {
    pqShownValue::set(widget->property(), 1.0);
    Q_EMIT widget->changeAvailable();
  }
}
