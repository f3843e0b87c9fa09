// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceMeasures.h"

#include "UnitScale.h"

#include <Eigen/Geometry>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

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
}

bool IsDegenerate(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  constexpr double SmallestAngle = 1e-10;
  const Eigen::Vector3d x = b - a;
  const Eigen::Vector3d y = c - a;
  const double longest = std::max({ x.stableNorm(), y.stableNorm(), (y - x).stableNorm() });
  return !(longest > 0.0) || !((x / longest).cross(y / longest).norm() > SmallestAngle);
}

Points AtUnitSize(const Points& P)
{
  return UnitScale(P) * P;
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

double TripleProduct(const Points& P, const Triangles& F, Eigen::Index f, const Eigen::Vector3d& O)
{
  const Eigen::Vector3d a = P.row(F(f, 0)).transpose() - O;
  const Eigen::Vector3d b = P.row(F(f, 1)).transpose() - O;
  const Eigen::Vector3d c = P.row(F(f, 2)).transpose() - O;
  return a.dot(b.cross(c));
}

double SolidAngle(const Points& P, const Triangles& F, Eigen::Index f, const Eigen::Vector3d& O)
{
  Eigen::Matrix3d x;
  for (int k = 0; k < 3; ++k)
  {
    x.col(k) = P.row(F(f, k)).transpose() - O;
  }
  const Eigen::RowVector3d r = x.colwise().norm();
  const double below = r.prod() + x.col(0).dot(x.col(1)) * r(2) + x.col(1).dot(x.col(2)) * r(0) +
    x.col(2).dot(x.col(0)) * r(1);
  return 2.0 * std::atan2(TripleProduct(P, F, f, O), below);
}

Eigen::Vector3d PointMean(const Points& P, const SurfacePart& part)
{
  if (part.IsWhole())
  {
    return P.colwise().mean();
  }
  Eigen::Vector4d sums = Eigen::Vector4d::Zero();
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    if (part.Counts(i))
    {
      sums += P.row(i).transpose().homogeneous();
    }
  }
  part.Sum(sums);
  return sums.head<3>() / sums(3);
}

double EnclosedVolume(const Points& P, const Triangles& F, const SurfacePart& part)
{
  const Eigen::Vector3d apex = PointMean(P, part);
  double volume = 0.0;
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    volume += AreaVector(P, F, f).dot(P.row(F(f, 0)).transpose() - apex) / 3.0;
  }
  return part.Sum(volume);
}

double BallRadius(double volume)
{
  return std::cbrt(std::abs(volume) * 3.0 / (4.0 * Pi));
}

double VolumeAmbiguity(const Points& P, const Triangles& F, const SurfacePart& part)
{
  const auto [low, high] = BoundsOf(P, part);
  const Points unit = UnitScale(low.cwiseAbs().cwiseMax(high.cwiseAbs())) * P;
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    area += AreaVector(unit, F, f);
  }
  part.Sum(area);
  return area.norm() / (4.0 * Pi * std::pow(BallRadius(EnclosedVolume(unit, F, part)), 2));
}

Eigen::Vector3d AreaCentroid(const Points& P, const Triangles& F, const SurfacePart& part)
{
  const Eigen::VectorXd area = PointAreas(P, F);
  Eigen::Vector4d sums;
  sums << P.transpose() * area, area.sum();
  part.Sum(sums);
  return sums.head<3>() / sums(3);
}

Eigen::Matrix3d AreaMoments(const Points& P, const Triangles& F, const SurfacePart& part)
{
  const Eigen::Vector3d O = AreaCentroid(P, F, part);
  const Eigen::VectorXd areas = TriangleAreas(P, F);
  Eigen::Matrix<double, 3, 4> sums = Eigen::Matrix<double, 3, 4>::Zero(); // with the area
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    Eigen::Matrix<double, 3, 4> corners; // and their sum
    for (int k = 0; k < 3; ++k)
    {
      corners.col(k) = P.row(F(f, k)).transpose() - O;
    }
    corners.col(3) = corners.leftCols<3>().rowwise().sum();
    sums.leftCols<3>() += areas(f) / 12.0 * corners * corners.transpose();
    sums(0, 3) += areas(f);
  }
  part.Sum(sums);
  return sums.leftCols<3>() / sums(0, 3);
}

