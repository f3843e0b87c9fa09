// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "EnergyTriangles.h"

namespace SphericalStyle
{
bool UpdateEnergyTriangles(const Points& P, const EnergyTriangles& surface,
  const EnergyTriangleOptions&, EnergyTriangles& triangles)
{
  Triangles F = surface.Topology.GetTriangles();
  triangles.Cotangents = surface.Cotangents;
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
