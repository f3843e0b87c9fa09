// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The smooth border of a region that deforms while the rest stays (thesis 4.9, 5.4).
#ifndef SphericalStyle_RegionBorder_h
#define SphericalStyle_RegionBorder_h

#include <Eigen/Core>

namespace SphericalStyle
{
/// 6 x^5 - 15 x^4 + 10 x^3 of x = distance / width, 1 from the width on: neither slope nor
/// curvature jumps at either end. For width 0 a step: 0 at distance 0, 1 elsewhere.
/// @param distances  n, >= 0, to what stays; infinite where nothing does @param width  length, >= 0
/// @return n weights, 0 at what stays
Eigen::VectorXd BorderWeights(const Eigen::VectorXd& distances, double width);
} // namespace SphericalStyle

#endif
