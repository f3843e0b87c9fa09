// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A further term of the energy that depends on the rotations alone. It changes the local step
/// only: matrix, factor and global step stay as they are. A style of this kind is a new LocalTerm.
#ifndef SphericalStyle_LocalTerm_h
#define SphericalStyle_LocalTerm_h

#include "TriangleMesh.h"

namespace SphericalStyle
{
class LocalTerm
{
public:
  virtual ~LocalTerm() = default;

  /// Called by the solver at the start of each solve; forgets what earlier solves have left.
  /// @param P  rest points in the solver's frame (diagonal 1), so that a term of length^2 that is
  ///        made of areas needs no scale of its own
  virtual void SetMesh(const Points& P, const Triangles& F) = 0;

  /// [local] with this term: R_y := argmin -2 tr(R_y S_y) + term_y(R_y). Where the minimum is not
  /// known in closed form, an R_y whose value is neither above that of the R_y given nor of the one
  /// given in the call before: a step that the loop takes back must do no harm.
  /// @param S  n covariances; may be overwritten @return the change of the energy, <= 0
  virtual double Fit(Matrices& S, Matrices& R, int threads) = 0;

  /// sum_y term_y(R_y), length^2.
  virtual double Evaluate(const Matrices& R) const = 0;
};
} // namespace SphericalStyle

#endif
