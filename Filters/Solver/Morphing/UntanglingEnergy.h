// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a tetrahedron costs that is not the shape it was: [untangle], and its derivatives.
#ifndef SphericalStyle_UntanglingEnergy_h
#define SphericalStyle_UntanglingEnergy_h

#include <Eigen/Core>

namespace SphericalStyle
{
/// chi(D) = (D + sqrt(D^2 + eps^2)) / 2 [untangle]: D where that is well above eps, above 0
/// everywhere, and without cancellation.
double RegularizedDeterminant(double D, double epsilon);

/// psi(J) = |J|^2 / chi(det J)^(2/3) + (det(J)^2 + 1) / chi(det J) [untangle]. Finite also where J
/// is inverted, and 5, its minimum, where J is a rotation, for epsilon to 0. No unit.
///
/// Source: V. Garanzha, I. Kaporin, L. Kudryavtseva, F. Protais, N. Ray, D. Sokolov, Foldover-free
/// maps in 50 lines of code, ACM Transactions on Graphics 40(4), 2021: f and g with lambda 1.
double UntanglingEnergy(const Eigen::Matrix3d& J, double epsilon);

/// d psi / dJ
Eigen::Matrix3d UntanglingGradient(const Eigen::Matrix3d& J, double epsilon);

/// The second derivative of psi as sum over k of Values[k] Q_k (x) Q_k, Q_k = Vectors[k], of
/// length 1 and orthogonal to each other.
struct UntanglingHessian
{
  double Values[9];
  Eigen::Matrix3d Vectors[9];
};

/// With J = U diag(s) V^T, psi is a function of s alone, so that Q_k is U E V^T: six E turn one
/// axis into another, which has eigenvalues in closed form, and three stretch the axes, a 3 x 3
/// problem (B. Smith, F. de Goes, T. Kim, Analytic Eigensystems for Isotropic Distortion Energies,
/// ACM Transactions on Graphics 38(1), 2019).
UntanglingHessian UntanglingSecondDerivative(const Eigen::Matrix3d& J, double epsilon);
} // namespace SphericalStyle

#endif
