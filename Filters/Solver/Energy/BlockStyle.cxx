// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockStyle.h"

#include "MeshTopology.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>

namespace SphericalStyle
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;
/// Sum of a n n^T n n^T over the normals of a part, n n^T read as a vector: all that its axes
/// depend on.
using Moments = Eigen::Matrix<double, 9, 9>;

constexpr int MostAxisSteps = 1000;
// Smaller steps of the axes end the iteration. Those of a ball are rounding alone.
constexpr double LeastStep = 1e-10;
// Less gain, as a share of the value, is no reason to prefer another start.
constexpr double LeastGain = 1e-9;

Eigen::Matrix<double, 9, 1> Outer(const Vector3d& n)
{
  const Matrix3d square = n * n.transpose();
  return Eigen::Map<const Eigen::Matrix<double, 9, 1>>(square.data());
}

/// Sum over the normals of a (u . n)^3 n.
Vector3d Gradient(const Moments& moments, const Vector3d& u)
{
  const Eigen::Matrix<double, 9, 1> rest = moments * Outer(u);
  return Eigen::Map<const Matrix3d>(rest.data()) * u;
}

double Value(const Moments& moments, const Matrix3d& axes)
{
  double sum = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    sum += axes.row(k).dot(Gradient(moments, axes.row(k).transpose()));
  }
  return sum;
}

/// Axes at right angles next to the gradient, again and again. The value is convex, so none of
/// these steps lowers it. @return the value
double Climb(const Moments& moments, Matrix3d& axes)
{
  for (int k = 0; k < MostAxisSteps; ++k)
  {
    Matrix3d gradient;
    for (int row = 0; row < 3; ++row)
    {
      gradient.row(row) = Gradient(moments, axes.row(row).transpose());
    }
    const Eigen::JacobiSVD<Matrix3d> svd(gradient, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Matrix3d next = svd.matrixU() * svd.matrixV().transpose();
    const double step = (next - axes).norm();
    axes = next;
    if (!(step > LeastStep))
    {
      break;
    }
  }
  return Value(moments, axes);
}

/// From the axes of the coordinates, and from the principal axes of the normals, which turn with
/// the part, as they are and turned out of every symmetry: those of a box with two equal sides lie
/// between two maxima, those of a tetrahedron are a saddle.
Matrix3d Axes(const Moments& moments)
{
  const Eigen::Matrix<double, 9, 1> trace = moments * Outer(Vector3d::UnitX()) +
    moments * Outer(Vector3d::UnitY()) + moments * Outer(Vector3d::UnitZ());
  const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(Eigen::Map<const Matrix3d>(trace.data()));
  const Matrix3d own = principal.eigenvectors().transpose();
  std::vector<Matrix3d> starts = { Matrix3d::Identity(), own };
  for (const Vector3d& axis : { Vector3d(1, 2, 3), Vector3d(-3, 1, 2), Vector3d(2, -3, 1) })
  {
    for (const double angle : { 0.5, 1.1 })
    {
      starts.emplace_back(Eigen::AngleAxisd(angle, axis.normalized()) * own);
    }
  }
  Matrix3d best = starts.front();
  double most = -1.0; // below every value, which is a sum of fourth powers
  for (Matrix3d& axes : starts)
  {
    const double value = Climb(moments, axes);
    if (value > most * (1.0 + LeastGain))
    {
      most = value;
      best = axes;
    }
  }
  return best;
}
}

std::vector<Matrix3d> BlockAxes(
  const Points& P, const Triangles& F, const std::vector<int>& part, int count)
{
  std::vector<Moments> moments(count, Moments::Zero());
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    const Vector3d u = P.row(F(f, 1)) - P.row(F(f, 0));
    const Vector3d v = P.row(F(f, 2)) - P.row(F(f, 0));
    const Vector3d cross = u.cross(v);
    const double twice = cross.stableNorm();
    if (twice > 0.0)
    {
      const Eigen::Matrix<double, 9, 1> outer = Outer(cross / twice);
      moments[part[F(f, 0)]] += 0.5 * twice * outer * outer.transpose();
    }
  }
  std::vector<Matrix3d> axes;
  axes.reserve(moments.size());
  for (const Moments& sum : moments)
  {
    axes.push_back(Axes(sum));
  }
  return axes;
}

Points BlockStyle::MakeTargets(const Points& P, const Triangles& F, const Points& normals) const
{
  const MeshTopology topology(F, static_cast<int>(P.rows()));
  const std::vector<int>& part = topology.GetComponents();
  const std::vector<Matrix3d> axes = BlockAxes(P, F, part, topology.GetNumberOfComponents());
  Points targets(normals.rows(), 3);
  for (Eigen::Index i = 0; i < normals.rows(); ++i)
  {
    const Matrix3d& own = axes[part[i]];
    const Vector3d along = own * normals.row(i).transpose();
    Eigen::Index closest = 0;
    along.cwiseAbs().maxCoeff(&closest);
    targets.row(i) = (along[closest] < 0.0 ? -1.0 : 1.0) * own.row(closest);
  }
  return targets;
}
} // namespace SphericalStyle
