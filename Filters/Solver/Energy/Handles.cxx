// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Handles.h"

#include "MeshTopology.h"
#include "UnitScale.h"

#include <Eigen/Geometry>

namespace SphericalStyle
{
Eigen::Matrix3d RotationOfVector(const Eigen::Vector3d& turn)
{
  const double angle = turn.stableNorm();
  return angle > 0.0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix()
                     : Eigen::Matrix3d::Identity();
}

Points MovedByHandle(const Handle& handle, const Points& P)
{
  if (handle.Stays())
  {
    return P;
  }
  Points moved = P.rowwise() - handle.place.transpose();
  if (!handle.turn.isZero(0.0))
  {
    moved = (moved * RotationOfVector(handle.turn).transpose()).eval();
  }
  moved.rowwise() += handle.to.transpose();
  return moved;
}

std::vector<int> HandlesOfPoints(const Points& P, const std::vector<Handle>& handles)
{
  const auto n = static_cast<int>(P.rows());
  std::vector<int> ofPoints(n, -1);
  for (int k = 0; k < static_cast<int>(handles.size()); ++k)
  {
    const Handle& handle = handles[k];
    // A power of two changes no digit, and squares stay in range.
    const double unit = UnitScale(
      Eigen::Vector3d(P.cwiseAbs().maxCoeff(), handle.place.cwiseAbs().maxCoeff(), handle.radius));
    const Eigen::VectorXd squares =
      (unit * (P.rowwise() - handle.place.transpose())).rowwise().squaredNorm();
    Eigen::Index nearest = 0;
    squares.minCoeff(&nearest);
    const double radius = unit * handle.radius;
    for (int i = 0; i < n; ++i)
    {
      if (i == nearest || squares(i) <= radius * radius)
      {
        if (ofPoints[i] >= 0)
        {
          throw PointInTwoHandles(i, ofPoints[i], k);
        }
        ofPoints[i] = k;
      }
    }
  }
  return ofPoints;
}

namespace
{
constexpr double FarthestMove = 1e6; // diagonals

/// Of each point: whether its component has a point of a handle.
std::vector<char> HasHandle(const TriangleMesh& mesh, const std::vector<int>& ofPoints)
{
  const auto n = static_cast<int>(ofPoints.size());
  const std::vector<int> first = FirstPointsOfComponents(mesh.F, n);
  std::vector<char> held(ofPoints.size(), 0);
  for (int i = 0; i < n; ++i)
  {
    if (ofPoints[i] >= 0)
    {
      held[first[i]] = 1;
    }
  }
  std::vector<char> has(ofPoints.size());
  for (int i = 0; i < n; ++i)
  {
    has[i] = held[first[i]];
  }
  return has;
}

void RequireNear(const TriangleMesh& mesh, int handle, const Points& moved)
{
  const Frame frame = FrameOf(mesh.P);
  if (!((frame.Into(moved)).cwiseAbs().maxCoeff() <= FarthestMove))
  {
    throw std::invalid_argument("row " + std::to_string(handle + 1) +
      " takes points farther than a million diagonals of the model; move it less far");
  }
}
}

void HoldHandles(const TriangleMesh& mesh, const std::vector<Handle>& handles,
  const std::vector<int>& ofPoints, StyleOptions& options)
{
  std::vector<char> held(ofPoints.size());
  for (std::size_t i = 0; i < ofPoints.size(); ++i)
  {
    held[i] = ofPoints[i] >= 0 ? 1 : 0;
  }
  if (options.componentCoupling == ComponentCoupling::Independent)
  {
    const std::vector<char> has = HasHandle(mesh, ofPoints);
    for (std::size_t i = 0; i < held.size(); ++i)
    {
      held[i] = held[i] || !has[i] ? 1 : 0;
    }
  }
  options.fixedPoints.clear();
  std::vector<std::vector<int>> rows(handles.size()); // among the fixed points
  for (int i = 0; i < static_cast<int>(held.size()); ++i)
  {
    if (ofPoints[i] >= 0)
    {
      rows[ofPoints[i]].push_back(static_cast<int>(options.fixedPoints.size()));
    }
    if (held[i])
    {
      options.fixedPoints.push_back(i);
    }
  }
  options.fixedPositions = mesh.P(options.fixedPoints, AllColumns);
  options.fixedTurns = Points::Zero(options.fixedPositions.rows(), 3);
  for (int k = 0; k < static_cast<int>(handles.size()); ++k)
  {
    if (!rows[k].empty())
    {
      const Points moved = MovedByHandle(handles[k], options.fixedPositions(rows[k], AllColumns));
      RequireNear(mesh, k, moved);
      options.fixedPositions(rows[k], AllColumns) = moved;
      options.fixedTurns(rows[k], AllColumns).rowwise() = handles[k].turn.transpose();
    }
  }
}
} // namespace SphericalStyle
