// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "AffineFit.h"

#include "LocalStep.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace SphericalStyle
{
namespace
{
constexpr double Line = 1e-6;       // of the spread: less across than this is on a line
constexpr double Stiffness = 0.003; // of the spread: against leaving the similarity
}

std::optional<AffineMap> FitAffineMap(const Points& P, const Points& Q, const Eigen::VectorXd& a)
{
  if (!(a.sum() > 0.0) || !Q.allFinite())
  {
    return {};
  }
  AffineMap map;
  map.from = a.transpose() * P / a.sum();
  map.to = a.transpose() * Q / a.sum();
  const Points p = P.rowwise() - map.from;
  Points r = Q.rowwise() - map.to;
  const Eigen::Matrix3d C = p.transpose() * a.asDiagonal() * p;
  const double spread = C.trace();
  const Eigen::Vector3d along =
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(C, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(along(1) > Line * spread))
  {
    return {};
  }
  const Eigen::Matrix3d S = p.transpose() * a.asDiagonal() * r;
  const Eigen::Matrix3d R = ClosestRotation(S);
  map.L = (R * S).trace() / spread * R;
  r -= p * map.L.transpose();
  const Eigen::Matrix3d K = C + Stiffness * spread * Eigen::Matrix3d::Identity();
  map.L += r.transpose() * a.asDiagonal() * p * K.inverse();
  return map.L.allFinite() && map.to.allFinite() ? std::optional(map) : std::nullopt;
}
} // namespace SphericalStyle
