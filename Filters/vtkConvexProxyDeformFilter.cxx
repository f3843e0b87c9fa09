// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkConvexProxyDeformFilter.h"

#include "Advice.h"
#include "BlendFunction.h"
#include "ProxyDeformation.h"
#include "vtkFilterSupport.h"
#include "vtkLongEdges.h"
#include "vtkPoissonDisk.h"
#include "vtkSurfaceMeshConversion.h"
#include "vtkSurfaceRegion.h"
#include "vtkTargetSphere.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using SphericalStyle::Points;
using SphericalStyle::ProxyDeformationOptions;
using SphericalStyle::ProxyDeformationReport;
using namespace vtkFilterSupport;
using vtkSurfaceMeshConversion::Rows;

vtkStandardNewMacro(vtkConvexProxyDeformFilter);

namespace
{
enum InputPorts
{
  MODEL = 0,
  PROXY = 1,
  SELECTION = 2
};

enum InputArrays
{
  NORMALS = 0,
  DIRECTIONS = 1,
  BLEND_ARRAY = 2,
  REGION_MASK = 3
};

constexpr double Infinity = std::numeric_limits<double>::infinity();

// Limits of the warnings: share of the hull that the model fills, and of its triangles that turned
// over. A creature with arms and ears fills half of its hull and does well.
constexpr double FarFromConvex = 1.0 / 3.0;
constexpr double ManyTurnedOver = 0.01;

/// Corners of the bounds, the length that fractions refer to.
/// With RefineLongEdges, fraction of the diagonal: that of vtkSphericalStyleFilter.
constexpr double LongestEdge = 0.04;

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

void FillProxy(vtkPolyData* output, const SphericalStyle::DeformedProxy& proxy,
  const ProxyDeformationReport& report)
{
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
  const Points moved = proxy.rounded - proxy.rest.P;
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
  AddStageSeconds(output->GetFieldData(),
    { { "Proxy", s.proxy }, { "Round", s.round }, { "Project", s.project },
      { "Transfer", s.transfer } });
}
}

//------------------------------------------------------------------------------------------------
struct vtkConvexProxyDeformFilter::Internals
{
  SphericalStyle::ProxyDeformation Deformation;

  /// @throw std::invalid_argument naming the property and its value
  static void CheckProperties(const vtkConvexProxyDeformFilter* self);
  /// The array for index, one row per mesh point; 0 rows where none is asked for.
  static Points Gather(vtkConvexProxyDeformFilter* self, int index, int components,
    const vtkSurfaceMesh& surface, vtkPolyData* input);
  /// t of every mesh point and axis. @param perAxis  whether an array of 3 components gave it
  static Points BlendWeights(vtkConvexProxyDeformFilter* self, const vtkSurfaceMesh& surface,
    vtkPolyData* input, const std::vector<char>& region, bool& perAxis);
  static ProxyDeformationOptions MakeOptions(vtkConvexProxyDeformFilter* self,
    const vtkSurfaceMesh& surface, vtkPolyData* input, vtkPolyData* ownProxy);
  void AttachArrays(vtkConvexProxyDeformFilter* self, const vtkSurfaceMesh& surface, const Rows& t,
    vtkPolyData* input, vtkPolyData* output) const;
  void FillLines(
    const vtkSurfaceMesh& surface, const Rows& t, vtkPolyData* input, vtkPolyData* output) const;
  static void Warn(vtkConvexProxyDeformFilter* self, const vtkSurfaceMesh& surface,
    const SphericalStyle::TriangleMesh& proxy, const ProxyDeformationReport& report);
  static void SetFacts(vtkConvexProxyDeformFilter* self, const ProxyDeformationReport& report,
    int proxyPoints, double diagonal, bool ownProxy);
};

void vtkConvexProxyDeformFilter::Internals::CheckProperties(const vtkConvexProxyDeformFilter* self)
{
  RequireTarget(self->Roundness, self->CenterMode == CUSTOM_CENTER ? self->Center : nullptr,
    self->RadiusMode == CUSTOM_RADIUS ? &self->Radius : nullptr);
  Require(self->Blend >= 0.0 && self->Blend <= 1.0, "Blend", "in 0..1", self->Blend);
  Require(self->BorderWidth >= 0.0 && self->BorderWidth <= 1.0, "BorderWidth", "in 0..1",
    self->BorderWidth);
  for (const double gain : self->AxisGain)
  {
    Require(std::isfinite(gain) && gain >= 0.0, "AxisGain", "finite and 0 or more", gain);
  }
}

Points vtkConvexProxyDeformFilter::Internals::Gather(vtkConvexProxyDeformFilter* self, int index,
  int components, const vtkSurfaceMesh& surface, vtkPolyData* input)
{
  static const vtkSurfaceMeshConversion::ArrayRule rules[] = {
    { "Normals", 3, -Infinity, Infinity, vtkDataSetAttributes::NORMALS },
    { "Directions", 3, -Infinity, Infinity },
    { "Blend array", 1, 0.0, 1.0 },
  };
  vtkSurfaceMeshConversion::ArrayRule rule = rules[index];
  rule.Components = components;
  return vtkSurfaceMeshConversion::GatherPointArray(
    self->GetInputArrayInformation(index), input, surface, rule);
}

