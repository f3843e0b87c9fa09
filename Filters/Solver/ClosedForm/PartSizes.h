// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Larger heads, smaller hands: each part of a surface gets a size of its own [sizes].
#ifndef SphericalStyle_PartSizes_h
#define SphericalStyle_PartSizes_h

#include "SurfaceGrid.h"

#include <utility>
#include <vector>

namespace SphericalStyle
{
/// With omega_k the smooth shares of the parts (PartShares) and s_k their sizes,
///
///     x' = sum_k omega_k(x) (s_k x + b_k).                                             [sizes]
///
/// Two parts meet at their joint, j_kl = sum A omega_k omega_l x / o_kl with the overlap o_kl = sum
/// A omega_k omega_l, A the areas of the points, and should agree there. The b_k are those for
/// which
///
///     sum_{k < l} o_kl |(s_k j_kl + b_k) - (s_l j_kl + b_l)|^2
///
/// is least and the centroid of the part with the largest area stays. Where the joints form a tree,
/// as with head and limbs, all agree exactly: a head grows out of its neck, and a hand goes along
/// with its arm. x' is linear in the sizes.
///
/// The grid takes what is near for what hangs together. Where triangles connect two parts, as by
/// way of the arm a hand and the cheek that it touches, the share of one in a point of the other
/// fades from 1.5 widths along edges to 4, and they have a joint only where a triangle has
/// corners of both. Parts that no triangles connect, as in a cracked mesh, share what is near. What
/// overlaps with nothing is joined to the nearest point that does, as closely as some thousand
/// points tell.
///
/// Cost: a factor of the grid's functions, once; then a pass over the points for other sizes.
class PartSizes
{
public:
  /// @param P  n x 3, in a frame of diagonal 1 @param F  m x 3, m > 0
  /// @param parts  n, 0..count-1 @param width  how far parts pass into each other: the size of the
  /// grid, above 0
  PartSizes(const Points& P, const Triangles& F, const std::vector<int>& parts, int count,
    double width, int threads);

  /// @param sizes  of each part, no unit, above 0 @return x', n x 3
  Points Sized(const Eigen::VectorXd& sizes) const;

  const Fields& GetShares() const { return this->Shares; } ///< omega, n x count

  /// The parts that are joined to another one by way of a part alone, as ears are to the body by
  /// way of the head; along the joints with the largest overlaps, those of a spanning tree.
  /// @return ascending, without the part
  std::vector<int> HangingOn(int part, int other) const;

private:
  struct Joint
  {
    int k;
    int l;
    double overlap; // area
    Eigen::RowVector3d place;
  };

  void ShareNothingThroughAir(const Triangles& F, double width);
  void FindJoints(const Eigen::VectorXd& areas);
  void JoinTheRest(const Eigen::VectorXd& areas);

  Points P;
  std::vector<int> Parts;
  Fields Shares;
  Eigen::MatrixXi Meet; // whether two parts are in one triangle, or nothing connects them
  std::vector<Joint> Joints;
  int Largest = 0; // part
  Eigen::RowVector3d Centroid;
};

/// A part, those that go along with it, and all the rest: a head, its ears, and the body.
struct Head
{
  int part = 0;
  std::vector<int> along;
};

/// The head of a figure: the part with the highest center along an axis, of those that enclose a
/// twentieth of what the one that encloses most does, so that ears and hands are none; each is
/// closed by its centroid. The body is the one that encloses most of the others.
/// @param head  the part that is known to be it, or -1
Head FindHead(const PartSizes& sized, const Points& P, const Triangles& F,
  const std::vector<int>& parts, int count, int axis, int head = -1);

/// Extent along an axis of the head alone, over that of the rest.
/// @return infinite where the rest has no extent
double HeightRatio(const Points& P, const std::vector<int>& parts, const Head& head, int axis);

/// By which the sizes of the head and of what goes along are to be multiplied for that ratio.
/// @return 0 where nothing between 1/20 and 20 will do
double FactorForHeightRatio(const PartSizes& sized, const Eigen::VectorXd& sizes,
  const std::vector<int>& parts, const Head& head, int axis, double wanted);

/// The ratios for 1/20 and 20, between which that finds a factor.
std::pair<double, double> HeightRatiosInReach(const PartSizes& sized, const Eigen::VectorXd& sizes,
  const std::vector<int>& parts, const Head& head, int axis);
} // namespace SphericalStyle

#endif
