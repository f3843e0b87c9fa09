// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The smooth base of a model [detail]: what goes to the sphere while the details only turn; and
/// the same smoothing for the shares of several centers.
#ifndef SphericalStyle_BaseSurface_h
#define SphericalStyle_BaseSurface_h

#include "MeshTopology.h"

namespace SphericalStyle
{
/// Two implicit smoothing steps (M + s^2 L_c) X_{k+1} = M X_k, M the lumped areas, L_c the
/// cotangent matrix (positive semidefinite sign). Constants stay what they are.
/// @param P  n x 3 @param cotangents  HalfEdgeCotangents of P
/// @param size  s, model length; what is smaller leaves the field
/// @param X  n x any, one field per column
/// @return n x any. One factorisation of the size of the global step's.
/// @throw SolverError when the system cannot be factored
Eigen::MatrixXd SmoothFields(const Points& P, const MeshTopology& topology,
  const HalfEdgeScalars& cotangents, double size, const Eigen::MatrixXd& X);

/// The base B: the points themselves, smoothed.
Points SmoothBase(
  const Points& P, const MeshTopology& topology, const HalfEdgeScalars& cotangents, double size);

/// omega of [energy]: the share of each center in each point, n x numberOfCenters, >= 0, rows of
/// sum 1. One center where `size` is 0; otherwise they pass into each other over about `size`.
/// @param ids  n, 0..numberOfCenters-1
Eigen::MatrixXd CenterShares(const Points& P, const MeshTopology& topology,
  const HalfEdgeScalars& cotangents, double size, const std::vector<int>& ids, int numberOfCenters);
} // namespace SphericalStyle

#endif
