// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "StyleEnergy.h"

#include "LocalStep.h"
#include "Parallel.h"
#include "Vector4.h"

#include <algorithm>
#include <array>
#include <utility>

namespace SphericalStyle
{
namespace
{
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
double Misfit(const Eigen::Matrix3d& E, const Eigen::Matrix3d& R, const Eigen::Matrix3d& T,
  const Weights& weight)
{
  const Eigen::Matrix3d residual = E - R * T;
  return residual.colwise().squaredNorm().dot(weight);
}
}

StyleEnergy::StyleEnergy(const MeshTopology& topology, EdgeWeights weights, HalfEdgeField e,
  HalfEdgeField tau, int threads)
  : Topology(&topology)
  , Weights(std::move(weights))
  , Edges(std::move(e))
  , Targets(std::move(tau))
  , Threads(threads)
{
  const Triangles& F = topology.GetTriangles();
  this->Scale = ParallelSum(topology.GetNumberOfTriangles(), this->Threads,
    [&](int begin, int end)
    {
      double sum = 0.0;
      for (int t = begin; t < end; ++t)
      {
        const auto sizes = [&](const HalfEdgeField& x)
        { return x.Of(F, t).colwise().squaredNorm().eval(); };
        sum += this->Weights.c.row(t).cwiseAbs().dot(sizes(this->Edges));
        sum += this->Weights.l.row(t).cwiseAbs().dot(sizes(this->Targets));
      }
      return 3.0 * sum;
    });
}

void StyleEnergy::PrepareSteps(const CellPattern& pattern)
{
  const Triangles& F = this->Topology->GetTriangles();
  this->Coefficients = CellCoefficients(
    pattern, *this->Topology,
    [&](int t) -> Eigen::Matrix3d
    {
      return this->Edges.Of(F, t) * this->Weights.c.row(t).asDiagonal() +
        this->Targets.Of(F, t) * this->Weights.l.row(t).asDiagonal();
    },
    this->Threads);
}

namespace
{
/// What the sums of residuals read.
struct ResidualArrays
{
  const int* F;
  const double* R;               // by point
  HalfEdgeField::Reader current; // e'
  HalfEdgeField::Reader e;
  HalfEdgeField::Reader tau;
  const double* c; // three for each triangle
  const double* l;
};

SPHERICALSTYLE_PER_INSTRUCTION_SET
void SumResiduals(const ResidualArrays& a, int begin, int end, EnergyTerms& energy)
{
  Vector4 rigid = {};
  Vector4 spherical = {};
  for (int t = begin; t < end; ++t)
  {
    const int* corner = a.F + 3 * static_cast<std::ptrdiff_t>(t);
    const Columns4 R[3] = { LoadColumns(a.R + 9 * static_cast<std::ptrdiff_t>(corner[0])),
      LoadColumns(a.R + 9 * static_cast<std::ptrdiff_t>(corner[1])),
      LoadColumns(a.R + 9 * static_cast<std::ptrdiff_t>(corner[2])) };
    Vector4 current[3];
    Vector4 e[3];
    Vector4 tau[3];
    a.current.Read(corner, t, current);
    a.e.Read(corner, t, e);
    a.tau.Read(corner, t, tau);
    for (int k = 0; k < 3; ++k)
    {
      Vector4 rigidSquares = {};
      Vector4 sphericalSquares = {};
      for (const Columns4& rotation : R)
      {
        const Vector4 u = current[k] - rotation * e[k];
        const Vector4 v = current[k] - rotation * tau[k];
        rigidSquares += u * u;
        sphericalSquares += v * v;
      }
      rigid += a.c[3 * static_cast<std::ptrdiff_t>(t) + k] * rigidSquares;
      spherical += a.l[3 * static_cast<std::ptrdiff_t>(t) + k] * sphericalSquares;
    }
  }
  energy.rigid = rigid[0] + rigid[1] + rigid[2];
  energy.spherical = spherical[0] + spherical[1] + spherical[2];
}

/// For one term: squares of the residuals x - R y of the three half-edges, from those of the
/// corners 0 and 1 as seen from corner 2.
struct Squares
{
  Vector4 of[3] = {};

  SPHERICALSTYLE_INLINE void Add(const Columns4& R, const Vector4 x[2], const Vector4 y[2])
  {
    const Vector4 u0 = x[0] - R * y[0];
    const Vector4 u1 = x[1] - R * y[1];
    const Vector4 between = u0 - u1;
    this->of[0] += u1 * u1;
    this->of[1] += u0 * u0;
    this->of[2] += between * between;
  }

