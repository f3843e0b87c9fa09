// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "BaseSurface.h"

#include "EdgeMatrix.h"
#include "SurfaceMeasures.h"

namespace SphericalStyle
{
Points SmoothBase(
  const Points& P, const MeshTopology& topology, const HalfEdgeScalars& cotangents, double size)
{
  const Eigen::VectorXd M = PointAreas(P, topology.GetTriangles());
  EdgeMatrix matrix(topology, std::vector<char>(P.rows(), 0));
  const SparseCholesky::Matrix& A = matrix.Assemble(size * size * cotangents, M);
  SparseCholesky factor;
  factor.Analyze(A);
  factor.Factor(A);
  SparseCholesky::RightHandSides B = P;
  for (int step = 0; step < 2; ++step)
  {
    B = M.asDiagonal() * B;
    factor.Solve(B);
  }
  return B;
}
} // namespace SphericalStyle
