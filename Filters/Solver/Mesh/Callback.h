// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How a caller follows a solve and ends it.
#ifndef SphericalStyle_Callback_h
#define SphericalStyle_Callback_h

#include <functional>

namespace SphericalStyle
{
/// Called after each iteration, or step where nothing iterates, with its number from 1 on.
/// @param change  of the energy in this iteration, relative to E_0; 0 where nothing iterates
/// @return whether to go on; false aborts the solve
using Callback = std::function<bool(int iteration, double change)>;

/// Thrown where nothing iterates and the callback asked to abort: there is no result.
struct SolveAborted
{
};
} // namespace SphericalStyle

#endif
