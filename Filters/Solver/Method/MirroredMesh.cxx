// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "MirroredMesh.h"

#include <Eigen/Geometry>

#include <cmath>
#include <stdexcept>

namespace SphericalStyle
{
MirroredMesh::MirroredMesh(const TriangleMesh& mesh, const Frame& frame, const MirrorPlane& plane)
  : Plane(plane)
  , MeshFrame(frame)
{
  const Eigen::Vector3d n = plane.normal;
  this->MeshFrame.origin =
    frame.origin - plane.DistanceOf(frame.origin.transpose()) * n.transpose();
  n.cwiseAbs().maxCoeff(&this->Axis);
  const Eigen::Vector3d axis =
    std::copysign(1.0, n(this->Axis)) * Eigen::Vector3d::Unit(this->Axis);
  this->Turn = n == axis ? Eigen::Matrix3d::Identity()
                         : Eigen::Quaterniond::FromTwoVectors(n, axis).toRotationMatrix();
  this->P = this->Doubled(this->MeshFrame.Into(mesh.P));
  const Eigen::Index m = mesh.F.rows();
  this->F.resize(2 * m, 3);
  this->F.topRows(m) = mesh.F;
  const int images = static_cast<int>(mesh.P.rows());
  this->F.bottomRows(m) = (mesh.F.rowwise().reverse().array() + images).matrix();
}

Points MirroredMesh::Doubled(const Points& vectors) const
{
  if (vectors.rows() == 0)
  {
    return vectors; // without memory there is no column to turn around
  }
  Points doubled(2 * vectors.rows(), 3);
  doubled.topRows(vectors.rows()) = vectors * this->Turn.transpose();
  doubled.bottomRows(vectors.rows()) = doubled.topRows(vectors.rows());
  doubled.col(this->Axis).tail(vectors.rows()) *= -1.0;
  return doubled;
}

ClosedFormOptions MirroredMesh::Into(ClosedFormOptions o) const
{
  if (o.NumberOfCenters() > 1 || o.centers.rows() > 0)
  {
    throw std::invalid_argument(
      "Symmetry has one center: it cannot be used with a center id array");
  }
  if (o.centerMode == CenterMode::Custom)
  {
    o.custom.center = this->Turn * o.custom.center;
    o.custom.center(this->Axis) = 0.0;
  }
  const auto twice = [](Eigen::VectorXd& values)
  {
    const Eigen::Index n = values.size();
    values.conservativeResize(2 * n);
    values.tail(n) = values.head(n).eval();
  };
  twice(o.roundnessFactors);
  twice(o.normalBlends);
  twice(o.partFactors);
  o.normals = this->Doubled(o.normals);
  o.targets = this->Doubled(o.targets);
  const int n = static_cast<int>(this->P.rows()) / 2;
  const std::size_t fixed = o.fixedPoints.size();
  for (std::size_t k = 0; k < fixed; ++k)
  {
    o.fixedPoints.push_back(o.fixedPoints[k] + n);
  }
  o.centerIds.clear();
  o.shape.axes = this->Turn * o.shape.axes;
  o.size.up = this->Turn * o.size.up;
  o.size.copies = 2;
  return o;
}

ClosedFormResult MirroredMesh::OutOf(ClosedFormResult result) const
{
  const Eigen::Index n = this->P.rows() / 2;
  result.positions = (result.positions.topRows(n) * this->Turn).eval();
  result.directions = (result.directions.topRows(n) * this->Turn).eval();
  if (!result.rotations.empty())
  {
    result.rotations.resize(n);
    for (Eigen::Matrix3d& R : result.rotations)
    {
      R = this->Turn.transpose() * R * this->Turn;
    }
  }
  return result;
}

Sphere MirroredMesh::OutOf(Sphere sphere) const
{
  sphere.center = this->Turn.transpose() * sphere.center;
  return sphere;
}
} // namespace SphericalStyle
