// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The linear system of the global step, solved again and again from the last solution.
#ifndef SphericalStyle_LinearSystem_h
#define SphericalStyle_LinearSystem_h

#include "ConjugateGradients.h"
#include "SparseCholesky.h"

#include <string>

namespace SphericalStyle
{
enum class LinearMethod
{
  /// SingleFactor from 20 000 rows on, Factor below; ConjugateGradients where the factor would take
  /// more than half of the machine's memory
  Automatic,
  /// Exact up to rounding: the reference
  Factor,
  /// The factor in single precision, applied to the residual in double precision: half of the time
  /// and memory of a solve. Factor where the matrix is so badly conditioned that less than three
  /// digits of the correction would be right
  SingleFactor,
  /// No factor: least memory, as many steps as are worth it
  ConjugateGradients
};

/// A X = B, A symmetric positive definite (indefinite only with full-edge weights: then Factor is
/// what is used whatever was asked for).
class LinearSystem
{
public:
  using Matrix = SparseCholesky::Matrix;
  using RightHandSides = SparseCholesky::RightHandSides;

  explicit LinearSystem(LinearMethod method = LinearMethod::Automatic);

  /// Of what is left of the gain of a solve by conjugate gradients; see there. Default 0.01,
  /// which is for loops.
  void SetShareLeft(double share) { this->ShareLeft = share; }
  /// Bytes that a factor may take with Automatic. Default: half of the machine's memory.
  void SetLargestFactor(double bytes) { this->LargestFactor = bytes; }

  /// Ordering and symbolic factorization of A's pattern.
  /// @throw SolverError if it must be factored and is too large for that
  /// @throw std::bad_alloc  what solves does not depend on the memory that happens to be free
  void Analyze(const Matrix& A);
  /// What solves need of the numbers of A. @throw SolverError if A is singular
  void Factor(const Matrix& A, int threads = 1);
  /// @param X  in: where to start, which Factor does not need; out: the solution
  /// @throw SolverError if it is not finite
  void Solve(const RightHandSides& B, RightHandSides& X, int threads = 1);

  /// Whether the matrix of Factor is positive definite, as far as that has been found.
  bool IsDefinite() const;
  /// What solves, for people.
  std::string GetName() const;
  /// Steps of conjugate gradients since Factor.
  int GetNumberOfSteps() const { return this->NumberOfSteps; }
  /// Solves by them since Factor that ended at their limit: the solution is not there yet.
  int GetNumberOfUnfinishedSolves() const { return this->NumberOfUnfinishedSolves; }

private:
  /// What Automatic means for A. Analyzes it if that is a factor.
  LinearMethod Choose(const Matrix& A);

  LinearMethod Method;
  LinearMethod Chosen = LinearMethod::Factor; // of this pattern; never Automatic
  LinearMethod Used = LinearMethod::Factor;   // of these numbers
  double ShareLeft = 0.01;
  double LargestFactor;
  SparseCholesky Cholesky;
  FullMatrix Full; // where residuals are needed
  ConjugateGradients Gradients;
  int NumberOfSteps = 0;
  int NumberOfUnfinishedSolves = 0;
};
} // namespace SphericalStyle

#endif
