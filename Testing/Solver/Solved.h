// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where a solver of its own takes a mesh.
#ifndef SphericalStyle_Solved_h
#define SphericalStyle_Solved_h

#include "StyleSolver.h"

inline SphericalStyle::Points Solved(
  const SphericalStyle::TriangleMesh& mesh, const SphericalStyle::StyleOptions& options)
{
  SphericalStyle::StyleSolver solver;
  solver.SetMesh(mesh);
  solver.Solve(options);
  return solver.GetPositions();
}

#endif
