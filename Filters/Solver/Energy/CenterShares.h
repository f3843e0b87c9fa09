// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How much each of several centers has to say at each point, for the energy.
#ifndef SphericalStyle_CenterShares_h
#define SphericalStyle_CenterShares_h

#include "LinearSystem.h"
#include "MeshTopology.h"

namespace SphericalStyle
{
/// omega of [energy]: the share of each center in each point, n x numberOfCenters, >= 0, rows of
/// sum 1. One center where `size` is 0; otherwise they pass into each other over about `size`, by
/// two implicit smoothing steps (M + s^2 L_c) X_{k+1} = M X_k, M the lumped areas, L_c the
/// cotangent matrix (positive semidefinite sign).
/// @param P  n x 3 @param topology, cotangents  what L_c is a sum over (EnergyTriangles)
/// @param size  s, model length
/// @param ids  n, 0..numberOfCenters-1
/// @param areas  n, the diagonal of M: PointAreas of the surface; none: those of the topology's
///        triangles
/// @return with a size, after one factorization as large as the global step's (or none, by
///         `method`) @throw SolverError when the system cannot be factored
Eigen::MatrixXd CenterShares(const Points& P, const MeshTopology& topology,
  const HalfEdgeScalars& cotangents, double size, const std::vector<int>& ids, int numberOfCenters,
  const Eigen::VectorXd& areas = {}, LinearMethod method = LinearMethod::Automatic,
  int threads = 1);
} // namespace SphericalStyle

#endif
