// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether a solid stands, and how it has to lean so that it does. [stands]
#ifndef SphericalStyle_Standing_h
#define SphericalStyle_Standing_h

#include "TriangleMesh.h"

#include <vector>

namespace SphericalStyle
{
/// Center of mass of the solid in a closed surface, by the divergence theorem.
Eigen::Vector3d CenterOfMass(const TriangleMesh& mesh);

/// Convex hull of places on the plane that a solid stands on, counterclockwise.
using SupportPolygon = std::vector<Eigen::Vector2d>;

/// Of the points on the lowest level, within `tolerance`; x and y are the axes after `axis`.
SupportPolygon FindSupport(const Points& P, int axis, double tolerance);

/// The angle by which the solid can be tilted before it falls over, degrees: of all edges, the
/// least atan(distance of the center from the edge / height of the center). Below 0 where it falls
/// by itself, and -90 where it stands on a point or a line.
/// @param center  over the plane @param height  of the center, above 0
double TiltAngle(const SupportPolygon& support, const Eigen::Vector2d& center, double height);

/// The place nearest to `center` at which the tilt angle is `angle` degrees or more.
/// @return false where there is none
bool NearestStablePlace(const SupportPolygon& support, const Eigen::Vector2d& center, double height,
  double angle, Eigen::Vector2d& place);
} // namespace SphericalStyle

#endif
