// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What several processes have, found by numbers that mean the same on all of them.
#ifndef SphericalStyle_SharedNumbers_h
#define SphericalStyle_SharedNumbers_h

#include "SurfacePart.h"

#include <array>
#include <vector>

namespace SphericalStyle
{
/// Those of the numbers that several processes have. @param own  ascending, each once
std::vector<double> HadBySeveral(const std::vector<double>& own, const Processes& processes);

/// How many things the processes before this one have. @param own  number of those here
double CountBefore(const SurfacePart& part, double own);

/// Things of several processes with the same name are one, and count on the first of them.
/// @param names  two numbers each; each name once on a process
/// @param things  that the names are of, below `size`; those without a name are on this process
/// alone
SurfacePart PartByNames(const std::vector<std::array<double, 2>>& names,
  const std::vector<int>& things, std::size_t size, const SurfacePart& part);
} // namespace SphericalStyle

#endif
