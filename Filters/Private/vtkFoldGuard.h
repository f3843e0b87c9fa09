// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The solver under the guard against folds, with CGAL's search for self-intersections. Private.
#ifndef vtkFoldGuard_h
#define vtkFoldGuard_h

#include "FoldGuard.h"
#include "SphericalStyleMethod.h"

#include <functional>
#include <memory>
#include <string>

class vtkTable;

namespace vtkFoldGuard
{
struct Result
{
  SphericalStyle::StyleReport Style; ///< of the last solve
  SphericalStyle::FoldGuardReport Guard;
  SphericalStyle::Points Positions; ///< those of the guard; where somebody asked to end, unguarded
  Eigen::VectorXd Roundness;        ///< n, lambda that remained
  double Seconds = 0.0;

  /// Whether there was a guard, and nobody asked it to end.
  bool HasCounted() const { return this->Guard.solves > 0 && !this->Guard.aborted; }
};

/// How solved points become those of the output.
using Finish = std::function<SphericalStyle::Points(const SphericalStyle::Points&)>;

/// @param callback  iterations are counted on over all solves
/// @throw std::invalid_argument in a library without CGAL
Result Solve(SphericalStyle::SphericalStyleMethod& solver,
  const SphericalStyle::MethodOptions& wanted,
  const std::shared_ptr<const SphericalStyle::TriangleMesh>& rest, bool singlePrecision,
  const Finish& finish, const SphericalStyle::Callback& callback);

/// The warning where less roundness alone was not enough, or hardly any is left; else empty.
std::string Remark(const Result& result);

/// What it did, in words; empty where it has not counted.
std::string Summary(const Result& result);

/// What it did, as field data; nothing where it has not counted.
void Fill(vtkTable* table, const Result& result);
}

#endif
