// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Points on their way to a sphere [projection] (thesis Fig. 4.26, outSphere): the ray from O
/// through p meets the sphere at q = O + r (p - O) / |p - O|, and p' = (1 - s) p + s q.
#ifndef SphericalStyle_SphereProjection_h
#define SphericalStyle_SphereProjection_h

#include "TargetDirections.h"

namespace SphericalStyle
{
/// Radius of the sphere around `center` that holds all points and touches the farthest: max |p -
/// O|.
double OuterRadius(const Points& P, const Eigen::Vector3d& center);

/// @param s  0: the points to the last bit, 1: points of the sphere
/// @param threads  the result has the same bits for any number
/// @param onCenter  points within 1e-12 of the farthest distance from O, which no ray goes through:
///        they stay
Points ProjectToSphere(
  const Points& P, const Sphere& sphere, double s, int threads, std::vector<int>& onCenter);
} // namespace SphericalStyle

#endif
