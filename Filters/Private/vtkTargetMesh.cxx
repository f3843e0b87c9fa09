// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTargetMesh.h"

#include "SurfaceMeasures.h"
#include "TargetShape.h"
#include "vtkSurfaceMeshConversion.h"

#include "vtkPolyData.h"

#include <sstream>
#include <stdexcept>
#include <string>

std::shared_ptr<const SphericalStyle::StarMesh> vtkTargetMesh::Update(vtkPolyData* mesh)
{
  if (!mesh)
  {
    throw std::invalid_argument(
      "Target Mesh needs a mesh: give one as TargetMesh, or choose another Target");
  }
  try
  {
    if (!vtkSurfaceMeshConversion::Update(mesh, /*weld=*/true, this->Surface) && this->Star)
    {
      return this->Star;
    }
    this->Star.reset(); // should the next line throw
    this->Star = std::make_shared<const SphericalStyle::StarMesh>(this->Surface->Mesh);
    return this->Star;
  }
  catch (const SphericalStyle::NotStarShaped& error)
  {
    const SphericalStyle::TriangleMesh& surface = this->Surface->Mesh;
    std::ostringstream message;
    message << "TargetMesh is not star-shaped: its cell " << this->Surface->GetCell(error.Triangle)
            << " is not seen from its centroid ("
            << SphericalStyle::AreaCentroid(surface.P, surface.F).transpose()
            << "). Take a simpler mesh, such as its convex hull";
    throw std::invalid_argument(message.str());
  }
  catch (const std::invalid_argument& error)
  {
    throw std::invalid_argument(std::string("TargetMesh: ") + error.what());
  }
}
