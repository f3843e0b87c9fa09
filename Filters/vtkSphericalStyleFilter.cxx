// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSphericalStyleFilter.h"

#include "Advice.h"
#include "SphericalStyleMethod.h"
#include "SurfaceGrid.h"
#include "vtkCenterIds.h"
#include "vtkFilterSupport.h"
#include "vtkFoldGuard.h"
#include "vtkLongEdges.h"
#include "vtkStyleHistory.h"
#include "vtkStyleReview.h"
#include "vtkSurfaceMeshConversion.h"
#include "vtkSurfaceRegion.h"
#include "vtkTargetSphere.h"

#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

using SphericalStyle::Points;
using namespace vtkFilterSupport;

vtkStandardNewMacro(vtkSphericalStyleFilter);

namespace
{
enum InputPorts
{
  MODEL = 0,
  CENTERS = 1,
  SELECTION = 2
};

enum InputArrays
{
  NORMALS = 0,
  ROUNDNESS_FACTOR = 1,
  NORMAL_BLEND = 2,
  TARGET_DIRECTIONS = 3,
  REGION_MASK = 4,
  CENTER_ID = 5
};

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr vtkSurfaceMeshConversion::ArrayRule ArrayRules[] = {
  // from ROUNDNESS_FACTOR on
  { "Roundness factor", 1, 0.0, Infinity },
  { "Normal blend", 1, 0.0, 1.0 },
  { "Target directions", 3, -Infinity, Infinity },
};

/// One row per point of the solve, no row where no array was chosen.
vtkSurfaceMeshConversion::Rows Gather(
  vtkSphericalStyleFilter* self, int index, const vtkSurfaceMesh& surface, vtkPolyData* input)
{
  return vtkSurfaceMeshConversion::GatherPointArray(
    self->GetInputArrayInformation(index), input, surface, ArrayRules[index - ROUNDNESS_FACTOR]);
}
}

//------------------------------------------------------------------------------------------------
struct vtkSphericalStyleFilter::Internals
{
  // What is solved for is shared with the method, which recognizes it by that.
  std::shared_ptr<const vtkSurfaceMesh> Surface; // of the last input, as it came; or nullptr
  double LongEdgeShare = -1.0;                   // of that
  std::shared_ptr<const vtkSurfaceMesh> Refined; // with long edges split; or nullptr
  SphericalStyle::SphericalStyleMethod Solver;
  vtkFoldGuard::Result Guarded;          // of this execution, empty without the guard
  SphericalStyle::MethodOptions Options; // of the last solve, as wanted
  vtkStyleReview Review;

  struct Inputs
  {
    vtkSmartPointer<vtkPolyData> Model;
    vtkPointSet* Centers;                    // or nullptr
    vtkSmartPointer<vtkSelection> Selection; // or nullptr
  };

  /// @throw std::invalid_argument naming the property and its value
  static void CheckProperties(const vtkSphericalStyleFilter* self);
  /// The mesh to solve for. With RefineLongEdges model and selection are replaced by those with
  /// long edges split; what it says to warn of is of the input.
  const vtkSurfaceMesh& TakeSurface(vtkSphericalStyleFilter* self, Inputs& inputs);
  vtkSurfaceMesh Refine(vtkSphericalStyleFilter* self, Inputs& inputs) const;
  static bool IsGuarded(const vtkSphericalStyleFilter* self)
  {
    return self->AvoidSelfIntersections && !self->ReproduceThesis;
  }
  static SphericalStyle::MethodOptions MakeOptions(vtkSphericalStyleFilter* self,
    const vtkSurfaceMesh& surface, const Inputs& inputs, const std::vector<char>& region);
  /// Runs the method on what there is to solve.
  /// @param regionWeights  how much moves, n, or none for all @param Q  the moved points
  SphericalStyle::StyleReport Solve(vtkSphericalStyleFilter* self, const vtkSurfaceMesh& surface,
    const Inputs& inputs, const std::vector<char>& region, const Eigen::VectorXd& regionWeights,
    const SphericalStyle::Callback& callback, Points& Q);
  void Warn(vtkSphericalStyleFilter* self, const vtkSurfaceMesh& surface,
    const SphericalStyle::StyleReport& report) const;
  void SetFacts(vtkSphericalStyleFilter* self, const SphericalStyle::StyleReport& report) const;
  /// Warns of thinned parts and gives the advice; none for the thesis, which is to be as it is.
  void Comment(vtkSphericalStyleFilter* self, const vtkSurfaceMesh& surface,
    const SphericalStyle::StyleReport& report, const Points& Q);
  /// All that an execution says of itself.
  void Tell(vtkSphericalStyleFilter* self, const vtkSurfaceMesh& surface,
    const SphericalStyle::StyleReport& report, const Points& Q, vtkTable* history);
  void AttachArrays(vtkSphericalStyleFilter* self, const vtkSurfaceMesh& surface,
    const Eigen::VectorXd& regionWeights, vtkPolyData* input, vtkPolyData* output) const;
};

