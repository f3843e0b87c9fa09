// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The condition number of the matrix of the global step.
#ifndef SphericalStyle_MatrixCondition_h
#define SphericalStyle_MatrixCondition_h

#include "MeshTopology.h"

namespace SphericalStyle
{
/// Condition numbers, largest over smallest eigenvalue (Eq. 4.40).
struct MatrixCondition
{
  /// Of the matrix, without its zero eigenvalues, one per component.
  double nonZero = 1.0;
  /// Of the matrix without the row and column of the last point of each component, which is what
  /// the thesis solves.
  double pinned = 1.0;
  /// Bound on the relative error of both, rounding left aside; above the tolerance where the
  /// iteration did not settle.
  double accuracy = 0.0;
};

/// By Lanczos iteration, with the factored matrix for the smallest eigenvalues.
/// @param k  weight of each half-edge (m x 3), a sum over triangles that is positive semidefinite
///        with no more zeros than components: c_h + lambda / 2 for [global] and Eq. 4.26 @param
///        tolerance  relative, of each eigenvalue
/// @throw SolverError if the pinned matrix cannot be factored
/// Cost: two factorizations and some hundred solves and products, O(n) memory beside the factor.
///
/// Why not Spectra (1.0, measured): both find the same nine digits; without the factorization
/// 98,000 points take .2 s here and .5 s there. It would save some 40 lines, tell no bound on the
/// error, and be one more package that a build needs.
MatrixCondition EstimateCondition(
  const MeshTopology& topology, const HalfEdgeScalars& k, double tolerance = 1e-6);
} // namespace SphericalStyle

#endif
