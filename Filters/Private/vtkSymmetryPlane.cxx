// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSymmetryPlane.h"

#include "Frame.h"
#include "NearestPoint.h"
#include "Parallel.h"
#include "SurfaceMeasures.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

using Eigen::Matrix3d;
using Eigen::Vector3d;
using SphericalStyle::MirrorPlane;

namespace
{
constexpr int AllSamples = 20000;
constexpr double LeastArea = 1e-12; // of triangles whose planes can be told
constexpr double Near = 0.02;
constexpr double Far = 0.05;
constexpr double AlmostAxis = 1e-9; // distance of a unit normal below which it is the axis

/// Without triangles that hardly have an area, unless there are no others.
SphericalStyle::TriangleMesh Clear(const SphericalStyle::TriangleMesh& mesh)
{
  const Eigen::VectorXd areas = SphericalStyle::TriangleAreas(mesh.P, mesh.F);
  std::vector<Eigen::Index> clear;
  for (Eigen::Index f = 0; f < areas.size(); ++f)
  {
    if (areas(f) > LeastArea)
    {
      clear.push_back(f);
    }
  }
  return clear.empty()
    ? mesh
    : SphericalStyle::TriangleMesh{ mesh.P, mesh.F(clear, SphericalStyle::AllColumns) };
}

/// Of equal area: the first ones are spread as evenly as all are, by the generalized golden ratio
/// of three dimensions.
SphericalStyle::Points TakeSamples(const SphericalStyle::TriangleMesh& mesh)
{
  SphericalStyle::Points samples(AllSamples, 3);
  const Eigen::VectorXd areas = SphericalStyle::TriangleAreas(mesh.P, mesh.F);
  std::vector<double> sums(areas.size());
  std::partial_sum(areas.begin(), areas.end(), sums.begin());
  double along = 0.5;
  double u = 0.5;
  double v = 0.5;
  const auto advance = [](double& at, double by) { at = at + by - std::floor(at + by); };
  for (int k = 0; k < samples.rows(); ++k)
  {
    advance(along, 0.8191725133961645);
    advance(u, 0.6710436067037893);
    advance(v, 0.5497004779019703);
    const auto found = std::upper_bound(sums.begin(), sums.end(), along * sums.back());
    const auto f = std::min<Eigen::Index>(found - sums.begin(), areas.size() - 1);
    const Eigen::RowVector3d a = mesh.P.row(mesh.F(f, 0));
    const Eigen::RowVector3d b = mesh.P.row(mesh.F(f, 1)) - a;
    const Eigen::RowVector3d c = mesh.P.row(mesh.F(f, 2)) - a;
    const double root = std::sqrt(u);
    samples.row(k) = a + root * ((1.0 - v) * b + v * c);
  }
  return samples;
}

/// A mirrored sample.
struct Image
{
  Vector3d sample;
  double distance;    // of the image from the surface
  Vector3d direction; // of that
  double along;       // the distance along it
};

/// How many samples, how many rounds, where they end.
struct Search
{
  int samples;
  int rounds;
  bool exact;              // to the nearest point itself, and not to the plane through it
  double converged = 1e-6; // step, where the diagonal is 1
  bool turns = true;       // whether the normal is looked for, too
};

class Symmetry
{
public:
  Symmetry(const SphericalStyle::TriangleMesh& mesh, int threads);

  MirrorPlane Find() const;
  MirrorPlane FindAcross(int axis) const;
  vtkSymmetryPlane::Found InModel(const MirrorPlane& plane) const;

private:
  Vector3d NormalOf(int f) const;
  std::vector<Image> Mirror(const MirrorPlane& plane, const Search& search) const;
  MirrorPlane Refined(MirrorPlane plane, const Search& search) const;
  double Cost(const MirrorPlane& plane, const Search& search) const;
  double ShareNear(const MirrorPlane& plane) const;

