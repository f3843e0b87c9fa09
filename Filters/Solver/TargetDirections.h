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

/// d_i = (p_i - O) / |p_i - O| (Eq. 4.4). A point within 1e-12 diagonals of O has no direction: it
/// takes the mean over the other corners of its triangles (zero when they surround it evenly).
/// @param onCenter  those points, ascending
Points CenterDirections(const Points& P, const MeshTopology& topology, const Eigen::Vector3d& O,
  std::vector<int>& onCenter);

/// t_i = (1 - a_i) d_i + a_i n_i (Eq. 4.6), a of one entry per point.
Points BlendDirections(const Points& d, const Points& n, const Eigen::VectorXd& a);

/// tau_uv = r (t_u - t_v) per half-edge, m x 9, length.
/// @param rest  rest edges e_uv that the concave test tau . e < 0 is made on, once
/// @param changed  number of half-edges flipped or zeroed
HalfEdgeVectors EdgeTargets(const Points& t, double r, const Triangles& F,
  const HalfEdgeVectors& rest, ConcaveEdges concave, int& changed);
} // namespace SphericalStyle

#endif
