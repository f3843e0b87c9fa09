// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkConvexProxyDeformFilter.h"

#include "BlendFunction.h"
#include "ProxyDeformation.h"
#include "vtkFilterSupport.h"
#include "vtkMovedSurface.h"
#include "vtkPoissonDisk.h"
#include "vtkProxyOutputs.h"
#include "vtkStyleModel.h"
#include "vtkSurfaceMeshConversion.h"
#include "vtkSurfaceRegion.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

using SphericalStyle::Points;
using SphericalStyle::ProxyDeformation;
using SphericalStyle::ProxyDeformationOptions;
using SphericalStyle::ProxyDeformationReport;
using namespace vtkFilterSupport;

vtkStandardNewMacro(vtkConvexProxyDeformFilter);

namespace
{
enum InputArrays
{
  NORMALS = 0,
  DIRECTIONS = 1,
  BLEND_ARRAY = 2,
  REGION_MASK = 3
};

/// With RefineLongEdges, fraction of the diagonal: that of vtkSphericalStyleFilter.
constexpr double LongestEdge = 0.04;

/// Corner to corner of the bounds, the length that fractions refer to.
double Diagonal(const Points& P)
{
  return P.rows() > 0 ? (P.colwise().maxCoeff() - P.colwise().minCoeff()).stableNorm() : 0.0;
}

/// The triangles of input 1. @throw std::invalid_argument naming the proxy
SphericalStyle::TriangleMesh OwnProxy(vtkPolyData* input)
{
  SphericalStyle::TriangleMesh mesh;
  if (input->GetNumberOfPoints() > 0)
  {
    try
    {
      mesh = vtkSurfaceMeshConversion::FromPolyData(input, true).Mesh;
    }
    catch (const std::invalid_argument& error)
    {
      throw std::invalid_argument(std::string("Proxy: ") + error.what());
    }
  }
  if (mesh.F.rows() == 0)
  {
    throw std::invalid_argument("Proxy: input 1 has no triangle with an area");
  }
  return mesh;
}

/// Where a mark is set.
std::vector<int> Marked(const std::vector<char>& marks)
{
  std::vector<int> result;
  for (std::size_t i = 0; i < marks.size(); ++i)
  {
    if (marks[i])
    {
      result.push_back(static_cast<int>(i));
    }
  }
  return result;
}

}

/// What is kept between executions.
struct vtkConvexProxyDeformFilter::Internals
{
  vtkStyleModel Model{ vtkSurfaceMeshConversion::TakePoints::All };
  SphericalStyle::ProxyDeformation Deformation;
};

//------------------------------------------------------------------------------------------------
vtkConvexProxyDeformFilter::vtkConvexProxyDeformFilter()
  : Internal(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(3);
  this->SetInputArrayToProcess(
    NORMALS, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::NORMALS);
  for (const int index : { DIRECTIONS, BLEND_ARRAY, REGION_MASK })
  {
    this->SetInputArrayToProcess(index, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "");
  }
}

vtkConvexProxyDeformFilter::~vtkConvexProxyDeformFilter() = default;

void vtkConvexProxyDeformFilter::SetProxyConnection(vtkAlgorithmOutput* proxy)
{
  this->SetInputConnection(PROXY, proxy);
}

void vtkConvexProxyDeformFilter::SetProxyData(vtkPolyData* proxy)
{
  this->SetInputData(PROXY, proxy);
}

void vtkConvexProxyDeformFilter::SetSelectionConnection(vtkAlgorithmOutput* selection)
{
  this->SetInputConnection(SELECTION, selection);
}

void vtkConvexProxyDeformFilter::SetSelectionData(vtkDataObject* selection)
{
  this->SetInputData(SELECTION, selection);
}

int vtkConvexProxyDeformFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(
    vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == SELECTION ? "vtkSelection" : "vtkPolyData");
  if (port != MODEL)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  else
  {
    TakeDataSet(info);
  }
  return 1;
}

