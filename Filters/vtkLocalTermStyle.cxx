// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLocalTermStyle.h"

#include "vtkFilterSupport.h"
#include "vtkStyleHistory.h"

#include "vtkPolyData.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkTable.h"

#include <string>
#include <utility>

SphericalStyle::LoopOptions vtkLocalTermStyle::MakeLoopOptions(
  int stopRule, double tolerance, int maximumNumberOfIterations, bool acceleration)
{
  vtkFilterSupport::Require(
    tolerance > 0.0 && tolerance < 1.0, "Tolerance", "above 0 and below 1", tolerance);
  SphericalStyle::LoopOptions loop;
  loop.stopRule = static_cast<SphericalStyle::StopRule>(stopRule);
  loop.tolerance = tolerance;
  loop.maximumNumberOfIterations = maximumNumberOfIterations;
  loop.acceleration = acceleration;
  return loop;
}

void vtkLocalTermStyle::Solve(vtkPolyDataAlgorithm* self, vtkPolyData* input,
  const SphericalStyle::LoopOptions& loop, int threads,
  std::shared_ptr<SphericalStyle::LocalTerm> term)
{
  this->Report = {};
  this->Surface = vtkSurfaceMeshConversion::FromPolyData(input, true);
  if (this->Surface.Mesh.F.rows() == 0)
  {
    return;
  }
  self->SetProgressText("Deforming");
  self->UpdateProgress(0.1);
  SphericalStyle::StyleOptions options;
  options.lambda = 0.0; // no sphere: the term is the whole style
  options.localTerm = std::move(term);
  options.loop = loop;
  options.threads = vtkFilterSupport::ThreadsToUse(threads);
  this->Solver.SetMesh(this->Surface.Mesh);
  this->Report = this->Solver.Solve(options,
    [self](int iteration, double)
    {
      self->UpdateProgress(1.0 - 0.8 / (1.0 + 0.1 * iteration));
      return !vtkFilterSupport::Aborted(self);
    });
}

void vtkLocalTermStyle::FillOutputs(vtkPolyDataAlgorithm* self, vtkPolyData* input,
  vtkPolyData* output, vtkTable* history, int precision, bool generateNormals,
  const char* secondTerm) const
{
  const bool solved = this->Surface.Mesh.F.rows() > 0;
  output->ShallowCopy(input);
  vtkSurfaceMeshConversion::ReplacePoints(output, this->Surface,
    solved ? this->Solver.GetPositions() : SphericalStyle::Points(0, 3), precision,
    generateNormals);
  vtkSurfaceMeshConversion::AddDisplacement(output, input);
  vtkStyleHistory::Fill(history, this->Report, secondTerm);

  const auto warn = [self](const std::string& text)
  { vtkWarningWithObjectMacro(self, << vtkFilterSupport::InBlock(self) << text); };
  for (const std::string& remark : vtkSurfaceMeshConversion::Remarks(this->Surface))
  {
    warn(remark);
  }
  if (solved && !this->Report.loop.converged && !this->Report.loop.aborted)
  {
    warn(vtkStyleHistory::NotConverged(this->Report));
  }
}
