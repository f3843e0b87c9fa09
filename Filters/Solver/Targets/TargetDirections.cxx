// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "TargetDirections.h"

#include "Parallel.h"
#include "SurfaceMeasures.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace SphericalStyle
{
int TargetOptions::NumberOfCenters(const SurfacePart& part) const
{
  const int last =
    this->centerIds.empty() ? 0 : *std::max_element(this->centerIds.begin(), this->centerIds.end());
  return 1 + static_cast<int>(part.Max(last));
}

bool TargetOptions::HasTargets(const SurfacePart& part) const
{
  return part.Max(this->targets.rows() > 0 ? 1.0 : 0.0) > 0.0;
}

bool TargetOptions::HasFixedPoints(const SurfacePart& part) const
{
  return part.Max(this->fixedPoints.empty() ? 0.0 : 1.0) > 0.0;
}

bool TargetOptions::UsesNormals(const SurfacePart& part) const
{
  constexpr double None = -1.0;
  const double largest =
    part.Max(this->normalBlends.size() > 0 ? this->normalBlends.maxCoeff() : None);
  return !this->HasTargets(part) && (largest == None ? this->normalBlend : largest) > 0.0;
}

bool TargetOptions::HasPartStyles(const SurfacePart& part) const
{
  return part.Max(this->partFactors.size() > 0 || this->blendsOfParts ? 1.0 : 0.0) > 0.0;
}

Eigen::VectorXd TargetOptions::Factors() const
{
  if (this->partFactors.size() == 0)
  {
    return this->roundnessFactors;
  }
  return this->roundnessFactors.size() == 0
    ? this->partFactors
    : Eigen::VectorXd(this->roundnessFactors.cwiseProduct(this->partFactors));
}

TargetOptions TargetOptions::Into(const Frame& frame) const
{
  TargetOptions framed = *this;
  framed.custom = { (this->custom.center - frame.origin.transpose()) / frame.scale,
    this->custom.radius / frame.scale };
  framed.centers = frame.Into(this->centers);
  return framed;
}

Sphere TargetSphere(const Points& P, const Triangles& F, CenterMode center, RadiusMode radius,
  const Sphere& custom, const SurfacePart& part)
{
  Sphere sphere = custom;
  switch (center)
  {
    case CenterMode::PointMean:
      sphere.center = PointMean(P, part);
      break;
    case CenterMode::AreaCentroid:
      sphere.center = AreaCentroid(P, F, part);
      break;
    case CenterMode::Custom:
      break;
  }
  switch (radius)
  {
    case RadiusMode::EqualArea:
      sphere.radius = std::sqrt(part.Sum(TriangleAreas(P, F).sum()) / (4.0 * Pi));
      break;
    case RadiusMode::EqualVolume:
      sphere.radius = BallRadius(EnclosedVolume(P, F, part));
      break;
    case RadiusMode::Custom:
      break;
  }
  if (!(sphere.radius > 0.0) || !std::isfinite(sphere.radius))
  {
    throw std::invalid_argument(radius == RadiusMode::EqualVolume
        ? "RadiusMode EqualVolume: the surface encloses no volume"
        : radius == RadiusMode::EqualArea
        ? "RadiusMode EqualArea: the area of the surface is 0 or not finite; scale the model"
        : "Radius must be above zero and finite");
  }
  if (!sphere.center.allFinite())
  {
    throw std::invalid_argument(center == CenterMode::Custom
        ? "Center must be finite"
        : "CenterMode: the center of the surface is not finite; scale the model");
  }
  return sphere;
}

namespace
{
/// The sphere of some points and triangles by themselves: others have no say, not even in the apex
/// of the volume.
/// @param points  that count here
Sphere SphereOfPart(const Points& P, const Triangles& F, const std::vector<int>& points,
  const std::vector<int>& triangles, CenterMode center, RadiusMode radius, const Sphere& custom,
  const SurfacePart& part)
{
  const SurfacePart apart = part.Apart();
  Eigen::Vector2d sizes(static_cast<double>(points.size()), static_cast<double>(triangles.size()));
  part.Sum(sizes);
  if (sizes(0) == 0.0)
  {
    throw std::invalid_argument("there is no point in it");
  }
  Sphere given = custom;
  if (center == CenterMode::PointMean)
  {
    Eigen::Vector3d sum = P(points, AllColumns).colwise().sum();
    part.Sum(sum);
    given.center = sum / sizes(0);
    center = CenterMode::Custom;
  }
  if ((center == CenterMode::AreaCentroid || radius != RadiusMode::Custom) && sizes(1) == 0.0)
  {
    throw std::invalid_argument("there is no triangle in it to take the sphere from");
  }
  Points corners(3 * triangles.size(), 3);
  Triangles soup(triangles.size(), 3);
  for (Eigen::Index f = 0; f < soup.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      soup(f, k) = static_cast<int>(3 * f) + k;
      corners.row(soup(f, k)) = P.row(F(triangles[f], k));
    }
  }
  return TargetSphere(corners, soup, center, radius, given, apart);
}
}

