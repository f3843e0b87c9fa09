// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSphericalStyleFilter.h"

#include "vtkFilterSupport.h"
#include "vtkSurfaceMeshConversion.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

using SphericalStyle::Points;
using namespace vtkFilterSupport;

vtkStandardNewMacro(vtkSphericalStyleFilter);

namespace
{
enum InputArrays
{
  NORMALS = 0,
  ROUNDNESS_FACTOR = 1,
  NORMAL_BLEND = 2,
  TARGET_DIRECTIONS = 3
};

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr vtkSurfaceMeshConversion::ArrayRule ArrayRules[] = {
  { "Normals", 3, -Infinity, Infinity, vtkDataSetAttributes::NORMALS },
  { "Roundness factor", 1, 0.0, Infinity },
  { "Normal blend", 1, 0.0, 1.0 },
  { "Target directions", 3, -Infinity, Infinity },
};

/// The history as rows; how long each stage took and what solved the system as field data.
void FillHistory(vtkTable* table, const SphericalStyle::StyleReport& report)
{
  using Row = SphericalStyle::HistoryRow;
  vtkNew<vtkIntArray> iteration;
  iteration->SetName("Iteration");
  for (const Row& row : report.loop.history)
  {
    iteration->InsertNextValue(row.iteration);
  }
  table->AddColumn(iteration);
  const auto add = [&](const char* name, double (*value)(const Row&))
  {
    vtkNew<vtkDoubleArray> column;
    column->SetName(name);
    for (const Row& row : report.loop.history)
    {
      column->InsertNextValue(value(row));
    }
    table->AddColumn(column);
  };
  add("Total", [](const Row& r) { return r.energy.Total(); });
  add("Rigid", [](const Row& r) { return r.energy.rigid; });
  add("Spherical", [](const Row& r) { return r.energy.spherical; });
  add("LocalChange", [](const Row& r) { return r.localChange; });
  add("GlobalChange", [](const Row& r) { return r.globalChange; });
  add("Residual", [](const Row& r) { return r.residual; });
  add("Gap", [](const Row& r) { return r.gap; });

  const SphericalStyle::StageSeconds& s = report.seconds;
  AddStageSeconds(table->GetFieldData(),
    { { "Base", s.base }, { "Weights", s.weights }, { "Analyze", s.analyze },
      { "Factor", s.factor }, { "Iterate", s.iterate } });
  vtkNew<vtkStringArray> solver;
  solver->SetName("LinearSolver");
  solver->InsertNextValue(report.linearSolver);
  table->GetFieldData()->AddArray(solver);
}
}

//------------------------------------------------------------------------------------------------
struct vtkSphericalStyleFilter::Internals
{
  SphericalStyle::StyleSolver Solver;

  /// @throw std::invalid_argument naming the property and its value
  static void CheckProperties(const vtkSphericalStyleFilter* self);
  static SphericalStyle::StyleOptions MakeOptions(
    vtkSphericalStyleFilter* self, const vtkSurfaceMesh& surface, vtkPolyData* input);
  static void Warn(vtkSphericalStyleFilter* self, const vtkSurfaceMesh& surface,
    const SphericalStyle::StyleReport& report);
  static void SetFacts(vtkSphericalStyleFilter* self, const SphericalStyle::StyleReport& report);
  void AttachArrays(vtkSphericalStyleFilter* self, const vtkSurfaceMesh& surface,
    vtkPolyData* input, vtkPolyData* output) const;
};

void vtkSphericalStyleFilter::Internals::CheckProperties(const vtkSphericalStyleFilter* self)
{
  RequireTarget(self->Roundness, self->CenterMode == CUSTOM_CENTER ? self->Center : nullptr,
    self->RadiusMode == CUSTOM_RADIUS ? &self->Radius : nullptr);
  Require(self->NormalBlend >= 0.0 && self->NormalBlend <= 1.0, "NormalBlend", "in 0..1",
    self->NormalBlend);
  Require(self->DetailSize >= 0.0 && self->DetailSize <= 0.2, "DetailSize", "in 0..0.2",
    self->DetailSize);
  Require(self->Tolerance > 0.0 && self->Tolerance < 1.0, "Tolerance", "above 0 and below 1",
    self->Tolerance);
}

