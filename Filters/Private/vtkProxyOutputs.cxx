// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkProxyOutputs.h"

#include "vtkFilterSupport.h"
#include "vtkTargetSphere.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cmath>
#include <sstream>

using SphericalStyle::DeformedProxy;
using SphericalStyle::ProxyDeformation;
using SphericalStyle::ProxyDeformationReport;

namespace
{
// Limits of the warnings: share of the hull that the model fills, and of its triangles that turned
// over. A creature with arms and ears fills half of its hull and does well.
constexpr double FarFromConvex = 1.0 / 3.0;
constexpr double ManyTurnedOver = 0.01;
}

namespace vtkProxyOutputs
{
void FillProxy(
  vtkPolyData* output, const ProxyDeformation& deformation, const ProxyDeformationReport& report)
{
  const DeformedProxy& proxy = deformation.GetProxy();
  const vtkIdType n = proxy.rounded.rows();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(n);
  vtkNew<vtkDoubleArray> rest;
  vtkNew<vtkDoubleArray> displacement;
  rest->SetName("RestPosition");
  displacement->SetName("Displacement");
  for (vtkDoubleArray* array : { rest.Get(), displacement.Get() })
  {
    array->SetNumberOfComponents(3);
    array->SetNumberOfTuples(n);
    output->GetPointData()->AddArray(array);
  }
  const SphericalStyle::Points moved = proxy.rounded - proxy.rest.P;
  for (vtkIdType i = 0; i < n; ++i)
  {
    points->SetPoint(i, proxy.rounded.row(i).data());
    rest->SetTuple(i, proxy.rest.P.row(i).data());
    displacement->SetTuple(i, moved.row(i).data());
  }
  vtkNew<vtkCellArray> triangles;
  for (const auto& t : proxy.rest.F.rowwise())
  {
    const vtkIdType ids[] = { t[0], t[1], t[2] };
    triangles->InsertNextCell(3, ids);
  }
  output->SetPoints(points);
  output->SetPolys(triangles);

  const auto& s = report.seconds;
  vtkFilterSupport::AddStageSeconds(output->GetFieldData(),
    { { "Proxy", s.proxy }, { "Round", s.round }, { "Project", s.project },
      { "Transfer", s.transfer } });
}

void FillLines(vtkPolyData* output, vtkPolyData* input, const vtkSurfaceMesh& surface,
  const vtkSurfaceMeshConversion::Rows& t, const ProxyDeformation& deformation)
{
  const DeformedProxy& proxy = deformation.GetProxy();
  const SphericalStyle::Points q =
    SphericalStyle::Interpolate(proxy.rest.F, deformation.GetFeet(), proxy.rest.P);
  const vtkIdType n = input->GetNumberOfPoints();
  vtkNew<vtkPoints> points;
  points->SetDataType(input->GetPoints()->GetDataType() == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE);
  points->SetNumberOfPoints(2 * n);
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkIdTypeArray> pointIds;
  pointIds->SetName("PointId");
  pointIds->SetNumberOfTuples(n);
  vtkNew<vtkDoubleArray> weights;
  weights->SetName("t");
  weights->SetNumberOfComponents(static_cast<int>(t.cols()));
  weights->SetNumberOfTuples(n);
  for (vtkIdType i = 0; i < n; ++i)
  {
    const int at = surface.MeshPoint[i];
    points->SetPoint(2 * i, input->GetPoint(i));
    points->SetPoint(2 * i + 1, q.row(at).data());
    const vtkIdType ends[] = { 2 * i, 2 * i + 1 };
    lines->InsertNextCell(2, ends);
    pointIds->SetValue(i, i);
    weights->SetTuple(i, t.row(at).data());
  }
  output->SetPoints(points);
  output->SetLines(lines);
  output->GetCellData()->AddArray(pointIds);
  output->GetCellData()->AddArray(weights);
}

void AddFeet(vtkPolyData* output, const vtkSurfaceMesh& surface, const SphericalStyle::Feet& feet)
{
  using vtkSurfaceMeshConversion::AddPointArray;
  AddPointArray(output, surface, "ProxyCell", VTK_ID_TYPE, feet.cell.cast<double>());
  AddPointArray(output, surface, "Barycentric", VTK_DOUBLE, feet.barycentric);
  if (feet.projectionCase.size() > 0)
  {
    AddPointArray(output, surface, "ProjectionCase", VTK_INT, feet.projectionCase.cast<double>());
  }
}

std::vector<std::string> Warnings(const vtkSurfaceMesh& surface,
  const SphericalStyle::ProxyDeformationOptions& options, const SphericalStyle::TriangleMesh& proxy,
  const ProxyDeformationReport& report)
{
  using vtkFilterSupport::Count;
  std::vector<std::string> warnings;
  const auto warn = [&warnings](const std::string& text) { warnings.push_back(text); };
  if (!report.fallback.empty())
  {
    warn("the proxy was made by IsotropicRemeshing, since the chosen ProxyMesher failed: " +
      report.fallback);
  }
  if (report.flat)
  {
    warn("all points lie in a plane: the proxy is the flat polygon around them and becomes a disc");
  }
  if (report.withoutHit > 0)
  {
    warn("the directions of " + Count(report.withoutHit, "point") +
      " meet no proxy, the first is point " +
      std::to_string(surface.FirstInputPoint(report.firstWithoutHit)) +
      "; the closest point is taken");
  }
  if (options.style.radiusMode == SphericalStyle::RadiusMode::EqualVolume)
  {
    warn(vtkTargetSphere::VolumeRemark("the proxy", proxy));
  }
  if (!report.style.loop.converged)
  {
    warn("the rounding of the proxy did not converge");
  }
  std::ostringstream far;
  if (report.convexityRatio < FarFromConvex)
  {
    far << "the model fills " << std::lround(100.0 * report.convexityRatio)
        << " % of its convex hull; this filter is meant for models that are about convex";
  }
  if (report.turnedOver > ManyTurnedOver * static_cast<double>(surface.Mesh.F.rows()))
  {
    far << (far.tellp() > 0 ? ". " : "") << report.turnedOver << " of "
        << Count(surface.Mesh.F.rows(), "triangle")
        << " turned over. Nearer to 1, t does less harm; Transfer Offset and a region may help";
  }
  if (far.tellp() > 0)
  {
    warn(far.str());
  }
  return warnings;
}
}
