// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Seconds since construction, for the stage times in reports.
#ifndef SphericalStyle_Stopwatch_h
#define SphericalStyle_Stopwatch_h

#include <chrono>

namespace SphericalStyle
{
class Stopwatch
{
public:
  double Seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Start).count();
  }

private:
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
};
} // namespace SphericalStyle

#endif