SphericalStyle::StyleOptions vtkSphericalStyleFilter::Internals::MakeOptions(
  vtkSphericalStyleFilter* self, const vtkSurfaceMesh& surface, vtkPolyData* input)
{
  using namespace SphericalStyle;
  StyleOptions o;
  o.lambda = self->Roundness;
  o.normalBlend = self->NormalBlend;
  o.centerMode = static_cast<SphericalStyle::CenterMode>(self->CenterMode);
  o.radiusMode = static_cast<SphericalStyle::RadiusMode>(self->RadiusMode);
  o.custom = { Eigen::Vector3d(self->Center), self->Radius };
  o.detailSize = self->DetailSize;
  o.sphericalWeighting = static_cast<SphericalStyle::SphericalWeighting>(self->SphericalWeighting);
  o.concaveEdges = static_cast<SphericalStyle::ConcaveEdges>(self->ConcaveEdges);
  o.edgeWeighting = static_cast<SphericalStyle::EdgeWeighting>(self->EdgeWeighting);
  o.anchor = static_cast<SphericalStyle::Anchor>(self->Anchor);
  o.initialGuess = static_cast<SphericalStyle::InitialGuess>(self->InitialGuess);
  o.loop.stopRule = static_cast<SphericalStyle::StopRule>(self->StopRule);
  o.loop.tolerance = self->Tolerance;
  o.loop.maximumNumberOfIterations = self->MaximumNumberOfIterations;
  o.loop.acceleration = self->Acceleration;
  o.threads = ThreadsToUse(self->NumberOfThreads);

  const auto gather = [&](int index)
  {
    return vtkSurfaceMeshConversion::GatherPointArray(
      self->GetInputArrayInformation(index), input, surface, ArrayRules[index]);
  };
  o.roundnessFactors = gather(ROUNDNESS_FACTOR).col(0);
  o.normalBlends = gather(NORMAL_BLEND).col(0);
  o.targets = gather(TARGET_DIRECTIONS);
  const bool useNormals =
    o.normalBlend > 0.0 || (o.normalBlends.size() > 0 && o.normalBlends.maxCoeff() > 0.0);
  if (useNormals && o.targets.rows() == 0)
  {
    o.normals = gather(NORMALS);
    for (Eigen::Index i = 0; i < o.normals.rows(); ++i)
    {
      o.normals.row(i) = o.normals.row(i).stableNormalized();
    }
  }
  return self->ReproduceThesis ? ThesisOptions(o) : o;
}

void vtkSphericalStyleFilter::Internals::Warn(vtkSphericalStyleFilter* self,
  const vtkSurfaceMesh& surface, const SphericalStyle::StyleReport& report)
{
  const auto warn = [self](const std::string& text) { vtkWarningWithObjectMacro(self, << text); };
  const bool solved = surface.Mesh.F.rows() > 0;
  if (!solved)
  {
    warn("the input has no triangle with an area: nothing moves");
  }
  if (surface.FannedPolygons > 0)
  {
    warn("cut " + Count(surface.FannedPolygons, "polygon") +
      " that cannot be triangulated as fans, the first is cell " +
      std::to_string(surface.FirstFannedPolygon));
  }
  if (surface.DegenerateTriangles > 0)
  {
    warn("skipped " + Count(surface.DegenerateTriangles, "degenerate triangle") +
      ", the first in cell " + std::to_string(surface.FirstDegenerateCell) +
      "; points of no other triangle stay in place");
  }
  if (!report.pointsOnCenter.empty())
  {
    const auto n = static_cast<vtkIdType>(report.pointsOnCenter.size());
    warn("no direction from the centre for " + Count(n, "point") + " on it, the first is point " +
      std::to_string(surface.FirstInputPoint(report.pointsOnCenter.front())) +
      "; the mean of the neighbours' directions is taken");
  }
  if (solved && !report.loop.converged && !report.loop.aborted)
  {
    warn("not converged after " + std::to_string(report.loop.iterations) +
      " iterations; raise MaximumNumberOfIterations or Tolerance");
  }
}

void vtkSphericalStyleFilter::Internals::SetFacts(
  vtkSphericalStyleFilter* self, const SphericalStyle::StyleReport& report)
{
  const SphericalStyle::LoopReport& loop = report.loop;
  self->NumberOfIterations = loop.iterations;
  self->Converged = loop.converged;
  self->FinalEnergy = loop.history.empty() ? 0.0 : loop.history.back().energy.Total();
  std::copy_n(report.sphere.center.data(), 3, self->EffectiveCenter);
  self->EffectiveRadius = report.sphere.radius;
}

void vtkSphericalStyleFilter::Internals::AttachArrays(vtkSphericalStyleFilter* self,
  const vtkSurfaceMesh& surface, vtkPolyData* input, vtkPolyData* output) const
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
  if (self->GenerateCellEnergy)
  {
    AddPointArray(output, surface, "CellEnergy", VTK_DOUBLE,
      solved ? this->Solver.GetCellEnergies() : Eigen::VectorXd());
  }
  if (self->GenerateRotation)
  {
    vtkSurfaceMeshConversion::Rows rows(surface.Mesh.P.rows(), 9);
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
    {
      rows.row(i) = this->Solver.GetRotations()[i].transpose().reshaped().transpose();
    }
    AddPointArray(output, surface, "Rotation", type, rows);
  }
}

