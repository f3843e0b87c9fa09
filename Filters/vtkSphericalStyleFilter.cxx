// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSphericalStyleFilter.h"

#include "SphericalStyleMethod.h"
#include "vtkCoarseSurface.h"
#include "vtkFilterSupport.h"
#include "vtkFoldGuard.h"
#include "vtkMovedSurface.h"
#include "vtkProcesses.h"
#include "vtkRestPose.h"
#include "vtkStyleArrays.h"
#include "vtkStyleHistory.h"
#include "vtkStyleModel.h"
#include "vtkStyleReview.h"
#include "vtkSurfaceMeshConversion.h"
#include "vtkSurfaceRegion.h"
#include "vtkSymmetryPlane.h"
#include "vtkTargetMesh.h"
#include "vtkTargetSphere.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using SphericalStyle::Points;
using namespace vtkFilterSupport;

vtkStandardNewMacro(vtkSphericalStyleFilter);

namespace
{
/// When each array of a surface was changed; no two have the same time. The surface itself may be
/// another copy of them: ParaView makes one for each execution.
std::vector<vtkMTimeType> TimesOf(vtkPolyData* surface)
{
  std::vector<vtkMTimeType> times = { surface->GetPoints() ? surface->GetPoints()->GetMTime() : 0 };
  for (vtkCellArray* cells :
    { surface->GetVerts(), surface->GetLines(), surface->GetPolys(), surface->GetStrips() })
  {
    times.push_back(cells->GetNumberOfCells() > 0 ? cells->GetMTime() : 0);
  }
  for (vtkDataSetAttributes* attributes :
    { static_cast<vtkDataSetAttributes*>(surface->GetPointData()),
      static_cast<vtkDataSetAttributes*>(surface->GetCellData()) })
  {
    for (int k = 0; k < attributes->GetNumberOfArrays(); ++k)
    {
      times.push_back(attributes->GetAbstractArray(k)->GetMTime());
    }
  }
  return times;
}

/// Of all processes.
double NumberOfPoints(const vtkSurfaceMesh& surface)
{
  const std::vector<char>& counts = surface.Part.counts;
  return surface.Part.Sum(static_cast<double>(
    surface.Part.IsWhole() ? surface.Mesh.P.rows() : std::count(counts.begin(), counts.end(), 1)));
}
}

/// What is kept between executions.
struct vtkSphericalStyleFilter::Internals
{
  /// What a preview is one of: the model of the last full result.
  struct PreviewBasis
  {
    std::vector<vtkMTimeType> Input; // see TimesOf
    int Refinement = 0;
    double RefinedLength = 0.0;
    std::shared_ptr<const vtkSurfaceMesh> Surface;
    vtkSmartPointer<vtkPolyData> Refined;           // nullptr where the input is the model
    std::shared_ptr<const vtkCoarseSurface> Coarse; // made by the first preview

    bool IsOf(vtkPolyData* input, int refinement, double length) const
    {
      return this->Surface && refinement == this->Refinement && length == this->RefinedLength &&
        this->Input == TimesOf(input);
    }
  };
  PreviewBasis Basis;

  vtkStyleModel Model;
  SphericalStyle::SphericalStyleMethod Solver;
  vtkStyleReview Review;
  std::shared_ptr<const vtkProcesses> Processes; // of the last execution on parts

  /// The plane of symmetry of a surface, and the share of it that is near its mirror image.
  struct Planes
  {
    std::shared_ptr<const vtkSurfaceMesh> Surface; // none before the first
    int Symmetry = NO_SYMMETRY;
    vtkSymmetryPlane::Found Found;
  };
  Planes Known;
  vtkTargetMesh TargetMesh;
};

/// What an execution solves, and how it ends.
struct vtkSphericalStyleFilter::Execution
{
  vtkStyleModel::Solved Model;
  std::shared_ptr<const SphericalStyle::TriangleMesh> Rest; // or nullptr
  std::vector<char> Region;                                 // see vtkSurfaceRegion::Marks
  Eigen::VectorXd RegionWeights;                            // how much moves, n, or none for all
  std::optional<SphericalStyle::MirrorPlane> Plane;         // of symmetry
  SphericalStyle::MethodOptions Options;                    // as wanted
  SphericalStyle::StyleReport Report;
  vtkFoldGuard::Result Guarded; // empty without the guard
  Points Q;                     // the moved points; none where there is nothing to solve
  bool HasTimeSteps = false;    // of the model: more than one

  const vtkSurfaceMesh& Surface() const { return *this->Model.Surface; }
  const SphericalStyle::SurfacePart& Part() const { return this->Surface().Part; }
  bool IsFirst() const { return this->Part().IsWhole() || this->Part().processes->GetRank() == 0; }
  bool HasTriangles() const
  {
    return this->Part().Max(this->Surface().Mesh.F.rows() > 0 ? 1.0 : 0.0) > 0.0;
  }
};

