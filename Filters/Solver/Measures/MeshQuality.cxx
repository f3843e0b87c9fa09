// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshQuality.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace SphericalStyle
{
namespace
{
Eigen::Vector3d UnitNormal(const Points& P, const Triangles& F, Eigen::Index f)
{
  const Eigen::Vector3d a = P.row(F(f, 1)) - P.row(F(f, 0));
  const Eigen::Vector3d b = P.row(F(f, 2)) - P.row(F(f, 0));
  return a.cross(b).stableNormalized();
}
}

int EdgeBalance(const Triangles& F, const MeshEdges& edges, int e)
{
  int balance = 0;
  for (int i = edges.GetOffset()[e]; i < edges.GetOffset()[e + 1]; ++i)
  {
    const int h = edges.GetHalfEdges()[i];
    balance += StartPoint(F, h) < EndPoint(F, h) ? 1 : -1;
  }
  return balance;
}

EdgeCounts CountEdges(const Triangles& F, const MeshEdges& edges, const EdgePart& part)
{
  // Triangles at an edge, and EdgeBalance.
  using Row = Eigen::Matrix<double, 1, 2>;
  std::vector<Row> rows;
  for (const int e : part.GetShared())
  {
    const double turn = part.IsTurned(static_cast<int>(rows.size())) ? -1.0 : 1.0;
    rows.emplace_back(edges.GetValence(e), turn * EdgeBalance(F, edges, e));
  }
  part.SumRows(rows.empty() ? nullptr : rows.front().data(), 2);
  Eigen::Array<double, 6, 1> sums; // edges, border, not manifold, misoriented, open, triangles
  sums.setZero();
  sums(5) = static_cast<double>(F.rows());
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    if (!part.Counts(e))
    {
      continue;
    }
    const int row = part.GetRow(e);
    const double balance = row < 0 ? EdgeBalance(F, edges, e) : rows[row](1);
    const double valence = row < 0 ? edges.GetValence(e) : rows[row](0);
    sums(0) += 1.0;
    sums(1) += valence == 1.0;
    sums(2) += valence > 2.0;
    sums(3) += valence == 2.0 && balance != 0.0;
    sums(4) += balance != 0.0;
  }
  part.GetProcesses().Sum(sums);
  EdgeCounts counts;
  counts.edges = static_cast<Eigen::Index>(sums(0));
  counts.border = static_cast<Eigen::Index>(sums(1));
  counts.nonManifold = static_cast<Eigen::Index>(sums(2));
  counts.misoriented = static_cast<Eigen::Index>(sums(3));
  counts.closed = sums(4) == 0.0 && sums(5) > 0.0;
  return counts;
}

Eigen::MatrixX2d ExtremeAngles(const Points& P, const Triangles& F)
{
  Eigen::MatrixX2d angles(F.rows(), 2);
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    Eigen::Vector3d angle;
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::Vector3d x = P.row(F(f, HalfEdgeStart(k))) - P.row(F(f, k));
      const Eigen::Vector3d y = P.row(F(f, HalfEdgeEnd(k))) - P.row(F(f, k));
      angle[k] = std::atan2(x.cross(y).norm(), x.dot(y)) * 180.0 / Pi;
    }
    angles.row(f) << angle.minCoeff(), angle.maxCoeff();
  }
  return angles;
}

double EdgeSum(const HalfEdgeScalars& c, const MeshEdges& edges, int e)
{
  double sum = 0.0;
  for (int i = edges.GetOffset()[e]; i < edges.GetOffset()[e + 1]; ++i)
  {
    sum += c.data()[edges.GetHalfEdges()[i]];
  }
  return sum;
}