//------------------------------------------------------------------------------------------------
vtkSphericalStyleFilter::vtkSphericalStyleFilter()
  : Internal(std::make_unique<Internals>())
{
  this->SetNumberOfOutputPorts(2);
  this->SetInputArrayToProcess(
    NORMALS, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::NORMALS);
  for (const int index : { ROUNDNESS_FACTOR, NORMAL_BLEND, TARGET_DIRECTIONS })
  {
    this->SetInputArrayToProcess(index, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "");
  }
}

vtkSphericalStyleFilter::~vtkSphericalStyleFilter() = default;

int vtkSphericalStyleFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkTable");
    return 1;
  }
  return this->Superclass::FillOutputPortInformation(port, info);
}

int vtkSphericalStyleFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0], 0);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  vtkTable* history = vtkTable::GetData(outputVector, 1);
  SphericalStyle::StyleReport report;
  Internals::SetFacts(this, report);
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return 1;
  }

  vtkSurfaceMesh surface;
  Points Q;
  try
  {
    Internals::CheckProperties(this);
    surface = vtkSurfaceMeshConversion::FromPolyData(input, this->WeldCoincidentPoints);
    const SphericalStyle::StyleOptions options = Internals::MakeOptions(this, surface, input);
    if (surface.Mesh.F.rows() > 0)
    {
      this->SetProgressText("Rounding");
      this->UpdateProgress(0.1);
      this->Internal->Solver.SetMesh(surface.Mesh);
      report = this->Internal->Solver.Solve(options,
        [this](int iteration, double)
        {
          this->UpdateProgress(1.0 - 0.8 / (1.0 + 0.1 * iteration));
          return !Aborted(this);
        });
      Q = this->Internal->Solver.GetPositions();
    }
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }

  output->ShallowCopy(input);
  vtkSurfaceMeshConversion::ReplacePoints(
    output, surface, Q, this->OutputPointsPrecision, this->GenerateNormals);
  this->Internal->AttachArrays(this, surface, input, output);
  FillHistory(history, report);
  Internals::Warn(this, surface, report);
  Internals::SetFacts(this, report);
  return 1;
}

void vtkSphericalStyleFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Roundness: " << this->Roundness << "\n";
  os << indent << "NormalBlend: " << this->NormalBlend << "\n";
  os << indent << "CenterMode: " << this->CenterMode << "\n";
  os << indent << "Center: " << Triple(this->Center) << "\n";
  os << indent << "RadiusMode: " << this->RadiusMode << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "DetailSize: " << this->DetailSize << "\n";
  os << indent << "SphericalWeighting: " << this->SphericalWeighting << "\n";
  os << indent << "ConcaveEdges: " << this->ConcaveEdges << "\n";
  os << indent << "EdgeWeighting: " << this->EdgeWeighting << "\n";
  os << indent << "StopRule: " << this->StopRule << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MaximumNumberOfIterations: " << this->MaximumNumberOfIterations << "\n";
  os << indent << "Acceleration: " << OnOff(this->Acceleration) << "\n";
  os << indent << "Anchor: " << this->Anchor << "\n";
  os << indent << "WeldCoincidentPoints: " << OnOff(this->WeldCoincidentPoints) << "\n";
  os << indent << "InitialGuess: " << this->InitialGuess << "\n";
  os << indent << "ReproduceThesis: " << OnOff(this->ReproduceThesis) << "\n";
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "GenerateTargetDirection: " << OnOff(this->GenerateTargetDirection) << "\n";
  os << indent << "GenerateDisplacement: " << OnOff(this->GenerateDisplacement) << "\n";
  os << indent << "GenerateNormals: " << OnOff(this->GenerateNormals) << "\n";
  os << indent << "GenerateCellEnergy: " << OnOff(this->GenerateCellEnergy) << "\n";
  os << indent << "GenerateRotation: " << OnOff(this->GenerateRotation) << "\n";
  os << indent << "NumberOfIterations: " << this->NumberOfIterations << "\n";
  os << indent << "Converged: " << OnOff(this->Converged) << "\n";
  os << indent << "FinalEnergy: " << this->FinalEnergy << "\n";
  os << indent << "EffectiveCenter: " << Triple(this->EffectiveCenter) << "\n";
  os << indent << "EffectiveRadius: " << this->EffectiveRadius << "\n";
}
