// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Dense.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace Dense
{
Eigen::VectorXd Eigenvalues(const Eigen::MatrixXd& symmetric)
{
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly)
    .eigenvalues();
}

Eigen::MatrixXd Solve(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b)
{
  return A.colPivHouseholderQr().solve(b);
}
}
