// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The weight t of Eq. 5.18 as a function of the coordinate along an axis [proxy]
/// (thesis 5.4, 5.5).
#ifndef SphericalStyle_BlendFunction_h
#define SphericalStyle_BlendFunction_h

#include "TriangleMesh.h"

namespace SphericalStyle
{
enum class BlendFunction
{
  Constant,  ///< the same t everywhere
  Linear,    ///< g(s) = s
  Quadratic, ///< g(s) = s^2
  Tanh,      ///< g(s) = (1 + tanh(k (2 s - 1)) / tanh k) / 2
  Smoothstep ///< g(s) = s^2 (3 - 2 s)
};

struct BlendOptions
{
  BlendFunction function = BlendFunction::Constant;
  double constant = 0.5;                             ///< t of Constant, 0..1
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();   ///< any length above 0
  Eigen::Vector2d range = Eigen::Vector2d(0.0, 1.0); ///< fractions of the bounds along the axis
  double atStart = 0.0;                              ///< t where the range starts, 0..1
  double atEnd = 1.0;                                ///< t where it ends, 0..1
  double steepness = 3.0;                            ///< k of Tanh, above 0
};

/// g(s): rises from 0 at s = 0 to 1 at s = 1; s outside 0..1 is clamped. 1 for Constant.
double BlendShape(BlendFunction function, double steepness, double s);

/// t of every point: atStart + (atEnd - atStart) g(s), s the place of the point in the range.
/// @param P  n x 3 @return n, within 0..1
/// @throw std::invalid_argument for options out of range
Eigen::VectorXd BlendAlongAxis(const Points& P, const BlendOptions& options);
} // namespace SphericalStyle

#endif
