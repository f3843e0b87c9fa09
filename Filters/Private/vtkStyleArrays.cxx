// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkStyleArrays.h"

#include "vtkSurfaceMeshConversion.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <string>

namespace Conversion = vtkSurfaceMeshConversion;

namespace
{
constexpr Conversion::ArrayRule Rules[] = {
  // from ROUNDNESS_FACTOR on
  { "Roundness factor", 1, 0.0, Conversion::Infinity, -1, vtkStyleArrays::PartRoundness },
  { "Normal blend", 1, 0.0, 1.0 },
  { "Target directions", 3, -Conversion::Infinity, Conversion::Infinity },
};
constexpr Conversion::ArrayRule BlendOfParts = { "Normal blend", 2, 0.0, 1.0, -1,
  vtkStyleArrays::PartNormalBlend };
}

namespace vtkStyleArrays
{
void SetDefaults(vtkAlgorithm* self)
{
  self->SetInputArrayToProcess(
    NORMALS, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::NORMALS);
  for (const int index :
    { ROUNDNESS_FACTOR, NORMAL_BLEND, TARGET_DIRECTIONS, REGION_MASK, CENTER_ID })
  {
    self->SetInputArrayToProcess(index, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "");
  }
}

bool IsChosen(vtkAlgorithm* self, int array)
{
  const char* name = self->GetInputArrayInformation(array)->Get(vtkDataObject::FIELD_NAME());
  return name && *name && std::string(name) != "None";
}

void Read(vtkAlgorithm* self, const vtkSurfaceMesh& surface, vtkPolyData* model,
  vtkPointSet* centers, SphericalStyle::MethodOptions& o)
{
  const auto gather = [&](int index)
  {
    return Conversion::GatherPointArray(
      self->GetInputArrayInformation(index), model, surface, Rules[index - ROUNDNESS_FACTOR]);
  };
  (IsChosen(self, ROUNDNESS_FACTOR) ? o.roundnessFactors : o.partFactors) =
    gather(ROUNDNESS_FACTOR).col(0);
  o.normalBlends = gather(NORMAL_BLEND).col(0);
  if (!IsChosen(self, NORMAL_BLEND))
  {
    const SphericalStyle::Points ofParts = Conversion::GatherPointArray(
      self->GetInputArrayInformation(NORMAL_BLEND), model, surface, BlendOfParts);
    if (ofParts.rows() > 0)
    {
      const auto weight = ofParts.col(1).array();
      o.normalBlends = weight * ofParts.col(0).array() + (1.0 - weight) * o.normalBlend;
      o.blendsOfParts = true;
    }
  }
  o.targets = gather(TARGET_DIRECTIONS);
  const bool useNormals =
    o.normalBlend > 0.0 || (o.normalBlends.size() > 0 && o.normalBlends.maxCoeff() > 0.0);
  if (surface.Part.Max(useNormals ? 1.0 : 0.0) > 0.0 && !o.HasTargets(surface.Part))
  {
    o.normals = Conversion::GatherNormals(self->GetInputArrayInformation(NORMALS), model, surface);
  }
  const vtkCenterIds ids = CenterIds(self, surface, model);
  o.centerIds = ids.OfPoints;
  if (centers)
  {
    o.centers = ids.Centers(centers);
  }
}

void Hold(
  const std::vector<char>& region, const vtkSurfaceMesh& surface, SphericalStyle::MethodOptions& o)
{
  for (std::size_t i = 0; i < region.size(); ++i)
  {
    if (!region[i])
    {
      o.fixedPoints.push_back(static_cast<int>(i));
    }
  }
  o.fixedPositions = surface.Mesh.P(o.fixedPoints, SphericalStyle::AllColumns);
}

vtkCenterIds CenterIds(vtkAlgorithm* self, const vtkSurfaceMesh& surface, vtkPolyData* model)
{
  return vtkCenterIds::Find(self->GetInputArrayInformation(CENTER_ID), surface, model);
}
}
