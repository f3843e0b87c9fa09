// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "CenterShares.h"

#include "EdgeMatrix.h"
#include "SurfaceMeasures.h"

#include <algorithm>

namespace SphericalStyle
{
namespace
{
constexpr double ShareLeft = 1e-12; // there is no next solve that would make up for it

/// Two smoothing steps. @param X  n x any, one field per column
Eigen::MatrixXd SmoothFields(const Eigen::VectorXd& areas, const MeshTopology& topology,
  const HalfEdgeScalars& cotangents, double size, const Eigen::MatrixXd& X, LinearMethod method,
  int threads)
{
  EdgeMatrix matrix(topology, std::vector<char>(areas.size(), 0));
  const LinearSystem::Matrix& A = matrix.Assemble(size * size * cotangents, areas);
  LinearSystem system(method);
  system.SetShareLeft(ShareLeft);
  system.Analyze(A);
  system.Factor(A, threads);
  Eigen::MatrixXd result(X.rows(), X.cols());
  for (Eigen::Index first = 0; first < X.cols(); first += 3)
  {
    const Eigen::Index columns = std::min<Eigen::Index>(3, X.cols() - first);
    LinearSystem::RightHandSides Y = LinearSystem::RightHandSides::Zero(X.rows(), 3);
    Y.leftCols(columns) = X.middleCols(first, columns);
    for (int step = 0; step < 2; ++step)
    {
      system.Solve(areas.asDiagonal() * Y, Y, threads);
    }
    result.middleCols(first, columns) = Y.leftCols(columns);
  }
  return result;
}
}

Eigen::MatrixXd CenterShares(const Points& P, const MeshTopology& topology,
  const HalfEdgeScalars& cotangents, double size, const std::vector<int>& ids, int numberOfCenters,
  const Eigen::VectorXd& areas, LinearMethod method, int threads)
{
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(P.rows(), numberOfCenters);
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    shares(i, ids[i]) = 1.0;
  }
  if (size > 0.0)
  {
    // Obtuse triangles can bring a share below 0.
    const Eigen::VectorXd M = areas.size() > 0 ? areas : PointAreas(P, topology.GetTriangles());
    shares = SmoothFields(M, topology, cotangents, size, shares, method, threads).cwiseMax(0.0);
    shares.array().colwise() /= shares.rowwise().sum().array().eval();
  }
  return shares;
}
} // namespace SphericalStyle
