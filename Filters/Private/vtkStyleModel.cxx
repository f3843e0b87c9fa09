// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkStyleModel.h"

#include "vtkSurfaceRegion.h"

#include "vtkAlgorithm.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"

#include <algorithm>

namespace Conversion = vtkSurfaceMeshConversion;

namespace
{
bool HasCoincidentPoints(const vtkSurfaceMesh& surface)
{
  const auto isTaken = [](int point) { return point != vtkSurfaceMesh::NotMoved; };
  return std::count_if(surface.MeshPoint.begin(), surface.MeshPoint.end(), isTaken) >
    surface.Mesh.P.rows();
}
}

vtkStyleModel::Solved vtkStyleModel::Update(vtkAlgorithm* self, vtkPolyData* input,
  vtkSelection* selection, bool weld, const Refinement& refinement,
  const std::shared_ptr<const SphericalStyle::Processes>& processes)
{
  if (Conversion::Update(input, weld, this->Surface, this->Take, processes))
  {
    const vtkSurfaceMesh& surface = *this->Surface;
    this->LongEdgeShare = SphericalStyle::LongEdgeShare(surface.Mesh, surface.Part);
    this->Facts = surface.Part.IsWhole()
      ? SphericalStyle::MeasureModel(surface.Mesh, HasCoincidentPoints(surface))
      : SphericalStyle::ModelFacts();
  }
  if (!vtkLongEdges::IsWanted(refinement.When, this->LongEdgeShare))
  {
    return { input, selection, this->Surface, 0.0, this->Facts };
  }
  if (processes)
  {
    throw SphericalStyle::WholeSurfaceNeeded("long edges are split");
  }
  self->SetProgressText("Refining");
  self->UpdateProgress(0.01);
  return this->Refine(self, input, selection, weld, refinement);
}

vtkStyleModel::Solved vtkStyleModel::Refine(vtkAlgorithm* self, vtkPolyData* input,
  vtkSelection* selection, bool weld, const Refinement& refinement) const
{
  const auto find = [input](vtkInformation* wanted, const char* purpose)
  { return wanted ? Conversion::FindPointArray(wanted, input, purpose) : nullptr; };
  const vtkLongEdges::Refined refined =
    vtkLongEdges::Split(input, *this->Surface, refinement.Length,
      { find(refinement.Region, "Region"), find(refinement.CenterId, "Center id") });
  Solved solved;
  if (selection)
  {
    solved.Selection =
      vtkLongEdges::Select(vtkSurfaceRegion::SelectedPoints(self, input, selection), refined);
  }
  solved.Model = refined.Surface;
  const auto mesh =
    std::make_shared<vtkSurfaceMesh>(Conversion::FromPolyData(solved.Model, weld, this->Take));
  mesh->DegenerateTriangles = this->Surface->DegenerateTriangles;
  mesh->FirstDegenerateCell = this->Surface->FirstDegenerateCell;
  mesh->FannedPolygons = this->Surface->FannedPolygons;
  mesh->FirstFannedPolygon = this->Surface->FirstFannedPolygon;
  solved.Surface = mesh;
  solved.SplitShare = this->LongEdgeShare;
  solved.Facts = this->Facts;
  return solved;
}
