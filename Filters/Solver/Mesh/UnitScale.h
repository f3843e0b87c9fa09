// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Numbers of any size into the middle of a range.
#ifndef SphericalStyle_UnitScale_h
#define SphericalStyle_UnitScale_h

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace SphericalStyle
{
/// The power of two that brings the largest size among the numbers to between 1/2 and 1: times that
/// no digit changes. 1 if there are none or all are 0; within 2^-1000 and 2^1000.
template <typename Derived>
double UnitScale(const Eigen::DenseBase<Derived>& numbers)
{
  int exponent = 0;
  std::frexp(numbers.size() > 0 ? numbers.derived().cwiseAbs().maxCoeff() : 0.0, &exponent);
  return std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
}
} // namespace SphericalStyle

#endif