int vtkConvexProxyDeformFilter::RequestWholeData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return RunGuarded(
    this, outputVector, [&] { return this->Execute(inputVector, outputVector); },
    [this] { this->Internal = std::make_unique<Internals>(); });
}

int vtkConvexProxyDeformFilter::Execute(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  namespace Conversion = vtkSurfaceMeshConversion;
  vtkPolyData* input = vtkPolyData::GetData(inputVector[MODEL], 0);
  vtkPolyData* ownProxy = vtkPolyData::GetData(inputVector[PROXY], 0);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  this->SetFacts({}, 0, 0.0, false);
  if (!IsSurface(this, inputVector[MODEL]))
  {
    return 0;
  }
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return 1;
  }

  this->CheckProperties();
  vtkStyleModel::Refinement refinement;
  refinement.When = this->RefineLongEdges;
  refinement.Length = LongestEdge;
  refinement.Region = this->GetInputArrayInformation(REGION_MASK);
  const vtkStyleModel::Solved model = this->Internal->Model.Update(
    this, input, vtkSelection::GetData(inputVector[SELECTION], 0), true, refinement);
  const vtkSurfaceMesh& surface = *model.Surface;
  ProxyDeformationOptions options = this->MakeOptions();
  this->TakeArrays(surface, model.Model, options);
  if (ownProxy)
  {
    options.ownProxy = OwnProxy(ownProxy);
  }
  const std::vector<char> region =
    vtkSurfaceRegion::Marks(this, refinement.Region, model.Selection, model.Model, surface);
  const bool perAxis = this->TakeBlend(surface, model.Model, region, options);
  if (this->HullOf == REGION)
  {
    options.hullPoints = Marked(region);
  }
  this->SetProgressText("Rounding the proxy");
  ProxyDeformation& deformation = this->Internal->Deformation;
  const ProxyDeformationReport report = deformation.Deform(model.ShareMesh(), options,
    [this](double share)
    {
      this->UpdateProgress(0.1 + 0.9 * share);
      return !Aborted(this);
    });
  if (report.aborted)
  {
    return 1;
  }

  output->ShallowCopy(model.Model);
  vtkMovedSurface::Fill(this, output, surface, deformation.GetPositions());
  const Conversion::Rows t = options.t.leftCols(perAxis ? 3 : 1);
  Conversion::AddPointArray(output, surface, "t", VTK_DOUBLE, t);
  Conversion::AddDisplacement(output, model.Model);
  if (this->GenerateProjectionArrays)
  {
    vtkProxyOutputs::AddFeet(output, surface, deformation.GetFeet());
  }
  vtkProxyOutputs::FillProxy(vtkPolyData::GetData(outputVector, 1), deformation, report);
  vtkProxyOutputs::FillLines(
    vtkPolyData::GetData(outputVector, 2), model.Model, surface, t, deformation);
  const SphericalStyle::TriangleMesh& proxy = deformation.GetProxy().rest;
  for (const std::string& warning : vtkProxyOutputs::Warnings(surface, options, proxy, report))
  {
    Warn(this, warning);
  }
  this->SetFacts(
    report, static_cast<int>(proxy.P.rows()), Diagonal(surface.Mesh.P), ownProxy != nullptr);
  return 1;
}

void vtkConvexProxyDeformFilter::CheckProperties() const
{
  RequireTarget(this->Roundness, this->CenterMode == CUSTOM_CENTER ? this->Center : nullptr,
    this->RadiusMode == CUSTOM_RADIUS ? &this->Radius : nullptr);
  Require(this->Blend >= 0.0 && this->Blend <= 1.0, "Blend", "in 0..1", this->Blend);
  Require(this->BorderWidth >= 0.0 && this->BorderWidth <= 1.0, "BorderWidth", "in 0..1",
    this->BorderWidth);
  for (const double gain : this->AxisGain)
  {
    Require(std::isfinite(gain) && gain >= 0.0, "AxisGain", "finite and 0 or more", gain);
  }
}