WeightReport CheckWeights(const HalfEdgeScalars& c, const MeshEdges& edges, const EdgePart& part)
{
  using Row = Eigen::Matrix<double, 1, 2>; // w, and triangles at the edge
  std::vector<Row> rows;
  for (const int e : part.GetShared())
  {
    rows.emplace_back(EdgeSum(c, edges, e), edges.GetValence(e));
  }
  part.SumRows(rows.empty() ? nullptr : rows.front().data(), 2);
  double negative = 0.0;
  double lambdaStar = 0.0;
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    const int row = part.GetRow(e);
    const double w = row < 0 ? EdgeSum(c, edges, e) : rows[row](0);
    const double valence = row < 0 ? edges.GetValence(e) : rows[row](1);
    if (part.Counts(e) && w < -RightAngle)
    {
      ++negative;
      // Each triangle at the edge brings lambda / 2 (two of them: w + lambda).
      lambdaStar = std::max(lambdaStar, -2.0 * w / valence);
    }
  }
  WeightReport report;
  report.negative = static_cast<Eigen::Index>(part.GetProcesses().Sum(negative));
  report.lambdaStar = part.GetProcesses().Max(lambdaStar);
  return report;
}

namespace
{
/// What the processes have of an edge: triangles, EdgeBalance, and the normal of the triangle of
/// the process on which the edge does not count.
using EdgeSides = Eigen::Matrix<double, 1, 5>;

std::vector<EdgeSides> SidesOfShared(
  const Points& P, const Triangles& F, const MeshEdges& edges, const EdgePart& part)
{
  std::vector<EdgeSides> sides;
  for (const int e : part.GetShared())
  {
    const double turn = part.IsTurned(static_cast<int>(sides.size())) ? -1.0 : 1.0;
    EdgeSides own = EdgeSides::Zero();
    own.head<2>() << edges.GetValence(e), turn * EdgeBalance(F, edges, e);
    if (!part.Counts(e))
    {
      own.tail<3>() = UnitNormal(P, F, edges.GetHalfEdges()[edges.GetOffset()[e]] / 3);
    }
    sides.push_back(own);
  }
  part.SumRows(sides.empty() ? nullptr : sides.front().data(), 5);
  return sides;
}
}

Eigen::VectorXd DihedralAngles(
  const Points& P, const Triangles& F, const MeshEdges& edges, const EdgePart& part)
{
  const std::vector<EdgeSides> sides = SidesOfShared(P, F, edges, part);
  Eigen::VectorXd angles(edges.GetNumberOfEdges());
  Eigen::Index number = 0;
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    const int row = part.GetRow(e);
    if (!part.Counts(e) || (row < 0 ? edges.GetValence(e) : sides[row](0)) != 2)
    {
      continue;
    }
    const int g = edges.GetHalfEdges()[edges.GetOffset()[e]];
    const Eigen::Vector3d along = P.row(EndPoint(F, g)) - P.row(StartPoint(F, g));
    const Eigen::Vector3d first = UnitNormal(P, F, g / 3);
    Eigen::Vector3d second;
    bool misoriented = false;
    if (edges.GetValence(e) == 2)
    {
      const int h = edges.GetHalfEdges()[edges.GetOffset()[e] + 1];
      misoriented = StartPoint(F, g) == StartPoint(F, h);
      second = UnitNormal(P, F, h / 3);
    }
    else
    {
      misoriented = sides[row](1) != 0.0;
      second = sides[row].tail<3>();
    }
    second *= misoriented ? -1.0 : 1.0;
    angles(number++) =
      std::atan2(along.stableNormalized().dot(first.cross(second)), first.dot(second));
  }
  return angles.head(number);
}

OppositionReport FindOpposition(const Points& P, const Points& normals, const Triangles& F,
  const MeshEdges& edges, const SurfacePart& points, const EdgePart& part)
{
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> sums; // opposed edges, edges
  sums.setZero(P.rows(), 2);
  double opposedEdges = 0.0;
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    if (!part.Counts(e))
    {
      continue;
    }
    const int h = edges.GetHalfEdges()[edges.GetOffset()[e]];
    const int u = StartPoint(F, h);
    const int v = EndPoint(F, h);
    const Eigen::RowVector3d edge = (P.row(u) - P.row(v)).stableNormalized();
    const bool opposed = edge.dot(normals.row(u) - normals.row(v)) < -RightAngle;
    opposedEdges += opposed;
    for (const int i : { u, v })
    {
      sums(i, 0) += opposed;
      sums(i, 1) += 1.0;
    }
  }
  points.SumAtShared(sums.data(), 2);
  OppositionReport report;
  report.edges = static_cast<Eigen::Index>(points.Sum(opposedEdges));
  report.share = sums.col(0).array() / sums.col(1).array().max(1.0);
  return report;
}
} // namespace SphericalStyle
