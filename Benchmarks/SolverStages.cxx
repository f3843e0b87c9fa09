// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The stages of the method in closed form with DetailSize 0.03, and of the energy, each through its
// public header. "bytes" is what a stage of the energy has to read and write at least: points,
// triangles, one weight a half-edge, rotations and covariances, each once.
#include "BenchmarkProgram.h"
#include "Frame.h"
#include "GlobalStep.h"
#include "LimbThickness.h"
#include "LocalStep.h"
#include "SphericalStyleMethod.h"
#include "Stages.h"
#include "SupernodalPattern.h"
#include "SurfaceMeasures.h"

#include <benchmark/benchmark.h>

namespace Benchmarks
{
namespace
{
using namespace SphericalStyle;

constexpr double Roundness = 0.5;
constexpr double DetailSize = 0.03;

/// Everything that any stage takes, of one mesh.
struct StageData
{
  explicit StageData(const MeshKey& key)
    : Mesh(MakeMesh(FamilyNamed(key.family), key.numberOfPoints))
    , Topology(Mesh.F, static_cast<int>(Mesh.P.rows()))
    , Cells(Topology)
    , Lambda(Eigen::VectorXd::Constant(Mesh.P.rows(), Roundness))
  {
    this->Mesh.P = FrameOf(this->Mesh.P).Into(this->Mesh.P);
    const Points& P = this->Mesh.P;
    const Triangles& F = this->Mesh.F;
    this->Cotangents = HalfEdgeCotangents(P, F);
    this->Ball = TargetSphere(P, F, CenterMode::AreaCentroid, RadiusMode::EqualArea, {});
    this->UpdateTargets();
    this->Energy = this->MakeEnergy(1);
    const EdgeWeights& weights = this->Energy.GetWeights();
    this->Global = GlobalStep(this->Topology, {});
    this->Global.SetWeights(weights.c, 1.0 + weights.ratio);
    this->Matrix = EdgeMatrix(this->Topology, this->Global.GetFixed());
    // A state as the loop has it: turned cells and bent edges.
    this->R.assign(P.rows(), Eigen::Matrix3d::Identity());
    this->Q = P;
    this->Iterate(this->Energy, this->Q, this->R, 2);
  }

  EdgeWeights Weights() const
  {
    return ComputeEdgeWeights(this->Cotangents, this->Mesh.F, this->Lambda, EdgeWeighting::HalfEdge,
      SphericalWeighting::Cotangent);
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
      this->Global.Solve(this->B, positions);
      total = energy.Evaluate(positions, rotations).Total();
    }
    return total;
  }

  double NumberOfPoints() const { return static_cast<double>(this->Mesh.P.rows()); }
  /// Bytes of so many points, and of the triangles with a weight a half-edge.
  double Bytes(int vectors, int matrices) const
  {
    const double triangle = 3 * sizeof(int) + 3 * sizeof(double);
    return this->NumberOfPoints() * sizeof(double) * (3 * vectors + 9 * matrices) +
      this->Mesh.F.rows() * triangle;
  }

