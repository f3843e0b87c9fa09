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

/// The second derivative of psi, made positive semidefinite. With J = U diag(s) V^T, psi is a
/// function of s alone, so that in these axes it has few numbers: three stretch the axes, and six
/// turn one into another, which have eigenvalues in closed form (B. Smith, F. de Goes, T. Kim,
/// Analytic Eigensystems for Isotropic Distortion Energies, ACM Transactions on Graphics 38(1),
/// 2019).
struct UntanglingHessian
{
  Eigen::Matrix3d U; ///< a rotation
  Eigen::Matrix3d V; ///< a rotation
  Eigen::Matrix3d Stretch;
  Eigen::Matrix3d Turn;  ///< of E_ij and itself, i != j
  Eigen::Matrix3d Cross; ///< of E_ij and E_ji

  /// The 3 x 3 matrix of J += x g^T and J += y h^T: psi changes by x^T B y. Without U and V.
  /// @param g, h  in the axes: V^T g, V^T h
  Eigen::Matrix3d InAxes(const Eigen::Vector3d& g, const Eigen::Vector3d& h) const
  {
    Eigen::Matrix3d B =
      this->Stretch.cwiseProduct(g * h.transpose()) + this->Cross.cwiseProduct(h * g.transpose());
    B.diagonal() += this->Turn * g.cwiseProduct(h);
    return B;
  }
};

/// @param smallest  eigenvalue, in units of the largest
UntanglingHessian UntanglingSecondDerivative(
  const Eigen::Matrix3d& J, double epsilon, double smallest);
} // namespace SphericalStyle

#endif
