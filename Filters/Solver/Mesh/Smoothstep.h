// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How shares fade: without a kink at both ends.
#ifndef SphericalStyle_Smoothstep_h
#define SphericalStyle_Smoothstep_h

namespace SphericalStyle
{
/// s^2 (3 - 2 s): rises from 0 at s = 0 to 1 at s = 1, level at both.
/// @param s  0..1
constexpr double Smoothstep(double s)
{
  return s * s * (3.0 - 2.0 * s);
}
} // namespace SphericalStyle

#endif
