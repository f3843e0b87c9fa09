// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The stages of the energy of the thesis, each through its public header. "bytes" is what a stage
// has to read and write at least: points, triangles, one weight a half-edge, rotations and
// covariances, each once.
#include "GlobalStep.h"
#include "LocalStep.h"
#include "Stages.h"
#include "StyleEnergy.h"
#include "SupernodalPattern.h"
#include "TargetDirections.h"

namespace Benchmarks
{
namespace
{
using namespace SphericalStyle;

constexpr double Roundness = 0.5;

/// Everything that any stage takes, of one mesh.
struct EnergyData
{
  explicit EnergyData(const MeshKey& key)
    : Mesh(MakeFramedMesh(key))
    , Topology(Mesh.F, static_cast<int>(Mesh.P.rows()))
    , Cells(Topology)
    , Lambda(Eigen::VectorXd::Constant(Mesh.P.rows(), Roundness))
  {
    const Points& P = this->Mesh.P;
    const Triangles& F = this->Mesh.F;
    this->Cotangents = HalfEdgeCotangents(P, F);
    this->Ball = TargetSphere(P, F, CenterMode::AreaCentroid, RadiusMode::EqualArea, {});
    this->UpdateTargets();
    this->Energy = this->MakeEnergy(1);
    const EdgeWeights& weights = this->Energy.GetWeights();
    this->Global = GlobalStep(this->Topology, {});
    this->Stiffness = weights.c + weights.l;
    this->Global.SetWeights(this->Stiffness, 1.0);
    this->Matrix = EdgeMatrix(this->Topology, this->Global.GetFixed());
    // A state as the loop has it: turned cells and bent edges.
    this->R.assign(P.rows(), Eigen::Matrix3d::Identity());
    this->Q = P;
    this->Iterate(this->Energy, this->Q, this->R, 2);
  }

  EdgeWeights Weights() const
  {
    return ComputeEdgeWeights(this->Cotangents, this->Mesh.F, this->Lambda, EdgeWeighting::HalfEdge,
      SphericalWeighting::Uniform);
  }

  void UpdateTargets()
  {
    std::vector<int> onCenter;
    this->Directions =
      CenterDirections(this->Mesh.P, this->Topology.GetTriangles(), this->Ball.center, onCenter);
  }

  StyleEnergy MakeEnergy(int threads) const
  {
    StyleEnergy energy(this->Topology, this->Weights(), HalfEdgeField(this->Mesh.P),
      HalfEdgeField(this->Directions, this->Ball.radius), threads);
    energy.PrepareSteps(this->Cells);
    return energy;
  }

  double Iterate(const StyleEnergy& energy, Points& positions, Matrices& rotations, int times = 1)
  {
    double total = 0.0;
    for (int k = 0; k < times; ++k)
    {
      energy.FitRotations(positions, rotations);
      energy.RightHandSide(rotations, this->B);
      this->Global.Solve(this->B, positions, energy.GetThreads());
      total = energy.Evaluate(positions, rotations).Total();
    }
    return total;
  }

  /// Bytes of so many points, and of the triangles with a weight a half-edge.
  double Bytes(int vectors, int matrices) const
  {
    const double triangle = 3 * sizeof(int) + 3 * sizeof(double);
    return this->Mesh.P.rows() * sizeof(double) * (3.0 * vectors + 9.0 * matrices) +
      this->Mesh.F.rows() * triangle;
  }