//------------------------------------------------------------------------------------------------
vtkSphericalStyleFilter::vtkSphericalStyleFilter()
  : Internal(std::make_shared<Internals>())
{
  this->SetNumberOfInputPorts(5);
  this->SetNumberOfOutputPorts(3);
  vtkStyleArrays::SetDefaults(this);
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

void vtkSphericalStyleFilter::SetRestPoseConnection(vtkAlgorithmOutput* rest)
{
  this->SetInputConnection(REST_POSE, rest);
}

void vtkSphericalStyleFilter::SetRestPoseData(vtkPolyData* rest)
{
  this->SetInputData(REST_POSE, rest);
}

void vtkSphericalStyleFilter::SetTargetMeshConnection(vtkAlgorithmOutput* mesh)
{
  this->SetInputConnection(TARGET, mesh);
}

void vtkSphericalStyleFilter::SetTargetMeshData(vtkPolyData* mesh)
{
  this->SetInputData(TARGET, mesh);
}

const char* vtkSphericalStyleFilter::GetAdvice()
{
  // ParaView asks for it between a change and the execution: it must not show that of the last one.
  return this->AdviceTime.GetMTime() > this->GetMTime() ? this->Advice.c_str() : "";
}

const char* vtkSphericalStyleFilter::GetFoldSummary()
{
  return this->AdviceTime.GetMTime() > this->GetMTime() ? this->FoldSummary.c_str() : "";
}

void vtkSphericalStyleFilter::ReleaseCache()
{
  this->Internal = std::make_shared<Internals>();
}

const char* vtkSphericalStyleFilter::GetCenterPosition()
{
  const bool custom = this->CenterMode == CUSTOM_CENTER;
  const std::shared_ptr<const vtkSurfaceMesh> surface = this->Internal->Model.GetSurface();
  const std::shared_ptr<const vtkCoarseSurface>& coarse = this->Internal->Basis.Coarse;
  if (!surface || !surface->Part.IsWhole() || surface->Mesh.F.rows() == 0 ||
    (!custom && (this->CenterMode != this->EffectiveCenterMode || this->EffectiveRadius <= 0.0)))
  {
    return "";
  }
  const Eigen::Vector3d center(custom ? this->Center : this->EffectiveCenter);
  const SphericalStyle::TriangleMesh& mesh =
    this->Preview && coarse ? coarse->Surface.Mesh : surface->Mesh;
  if (!vtkTargetSphere::Encloses(mesh, center))
  {
    return "Outside";
  }
  return vtkTargetSphere::IsNear(mesh, center, 0.5 * this->EffectiveRadius) ? "NearSurface"
                                                                            : "Inside";
}

int vtkSphericalStyleFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  // See IsSurface.
  const char* types[] = { "vtkDataSet", "vtkPointSet", "vtkSelection", "vtkPolyData",
    "vtkPolyData" };
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

bool vtkSphericalStyleFilter::WorksOnParts(
  vtkInformationVector** inputVector, const vtkProcesses& processes)
{
  // The closed form has more options than these; they are no switches between ways to work.
  SphericalStyle::StyleOptions o;
  o.sphericalWeighting = static_cast<SphericalStyle::SphericalWeighting>(this->SphericalWeighting);
  o.concaveEdges = static_cast<SphericalStyle::ConcaveEdges>(this->ConcaveEdges);
  o.edgeWeighting = static_cast<SphericalStyle::EdgeWeighting>(this->EdgeWeighting);
  o.initialGuess = static_cast<SphericalStyle::InitialGuess>(this->InitialGuess);
  o.loop.stopRule = static_cast<SphericalStyle::StopRule>(this->StopRule);
  o.anchor = static_cast<SphericalStyle::Anchor>(this->Anchor);
  const bool needsWhole = !SphericalStyle::IsClosedForm(o) ||
    o.anchor == SphericalStyle::Anchor::LastPoint || this->ReproduceThesis ||
    this->AvoidSelfIntersections || !this->WeldCoincidentPoints || this->Symmetry != NO_SYMMETRY ||
    this->Target == TARGET_MESH || this->RefineLongEdges == vtkLongEdges::ALWAYS ||
    vtkStyleArrays::IsChosen(this, vtkStyleArrays::REGION_MASK) ||
    vtkStyleArrays::IsChosen(this, vtkStyleArrays::CENTER_ID) ||
    vtkSelection::GetData(inputVector[SELECTION], 0) ||
    vtkPolyData::GetData(inputVector[REST_POSE], 0);
  // What differs between two processes counts as on the first one, which gathering leads to.
  return this->AllAgree(!needsWhole, processes);
}

bool vtkSphericalStyleFilter::AllAgree(bool can, const vtkProcesses& processes) const
{
  return processes.AreAlike({ can ? 1.0 : 0.0, this->Roundness, this->NormalBlend,
           static_cast<double>(this->NormalRadius), static_cast<double>(this->KeepSize),
           this->KeepOnGround ? 1.0 : 0.0, static_cast<double>(this->UpAxis),
           static_cast<double>(this->CenterMode), this->Center[0], this->Center[1], this->Center[2],
           static_cast<double>(this->RadiusMode), this->Radius, this->DetailSize,
           static_cast<double>(this->Target), this->TargetEdges, this->TargetLengths[0],
           this->TargetLengths[1], this->TargetLengths[2],
           static_cast<double>(this->RefineLongEdges), this->GenerateRotation ? 1.0 : 0.0,
           this->GenerateNormals ? 1.0 : 0.0, this->TransformAllInputVectors ? 1.0 : 0.0,
           static_cast<double>(this->PreviewSize) }) &&
    can;
}

std::shared_ptr<const vtkProcesses> vtkSphericalStyleFilter::TakeProcesses() const
{
  std::shared_ptr<const vtkProcesses>& kept = this->Internal->Processes;
  if (!kept || !kept->IsOf(this->Controller))
  {
    kept = std::make_shared<const vtkProcesses>(this->Controller);
  }
  return kept;
}

int vtkSphericalStyleFilter::RequestPart(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const std::shared_ptr<const vtkProcesses> processes = this->TakeProcesses();
  if (!this->WorksOnParts(inputVector, *processes))
  {
    return WHOLE_IS_NEEDED;
  }
  const int outcome = this->RunOnParts(inputVector, outputVector, *processes,
    [&] { this->Execute(inputVector, outputVector, processes); });
  if (outcome == PART_FAILED)
  {
    this->ReleaseCache(); // another process may have less of it
  }
  return outcome;
}

//------------------------------------------------------------------------------------------------
int vtkSphericalStyleFilter::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const int preview = this->RequestPreview(inputVector, outputVector);
  if (preview != WHOLE_IS_NEEDED)
  {
    return preview == PART_DONE;
  }
  Internals::PreviewBasis last = std::move(this->Internal->Basis);
  this->Internal->Basis = {};
  const int done = this->Superclass::RequestData(request, inputVector, outputVector);
  Internals::PreviewBasis& basis = this->Internal->Basis;
  if (basis.Surface)
  {
    auto* input = vtkPolyData::GetData(inputVector[MODEL], 0);
    basis.Input = TimesOf(input);
    if (basis.Surface == last.Surface && last.IsOf(input, basis.Refinement, basis.RefinedLength))
    {
      basis.Coarse = last.Coarse;
    }
  }
  return done;
}