  SphericalStyle::Frame Units;
  SphericalStyle::TriangleMesh Framed;
  SphericalStyle::TriangleTree Tree;
  SphericalStyle::Points Samples; // the first ones are spread over the surface, too
  int Threads;
};

Symmetry::Symmetry(const SphericalStyle::TriangleMesh& mesh, int threads)
  : Units(SphericalStyle::FrameOf(mesh.P))
  , Framed(Clear({ this->Units.Into(mesh.P), mesh.F }))
  , Tree(this->Framed.P, this->Framed.F)
  , Samples(TakeSamples(this->Framed))
  , Threads(threads)
{
}

Vector3d Symmetry::NormalOf(int f) const
{
  const Vector3d a = this->Framed.P.row(this->Framed.F(f, 0));
  const Vector3d b = this->Framed.P.row(this->Framed.F(f, 1));
  const Vector3d c = this->Framed.P.row(this->Framed.F(f, 2));
  return (b - a).cross(c - a).stableNormalized();
}

std::vector<Image> Symmetry::Mirror(const MirrorPlane& plane, const Search& search) const
{
  std::vector<Image> images(search.samples);
  SphericalStyle::ParallelFor(search.samples, this->Threads,
    [&](int begin, int end)
    {
      for (int k = begin; k < end; ++k)
      {
        Image& image = images[k];
        image.sample = this->Samples.row(k);
        const Vector3d place = plane.Mirror(image.sample);
        SphericalStyle::NearestPoint nearest(this->Framed.P, this->Framed.F, place);
        nearest.Search(this->Tree);
        const Vector3d offset = place - nearest.GetPoint();
        image.distance = offset.norm();
        image.direction =
          search.exact ? offset.stableNormalized() : this->NormalOf(nearest.GetTriangle());
        image.along = image.direction.dot(offset);
      }
    });
  return images;
}

double Symmetry::Cost(const MirrorPlane& plane, const Search& search) const
{
  double sum = 0.0;
  for (const Image& image : this->Mirror(plane, search))
  {
    sum += std::min(image.distance, Far);
  }
  return sum / search.samples;
}

double Symmetry::ShareNear(const MirrorPlane& plane) const
{
  const std::vector<Image> images = this->Mirror(plane, { AllSamples, 0, false });
  const auto near = std::count_if(
    images.begin(), images.end(), [&](const Image& image) { return image.distance < Near; });
  return static_cast<double>(near) / AllSamples;
}

MirrorPlane Symmetry::Refined(MirrorPlane plane, const Search& search) const
{
  for (int round = 0; round < search.rounds; ++round)
  {
    const std::vector<Image> images = this->Mirror(plane, search);
    std::vector<double> distances;
    distances.reserve(images.size());
    for (const Image& image : images)
    {
      distances.push_back(image.distance);
    }
    const auto middle = distances.begin() + search.samples / 2;
    std::nth_element(distances.begin(), middle, distances.end());
    const double usual = 3.0 * std::max(*middle, 1e-12);
    // Unknown: by how much the normal leans toward u and v, and how far the plane moves along it.
    const Vector3d n = plane.normal;
    const Vector3d u = n.unitOrthogonal();
    const Vector3d v = n.cross(u);
    Matrix3d A = Matrix3d::Zero();
    Vector3d b = Vector3d::Zero();
    for (const Image& image : images)
    {
      const Vector3d& m = image.direction;
      const double off = image.distance / usual;
      const double weight = 1.0 / (1.0 + off * off);
      const Vector3d from = image.sample - plane.origin;
      const double height = n.dot(from);
      const Vector3d slope(-2.0 * (u.dot(from) * n.dot(m) + height * u.dot(m)),
        -2.0 * (v.dot(from) * n.dot(m) + height * v.dot(m)), 2.0 * n.dot(m));
      A += weight * slope * slope.transpose();
      b -= weight * image.along * slope;
    }
    A.diagonal().array() += 1e-12 * A.trace() + 1e-300; // a sphere has no plane of its own
    const Vector3d step =
      search.turns ? Vector3d(A.ldlt().solve(b)) : Vector3d(0.0, 0.0, b(2) / A(2, 2));
    const double size = step.norm();
    if (!std::isfinite(size))
    {
      break;
    }
    const Vector3d bounded = size > 0.2 ? Vector3d(0.2 / size * step) : step;
    plane.origin += bounded(2) * n;
    plane.normal = (n + bounded(0) * u + bounded(1) * v).normalized();
    if (size < search.converged)
    {
      break;
    }
  }
  return plane;
}

MirrorPlane Symmetry::Find() const
{
  const Vector3d mean = this->Samples.colwise().mean().transpose();
  const SphericalStyle::Points from = this->Samples.rowwise() - mean.transpose();
  const Matrix3d axes =
    Eigen::SelfAdjointEigenSolver<Matrix3d>(from.transpose() * from).eigenvectors();
  // First the axes of the coordinates: of equals the first is taken.
  std::vector<Vector3d> directions = { Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ() };
  for (int axis = 0; axis < 3; ++axis)
  {
    directions.emplace_back(axes.col(axis));
  }
  for (int k = 0; k < 27; ++k)
  {
    const Vector3d direction = Eigen::Vector3i(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1).cast<double>();
    if (k > 13 && direction.squaredNorm() > 1.5)
    {
      directions.emplace_back(direction.normalized());
    }
  }
  MirrorPlane best;
  double least = INFINITY;
  for (const Vector3d& direction : directions)
  {
    const Search few{ 400, 10, false };
    const MirrorPlane plane = this->Refined({ mean, direction }, few);
    const double cost = this->Cost(plane, few);
    if (cost < 0.98 * least - 1e-5) // of about equals the first
    {
      least = cost;
      best = plane;
    }
  }
  best = this->Refined(best, { 4000, 20, false });
  best = this->Refined(best, { 1000, 12, true, 1e-14 });
  best.origin = mean - best.DistanceOf(mean) * best.normal;
  int axis = 0;
  best.normal.cwiseAbs().maxCoeff(&axis);
  best.normal *= std::copysign(1.0, best.normal(axis));
  if ((best.normal - Vector3d::Unit(axis)).norm() < AlmostAxis)
  {
    best.normal = Vector3d::Unit(axis);
  }
  return best;
}

MirrorPlane Symmetry::FindAcross(int axis) const
{
  const MirrorPlane middle{ this->Samples.colwise().mean().transpose(), Vector3d::Unit(axis) };
  const MirrorPlane near = this->Refined(middle, { 4000, 20, false, 1e-6, false });
  return this->Refined(near, { 1000, 12, true, 1e-14, false });
}

vtkSymmetryPlane::Found Symmetry::InModel(const MirrorPlane& plane) const
{
  return { { this->Units.OutOf(plane.origin.transpose()).transpose(), plane.normal },
    this->ShareNear(plane) };
}
}

vtkSymmetryPlane::Found vtkSymmetryPlane::Find(
  const SphericalStyle::TriangleMesh& mesh, int threads)
{
  const Symmetry symmetry(mesh, threads);
  return symmetry.InModel(symmetry.Find());
}

vtkSymmetryPlane::Found vtkSymmetryPlane::FindAcross(
  const SphericalStyle::TriangleMesh& mesh, int axis, int threads)
{
  const Symmetry symmetry(mesh, threads);
  return symmetry.InModel(symmetry.FindAcross(axis));
}