ProxyDeformationOptions vtkConvexProxyDeformFilter::MakeOptions() const
{
  ProxyDeformationOptions o;
  o.convexProxy.mesher = static_cast<SphericalStyle::ProxyMesher>(this->ProxyMesher);
  o.convexProxy.numberOfPoints = this->NumberOfProxyPoints;
  o.convexProxy.seed = static_cast<std::uint32_t>(this->Seed);
  o.convexProxy.poissonDisk = vtkPoissonDisk;
  o.style.lambda = this->Roundness;
  o.style.centerMode = static_cast<SphericalStyle::CenterMode>(this->CenterMode);
  o.style.radiusMode = static_cast<SphericalStyle::RadiusMode>(this->RadiusMode);
  o.style.custom = { Eigen::Vector3d(this->Center), this->Radius };
  o.style.sphericalWeighting =
    static_cast<SphericalStyle::SphericalWeighting>(this->SphericalWeighting);
  o.projection = static_cast<SphericalStyle::Projection>(this->Projection);
  o.neighbors = this->NumberOfNeighbors;
  o.transfer = static_cast<SphericalStyle::Transfer>(this->Transfer);
  o.gain = Eigen::Vector3d(this->AxisGain);
  o.threads = ThreadsToUse(this->NumberOfThreads);
  return o;
}

void vtkConvexProxyDeformFilter::TakeArrays(
  const vtkSurfaceMesh& surface, vtkPolyData* model, ProxyDeformationOptions& o)
{
  namespace Conversion = vtkSurfaceMeshConversion;
  const auto gather = [&](int index, const Conversion::ArrayRule& rule)
  {
    return Conversion::GatherPointArray(
      this->GetInputArrayInformation(index), model, surface, rule);
  };
  if (this->Projection == SMALLEST_ANGLE)
  {
    o.normals = gather(NORMALS, Conversion::NormalsRule);
  }
  if (this->Projection == DIRECTION_ARRAY)
  {
    o.directions =
      gather(DIRECTIONS, { "Directions", 3, -Conversion::Infinity, Conversion::Infinity });
    if (o.directions.rows() == 0)
    {
      throw std::invalid_argument(
        "Directions: Projection is DirectionArray, but no array is set to process (index 1)");
    }
  }
}

bool vtkConvexProxyDeformFilter::TakeBlend(const vtkSurfaceMesh& surface, vtkPolyData* model,
  const std::vector<char>& region, ProxyDeformationOptions& options)
{
  const Points& P = surface.Mesh.P;
  Points& t = options.t;
  bool perAxis = false;
  if (this->BlendFunction == ARRAY)
  {
    vtkInformation* wanted = this->GetInputArrayInformation(BLEND_ARRAY);
    vtkDataArray* array = vtkSurfaceMeshConversion::FindPointArray(wanted, model, "Blend array");
    if (!array)
    {
      throw std::invalid_argument(
        "Blend array: BlendFunction is Array, but no array is set to process (index 2)");
    }
    perAxis = array->GetNumberOfComponents() == 3;
    t = vtkSurfaceMeshConversion::GatherPointArray(
      wanted, model, surface, { "Blend array", perAxis ? 3 : 1, 0.0, 1.0 });
    if (!perAxis)
    {
      t = t.col(0).replicate<1, 3>().eval();
    }
  }
  else
  {
    SphericalStyle::BlendOptions o;
    o.function = static_cast<SphericalStyle::BlendFunction>(this->BlendFunction);
    o.constant = this->Blend;
    o.axis = Eigen::Vector3d(this->BlendAxis);
    o.range = Eigen::Vector2d(this->BlendRange);
    o.atStart = this->BlendAtStart;
    o.atEnd = this->BlendAtEnd;
    o.steepness = this->TanhSteepness;
    t = SphericalStyle::BlendAlongAxis(P, o).replicate<1, 3>();
  }
  if (!region.empty())
  {
    const Eigen::VectorXd inside =
      vtkSurfaceRegion::Weights(P, region, this->BorderWidth, ThreadsToUse(this->NumberOfThreads));
    // This way round t stays what it is well inside, and is 1 outside, to the last bit.
    t = (t.array() + (1.0 - t.array()).colwise() * (1.0 - inside.array())).matrix().eval();
  }
  return perAxis;
}

