// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "TargetDirections.h"

#include "SurfaceMeasures.h"

#include <cmath>

namespace SphericalStyle
{
Sphere TargetSphere(
  const Points& P, const Triangles& F, CenterMode center, RadiusMode radius, const Sphere& custom)
{
  Sphere sphere = custom;
  switch (center)
  {
    case CenterMode::PointMean:
      sphere.center = P.colwise().mean();
      break;
    case CenterMode::AreaCentroid:
      sphere.center = AreaCentroid(P, F);
      break;
    case CenterMode::Custom:
      break;
  }
  switch (radius)
  {
    case RadiusMode::EqualArea:
      sphere.radius = std::sqrt(TriangleAreas(P, F).sum() / (4.0 * Pi));
      break;
    case RadiusMode::EqualVolume:
      sphere.radius = std::cbrt(std::abs(EnclosedVolume(P, F)) * 3.0 / (4.0 * Pi));
      break;
    case RadiusMode::Custom:
      break;
  }
  if (!(sphere.radius > 0.0) || !std::isfinite(sphere.radius))
  {
    throw std::invalid_argument(radius == RadiusMode::EqualVolume
        ? "RadiusMode EqualVolume: the surface encloses no volume"
        : "Radius must be above zero and finite");
  }
  if (!sphere.center.allFinite())
  {
    throw std::invalid_argument("Center must be finite");
  }
  return sphere;
}

Points CenterDirections(const Points& P, const MeshTopology& topology, const Eigen::Vector3d& O,
  std::vector<int>& onCenter)
{
  const double smallest = 1e-12 * (P.colwise().maxCoeff() - P.colwise().minCoeff()).norm();
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
  const Points known = d;
  const Triangles& F = topology.GetTriangles();
  for (const int i : onCenter)
  {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    const int first = topology.GetCornerOffset()[i];
    const int last = topology.GetCornerOffset()[i + 1];
    for (int at = first; at < last; ++at)
    {
      const int corner = topology.GetCorners()[at];
      sum += known.row(F(corner / 3, HalfEdgeStart(corner % 3)));
      sum += known.row(F(corner / 3, HalfEdgeEnd(corner % 3)));
    }
    d.row(i) = sum / (2.0 * (last - first));
  }
  return d;
}

Points BlendDirections(const Points& d, const Points& n, const Eigen::VectorXd& a)
{
  return d.array().colwise() * (1.0 - a.array()) + n.array().colwise() * a.array();
}

HalfEdgeVectors EdgeTargets(const Points& t, double r, const Triangles& F,
  const HalfEdgeVectors& rest, ConcaveEdges concave, int& changed)
{
  HalfEdgeVectors tau = HalfEdgeDifferences(r * t, F);
  changed = 0;
  if (concave == ConcaveEdges::Keep)
  {
    return tau;
  }
  const double factor = concave == ConcaveEdges::Flip ? -1.0 : 0.0;
  for (Eigen::Index f = 0; f < F.rows(); ++f)
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
  return tau;
}
} // namespace SphericalStyle
