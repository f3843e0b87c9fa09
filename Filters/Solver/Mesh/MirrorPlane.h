// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A plane that a model is to be its own mirror image about [symmetry].
#ifndef SphericalStyle_MirrorPlane_h
#define SphericalStyle_MirrorPlane_h

#include "TriangleMesh.h"

namespace SphericalStyle
{
struct MirrorPlane
{
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< a point of it
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX(); ///< length 1

  double DistanceOf(const Eigen::Vector3d& x) const { return this->normal.dot(x - this->origin); }
  Eigen::Vector3d Mirror(const Eigen::Vector3d& x) const
  {
    return x - 2.0 * this->DistanceOf(x) * this->normal;
  }
  bool operator==(const MirrorPlane& other) const
  {
    return this->origin == other.origin && this->normal == other.normal;
  }
};
} // namespace SphericalStyle

#endif
