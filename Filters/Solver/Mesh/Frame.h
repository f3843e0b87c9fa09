// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Model units and the units of a solve.
#ifndef SphericalStyle_Frame_h
#define SphericalStyle_Frame_h

#include "SurfacePart.h"

#include <cmath>

namespace SphericalStyle
{
/// A mesh is solved around the origin at diagonal 1, so that nothing depends on place and scale.
struct Frame
{
  Eigen::RowVector3d origin = Eigen::RowVector3d::Zero(); ///< length
  double scale = 1.0;                                     ///< diagonal of the bounds, length

  Points Into(const Points& x) const { return (x.rowwise() - this->origin) / this->scale; }
  Points OutOf(Points x) const
  {
    x = (this->scale * x).rowwise() + this->origin;
    return x;
  }

  /// Takes an energy, length^2, out of the frame; 0 stays 0 where scale^2 is infinite.
  template <typename Energy>
  Energy EnergyOutOf(const Energy& energy) const
  {
    return this->scale * (this->scale * energy);
  }
};

/// Origin in the middle of the bounds. @throw std::invalid_argument when they have no extent
inline Frame FrameOf(const Points& P, const SurfacePart& part = {})
{
  const auto [low, high] = BoundsOf(P, part);
  Frame frame;
  frame.origin = 0.5 * low + 0.5 * high;
  frame.scale = (0.5 * high - 0.5 * low).stableNorm() * 2.0;
  if (!(frame.scale > 0.0) || !std::isfinite(frame.scale))
  {
    throw std::invalid_argument("the points are all equal or too far apart");
  }
  return frame;
}
} // namespace SphericalStyle

#endif