  TriangleMesh Mesh; // in its frame
  MeshTopology Topology;
  CellPattern Cells;
  Eigen::VectorXd Lambda;
  HalfEdgeScalars Cotangents;
  Points Directions;
  Sphere Ball;
  StyleEnergy Energy;
  GlobalStep Global;
  EdgeMatrix Matrix;
  Points Q;
  Matrices R;
  Matrices S;
  Points B;
};

/// The data of the mesh that was asked for last: benchmarks run mesh by mesh, and two large ones do
/// not fit everywhere.
StageData& DataOf(const MeshKey& key)
{
  static std::unique_ptr<StageData> data;
  static MeshKey current = { "", 0 };
  if (!data || !(current == key))
  {
    data.reset();
    data = std::make_unique<StageData>(key);
    current = key;
  }
  return *data;
}

template <typename Dense>
std::string HashOf(const Dense& x)
{
  return Hash(x.data(), static_cast<std::size_t>(x.size()) * sizeof(*x.data()));
}

/// What every stage reports beside its time. @param bytes  0 where no bound is known
void Report(benchmark::State& state, const StageData& data, double bytes, const std::string& hash)
{
  using benchmark::Counter;
  state.counters["points"] = data.NumberOfPoints();
  state.counters["s_per_point"] =
    Counter(data.NumberOfPoints(), Counter::kIsIterationInvariantRate | Counter::kInvert);
  if (bytes > 0.0)
  {
    state.counters["bytes"] = Counter(bytes, Counter::kIsIterationInvariantRate);
  }
  state.SetLabel(hash);
}

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

template <typename Body>
void Register(const std::string& stage, const MeshKey& key, int threads, Body body)
{
  benchmark::RegisterBenchmark(NameOf(stage, key, threads).c_str(),
    [key, threads, body](benchmark::State& state) { body(state, DataOf(key), threads); })
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
}

//------------------------------------------------------------------------- stages of the set-up
void Topology(benchmark::State& state, StageData& data, int)
{
  MeshTopology result;
  while (state.KeepRunning())
  {
    result = MeshTopology(data.Mesh.F, static_cast<int>(data.Mesh.P.rows()));
  }
  const auto& corners = result.GetCorners();
  Report(state, data, 0.0, Hash(corners.data(), corners.size() * sizeof(int)));
}

void Cotangents(benchmark::State& state, StageData& data, int)
{
  HalfEdgeScalars c;
  while (state.KeepRunning())
  {
    c = HalfEdgeCotangents(data.Mesh.P, data.Mesh.F);
    benchmark::ClobberMemory();
  }
  Report(state, data, data.Bytes(1, 0), HashOf(c));
}

void Weights(benchmark::State& state, StageData& data, int)
{
  EdgeWeights weights;
  while (state.KeepRunning())
  {
    weights = data.Weights();
    benchmark::ClobberMemory();
  }
  Report(state, data, 0.0, HashOf(weights.l));
}

void Splat(benchmark::State& state, StageData& data, int threads)
{
  SurfaceGrid grid;
  while (state.KeepRunning())
  {
    grid = SurfaceGrid(data.Mesh.P, data.Mesh.F, DetailSize, threads);
  }
  Report(state, data, 0.0, HashOf(grid.GetWeights()));
}

void Walls(benchmark::State& state, StageData& data, int threads)
{
  const SurfaceGrid grid(data.Mesh.P, data.Mesh.F, DetailSize, threads);
  std::vector<GridPair> walls;
  while (state.KeepRunning())
  {
    walls = FindWalls(grid, data.Mesh.P, data.Mesh.F, threads);
  }
  Report(state, data, 0.0, Hash(walls.data(), walls.size() * sizeof(GridPair)));
}

/// The base from the factor of the grid on, as a new detail size needs it.
void Base(benchmark::State& state, StageData& data, int threads)
{
  SurfaceGrid grid(data.Mesh.P, data.Mesh.F, DetailSize, threads);
  Points base;
  while (state.KeepRunning())
  {
    grid.Factor({}, threads);
    const Fields once = grid.Smooth(grid.GetPlaces(), threads);
    const Fields twice = grid.Smooth(grid.AtSamples(once, threads), threads);
    base = grid.AtPoints(twice, data.Mesh.P, threads);
  }
  Report(state, data, 0.0, HashOf(base));
  state.counters["functions"] = grid.GetNumberOfFunctions();
}

void Limbs(benchmark::State& state, StageData& data, int threads)
{
  Eigen::VectorXd thickness;
  while (state.KeepRunning())
  {
    thickness = LimbThickness(data.Mesh.P, data.Mesh.P, data.Mesh.F, data.Ball.radius, threads);
  }
  Report(state, data, 0.0, HashOf(thickness));
}

/// What a new Roundness redoes.
void Carry(benchmark::State& state, StageData& data, int threads)
{
  ClosedFormStyle style;
  style.SetMesh(data.Mesh.P, data.Mesh.F);
  ClosedFormOptions options;
  options.detailSize = DetailSize;
  options.threads = threads;
  style.Solve(options);
  double lambda = Roundness;
  while (state.KeepRunning())
  {
    options.lambda = lambda += 1e-3;
    style.Solve(options);
  }
  options.lambda = Roundness;
  style.Solve(options);
  Report(state, data, 0.0, HashOf(style.GetPositions()));
}

void Targets(benchmark::State& state, StageData& data, int)
{
  while (state.KeepRunning())
  {
    data.UpdateTargets();
    benchmark::ClobberMemory();
  }
  Report(state, data, 0.0, HashOf(data.Directions));
}

void Matrix(benchmark::State& state, StageData& data, int)
{
  std::string hash;
  while (state.KeepRunning())
  {
    EdgeMatrix matrix(data.Topology, data.Global.GetFixed());
    const SparseCholesky::Matrix& A = matrix.Assemble(data.Cotangents);
    state.PauseTiming();
    hash = Hash(A.valuePtr(), A.nonZeros() * sizeof(double));
    state.ResumeTiming();
  }
  Report(state, data, 0.0, hash);
}

void Ordering(benchmark::State& state, StageData& data, int)
{
  const SparseCholesky::Matrix& A = data.Matrix.Assemble(data.Cotangents);
  while (state.KeepRunning())
  {
    SparseCholesky factor;
    factor.Analyze(A);
  }
  Report(state, data, 0.0, "");
}

/// b for the free rows of the global step.
SparseCholesky::RightHandSides RightHandSides(const StageData& data)
{
  return data.B.topRows(data.Matrix.GetNumberOfRows());
}

void Factorization(benchmark::State& state, StageData& data, int threads)
{
  const SparseCholesky::Matrix& A = data.Matrix.Assemble(data.Cotangents);
  SparseCholesky factor;
  factor.Analyze(A);
  while (state.KeepRunning())
  {
    factor.Factor(A, SparseCholesky::Precision::Double, threads);
  }
  SparseCholesky::RightHandSides X = RightHandSides(data);
  factor.Solve(X);
  Report(state, data, 0.0, HashOf(X));
  const FactorCost cost = CostOf(A);
  state.counters["factor_entries"] = cost.entries;
  state.counters["flops"] =
    benchmark::Counter(cost.operations, benchmark::Counter::kIsIterationInvariantRate);
}

template <SparseCholesky::Precision Precision>
void Solve(benchmark::State& state, StageData& data, int threads)
{
  const SparseCholesky::Matrix& A = data.Matrix.Assemble(data.Cotangents);
  SparseCholesky factor;
  factor.Analyze(A);
  factor.Factor(A, Precision);
  SparseCholesky::RightHandSides X;
  while (state.KeepRunning())
  {
    state.PauseTiming();
    X = RightHandSides(data);
    state.ResumeTiming();
    factor.Solve(X, threads);
  }
  const FactorCost cost = CostOf(A);
  const std::size_t size =
    factor.GetPrecision() == SparseCholesky::Precision::Single ? sizeof(float) : sizeof(double);
  Report(state, data, 2.0 * size * cost.entries, HashOf(X));
  state.counters["flops"] =
    benchmark::Counter(12.0 * cost.entries, benchmark::Counter::kIsIterationInvariantRate);
}

//--------------------------------------------------------------------------- stages of the loop
void Covariances(benchmark::State& state, StageData& data, int threads)
{
  StyleEnergy energy = data.MakeEnergy(threads);
  Matrices S;
  while (state.KeepRunning())
  {
    energy.Covariances(data.Q, S);
    benchmark::ClobberMemory();
  }
  // P, t, P'; S
  Report(state, data, data.Bytes(3, 1), Hash(S.data(), S.size() * sizeof(S[0])));
}

void Rotations(benchmark::State& state, StageData& data, int threads)
{
  data.Energy.Covariances(data.Q, data.S);
  Matrices R = data.R;
  while (state.KeepRunning())
  {
    benchmark::DoNotOptimize(FitRotations(data.S, R, threads));
  }
  const double bytes = 3.0 * sizeof(Eigen::Matrix3d) * data.NumberOfPoints(); // S, R old and new
  Report(state, data, bytes, Hash(R.data(), R.size() * sizeof(R[0])));
}

void LocalStep(benchmark::State& state, StageData& data, int threads)
{
  const StyleEnergy energy = data.MakeEnergy(threads);
  Matrices R = data.R;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(energy.FitRotations(data.Q, R));
  }
  // P, t, P'; R old and new
  Report(state, data, data.Bytes(3, 2), Hash(R.data(), R.size() * sizeof(R[0])));
}

