// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "LocalStep.h"

#include "Parallel.h"
#include "Vector4.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace SphericalStyle
{
namespace
{
// Of the closed form; the singular value decomposition takes over beyond.
constexpr double SmallestDenominator = 1e-3;
constexpr double LeastStretch = 1e-12;  // of the largest singular value
constexpr double LargestDefect = 1e-10; // of R^T R from the identity
}

Eigen::Matrix3d ClosestRotationSVD(const Eigen::Matrix3d& S)
{
  const double size = S.cwiseAbs().maxCoeff();
  if (!(size > 0.0))
  {
    return Eigen::Matrix3d::Identity();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(S / size, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  if ((svd.matrixV() * U.transpose()).determinant() < 0.0)
  {
    U.col(2) = -U.col(2); // Eq. 4.15: the last column belongs to the smallest singular value
  }
  return svd.matrixV() * U.transpose();
}

Eigen::Matrix3d ClosestRotation(const Eigen::Matrix3d& S)
{
  const double size = S.norm();
  if (!(size > 0.0) || !std::isfinite(size))
  {
    return Eigen::Matrix3d::Identity();
  }
  const Eigen::Matrix3d M = S.transpose() / size; // a = |M|^2 = 1
  Eigen::Matrix3d cofactor;
  cofactor.col(0) = M.col(1).cross(M.col(2));
  cofactor.col(1) = M.col(2).cross(M.col(0));
  cofactor.col(2) = M.col(0).cross(M.col(1));
  const double d = M.col(0).dot(cofactor.col(0));
  const double b = cofactor.squaredNorm();

  // Newton from above the largest root (x <= sqrt(3 a)): monotone, since the quartic is convex
  // there.
  double x = std::sqrt(3.0);
  double slope = 0.0;
  for (int step = 0; step < 20; ++step)
  {
    const double y = x * x - 1.0;
    slope = 4.0 * (x * y - 2.0 * d);
    const double dx = (y * y - 8.0 * d * x - 4.0 * b) / slope;
    x -= dx;
    if (!(std::abs(dx) > 1e-15 * x))
    {
      break;
    }
  }
  // x^3 - a x - 2 d = 2 (s1 + s2)(s2 + s3)(s3 + s1): small where the rotation is ill defined.
  const double denominator = x * (x * x - 1.0) - 2.0 * d;
  if (denominator > SmallestDenominator)
  {
    Eigen::Matrix3d R =
      ((x * x + 1.0) * M + 2.0 * x * cofactor - 2.0 * M * (M.transpose() * M)) / denominator;
    const Eigen::Matrix3d gram = R.transpose() * R;
    if ((gram - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < LargestDefect)
    {
      return R * (1.5 * Eigen::Matrix3d::Identity() - 0.5 * gram); // one Newton-Schulz step: 1e-20
    }
  }
  return ClosestRotationSVD(S);
}

double RotationCertainty(const Eigen::Matrix3d& S, const Eigen::Matrix3d& R)
{
  if (!(S.determinant() < 0.0))
  {
    return 1.0;
  }
  // R S is symmetric, with the eigenvalues s1, s2 and -s3.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> stretch(R * S, Eigen::EigenvaluesOnly);
  const double s3 = -stretch.eigenvalues()(0);
  const double s2 = stretch.eigenvalues()(1);
  if (!(s2 + s3 > LeastStretch * stretch.eigenvalues()(2))) // rounding: no sign means anything
  {
    return 1.0;
  }
  return s3 < s2 ? std::min(1.0, (s2 - s3) / (s2 + s3)) : 0.0;
}

namespace
{
constexpr int Lanes = 8;
constexpr int NewtonSteps = 7; // cells that need more are left to ClosestRotation

/// A 3 x 3 matrix for each lane, column-major.
struct Matrix8
{
  Vector8 m[9];
  Vector8& operator()(int row, int column) { return this->m[3 * column + row]; }
  const Vector8& operator()(int row, int column) const { return this->m[3 * column + row]; }
};

/// A^T B
SPHERICALSTYLE_INLINE Matrix8 TransposedTimes(const Matrix8& A, const Matrix8& B)
{
  Matrix8 C;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      C(i, j) = A(0, i) * B(0, j) + A(1, i) * B(1, j) + A(2, i) * B(2, j);
    }
  }
  return C;
}

SPHERICALSTYLE_INLINE Matrix8 Times(const Matrix8& A, const Matrix8& B)
{
  Matrix8 C;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      C(i, j) = A(i, 0) * B(0, j) + A(i, 1) * B(1, j) + A(i, 2) * B(2, j);
    }
  }
  return C;
}

SPHERICALSTYLE_INLINE Matrix8 Cofactor(const Matrix8& A)
{
  Matrix8 C;
  for (int i = 0; i < 3; ++i)
  {
    const int i1 = (i + 1) % 3;
    const int i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j)
    {
      const int j1 = (j + 1) % 3;
      const int j2 = (j + 2) % 3;
      C(i, j) = A(i1, j1) * A(i2, j2) - A(i1, j2) * A(i2, j1);
    }
  }
  return C;
}

