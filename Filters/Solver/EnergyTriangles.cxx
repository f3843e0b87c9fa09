// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "EnergyTriangles.h"

#include "IntrinsicDelaunay.h"

#include <utility>

namespace SphericalStyle
{
bool UpdateEnergyTriangles(const Points& P, const EnergyTriangles& surface,
  const EnergyTriangleOptions& options, EnergyTriangles& triangles)
{
  Triangles F = surface.Topology.GetTriangles();
  triangles.Cotangents = surface.Cotangents;
  if (options.intrinsicDelaunay)
  {
    IntrinsicTriangulation intrinsic = IntrinsicDelaunay(P, F, surface.Cotangents);
    F = std::move(intrinsic.F);
    triangles.Cotangents = std::move(intrinsic.Cotangents);
    triangles.NumberOfFlips = intrinsic.NumberOfFlips;
    triangles.NumberOfNegativeEdges = intrinsic.NumberOfNegativeEdges;
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