void vtkSphericalStyleFilter::Internals::CheckProperties(const vtkSphericalStyleFilter* self)
{
  RequireTarget(self->Roundness, self->CenterMode == CUSTOM_CENTER ? self->Center : nullptr,
    self->RadiusMode == CUSTOM_RADIUS ? &self->Radius : nullptr);
  Require(self->NormalBlend >= 0.0 && self->NormalBlend <= 1.0, "NormalBlend", "in 0..1",
    self->NormalBlend);
  Require(self->DetailSize >= 0.0 && self->DetailSize <= 0.2, "DetailSize", "in 0..0.2",
    self->DetailSize);
  for (const auto& [name, value] : { std::pair("BorderWidth", self->BorderWidth),
         std::pair("CenterBlendWidth", self->CenterBlendWidth) })
  {
    Require(value >= 0.0 && value <= 1.0, name, "in 0..1", value);
  }
  Require(self->MaximumEdgeLength >= 0.001 && self->MaximumEdgeLength <= 1.0, "MaximumEdgeLength",
    "in 0.001..1", self->MaximumEdgeLength);
}

const vtkSurfaceMesh& vtkSphericalStyleFilter::Internals::TakeSurface(
  vtkSphericalStyleFilter* self, Inputs& inputs)
{
  if (vtkSurfaceMeshConversion::Update(inputs.Model, self->WeldCoincidentPoints, this->Surface) ||
    this->LongEdgeShare < 0.0)
  {
    this->LongEdgeShare = SphericalStyle::LongEdgeShare(this->Surface->Mesh);
  }
  this->Refined.reset();
  if (self->ReproduceThesis || !vtkLongEdges::IsWanted(self->RefineLongEdges, this->LongEdgeShare))
  {
    return *this->Surface;
  }
  self->SetProgressText("Refining");
  self->UpdateProgress(0.01);
  this->Refined = std::make_shared<const vtkSurfaceMesh>(this->Refine(self, inputs));
  return *this->Refined;
}

vtkSurfaceMesh vtkSphericalStyleFilter::Internals::Refine(
  vtkSphericalStyleFilter* self, Inputs& inputs) const
{
  const vtkSurfaceMesh& surface = *this->Surface;
  const auto find = [&](int index, const char* purpose)
  {
    return vtkSurfaceMeshConversion::FindPointArray(
      self->GetInputArrayInformation(index), inputs.Model, purpose);
  };
  const vtkLongEdges::Refined refined = vtkLongEdges::Split(inputs.Model, surface,
    self->MaximumEdgeLength, { find(REGION_MASK, "Region"), find(CENTER_ID, "Center id") });
  if (inputs.Selection)
  {
    inputs.Selection = vtkLongEdges::Select(
      vtkSurfaceRegion::SelectedPoints(self, inputs.Model, inputs.Selection), refined);
  }
  inputs.Model = refined.Surface;
  vtkSurfaceMesh mesh =
    vtkSurfaceMeshConversion::FromPolyData(inputs.Model, self->WeldCoincidentPoints);
  mesh.DegenerateTriangles = surface.DegenerateTriangles;
  mesh.FirstDegenerateCell = surface.FirstDegenerateCell;
  mesh.FannedPolygons = surface.FannedPolygons;
  mesh.FirstFannedPolygon = surface.FirstFannedPolygon;
  return mesh;
}

