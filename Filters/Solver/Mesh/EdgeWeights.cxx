// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeWeights.h"

#include "MeshEdges.h"
#include "Stitches.h"

#include <Eigen/Geometry>

#include <cmath>

namespace SphericalStyle
{
HalfEdgeScalars HalfEdgeCotangents(const Points& P, const Triangles& F)
{
  HalfEdgeScalars c(F.rows(), 3);
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    Eigen::Vector3d e[3]; // the half-edges
    Eigen::Vector3d square;
    for (int k = 0; k < 3; ++k)
    {
      e[k] = P.row(F(f, HalfEdgeEnd(k))) - P.row(F(f, HalfEdgeStart(k)));
      square(k) = e[k].squaredNorm();
    }
    // One area for all three: of a sliver it has few digits, and three of them would be a form that
    // is not positive semidefinite by far. The two shorter edges have the most.
    int longest = square(1) > square(0) ? 1 : 0;
    longest = square(2) > square(longest) ? 2 : longest;
    const double area = e[HalfEdgeStart(longest)].cross(e[HalfEdgeEnd(longest)]).norm(); // twice
    for (int k = 0; k < 3; ++k)
    {
      c(f, k) = -0.5 * e[HalfEdgeStart(k)].dot(e[HalfEdgeEnd(k)]) / area;
    }
  }
  return c;
}

HalfEdgeScalars EdgeSums(const HalfEdgeScalars& x, const Triangles& F)
{
  const MeshEdges edges(F);
  const std::vector<int>& offset = edges.GetOffset();
  const std::vector<int>& halfEdges = edges.GetHalfEdges();
  HalfEdgeScalars sums(x.rows(), 3);
  for (int e = 0; e < edges.GetNumberOfEdges(); ++e)
  {
    double sum = 0.0;
    for (int i = offset[e]; i < offset[e + 1]; ++i)
    {
      sum += x.data()[halfEdges[i]];
    }
    for (int i = offset[e]; i < offset[e + 1]; ++i)
    {
      sums.data()[halfEdges[i]] = sum;
    }
  }
  return sums;
}

EdgeWeights ComputeEdgeWeights(const HalfEdgeScalars& cotangents, const Triangles& F,
  const Eigen::VectorXd& lambda, EdgeWeighting edges, SphericalWeighting spherical, int stitches)
{
  const bool full = edges == EdgeWeighting::FullEdge;
  EdgeWeights w;
  w.c = cotangents;
  if (full)
  {
    const Eigen::Index m = F.rows() - 2 * stitches;
    w.c.topRows(m) = EdgeSums(cotangents.topRows(m), F.topRows(m));
    w.c.bottomRows(2 * stitches) *= 2.0; // of stitches alone, whatever edge they run beside
  }
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
    const bool stitch = f >= F.rows() - 2 * stitches;
    const double share = stitch ? 0.5 * w.c(f, 1) / StitchWeight : full ? 1.0 : 0.5;
    for (int k = 0; k < 3; ++k)
    {
      const double mean = 0.5 * (lambda(F(f, HalfEdgeStart(k))) + lambda(F(f, HalfEdgeEnd(k))));
      w.l(f, k) = share * mean;
    }
  }
  return w;
}
} // namespace SphericalStyle