Points vtkConvexProxyDeformFilter::Internals::BlendWeights(vtkConvexProxyDeformFilter* self,
  const vtkSurfaceMesh& surface, vtkPolyData* input, const std::vector<char>& region, bool& perAxis)
{
  const Points& P = surface.Mesh.P;
  Points t;
  perAxis = false;
  if (self->BlendFunction == ARRAY)
  {
    vtkDataArray* array = vtkSurfaceMeshConversion::FindPointArray(
      self->GetInputArrayInformation(BLEND_ARRAY), input, "Blend array");
    if (!array)
    {
      throw std::invalid_argument(
        "Blend array: BlendFunction is Array, but no array is set to process (index 2)");
    }
    perAxis = array->GetNumberOfComponents() == 3;
    t = Gather(self, BLEND_ARRAY, perAxis ? 3 : 1, surface, input);
    if (!perAxis)
    {
      t = t.col(0).replicate<1, 3>().eval();
    }
  }
  else
  {
    SphericalStyle::BlendOptions o;
    o.function = static_cast<SphericalStyle::BlendFunction>(self->BlendFunction);
    o.constant = self->Blend;
    o.axis = Eigen::Vector3d(self->BlendAxis);
    o.range = Eigen::Vector2d(self->BlendRange);
    o.atStart = self->BlendAtStart;
    o.atEnd = self->BlendAtEnd;
    o.steepness = self->TanhSteepness;
    t = SphericalStyle::BlendAlongAxis(P, o).replicate<1, 3>();
  }
  if (!region.empty())
  {
    const Eigen::VectorXd inside =
      vtkSurfaceRegion::Weights(P, region, self->BorderWidth, ThreadsToUse(self->NumberOfThreads));
    // This way round t stays what it is well inside, and is 1 outside, to the last bit.
    t = (t.array() + (1.0 - t.array()).colwise() * (1.0 - inside.array())).matrix().eval();
  }
  return t;
}

ProxyDeformationOptions vtkConvexProxyDeformFilter::Internals::MakeOptions(
  vtkConvexProxyDeformFilter* self, const vtkSurfaceMesh& surface, vtkPolyData* input,
  vtkPolyData* ownProxy)
{
  ProxyDeformationOptions o;
  o.convexProxy.mesher = static_cast<SphericalStyle::ProxyMesher>(self->ProxyMesher);
  o.convexProxy.numberOfPoints = self->NumberOfProxyPoints;
  o.convexProxy.seed = static_cast<std::uint32_t>(self->Seed);
  o.convexProxy.poissonDisk = vtkPoissonDisk;
  o.style.lambda = self->Roundness;
  o.style.centerMode = static_cast<SphericalStyle::CenterMode>(self->CenterMode);
  o.style.radiusMode = static_cast<SphericalStyle::RadiusMode>(self->RadiusMode);
  o.style.custom = { Eigen::Vector3d(self->Center), self->Radius };
  o.style.sphericalWeighting =
    static_cast<SphericalStyle::SphericalWeighting>(self->SphericalWeighting);
  o.projection = static_cast<SphericalStyle::Projection>(self->Projection);
  o.neighbors = self->NumberOfNeighbors;
  o.transfer = static_cast<SphericalStyle::Transfer>(self->Transfer);
  o.gain = Eigen::Vector3d(self->AxisGain);
  o.threads = ThreadsToUse(self->NumberOfThreads);
  if (ownProxy)
  {
    o.ownProxy = OwnProxy(ownProxy);
  }
  if (self->Projection == SMALLEST_ANGLE)
  {
    o.normals = Gather(self, NORMALS, 3, surface, input);
  }
  if (self->Projection == DIRECTION_ARRAY)
  {
    o.directions = Gather(self, DIRECTIONS, 3, surface, input);
    if (o.directions.rows() == 0)
    {
      throw std::invalid_argument(
        "Directions: Projection is DirectionArray, but no array is set to process (index 1)");
    }
  }
  return o;
}

void vtkConvexProxyDeformFilter::Internals::AttachArrays(vtkConvexProxyDeformFilter* self,
  const vtkSurfaceMesh& surface, const Rows& t, vtkPolyData* input, vtkPolyData* output) const
{
  using vtkSurfaceMeshConversion::AddPointArray;
  AddPointArray(output, surface, "t", VTK_DOUBLE, t);
  vtkSurfaceMeshConversion::AddDisplacement(output, input);
  if (self->GenerateProjectionArrays)
  {
    const SphericalStyle::Feet& feet = this->Deformation.GetFeet();
    AddPointArray(output, surface, "ProxyCell", VTK_ID_TYPE, feet.cell.cast<double>());
    AddPointArray(output, surface, "Barycentric", VTK_DOUBLE, feet.barycentric);
    if (feet.projectionCase.size() > 0)
    {
      AddPointArray(output, surface, "ProjectionCase", VTK_INT, feet.projectionCase.cast<double>());
    }
  }
}

