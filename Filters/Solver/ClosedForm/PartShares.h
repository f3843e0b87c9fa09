// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How much of each part there is at each point of a surface, in closed form.
#ifndef SphericalStyle_PartShares_h
#define SphericalStyle_PartShares_h

#include "SurfaceGrid.h"

#include <vector>

namespace SphericalStyle
{
/// 1 for the part that a point is of, else 0, n x count. @param parts  n, 0..count-1
Fields PartShares(const std::vector<int>& parts, int count);

/// omega of [centers]: the same smoothed twice on the grid, so that parts pass into each other over
/// about its size. Not below 0; rows of sum 1. Where the grid is unknown, as at triangles without
/// area, they stay.
/// @param grid  factored @param shares  n x count @param P  n x 3
Fields SmoothShares(const SurfaceGrid& grid, const Fields& shares, const Points& P, int threads);
} // namespace SphericalStyle

#endif
