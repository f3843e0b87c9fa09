// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// From the deformed proxy back to the model [proxy], steps 5 and 6 (thesis 5.4).
#ifndef SphericalStyle_ProxyTransfer_h
#define SphericalStyle_ProxyTransfer_h

#include "SurfaceProjection.h"

namespace SphericalStyle
{
enum class Transfer
{
  Blend, ///< p' = (1 - t) q' + t p (Eq. 5.18): what lies off the proxy is flattened by 1 - t
  Offset ///< p' = (1 - t) (q' + R (p - q)) + t p, R the rotation of the proxy at q: nothing is
};

/// The proxy before and after.
struct DeformedProxy
{
  TriangleMesh rest;
  Points rounded;     ///< one row per point of rest
  Matrices rotations; ///< one per point: SurfaceRotations
};

/// R of every foot: the closest rotation of the mean of those at the corners, by b.
Matrices RotationsAtFeet(const DeformedProxy& proxy, const Feet& feet, int threads);

struct TransferOptions
{
  Transfer transfer = Transfer::Blend;
  /// Emphasis (thesis Fig. 5.5): the rounded proxy is stretched by these factors along x, y, z from
  /// the center before anything is blended.
  Eigen::Vector3d gain = Eigen::Vector3d::Ones();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
};

/// @param P  n x 3 points of the model @param t  n x 3, per axis, 0..1; 1 keeps the coordinate's
/// bits
/// @param rotations  of the feet (RotationsAtFeet); for Offset only @return n x 3
Points TransferFromProxy(const Points& P, const DeformedProxy& proxy, const Feet& feet,
  const Matrices& rotations, const Points& t, const TransferOptions& options);
} // namespace SphericalStyle

#endif
