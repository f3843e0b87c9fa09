// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The target sphere as something to look at, and whether its center and radius mean something to
/// the model. Private.
#ifndef vtkTargetSphere_h
#define vtkTargetSphere_h

#include "TargetDirections.h" // for Sphere

#include <string>
#include <vector>

class vtkPolyData;
struct vtkSurfaceMesh;

namespace vtkTargetSphere
{
/// Fills `output` with lines of longitude and latitude around each center, axis z, on the shape
/// that has the size of the sphere. Lines, so that the model is seen through them however they are
/// shown.
void Fill(vtkPolyData* output, const std::vector<SphericalStyle::Sphere>& spheres,
  const SphericalStyle::TargetShape& shape);

/// Whether the surface winds around the point: the solid angles of its triangles sum to more than
/// 2 pi, half the full angle, in size. Holes so count as closed where they are narrow. The
/// triangles must agree on their outside; which it is does not matter. O(m).
bool Encloses(const SphericalStyle::TriangleMesh& mesh, const Eigen::Vector3d& point);

/// Whether the surface comes nearer to the point than a distance. O(m).
bool IsNear(
  const SphericalStyle::TriangleMesh& mesh, const Eigen::Vector3d& point, double distance);

/// The warning for points that have no direction from the center; empty without any.
/// @param points  of the mesh
std::string OnCenter(const std::vector<int>& points, const vtkSurfaceMesh& surface);

/// For RadiusMode EqualVolume: the warning where the mesh has no volume of its own, but for holes
/// that change it by less than a hundredth; else empty. O(m). @param what  the mesh, in words
std::string VolumeRemark(const char* what, const SphericalStyle::TriangleMesh& mesh,
  const SphericalStyle::SurfacePart& part = {});
}

#endif
