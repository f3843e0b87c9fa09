// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Solving without a factor: conjugate gradients from a guess, as far as is worth it.
#ifndef SphericalStyle_ConjugateGradients_h
#define SphericalStyle_ConjugateGradients_h

#include "FullMatrix.h"

namespace SphericalStyle
{
/// A X = B for three right-hand sides at once, A symmetric positive definite, preconditioned by
/// Eigen's incomplete Cholesky factor, which takes as much memory as A.
///
/// Every step lowers 1/2 tr X^T A X - tr X^T B. Once the last steps together lowered it by less
/// than a share of what the solve has lowered it by, the rest is left: the next solve of the loop
/// starts from there.
///
/// Why not the algebraic multigrid of hypre (2.26, measured): it is better. Slivers of 98,000
/// points reach a residual of 1e-6 in 17 steps and .8 s there, and stay above 1e-3 after 1000 steps
/// and 4.6 s here, which the caller reports. But Debian's library needs MPI to be initialized,
/// which a filter must not do for its program. Nothing in closed form is solved this way: it is for
/// energies whose factor would take more than half of the machine's memory.
class ConjugateGradients
{
public:
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>; ///< lower triangle
  using Rows = FullMatrix::Rows;

  /// Makes the incomplete factor. @return whether there is one; an indefinite matrix has none
  bool SetMatrix(const Matrix& A);

  /// Steps of one solve, at most.
  static constexpr int LargestNumberOfSteps = 1000;

  /// Improves X. @param A  the matrix of SetMatrix @param share  of what was gained that may be
  /// left @return the number of steps; LargestNumberOfSteps where more of it is left than that
  int Solve(const FullMatrix& A, const Rows& B, Rows& X, double share, int threads = 1) const;

private:
  void Precondition(const Rows& R, Rows& Z, int threads) const;

  Eigen::SparseMatrix<double, Eigen::ColMajor, int> L; // of the scaled, permuted matrix
  Eigen::VectorXd Scale;
  Eigen::VectorXi Order; // row of L of each row of A
  mutable Rows Work;
};
} // namespace SphericalStyle

#endif
