// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The affine map closest to how some points moved [guard].
#ifndef SphericalStyle_AffineFit_h
#define SphericalStyle_AffineFit_h

#include "TriangleMesh.h"

#include <optional>

namespace SphericalStyle
{
/// x -> to + L (x - from), in rows.
struct AffineMap
{
  Eigen::RowVector3d from;
  Eigen::RowVector3d to;
  Eigen::Matrix3d L;

  Eigen::RowVector3d operator()(const Eigen::RowVector3d& x) const
  {
    return this->to + (x - this->from) * this->L.transpose();
  }
};

/// Fits q_i by p_i [guard]: relative to their weighted means, the similarity s R closest to them,
/// and then
///
///     L = s R + (sum a_i r_i p_i^T) (sum a_i p_i p_i^T + .003 sum a_i |p_i|^2 I)^-1,
///     r_i = q_i - s R p_i.
///
/// A similarity that all points follow is found to rounding. Across a plane that the points lie in,
/// L is that of the similarity.
/// @param P  k x 3, of about size 1 @param Q  k x 3, the same @param a  k weights, 0 or more
/// @return nothing if the points with a weight lie on a line, there are none, or Q or the map is
/// not
///         finite
std::optional<AffineMap> FitAffineMap(const Points& P, const Points& Q, const Eigen::VectorXd& a);
} // namespace SphericalStyle

#endif
