// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The inner points of a volume mesh, carried by its boundary so that no cell inverts.
#ifndef SphericalStyle_VolumeMorphing_h
#define SphericalStyle_VolumeMorphing_h

#include "Callback.h"
#include "VolumeMesh.h"

namespace SphericalStyle
{
struct MorphedVolume
{
  Points P;           ///< n x 3, length
  int iterations = 0; ///< Newton steps
};

/// Where the displacements of the inner points are harmonic [harmonic]: the minimum of the integral
/// of |grad u|^2 over the mesh at rest, by linear elements at the corners of the cells. By
/// conjugate gradients, to about 1e-5 of the displacements.
/// @param rest  as OrientCells left it; points of no cell stay in place
/// @param isFixed  n flags: points that are given
/// @param displacements  n x 3, length; those of other points do not count
/// @throw SolverError, std::invalid_argument if the points have no extent
Points HarmonicExtension(const VolumeMesh& rest, const std::vector<char>& isFixed,
  const Points& displacements, int threads);

/// Minimizes E = sum_c w_c psi(J_c) [untangle] over the inner points by Newton's method from
/// HarmonicExtension, each step solved by conjugate gradients (BlockSystem). Exact for rigid
/// motions of the boundary; nothing moves where nothing is displaced, bit for bit. The same bits
/// for any number of threads.
///
/// Whether no cell is inverted is for the caller to see: the best points found are returned.
/// @param callback  of each step @throw SolveAborted
MorphedVolume MorphVolume(const VolumeMesh& rest, const std::vector<char>& isFixed,
  const Points& displacements, int threads, const Callback& callback = {});

/// How much of the mesh at a point has turned [turn], for each point: the rotation closest to the
/// sum of w_c J_c over the corners with that point. Corners that are flat at rest do not count; the
/// identity where nothing does, and, bit for bit, where no corner has moved.
/// @param Q  n x 3, where the points are now
Matrices VolumeRotations(const VolumeMesh& rest, const Points& Q, int threads);

/// m flags: 1 for cells of which a corner is inverted and has no inner point: no motion of inner
/// points changes that.
std::vector<char> InvertedByBoundary(
  const VolumeMesh& mesh, const std::vector<char>& isFixed, const Points& P);
} // namespace SphericalStyle

#endif
