// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The size and the place of a model after a deformation [size].
#ifndef SphericalStyle_ModelSize_h
#define SphericalStyle_ModelSize_h

#include "SurfacePart.h"

namespace SphericalStyle
{
/// What of the model is as large after the deformation as it was before.
enum class KeepSize
{
  Off,    ///< nothing
  Area,   ///< area of the triangles
  Volume, ///< what they enclose; for closed surfaces
  Extent  ///< extent along the up axis
};

struct SizeOptions
{
  KeepSize keep = KeepSize::Off;
  Eigen::Vector3d up = Eigen::Vector3d::UnitY(); ///< the up axis, length 1
  bool keepOnGround = false;                     ///< the lowest point along it stays on its level
  int copies = 1; ///< of the model in the mesh: the first has extent and ground
};

/// What is kept, as a length: the root of the area, the cube root of the volume, the extent.
/// @param members  the points that count @param weights  n, of the points in the mean: rest areas
/// of the triangles of this process
double LengthOf(const Points& X, const Triangles& F, const std::vector<int>& members,
  const Eigen::VectorXd& weights, const SizeOptions& options, int threads,
  const SurfacePart& part = {});

/// Scales Q about its mean so that `keep` is what it was, then moves it along the up axis if asked.
/// @param P, Q  n x 3 rest and deformed points @param F  m x 3, what is measured
/// @param members  the points that count and that are moved, ascending
/// @param weights  n, of the points in the mean: rest areas
/// @param before  LengthOf the rest points
/// @return the factor; 1 with Off
/// @throw std::invalid_argument where there is nothing to keep: no volume, or no extent
double RestoreSize(const Points& P, const Triangles& F, const std::vector<int>& members,
  const Eigen::VectorXd& weights, const SizeOptions& options, double before, int threads, Points& Q,
  const SurfacePart& part = {});
} // namespace SphericalStyle

#endif
