// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceMeasures.h"

#include "EdgeWeights.h"

#include <Eigen/Geometry>

#include <cmath>

namespace SphericalStyle
{
namespace
{
Eigen::Vector3d AreaVector(const Points& P, const Triangles& F, Eigen::Index f)
{
  const Eigen::Vector3d a = P.row(F(f, 0));
  const Eigen::Vector3d b = P.row(F(f, 1));
  const Eigen::Vector3d c = P.row(F(f, 2));
  return 0.5 * (b - a).cross(c - a);
}

Points CotangentLaplacianVectors(const Points& P, const Triangles& F, const HalfEdgeScalars& c)
{
  Points result = Points::Zero(P.rows(), 3);
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int u = F(f, HalfEdgeStart(k));
      const int v = F(f, HalfEdgeEnd(k));
      const Eigen::RowVector3d flow = c(f, k) * (P.row(u) - P.row(v));
      result.row(u) += flow;
      result.row(v) -= flow;
    }
  }
  return result;
}
}

Eigen::VectorXd TriangleAreas(const Points& P, const Triangles& F)
{
  Eigen::VectorXd area(F.rows());
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    area(f) = AreaVector(P, F, f).norm();
  }
  return area;
}

Eigen::VectorXd PointAreas(const Points& P, const Triangles& F)
{
  const Eigen::VectorXd area = TriangleAreas(P, F);
  Eigen::VectorXd lumped = Eigen::VectorXd::Zero(P.rows());
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      lumped(F(f, k)) += area(f) / 3.0;
    }
  }
  return lumped;
}

double EnclosedVolume(const Points& P, const Triangles& F)
{
  const Eigen::Vector3d apex = P.colwise().mean();
  double volume = 0.0;
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    volume += AreaVector(P, F, f).dot(P.row(F(f, 0)).transpose() - apex) / 3.0;
  }
  return volume;
}

Eigen::Vector3d AreaCentroid(const Points& P, const Triangles& F)
{
  const Eigen::VectorXd area = PointAreas(P, F);
  return (P.transpose() * area) / area.sum();
}

Points TriangleNormals(const Points& P, const Triangles& F)
{
  Points normals(F.rows(), 3);
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    normals.row(f) = AreaVector(P, F, f).stableNormalized().transpose();
  }
  return normals;
}

Points PointNormals(const Points& P, const Triangles& F)
{
  Points normals = Points::Zero(P.rows(), 3);
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    const Eigen::Vector3d area = AreaVector(P, F, f);
    const double size = area.norm();
    if (!(size > 0.0))
    {
      continue;
    }
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::Vector3d x = P.row(F(f, HalfEdgeStart(k))) - P.row(F(f, k));
      const Eigen::Vector3d y = P.row(F(f, HalfEdgeEnd(k))) - P.row(F(f, k));
      normals.row(F(f, k)) += std::atan2(2.0 * size, x.dot(y)) / size * area.transpose();
    }
  }
  for (Eigen::Index i = 0; i < normals.rows(); ++i)
  {
    // The sum has the size of an angle: far below that, the triangles cancel.
    const double size = normals.row(i).norm();
    if (size > 1e-12)
    {
      normals.row(i) /= size;
    }
    else
    {
      normals.row(i).setZero();
    }
  }
  return normals;
}

double Sphericity(const Points& P, const Triangles& F)
{
  const double volume = std::abs(EnclosedVolume(P, F));
  return std::cbrt(Pi) * std::pow(6.0 * volume, 2.0 / 3.0) / TriangleAreas(P, F).sum();
}

double RadiusSpread(const Points& P, const Eigen::Vector3d& center)
{
  const Eigen::VectorXd radius = (P.rowwise() - center.transpose()).rowwise().norm();
  const double mean = radius.mean();
  return std::sqrt((radius.array() - mean).square().mean()) / mean;
}

double DetailError(const Points& P, const Points& Q, const Triangles& F, const Matrices& R)
{
  const HalfEdgeScalars c = HalfEdgeCotangents(P, F);
  const Points rest = CotangentLaplacianVectors(P, F, c);
  const Points deformed = CotangentLaplacianVectors(Q, F, c);
  double sum = 0.0;
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    sum += (deformed.row(i).transpose() - R[i] * rest.row(i).transpose()).squaredNorm();
  }
  const double diagonal = (P.colwise().maxCoeff() - P.colwise().minCoeff()).norm();
  return std::sqrt(sum / static_cast<double>(P.rows())) / diagonal;
}
} // namespace SphericalStyle
