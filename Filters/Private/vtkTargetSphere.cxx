// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTargetSphere.h"

#include "NearestPoint.h"
#include "SurfaceMeasures.h"
#include "vtkFilterSupport.h"
#include "vtkSurfaceMeshConversion.h"

#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cmath>

namespace
{
constexpr int NumberOfMeridians = 8; // whole circles
constexpr int NumberOfParallels = 7;
constexpr int NumberOfSegments = 64;
constexpr double LargestAmbiguity = 0.01; // a third of that in the radius

/// Closed: the last point is the first.
/// @param sphere  with the size of the shape that the circle lies on @param a, b  orthogonal, of
/// one length in units of the
///                radius @param height  of the circle's center along z, in the same unit
void AddCircle(vtkPoints* points, vtkCellArray* lines, const SphericalStyle::Sphere& sphere,
  const SphericalStyle::TargetShape& shape, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
  double height)
{
  const vtkIdType first = points->GetNumberOfPoints();
  lines->InsertNextCell(NumberOfSegments + 1);
  for (int k = 0; k < NumberOfSegments; ++k)
  {
    const double angle = 2.0 * EIGEN_PI * k / NumberOfSegments;
    const Eigen::Vector3d direction =
      std::cos(angle) * a + std::sin(angle) * b + height * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d point = sphere.center + sphere.radius * shape.Reach(direction);
    lines->InsertCellPoint(points->InsertNextPoint(point.data()));
  }
  lines->InsertCellPoint(first);
}
}

void vtkTargetSphere::Fill(vtkPolyData* output, const std::vector<SphericalStyle::Sphere>& spheres,
  const SphericalStyle::TargetShape& shape)
{
  using Eigen::Vector3d;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  for (const SphericalStyle::Sphere& sphere : spheres)
  {
    for (int k = 0; k < NumberOfMeridians; ++k)
    {
      const double angle = EIGEN_PI * k / NumberOfMeridians;
      AddCircle(points, lines, sphere, shape, { std::cos(angle), std::sin(angle), 0.0 },
        Vector3d::UnitZ(), 0.0);
    }
    for (int k = 1; k <= NumberOfParallels; ++k)
    {
      const double angle = EIGEN_PI * k / (NumberOfParallels + 1);
      AddCircle(points, lines, sphere, shape, std::sin(angle) * Vector3d::UnitX(),
        std::sin(angle) * Vector3d::UnitY(), std::cos(angle));
    }
  }
  output->SetPoints(points);
  output->SetLines(lines);
}

bool vtkTargetSphere::Encloses(
  const SphericalStyle::TriangleMesh& mesh, const Eigen::Vector3d& point)
{
  double angle = 0.0;
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    angle += SphericalStyle::SolidAngle(mesh.P, mesh.F, f, point);
  }
  return std::abs(angle) > 2.0 * EIGEN_PI;
}

bool vtkTargetSphere::IsNear(
  const SphericalStyle::TriangleMesh& mesh, const Eigen::Vector3d& point, double distance)
{
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    const Eigen::Vector3d nearest = SphericalStyle::NearestOfTriangle(
      point, mesh.P.row(mesh.F(f, 0)), mesh.P.row(mesh.F(f, 1)), mesh.P.row(mesh.F(f, 2)));
    if ((nearest - point).squaredNorm() < distance * distance)
    {
      return true;
    }
  }
  return false;
}

std::string vtkTargetSphere::OnCenter(const std::vector<int>& points, const vtkSurfaceMesh& surface)
{
  vtkIdType count = 0;
  vtkIdType first = -1;
  int process = -1;
  for (const int i : points)
  {
    if (surface.Part.Counts(i) && count++ == 0)
    {
      first = surface.FirstInputPoint(i);
    }
  }
  vtkSurfaceMeshConversion::CountOnAll(surface.Part, count, first, process);
  return count == 0 ? std::string()
                    : "no direction from the center for " +
      vtkFilterSupport::Count(count, "point") + " on it, the first is point " +
      std::to_string(first) + vtkSurfaceMeshConversion::OfProcess(process) +
      "; the mean of the neighbors' directions is taken";
}

std::string vtkTargetSphere::VolumeRemark(const char* what,
  const SphericalStyle::TriangleMesh& mesh, const SphericalStyle::SurfacePart& part)
{
  if (SphericalStyle::VolumeAmbiguity(mesh.P, mesh.F, part) < LargestAmbiguity)
  {
    return {};
  }
  return std::string("RadiusMode EqualVolume: ") + what +
    " is open, or its triangles do not all face the same way; the volume of the cones from the "
    "mean point is taken. EqualArea needs no volume";
}
