// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshQuality.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace SphericalStyle
{
namespace
{
int StartPoint(const Triangles& F, int h)
{
  return F(h / 3, HalfEdgeStart(h % 3));
}

int EndPoint(const Triangles& F, int h)
{
  return F(h / 3, HalfEdgeEnd(h % 3));
}

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

EdgeCounts CountEdges(const Triangles& F, const MeshEdges& edges)
{
  EdgeCounts counts;
  counts.closed = F.rows() > 0;
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    const int balance = EdgeBalance(F, edges, e);
    const int valence = edges.GetValence(e);
    counts.border += valence == 1;
    counts.nonManifold += valence > 2;
    counts.misoriented += valence == 2 && balance != 0;
    counts.closed &= balance == 0;
  }
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

WeightReport CheckWeights(const HalfEdgeScalars& c, const MeshEdges& edges)
{
  WeightReport report;
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    const double w = EdgeSum(c, edges, e);
    if (w < -RightAngle)
    {
      ++report.negative;
      // Each triangle at the edge brings lambda / 2 (two of them: w + lambda).
      report.lambdaStar = std::max(report.lambdaStar, -2.0 * w / edges.GetValence(e));
    }
  }
  return report;
}

Eigen::VectorXd DihedralAngles(const Points& P, const Triangles& F, const MeshEdges& edges)
{
  Eigen::VectorXd angles(edges.GetNumberOfEdges());
  Eigen::Index number = 0;
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    if (edges.GetValence(e) != 2)
    {
      continue;
    }
    const int g = edges.GetHalfEdges()[edges.GetOffset()[e]];
    const int h = edges.GetHalfEdges()[edges.GetOffset()[e] + 1];
    const Eigen::Vector3d along = P.row(EndPoint(F, g)) - P.row(StartPoint(F, g));
    const Eigen::Vector3d first = UnitNormal(P, F, g / 3);
    const bool misoriented = StartPoint(F, g) == StartPoint(F, h);
    const Eigen::Vector3d second = (misoriented ? -1.0 : 1.0) * UnitNormal(P, F, h / 3);
    angles(number++) =
      std::atan2(along.stableNormalized().dot(first.cross(second)), first.dot(second));
  }
  return angles.head(number);
}

OppositionReport FindOpposition(
  const Points& P, const Points& normals, const Triangles& F, const MeshEdges& edges)
{
  OppositionReport report;
  report.share = Eigen::VectorXd::Zero(P.rows());
  Eigen::VectorXd count = Eigen::VectorXd::Zero(P.rows());
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    const int h = edges.GetHalfEdges()[edges.GetOffset()[e]];
    const int u = StartPoint(F, h);
    const int v = EndPoint(F, h);
    const Eigen::RowVector3d edge = (P.row(u) - P.row(v)).stableNormalized();
    const bool opposed = edge.dot(normals.row(u) - normals.row(v)) < -RightAngle;
    report.edges += opposed;
    for (const int i : { u, v })
    {
      report.share(i) += opposed;
      count(i) += 1.0;
    }
  }
  report.share = report.share.array() / count.array().max(1.0);
  return report;
}
} // namespace SphericalStyle
