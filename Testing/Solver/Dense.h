// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What tests compute from dense matrices of any size. Compiled once: each of Eigen's
/// decompositions takes the compiler several seconds.
#ifndef SphericalStyle_Dense_h
#define SphericalStyle_Dense_h

#include <Eigen/Core>

namespace Dense
{
/// Ascending.
Eigen::VectorXd Eigenvalues(const Eigen::MatrixXd& symmetric);

/// x of least |A x - b|, which is 0 where A is square and regular.
Eigen::MatrixXd Solve(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b);
}

#endif