std::vector<Sphere> TargetSpheres(const Points& P, const Triangles& F,
  const std::vector<int>& parts, int numberOfParts, CenterMode center, RadiusMode radius,
  const Sphere& custom, const SurfacePart& part)
{
  std::vector<std::vector<int>> points(numberOfParts);
  std::vector<std::vector<int>> triangles(numberOfParts);
  const auto add = [](std::vector<std::vector<int>>& members, int which, auto id)
  {
    if (which >= 0)
    {
      members[which].push_back(static_cast<int>(id));
    }
  };
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    add(points, part.Counts(static_cast<Eigen::Index>(i)) ? parts[i] : -1, i);
  }
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    const int b = parts[F(f, 1)];
    add(triangles, b == parts[F(f, 2)] ? b : parts[F(f, 0)], f);
  }
  std::vector<Sphere> spheres;
  for (int k = 0; k < numberOfParts; ++k)
  {
    try
    {
      spheres.push_back(SphereOfPart(P, F, points[k], triangles[k], center, radius, custom, part));
    }
    catch (const std::invalid_argument& error)
    {
      throw PartWithoutSphere(k, error.what());
    }
  }
  return spheres;
}

std::vector<Sphere> SpheresOfCenters(
  const Points& P, const Triangles& F, const TargetOptions& options, const SurfacePart& part)
{
  const int centers = options.NumberOfCenters(part);
  const bool ofAll = !options.HasFixedPoints(part) || !options.sphereOfFreePoints;
  if (centers == 1 && ofAll)
  {
    return { TargetSphere(P, F, options.centerMode, options.radiusMode, options.custom, part) };
  }
  std::vector<int> parts = options.centerIds;
  parts.resize(P.rows(), 0);
  if (!ofAll)
  {
    for (const int i : options.fixedPoints)
    {
      parts[i] = -1;
    }
  }
  std::vector<Sphere> spheres = TargetSpheres(
    P, F, parts, centers, options.centerMode, options.radiusMode, options.custom, part);
  for (Eigen::Index k = 0; k < options.centers.rows(); ++k)
  {
    spheres[k].center = options.centers.row(k);
  }
  return spheres;
}

Points CenterDirections(const Points& P, const Triangles& F, const Eigen::Vector3d& O,
  std::vector<int>& onCenter, const SurfacePart& part)
{
  const auto [low, high] = BoundsOf(P, part);
  const double smallest = 1e-12 * (high - low).norm();
  Points d = P.rowwise() - O.transpose();
  onCenter.clear();
  for (int i = 0; i < d.rows(); ++i)
  {
    const double distance = d.row(i).norm();
    if (distance > smallest)
    {
      d.row(i) /= distance;
    }
    else
    {
      d.row(i).setZero();
      onCenter.push_back(i);
    }
  }
  if (part.Max(onCenter.empty() ? 0.0 : 1.0) == 0.0)
  {
    return d;
  }
  const Points known = d;
  Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> sums; // with the number of corners
  sums.setZero(P.rows(), 4);
  for (const int i : onCenter)
  {
    auto sum = sums.row(i);
    for (Eigen::Index corner = 0; corner < F.size(); ++corner)
    {
      if (F.data()[corner] == i)
      {
        const Eigen::Index f = corner / 3;
        const int k = static_cast<int>(corner % 3);
        sum.head<3>() += known.row(F(f, HalfEdgeStart(k)));
        sum.head<3>() += known.row(F(f, HalfEdgeEnd(k)));
        ++sum(3);
      }
    }
  }
  part.SumAtShared(sums.data(), 4);
  for (const int i : onCenter)
  {
    d.row(i) = sums.row(i).head<3>() / (2.0 * std::max(sums(i, 3), 1.0));
  }
  return d;
}

TargetShape ShapeOf(
  const Points& P, const Triangles& F, const TargetOptions& options, const SurfacePart& part)
{
  if (options.shape.kind == TargetKind::Sphere)
  {
    return {};
  }
  return { options.shape, AreaMoments(P, F, part), options.radiusMode == RadiusMode::EqualVolume };
}

void ReachShape(const TargetShape& shape, int threads, Points& d)
{
  if (shape.IsSphere())
  {
    return;
  }
  ParallelFor(static_cast<int>(d.rows()), threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        d.row(i) = shape.Reach(d.row(i));
      }
    });
}

Points BlendDirections(const Points& d, const Points& n, const Eigen::VectorXd& a)
{
  return d.array().colwise() * (1.0 - a.array()) + n.array().colwise() * a.array();
}

void AddEdgeTargets(
  const Points& t, double r, const Eigen::VectorXd& omega, const Triangles& F, HalfEdgeVectors& tau)
{
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int u = F(f, HalfEdgeStart(k));
      const int v = F(f, HalfEdgeEnd(k));
      const double share = omega.size() > 0 ? 0.5 * (omega[u] + omega[v]) : 1.0;
      tau.block<1, 3>(f, 3 * k) += share * (r * t.row(u) - r * t.row(v));
    }
  }
}

int ChangeConcaveTargets(const HalfEdgeVectors& rest, ConcaveEdges concave, HalfEdgeVectors& tau)
{
  int changed = 0;
  if (concave == ConcaveEdges::Keep)
  {
    return changed;
  }
  const double factor = concave == ConcaveEdges::Flip ? -1.0 : 0.0;
  for (Eigen::Index f = 0; f < tau.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      auto target = tau.block<1, 3>(f, 3 * k);
      if (target.dot(rest.block<1, 3>(f, 3 * k)) < 0.0)
      {
        target *= factor;
        ++changed;
      }
    }
  }
  return changed;
}
} // namespace SphericalStyle
