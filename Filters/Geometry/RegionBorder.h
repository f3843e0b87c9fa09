// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The smooth border of a region that deforms while the rest stays (thesis 5.4).
#ifndef SphericalStyle_RegionBorder_h
#define SphericalStyle_RegionBorder_h

#include "TriangleMesh.h"

#include <vector>

namespace SphericalStyle
{
/// 0 at points outside, from there to 1 at points inside that are `width` or more away from every
/// point outside: 6 x^5 - 15 x^4 + 10 x^3 of the distance over width, so that neither slope nor
/// curvature jumps. Distances are straight, which makes borders across cracks and between parts
/// smooth too. All 1 if nothing is outside; 0 and 1 alone for width 0.
/// @param P  n x 3 @param inside  n, 0 or 1 @param width  length, >= 0
Eigen::VectorXd BorderWeights(
  const Points& P, const std::vector<char>& inside, double width, int threads);
} // namespace SphericalStyle

#endif