Points TriangleNormals(const Points& P, const Triangles& F)
{
  const Points unit = AtUnitSize(P);
  Points normals(F.rows(), 3);
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    normals.row(f) = AreaVector(unit, F, f).stableNormalized().transpose();
  }
  return normals;
}

Points PointNormals(const Points& P, const Triangles& F, const SurfacePart& part)
{
  Points normals = PointNormalSums(P, F);
  part.SumAtShared(normals.data(), 3);
  NormalizeSums(normals);
  return normals;
}

Points PointNormalSums(const Points& P, const Triangles& F)
{
  const Points unit = AtUnitSize(P);
  Points normals = Points::Zero(P.rows(), 3);
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    const Eigen::Vector3d area = AreaVector(unit, F, f);
    const double size = area.norm();
    if (!(size > 0.0))
    {
      continue;
    }
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::Vector3d x = unit.row(F(f, HalfEdgeStart(k))) - unit.row(F(f, k));
      const Eigen::Vector3d y = unit.row(F(f, HalfEdgeEnd(k))) - unit.row(F(f, k));
      normals.row(F(f, k)) += std::atan2(2.0 * size, x.dot(y)) / size * area.transpose();
    }
  }
  return normals;
}

void NormalizeSums(Points& normals)
{
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
}

double Sphericity(const Points& P, const Triangles& F, const SurfacePart& part)
{
  const auto [low, high] = BoundsOf(P, part);
  const Points unit = UnitScale(low.cwiseAbs().cwiseMax(high.cwiseAbs())) * P;
  const double volume = std::abs(EnclosedVolume(unit, F, part));
  return std::cbrt(Pi) * std::pow(6.0 * volume, 2.0 / 3.0) / part.Sum(TriangleAreas(unit, F).sum());
}

namespace
{
/// The points that count here.
Points ThatCount(const Points& P, const SurfacePart& part)
{
  if (part.IsWhole())
  {
    return P;
  }
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    if (part.Counts(i))
    {
      rows.push_back(i);
    }
  }
  return P(rows, AllColumns);
}

double LargestNumber(const Points& x, const SurfacePart& part)
{
  return part.Max(x.size() > 0 ? x.cwiseAbs().maxCoeff() : 0.0);
}

double SumOfSquares(const Eigen::ArrayXd& x, const SurfacePart& part)
{
  return part.Sum(x.square().sum());
}
}

double RadiusSpread(const Points& P, const Eigen::Vector3d& center, const SurfacePart& part)
{
  Points x = ThatCount(P, part).rowwise() - center.transpose();
  const auto count = part.Sum(static_cast<double>(x.rows()));
  x *= UnitScale(Eigen::Array<double, 1, 1>(LargestNumber(x, part)));
  const Eigen::ArrayXd radius = x.rowwise().norm();
  const double mean = part.Sum(radius.sum()) / count;
  return std::sqrt(SumOfSquares(radius - mean, part) / count) / mean;
}

