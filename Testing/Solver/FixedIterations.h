// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The mode in which two runs must agree to rounding.
#ifndef SphericalStyle_FixedIterations_h
#define SphericalStyle_FixedIterations_h

#include "StyleSolver.h"

/// The options with exactly so many plain iterations.
inline SphericalStyle::StyleOptions Fixed(SphericalStyle::StyleOptions options, int iterations)
{
  options.loop.stopRule = SphericalStyle::StopRule::FixedIterations;
  options.loop.maximumNumberOfIterations = iterations;
  options.loop.acceleration = false;
  return options;
}

#endif
