// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLocalTermAlgorithm.h"

#include "vtkFilterSupport.h"
#include "vtkStyleHistory.h"
#include "vtkSurfaceMeshConversion.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <string>

using namespace vtkFilterSupport;

struct vtkLocalTermAlgorithm::Internals
{
  SphericalStyle::StyleSolver Solver;
  vtkSurfaceMesh Surface;
  SphericalStyle::StyleReport Report;

  static SphericalStyle::LoopOptions MakeLoopOptions(const vtkLocalTermAlgorithm* self);
  void Solve(vtkLocalTermAlgorithm* self, const std::shared_ptr<SphericalStyle::LocalTerm>& term);
  SphericalStyle::Points GetPositions() const;
  void Warn(vtkLocalTermAlgorithm* self) const;
  void SetFacts(vtkLocalTermAlgorithm* self) const;
};

SphericalStyle::LoopOptions vtkLocalTermAlgorithm::Internals::MakeLoopOptions(
  const vtkLocalTermAlgorithm* self)
{
  Require(self->Tolerance > 0.0 && self->Tolerance < 1.0, "Tolerance", "above 0 and below 1",
    self->Tolerance);
  SphericalStyle::LoopOptions loop;
  loop.stopRule = static_cast<SphericalStyle::StopRule>(self->StopRule);
  loop.tolerance = self->Tolerance;
  loop.maximumNumberOfIterations = self->MaximumNumberOfIterations;
  loop.acceleration = self->Acceleration;
  return loop;
}

void vtkLocalTermAlgorithm::Internals::Solve(
  vtkLocalTermAlgorithm* self, const std::shared_ptr<SphericalStyle::LocalTerm>& term)
{
  SphericalStyle::StyleOptions options;
  options.loop = MakeLoopOptions(self);
  if (this->Surface.Mesh.F.rows() == 0)
  {
    return;
  }
  self->SetProgressText("Deforming");
  self->UpdateProgress(0.1);
  options.lambda = 0.0; // no sphere: the term is the whole style
  options.localTerm = term;
  options.threads = ThreadsToUse(self->NumberOfThreads);
  this->Solver.SetMesh(this->Surface.Mesh);
  this->Report = this->Solver.Solve(options,
    [self](int iteration, double)
    {
      self->UpdateProgress(1.0 - 0.8 / (1.0 + 0.1 * iteration));
      return !Aborted(self);
    });
}

SphericalStyle::Points vtkLocalTermAlgorithm::Internals::GetPositions() const
{
  return this->Surface.Mesh.F.rows() > 0 ? this->Solver.GetPositions()
                                         : SphericalStyle::Points(0, 3);
}

void vtkLocalTermAlgorithm::Internals::Warn(vtkLocalTermAlgorithm* self) const
{
  std::vector<std::string> remarks = vtkSurfaceMeshConversion::Remarks(this->Surface);
  const SphericalStyle::LoopReport& loop = this->Report.loop;
  if (this->Surface.Mesh.F.rows() > 0 && !loop.converged && !loop.aborted)
  {
    remarks.push_back(vtkStyleHistory::NotConverged(this->Report));
  }
  for (const std::string& remark : remarks)
  {
    vtkWarningWithObjectMacro(self, << InBlock(self) << remark);
  }
}

void vtkLocalTermAlgorithm::Internals::SetFacts(vtkLocalTermAlgorithm* self) const
{
  const SphericalStyle::LoopReport& loop = this->Report.loop;
  self->NumberOfIterations = loop.iterations;
  self->Converged = loop.converged;
  self->FinalEnergy = loop.history.empty() ? 0.0 : loop.history.back().energy.Total();
}

//------------------------------------------------------------------------------------------------
vtkLocalTermAlgorithm::vtkLocalTermAlgorithm()
  : Internal(std::make_unique<Internals>())
{
  this->SetNumberOfOutputPorts(2);
}

vtkLocalTermAlgorithm::~vtkLocalTermAlgorithm() = default;

void vtkLocalTermAlgorithm::AddArrays(
  const SphericalStyle::LocalTerm&, const vtkSurfaceMesh&, vtkPolyData*)
{
}

int vtkLocalTermAlgorithm::FillInputPortInformation(int, vtkInformation* info)
{
  TakeDataSet(info);
  return 1;
}

int vtkLocalTermAlgorithm::FillOutputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkTable");
    return 1;
  }
  return this->Superclass::FillOutputPortInformation(port, info);
}

int vtkLocalTermAlgorithm::RequestWholeData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return RunGuarded(
    this, outputVector, [&] { return this->Execute(inputVector, outputVector); },
    [this] { this->Internal = std::make_unique<Internals>(); });
}

int vtkLocalTermAlgorithm::Execute(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  Internals& internal = *this->Internal;
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0], 0);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  internal.Report = {};
  internal.SetFacts(this);
  if (!IsSurface(this, inputVector[0]))
  {
    return 0;
  }
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  const std::shared_ptr<SphericalStyle::LocalTerm> term = this->MakeTerm(inputVector);
  internal.Surface = vtkSurfaceMeshConversion::FromPolyData(input, true);
  internal.Solve(this, term);
  output->ShallowCopy(input);
  vtkSurfaceMeshConversion::ReplacePoints(output, internal.Surface, internal.GetPositions(),
    this->OutputPointsPrecision, this->GenerateNormals);
  vtkSurfaceMeshConversion::AddDisplacement(output, input);
  this->AddArrays(*term, internal.Surface, output);
  vtkStyleHistory::Fill(vtkTable::GetData(outputVector, 1), internal.Report, this->GetTermName());
  internal.Warn(this);
  internal.SetFacts(this);
  return 1;
}

void vtkLocalTermAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "StopRule: " << this->StopRule << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MaximumNumberOfIterations: " << this->MaximumNumberOfIterations << "\n";
  os << indent << "Acceleration: " << OnOff(this->Acceleration) << "\n";
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "GenerateNormals: " << OnOff(this->GenerateNormals) << "\n";
  os << indent << "NumberOfIterations: " << this->NumberOfIterations << "\n";
  os << indent << "Converged: " << OnOff(this->Converged) << "\n";
  os << indent << "FinalEnergy: " << this->FinalEnergy << "\n";
}
