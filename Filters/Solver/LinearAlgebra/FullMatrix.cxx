// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "FullMatrix.h"

#include "Parallel.h"

namespace SphericalStyle
{
FullMatrix::FullMatrix(const Eigen::SparseMatrix<double, Eigen::ColMajor, int>& lowerTriangle)
  : A(lowerTriangle.selfadjointView<Eigen::Lower>())
{
}

void FullMatrix::Multiply(const Rows& X, Rows& Y, int threads) const
{
  const int* start = this->A.outerIndexPtr();
  const int* column = this->A.innerIndexPtr();
  const double* value = this->A.valuePtr();
  Y.resize(X.rows(), 3);
  ParallelFor(static_cast<int>(X.rows()), threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
        for (int k = start[i]; k < start[i + 1]; ++k)
        {
          sum += value[k] * X.row(column[k]);
        }
        Y.row(i) = sum;
      }
    });
}

FullMatrix::Rows FullMatrix::Residual(const Rows& B, const Rows& X, int threads) const
{
  Rows R;
  this->Multiply(X, R, threads);
  R = B - R;
  return R;
}
} // namespace SphericalStyle
