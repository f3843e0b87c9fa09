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
/// Keeps 36 bytes per point for each step of the window; what it mixes is a proposal.
class AndersonAcceleration
{
public:
  /// @param window  1..LargestWindow: residuals looked at
  AndersonAcceleration(int window, int threads);

  static constexpr int LargestWindow = 8;

  /// @param x  current point @param g  the map's image of x
  /// @param mixed  the combination of the last images whose residual is smallest
  /// @return false (mixed untouched) while there is no earlier residual
  bool Mix(const Points& x, const Points& g, Points& mixed);
  /// Forgets all earlier residuals.
  void Reset();

private:
  /// The changes from one call to the next. Those of the residual decide on the mixture only, for
  /// which single precision is enough; what is mixed stays as exact as it is.
  struct Step
  {
    std::vector<float> residual;
    std::vector<double> image;
  };
  Step& NextStep();
  void AddStep(const Points& x, const Points& g);

  int Window;
  int Threads;
  bool HasLast = false;
  Points LastResidual;
  Points LastImage;
  std::vector<Step> Steps; // oldest first
  // Of the steps' residuals, and their products with the last residual. Without memory of their
  // own: Eigen would free it twice if there is none to grow.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, LargestWindow, LargestWindow> Gram;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, LargestWindow, 1> Right;
};
} // namespace SphericalStyle

#endif
