// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Head, hands, legs: the parts that a surface has by its shape [parts].
#ifndef SphericalStyle_SurfaceParts_h
#define SphericalStyle_SurfaceParts_h

#include "Callback.h"
#include "TriangleMesh.h"

#include <vector>

namespace SphericalStyle
{
/// A part has no less than this share of the area.
constexpr double LeastPart = 0.006;

struct PartsOptions
{
  int numberOfParts = 0; ///< wanted; 0: as many as there are good cuts
  int threads = 1;
};

struct SurfacePartsResult
{
  std::vector<int> parts; ///< of each point, n, 0 .. count - 1
  int count = 0;
  std::vector<double> thickness; ///< of each part: rho [limb], geometric mean
};

/// Cuts the surface again and again where that is best, at samples k of a SurfaceGrid of size .03,
/// so that cracks, loose triangles and the triangulation do not matter. With W_k the area of a
/// sample, n_k the smooth normal there, c_k <= 0 the smallest principal curvature of the base where
/// it is concave, and rho_k the thickness of the limb:
///
///     kappa_k = max(.02, exp(6 rho_k c_k)),      kappa_kl = sqrt(kappa_k kappa_l)
///     w_kl = 3 W_k W_l / (2 e^3)   for |x_k - x_l| < e = 2.3 sub-cells, n_k . n_l > -.2
///
/// The sum of w_kl over pairs across a border is its length L (a nonlocal perimeter: Garcia
/// Trillos, Slepcev, von Brecht, Laurent, Bresson, Consistency of Cheeger and ratio graph cuts,
/// JMLR 17, 2016). A piece C with the area A, at most half of its part, is worth cutting off where
///
///     q(C) = L / sqrt(2 pi A) * kappa^1.5 * exp(-.35 |log rho_C - log rho_rest|)
///
/// is small, kappa the mean of kappa_kl along its border and log rho the means over both sides:
/// short borders, in concave places (the minima rule: Hoffman, Richards, Parts of recognition,
/// 1984), between thick and thin. Half of a sphere has q = 1. Only L < .9 sqrt(2 pi A) is looked
/// at.
///
/// Pieces are connected level sets of fields u: the smoothest nine with
/// -div(kappa grad u) = lambda u on the part (inverse subspace iteration from x, y, z and their
/// products), and the answers to a source at twelve samples that are far from each other in the
/// space of u / sqrt(lambda), the tips of limbs. Along a border that has been cut kappa becomes 1.
/// Cuts are made from the best on: while q < .25, or until there are enough parts. Loose pieces
/// below LeastPart belong to the nearest other. A point is of the part whose smooth share is
/// largest there.
///
/// @param P  n x 3, in a frame of diagonal 1 @param F  m x 3, m > 0, facing outward
/// @param callback  asked before each search for a cut, with its number
/// @return fewer parts than wanted where nothing more can be cut off, or a piece is smaller than
/// the points are apart; more where there are more loose pieces. The same for any number of
/// threads. @throw SolverError, SolveAborted Cost: a search takes some tenths of a second, whatever
/// the number of triangles, and less in a small part; there are twice as many as parts.
SurfacePartsResult FindParts(
  const Points& P, const Triangles& F, const PartsOptions& options, const Callback& callback = {});
} // namespace SphericalStyle

#endif