SPHERICALSTYLE_INLINE Vector8 SquaredNorm(const Matrix8& A)
{
  Vector8 sum = {};
  for (const Vector8& x : A.m)
  {
    sum += x * x;
  }
  return sum;
}

/// ClosestRotation for eight covariances of nine numbers each.
/// @param R  takes the rotations @param good  whether R is right; else it means nothing
SPHERICALSTYLE_PER_INSTRUCTION_SET
void ClosestRotations(const double* S, double* R, bool* good)
{
  Matrix8 M; // the transpose of S, of size 1
  for (int l = 0; l < Lanes; ++l)
  {
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        M(i, j)[l] = S[9 * l + 3 * i + j];
      }
    }
  }
  Vector8 size = SquaredNorm(M);
  for (int l = 0; l < Lanes; ++l)
  {
    size[l] = std::sqrt(size[l]);
  }
  for (Vector8& x : M.m)
  {
    x /= size; // not a number where there is nothing: no lane is good then
  }
  const Matrix8 cofactor = Cofactor(M);
  const Vector8 d = M(0, 0) * cofactor(0, 0) + M(1, 0) * cofactor(1, 0) + M(2, 0) * cofactor(2, 0);
  const Vector8 b = SquaredNorm(cofactor);
  Vector8 x = Vector8{} + std::sqrt(3.0);
  for (int step = 0; step < NewtonSteps; ++step)
  {
    const Vector8 y = x * x - 1.0;
    x -= (y * y - 8.0 * d * x - 4.0 * b) / (4.0 * (x * y - 2.0 * d));
  }
  const Vector8 denominator = x * (x * x - 1.0) - 2.0 * d;
  const Matrix8 stretched = Times(M, TransposedTimes(M, M));
  Matrix8 Q;
  for (int k = 0; k < 9; ++k)
  {
    Q.m[k] =
      ((x * x + 1.0) * M.m[k] + 2.0 * x * cofactor.m[k] - 2.0 * stretched.m[k]) / denominator;
  }
  Matrix8 gram = TransposedTimes(Q, Q);
  Vector8 defect = {};
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      defect += Magnitude(gram(i, j) - (i == j ? 1.0 : 0.0));
      gram(i, j) = (i == j ? 1.5 : 0.0) - 0.5 * gram(i, j);
    }
  }
  Q = Times(Q, gram); // one Newton-Schulz step
  for (int l = 0; l < Lanes; ++l)
  {
    good[l] = denominator[l] > SmallestDenominator && defect[l] < LargestDefect;
    for (int k = 0; k < 9; ++k)
    {
      R[9 * l + k] = Q.m[k][l];
    }
  }
}
}

double FitRotations(const double* S, int count, Eigen::Matrix3d* R)
{
  using Covariance = Eigen::Map<const Eigen::Matrix3d>;
  double change = 0.0;
  for (int first = 0; first < count; first += Lanes)
  {
    const int lanes = std::min(Lanes, count - first);
    const double* block = S + 9 * static_cast<std::ptrdiff_t>(first);
    double padded[9 * Lanes] = {};
    if (lanes < Lanes)
    {
      std::copy(block, block + 9 * lanes, padded);
      block = padded;
    }
    double fitted[9 * Lanes];
    bool good[Lanes];
    ClosestRotations(block, fitted, good);
    for (int l = 0; l < lanes; ++l)
    {
      const Covariance covariance(block + 9 * l);
      const Eigen::Matrix3d rotation =
        good[l] ? Eigen::Matrix3d(Covariance(fitted + 9 * l)) : ClosestRotation(covariance);
      change -= 2.0 * (rotation - R[first + l]).cwiseProduct(covariance.transpose()).sum();
      R[first + l] = rotation;
    }
  }
  return change;
}

double FitRotations(const Matrices& S, Matrices& R, int threads)
{
  return ParallelSum(static_cast<int>(S.size()), threads,
    [&](int begin, int end) { return FitRotations(S[begin].data(), end - begin, &R[begin]); });
}
} // namespace SphericalStyle
