// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The style in closed form at few points of a large model, in a time that does not depend on its
/// size [preview].
#ifndef SphericalStyle_ClosedFormPreview_h
#define SphericalStyle_ClosedFormPreview_h

#include "CarriedDetails.h"
#include "ClosedFormStyle.h"

#include <array>

namespace SphericalStyle
{
/// What a whole model has at rest.
struct ModelAtRest
{
  const Points& P;                  ///< n x 3
  const Triangles& F;               ///< m x 3
  const Points& B;                  ///< n x 3, its base; P without details
  const SurfaceGrid& grid;          ///< of the base; no functions without details
  const Points* normals;            ///< n x 3, or nullptr where NormalBlend is 0
  const Eigen::VectorXd* thickness; ///< n, or nullptr where the radius of the whole model counts
};

/// The result at some points. What points have at rest is theirs bit for bit. What the whole
/// surface says of the change comes from the samples of its grid, where all that varies smoothly is
/// expanded about the mean of a sample, and from probes, triangles that each stand for the same
/// area:
///
///     G'_k = (1 - m) G_k + m ((1 - a) r H_k + a G(rho n)_k),      m = mu / (1 + mu)
///     G(P')_k = G'_k + Q_k G(D)_k + sum over axes x of dQ_k / dx (G(D x)_k - x_k G(D)_k)
///
/// with B, D = P - B, rho n, and their products with coordinates averaged over all triangles in the
/// sample once; H_k the gradient of d to second order about the mean of B; Q = c R, its slope from
/// four places around x_k. Mean, area and volume are those of the probes, against the same at rest;
/// extent and ground those of the points.
///
/// Cost: two covariances smoothed twice, as for all points, then some hundred operations a sample,
/// point and probe. Made with a few passes over all points and triangles.
///
/// Of a surface that is spread over processes each takes its own points and probes; what comes from
/// the samples is the same on all of them. The constructor and Solve are to be called by all.
class ClosedFormPreview
{
public:
  ClosedFormPreview() = default;
  ClosedFormPreview(const ModelAtRest& model, const PreviewPlaces& places, int threads);

  /// @param o  without arrays and regions, with one center @param slopes  of the base at rest
  /// @param part  of the model that this process has @param scale  by which the result was scaled
  ClosedFormResult Solve(const ClosedFormOptions& o, const Sphere& sphere, const SurfaceGrid& grid,
    const BaseSlopes& slopes, const SurfacePart& part, double& scale) const;

private:
  /// What is averaged over a sample.
  struct SampleMeans
  {
    Points base;                         // B
    std::array<Fields, 2> squares;       // gradients of b b^T, b from its mean: xx xy xz, yy yz zz
    Fields limbs;                        // gradients of rho n
    Fields details;                      // gradients of D
    std::array<Fields, 3> detailMoments; // of D (x - x_k), for each axis x
  };

  void TakeMeans(const ModelAtRest& model, int threads);
  BaseSlopes SlopesOf(const ClosedFormOptions& o, const Sphere& sphere, const SurfaceGrid& grid,
    const BaseSlopes& slopes) const;
  Points CarriedAreas(const ClosedFormOptions& o, const SurfaceGrid& grid, const Fields& smooth,
    const BaseSlopes& after) const;
  double Place(const ClosedFormOptions& o, const SurfacePart& part, Points& Q) const;

  int NumberOfPoints = 0;
  // Of the points, then of the three corners of each probe.
  Points P;
  Points B;
  Points Limbs; // rho n or n; no rows where normals have no say
  Eigen::VectorXd ProbeAreas;
  double AreaOfProbe = 0.0; // that each stands for
  SampleMeans Samples;
};
} // namespace SphericalStyle

#endif
