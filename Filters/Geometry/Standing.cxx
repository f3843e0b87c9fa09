// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Standing.h"

#include "SurfaceMeasures.h"
#include "SurfaceMesh.h"

#include <CGAL/convex_hull_2.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace SphericalStyle
{
namespace
{
constexpr double Degrees = 180.0 / Pi;

/// What of a convex polygon is farther than `distance` from its edges.
SupportPolygon Inset(const SupportPolygon& polygon, double distance)
{
  SupportPolygon inside = polygon;
  for (std::size_t e = 0; e < polygon.size(); ++e)
  {
    const Eigen::Vector2d along = (polygon[(e + 1) % polygon.size()] - polygon[e]).normalized();
    const Eigen::Vector2d inward(-along.y(), along.x());
    const auto depth = [&](const Eigen::Vector2d& p)
    { return inward.dot(p - polygon[e]) - distance; };
    SupportPolygon rest;
    for (std::size_t k = 0; k < inside.size(); ++k)
    {
      const Eigen::Vector2d& p = inside[k];
      const Eigen::Vector2d& q = inside[(k + 1) % inside.size()];
      const double a = depth(p);
      const double b = depth(q);
      if (a >= 0.0)
      {
        rest.push_back(p);
      }
      if ((a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0))
      {
        rest.emplace_back(p + a / (a - b) * (q - p));
      }
    }
    inside = rest;
  }
  return inside;
}
} // namespace

Eigen::Vector3d CenterOfMass(const TriangleMesh& mesh)
{
  const Eigen::RowVector3d O = mesh.P.colwise().mean();
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  double volume = 0.0;
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    const double six = TripleProduct(mesh.P, mesh.F, f, O.transpose());
    volume += six;
    sum += six * 0.25 * (mesh.P(mesh.F.row(f), AllColumns).colwise().sum() - 3.0 * O);
  }
  return (O + sum / volume).transpose();
}

SupportPolygon FindSupport(const Points& P, int axis, double tolerance)
{
  const double ground = P.col(axis).minCoeff() + tolerance;
  std::vector<Kernel::Point_2> places;
  for (const auto& p : P.rowwise())
  {
    if (p(axis) <= ground)
    {
      places.emplace_back(p((axis + 1) % 3), p((axis + 2) % 3));
    }
  }
  std::vector<Kernel::Point_2> hull;
  CGAL::convex_hull_2(places.begin(), places.end(), std::back_inserter(hull));
  SupportPolygon support;
  for (const Kernel::Point_2& p : hull)
  {
    support.emplace_back(p.x(), p.y());
  }
  return support;
}

double TiltAngle(const SupportPolygon& support, const Eigen::Vector2d& center, double height)
{
  if (support.size() < 3)
  {
    return -90.0;
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < support.size(); ++e)
  {
    const Eigen::Vector2d along = (support[(e + 1) % support.size()] - support[e]).normalized();
    const Eigen::Vector2d inward(-along.y(), along.x());
    least = std::min(least, std::atan2(inward.dot(center - support[e]), height));
  }
  return Degrees * least;
}

bool NearestStablePlace(const SupportPolygon& support, const Eigen::Vector2d& center, double height,
  double angle, Eigen::Vector2d& place)
{
  place = center;
  if (support.size() < 3)
  {
    return false;
  }
  if (TiltAngle(support, center, height) >= angle)
  {
    return true;
  }
  const SupportPolygon inside = Inset(support, height * std::tan(angle / Degrees));
  if (inside.empty())
  {
    return false;
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < inside.size(); ++k) // the center is outside
  {
    const Eigen::Vector2d edge = inside[(k + 1) % inside.size()] - inside[k];
    const double length = edge.squaredNorm();
    const double share =
      length > 0.0 ? std::clamp(edge.dot(center - inside[k]) / length, 0.0, 1.0) : 0.0;
    const Eigen::Vector2d on = inside[k] + share * edge;
    if ((on - center).norm() < nearest)
    {
      nearest = (on - center).norm();
      place = on;
    }
  }
  return true;
}
} // namespace SphericalStyle