/// @return WHOLE_IS_NEEDED where the result is to be the full one: on all processes or on none
int vtkSphericalStyleFilter::RequestPreview(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const std::shared_ptr<const vtkProcesses> processes =
    this->IsSpread() ? this->TakeProcesses() : nullptr;
  bool can = this->Preview;
  try
  {
    can = can && this->CanPreview(inputVector, processes.get());
  }
  catch (const std::exception&) // the whole execution says what is wrong
  {
    can = false;
  }
  if (!(processes ? this->AllAgree(can, *processes) : can))
  {
    return WHOLE_IS_NEEDED;
  }
  vtkPolyData* input = vtkPolyData::GetData(inputVector[MODEL], 0);
  const auto release = [this] { this->ReleaseCache(); };
  const auto preview = [&]
  {
    this->MakePreview(input, outputVector, processes.get());
    return 1;
  };
  if (!processes)
  {
    return RunGuarded(this, outputVector, preview, release) ? PART_DONE : PART_FAILED;
  }
  const int outcome =
    this->RunTogether(input->GetNumberOfPoints() > 0, outputVector, *processes, preview);
  if (outcome == PART_FAILED)
  {
    release(); // another process may have less of it
  }
  return outcome;
}

/// @param processes  that the input is spread over, or nullptr @throw std::invalid_argument
bool vtkSphericalStyleFilter::CanPreview(
  vtkInformationVector** inputVector, const vtkProcesses* processes)
{
  auto* input = vtkPolyData::GetData(inputVector[MODEL], 0);
  const Internals::PreviewBasis& basis = this->Internal->Basis;
  if (!input || !basis.IsOf(input, this->RefineLongEdges, this->MaximumEdgeLength) ||
    basis.Surface->Part.processes.get() != processes)
  {
    return false;
  }
  vtkSurfaceMeshConversion::CheckArrays(input); // some points are copied with all that they have
  const SphericalStyle::MethodOptions o = this->MakeOptions();
  const bool givenNormals =
    vtkStyleArrays::IsChosen(this, vtkStyleArrays::NORMALS) || input->GetPointData()->GetNormals();
  bool asksForArrays = false;
  for (const int array :
    { vtkStyleArrays::ROUNDNESS_FACTOR, vtkStyleArrays::NORMAL_BLEND,
      vtkStyleArrays::TARGET_DIRECTIONS, vtkStyleArrays::REGION_MASK, vtkStyleArrays::CENTER_ID })
  {
    asksForArrays |= vtkStyleArrays::IsChosen(this, array);
  }
  for (const char* array : { vtkStyleArrays::PartRoundness, vtkStyleArrays::PartNormalBlend })
  {
    asksForArrays |= input->GetPointData()->HasArray(array) != 0;
  }
  return SphericalStyle::IsClosedForm(o) && o.anchor == SphericalStyle::Anchor::Centroid &&
    !this->ReproduceThesis && !this->AvoidSelfIntersections && this->WeldCoincidentPoints &&
    this->Symmetry == NO_SYMMETRY && this->Target == SPHERE && !asksForArrays &&
    !vtkSelection::GetData(inputVector[SELECTION], 0) &&
    !vtkPolyData::GetData(inputVector[REST_POSE], 0) &&
    !(givenNormals && this->DetailSize == 0.0 && this->NormalBlend > 0.0);
}

