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

  void Solve(vtkLocalTermAlgorithm* self, const std::shared_ptr<SphericalStyle::LocalTerm>& term);
  SphericalStyle::Points GetPositions() const;
  void Warn(vtkLocalTermAlgorithm* self) const;
};

void vtkLocalTermAlgorithm::Internals::Solve(
  vtkLocalTermAlgorithm* self, const std::shared_ptr<SphericalStyle::LocalTerm>& term)
{
  SphericalStyle::StyleOptions options;
  options.loop = self->MakeLoopOptions();
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
  if (this->Surface.Mesh.F.rows() > 0)
  {
    for (std::string& remark : vtkStyleHistory::Remarks(this->Report))
    {
      remarks.push_back(std::move(remark));
    }
  }
  for (const std::string& remark : remarks)
  {
    vtkWarningWithObjectMacro(self, << InBlock(self) << remark);
  }
}

//------------------------------------------------------------------------------------------------
vtkLocalTermAlgorithm::vtkLocalTermAlgorithm()
  : Internal(std::make_unique<Internals>())
{
}

vtkLocalTermAlgorithm::~vtkLocalTermAlgorithm() = default;

void vtkLocalTermAlgorithm::AddArrays(
  const SphericalStyle::LocalTerm&, const vtkSurfaceMesh&, vtkPolyData*)
{
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
  this->SetLoopFacts(internal.Report.loop);
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
  this->SetLoopFacts(internal.Report.loop);
  return 1;
}