void PrepareSteps(benchmark::State& state, StageData& data, int threads)
{
  StyleEnergy energy = data.MakeEnergy(threads);
  for (auto _ : state)
  {
    energy.PrepareSteps(data.Cells);
  }
  Points b;
  energy.RightHandSide(data.R, b);
  Report(state, data, 0.0, HashOf(b));
}

void RightHandSide(benchmark::State& state, StageData& data, int threads)
{
  StyleEnergy energy = data.MakeEnergy(threads);
  Points b;
  while (state.KeepRunning())
  {
    energy.RightHandSide(data.R, b);
    benchmark::ClobberMemory();
  }
  // P, t; R; b
  Report(state, data, data.Bytes(3, 1), HashOf(b));
}

void Value(benchmark::State& state, StageData& data, int threads)
{
  const StyleEnergy energy = data.MakeEnergy(threads);
  double total = 0.0;
  while (state.KeepRunning())
  {
    total = energy.Evaluate(data.Q, data.R).Total();
    benchmark::DoNotOptimize(total);
  }
  // P, t, P'; R
  Report(state, data, data.Bytes(3, 1), Hash(&total, sizeof total));
}

void Iteration(benchmark::State& state, StageData& data, int threads)
{
  StyleEnergy energy = data.MakeEnergy(threads);
  Points Q = data.Q;
  Matrices R = data.R;
  while (state.KeepRunning())
  {
    data.Iterate(energy, Q, R);
  }
  Q = data.Q; // the number of iterations is not the same in every run
  R = data.R;
  data.Iterate(energy, Q, R, 2);
  Report(state, data, 0.0, HashOf(Q));
}

