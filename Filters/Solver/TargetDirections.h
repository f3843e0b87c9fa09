// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The target sphere, the directions t toward it and the edge targets tau [symbols].
#ifndef SphericalStyle_TargetDirections_h
#define SphericalStyle_TargetDirections_h

#include "MeshTopology.h"

namespace SphericalStyle
{
enum class CenterMode
{
  PointMean,    ///< mean of the points (thesis)
  AreaCentroid, ///< mean of the surface
  Custom
};

enum class RadiusMode
{
  EqualArea,   ///< sqrt(A / 4 pi) (thesis)
  EqualVolume, ///< cube root of 3 V / 4 pi
  Custom
};

/// What becomes of an edge target that opposes its edge on the rest shape (Eq. 4.39).
enum class ConcaveEdges
{
  Keep,
  Flip,
  Zero
};

struct Sphere
{
  Eigen::Vector3d center = Eigen::Vector3d::Zero(); ///< O
  double radius = 1.0;                              ///< r > 0
};

/// @param custom  what the Custom modes take
/// @throw std::invalid_argument when the radius is not above zero
Sphere TargetSphere(
  const Points& P, const Triangles& F, CenterMode center, RadiusMode radius, const Sphere& custom);

/// A part of a surface that has no target sphere.
class PartWithoutSphere : public std::invalid_argument
{
public:
  PartWithoutSphere(int part, const std::string& why)
    : std::invalid_argument("part " + std::to_string(part) + ": " + why)
    , Part(part)
    , Why(why)
  {
  }

  int Part;
  std::string Why; ///< without the part
};

/// The same for each part of a surface by itself: its points, and the triangles that have two or
/// three corners in it (of three parts at one triangle, the part of its first corner takes it).
/// @param parts  n, 0..numberOfParts-1, or -1 for points of no part
/// @throw PartWithoutSphere where TargetSphere throws, and for one without a point or triangle
std::vector<Sphere> TargetSpheres(const Points& P, const Triangles& F,
  const std::vector<int>& parts, int numberOfParts, CenterMode center, RadiusMode radius,
  const Sphere& custom);

/// d_i = (p_i - O) / |p_i - O| (Eq. 4.4). A point within 1e-12 diagonals of O has no direction: it
/// takes the mean over the other corners of its triangles (zero when they surround it evenly).
/// @param onCenter  those points, ascending
Points CenterDirections(const Points& P, const Triangles& F, const Eigen::Vector3d& O,
  std::vector<int>& onCenter);

/// t_i = (1 - a_i) d_i + a_i n_i (Eq. 4.6), a of one entry per point.
Points BlendDirections(const Points& d, const Points& n, const Eigen::VectorXd& a);

/// Adds omega_uv r (t_u - t_v) per half-edge to tau (m x 9, length): the targets of one center
/// [energy].
/// @param omega  n, share of this center; an edge takes the mean of its ends, so that both follow
///        the same centers. No rows: 1
void AddEdgeTargets(const Points& t, double r, const Eigen::VectorXd& omega, const Triangles& F,
  HalfEdgeVectors& tau);

/// Flips or zeroes the targets that oppose their edge, tau . e < 0, once on the rest shape.
/// @param rest  rest edges e_uv @return number of half-edges changed
int ChangeConcaveTargets(const HalfEdgeVectors& rest, ConcaveEdges concave, HalfEdgeVectors& tau);
} // namespace SphericalStyle

#endif
