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
  HalfEdgeField delta, HalfEdgeField f, int threads)
  : Topology(&topology)
  , Weights(std::move(weights))
  , Edges(std::move(e))
  , TurningTargets(std::move(delta))
  , FixedTargets(std::move(f))
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
        sum += this->Weights.l.row(t).cwiseAbs().dot(sizes(this->TurningTargets));
        if (this->HasFixedTargets())
        {
          sum += this->Weights.l.row(t).cwiseAbs().dot(sizes(this->FixedTargets));
        }
      }
      return 3.0 * sum;
    });
}

namespace
{
/// What the sums of fixed targets read.
struct FixedArrays
{
  const int* F;
  const int* cornerOffset; // by point
  const int* corners;
  HalfEdgeField::Reader delta;
  HalfEdgeField::Reader f;
  const double* l; // three for each triangle
};

/// For the points begin..end-1: sum_{f at y} sum_h l delta f^T, and what 3 l f adds to b.
SPHERICALSTYLE_PER_INSTRUCTION_SET
void SumFixedTargets(const FixedArrays& a, int begin, int end, double* covariances, double* pulls)
{
  for (int y = begin; y < end; ++y)
  {
    Vector4 columns[3] = {};
    Vector4 pull = {};
    for (int at = a.cornerOffset[y]; at < a.cornerOffset[y + 1]; ++at)
    {
      const int t = a.corners[at] / 3;
      const int k = a.corners[at] % 3;
      const int* corner = a.F + 3 * static_cast<std::ptrdiff_t>(t);
      Vector4 delta[3];
      Vector4 f[3];
      a.delta.Read(corner, t, delta);
      a.f.Read(corner, t, f);
      for (int h = 0; h < 3; ++h)
      {
        f[h] *= a.l[3 * static_cast<std::ptrdiff_t>(t) + h];
        for (int c = 0; c < 3; ++c)
        {
          columns[c] += delta[h] * f[h][c];
        }
      }
      // Corner k starts half-edge k + 2 and ends half-edge k + 1.
      pull += 3.0 * (f[(k + 2) % 3] - f[(k + 1) % 3]);
    }
    for (int k = 0; k < 3; ++k)
    {
      for (int c = 0; c < 3; ++c)
      {
        covariances[9 * static_cast<std::ptrdiff_t>(y) + 3 * c + k] = columns[c][k];
      }
      pulls[3 * static_cast<std::ptrdiff_t>(y) + k] = pull[k];
    }
  }
}
}

void StyleEnergy::PrepareSteps(const CellPattern& pattern, CellPulls pulls)
{
  const Triangles& F = this->Topology->GetTriangles();
  this->Pulls = std::move(pulls);
  if (this->Pulls.IsEmpty())
  {
    this->Pulls = CellPulls(
      pattern, *this->Topology,
      [&](int t) -> Eigen::Matrix3d
      {
        return this->Edges.Of(F, t) * this->Weights.c.row(t).asDiagonal() +
          this->TurningTargets.Of(F, t) * this->Weights.l.row(t).asDiagonal();
      },
      this->Threads);
  }
  if (!this->HasFixedTargets())
  {
    return;
  }
  const int n = this->Topology->GetNumberOfPoints();
  this->FixedCovariances.resize(9 * static_cast<std::size_t>(n));
  this->FixedPulls.resize(n, 3);
  using Reader = HalfEdgeField::Reader;
  const FixedArrays arrays = { F.data(), this->Topology->GetCornerOffset().data(),
    this->Topology->GetCorners().data(), Reader(this->TurningTargets), Reader(this->FixedTargets),
    this->Weights.l.data() };
  ParallelFor(n, this->Threads,
    [&](int begin, int end) {
      SumFixedTargets(arrays, begin, end, this->FixedCovariances.data(), this->FixedPulls.data());
    });
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
  HalfEdgeField::Reader delta;
  HalfEdgeField::Reader f;
  bool hasFixed;
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
    Vector4 delta[3];
    Vector4 fixed[3] = {};
    a.current.Read(corner, t, current);
    a.e.Read(corner, t, e);
    a.delta.Read(corner, t, delta);
    if (a.hasFixed)
    {
      a.f.Read(corner, t, fixed);
    }
    for (int k = 0; k < 3; ++k)
    {
      const Vector4 base = current[k] - fixed[k];
      Vector4 rigidSquares = {};
      Vector4 sphericalSquares = {};
      for (const Columns4& rotation : R)
      {
        const Vector4 u = current[k] - rotation * e[k];
        const Vector4 v = base - rotation * delta[k];
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
    Vector4 delta[2];
    a.current.ReadFromLast(corner, current);
    a.e.ReadFromLast(corner, e);
    a.delta.ReadFromLast(corner, delta);
    Vector4 base[2] = { current[0], current[1] };
    if (a.hasFixed)
    {
      Vector4 fixed[2];
      a.f.ReadFromLast(corner, fixed);
      base[0] -= fixed[0];
      base[1] -= fixed[1];
    }
    Squares rigidSquares;
    Squares sphericalSquares;
    for (int y = 0; y < 3; ++y)
    {
      const Columns4 R = LoadColumns(a.R + 9 * static_cast<std::ptrdiff_t>(corner[y]));
      rigidSquares.Add(R, current, e);
      sphericalSquares.Add(R, base, delta);
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
    Reader(this->TurningTargets), Reader(this->FixedTargets), this->HasFixedTargets(),
    this->Weights.c.data(), this->Weights.l.data() };
  const bool differences = this->Edges.IsDifference() && this->TurningTargets.IsDifference() &&
    (this->FixedTargets.IsDifference() || !this->HasFixedTargets());
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
    Eigen::Matrix3d G = E;
    if (this->HasFixedTargets())
    {
      G -= this->FixedTargets.Of(F, f);
    }
    for (int y = 0; y < 3; ++y)
    {
      const Eigen::Matrix3d& rotation = R[F(f, y)];
      energy(F(f, y)) += Misfit(E, rotation, this->Edges.Of(F, f), this->Weights.c.row(f)) +
        Misfit(G, rotation, this->TurningTargets.Of(F, f), this->Weights.l.row(f));
    }
  }
  return energy;
}

void StyleEnergy::Covariances(const Points& Q, int begin, int end, double* S) const
{
  this->Pulls.Covariances(Q, begin, end, S);
  if (this->HasFixedTargets())
  {
    const double* fixed = &this->FixedCovariances[9 * static_cast<std::size_t>(begin)];
    for (std::ptrdiff_t k = 0; k < 9 * static_cast<std::ptrdiff_t>(end - begin); ++k)
    {
      S[k] -= fixed[k];
    }
  }
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
        this->Covariances(Q, first, last, batch.data());
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
        this->Covariances(Q, first, last, batch.data());
        change += SphericalStyle::FitRotations(batch.data(), last - first, &R[first]);
      }
      return change;
    });
}

void StyleEnergy::RightHandSide(const Matrices& R, Points& b) const
{
  this->Pulls.RightHandSide(R, b, this->Threads);
  if (this->HasFixedTargets())
  {
    b += this->FixedPulls;
  }
}
} // namespace SphericalStyle
