// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Products of a symmetric sparse matrix with three vectors at once.
#ifndef SphericalStyle_FullMatrix_h
#define SphericalStyle_FullMatrix_h

#include <Eigen/SparseCore>

namespace SphericalStyle
{
/// A symmetric matrix with both of its triangles, so that rows are independent of each other.
class FullMatrix
{
public:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

  FullMatrix() = default;
  explicit FullMatrix(const Eigen::SparseMatrix<double, Eigen::ColMajor, int>& lowerTriangle);

  /// Y := A X.
  void Multiply(const Rows& X, Rows& Y, int threads = 1) const;
  /// B - A X.
  Rows Residual(const Rows& B, const Rows& X, int threads = 1) const;

private:
  Eigen::SparseMatrix<double, Eigen::RowMajor, int> A;
};
} // namespace SphericalStyle

#endif
