// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "GlobalStep.h"

#include "Stopwatch.h"

namespace SphericalStyle
{
GlobalStep::GlobalStep(
  const MeshTopology& topology, const std::vector<int>& pinned, LinearMethod method)
  : Topology(&topology)
  , Fixed(topology.GetNumberOfPoints(), 0)
  , ComponentIsPinned(topology.GetNumberOfComponents(), 0)
  , System(method)
{
  for (const int i : pinned)
  {
    this->Fixed[i] = 1;
    this->ComponentIsPinned[topology.GetComponents()[i]] = 1;
  }
  for (int c = 0; c < topology.GetNumberOfComponents(); ++c)
  {
    if (!this->ComponentIsPinned[c])
    {
      this->Fixed[topology.GetLastPoints()[c]] = 1;
    }
  }
}

/// Where half-edges add, and those between a free and a fixed point.
void GlobalStep::BuildMatrix()
{
  this->Matrix = EdgeMatrix(*this->Topology, this->Fixed);
  const Triangles& F = this->Topology->GetTriangles();
  const std::vector<int>& rows = this->Matrix.GetRows();
  for (int h = 0; h < static_cast<int>(F.size()); ++h)
  {
    const int u = StartPoint(F, h);
    const int v = EndPoint(F, h);
    if (rows[u] >= 0 && rows[v] < 0)
    {
      this->Borders.push_back({ rows[u], v, h });
    }
    else if (rows[u] < 0 && rows[v] >= 0)
    {
      this->Borders.push_back({ rows[v], u, h });
    }
  }
}

bool GlobalStep::SetWeights(const HalfEdgeScalars& k, double scale, int threads)
{
  this->Scale = scale;
  this->AnalyzeSeconds = this->FactorSeconds = 0.0;
  if (this->Factored.size() == k.size() && this->Factored == k)
  {
    return false;
  }
  this->Factored.resize(0, 3); // nothing is factored if the next lines throw
  const Stopwatch analyze;
  if (!this->Analyzed)
  {
    this->BuildMatrix();
  }
  if (this->Matrix.GetNumberOfRows() > 0)
  {
    const SparseCholesky::Matrix& A = this->Matrix.Assemble(3.0 * k);
    if (!this->Analyzed)
    {
      this->System.Analyze(A);
      this->Analyzed = true;
    }
    this->AnalyzeSeconds = analyze.Seconds();
    const Stopwatch factor;
    this->System.Factor(A, threads);
    this->FactorSeconds = factor.Seconds();
  }
  this->Factored = k;
  return true;
}

void GlobalStep::Solve(const Points& b, Points& Q, int threads)
{
  const std::vector<int>& rows = this->Matrix.GetRows();
  this->Right.resize(this->Matrix.GetNumberOfRows(), 3);
  this->Solution.resize(this->Right.rows(), 3);
  if (this->Right.rows() == 0)
  {
    return;
  }
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    if (const auto point = static_cast<Eigen::Index>(i); rows[i] >= 0)
    {
      this->Right.row(rows[i]) = b.row(point) / this->Scale;
      this->Solution.row(rows[i]) = Q.row(point);
    }
  }
  for (const Border& border : this->Borders)
  {
    this->Right.row(border.row) +=
      3.0 * this->Factored.data()[border.halfEdge] * Q.row(border.fixedPoint);
  }
  this->System.Solve(this->Right, this->Solution, threads);
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    if (rows[i] >= 0)
    {
      Q.row(static_cast<Eigen::Index>(i)) = this->Solution.row(rows[i]);
    }
  }
}
} // namespace SphericalStyle