  TriangleMesh Mesh;
  MeshTopology Topology;
  CellPattern Cells;
  Eigen::VectorXd Lambda;
  HalfEdgeScalars Cotangents;
  Points Directions;
  Sphere Ball;
  StyleEnergy Energy;
  GlobalStep Global;
  HalfEdgeScalars Stiffness; // of the global step
  EdgeMatrix Matrix;
  Points Q;
  Matrices R;
  Matrices S;
  Points B;
};

/// Entries of the Cholesky factor of A, the zeros in its supernodes included, and what factoring
/// costs.
struct FactorCost
{
  double entries = 0.0;
  double operations = 0.0;
};

FactorCost CostOf(const SparseCholesky::Matrix& A)
{
  FactorCost cost;
  const SupernodalPattern pattern(A);
  for (int s = 0; s < pattern.GetNumberOfSupernodes(); ++s)
  {
    for (double rows = pattern.GetRowsBelow(s) + 1; rows <= pattern.GetRows(s); ++rows)
    {
      cost.entries += rows;
      cost.operations += rows * rows;
    }
  }
  return cost;
}

//------------------------------------------------------------------------- stages of the set-up
void Topology(benchmark::State& state, EnergyData& data, int)
{
  MeshTopology result;
  for (auto _ : state)
  {
    result = MeshTopology(data.Mesh.F, static_cast<int>(data.Mesh.P.rows()));
  }
  const auto& corners = result.GetCorners();
  Report(state, data.Mesh.P.rows(), HashOf(corners));
}

void Cotangents(benchmark::State& state, EnergyData& data, int)
{
  HalfEdgeScalars c;
  for (auto _ : state)
  {
    c = HalfEdgeCotangents(data.Mesh.P, data.Mesh.F);
    benchmark::ClobberMemory();
  }
  Report(state, data.Mesh.P.rows(), HashOf(c));
  ReportRate(state, "bytes", data.Bytes(1, 0));
}

void Weights(benchmark::State& state, EnergyData& data, int)
{
  EdgeWeights weights;
  for (auto _ : state)
  {
    weights = data.Weights();
    benchmark::ClobberMemory();
  }
  Report(state, data.Mesh.P.rows(), HashOf(weights.l));
}

void Targets(benchmark::State& state, EnergyData& data, int)
{
  for (auto _ : state)
  {
    data.UpdateTargets();
    benchmark::ClobberMemory();
  }
  Report(state, data.Mesh.P.rows(), HashOf(data.Directions));
}

void Matrix(benchmark::State& state, EnergyData& data, int)
{
  std::string hash;
  for (auto _ : state)
  {
    EdgeMatrix matrix(data.Topology, data.Global.GetFixed());
    const SparseCholesky::Matrix& A = matrix.Assemble(data.Stiffness);
    state.PauseTiming();
    hash = Hash(A.valuePtr(), A.nonZeros() * sizeof(double));
    state.ResumeTiming();
  }
  Report(state, data.Mesh.P.rows(), hash);
}

void Ordering(benchmark::State& state, EnergyData& data, int)
{
  const SparseCholesky::Matrix& A = data.Matrix.Assemble(data.Stiffness);
  for (auto _ : state)
  {
    SparseCholesky factor;
    factor.Analyze(A);
  }
  Report(state, data.Mesh.P.rows(), "");
}

/// b for the free rows of the global step.
SparseCholesky::RightHandSides RightHandSides(const EnergyData& data)
{
  return data.B.topRows(data.Matrix.GetNumberOfRows());
}

void Factorization(benchmark::State& state, EnergyData& data, int threads)
{
  const SparseCholesky::Matrix& A = data.Matrix.Assemble(data.Stiffness);
  SparseCholesky factor;
  factor.Analyze(A);
  for (auto _ : state)
  {
    factor.Factor(A, SparseCholesky::Precision::Double, threads);
  }
  SparseCholesky::RightHandSides X = RightHandSides(data);
  factor.Solve(X);
  Report(state, data.Mesh.P.rows(), HashOf(X));
  const FactorCost cost = CostOf(A);
  state.counters["factor_entries"] = cost.entries;
  ReportRate(state, "flops", cost.operations);
}

template <SparseCholesky::Precision Precision>
void Solve(benchmark::State& state, EnergyData& data, int threads)
{
  const SparseCholesky::Matrix& A = data.Matrix.Assemble(data.Stiffness);
  SparseCholesky factor;
  factor.Analyze(A);
  factor.Factor(A, Precision);
  SparseCholesky::RightHandSides X;
  for (auto _ : state)
  {
    state.PauseTiming();
    X = RightHandSides(data);
    state.ResumeTiming();
    factor.Solve(X, threads);
  }
  const FactorCost cost = CostOf(A);
  const std::size_t size =
    factor.GetPrecision() == SparseCholesky::Precision::Single ? sizeof(float) : sizeof(double);
  Report(state, data.Mesh.P.rows(), HashOf(X));
  ReportRate(state, "bytes", 2.0 * size * cost.entries);
  ReportRate(state, "flops", 12.0 * cost.entries);
}

//--------------------------------------------------------------------------- stages of the loop
void Rotations(benchmark::State& state, EnergyData& data, int threads)
{
  data.Energy.Covariances(data.Q, data.S);
  Matrices R = data.R;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(FitRotations(data.S, R, threads));
  }
  Report(state, data.Mesh.P.rows(), HashOf(R));
  // S, R old and new
  ReportRate(state, "bytes", 3.0 * sizeof(Eigen::Matrix3d) * data.Mesh.P.rows());
}

void LocalStep(benchmark::State& state, EnergyData& data, int threads)
{
  const StyleEnergy energy = data.MakeEnergy(threads);
  Matrices R = data.R;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(energy.FitRotations(data.Q, R));
  }
  Report(state, data.Mesh.P.rows(), HashOf(R));
  // P, t, P'; R old and new
  ReportRate(state, "bytes", data.Bytes(3, 2));
}