/// [preview]
void vtkSphericalStyleFilter::MakePreview(
  vtkPolyData* input, vtkInformationVector* outputVector, const vtkProcesses* processes)
{
  constexpr int Probes = 1 << 14;
  const std::shared_ptr<Internals> internal = this->Internal; // ReleaseCache may come meanwhile
  Internals::PreviewBasis& basis = internal->Basis;
  const std::shared_ptr<const vtkSurfaceMesh> surface = basis.Surface;
  this->CheckProperties();
  if (surface->Part.Max(basis.Coarse ? 0.0 : 1.0) > 0.0)
  {
    vtkPolyData* model = basis.Refined ? basis.Refined.Get() : input;
    const auto without = vtkSurfaceMeshConversion::WithoutEmptyArrays(model);
    basis.Coarse = vtkCoarseSurface::Make(vtkPolyData::SafeDownCast(without), *surface,
      this->PreviewSize, Probes, internal->Solver.GetFrame().scale);
  }
  const std::shared_ptr<const vtkCoarseSurface> coarse = basis.Coarse;
  SphericalStyle::MethodOptions o = this->MakeOptions();
  o.size.keepOnGround = this->KeepOnGround;
  const auto goOn = [this](int, double) { return !Aborted(this); };
  const SphericalStyle::StyleReport report = internal->Solver.Preview(coarse->Places, o, goOn);

  using vtkSurfaceMeshConversion::AddPointArray;
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  output->ShallowCopy(coarse->Model);
  vtkMovedSurface::Fill(this, output, coarse->Surface, internal->Solver.TakePositions());
  AddPointArray(output, coarse->Surface, "TargetDirection", output->GetPoints()->GetDataType(),
    internal->Solver.GetDirections());
  if (this->GenerateDisplacement)
  {
    vtkSurfaceMeshConversion::AddDisplacement(output, coarse->Model);
  }
  if (o.keepRotations)
  {
    vtkSurfaceMeshConversion::AddRotations(
      output, coarse->Surface, internal->Solver.GetRotations());
  }
  internal->Solver.ForgetResult();
  this->SetLoopFacts(report.loop);
  std::copy_n(report.sphere.center.data(), 3, this->EffectiveCenter);
  this->EffectiveRadius = report.sphere.radius;
  this->EffectiveCenterMode = this->CenterMode;
  this->AdviceTime.Modified(); // that of the full result stays
  const std::vector<double> bytes = processes ? processes->GetBytesOfAll() : std::vector<double>();
  if (processes && processes->GetRank() > 0)
  {
    return;
  }
  vtkTable* history = vtkTable::GetData(outputVector, 1);
  vtkStyleHistory::Fill(history, report, "Spherical");
  vtkStyleHistory::AddBytes(history, bytes);
  vtkTargetSphere::Fill(vtkPolyData::GetData(outputVector, 2), report.spheres, report.shape);
}

//------------------------------------------------------------------------------------------------
int vtkSphericalStyleFilter::Execute(vtkInformationVector** inputVector,
  vtkInformationVector* outputVector, const std::shared_ptr<const vtkProcesses>& processes)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[MODEL], 0);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  Execution e;
  e.Report.sphere.radius = 0.0; // until there is one
  this->SetFacts(e);
  if (!IsSurface(this, inputVector[MODEL]))
  {
    return 0;
  }
  if (!processes && (!input || input->GetNumberOfPoints() == 0))
  {
    return 1;
  }

  this->CheckProperties();
  e.HasTimeSteps = inputVector[MODEL]->GetInformationObject(0)->Length(
                     vtkStreamingDemandDrivenPipeline::TIME_STEPS()) > 1;
  const std::shared_ptr<Internals> internal = this->Internal; // ReleaseCache may come meanwhile
  this->Take(inputVector, *internal, processes, e);
  if (e.HasTriangles())
  {
    this->Solve(*internal, e);
  }

  output->ShallowCopy(e.Model.Model);
  vtkMovedSurface::Fill(this, output, e.Surface(), e.Q);
  this->AttachArrays(*internal, e, output);
  internal->Solver.ForgetResult(); // the review needs memory, and none of it
  this->KeepBasis(*internal, e, input);
  this->SetFacts(e);
  this->Review(*internal, e);
  const std::vector<double> bytes = processes ? processes->GetBytesOfAll() : std::vector<double>();
  if (!e.IsFirst())
  {
    return 1;
  }
  vtkTable* history = vtkTable::GetData(outputVector, 1);
  vtkStyleHistory::Fill(history, e.Report, "Spherical");
  vtkFoldGuard::Fill(history, e.Guarded);
  vtkStyleHistory::AddAdvice(history, this->GetAdvice());
  vtkStyleHistory::AddPlane(history, e.Plane);
  vtkStyleHistory::AddBytes(history, bytes);
  vtkTargetSphere::Fill(vtkPolyData::GetData(outputVector, 2), e.Report.spheres, e.Report.shape);
  return 1;
}

