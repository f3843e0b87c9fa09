// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The one place where sparse linear systems are solved: factor once, solve often.
#ifndef SphericalStyle_SparseCholesky_h
#define SphericalStyle_SparseCholesky_h

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <memory>

namespace SphericalStyle
{
/// Symmetric positive definite system A X = B for few right-hand sides.
///
/// CHOLMOD's supernodal Cholesky where the build has SuiteSparse, with PackedFactor; Eigen's
/// SimplicialLDLT otherwise.
/// In single precision the factor is worked out in double precision and kept in single.
/// A matrix that is not positive definite (possible only with full-edge weights) is factored by
/// LDLT, which needs no sign.
class SparseCholesky
{
public:
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>; ///< lower triangle, compressed
  using RightHandSides = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

  enum class Backend
  {
    Best, ///< Cholmod where it was built in
    Cholmod,
    Eigen
  };

  enum class Precision
  {
    Double,
    Single ///< solutions right to three digits or more: for corrections
  };

  /// @throw std::invalid_argument when the backend was not built in
  explicit SparseCholesky(Backend backend = Backend::Best);
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  static bool HasCholmod();
  /// What solves: "CHOLMOD supernodal LLT" or "Eigen LDLT", with "in single precision".
  const char* GetName() const;

  /// Ordering and symbolic factorisation of A's pattern. @throw SolverError
  void Analyze(const Matrix& A);
  /// Bytes that a factor of the pattern of Analyze takes in double precision; 0 where it is not
  /// known before it is factored (Eigen).
  double GetFactorBytes() const;
  /// Numeric factorisation; the pattern must be that of Analyze. Keeps double precision where
  /// GetError would be above 1e-3 with single precision. @throw SolverError if A is singular
  void Factor(const Matrix& A, Precision precision = Precision::Double, int threads = 1);
  /// What Factor has kept.
  Precision GetPrecision() const;
  /// With single precision: error of the solution for a right-hand side without any order, in the
  /// norm of A, relative; 0 with double precision.
  double GetError() const;
  /// Replaces B (n x 3) by A^-1 B. @throw SolverError if the result is not finite
  void Solve(RightHandSides& B, int threads = 1) const;

private:
  class Implementation;
  class EigenImplementation;
  class CholmodImplementation;
  std::unique_ptr<Implementation> Impl;
};
} // namespace SphericalStyle

#endif
