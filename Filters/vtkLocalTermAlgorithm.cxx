// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLocalTermAlgorithm.h"

#include "vtkFilterSupport.h"
#include "vtkMovedSurface.h"
#include "vtkStyleHistory.h"
#include "vtkSurfaceMeshConversion.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <string>

using namespace vtkFilterSupport;

/// What is kept between executions.
struct vtkLocalTermAlgorithm::Internals
{
  SphericalStyle::StyleSolver Solver;
  std::shared_ptr<const vtkSurfaceMesh> Surface; // shared with the solver; or nullptr
};

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
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0], 0);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  SphericalStyle::StyleReport report;
  this->SetLoopFacts(report.loop);
  if (!IsSurface(this, inputVector[0]))
  {
    return 0;
  }
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  const std::shared_ptr<SphericalStyle::LocalTerm> term = this->MakeTerm(inputVector);
  vtkSurfaceMeshConversion::Update(input, true, this->Internal->Surface);
  const vtkSurfaceMesh& surface = *this->Internal->Surface;
  SphericalStyle::Points Q(0, 3);
  if (surface.Mesh.F.rows() > 0)
  {
    report = this->Solve(term);
    Q = this->Internal->Solver.GetPositions();
  }
  output->ShallowCopy(input);
  vtkMovedSurface::Fill(this, output, surface, Q);
  vtkSurfaceMeshConversion::AddDisplacement(output, input);
  this->AddArrays(*term, surface, output);
  vtkStyleHistory::Fill(vtkTable::GetData(outputVector, 1), report, this->GetTermName());
  for (const std::string& remark : vtkSurfaceMeshConversion::Remarks(surface))
  {
    Warn(this, remark);
  }
  if (surface.Mesh.F.rows() > 0)
  {
    for (const std::string& remark : vtkStyleHistory::Remarks(report))
    {
      Warn(this, remark);
    }
  }
  this->SetLoopFacts(report.loop);
  return 1;
}

SphericalStyle::StyleReport vtkLocalTermAlgorithm::Solve(
  const std::shared_ptr<SphericalStyle::LocalTerm>& term)
{
  const std::shared_ptr<const vtkSurfaceMesh>& surface = this->Internal->Surface;
  SphericalStyle::StyleSolver& solver = this->Internal->Solver;
  this->SetProgressText("Deforming");
  this->UpdateProgress(0.1);
  SphericalStyle::StyleOptions options;
  options.loop = this->MakeLoopOptions();
  options.lambda = 0.0; // no sphere: the term is the whole style
  options.localTerm = term;
  options.threads = ThreadsToUse(this->NumberOfThreads);
  solver.SetMesh(std::shared_ptr<const SphericalStyle::TriangleMesh>(surface, &surface->Mesh));
  return solver.Solve(options,
    [this](int iteration, double)
    {
      this->UpdateProgress(1.0 - 0.8 / (1.0 + 0.1 * iteration));
      return !Aborted(this);
    });
}