  SPHERICALSTYLE_INLINE Vector4 Sum(const double* weights) const
  {
    return weights[0] * this->of[0] + weights[1] * this->of[1] + weights[2] * this->of[2];
  }
};

/// SumResiduals where all fields are differences: two products with a rotation in place of three.
SPHERICALSTYLE_PER_INSTRUCTION_SET
void SumResidualsOfDifferences(const ResidualArrays& a, int begin, int end, EnergyTerms& energy)
{
  Vector4 rigid = {};
  Vector4 spherical = {};
  for (int t = begin; t < end; ++t)
  {
    const int* corner = a.F + 3 * static_cast<std::ptrdiff_t>(t);
    Vector4 current[2];
    Vector4 e[2];
    Vector4 tau[2];
    a.current.ReadFromLast(corner, current);
    a.e.ReadFromLast(corner, e);
    a.tau.ReadFromLast(corner, tau);
    Squares rigidSquares;
    Squares sphericalSquares;
    for (int y = 0; y < 3; ++y)
    {
      const Columns4 R = LoadColumns(a.R + 9 * static_cast<std::ptrdiff_t>(corner[y]));
      rigidSquares.Add(R, current, e);
      sphericalSquares.Add(R, current, tau);
    }
    rigid += rigidSquares.Sum(a.c + 3 * static_cast<std::ptrdiff_t>(t));
    spherical += sphericalSquares.Sum(a.l + 3 * static_cast<std::ptrdiff_t>(t));
  }
  energy.rigid = rigid[0] + rigid[1] + rigid[2];
  energy.spherical = spherical[0] + spherical[1] + spherical[2];
}
}

EnergyTerms StyleEnergy::Evaluate(const Points& Q, const Matrices& R) const
{
  using Reader = HalfEdgeField::Reader;
  const Triangles& F = this->Topology->GetTriangles();
  const HalfEdgeField current(Q);
  const ResidualArrays arrays = { F.data(), R.data()->data(), Reader(current), Reader(this->Edges),
    Reader(this->Targets), this->Weights.c.data(), this->Weights.l.data() };
  const bool differences = this->Edges.IsDifference() && this->Targets.IsDifference();
  const auto sum = differences ? SumResidualsOfDifferences : SumResiduals;
  return ParallelSum(static_cast<int>(F.rows()), this->Threads, EnergyTerms(),
    [&](int begin, int end)
    {
      EnergyTerms energy;
      sum(arrays, begin, end, energy);
      return energy;
    });
}

Eigen::VectorXd StyleEnergy::CellEnergies(const Points& Q, const Matrices& R) const
{
  const Triangles& F = this->Topology->GetTriangles();
  Eigen::VectorXd energy = Eigen::VectorXd::Zero(Q.rows());
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    const Eigen::Matrix3d E = DeformedEdges(Q, F, f);
    for (int y = 0; y < 3; ++y)
    {
      const Eigen::Matrix3d& rotation = R[F(f, y)];
      energy(F(f, y)) += Misfit(E, rotation, this->Edges.Of(F, f), this->Weights.c.row(f)) +
        Misfit(E, rotation, this->Targets.Of(F, f), this->Weights.l.row(f));
    }
  }
  return energy;
}

namespace
{
constexpr int Batch = 64; // covariances that stay in the cache until their rotations are found
using BatchOfCovariances = std::array<double, 9 * Batch + 1>;
}

void StyleEnergy::Covariances(const Points& Q, Matrices& S) const
{
  S.resize(Q.rows());
  ParallelFor(static_cast<int>(Q.rows()), this->Threads,
    [&](int begin, int end)
    {
      BatchOfCovariances batch;
      for (int first = begin; first < end; first += Batch)
      {
        const int last = std::min(first + Batch, end);
        this->Coefficients.Covariances(Q, first, last, batch.data());
        std::copy_n(batch.data(), 9 * static_cast<std::ptrdiff_t>(last - first), S[first].data());
      }
    });
}

double StyleEnergy::FitRotations(const Points& Q, Matrices& R) const
{
  return ParallelSum(static_cast<int>(Q.rows()), this->Threads,
    [&](int begin, int end)
    {
      BatchOfCovariances batch;
      double change = 0.0;
      for (int first = begin; first < end; first += Batch)
      {
        const int last = std::min(first + Batch, end);
        this->Coefficients.Covariances(Q, first, last, batch.data());
        change += SphericalStyle::FitRotations(batch.data(), last - first, &R[first]);
      }
      return change;
    });
}

void StyleEnergy::RightHandSide(const Matrices& R, Points& b) const
{
  this->Coefficients.RightHandSide(R, b, this->Threads);
}
} // namespace SphericalStyle
