// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How the normals of a surface are spread over the sphere. [gaussmap]
#ifndef SphericalStyle_GaussMap_h
#define SphericalStyle_GaussMap_h

#include "SphereUnits.h"
#include "SurfacePart.h"

namespace SphericalStyle
{
/// What each of the N normals counts: its weight over the mean weight, so that the counts sum to N
/// and a threshold means the same with weights as without. Ones if there are no weights.
/// @param weights  areas for instance, length^2; N, or empty on all processes
Eigen::VectorXd RelativeWeights(
  Eigen::Index N, const Eigen::VectorXd& weights, const SurfacePart& part = {});

/// Count of each unit: the sum of the weights of the normals in it.
/// @param normals  N x 3, not 0, of any length @param weights  N, not negative
Eigen::VectorXd CountNormals(
  const SphereUnits& units, const Points& normals, const Eigen::VectorXd& weights);

/// Density of each unit: share of the count over share of the sphere, 1 everywhere for a uniform
/// spread; its integral over the sphere is 4 pi. 0 everywhere if nothing was counted.
Eigen::VectorXd Density(const SphereUnits& units, const Eigen::VectorXd& counts);

/// Units with a count above the threshold; 0: units hit at all.
int UnitsAbove(const Eigen::VectorXd& counts, double threshold);

/// How close counts on K > 1 units of equal area come to uniform. With p_k the shares of the count:
struct Spread
{
  double entropy = 0.0;           ///< H = - sum p_k ln p_k, nats, 0 .. ln K
  double relativeEntropy = 0.0;   ///< H / ln K, 0 (all in one unit) .. 1 (uniform)
  double divergence = 0.0;        ///< Kullback-Leibler, sum p_k ln(K p_k) = ln K - H, nats
  double distanceToUniform = 0.0; ///< total variation, sum |p_k - 1 / K| / 2, 0 .. 1 - 1 / K
};
/// All NaN if nothing was counted.
Spread MeasureSpread(const Eigen::VectorXd& counts);
} // namespace SphericalStyle

#endif
