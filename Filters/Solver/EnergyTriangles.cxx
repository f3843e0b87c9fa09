// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "EnergyTriangles.h"

#include "IntrinsicDelaunay.h"
#include "WallStitches.h"

#include <utility>

namespace SphericalStyle
{
namespace
{
/// The stitches that the options ask for; triangles takes how many there are.
std::vector<Stitch> StitchesOf(const Points& P, const MeshTopology& surface,
  const EnergyTriangleOptions& options, EnergyTriangles& triangles)
{
  const Triangles& F = surface.GetTriangles();
  std::vector<Stitch> stitches;
  if (options.stitched)
  {
    stitches = FindStitches(P, F, surface.GetComponents());
  }
  const std::size_t between = stitches.size();
  if (options.wallSize > 0.0)
  {
    const std::vector<Stitch> walls = FindWallStitches(P, F, options.wallSize, options.threads);
    stitches.insert(stitches.end(), walls.begin(), walls.end());
  }
  triangles.NumberOfStitches = static_cast<int>(stitches.size());
  triangles.NumberOfWallStitches = static_cast<int>(stitches.size() - between);
  return stitches;
}

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
      cotangents.row(f) << 0.0, 0.5 * s.weight, 0.5 * s.weight;
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
  AddStitches(StitchesOf(P, surface.Topology, options, triangles), F, triangles.Cotangents);
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
