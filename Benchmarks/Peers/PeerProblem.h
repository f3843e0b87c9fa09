// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The task that peers get: they know handles and no target sphere, so six handles go to it.
#ifndef SphericalStyle_PeerProblem_h
#define SphericalStyle_PeerProblem_h

#include "BenchmarkMesh.h"

#include <set>

namespace Benchmarks
{
struct Handle
{
  int point;
  Eigen::Vector3d position;
};

/// The outermost point of each direction along the axes, moved halfway to the sphere around the
/// mean of the points whose radius is the mean distance. All other points are free.
inline std::vector<Handle> MakeHandles(const SphericalStyle::Points& P)
{
  const Eigen::RowVector3d center = P.colwise().mean();
  const double radius = (P.rowwise() - center).rowwise().norm().mean();
  std::set<int> points;
  for (int axis = 0; axis < 3; ++axis)
  {
    Eigen::Index row = 0;
    P.col(axis).minCoeff(&row);
    points.insert(static_cast<int>(row));
    P.col(axis).maxCoeff(&row);
    points.insert(static_cast<int>(row));
  }
  std::vector<Handle> handles;
  for (const int i : points)
  {
    const Eigen::RowVector3d onSphere = center + radius * (P.row(i) - center).normalized();
    handles.push_back({ i, 0.5 * (P.row(i) + onSphere).transpose() });
  }
  return handles;
}
} // namespace Benchmarks

#endif
