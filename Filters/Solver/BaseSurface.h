// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The smooth base of a model [detail]: what goes to the sphere while the details only turn; and
/// the same smoothing for the shares of several centers.
#ifndef SphericalStyle_BaseSurface_h
#define SphericalStyle_BaseSurface_h

#include "LinearSystem.h"
#include "MeshTopology.h"

namespace SphericalStyle
{
/// Two implicit smoothing steps (M + s^2 L_c) X_{k+1} = M X_k, M the lumped areas, L_c the
/// cotangent matrix (positive semidefinite sign). Constants stay what they are.
/// @param topology, cotangents  what L_c is a sum over (EnergyTriangles)
/// @param areas  n, the diagonal of M: PointAreas of the surface
/// @param size  s, model length; what is smaller leaves the field
/// @param X  n x any, one field per column
/// @return n x any. One factorisation of the size of the global step's (or none, by `method`).
/// @throw SolverError when the system cannot be factored
Eigen::MatrixXd SmoothFields(const Eigen::VectorXd& areas, const MeshTopology& topology,
  const HalfEdgeScalars& cotangents, double size, const Eigen::MatrixXd& X,
  LinearMethod method = LinearMethod::Automatic, int threads = 1);

/// The base B: the points themselves, smoothed.
/// @param P  n x 3 @param areas  as above; none: those of the topology's triangles
Points SmoothBase(const Points& P, const MeshTopology& topology, const HalfEdgeScalars& cotangents,
  double size, const Eigen::VectorXd& areas = {}, LinearMethod method = LinearMethod::Automatic,
  int threads = 1);

/// omega of [energy]: the share of each center in each point, n x numberOfCenters, >= 0, rows of
/// sum 1. One center where `size` is 0; otherwise they pass into each other over about `size`.
/// @param ids  n, 0..numberOfCenters-1 @param areas  as above; none: those of the topology's
Eigen::MatrixXd CenterShares(const Points& P, const MeshTopology& topology,
  const HalfEdgeScalars& cotangents, double size, const std::vector<int>& ids, int numberOfCenters,
  const Eigen::VectorXd& areas = {}, LinearMethod method = LinearMethod::Automatic,
  int threads = 1);
} // namespace SphericalStyle

#endif
