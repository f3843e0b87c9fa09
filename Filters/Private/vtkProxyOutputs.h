// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What vtkConvexProxyDeformFilter shows beside the deformed model: the proxy, the lines to it, and
/// what there is to warn of. Private.
#ifndef vtkProxyOutputs_h
#define vtkProxyOutputs_h

#include "ProxyDeformation.h"
#include "vtkSurfaceMeshConversion.h"

#include <string>
#include <vector>

class vtkPolyData;

namespace vtkProxyOutputs
{
/// The rounded proxy with its point arrays RestPosition and Displacement, and how long each stage
/// took as field data.
void FillProxy(vtkPolyData* output, const SphericalStyle::ProxyDeformation& deformation,
  const SphericalStyle::ProxyDeformationReport& report);

/// A line from each input point to its foot on the proxy at rest, with the cell arrays PointId and
/// t. @param t  n x 1 or n x 3
void FillLines(vtkPolyData* output, vtkPolyData* input, const vtkSurfaceMesh& surface,
  const vtkSurfaceMeshConversion::Rows& t, const SphericalStyle::ProxyDeformation& deformation);

/// The point arrays ProxyCell, Barycentric and, where there are cases, ProjectionCase.
void AddFeet(vtkPolyData* output, const vtkSurfaceMesh& surface, const SphericalStyle::Feet& feet);

/// What there is to warn of, in the order in which the steps are done.
std::vector<std::string> Warnings(const vtkSurfaceMesh& surface,
  const SphericalStyle::ProxyDeformationOptions& options, const SphericalStyle::TriangleMesh& proxy,
  const SphericalStyle::ProxyDeformationReport& report);
}

#endif