SphericalStyle::MethodOptions vtkSphericalStyleFilter::Internals::MakeOptions(
  vtkSphericalStyleFilter* self, const vtkSurfaceMesh& surface, const Inputs& inputs,
  const std::vector<char>& region)
{
  using namespace SphericalStyle;
  MethodOptions o;
  o.lambda = self->Roundness;
  o.normalBlend = self->NormalBlend;
  o.centerMode = static_cast<SphericalStyle::CenterMode>(self->CenterMode);
  o.radiusMode = static_cast<SphericalStyle::RadiusMode>(self->RadiusMode);
  o.custom = { Eigen::Vector3d(self->Center), self->Radius };
  o.detailSize = self->DetailSize;
  o.normalRadius = static_cast<SphericalStyle::NormalRadius>(self->NormalRadius);
  o.size.keep = static_cast<SphericalStyle::KeepSize>(self->KeepSize);
  o.size.upAxis = self->UpAxis;
  o.size.keepOnGround = self->KeepOnGround && region.empty();
  o.keepRotations = self->GenerateRotation;
  o.sphericalWeighting = static_cast<SphericalStyle::SphericalWeighting>(self->SphericalWeighting);
  o.concaveEdges = static_cast<SphericalStyle::ConcaveEdges>(self->ConcaveEdges);
  o.edgeWeighting = static_cast<SphericalStyle::EdgeWeighting>(self->EdgeWeighting);
  o.anchor = static_cast<SphericalStyle::Anchor>(self->Anchor);
  o.componentCoupling = static_cast<SphericalStyle::ComponentCoupling>(self->ComponentCoupling);
  o.initialGuess = static_cast<SphericalStyle::InitialGuess>(self->InitialGuess);
  o.loop = self->MakeLoopOptions();
  o.loop.acceleration = o.loop.acceleration && self->Acceleration;
  o.threads = ThreadsToUse(self->NumberOfThreads);

  const auto gather = [&](int index) { return Gather(self, index, surface, inputs.Model); };
  o.roundnessFactors = gather(ROUNDNESS_FACTOR).col(0);
  o.normalBlends = gather(NORMAL_BLEND).col(0);
  o.targets = gather(TARGET_DIRECTIONS);
  const bool useNormals =
    o.normalBlend > 0.0 || (o.normalBlends.size() > 0 && o.normalBlends.maxCoeff() > 0.0);
  if (useNormals && o.targets.rows() == 0)
  {
    o.normals = vtkSurfaceMeshConversion::GatherNormals(
      self->GetInputArrayInformation(NORMALS), inputs.Model, surface);
  }
  const vtkCenterIds ids =
    vtkCenterIds::Find(self->GetInputArrayInformation(CENTER_ID), surface, inputs.Model);
  o.centerIds = ids.OfPoints;
  o.centerBlend = self->CenterBlendWidth;
  if (inputs.Centers)
  {
    o.centers = ids.Centers(inputs.Centers);
  }
  for (std::size_t i = 0; i < region.size(); ++i)
  {
    if (!region[i])
    {
      o.fixedPoints.push_back(static_cast<int>(i));
    }
  }
  o.fixedPositions = surface.Mesh.P(o.fixedPoints, Eigen::all);
  o.sphereOfFreePoints =
    self->SphereOf == REGION && o.fixedPositions.rows() < surface.Mesh.P.rows();
  return self->ReproduceThesis ? ThesisOptions(o) : o;
}

