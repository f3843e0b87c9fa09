// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The whole method for the nonlinear feature (thesis chapter 3, [nonlinear]): options in, deformed
/// points and a report out.
#ifndef SphericalStyle_NonlinearFeature_h
#define SphericalStyle_NonlinearFeature_h

#include "StyleSolver.h"

#include <memory>

namespace SphericalStyle
{
/// How the center o enters the global step.
enum class CenterConstraint
{
  /// o is the origin and nothing else is asked of the points: since the energy does not change when
  /// points and o move together, that is no constraint, and every step is an exact minimizer.
  Corrected,
  /// Eq. 3.26 - 3.42 to the letter: o is also the mean of the unknowns, the last point is
  /// eliminated by it and its equation dropped; one scale per cell by Eq. 3.12. The energy can
  /// rise.
  AsWritten
};

/// What the user wants. Positions are in model units. Arrays of 0 rows mean "none".
struct NonlinearOptions
{
  double lambda = 0.5;                           ///< roundness, >= 0
  CenterMode centerMode = CenterMode::PointMean; ///< AsWritten: always the mean
  Eigen::Vector3d center = { 0, 0, 0 };          ///< for CenterMode::Custom
  CenterConstraint centerConstraint = CenterConstraint::Corrected;
  /// AsWritten does not accelerate, and takes StopRule::Thesis for Converged: its energy can rise
  /// and has no known limit.
  LoopOptions loop;
  int threads = 1;

  Eigen::VectorXd roundnessFactors; ///< n, >= 0: lambda_j = lambda * factor
  Points normals;                   ///< n x 3, unit or zero; computed where absent
};

/// Chapter 3 to the letter: AsWritten, Eq. 3.46, the mean of the points, no acceleration.
NonlinearOptions ThesisOptions(NonlinearOptions options);

/// Built once per mesh and kept. The matrix 2 L_w + diag(lambda_j nu_j s_j^2) changes in every
/// iteration, but only on its diagonal: ordering and symbolic factor are made once per triangles.
///
/// Starts at the rest points with R = I and s_j = 1 / |p_j - o|: E_0 is Eq. 3.1 of the model.
///
/// Lambda weighs lengths against directions, so a unit of length belongs to it (the thesis unitizes
/// the scale, 3.4.2 and 3.6.2, and does not say how): r = sqrt(A / 4 pi), A the area of the model.
/// It makes s about 1, so that Eq. 3.24 and 3.25 are of one order, and lets lambda mean the same
/// for any size and orientation. In model units E has lambda r^2 in place of lambda.
///
/// The matrix is positive definite on every mesh: L_w is semidefinite with one constant vector per
/// connected component, and one s_j > 0 of a component is enough for that. A component that nothing
/// pulls (lambda nu s^2 below 1e-10 of its part of L_w) is held by its last point: a proximal step,
/// under which the energy does not rise either.
class NonlinearFeature
{
public:
  /// AsWritten refuses more: it factors without symmetry in every iteration (.7 s at 30,000
  /// points), and each neighbor of the last point has a row without a zero.
  static constexpr int MaximumPointsAsWritten = 50000;
  static constexpr int MaximumDenseEntriesAsWritten = 1000000;

  NonlinearFeature();
  ~NonlinearFeature();

  /// Takes the mesh; keeps everything that an equal mesh or equal triangles allow to keep.
  /// @throw std::invalid_argument: see SolverMesh
  void SetMesh(std::shared_ptr<const TriangleMesh> mesh);
  /// The same with a copy of it.
  void SetMesh(const TriangleMesh& mesh);

  /// Deforms the mesh. @throw std::invalid_argument for options out of range or of wrong size,
  /// without a mesh, and for too many points AsWritten @throw SolverError
  /// @return the report; its sphere has the center o and, as radius, the unit of length r
  StyleReport Solve(const NonlinearOptions& options, const Callback& callback = {});

  const Points& GetPositions() const;      ///< P', n x 3, model units
  const Matrices& GetRotations() const;    ///< R, n, rest to deformed
  Eigen::VectorXd GetScales() const;       ///< s, n, 1 / length
  Eigen::VectorXd GetCellEnergies() const; ///< n, length^2
  /// Whether the rest normals point toward o on the mean: faces turned inward, whose cells have to
  /// turn over.
  bool HasInwardNormals() const;
  /// Symbolic and numeric factorizations since the triangles were set.
  int GetNumberOfAnalyses() const;
  int GetNumberOfFactorizations() const;

private:
  class State;
  std::unique_ptr<State> S;
};
} // namespace SphericalStyle

#endif
