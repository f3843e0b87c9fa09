// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkStyleHistory.h"

#include "vtkFilterSupport.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

namespace vtkStyleHistory
{
void Fill(vtkTable* table, const SphericalStyle::StyleReport& report, const char* secondTerm)
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
  if (secondTerm)
  {
    add(secondTerm, [](const Row& r) { return r.energy.spherical; });
  }
  add("LocalChange", [](const Row& r) { return r.localChange; });
  add("GlobalChange", [](const Row& r) { return r.globalChange; });
  add("Residual", [](const Row& r) { return r.residual; });
  add("Gap", [](const Row& r) { return r.gap; });

  const SphericalStyle::StageSeconds& s = report.seconds;
  vtkFilterSupport::AddStageSeconds(table->GetFieldData(),
    { { "Base", s.base }, { "Weights", s.weights }, { "Analyze", s.analyze },
      { "Factor", s.factor }, { "Iterate", s.iterate }, { "Triangles", s.triangles } });
  vtkNew<vtkStringArray> solver;
  solver->SetName("LinearSolver");
  solver->InsertNextValue(report.linearSolver);
  table->GetFieldData()->AddArray(solver);
  vtkNew<vtkDoubleArray> spheres;
  spheres->SetName("Spheres");
  spheres->SetNumberOfComponents(4);
  for (const SphericalStyle::Sphere& sphere : report.spheres)
  {
    spheres->InsertNextTuple4(
      sphere.center.x(), sphere.center.y(), sphere.center.z(), sphere.radius);
  }
  table->GetFieldData()->AddArray(spheres);
  vtkFilterSupport::AddCount(table->GetFieldData(), "NumberOfStitches", report.stitches);
  vtkFilterSupport::AddCount(table->GetFieldData(), "NumberOfWallStitches", report.walls);
  if (report.edgeFlips >= 0)
  {
    vtkFilterSupport::AddCount(table->GetFieldData(), "EdgeFlips", report.edgeFlips);
    vtkFilterSupport::AddCount(table->GetFieldData(), "NegativeEdges", report.negativeEdges);
  }
}

void AddPlane(vtkTable* table, const std::optional<SphericalStyle::MirrorPlane>& plane)
{
  if (plane)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName("SymmetryPlane");
    array->SetNumberOfComponents(3);
    array->InsertNextTuple(plane->origin.data());
    array->InsertNextTuple(plane->normal.data());
    table->GetFieldData()->AddArray(array);
  }
}

void AddAdvice(vtkTable* table, const char* advice)
{
  vtkNew<vtkStringArray> array;
  array->SetName("Advice");
  array->InsertNextValue(advice);
  table->GetFieldData()->AddArray(array);
}

void AddBytes(vtkTable* table, const std::vector<double>& bytes)
{
  if (bytes.empty())
  {
    return;
  }
  vtkNew<vtkDoubleArray> array;
  array->SetName("BytesExchanged");
  array->SetNumberOfComponents(2);
  for (std::size_t k = 0; k < bytes.size(); k += 2)
  {
    array->InsertNextTuple2(bytes[k], bytes[k + 1]);
  }
  table->GetFieldData()->AddArray(array);
}

std::vector<std::string> Remarks(const SphericalStyle::StyleReport& report)
{
  std::vector<std::string> remarks;
  if (!report.loop.converged && !report.loop.aborted)
  {
    remarks.push_back("not converged after " + std::to_string(report.loop.iterations) +
      " iterations; raise MaximumNumberOfIterations or Tolerance");
  }
  if (report.unfinishedSolves > 0)
  {
    remarks.push_back(std::to_string(report.unfinishedSolves) +
      " solves of the global step ended before their solution: the factor of this mesh does not "
      "fit "
      "into memory, and conjugate gradients are slow on its slivers. Take SphericalWeighting "
      "Cotangent, or improve the mesh");
  }
  return remarks;
}
}
