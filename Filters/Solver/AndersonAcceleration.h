// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Anderson acceleration of a fixed-point map (Anderson 1965; for local/global solvers: Peng et
/// al., Anderson acceleration for geometry optimization and physics simulation, ACM TOG 37(4),
/// 2018).
#ifndef SphericalStyle_AndersonAcceleration_h
#define SphericalStyle_AndersonAcceleration_h

#include "TriangleMesh.h"

namespace SphericalStyle
{
class AndersonAcceleration
{
public:
  explicit AndersonAcceleration(int window)
    : Window(window)
  {
  }

  /// @param x  current point @param g  the map's image of x
  /// @param mixed  the combination of the last images whose residual is smallest
  /// @return false (mixed untouched) while there is no earlier residual
  bool Mix(const Points& x, const Points& g, Points& mixed);
  /// Forgets all earlier residuals.
  void Reset();

private:
  int Window;
  bool HasLast = false;
  Points LastResidual;
  Points LastImage;
  std::vector<Points> ResidualSteps; // newest last
  std::vector<Points> ImageSteps;
};
} // namespace SphericalStyle

#endif
