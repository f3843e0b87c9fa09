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
/// In single precision the factor is worked out in double precision and kept in single.
/// A matrix that is not positive definite (possible only with full-edge weights) is factored by
/// Eigen's LDLT, which needs no sign.
class SparseCholesky
{
public:
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>; ///< lower triangle, compressed
  using RightHandSides = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

  enum class Backend
  {
    Multifrontal, ///< MultifrontalCholesky and PackedFactor
    Eigen         ///< SimplicialLDLT: slower, the reference in tests
  };

  enum class Precision
  {
    Double,
    Single ///< solutions right to three digits or more: for corrections
  };

  explicit SparseCholesky(Backend backend = Backend::Multifrontal);
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  /// What solves: "multifrontal LLT" or "Eigen LDLT", with "in single precision".
  const char* GetName() const;

  /// Ordering and symbolic factorization of A's pattern. @throw SolverError if it is too large to
  /// be counted
  void Analyze(const Matrix& A);
  /// Bytes that a factor of the pattern of Analyze takes in double precision; 0 with
  /// Eigen, where it is not known before it is factored.
  double GetFactorBytes() const;
  /// Numeric factorization; the pattern must be that of Analyze. Keeps double precision where
  /// GetError would be above 1e-3 with single precision. @throw SolverError if A is singular
  void Factor(const Matrix& A, Precision precision = Precision::Double, int threads = 1);
  /// What Factor has kept.
  Precision GetPrecision() const;
  /// With single precision: error of the solution for a right-hand side without any order, in the
  /// norm of A, relative; 0 with double precision.
  double GetError() const;
  /// Whether the matrix of Factor is positive definite.
  bool IsDefinite() const;
  /// Replaces B (n x 3) by A^-1 B. @throw SolverError if the result is not finite
  void Solve(RightHandSides& B, int threads = 1) const;

private:
  class Implementation;
  class EigenImplementation;
  class MultifrontalImplementation;
  std::unique_ptr<Implementation> Impl;
};
} // namespace SphericalStyle

#endif
