// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSphereProjectionFilter.h"

#include "SphereProjection.h"
#include "vtkFilterSupport.h"
#include "vtkMovedSurface.h"
#include "vtkSurfaceMeshConversion.h"
#include "vtkTargetSphere.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

using SphericalStyle::Points;
using SphericalStyle::Sphere;
using namespace vtkFilterSupport;

vtkStandardNewMacro(vtkSphereProjectionFilter);

namespace
{
/// The sphere that the modes ask for.
/// @throw std::invalid_argument naming the mode that the input has no triangles for
Sphere FindSphere(
  const SphericalStyle::TriangleMesh& mesh, int centerMode, int radiusMode, const Sphere& custom)
{
  using Filter = vtkSphereProjectionFilter;
  const bool ofArea = radiusMode == Filter::EQUAL_AREA || radiusMode == Filter::EQUAL_VOLUME;
  if (mesh.F.rows() == 0 && (ofArea || centerMode == Filter::AREA_CENTROID))
  {
    throw std::invalid_argument(std::string(ofArea ? "RadiusMode" : "CenterMode AreaCentroid") +
      ": the input has no triangle with an area; take another mode");
  }
  auto radius = SphericalStyle::RadiusMode::Custom;
  if (ofArea)
  {
    radius = radiusMode == Filter::EQUAL_AREA ? SphericalStyle::RadiusMode::EqualArea
                                              : SphericalStyle::RadiusMode::EqualVolume;
  }
  Sphere sphere = SphericalStyle::TargetSphere(
    mesh.P, mesh.F, static_cast<SphericalStyle::CenterMode>(centerMode), radius, custom);
  if (radiusMode == Filter::OUTER)
  {
    sphere.radius = SphericalStyle::OuterRadius(mesh.P, sphere.center);
  }
  return sphere;
}
}

vtkSphereProjectionFilter::vtkSphereProjectionFilter() = default;

int vtkSphereProjectionFilter::RequestWholeData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  return RunGuarded(this, outputVector, [&] { return this->Execute(inputVector, outputVector); });
}

int vtkSphereProjectionFilter::Execute(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  namespace Conversion = vtkSurfaceMeshConversion;
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0], 0);
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
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

  Require(this->Coefficient >= 0.0 && this->Coefficient <= 1.0, "Coefficient", "in 0..1",
    this->Coefficient);
  RequireSphere(this->CenterMode == CUSTOM_CENTER ? this->Center : nullptr,
    this->RadiusMode == CUSTOM_RADIUS ? &this->Radius : nullptr);
  const vtkSurfaceMesh surface = Conversion::FromPolyData(input, true, Conversion::TakePoints::All);
  Sphere sphere;
  sphere.center = Eigen::Vector3d(this->Center);
  sphere.radius = this->RadiusMode == CUSTOM_RADIUS ? this->Radius : 1.0;
  sphere = FindSphere(surface.Mesh, this->CenterMode, this->RadiusMode, sphere);

  std::vector<int> onCenter;
  const Points Q = SphericalStyle::ProjectToSphere(
    surface.Mesh.P, sphere, this->Coefficient, ThreadsToUse(this->NumberOfThreads), onCenter);
  output->ShallowCopy(input);
  vtkMovedSurface::Fill(this, output, surface, Q);
  Conversion::AddDisplacement(output, input);
  if (!onCenter.empty())
  {
    vtkWarningMacro(<< InBlock(this) << "no ray from the center through "
                    << Count(static_cast<vtkIdType>(onCenter.size()), "point")
                    << " on it, the first is point " << surface.FirstInputPoint(onCenter.front())
                    << "; they stay in place");
  }
  if (this->RadiusMode == EQUAL_VOLUME)
  {
    Warn(this, vtkTargetSphere::VolumeRemark("the surface", surface.Mesh));
  }
  std::copy_n(sphere.center.data(), 3, this->EffectiveCenter);
  this->EffectiveRadius = sphere.radius;
  return 1;
}

void vtkSphereProjectionFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Coefficient: " << this->Coefficient << "\n";
  os << indent << "CenterMode: " << this->CenterMode << "\n";
  os << indent << "Center: " << Triple(this->Center) << "\n";
  os << indent << "RadiusMode: " << this->RadiusMode << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "EffectiveCenter: " << Triple(this->EffectiveCenter) << "\n";
  os << indent << "EffectiveRadius: " << this->EffectiveRadius << "\n";
}