SphericalStyle::StyleReport vtkSphericalStyleFilter::Internals::Solve(vtkSphericalStyleFilter* self,
  const vtkSurfaceMesh& surface, const Inputs& inputs, const std::vector<char>& region,
  const Eigen::VectorXd& regionWeights, const SphericalStyle::Callback& callback, Points& Q)
{
  const SphericalStyle::TriangleMesh& mesh = surface.Mesh;
  const std::shared_ptr<const vtkSurfaceMesh>& owner =
    this->Refined ? this->Refined : this->Surface;
  const std::shared_ptr<const SphericalStyle::TriangleMesh> shared(owner, &mesh);
  const auto finish = [&](const Points& solved) -> Points
  {
    return regionWeights.size() > 0 ? mesh.P + regionWeights.asDiagonal() * (solved - mesh.P)
                                    : solved;
  };
  if (mesh.F.rows() > 0)
  {
    self->SetProgressText("Rounding");
    self->UpdateProgress(0.1);
  }
  // Made, and arrays checked, even if there is nothing to solve.
  this->Options = MakeOptions(self, surface, inputs, region);
  if (mesh.F.rows() == 0)
  {
    return {};
  }
  try
  {
    if (!IsGuarded(self))
    {
      this->Solver.SetMesh(shared);
      SphericalStyle::StyleReport report = this->Solver.Solve(this->Options, callback);
      Q = this->Solver.TakePositions();
      if (regionWeights.size() > 0)
      {
        Q = finish(Q);
      }
      return report;
    }
    const int type =
      vtkSurfaceMeshConversion::OutputPointType(inputs.Model, self->OutputPointsPrecision);
    this->Guarded =
      vtkFoldGuard::Solve(this->Solver, this->Options, shared, type == VTK_FLOAT, finish, callback);
  }
  catch (const SphericalStyle::PartWithoutSphere& error)
  {
    vtkCenterIds::Find(self->GetInputArrayInformation(CENTER_ID), surface, inputs.Model)
      .Refuse(error);
  }
  Q = this->Guarded.Positions;
  return this->Guarded.Style;
}

void vtkSphericalStyleFilter::Internals::Warn(vtkSphericalStyleFilter* self,
  const vtkSurfaceMesh& surface, const SphericalStyle::StyleReport& report) const
{
  const auto warn = [self](const std::string& text)
  { vtkWarningWithObjectMacro(self, << InBlock(self) << text); };
  for (const std::string& remark : vtkSurfaceMeshConversion::Remarks(surface))
  {
    warn(remark);
  }
  if (self->RadiusMode == EQUAL_VOLUME && report.spheres.size() == 1)
  {
    vtkTargetSphere::WarnOfVolume(self, "the surface", surface.Mesh);
  }
  if (!report.pointsOnCenter.empty())
  {
    warn(vtkTargetSphere::OnCenter(report.pointsOnCenter, surface));
  }
  if (self->GenerateCellEnergy && report.closedForm)
  {
    warn("GenerateCellEnergy: the result is in closed form, no energy was minimized, and there is "
         "no array CellEnergy; SphericalWeighting Uniform minimizes one");
  }
  if (report.coarserGrid)
  {
    std::ostringstream text;
    text << "DetailSize " << self->DetailSize
         << " is too small for the area of this model: the base is "
         << "as smooth as with DetailSize "
         << SphericalStyle::SurfaceGrid::SpacingsPerSize * report.gridSpacing
         << "; take that or more, or details smaller than it count as base";
    warn(text.str());
  }
  if (!report.hasMinimum)
  {
    warn("the system matrix is not positive definite: with full-edge weights the energy of this "
         "surface has no minimum, and iterations lead away from it without end; take EdgeWeighting "
         "HalfEdge" +
      std::string(self->ReproduceThesis ? " without ReproduceThesis" : ""));
  }
  else if (surface.Mesh.F.rows() > 0)
  {
    for (const std::string& remark : vtkStyleHistory::Remarks(report))
    {
      warn(remark);
    }
  }
  if (this->Guarded.Guard.blended)
  {
    warn("AvoidSelfIntersections: less roundness alone did not remove all folds; the result was "
         "moved back toward the input where they were, or all over");
  }
}