namespace
{
/// Rows [A b] of a least-squares problem.
using SphereRows = Eigen::Matrix<double, Eigen::Dynamic, 5>;

/// Rows with the same solution, few where the surface is spread: each process gives the triangle of
/// a QR decomposition of its own (Demmel et al., Communication-optimal parallel and sequential QR
/// and LU factorizations, 2012).
SphereRows RowsOfAll(SphereRows own, const SurfacePart& part)
{
  if (part.IsWhole())
  {
    return own;
  }
  if (own.rows() > 5)
  {
    const Eigen::HouseholderQR<SphereRows> qr(own);
    own = qr.matrixQR().topRows<5>().template triangularView<Eigen::Upper>().toDenseMatrix();
  }
  const Eigen::Matrix<double, Eigen::Dynamic, 5, Eigen::RowMajor> rows = own;
  const std::vector<double> all = part.Concatenate({ rows.data(), rows.data() + rows.size() });
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 5, Eigen::RowMajor>>(
    all.data(), static_cast<Eigen::Index>(all.size()) / 5, 5);
}

double MeanSquareDistance(
  const Points& x, double count, const FittedSphere& sphere, const SurfacePart& part)
{
  const Eigen::ArrayXd distance = (x.rowwise() - sphere.center.transpose()).rowwise().norm();
  return SumOfSquares(distance - sphere.radius, part) / count;
}

/// Gauss-Newton on the distances, from the algebraic fit, until steps are small or lead away. The
/// sum of squares alone tells no step below 1e-8.
void RefineSphere(const Points& x, double count, const SurfacePart& part, FittedSphere& sphere)
{
  constexpr double Growth = 1.0 + 1e-12; // of the error by rounding
  constexpr double Settled = 1e-14;
  constexpr double NearlySettled = 1e-11; // where steps that shrink no more are rounding
  double error = MeanSquareDistance(x, count, sphere, part);
  double before = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 50; ++step)
  {
    SphereRows J(x.rows(), 5);
    J.leftCols<3>() = x.rowwise() - sphere.center.transpose();
    const Eigen::ArrayXd distance = J.leftCols<3>().rowwise().norm();
    if (part.Max(distance.size() > 0 && !(distance.minCoeff() > 0.0) ? 1.0 : 0.0) > 0.0)
    {
      return;
    }
    J.leftCols<3>().array().colwise() /= distance;
    J.col(3).setOnes();
    J.col(4) = distance - sphere.radius;
    const SphereRows rows = RowsOfAll(std::move(J), part);
    const Eigen::Vector4d change =
      Eigen::MatrixX4d(rows.leftCols<4>()).colPivHouseholderQr().solve(rows.col(4));
    FittedSphere next = sphere;
    next.center += change.head<3>();
    next.radius += change(3);
    const double now = MeanSquareDistance(x, count, next, part);
    if (!(now <= Growth * error))
    {
      return;
    }
    sphere = next;
    error = now;
    const double size = change.norm();
    if (size <= Settled || (size <= NearlySettled && size > 0.5 * before))
    {
      return;
    }
    before = size;
  }
}
}

FittedSphere FitSphere(const Points& P, const SurfacePart& part)
{
  constexpr double None = std::numeric_limits<double>::quiet_NaN();
  Points x = ThatCount(P, part);
  const auto count = part.Sum(static_cast<double>(x.rows()));
  Eigen::RowVector3d mean = x.colwise().sum();
  part.Sum(mean);
  mean /= count;
  x.rowwise() -= mean;
  const double size = LargestNumber(x, part);
  x /= size > 0.0 ? size : 1.0;
  // |x|^2 = 2 c.x + (r^2 - |c|^2), linear in c and the bracket
  SphereRows own(x.rows(), 5);
  own << 2.0 * x, Eigen::VectorXd::Ones(x.rows()), x.rowwise().squaredNorm();
  const SphereRows rows = RowsOfAll(std::move(own), part);
  Eigen::ColPivHouseholderQR<Eigen::MatrixX4d> qr(rows.leftCols<4>());
  qr.setThreshold(1e-9);
  if (qr.rank() < 4)
  {
    return { Eigen::Vector3d::Constant(None), None, None };
  }
  const Eigen::Vector4d fit = qr.solve(rows.col(4));
  FittedSphere sphere;
  sphere.center = fit.head<3>();
  sphere.radius = std::sqrt(fit(3) + sphere.center.squaredNorm());
  RefineSphere(x, count, part, sphere);
  sphere.error = std::sqrt(MeanSquareDistance(x, count, sphere, part)) / sphere.radius;
  sphere.center = size * sphere.center + mean.transpose();
  sphere.radius *= size;
  return sphere;
}

Eigen::VectorXd RadialCosines(const Points& P, const Points& normals, const Eigen::Vector3d& center)
{
  Eigen::VectorXd cosine = Eigen::VectorXd::Zero(P.rows());
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    const Eigen::RowVector3d d = P.row(i) - center.transpose();
    const double distance = d.stableNorm();
    cosine(i) = distance > 0.0 ? d.dot(normals.row(i)) / distance : 0.0;
  }
  return cosine;
}
} // namespace SphericalStyle
