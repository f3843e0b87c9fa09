// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Details on a base that has moved: their rotations, and where they give way [carry]. Of any
/// points of a surface: what is needed of all of it is in the samples of its grid.
#ifndef SphericalStyle_CarriedDetails_h
#define SphericalStyle_CarriedDetails_h

#include "SurfaceGrid.h"

namespace SphericalStyle
{
/// Gradients and area vectors of a base at the samples of its grid.
struct BaseSlopes
{
  Fields gradients;   ///< samples x 9, as SurfaceGrid::Gradients
  Points areaVectors; ///< samples x 3, as SurfaceGrid::AreaVectorsUnder
};

/// c, what is kept of details where their rotation is hardly determined.
/// @param R  the rotation closest to S
double CertainShare(const Eigen::Matrix3d& S, const Eigen::Matrix3d& R);

/// S_k, before it is smoothed: samples x 9, column by column.
/// @param before, after  of the base at rest, and of B'
Fields DetailCovariances(
  const SurfaceGrid& grid, const BaseSlopes& before, const BaseSlopes& after, int threads);

/// y_k and its square, samples x 2, in creases where details would fold.
/// @param S  smoothed covariances at the samples @param ofBase, carried  area vectors of B' and of
/// P' before anything gives way
Fields DetailYields(const SurfaceGrid& grid, const Fields& S, const Points& ofBase,
  const Points& carried, int threads);

/// P' = B' + c R (P - B), before anything gives way.
/// @param smooth  coefficients of the covariances @param P, B, moved  n x 3, of any points of the
/// surface: at rest, of the base, B'
/// @param rotations  R, n, unless it is nullptr
void CarryDetails(const SurfaceGrid& grid, const Fields& smooth, const Points& P, const Points& B,
  const Points& moved, int threads, Points& positions, Matrices* rotations);

/// Brings P' back toward B' where details give way.
/// @param smooth  coefficients of the yields @param P, moved  see above
void GiveWay(const SurfaceGrid& grid, const Fields& smooth, const Points& P, const Points& moved,
  int threads, Points& positions);
} // namespace SphericalStyle

#endif
