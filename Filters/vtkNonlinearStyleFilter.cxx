// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNonlinearStyleFilter.h"

#include "NonlinearFeature.h"
#include "vtkFilterSupport.h"
#include "vtkMovedSurface.h"
#include "vtkStyleArrays.h"
#include "vtkStyleHistory.h"
#include "vtkSurfaceMeshConversion.h"
#include "vtkTargetSphere.h"

#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <memory>
#include <string>

using SphericalStyle::Points;
using namespace vtkFilterSupport;

vtkStandardNewMacro(vtkNonlinearStyleFilter);

namespace
{
constexpr vtkSurfaceMeshConversion::ArrayRule RoundnessFactor = { "Roundness factor", 1, 0.0,
  vtkSurfaceMeshConversion::Infinity };
}

struct vtkNonlinearStyleFilter::Internals
{
  std::shared_ptr<const vtkSurfaceMesh> Surface; // shared with the method; or nullptr
  SphericalStyle::NonlinearFeature Solver;
};

vtkNonlinearStyleFilter::vtkNonlinearStyleFilter()
  : Internal(std::make_unique<Internals>())
{
  this->SetInputArrayToProcess(vtkStyleArrays::NORMALS, 0, 0,
    vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::NORMALS);
  this->SetInputArrayToProcess(
    vtkStyleArrays::ROUNDNESS_FACTOR, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "");
}

vtkNonlinearStyleFilter::~vtkNonlinearStyleFilter() = default;

int vtkNonlinearStyleFilter::RequestWholeData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return RunGuarded(
    this, outputVector, [&] { return this->Execute(inputVector, outputVector); },
    [this] { this->Internal = std::make_unique<Internals>(); });
}

int vtkNonlinearStyleFilter::Execute(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using namespace SphericalStyle;
  namespace Conversion = vtkSurfaceMeshConversion;
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0], 0);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  StyleReport report;
  this->SetLoopFacts(report.loop);
  std::fill_n(this->EffectiveCenter, 3, 0.0);
  this->EffectiveRadius = 0.0;
  if (!IsSurface(this, inputVector[0]))
  {
    return 0;
  }
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return 1;
  }

  RequireTarget(
    this->Roundness, this->CenterMode == CUSTOM_CENTER ? this->Center : nullptr, nullptr);
  NonlinearFeature& solver = this->Internal->Solver;
  Conversion::Update(input, true, this->Internal->Surface);
  const std::shared_ptr<const vtkSurfaceMesh> owner = this->Internal->Surface;
  const vtkSurfaceMesh& surface = *owner;
  NonlinearOptions o;
  o.lambda = this->Roundness;
  o.centerMode = static_cast<SphericalStyle::CenterMode>(this->CenterMode);
  o.center = Eigen::Vector3d(this->Center);
  o.centerConstraint = static_cast<SphericalStyle::CenterConstraint>(this->CenterConstraint);
  o.loop = this->MakeLoopOptions();
  o.threads = ThreadsToUse(this->NumberOfThreads);
  o.normals = Conversion::GatherNormals(
    this->GetInputArrayInformation(vtkStyleArrays::NORMALS), input, surface);
  o.roundnessFactors =
    Conversion::GatherPointArray(this->GetInputArrayInformation(vtkStyleArrays::ROUNDNESS_FACTOR),
      input, surface, RoundnessFactor)
      .col(0);
  const bool generateRotation = this->GenerateRotation; // an observer may change it meanwhile
  const bool solved = surface.Mesh.F.rows() > 0;
  if (solved)
  {
    this->SetProgressText("Rounding");
    this->UpdateProgress(0.1);
    solver.SetMesh(std::shared_ptr<const TriangleMesh>(owner, &surface.Mesh));
    report = solver.Solve(this->ReproduceThesis ? ThesisOptions(o) : o,
      [this](int iteration, double)
      {
        this->UpdateProgress(1.0 - 0.8 / (1.0 + 0.1 * iteration));
        return !Aborted(this);
      });
  }

  output->ShallowCopy(input);
  vtkMovedSurface::Fill(this, output, surface, solved ? solver.GetPositions() : Points(0, 3));
  Conversion::AddDisplacement(output, input);
  if (this->GenerateCellEnergy)
  {
    Conversion::AddPointArray(output, surface, "CellEnergy", VTK_DOUBLE,
      solved ? solver.GetCellEnergies() : Eigen::VectorXd());
  }
  if (this->GenerateAuxiliaryScale)
  {
    Conversion::AddPointArray(output, surface, "AuxiliaryScale", VTK_DOUBLE,
      solved ? solver.GetScales() : Eigen::VectorXd());
  }
  if (generateRotation)
  {
    Conversion::AddRotations(output, surface, solver.GetRotations());
  }
  vtkStyleHistory::Fill(vtkTable::GetData(outputVector, 1), report, "Spherical");
  this->SetLoopFacts(report.loop);
  std::copy_n(report.sphere.center.data(), 3, this->EffectiveCenter);
  this->EffectiveRadius = report.sphere.radius;
  this->Warn(report);
  return 1;
}

void vtkNonlinearStyleFilter::Warn(const SphericalStyle::StyleReport& report)
{
  using namespace SphericalStyle;
  const vtkSurfaceMesh& surface = *this->Internal->Surface;
  std::vector<std::string> remarks = vtkSurfaceMeshConversion::Remarks(surface);
  if (!report.pointsOnCenter.empty())
  {
    remarks.push_back(vtkTargetSphere::OnCenter(report.pointsOnCenter, surface));
  }
  if (surface.Mesh.F.rows() > 0)
  {
    for (std::string& remark : vtkStyleHistory::Remarks(report))
    {
      remarks.push_back(std::move(remark));
    }
  }
  const Rises rises = CountRises(report.loop);
  if (rises.globalSteps + rises.localSteps > 0)
  {
    remarks.push_back("the energy rose in " + std::to_string(rises.globalSteps) + " global and " +
      std::to_string(rises.localSteps) + " local steps and in " + std::to_string(rises.iterations) +
      " of " + std::to_string(report.loop.iterations) +
      " iterations: CenterConstraint AsWritten does not minimize it; Corrected does");
  }
  if (surface.Mesh.F.rows() > 0 && this->Internal->Solver.HasInwardNormals())
  {
    remarks.emplace_back("the normals point toward the center, and the surface turns over. Reverse "
                         "its faces (vtkReverseSense)");
  }
  for (const std::string& remark : remarks)
  {
    vtkFilterSupport::Warn(this, remark);
  }
}

void vtkNonlinearStyleFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Roundness: " << this->Roundness << "\n";
  os << indent << "CenterConstraint: " << this->CenterConstraint << "\n";
  os << indent << "CenterMode: " << this->CenterMode << "\n";
  os << indent << "Center: " << Triple(this->Center) << "\n";
  os << indent << "ReproduceThesis: " << OnOff(this->ReproduceThesis) << "\n";
  os << indent << "GenerateCellEnergy: " << OnOff(this->GenerateCellEnergy) << "\n";
  os << indent << "GenerateRotation: " << OnOff(this->GenerateRotation) << "\n";
  os << indent << "GenerateAuxiliaryScale: " << OnOff(this->GenerateAuxiliaryScale) << "\n";
  os << indent << "EffectiveCenter: " << Triple(this->EffectiveCenter) << "\n";
  os << indent << "EffectiveRadius: " << this->EffectiveRadius << "\n";
}
