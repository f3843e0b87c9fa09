// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The style in closed form a second time, straight from the formulas: dense matrices, maps from
/// cells to functions, rays that try every triangle, balls that try every sample. No shared code
/// with the solver but the names of its options. Slow, for a few hundred points and two thousand
/// functions.
#ifndef SphericalStyle_ClosedFormReference_h
#define SphericalStyle_ClosedFormReference_h

#include "SphericalStyleMethod.h"

#include <memory>

class ClosedFormReference
{
public:
  using Points = SphericalStyle::Points;

  explicit ClosedFormReference(const SphericalStyle::TriangleMesh& mesh);
  ~ClosedFormReference();

  /// Keeps factors, bases and balls of one mesh from solve to solve.
  void Solve(const SphericalStyle::MethodOptions& options);

  const Points& GetPositions() const;
  const Points& GetDirections() const;
  const SphericalStyle::Matrices& GetRotations() const;
  const std::vector<SphericalStyle::Sphere>& GetSpheres() const;
  double GetSizeFactor() const;
  int GetFunctions() const;
  int GetWalls() const;
  /// Largest share by which details gave way.
  double GetYield() const;
  /// How near the mesh comes to where a rule changes its mind: a quadrature point to the border of
  /// a sub-cell, a triangle to one more cut, in cells. Below about 1e-12, rounding decides.
  double GetMargin() const;

private:
  class State;
  std::unique_ptr<State> S;
};

#endif
