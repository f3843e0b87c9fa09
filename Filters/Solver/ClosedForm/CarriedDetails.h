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

/// Points of a surface, n x 3 each.
struct DetailPoints
{
  const Points& P; ///< in the grid
  const Points& X; ///< in the pose that is rounded; P without one
  const Points& B; ///< base of that
};

/// Area vectors at the samples, samples x 3 each.
struct DetailAreas
{
  const Points& atRest;  ///< of X
  const Points& ofBase;  ///< of B'
  const Points& carried; ///< of P' before anything gives way
};

/// c, what is kept of details where their rotation is hardly determined.
/// @param R  the rotation closest to S
double CertainShare(const Eigen::Matrix3d& S, const Eigen::Matrix3d& R);

/// S_k, before it is smoothed: samples x 9, column by column.
/// @param before, after  of the base at rest, and of B'
Fields DetailCovariances(
  const SurfaceGrid& grid, const BaseSlopes& before, const BaseSlopes& after, int threads);

/// y_k and its square, samples x 2, in creases where details would fold.
/// @param S  smoothed covariances at the samples
Fields DetailYields(const Fields& S, const DetailAreas& areas, int threads);

/// P' = B' + c R (X - B), before anything gives way.
/// @param smooth  coefficients of the covariances @param moved  B', n x 3
/// @param rotations  R, n, unless it is nullptr
void CarryDetails(const SurfaceGrid& grid, const Fields& smooth, const DetailPoints& points,
  const Points& moved, int threads, Points& positions, Matrices* rotations);

/// Brings P' back toward B' where details give way.
/// @param smooth  coefficients of the yields @param P, moved  n x 3, in the grid and B'
void GiveWay(const SurfaceGrid& grid, const Fields& smooth, const Points& P, const Points& moved,
  int threads, Points& positions);
} // namespace SphericalStyle

#endif
