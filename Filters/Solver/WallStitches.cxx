// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "WallStitches.h"

#include "Frame.h"
#include "Orientation.h"
#include "SurfaceMeasures.h"
#include "Thickness.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace SphericalStyle
{
namespace
{
/// The corner of a triangle that is nearest to a point, and its distance.
std::pair<int, double> NearestCorner(const TriangleMesh& mesh, int triangle, int point)
{
  std::pair<int, double> nearest = { -1, 0.0 };
  for (const int corner : mesh.F.row(triangle))
  {
    const double distance = (mesh.P.row(corner) - mesh.P.row(point)).norm();
    if (nearest.first < 0 || distance < nearest.second)
    {
      nearest = { corner, distance };
    }
  }
  return nearest;
}

/// Sorts stitches and adds up the weights of equal ones: two at most, so in no particular order.
void Merge(std::vector<Stitch>& stitches)
{
  const auto ends = [](const Stitch& s) { return std::make_pair(s.u, s.v); };
  std::sort(stitches.begin(), stitches.end(),
    [&](const Stitch& a, const Stitch& b) { return ends(a) < ends(b); });
  std::size_t last = 0;
  for (std::size_t i = 1; i < stitches.size(); ++i)
  {
    if (ends(stitches[i]) == ends(stitches[last]))
    {
      stitches[last].weight += stitches[i].weight;
    }
    else
    {
      stitches[++last] = stitches[i];
    }
  }
  stitches.resize(std::min(stitches.size(), last + 1));
}
}

std::vector<Stitch> FindWallStitches(const Points& P, const Triangles& F, double size, int threads)
{
  const TriangleMesh mesh = { P, OrientAlike(P, F) };
  std::vector<int> points(P.rows());
  std::iota(points.begin(), points.end(), 0);
  const ThicknessProbes probes = PlaceThicknessProbes(mesh, points, threads, 2.0 * size);
  const Points normals = PointNormals(P, mesh.F), faces = TriangleNormals(P, mesh.F);
  const Eigen::VectorXd areas = PointAreas(P, F);
  const double thickest = 2.0 * size * FrameOf(P).scale;
  const double thinnest = 0.05 * thickest;
  std::vector<Stitch> stitches;
  for (std::size_t i = 0; i < probes.points.size(); ++i)
  {
    const int u = probes.points[i];
    const auto [v, distance] = NearestCorner(mesh, probes.triangles[i], u);
    const double cosine = -normals.row(u).dot(faces.row(probes.triangles[i]));
    if (cosine > 0.0 && distance < thickest)
    {
      const double length = std::max(distance, thinnest);
      const double weight =
        0.5 * areas(u) * cosine * cosine * (1.0 / (length * length) - 1.0 / (thickest * thickest));
      stitches.push_back({ std::min(u, v), std::max(u, v), weight });
    }
  }
  Merge(stitches);
  return stitches;
}
} // namespace SphericalStyle
