// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Walls that are too thin to be printed, and made thick enough. [walls]
#ifndef SphericalStyle_WallThickness_h
#define SphericalStyle_WallThickness_h

#include "TriangleMesh.h"

#include <functional>
#include <limits>
#include <vector>

namespace SphericalStyle
{
/// The two sides of a wall face away from each other by more than this, in degrees: what is near a
/// sharp edge is no wall.
constexpr double WallAngle = 120.0;

/// The wall that each point is on.
struct Walls
{
  Eigen::VectorXd thickness; ///< infinite where there is none, length
  std::vector<int> opposite; ///< triangle along the normal; -1 where there is none that faces away
};

/// Of each point, how far it is to the other side of the wall that it is on: along the ray against
/// its normal, to where that leaves the last of the parts that it runs through. Where that side
/// does not face away, rays tilted away from it by 15 and 30 degrees are tried, and the longest of
/// all up to one whose side does counts. Infinite where there is no such side within reach, and for
/// points inside of another part.
/// @param mesh  closed, facing outward @param reach  length
/// Cost: a tree of the triangles, and two rays for most points.
Walls FindWalls(
  const TriangleMesh& mesh, int threads, double reach = std::numeric_limits<double>::infinity());

/// A level along an axis that points on it stay on, and others stay above.
struct Ground
{
  int axis = 0;
  double level = -std::numeric_limits<double>::infinity();
};

/// Moves both sides of thin walls outward until no point has less than `thickness` below it along
/// its normal, by at
/// most half of it, or straight up by all of it where the other side lies on the ground. Next to
/// them the surface follows at a slope of one half, so that no step comes about. Points stay where
/// two triangles would run through each other, unless both ran through something before.
/// @param mesh  closed, facing outward; every triangle has an area
/// @param thickness  length, above 0
/// @param onStep  called before each step; what it throws ends all of it
/// @return the points; those of the mesh, bit for bit, where nothing is thinner
Points ThickenWalls(
  const TriangleMesh& mesh, double thickness, int threads, const Ground& ground = {},
  const std::function<void()>& onStep = [] {});
} // namespace SphericalStyle

#endif
