// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How the motion of a surface carries the space around it.
#ifndef SphericalStyle_CarriedField_h
#define SphericalStyle_CarriedField_h

#include "TriangleMesh.h"

namespace SphericalStyle
{
/// The field [near]: each point s_k of the surface moves the space around it rigidly, as the
/// surface does there, and at x these motions are blended by their area over the fourth power of
/// the distance:
///
///     u(x) = sum_k w_k (d_k + (R_k - 1) (x - s_k)) / sum_k w_k,   w_k = a_k / |x - s_k|^4
///
/// Rigid where the surface moves rigidly, 0 where it does not move, smooth off the surface, d_k on
/// its points. Nothing keeps it from folding.
///
/// Points far away from x count together: a group of radius r as one from 6 r on, its points by
/// themselves up to 4 r, and a smooth blend of both in between, so that the field has no steps.
/// Measured on an egg of a ball, up to half a diagonal off the surface: .5 % of the motion (rms).
///
/// Source: E. Luke, E. Collins, E. Blades, A fast mesh deformation method using explicit
/// interpolation, Journal of Computational Physics 231(2), 2012, there with the exponents 3 and 5.
///
/// Cost: 20 microseconds for each x.
class CarriedField
{
public:
  /// @param rest  points of no triangle do not count @param moved  n x 3
  /// @throw std::invalid_argument if no triangle has an area
  CarriedField(const TriangleMesh& rest, const Points& moved, int threads);

  /// u at the points x, length.
  Points At(const Points& x, int threads) const;
  /// How the space turns at the points x: the rotations closest to sum_k w_k R_k.
  Matrices RotationsAt(const Points& x, int threads) const;

private:
  /// What a group of samples adds at x: weight (offset + turn (x - center)).
  struct Group
  {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    double radius = 0.0;
    double area = 0.0;
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
    Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
    int begin = 0; ///< of its samples
    int end = 0;
    int child = -1; ///< the first of two, -1 for none
  };
  void Split(int group, std::vector<int>& order);
  void Summarize(Group& group) const;
  /// The groups and samples that count at x, blended into one.
  Group Blend(const Eigen::Vector3d& x) const;
  Eigen::Vector3d IntoFrame(const Points& x, int row) const;

  bool Moves = false;
  Eigen::RowVector3d Origin;
  double Scale = 1.0;
  std::vector<Group> Samples; // in the order of the tree
  std::vector<Group> Groups;
};
} // namespace SphericalStyle

#endif
