// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The stages of the method in closed form with the defaults of the filter, each through its public
// header.
#include "ClosedFormStyle.h"
#include "LimbThickness.h"
#include "Stages.h"

namespace Benchmarks
{
namespace
{
using namespace SphericalStyle;

/// As vtkSphericalStyleFilter has it.
ClosedFormOptions Defaults(int threads)
{
  ClosedFormOptions options;
  options.lambda = 1.0;
  options.normalBlend = 0.6;
  options.detailSize = 0.06;
  options.size.keep = KeepSize::Area;
  options.threads = threads;
  return options;
}

struct ClosedFormData
{
  explicit ClosedFormData(const MeshKey& key)
    : Mesh(MakeFramedMesh(key))
    , Options(Defaults(1))
    , Grid(Mesh.P, Mesh.F, Options.detailSize, 1)
    , Walls(FindWalls(Grid, Mesh.P, Mesh.F, 1))
  {
    this->Grid.Factor(this->Walls, 1);
    this->Base = this->MakeBase(1);
    this->Radius =
      TargetSphere(this->Base, this->Mesh.F, this->Options.centerMode, this->Options.radiusMode, {})
        .radius;
  }

  Points MakeBase(int threads) const
  {
    const Fields base = this->Grid.SmoothTwice(this->Grid.GetPlaces(), threads);
    return this->Grid.AtPoints(base, this->Mesh.P, threads);
  }

  TriangleMesh Mesh;
  ClosedFormOptions Options;
  SurfaceGrid Grid;
  std::vector<GridPair> Walls;
  Points Base;
  double Radius = 0.0;
};

void Splat(benchmark::State& state, ClosedFormData& data, int threads)
{
  SurfaceGrid grid;
  for (auto _ : state)
  {
    grid = SurfaceGrid(data.Mesh.P, data.Mesh.F, data.Options.detailSize, threads);
  }
  Report(state, data.Mesh.P.rows(), HashOf(grid.GetWeights()));
  state.counters["samples"] = grid.GetNumberOfSamples();
}

void Walls(benchmark::State& state, ClosedFormData& data, int threads)
{
  std::vector<GridPair> walls;
  for (auto _ : state)
  {
    walls = FindWalls(data.Grid, data.Mesh.P, data.Mesh.F, threads);
  }
  Report(state, data.Mesh.P.rows(), HashOf(walls));
  state.counters["pairs"] = static_cast<double>(walls.size());
}

void GridFactor(benchmark::State& state, ClosedFormData& data, int threads)
{
  for (auto _ : state)
  {
    data.Grid.Factor(data.Walls, threads);
  }
  Report(state, data.Mesh.P.rows(), HashOf(data.MakeBase(threads)));
  state.counters["functions"] = data.Grid.GetNumberOfFunctions();
}

void Base(benchmark::State& state, ClosedFormData& data, int threads)
{
  Points base;
  for (auto _ : state)
  {
    base = data.MakeBase(threads);
  }
  Report(state, data.Mesh.P.rows(), HashOf(base));
}

void Gradients(benchmark::State& state, ClosedFormData& data, int threads)
{
  Fields gradients;
  for (auto _ : state)
  {
    gradients = data.Grid.Gradients(data.Base, threads);
  }
  Report(state, data.Mesh.P.rows(), HashOf(gradients));
}

void Limbs(benchmark::State& state, ClosedFormData& data, int threads)
{
  Eigen::VectorXd thickness;
  for (auto _ : state)
  {
    thickness = LimbThickness(data.Mesh.P, data.Base, data.Mesh.F, data.Radius, threads);
  }
  Report(state, data.Mesh.P.rows(), HashOf(thickness));
}

void FirstResult(benchmark::State& state, ClosedFormData& data, int threads)
{
  ClosedFormStyle style;
  for (auto _ : state)
  {
    style.SetMesh(data.Mesh.P, data.Mesh.F);
    style.Solve(Defaults(threads));
  }
  Report(state, data.Mesh.P.rows(), HashOf(style.GetPositions()));
}

/// What a moved center, or another Roundness, redoes.
void Update(benchmark::State& state, ClosedFormData& data, int threads)
{
  ClosedFormStyle style;
  style.SetMesh(data.Mesh.P, data.Mesh.F);
  const ClosedFormOptions options = Defaults(threads);
  style.Solve(options);
  for (auto _ : state)
  {
    style.Solve(options); // compares no options: it is as much work as for other ones
  }
  Report(state, data.Mesh.P.rows(), HashOf(style.GetPositions()));
}
}

void RegisterClosedFormStages(const MeshKey& key, int threads)
{
  using Body = void (*)(benchmark::State&, ClosedFormData&, int);
  const std::pair<const char*, Body> stages[] = { { "Splat", Splat }, { "Walls", Walls },
    { "GridFactor", GridFactor }, { "Base", Base }, { "Gradients", Gradients }, { "Limbs", Limbs },
    { "FirstResult", FirstResult }, { "Update", Update } };
  for (const auto& [name, body] : stages)
  {
    Register(name, key, threads, body);
  }
}
} // namespace Benchmarks