/// What previews need of a full result.
void vtkSphericalStyleFilter::KeepBasis(
  Internals& internal, const Execution& e, vtkPolyData* input) const
{
  const bool gathered = this->IsSpread() && e.Part().IsWhole();
  if (gathered || e.Rest || !e.HasTriangles() || !e.Report.closedForm || e.Report.loop.aborted ||
    NumberOfPoints(e.Surface()) <= 2.0 * this->PreviewSize)
  {
    return;
  }
  Internals::PreviewBasis& basis = internal.Basis;
  basis.Refinement = this->RefineLongEdges;
  basis.RefinedLength = this->MaximumEdgeLength;
  basis.Surface = e.Model.Surface;
  basis.Refined = e.Model.Model == input ? nullptr : e.Model.Model;
}

void vtkSphericalStyleFilter::CheckProperties() const
{
  RequireTarget(this->Roundness, this->CenterMode == CUSTOM_CENTER ? this->Center : nullptr,
    this->RadiusMode == CUSTOM_RADIUS ? &this->Radius : nullptr);
  Require(this->NormalBlend >= 0.0 && this->NormalBlend <= 1.0, "NormalBlend", "in 0..1",
    this->NormalBlend);
  Require(this->DetailSize >= 0.0 && this->DetailSize <= 0.2, "DetailSize", "in 0..0.2",
    this->DetailSize);
  for (const auto& [name, value] : { std::pair("BorderWidth", this->BorderWidth),
         std::pair("CenterBlendWidth", this->CenterBlendWidth) })
  {
    Require(value >= 0.0 && value <= 1.0, name, "in 0..1", value);
  }
  for (const auto& [on, what] : { std::pair(this->AvoidSelfIntersections, "AvoidSelfIntersections"),
         std::pair(this->ReproduceThesis, "ReproduceThesis") })
  {
    if (on && this->Symmetry != NO_SYMMETRY)
    {
      throw std::invalid_argument(
        std::string("Symmetry and ") + what + " cannot be used together: switch one of them off");
    }
  }
  Require(this->TargetEdges >= 0.0 && this->TargetEdges <= 1.0, "TargetEdges", "in 0..1",
    this->TargetEdges);
  const Eigen::Vector3d lengths(this->TargetLengths);
  if (!lengths.allFinite() || !(lengths.isZero(0.0) || lengths.minCoeff() > 0.0))
  {
    throw std::invalid_argument(
      "TargetLengths must be finite and all above 0, or all 0 for those of the model; they are " +
      Triple(this->TargetLengths));
  }
  if (this->Target != SPHERE && this->ReproduceThesis)
  {
    throw std::invalid_argument("The thesis knows no Target but the Sphere: switch ReproduceThesis "
                                "off, or set Target to Sphere");
  }
  Require(this->MaximumEdgeLength >= 0.001 && this->MaximumEdgeLength <= 1.0, "MaximumEdgeLength",
    "in 0.001..1", this->MaximumEdgeLength);
}

