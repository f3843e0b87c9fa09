// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeWeights.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace SphericalStyle
{
HalfEdgeScalars HalfEdgeCotangents(const Points& P, const Triangles& F)
{
  HalfEdgeScalars c(F.rows(), 3);
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::Vector3d x = P.row(F(f, HalfEdgeStart(k))) - P.row(F(f, k));
      const Eigen::Vector3d y = P.row(F(f, HalfEdgeEnd(k))) - P.row(F(f, k));
      c(f, k) = 0.5 * x.dot(y) / x.cross(y).norm();
    }
  }
  return c;
}

HalfEdgeScalars EdgeSums(const HalfEdgeScalars& x, const Triangles& F)
{
  struct Entry
  {
    std::int64_t edge;
    int halfEdge;
  };
  std::vector<Entry> entries(F.size());
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const auto ends = std::minmax(F(f, HalfEdgeStart(k)), F(f, HalfEdgeEnd(k)));
      const int h = static_cast<int>(3 * f) + k;
      entries[h] = { (static_cast<std::int64_t>(ends.first) << 32) | ends.second, h };
    }
  }
  std::sort(entries.begin(), entries.end(),
    [](const Entry& a, const Entry& b)
    { return std::make_pair(a.edge, a.halfEdge) < std::make_pair(b.edge, b.halfEdge); });
  HalfEdgeScalars sums(x.rows(), 3);
  for (std::size_t first = 0, last = 0; first < entries.size(); first = last)
  {
    double sum = 0.0;
    for (last = first; last < entries.size() && entries[last].edge == entries[first].edge; ++last)
    {
      sum += x.data()[entries[last].halfEdge];
    }
    for (std::size_t i = first; i < last; ++i)
    {
      sums.data()[entries[i].halfEdge] = sum;
    }
  }
  return sums;
}

EdgeWeights ComputeEdgeWeights(const HalfEdgeScalars& cotangents, const Triangles& F,
  const Eigen::VectorXd& lambda, EdgeWeighting edges, SphericalWeighting spherical)
{
  const bool full = edges == EdgeWeighting::FullEdge;
  EdgeWeights w;
  w.c = full ? EdgeSums(cotangents, F) : cotangents;
  const bool cotangent = spherical == SphericalWeighting::Cotangent;
  const bool oneLambda = lambda.size() > 0 && (lambda.array() == lambda(0)).all();
  w.proportional = oneLambda && (cotangent || lambda(0) == 0.0);
  if (w.proportional)
  {
    w.ratio = std::sqrt(3.0) * lambda(0);
    w.l = w.ratio * w.c;
    return w;
  }
  w.l.resize(F.rows(), 3);
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    if (cotangent)
    {
      const double mean = (lambda(F(f, 0)) + lambda(F(f, 1)) + lambda(F(f, 2))) / 3.0;
      w.l.row(f) = std::sqrt(3.0) * mean * w.c.row(f);
      continue;
    }
    for (int k = 0; k < 3; ++k)
    {
      const double mean = 0.5 * (lambda(F(f, HalfEdgeStart(k))) + lambda(F(f, HalfEdgeEnd(k))));
      w.l(f, k) = full ? mean : 0.5 * mean;
    }
  }
  return w;
}
} // namespace SphericalStyle
