// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Thickness.h"

#include "FirstHit.h"
#include "Frame.h"
#include "Parallel.h"
#include "SurfaceMeasures.h"
#include "TriangleTree.h"

#include <algorithm>
#include <cmath>

namespace SphericalStyle
{
ThicknessProbes PlaceThicknessProbes(
  const TriangleMesh& rest, const std::vector<int>& points, int threads, double reach)
{
  ThicknessProbes probes;
  if (rest.F.rows() == 0 || points.empty())
  {
    return probes;
  }
  const Points P = FrameOf(rest.P).Into(rest.P);
  const double inward = EnclosedVolume(P, rest.F) < 0.0 ? 1.0 : -1.0;
  const Points normals = PointNormals(P, rest.F);
  const TriangleTree tree(P, rest.F);

  const int n = static_cast<int>(points.size());
  std::vector<int> triangles(n, -1);
  Points barycentric(n, 3);
  ParallelFor(n, threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        const Eigen::Vector3d normal = normals.row(points[i]);
        FirstHit hit(P, rest.F, P.row(points[i]), inward * normal, reach);
        hit.SkipPoint(points[i]);
        if (normal.norm() > 0.5)
        {
          hit.Search(tree);
        }
        if (hit.GetTriangle() >= 0)
        {
          triangles[i] = hit.GetTriangle();
          barycentric.row(i) = hit.GetPlace();
        }
      }
    });
  for (int i = 0; i < n; ++i)
  {
    if (triangles[i] >= 0)
    {
      barycentric.row(static_cast<Eigen::Index>(probes.points.size())) =
        barycentric.row(i).eval(); // no row is overtaken
      probes.points.push_back(points[i]);
      probes.triangles.push_back(triangles[i]);
    }
  }
  probes.barycentric = barycentric.topRows(static_cast<Eigen::Index>(probes.points.size()));
  return probes;
}

Eigen::VectorXd ThicknessRatios(
  const TriangleMesh& rest, const Points& deformed, const ThicknessProbes& probes)
{
  const auto thickness = [&](const Points& x, Eigen::Index i)
  {
    const auto corners = rest.F.row(probes.triangles[i]);
    Eigen::RowVector3d across = -x.row(probes.points[i]);
    for (int k = 0; k < 3; ++k)
    {
      across += probes.barycentric(i, k) * x.row(corners(k));
    }
    return across.norm();
  };
  Eigen::VectorXd ratio(static_cast<Eigen::Index>(probes.points.size()));
  for (Eigen::Index i = 0; i < ratio.size(); ++i)
  {
    ratio(i) = thickness(deformed, i) / thickness(rest.P, i);
  }
  return ratio;
}
} // namespace SphericalStyle