void vtkSphericalStyleFilter::Internals::SetFacts(
  vtkSphericalStyleFilter* self, const SphericalStyle::StyleReport& report) const
{
  self->SetLoopFacts(report.loop);
  std::copy_n(report.sphere.center.data(), 3, self->EffectiveCenter);
  self->EffectiveRadius = report.sphere.radius;
  self->EffectiveCenterMode = self->CenterMode;
  const SphericalStyle::FoldGuardReport& guard = this->Guarded.Guard;
  const bool counted = this->Guarded.HasCounted();
  self->TurnedOverBefore = counted ? guard.before.turnedOver : NotCounted;
  self->TurnedOverAfter = counted ? guard.after.turnedOver : NotCounted;
  self->NewIntersectionsBefore = counted ? guard.before.newPairs : NotCounted;
  self->NewIntersectionsAfter = counted ? guard.after.newPairs : NotCounted;
  self->Advice.clear();
}

void vtkSphericalStyleFilter::Internals::Comment(vtkSphericalStyleFilter* self,
  const vtkSurfaceMesh& surface, const SphericalStyle::StyleReport& report, const Points& Q)
{
  if (Q.rows() == 0 || report.loop.aborted)
  {
    return;
  }
  const vtkStyleReview::Remarks remarks =
    this->Review.Look(surface, this->Solver.GetMeshGeneration(), Q, this->Options, report);
  if (!remarks.Thinned.empty())
  {
    vtkWarningWithObjectMacro(self, << InBlock(self) << remarks.Thinned);
  }
  self->Advice = self->ReproduceThesis ? "" : remarks.Advice;
  self->AdviceTime.Modified();
}

void vtkSphericalStyleFilter::Internals::Tell(vtkSphericalStyleFilter* self,
  const vtkSurfaceMesh& surface, const SphericalStyle::StyleReport& report, const Points& Q,
  vtkTable* history)
{
  SetFacts(self, report);
  Warn(self, surface, report);
  this->Comment(self, surface, report, Q);
  vtkStyleHistory::Fill(history, report, "Spherical");
  vtkFoldGuard::Fill(history, this->Guarded);
  vtkNew<vtkStringArray> advice;
  advice->SetName("Advice");
  advice->InsertNextValue(self->GetAdvice());
  history->GetFieldData()->AddArray(advice);
}

void vtkSphericalStyleFilter::Internals::AttachArrays(vtkSphericalStyleFilter* self,
  const vtkSurfaceMesh& surface, const Eigen::VectorXd& regionWeights, vtkPolyData* input,
  vtkPolyData* output) const
{
  using vtkSurfaceMeshConversion::AddPointArray;
  const int type = output->GetPoints()->GetDataType();
  const bool solved = surface.Mesh.F.rows() > 0;
  if (self->GenerateTargetDirection)
  {
    AddPointArray(output, surface, "TargetDirection", type,
      solved ? this->Solver.GetDirections() : Points(0, 3));
  }
  if (self->GenerateDisplacement)
  {
    vtkSurfaceMeshConversion::AddDisplacement(output, input);
  }
  if (regionWeights.size() > 0)
  {
    AddPointArray(output, surface, "RegionWeight", VTK_DOUBLE, regionWeights);
  }
  if (this->Guarded.Roundness.size() > 0)
  {
    AddPointArray(output, surface, "RemainingRoundness", VTK_DOUBLE, this->Guarded.Roundness);
  }
  if (self->GenerateCellEnergy)
  {
    const Eigen::VectorXd energies = solved ? this->Solver.GetCellEnergies() : Eigen::VectorXd();
    if (!solved || energies.size() > 0) // none where nothing is minimized, see Warn
    {
      AddPointArray(output, surface, "CellEnergy", VTK_DOUBLE, energies);
    }
  }
  // An observer may have asked for it since: then there are none of this execution.
  if (self->GenerateRotation && (!solved || this->Options.keepRotations))
  {
    vtkSurfaceMeshConversion::AddRotations(output, surface, this->Solver.GetRotations());
  }
}

