// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The local step [local] (Eq. 4.12 - 4.15): rotations closest to the covariances.
#ifndef SphericalStyle_LocalStep_h
#define SphericalStyle_LocalStep_h

#include "TriangleMesh.h"

namespace SphericalStyle
{
/// Rotation R that maximizes tr(R S), det +1, by Jacobi singular value decomposition: S = U Sigma
/// Q^T, R = Q diag(1, 1, det(Q U^T)) U^T. The identity for S = 0. The reference.
Eigen::Matrix3d ClosestRotationSVD(const Eigen::Matrix3d& S);

/// The same by the closed form: the largest root x of the quartic x^4 - 2 a x^2 - 8 d x + a^2 - 4 b
/// (a = |S|^2, b = |cof S|^2, d = det S) is tr(R S), and
/// R = ((x^2 + a) S^T + 2 x cof S^T - 2 S^T S S^T) / (x^3 - a x - 2 d).
/// Falls back to ClosestRotationSVD where two singular values nearly cancel or the result is not
/// orthonormal to 1e-10.
Eigen::Matrix3d ClosestRotation(const Eigen::Matrix3d& S);

/// How well determined the closest rotation is, 0 to 1: with the singular values s1 >= s2 >= s3 of
/// S, 1 where det S >= 0, else (s2 - s3) / (s2 + s3). At 0 it turns by 180 degrees. 1 as well where
/// s2 + s3 is at most 1e-12 s1: nothing but rounding.
/// @param R  ClosestRotation(S)
double RotationCertainty(const Eigen::Matrix3d& S, const Eigen::Matrix3d& R);

/// Replaces R by the closest rotations of S (n each). The closed form is worked out for eight cells
/// at a time; what it does not reach goes through ClosestRotation.
/// @return the change of the energy, -2 sum tr((R_new - R_old) S), length^2, <= 0
double FitRotations(const Matrices& S, Matrices& R, int threads);

/// The same for count matrices of nine numbers each, column-major, on this thread.
double FitRotations(const double* S, int count, Eigen::Matrix3d* R);
} // namespace SphericalStyle

#endif