void vtkSphericalStyleFilter::Take(vtkInformationVector** inputVector, Internals& internal,
  const std::shared_ptr<const vtkProcesses>& processes, Execution& e)
{
  vtkStyleModel::Refinement refinement;
  refinement.When = this->ReproduceThesis ? vtkLongEdges::NEVER : this->RefineLongEdges;
  refinement.Length = this->MaximumEdgeLength;
  refinement.Region = this->GetInputArrayInformation(vtkStyleArrays::REGION_MASK);
  refinement.CenterId = this->GetInputArrayInformation(vtkStyleArrays::CENTER_ID);
  vtkSmartPointer<vtkPolyData> model = vtkPolyData::GetData(inputVector[MODEL], 0);
  vtkPolyData* rest = vtkPolyData::GetData(inputVector[REST_POSE], 0);
  if (rest)
  {
    if (this->AvoidSelfIntersections || this->ReproduceThesis)
    {
      throw std::invalid_argument(
        "With a rest pose, AvoidSelfIntersections and ReproduceThesis must be off");
    }
    if (e.HasTimeSteps &&
      this->GetInputConnection(REST_POSE, 0) == this->GetInputConnection(MODEL, 0))
    {
      Warn(this,
        "RestPose is the model itself, which changes over time, and so it does nothing: give it "
        "one time step of the model, as Force Time makes it in ParaView");
    }
    model = vtkRestPose::AtRest(model, rest);
  }
  e.Model = internal.Model.Update(this, model, vtkSelection::GetData(inputVector[SELECTION], 0),
    this->WeldCoincidentPoints, refinement, processes);
  if (rest)
  {
    e.Rest = vtkRestPose::TakeBack(e.Model);
  }
  const vtkSurfaceMesh& surface = e.Surface();
  e.Region =
    vtkSurfaceRegion::Marks(this, refinement.Region, e.Model.Selection, e.Model.Model, surface);
  if (!e.Region.empty())
  {
    e.RegionWeights = vtkSurfaceRegion::Weights(
      surface.Mesh.P, e.Region, this->BorderWidth, ThreadsToUse(this->NumberOfThreads));
  }
  if (e.HasTriangles())
  {
    this->SetProgressText("Rounding");
    this->UpdateProgress(0.1);
  }
  // Made, and arrays checked, even if there is nothing to solve.
  e.Options = this->MakeOptions();
  vtkStyleArrays::Read(
    this, surface, e.Model.Model, vtkPointSet::GetData(inputVector[CENTERS], 0), e.Options);
  vtkStyleArrays::Hold(e.Region, surface, e.Options);
  e.Options.size.keepOnGround = this->KeepOnGround && e.Region.empty();
  e.Options.sphereOfFreePoints =
    this->SphereOf == REGION && e.Options.fixedPositions.rows() < surface.Mesh.P.rows();
  if (this->ReproduceThesis)
  {
    e.Options = SphericalStyle::ThesisOptions(e.Options);
  }
  this->TakeTarget(vtkPolyData::GetData(inputVector[TARGET], 0), internal, e);
  if (this->Symmetry != NO_SYMMETRY && e.HasTriangles())
  {
    this->TakePlane(internal, e);
  }
}

/// [target]
void vtkSphericalStyleFilter::TakeTarget(vtkPolyData* mesh, Internals& internal, Execution& e)
{
  if (this->Target != SPHERE && e.Options.HasTargets(e.Part()))
  {
    throw std::invalid_argument("An array of target directions and a Target other than the Sphere "
                                "cannot be used together: take one of them away");
  }
  if (this->Target == TARGET_MESH)
  {
    e.Options.shape.mesh = internal.TargetMesh.Update(mesh);
  }
  else if (mesh)
  {
    Warn(this, "TargetMesh has no effect: set Target to Mesh");
  }
}

/// [symmetry]
void vtkSphericalStyleFilter::TakePlane(Internals& internal, Execution& e)
{
  if (e.Rest)
  {
    throw std::invalid_argument("Symmetry and a rest pose cannot be used together: switch Symmetry "
                                "off, or take the rest pose away");
  }
  Internals::Planes& known = internal.Known;
  // Where edges are split, each execution has a mesh of its own.
  if (!known.Surface || known.Symmetry != this->Symmetry ||
    !(known.Surface->Mesh == e.Surface().Mesh))
  {
    this->SetProgressText("Looking for the plane of symmetry");
    known.Surface.reset(); // should it throw
    const SphericalStyle::TriangleMesh& mesh = e.Surface().Mesh;
    known.Found = this->Symmetry == FOUND_PLANE
      ? vtkSymmetryPlane::Find(mesh, e.Options.threads)
      : vtkSymmetryPlane::FindAcross(mesh, this->Symmetry - ACROSS_X, e.Options.threads);
    known.Symmetry = this->Symmetry;
    known.Surface = e.Model.Surface;
    this->SetProgressText("Rounding");
  }
  e.Plane = known.Found.plane;
  if (known.Found.share < vtkSymmetryPlane::LeastShare)
  {
    const std::string fact = "only " + std::to_string(std::lround(100.0 * known.Found.share)) +
      " % of the surface comes within 2 % of the diagonal of its mirror image";
    if (this->Symmetry == FOUND_PLANE)
    {
      throw std::invalid_argument("Symmetry: there is no plane of symmetry: about the best one, " +
        fact + ". Set Symmetry to X, Y or Z for a plane across that axis, or to Off");
    }
    Warn(this, "Symmetry: about the plane across this axis, " + fact);
  }
  if (this->CenterMode == CUSTOM_CENTER)
  {
    const double distance = std::abs(e.Plane->DistanceOf(Eigen::Vector3d(this->Center)));
    if (distance > 1e-6 * SphericalStyle::FrameOf(e.Surface().Mesh.P).scale)
    {
      std::ostringstream message;
      message << "Center is " << distance
              << " away from the plane of symmetry, and is moved onto it";
      Warn(this, message.str());
    }
  }
}

