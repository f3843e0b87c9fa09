// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "StyleEnergy.h"

#include "Parallel.h"

#include <cmath>
#include <utility>

namespace SphericalStyle
{
namespace
{
/// The three vectors of a triangle's half-edges as columns.
using Columns = Eigen::Map<const Eigen::Matrix3d>;

Columns TriangleColumns(const HalfEdgeVectors& x, Eigen::Index f)
{
  return Columns(x.row(f).data()); // row-major row of nine = three vectors = column-major matrix
}

Eigen::Matrix3d DeformedEdges(const Points& Q, const Triangles& F, Eigen::Index f)
{
  const Eigen::Vector3d a = Q.row(F(f, 0));
  const Eigen::Vector3d b = Q.row(F(f, 1));
  const Eigen::Vector3d c = Q.row(F(f, 2));
  Eigen::Matrix3d E;
  E << b - c, c - a, a - b;
  return E;
}

/// sum_h weight_h |E_h - R T_h|^2 over the half-edges of a triangle.
template <typename Weights>
double Misfit(
  const Eigen::Matrix3d& E, const Eigen::Matrix3d& R, const Columns& T, const Weights& weight)
{
  const Eigen::Matrix3d residual = E - R * T;
  return residual.colwise().squaredNorm().dot(weight);
}
}

StyleEnergy::StyleEnergy(const MeshTopology& topology, EdgeWeights weights, HalfEdgeVectors e,
  HalfEdgeVectors delta, HalfEdgeVectors f, int threads)
  : Topology(&topology)
  , Weights(std::move(weights))
  , Edges(std::move(e))
  , TurningTargets(std::move(delta))
  , FixedTargets(std::move(f))
  , Threads(threads)
{
  const Eigen::Index m = this->Edges.rows();
  this->Pull.resize(m, 9);
  this->FixedCovariances.resize(this->HasFixedTargets() ? m : 0);
  for (Eigen::Index t = 0; t < m; ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const double c = this->Weights.c(t, k);
      const double l = this->Weights.l(t, k);
      const auto edge = this->Edges.block<1, 3>(t, 3 * k);
      const auto delta_h = this->TurningTargets.block<1, 3>(t, 3 * k);
      this->Pull.block<1, 3>(t, 3 * k) = c * edge + l * delta_h;
      this->Scale += 3.0 * (std::abs(c) * edge.squaredNorm() + std::abs(l) * delta_h.squaredNorm());
      if (this->HasFixedTargets())
      {
        this->Scale += 3.0 * std::abs(l) * this->FixedTargets.block<1, 3>(t, 3 * k).squaredNorm();
      }
    }
    if (this->HasFixedTargets())
    {
      this->FixedCovariances[t] = TriangleColumns(this->TurningTargets, t) *
        this->Weights.l.row(t).asDiagonal() * TriangleColumns(this->FixedTargets, t).transpose();
    }
  }
  this->TriangleCovariances.resize(m);
  this->CornerPulls.resize(m, 9);
}

EnergyTerms StyleEnergy::Evaluate(const Points& Q, const Matrices& R) const
{
  const Triangles& F = this->Topology->GetTriangles();
  const int m = static_cast<int>(F.rows());
  const auto term =
    [&](const HalfEdgeVectors& turning, const HalfEdgeVectors& fixed, const HalfEdgeScalars& weight)
  {
    return ParallelSum(m, this->Threads,
      [&](int begin, int end)
      {
        double sum = 0.0;
        for (int f = begin; f < end; ++f)
        {
          Eigen::Matrix3d E = DeformedEdges(Q, F, f);
          if (fixed.rows() > 0)
          {
            E -= TriangleColumns(fixed, f);
          }
          const Columns T = TriangleColumns(turning, f);
          for (int y = 0; y < 3; ++y)
          {
            sum += Misfit(E, R[F(f, y)], T, weight.row(f));
          }
        }
        return sum;
      });
  };
  return { term(this->Edges, HalfEdgeVectors(), this->Weights.c),
    term(this->TurningTargets, this->FixedTargets, this->Weights.l) };
}

Eigen::VectorXd StyleEnergy::CellEnergies(const Points& Q, const Matrices& R) const
{
  const Triangles& F = this->Topology->GetTriangles();
  Eigen::VectorXd energy = Eigen::VectorXd::Zero(Q.rows());
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    const Eigen::Matrix3d E = DeformedEdges(Q, F, f);
    Eigen::Matrix3d G = E;
    if (this->HasFixedTargets())
    {
      G -= TriangleColumns(this->FixedTargets, f);
    }
    for (int y = 0; y < 3; ++y)
    {
      const Eigen::Matrix3d& rotation = R[F(f, y)];
      energy(F(f, y)) +=
        Misfit(E, rotation, TriangleColumns(this->Edges, f), this->Weights.c.row(f)) +
        Misfit(G, rotation, TriangleColumns(this->TurningTargets, f), this->Weights.l.row(f));
    }
  }
  return energy;
}

void StyleEnergy::Covariances(const Points& Q, Matrices& S)
{
  const Triangles& F = this->Topology->GetTriangles();
  ParallelFor(static_cast<int>(F.rows()), this->Threads,
    [&](int begin, int end)
    {
      for (int f = begin; f < end; ++f)
      {
        this->TriangleCovariances[f] =
          TriangleColumns(this->Pull, f) * DeformedEdges(Q, F, f).transpose();
        if (this->HasFixedTargets())
        {
          this->TriangleCovariances[f] -= this->FixedCovariances[f];
        }
      }
    });
  S.resize(Q.rows());
  const std::vector<int>& offset = this->Topology->GetCornerOffset();
  const std::vector<int>& corners = this->Topology->GetCorners();
  ParallelFor(static_cast<int>(Q.rows()), this->Threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        S[i].setZero();
        for (int at = offset[i]; at < offset[i + 1]; ++at)
        {
          S[i] += this->TriangleCovariances[corners[at] / 3];
        }
      }
    });
}

void StyleEnergy::RightHandSide(const Matrices& R, Points& b)
{
  const Triangles& F = this->Topology->GetTriangles();
  ParallelFor(static_cast<int>(F.rows()), this->Threads,
    [&](int begin, int end)
    {
      for (int f = begin; f < end; ++f)
      {
        Eigen::Matrix3d pull =
          (R[F(f, 0)] + R[F(f, 1)] + R[F(f, 2)]) * TriangleColumns(this->Pull, f);
        if (this->HasFixedTargets())
        {
          pull +=
            3.0 * TriangleColumns(this->FixedTargets, f) * this->Weights.l.row(f).asDiagonal();
        }
        // Corner k starts half-edge k + 2 and ends half-edge k + 1.
        Eigen::Map<Eigen::Matrix3d> corner(this->CornerPulls.row(f).data());
        for (int k = 0; k < 3; ++k)
        {
          corner.col(k) = pull.col((k + 2) % 3) - pull.col((k + 1) % 3);
        }
      }
    });
  b.resize(static_cast<Eigen::Index>(R.size()), 3);
  const std::vector<int>& offset = this->Topology->GetCornerOffset();
  const std::vector<int>& corners = this->Topology->GetCorners();
  ParallelFor(static_cast<int>(R.size()), this->Threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
        for (int at = offset[i]; at < offset[i + 1]; ++at)
        {
          sum += Eigen::Map<const Eigen::RowVector3d>(
            this->CornerPulls.data() + 3 * static_cast<std::ptrdiff_t>(corners[at]));
        }
        b.row(i) = sum;
      }
    });
}
} // namespace SphericalStyle