//------------------------------------------------------------------------------------------------
vtkSphericalStyleFilter::vtkSphericalStyleFilter()
  : Internal(std::make_shared<Internals>())
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(3);
  this->SetInputArrayToProcess(
    NORMALS, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::NORMALS);
  for (const int index :
    { ROUNDNESS_FACTOR, NORMAL_BLEND, TARGET_DIRECTIONS, REGION_MASK, CENTER_ID })
  {
    this->SetInputArrayToProcess(index, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "");
  }
}

vtkSphericalStyleFilter::~vtkSphericalStyleFilter() = default;

void vtkSphericalStyleFilter::SetCentersConnection(vtkAlgorithmOutput* centers)
{
  this->SetInputConnection(CENTERS, centers);
}

void vtkSphericalStyleFilter::SetCentersData(vtkPointSet* centers)
{
  this->SetInputData(CENTERS, centers);
}

void vtkSphericalStyleFilter::SetSelectionConnection(vtkAlgorithmOutput* selection)
{
  this->SetInputConnection(SELECTION, selection);
}

void vtkSphericalStyleFilter::SetSelectionData(vtkDataObject* selection)
{
  this->SetInputData(SELECTION, selection);
}

const char* vtkSphericalStyleFilter::GetAdvice()
{
  // ParaView asks for it between a change and the execution: it must not show that of the last one.
  return this->AdviceTime.GetMTime() > this->GetMTime() ? this->Advice.c_str() : "";
}

void vtkSphericalStyleFilter::ReleaseCache()
{
  this->Internal = std::make_shared<Internals>();
}

const char* vtkSphericalStyleFilter::GetCenterPosition()
{
  const bool custom = this->CenterMode == CUSTOM_CENTER;
  const std::shared_ptr<const vtkSurfaceMesh> surface = this->Internal->Surface;
  if (!surface || surface->Mesh.F.rows() == 0 ||
    (!custom && this->CenterMode != this->EffectiveCenterMode))
  {
    return "";
  }
  const Eigen::Vector3d center(custom ? this->Center : this->EffectiveCenter);
  return vtkTargetSphere::Encloses(surface->Mesh, center) ? "Inside" : "Outside";
}

int vtkSphericalStyleFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  const char* types[] = { "vtkDataSet", "vtkPointSet", "vtkSelection" }; // see IsSurface
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), types[port]);
  if (port != MODEL)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkSphericalStyleFilter::RequestWholeData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return RunGuarded(
    this, outputVector, [&] { return this->Execute(inputVector, outputVector); },
    [this] { this->ReleaseCache(); });
}

