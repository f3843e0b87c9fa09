// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The convex proxy of a model [proxy], steps 1 to 3 (thesis 5.2).
#ifndef SphericalStyle_ConvexProxy_h
#define SphericalStyle_ConvexProxy_h

#include "TriangleMesh.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace SphericalStyle
{
enum class ProxyMesher
{
  IsotropicRemeshing, ///< the hull, remeshed evenly
  BallPivoting,       ///< Poisson-disk samples of the hull, triangles by ball pivoting (thesis)
  AdvancingFront,     ///< the same samples, triangles by an advancing front
  SubdividedHull      ///< the hull's own triangles, long edges cut
};

/// Thins samples until no two are nearer than the radius and none could be put back (Poisson disk).
/// @param normals  of the samples, one each @return the samples kept, ascending
using PoissonDisk =
  std::function<std::vector<int>(const Points& samples, const Points& normals, double radius)>;

struct ConvexProxyOptions
{
  ProxyMesher mesher = ProxyMesher::IsotropicRemeshing;
  int numberOfPoints = 5000; ///< asked for; about that many come out. 4 or more
  std::uint32_t seed = 0;    ///< of the samples
  PoissonDisk poissonDisk;   ///< for BallPivoting and AdvancingFront
};

struct ConvexProxy
{
  TriangleMesh mesh;       ///< closed and oriented outward, or open in a plane when flat
  bool flat = false;       ///< the points lie in a plane: so does the proxy
  double hullVolume = 0.0; ///< length^3
  std::string fallback;    ///< why IsotropicRemeshing was taken instead; empty if it was not
};

/// @param P  n x 3, finite
/// @throw std::invalid_argument when the points lie on a line or at one place, or options are out
///        of range
ConvexProxy MakeConvexProxy(const Points& P, const ConvexProxyOptions& options);
} // namespace SphericalStyle

#endif
