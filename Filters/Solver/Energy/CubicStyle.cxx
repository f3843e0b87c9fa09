// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "CubicStyle.h"

#include "LocalStep.h"
#include "Parallel.h"
#include "SurfaceMeasures.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace SphericalStyle
{
namespace
{
// The article's parameters, but: the first penalty is the cell's area where there it is 1e-4, so
// that nothing depends on how fine the mesh is; and the tolerances are 1e-5 and 1e-3 there. A loose
// local step costs more iterations than it saves.
constexpr int MostSplittingSteps = 100;
constexpr double AbsoluteTolerance = 1e-8;
constexpr double RelativeTolerance = 1e-7;
constexpr double Imbalance = 10.0; // mu
constexpr double Growth = 2.0;     // tau

/// argmin_z k |z|_1 + |z - x|^2 / 2, entry by entry.
Eigen::Vector3d Shrink(const Eigen::Vector3d& x, double k)
{
  return x.array().sign() * (x.array().abs() - k).max(0.0);
}
}

CubicStyle::CubicStyle(double lambda)
  : Lambda(lambda)
{
  if (!std::isfinite(lambda) || lambda < 0.0)
  {
    throw std::invalid_argument("the cubeness must be finite and not negative");
  }
}

void CubicStyle::SetMesh(const Points& P, const Triangles& F)
{
  this->Normals = PointNormals(P, F);
  this->Areas = PointAreas(P, F);
  this->Before.clear();
  this->Splits.resize(P.rows());
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    this->Splits[i] = { this->Normals.row(i).transpose(), Eigen::Vector3d::Zero(), this->Areas[i] };
  }
}

/// -2 tr(R S) + lambda a |R n|_1
double CubicStyle::Value(
  const Eigen::Matrix3d& S, const Eigen::Matrix3d& R, Eigen::Index cell) const
{
  return -2.0 * R.cwiseProduct(S.transpose()).sum() +
    this->Lambda * this->Areas[cell] * (R * this->Normals.row(cell).transpose()).lpNorm<1>();
}

/// min over R, z of -tr(R S) + lambda a / 2 |z|_1 with z = R n; keeps the best R on the way.
void CubicStyle::Alternate(
  const Eigen::Matrix3d& S, Eigen::Index cell, Eigen::Matrix3d& best, double& value)
{
  const Eigen::Vector3d n = this->Normals.row(cell).transpose();
  const double strength = 0.5 * this->Lambda * this->Areas[cell];
  Split& split = this->Splits[cell];
  for (int step = 0; step < MostSplittingSteps; ++step)
  {
    const Eigen::Matrix3d R = ClosestRotation(S + split.rho * n * (split.z - split.u).transpose());
    const double here = this->Value(S, R, cell);
    if (here < value)
    {
      value = here;
      best = R;
    }
    const Eigen::Vector3d Rn = R * n;
    const Eigen::Vector3d before = split.z;
    split.z = Shrink(Rn + split.u, strength / split.rho);
    split.u += Rn - split.z;
    const double primal = (split.z - Rn).norm();
    const double dual = split.rho * (split.z - before).norm();
    if (primal <= std::sqrt(6.0) * AbsoluteTolerance +
          RelativeTolerance * std::max(Rn.norm(), split.z.norm()) &&
      dual <= std::sqrt(3.0) * AbsoluteTolerance * this->Areas[cell] +
          RelativeTolerance * split.rho * split.u.norm())
    {
      return;
    }
    if (primal * this->Areas[cell] > Imbalance * dual)
    {
      split.rho *= Growth;
      split.u /= Growth;
    }
    else if (dual > Imbalance * primal * this->Areas[cell])
    {
      split.rho /= Growth;
      split.u *= Growth;
    }
  }
}

/// The rotation with R n on a half axis, where |R n|_1 is least and has a corner: best in closed
/// form. Among R = (turn by phi about the axis) R_0 the trace tr(R S) is a^T M a + c cos phi + s
/// sin phi, M = R_0 S.
void CubicStyle::Snap(
  const Eigen::Matrix3d& S, Eigen::Index cell, Eigen::Matrix3d& best, double& value) const
{
  const Eigen::Vector3d n = this->Normals.row(cell).transpose();
  if (n.isZero(0.0))
  {
    return; // the term is 0 whatever R
  }
  for (int side = 0; side < 6; ++side)
  {
    const Eigen::Vector3d axis = (side < 3 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(side % 3);
    const Eigen::Matrix3d R = Eigen::Quaterniond::FromTwoVectors(n, axis).toRotationMatrix();
    const Eigen::Matrix3d M = R * S;
    const Eigen::Vector3d skew(M(1, 2) - M(2, 1), M(2, 0) - M(0, 2), M(0, 1) - M(1, 0));
    const double phi = std::atan2(axis.dot(skew), M.trace() - axis.dot(M * axis));
    const Eigen::Matrix3d turned = Eigen::AngleAxisd(phi, axis) * R;
    const double here = this->Value(S, turned, cell);
    if (here < value)
    {
      value = here;
      best = turned;
    }
  }
}

double CubicStyle::Fit(Matrices& S, Matrices& R, int threads)
{
  if (this->Before.empty())
  {
    this->Before = R;
  }
  return ParallelSum(static_cast<int>(S.size()), threads,
    [&](int begin, int end)
    {
      double change = 0.0;
      for (int i = begin; i < end; ++i)
      {
        const Eigen::Matrix3d given = R[i];
        const double atGiven = this->Value(S[i], given, i);
        double value = atGiven;
        const double atBefore = this->Value(S[i], this->Before[i], i);
        if (atBefore < value)
        {
          value = atBefore;
          R[i] = this->Before[i];
        }
        this->Alternate(S[i], i, R[i], value);
        this->Snap(S[i], i, R[i], value);
        this->Before[i] = given;
        change += value - atGiven;
      }
      return change;
    });
}

double CubicStyle::Evaluate(const Matrices& R) const
{
  double sum = 0.0;
  for (std::size_t i = 0; i < R.size(); ++i)
  {
    const auto row = static_cast<Eigen::Index>(i);
    sum += this->Areas[row] * (R[i] * this->Normals.row(row).transpose()).lpNorm<1>();
  }
  return this->Lambda * sum;
}
} // namespace SphericalStyle