int vtkSphericalStyleFilter::Execute(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  Internals::Inputs inputs = { vtkPolyData::GetData(inputVector[MODEL], 0),
    vtkPointSet::GetData(inputVector[CENTERS], 0),
    vtkSelection::GetData(inputVector[SELECTION], 0) };
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  vtkTable* history = vtkTable::GetData(outputVector, 1);
  SphericalStyle::StyleReport report;
  const std::shared_ptr<Internals> internal = this->Internal; // ReleaseCache may come meanwhile
  internal->SetFacts(this, report);
  if (!IsSurface(this, inputVector[MODEL]))
  {
    return 0;
  }
  if (!inputs.Model || inputs.Model->GetNumberOfPoints() == 0)
  {
    return 1;
  }

  Internals::CheckProperties(this);
  const vtkSurfaceMesh& surface = internal->TakeSurface(this, inputs);
  const std::vector<char> region = vtkSurfaceRegion::Marks(
    this, this->GetInputArrayInformation(REGION_MASK), inputs.Selection, inputs.Model, surface);
  Eigen::VectorXd regionWeights;
  if (!region.empty())
  {
    regionWeights = vtkSurfaceRegion::Weights(
      surface.Mesh.P, region, this->BorderWidth, ThreadsToUse(this->NumberOfThreads));
  }
  Points Q;
  report = internal->Solve(
    this, surface, inputs, region, regionWeights,
    [this](int step, double)
    {
      if (!Aborted(this))
      {
        this->UpdateProgress(1.0 - 0.8 / (1.0 + 0.1 * step));
      }
      return !Aborted(this);
    },
    Q);

  output->ShallowCopy(inputs.Model);
  vtkSurfaceMeshConversion::ReplacePoints(
    output, surface, Q, this->OutputPointsPrecision, this->GenerateNormals);
  internal->AttachArrays(this, surface, regionWeights, inputs.Model, output);
  internal->Tell(this, surface, report, Q, history);
  vtkTargetSphere::Fill(vtkPolyData::GetData(outputVector, 2), report.spheres);
  internal->Guarded = {};
  internal->Solver.ForgetResult();
  return 1;
}

void vtkSphericalStyleFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Roundness: " << this->Roundness << "\n";
  os << indent << "NormalBlend: " << this->NormalBlend << "\n";
  os << indent << "NormalRadius: " << this->NormalRadius << "\n";
  os << indent << "KeepSize: " << this->KeepSize << "\n";
  os << indent << "KeepOnGround: " << OnOff(this->KeepOnGround) << "\n";
  os << indent << "UpAxis: " << this->UpAxis << "\n";
  os << indent << "CenterMode: " << this->CenterMode << "\n";
  os << indent << "Center: " << Triple(this->Center) << "\n";
  os << indent << "RadiusMode: " << this->RadiusMode << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "DetailSize: " << this->DetailSize << "\n";
  os << indent << "SphereOf: " << this->SphereOf << "\n";
  os << indent << "BorderWidth: " << this->BorderWidth << "\n";
  os << indent << "CenterBlendWidth: " << this->CenterBlendWidth << "\n";
  os << indent << "SphericalWeighting: " << this->SphericalWeighting << "\n";
  os << indent << "AvoidSelfIntersections: " << OnOff(this->AvoidSelfIntersections) << "\n";
  os << indent << "EdgeWeighting: " << this->EdgeWeighting << "\n";
  os << indent << "RefineLongEdges: " << this->RefineLongEdges << "\n";
  os << indent << "MaximumEdgeLength: " << this->MaximumEdgeLength << "\n";
  os << indent << "ReproduceThesis: " << OnOff(this->ReproduceThesis) << "\n";
  os << indent << "GenerateTargetDirection: " << OnOff(this->GenerateTargetDirection) << "\n";
  os << indent << "GenerateDisplacement: " << OnOff(this->GenerateDisplacement) << "\n";
  os << indent << "GenerateRotation: " << OnOff(this->GenerateRotation) << "\n";
  os << indent << "EffectiveCenter: " << Triple(this->EffectiveCenter) << "\n";
  os << indent << "EffectiveRadius: " << this->EffectiveRadius << "\n";
  os << indent << "CenterPosition: " << this->GetCenterPosition() << "\n";
  os << indent << "TurnedOverBefore: " << this->TurnedOverBefore << "\n";
  os << indent << "TurnedOverAfter: " << this->TurnedOverAfter << "\n";
  os << indent << "NewIntersectionsBefore: " << this->NewIntersectionsBefore << "\n";
  os << indent << "NewIntersectionsAfter: " << this->NewIntersectionsAfter << "\n";
  os << indent << "Advice: " << this->GetAdvice() << "\n";
}