void PrepareSteps(benchmark::State& state, EnergyData& data, int threads)
{
  StyleEnergy energy = data.MakeEnergy(threads);
  for (auto _ : state)
  {
    energy.PrepareSteps(data.Cells);
  }
  Points b;
  energy.RightHandSide(data.R, b);
  Report(state, data.Mesh.P.rows(), HashOf(b));
}

void RightHandSide(benchmark::State& state, EnergyData& data, int threads)
{
  StyleEnergy energy = data.MakeEnergy(threads);
  Points b;
  for (auto _ : state)
  {
    energy.RightHandSide(data.R, b);
    benchmark::ClobberMemory();
  }
  Report(state, data.Mesh.P.rows(), HashOf(b));
  // P, t; R; b
  ReportRate(state, "bytes", data.Bytes(3, 1));
}

void Value(benchmark::State& state, EnergyData& data, int threads)
{
  const StyleEnergy energy = data.MakeEnergy(threads);
  double total = 0.0;
  for (auto _ : state)
  {
    total = energy.Evaluate(data.Q, data.R).Total();
    benchmark::DoNotOptimize(total);
  }
  Report(state, data.Mesh.P.rows(), Hash(&total, sizeof total));
  // P, t, P'; R
  ReportRate(state, "bytes", data.Bytes(3, 1));
}

void Iteration(benchmark::State& state, EnergyData& data, int threads)
{
  StyleEnergy energy = data.MakeEnergy(threads);
  Points Q = data.Q;
  Matrices R = data.R;
  for (auto _ : state)
  {
    data.Iterate(energy, Q, R);
  }
  Q = data.Q; // the number of iterations is not the same in every run
  R = data.R;
  data.Iterate(energy, Q, R, 2);
  Report(state, data.Mesh.P.rows(), HashOf(Q));
}
}

void RegisterEnergyStages(const MeshKey& key, int threads)
{
  using Body = void (*)(benchmark::State&, EnergyData&, int);
  const std::pair<const char*, Body> stages[] = { { "Topology", Topology },
    { "Cotangents", Cotangents }, { "Weights", Weights }, { "Targets", Targets },
    { "PrepareSteps", PrepareSteps }, { "Matrix", Matrix }, { "Ordering", Ordering },
    { "Factorization", Factorization }, { "Rotations", Rotations }, { "LocalStep", LocalStep },
    { "RightHandSide", RightHandSide }, { "Solve", Solve<SparseCholesky::Precision::Double> },
    { "SolveSingle", Solve<SparseCholesky::Precision::Single> }, { "Energy", Value },
    { "Iteration", Iteration } };
  for (const auto& [name, body] : stages)
  {
    Register(name, key, threads, body);
  }
}
} // namespace Benchmarks
