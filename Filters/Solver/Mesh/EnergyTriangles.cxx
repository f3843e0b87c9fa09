// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "EnergyTriangles.h"

#include "IntrinsicDelaunay.h"
#include "Stitches.h"

#include <utility>

namespace SphericalStyle
{
namespace
{
/// A pair of triangles a stitch, after the others.
void AddStitches(const std::vector<Stitch>& stitches, Triangles& F, HalfEdgeScalars& cotangents)
{
  Eigen::Index f = F.rows();
  const Eigen::Index m = f + 2 * static_cast<Eigen::Index>(stitches.size());
  F.conservativeResize(m, 3);
  cotangents.conservativeResize(m, 3);
  for (const Stitch& s : stitches)
  {
    F.row(f) << s.u, s.v, s.v;
    F.row(f + 1) << s.v, s.u, s.u;
    for (const Eigen::Index end = f + 2; f < end; ++f)
    {
      const double half = 0.5 * s.weight * StitchWeight;
      cotangents.row(f) << 0.0, half, half;
    }
  }
}
}

bool UpdateEnergyTriangles(const Points& P, const EnergyTriangles& surface,
  const EnergyTriangleOptions& options, EnergyTriangles& triangles)
{
  Triangles F = surface.Topology.GetTriangles();
  triangles.Cotangents.resize(0, 3); // Eigen would free it twice if there is no memory for the next
  triangles.Cotangents = surface.Cotangents;
  triangles.NumberOfFlips = triangles.NumberOfNegativeEdges = -1;
  if (options.intrinsicDelaunay)
  {
    IntrinsicTriangulation intrinsic = IntrinsicDelaunay(P, F, surface.Cotangents);
    F = std::move(intrinsic.F);
    triangles.Cotangents = std::move(intrinsic.Cotangents);
    triangles.NumberOfFlips = intrinsic.NumberOfFlips;
    triangles.NumberOfNegativeEdges = intrinsic.NumberOfNegativeEdges;
  }
  triangles.NumberOfStitches = 0;
  if (options.stitched)
  {
    const std::vector<Stitch> stitches =
      FindStitches(P, surface.Topology.GetTriangles(), surface.Topology.GetComponents());
    AddStitches(stitches, F, triangles.Cotangents);
    triangles.NumberOfStitches = static_cast<int>(stitches.size());
  }
  const Triangles& before = triangles.Topology.GetTriangles();
  if (triangles.Topology.GetNumberOfPoints() == P.rows() && before.rows() == F.rows() &&
    before == F)
  {
    return false;
  }
  triangles.Topology = MeshTopology(F, static_cast<int>(P.rows()), RepeatedPoints::Allowed);
  return true;
}
} // namespace SphericalStyle
