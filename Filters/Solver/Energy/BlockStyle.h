// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Blocks along the axes of each part [block]: the term of TargetNormals, t_y the half axis closest
/// to n_y of the part's axes, which are those that its normals are nearest to already.
#ifndef SphericalStyle_BlockStyle_h
#define SphericalStyle_BlockStyle_h

#include "TargetNormals.h"

#include <vector>

namespace SphericalStyle
{
/// The three unit vectors u_k, the rows, at right angles that maximize
///
///     sum over the triangles of a_f sum over k of (u_k . n_f)^4
///
/// a_f the area and n_f the normal: 1 times the area where every normal lies along an axis, and 3/5
/// of it for a ball, whose axes are any. One pass over the triangles, then a problem of fixed size,
/// solved by the iteration of Y. Zhai et al., Complete Dictionary Learning via l4-Norm
/// Maximization, Journal of Machine Learning Research 21, 2020: it never goes down. Of its results
/// from eight starts the best is taken.
/// @param part  of each point, 0 to count - 1 @param count  of parts
/// @return one for each part; any axes where it has no area
std::vector<Eigen::Matrix3d> BlockAxes(
  const Points& P, const Triangles& F, const std::vector<int>& part, int count);

class BlockStyle : public TargetNormals
{
public:
  using TargetNormals::TargetNormals;

private:
  Points MakeTargets(const Points& P, const Triangles& F, const Points& normals) const override;
};
} // namespace SphericalStyle

#endif
