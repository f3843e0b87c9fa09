// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a deformation did to a surface: rotations, triangles turned over, and the measures of a
/// pair of surfaces in section [measures].
#ifndef SphericalStyle_DeformationMeasures_h
#define SphericalStyle_DeformationMeasures_h

#include "EdgePart.h"

namespace SphericalStyle
{
/// Rotation of the surface at each point: the one closest to the change of the edges of the
/// triangles at it, each by half its cotangents as in [local] but with no sphere. The solver's own
/// rotations are not that: they turn edges and targets together, and stay near the identity
/// [blend].
Matrices SurfaceRotations(
  const TriangleMesh& rest, const Points& deformed, int threads, const SurfacePart& part = {});

/// Flags of the triangles whose normal after the deformation points against the normal before,
/// turned by the mean of the rotations at the corners. A triangle that lost its area (1e-9 of it is
/// left, or less) has none.
/// @param rotations  n rotations, rest to deformed
std::vector<char> TurnedOver(
  const Points& P, const Points& Q, const Triangles& F, const Matrices& rotations);
int CountTurnedOver(
  const Points& P, const Points& Q, const Triangles& F, const Matrices& rotations);

/// Detail error [measures]: rms difference of the cotangent-Laplacian vectors sum_j w_ij (p_i -
/// p_j) of P turned by R and of Q, relative to the diagonal of P.
/// @param R  n rotations of the cells, rest to deformed
double DetailError(const Points& P, const Points& Q, const Triangles& F, const Matrices& R,
  const SurfacePart& part = {});

/// Rms change of the dihedral angles from P to Q, radians, the shorter way around; 0 without edges.
double DihedralChange(const Points& P, const Points& Q, const Triangles& F, const MeshEdges& edges,
  const EdgePart& part = {});

/// Standard deviation of the logarithms of positive ratios; 0 for none.
double LogSpread(const Eigen::VectorXd& ratios, const SurfacePart& part = {});
} // namespace SphericalStyle

#endif