SphericalStyle::MethodOptions vtkSphericalStyleFilter::MakeOptions() const
{
  SphericalStyle::MethodOptions o;
  o.lambda = this->Roundness;
  o.normalBlend = this->NormalBlend;
  o.centerMode = static_cast<SphericalStyle::CenterMode>(this->CenterMode);
  o.radiusMode = static_cast<SphericalStyle::RadiusMode>(this->RadiusMode);
  o.custom = { Eigen::Vector3d(this->Center), this->Radius };
  o.shape.kind = static_cast<SphericalStyle::TargetKind>(this->Target);
  o.shape.edges = this->TargetEdges;
  o.shape.lengths = Eigen::Vector3d(this->TargetLengths);
  o.centerBlend = this->CenterBlendWidth;
  o.detailSize = this->DetailSize;
  o.normalRadius = static_cast<SphericalStyle::NormalRadius>(this->NormalRadius);
  o.size.keep = static_cast<SphericalStyle::KeepSize>(this->KeepSize);
  o.size.up = Eigen::Vector3d::Unit(this->UpAxis);
  o.keepRotations = this->GenerateRotation;
  o.sphericalWeighting = static_cast<SphericalStyle::SphericalWeighting>(this->SphericalWeighting);
  o.concaveEdges = static_cast<SphericalStyle::ConcaveEdges>(this->ConcaveEdges);
  o.edgeWeighting = static_cast<SphericalStyle::EdgeWeighting>(this->EdgeWeighting);
  o.anchor = static_cast<SphericalStyle::Anchor>(this->Anchor);
  o.componentCoupling = static_cast<SphericalStyle::ComponentCoupling>(this->ComponentCoupling);
  o.initialGuess = static_cast<SphericalStyle::InitialGuess>(this->InitialGuess);
  o.loop = this->MakeLoopOptions();
  o.loop.acceleration = o.loop.acceleration && this->Acceleration;
  o.threads = ThreadsToUse(this->NumberOfThreads);
  return o;
}

void vtkSphericalStyleFilter::Solve(Internals& internal, Execution& e)
{
  const SphericalStyle::TriangleMesh& mesh = e.Surface().Mesh;
  const auto goOn = [this](int step, double)
  {
    if (!Aborted(this))
    {
      this->UpdateProgress(1.0 - 0.8 / (1.0 + 0.1 * step));
    }
    return !Aborted(this);
  };
  const auto fadeAtBorder = [&](const Points& solved) -> Points
  {
    return e.RegionWeights.size() > 0 ? mesh.P + e.RegionWeights.asDiagonal() * (solved - mesh.P)
                                      : solved;
  };
  try
  {
    if (this->AvoidSelfIntersections && !this->ReproduceThesis)
    {
      const int type =
        vtkSurfaceMeshConversion::OutputPointType(e.Model.Model, this->OutputPointsPrecision);
      e.Guarded = vtkFoldGuard::Solve(
        internal.Solver, e.Options, e.Model.ShareMesh(), type == VTK_FLOAT, fadeAtBorder, goOn);
      e.Report = e.Guarded.Style;
      e.Q = e.Guarded.Positions;
      return;
    }
    internal.Solver.SetMesh(e.Model.ShareMesh(), e.Part(), e.Rest, e.Plane);
    e.Report = internal.Solver.Solve(e.Options, goOn);
    e.Q = internal.Solver.TakePositions();
    if (e.RegionWeights.size() > 0)
    {
      e.Q = fadeAtBorder(e.Q);
    }
  }
  catch (const SphericalStyle::PartWithoutSphere& error)
  {
    vtkStyleArrays::CenterIds(this, e.Surface(), e.Model.Model).Refuse(error);
  }
}

void vtkSphericalStyleFilter::AttachArrays(
  const Internals& internal, const Execution& e, vtkPolyData* output) const
{
  using vtkSurfaceMeshConversion::AddPointArray;
  const vtkSurfaceMesh& surface = e.Surface();
  const int type = output->GetPoints()->GetDataType();
  const bool solved = e.HasTriangles();
  AddPointArray(output, surface, "TargetDirection", type,
    solved ? internal.Solver.GetDirections() : Points(0, 3));
  if (this->GenerateDisplacement)
  {
    vtkSurfaceMeshConversion::AddDisplacement(output, e.Model.Model);
  }
  if (e.RegionWeights.size() > 0)
  {
    AddPointArray(output, surface, "RegionWeight", VTK_DOUBLE, e.RegionWeights);
  }
  if (e.Guarded.Roundness.size() > 0)
  {
    AddPointArray(output, surface, "RemainingRoundness", VTK_DOUBLE, e.Guarded.Roundness);
  }
  if (this->GenerateCellEnergy)
  {
    const Eigen::VectorXd energies = solved ? internal.Solver.GetCellEnergies() : Eigen::VectorXd();
    if (!solved || energies.size() > 0) // none where nothing is minimized: a warning says so
    {
      AddPointArray(output, surface, "CellEnergy", VTK_DOUBLE, energies);
    }
  }
  // An observer may have asked for it since: then there are none of this execution.
  if (this->GenerateRotation && (!solved || e.Options.keepRotations))
  {
    vtkSurfaceMeshConversion::AddRotations(output, surface, internal.Solver.GetRotations());
  }
}