//------------------------------------------------------------------------------ the whole solver
void Whole(benchmark::State& state, const StageData& data, const MethodOptions& options)
{
  Points Q;
  int iterations = 0;
  while (state.KeepRunning())
  {
    SphericalStyleMethod method;
    method.SetMesh(data.Mesh);
    iterations = method.Solve(options).loop.iterations;
    state.PauseTiming();
    Q = method.GetPositions();
    state.ResumeTiming();
  }
  Report(state, data, 0.0, HashOf(Q));
  state.counters["iterations"] = iterations;
}

MethodOptions Options(double detailSize, SphericalWeighting weighting)
{
  MethodOptions options;
  options.lambda = Roundness;
  options.centerMode = CenterMode::AreaCentroid;
  options.detailSize = detailSize;
  options.sphericalWeighting = weighting;
  return options;
}
}

void RegisterSolverStages(const MeshKey& key, int threads)
{
  using Body = void (*)(benchmark::State&, StageData&, int);
  const std::pair<const char*, Body> stages[] = { { "Topology", Topology },
    { "Cotangents", Cotangents }, { "Weights", Weights }, { "Splat", Splat }, { "Walls", Walls },
    { "Base", Base }, { "Limbs", Limbs }, { "Carry", Carry }, { "Targets", Targets },
    { "PrepareSteps", PrepareSteps }, { "Matrix", Matrix }, { "Ordering", Ordering },
    { "Factorization", Factorization }, { "Covariances", Covariances }, { "Rotations", Rotations },
    { "LocalStep", LocalStep }, { "RightHandSide", RightHandSide },
    { "Solve", Solve<SparseCholesky::Precision::Double> },
    { "SolveSingle", Solve<SparseCholesky::Precision::Single> }, { "Energy", Value },
    { "Iteration", Iteration } };
  for (const auto& [name, body] : stages)
  {
    Register(name, key, threads, body);
  }
  const std::pair<const char*, MethodOptions> wholes[] = {
    { "Solver:default", Options(0.0, SphericalWeighting::Cotangent) },
    { "Solver:details", Options(DetailSize, SphericalWeighting::Cotangent) },
    { "Solver:uniform", Options(0.0, SphericalWeighting::Uniform) }
  };
  for (const auto& [name, given] : wholes)
  {
    MethodOptions options = given;
    options.threads = threads;
    Register(name, key, threads,
      [options](benchmark::State& state, const StageData& data, int)
      { Whole(state, data, options); });
  }
}
} // namespace Benchmarks