void vtkConvexProxyDeformFilter::Internals::FillLines(
  const vtkSurfaceMesh& surface, const Rows& t, vtkPolyData* input, vtkPolyData* output) const
{
  const SphericalStyle::DeformedProxy& proxy = this->Deformation.GetProxy();
  const Points q =
    SphericalStyle::Interpolate(proxy.rest.F, this->Deformation.GetFeet(), proxy.rest.P);
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

void vtkConvexProxyDeformFilter::Internals::Warn(vtkConvexProxyDeformFilter* self,
  const vtkSurfaceMesh& surface, const SphericalStyle::TriangleMesh& proxy,
  const ProxyDeformationReport& report)
{
  const auto warn = [self](const std::string& text)
  { vtkWarningWithObjectMacro(self, << InBlock(self) << text); };
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
  if (self->RadiusMode == EQUAL_VOLUME)
  {
    vtkTargetSphere::WarnOfVolume(self, "the proxy", proxy);
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
}

void vtkConvexProxyDeformFilter::Internals::SetFacts(vtkConvexProxyDeformFilter* self,
  const ProxyDeformationReport& report, int proxyPoints, double diagonal, bool ownProxy)
{
  self->EffectiveNumberOfProxyPoints = proxyPoints;
  self->EffectiveProxyMesher = report.fallback.empty() ? self->ProxyMesher : ISOTROPIC_REMESHING;
  if (ownProxy || proxyPoints == 0)
  {
    self->EffectiveProxyMesher = -1;
  }
  self->ConvexityRatio = report.convexityRatio;
  self->TrianglesTurnedOver = report.turnedOver;
  std::copy_n(report.caseCounts.data(), 3, self->ProjectionCaseCounts);
  self->ProjectionError = diagonal > 0.0 ? report.projectionError / diagonal : 0.0;
  std::copy_n(report.style.sphere.center.data(), 3, self->EffectiveCenter);
  self->EffectiveRadius = proxyPoints > 0 ? report.style.sphere.radius : 0.0;
}

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
  vtkPolyData* input = vtkPolyData::GetData(inputVector[MODEL], 0);
  vtkPolyData* ownProxy = vtkPolyData::GetData(inputVector[PROXY], 0);
  vtkSelection* selection = vtkSelection::GetData(inputVector[SELECTION], 0);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  Internals::SetFacts(this, {}, 0, 0.0, false);
  if (!IsSurface(this, inputVector[MODEL]))
  {
    return 0;
  }
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return 1;
  }

  namespace Conversion = vtkSurfaceMeshConversion;
  const SphericalStyle::ProxyDeformation& deformation = this->Internal->Deformation;
  Internals::CheckProperties(this);
  vtkSurfaceMesh surface = Conversion::FromPolyData(input, true, Conversion::TakePoints::All);
  vtkSmartPointer<vtkPolyData> split;
  vtkSmartPointer<vtkSelection> splitSelection;
  if (vtkLongEdges::IsWanted(this->RefineLongEdges, SphericalStyle::LongEdgeShare(surface.Mesh)))
  {
    const vtkLongEdges::Refined refined = vtkLongEdges::Split(input, surface, LongestEdge,
      { Conversion::FindPointArray(this->GetInputArrayInformation(REGION_MASK), input, "Region") });
    if (selection)
    {
      splitSelection =
        vtkLongEdges::Select(vtkSurfaceRegion::SelectedPoints(this, input, selection), refined);
      selection = splitSelection;
    }
    split = refined.Surface;
    input = split;
    surface = Conversion::FromPolyData(input, true, Conversion::TakePoints::All);
  }
  ProxyDeformationOptions options = Internals::MakeOptions(this, surface, input, ownProxy);
  const std::vector<char> region = vtkSurfaceRegion::Marks(
    this, this->GetInputArrayInformation(REGION_MASK), selection, input, surface);
  bool perAxis = false;
  const Points t = Internals::BlendWeights(this, surface, input, region, perAxis);
  options.t = t;
  if (this->HullOf == REGION)
  {
    options.hullPoints = Marked(region);
  }
  this->SetProgressText("Rounding the proxy");
  const ProxyDeformationReport report = this->Internal->Deformation.Deform(surface.Mesh, options,
    [this](double share)
    {
      this->UpdateProgress(0.1 + 0.9 * share);
      return !Aborted(this);
    });
  if (report.aborted)
  {
    return 1;
  }

  output->ShallowCopy(input);
  Conversion::ReplacePoints(output, surface, deformation.GetPositions(),
    this->OutputPointsPrecision, this->GenerateNormals);
  const Rows shown = t.leftCols(perAxis ? 3 : 1);
  this->Internal->AttachArrays(this, surface, shown, input, output);
  FillProxy(vtkPolyData::GetData(outputVector, 1), deformation.GetProxy(), report);
  this->Internal->FillLines(surface, shown, input, vtkPolyData::GetData(outputVector, 2));
  Internals::Warn(this, surface, deformation.GetProxy().rest, report);
  Internals::SetFacts(this, report, static_cast<int>(deformation.GetProxy().rest.P.rows()),
    Diagonal(surface.Mesh.P), ownProxy != nullptr);
  return 1;
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