void vtkSphericalStyleFilter::SetFacts(const Execution& e)
{
  this->SetLoopFacts(e.Report.loop);
  std::copy_n(e.Report.sphere.center.data(), 3, this->EffectiveCenter);
  this->EffectiveRadius = e.Report.sphere.radius;
  this->EffectiveCenterMode = this->CenterMode;
  const SphericalStyle::FoldGuardReport& guard = e.Guarded.Guard;
  const bool counted = e.Guarded.HasCounted();
  this->TurnedOverBefore = counted ? guard.before.turnedOver : NotCounted;
  this->TurnedOverAfter = counted ? guard.after.turnedOver : NotCounted;
  this->NewIntersectionsBefore = counted ? guard.before.newPairs : NotCounted;
  this->NewIntersectionsAfter = counted ? guard.after.newPairs : NotCounted;
  this->FoldSummary = vtkFoldGuard::Summary(e.Guarded);
  this->Advice.clear();
}

void vtkSphericalStyleFilter::Review(Internals& internal, const Execution& e)
{
  for (const std::string& warning : vtkStyleReview::Warnings(e.Surface(), e.Options, e.Report,
         { this->ReproduceThesis, this->GenerateCellEnergy,
           !vtkStyleArrays::IsChosen(this, vtkStyleArrays::NORMALS) }))
  {
    Warn(this, e.IsFirst() ? warning : "");
  }
  Warn(this, vtkFoldGuard::Remark(e.Guarded));
  const Eigen::Vector3d& lengths = e.Options.shape.lengths;
  const bool usesLengths = this->Target != SPHERE && this->Target != TARGET_MESH;
  if (usesLengths && e.IsFirst() && lengths.minCoeff() < 0.1 * (1.0 - 1e-9) * lengths.maxCoeff())
  {
    Warn(this, "TargetLengths: what is shorter than a tenth of the longest counts as a tenth");
  }
  if (!e.HasTriangles() || e.Report.loop.aborted)
  {
    return;
  }
  const vtkStyleReview::Remarks remarks = internal.Review.Review(e.Surface(),
    internal.Solver.GetMeshGeneration(), e.Q, e.Options, e.Report,
    { this->AvoidSelfIntersections, this->RefineLongEdges == vtkLongEdges::NEVER,
      e.Model.SplitShare, e.Rest ? SphericalStyle::ModelFacts() : e.Model.Facts });
  Warn(this, remarks.Thinned);
  this->Advice =
    this->ReproduceThesis || !e.IsFirst() ? "" : remarks.Advice; // the thesis is to be as it is
  if (this->Advice.empty() && e.HasTimeSteps && !e.Rest && !this->ReproduceThesis && e.IsFirst() &&
    this->Roundness > 0.0)
  {
    this->Advice =
      "The model has time steps. If it moves, give RestPose (an advanced property) one "
      "of them, as Force Time makes it: then the result does not jitter";
  }
  this->AdviceTime.Modified();
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
  os << indent << "Target: " << this->Target << "\n";
  os << indent << "TargetEdges: " << this->TargetEdges << "\n";
  os << indent << "TargetLengths: " << Triple(this->TargetLengths) << "\n";
  os << indent << "Symmetry: " << this->Symmetry << "\n";
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
  os << indent << "GenerateDisplacement: " << OnOff(this->GenerateDisplacement) << "\n";
  os << indent << "GenerateRotation: " << OnOff(this->GenerateRotation) << "\n";
  os << indent << "Preview: " << OnOff(this->Preview) << "\n";
  os << indent << "EffectiveCenter: " << Triple(this->EffectiveCenter) << "\n";
  os << indent << "EffectiveRadius: " << this->EffectiveRadius << "\n";
  os << indent << "CenterPosition: " << this->GetCenterPosition() << "\n";
  os << indent << "TurnedOverBefore: " << this->TurnedOverBefore << "\n";
  os << indent << "TurnedOverAfter: " << this->TurnedOverAfter << "\n";
  os << indent << "NewIntersectionsBefore: " << this->NewIntersectionsBefore << "\n";
  os << indent << "NewIntersectionsAfter: " << this->NewIntersectionsAfter << "\n";
  os << indent << "FoldSummary: " << this->GetFoldSummary() << "\n";
  os << indent << "Advice: " << this->GetAdvice() << "\n";
}