void vtkConvexProxyDeformFilter::SetFacts(
  const ProxyDeformationReport& report, int proxyPoints, double diagonal, bool ownProxy)
{
  this->EffectiveNumberOfProxyPoints = proxyPoints;
  this->EffectiveProxyMesher = report.fallback.empty() ? this->ProxyMesher : ISOTROPIC_REMESHING;
  if (ownProxy || proxyPoints == 0)
  {
    this->EffectiveProxyMesher = -1;
  }
  this->ConvexityRatio = report.convexityRatio;
  this->TrianglesTurnedOver = report.turnedOver;
  std::copy_n(report.caseCounts.data(), 3, this->ProjectionCaseCounts);
  this->ProjectionError = diagonal > 0.0 ? report.projectionError / diagonal : 0.0;
  std::copy_n(report.style.sphere.center.data(), 3, this->EffectiveCenter);
  this->EffectiveRadius = proxyPoints > 0 ? report.style.sphere.radius : 0.0;
}

void vtkConvexProxyDeformFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ProxyMesher: " << this->ProxyMesher << "\n";
  os << indent << "HullOf: " << this->HullOf << "\n";
  os << indent << "NumberOfProxyPoints: " << this->NumberOfProxyPoints << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "Roundness: " << this->Roundness << "\n";
  os << indent << "CenterMode: " << this->CenterMode << "\n";
  os << indent << "Center: " << Triple(this->Center) << "\n";
  os << indent << "RadiusMode: " << this->RadiusMode << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "SphericalWeighting: " << this->SphericalWeighting << "\n";
  os << indent << "Projection: " << this->Projection << "\n";
  os << indent << "NumberOfNeighbors: " << this->NumberOfNeighbors << "\n";
  os << indent << "BlendFunction: " << this->BlendFunction << "\n";
  os << indent << "Blend: " << this->Blend << "\n";
  os << indent << "BlendAxis: " << Triple(this->BlendAxis) << "\n";
  os << indent << "BlendRange: (" << this->BlendRange[0] << ", " << this->BlendRange[1] << ")\n";
  os << indent << "BlendAtStart: " << this->BlendAtStart << "\n";
  os << indent << "BlendAtEnd: " << this->BlendAtEnd << "\n";
  os << indent << "TanhSteepness: " << this->TanhSteepness << "\n";
  os << indent << "AxisGain: " << Triple(this->AxisGain) << "\n";
  os << indent << "BorderWidth: " << this->BorderWidth << "\n";
  os << indent << "Transfer: " << this->Transfer << "\n";
  os << indent << "RefineLongEdges: " << this->RefineLongEdges << "\n";
  os << indent << "GenerateProjectionArrays: " << OnOff(this->GenerateProjectionArrays) << "\n";
  os << indent << "EffectiveNumberOfProxyPoints: " << this->EffectiveNumberOfProxyPoints << "\n";
  os << indent << "EffectiveProxyMesher: " << this->EffectiveProxyMesher << "\n";
  os << indent << "ConvexityRatio: " << this->ConvexityRatio << "\n";
  os << indent << "TrianglesTurnedOver: " << this->TrianglesTurnedOver << "\n";
  os << indent << "ProjectionCaseCounts: (" << this->ProjectionCaseCounts[0] << ", "
     << this->ProjectionCaseCounts[1] << ", " << this->ProjectionCaseCounts[2] << ")\n";
  os << indent << "ProjectionError: " << this->ProjectionError << "\n";
  os << indent << "EffectiveCenter: " << Triple(this->EffectiveCenter) << "\n";
  os << indent << "EffectiveRadius: " << this->EffectiveRadius << "\n";
}
