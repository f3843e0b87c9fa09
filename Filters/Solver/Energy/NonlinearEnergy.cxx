// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "NonlinearEnergy.h"

#include "Parallel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace SphericalStyle
{
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

NonlinearEnergy::NonlinearEnergy(
  const OneRings& rings, Points P, Points normals, VectorXd lambda, int threads)
  : Rings(&rings)
  , P(std::move(P))
  , Normals(std::move(normals))
  , Lambda(std::move(lambda))
  , Threads(threads)
{
  for (int i = 0; i < rings.GetNumberOfPoints(); ++i)
  {
    for (const OneRings::Neighbor& j : rings[i])
    {
      this->Scale += std::abs(j.weight) * (this->P.row(i) - this->P.row(j.point)).squaredNorm();
    }
    this->Scale += this->Lambda(i) * (rings[i].size() + 1) * this->Normals.row(i).squaredNorm();
  }
}

EnergyTerms NonlinearEnergy::CellEnergy(
  int i, const Points& Q, const Matrices& R, const VectorXd& s) const
{
  const auto spherical = [&](int j)
  {
    const Vector3d misfit = R[i] * this->Normals.row(j).transpose() - s(j) * Q.row(j).transpose();
    return this->Lambda(j) * misfit.squaredNorm();
  };
  EnergyTerms energy;
  energy.spherical = spherical(i);
  for (const OneRings::Neighbor& j : (*this->Rings)[i])
  {
    const Vector3d edge = Q.row(i) - Q.row(j.point);
    const Vector3d rest = this->P.row(i) - this->P.row(j.point);
    energy.rigid += j.weight * (edge - R[i] * rest).squaredNorm();
    energy.spherical += spherical(j.point);
  }
  return energy;
}

EnergyTerms NonlinearEnergy::Evaluate(const Points& Q, const Matrices& R, const VectorXd& s) const
{
  std::vector<EnergyTerms> cells(R.size());
  ParallelFor(static_cast<int>(R.size()), this->Threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        cells[i] = this->CellEnergy(i, Q, R, s);
      }
    });
  EnergyTerms sum;
  for (const EnergyTerms& cell : cells)
  {
    sum.rigid += cell.rigid;
    sum.spherical += cell.spherical;
  }
  return sum;
}

VectorXd NonlinearEnergy::CellEnergies(const Points& Q, const Matrices& R, const VectorXd& s) const
{
  VectorXd energies(Q.rows());
  for (int i = 0; i < energies.size(); ++i)
  {
    energies(i) = this->CellEnergy(i, Q, R, s).Total();
  }
  return energies;
}

VectorXd NonlinearEnergy::ReciprocalDistances(const Points& Q)
{
  return Q.rowwise().norm().cwiseInverse().cwiseMin(LargestScale);
}

void NonlinearEnergy::Covariances(const Points& Q, const VectorXd& s, Matrices& S) const
{
  S.resize(Q.rows());
  ParallelFor(static_cast<int>(Q.rows()), this->Threads,
    [&](int begin, int end)
    {
      const auto spherical = [&](int j) -> Matrix3d
      { return this->Lambda(j) * s(j) * this->Normals.row(j).transpose() * Q.row(j); };
      for (int i = begin; i < end; ++i)
      {
        S[i] = spherical(i);
        for (const OneRings::Neighbor& j : (*this->Rings)[i])
        {
          S[i] += j.weight * (this->P.row(i) - this->P.row(j.point)).transpose() *
            (Q.row(i) - Q.row(j.point));
          S[i] += spherical(j.point);
        }
      }
    });
}

/// sum_{i in N(j) + j} R_i n_j: the cells that hold j are those that j's own cell holds.
Vector3d NonlinearEnergy::SumOfTurnedNormals(int j, const Matrices& R) const
{
  Matrix3d sum = R[j];
  for (const OneRings::Neighbor& i : (*this->Rings)[j])
  {
    sum += R[i.point];
  }
  return sum * this->Normals.row(j).transpose();
}

/// Replaces s. @return the change of E: sum_j lambda_j (nu_j |p'_j|^2 s^2 - 2 s p'_j . sum R_i n_j)
double NonlinearEnergy::SetScales(
  const Points& Q, const Matrices& R, const VectorXd& next, VectorXd& s) const
{
  const double change = ParallelSum(static_cast<int>(Q.rows()), this->Threads,
    [&](int begin, int end)
    {
      double sum = 0.0;
      for (int j = begin; j < end; ++j)
      {
        const double nu = (*this->Rings)[j].size() + 1.0;
        const double pull = Q.row(j).dot(this->SumOfTurnedNormals(j, R));
        sum += this->Lambda(j) * (next(j) - s(j)) *
          (nu * Q.row(j).squaredNorm() * (next(j) + s(j)) - 2.0 * pull);
      }
      return sum;
    });
  s = next;
  return change;
}

double NonlinearEnergy::FitScales(const Points& Q, const Matrices& R, VectorXd& s) const
{
  VectorXd next(Q.rows());
  ParallelFor(static_cast<int>(Q.rows()), this->Threads,
    [&](int begin, int end)
    {
      for (int j = begin; j < end; ++j)
      {
        const double nu = (*this->Rings)[j].size() + 1.0;
        const double square = Q.row(j).squaredNorm();
        const double pull = Q.row(j).dot(this->SumOfTurnedNormals(j, R));
        next(j) = square > 0.0 ? std::clamp(pull / (nu * square), 0.0, LargestScale) : 0.0;
      }
    });
  return this->SetScales(Q, R, next, s);
}

double NonlinearEnergy::FitScalesPerCell(const Points& Q, const Matrices& R, VectorXd& s) const
{
  VectorXd next(Q.rows());
  ParallelFor(static_cast<int>(Q.rows()), this->Threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        double pull = Q.row(i).dot(R[i] * this->Normals.row(i).transpose());
        double square = Q.row(i).squaredNorm();
        for (const OneRings::Neighbor& j : (*this->Rings)[i])
        {
          pull += Q.row(j.point).dot(R[i] * this->Normals.row(j.point).transpose());
          square += Q.row(j.point).squaredNorm();
        }
        next(i) = square > 0.0 ? pull / square : 0.0;
      }
    });
  return this->SetScales(Q, R, next, s);
}

VectorXd NonlinearEnergy::Diagonal(const VectorXd& s) const
{
  VectorXd d(s.size());
  for (int i = 0; i < d.size(); ++i)
  {
    d(i) = this->Lambda(i) * ((*this->Rings)[i].size() + 1) * s(i) * s(i);
  }
  return d;
}

void NonlinearEnergy::RightHandSide(const Matrices& R, const VectorXd& s, Points& b) const
{
  b.resize(s.size(), 3);
  ParallelFor(static_cast<int>(s.size()), this->Threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        Vector3d sum = this->Lambda(i) * s(i) * this->SumOfTurnedNormals(i, R);
        for (const OneRings::Neighbor& j : (*this->Rings)[i])
        {
          sum +=
            j.weight * ((R[i] + R[j.point]) * (this->P.row(i) - this->P.row(j.point)).transpose());
        }
        b.row(i) = sum;
      }
    });
}
} // namespace SphericalStyle
