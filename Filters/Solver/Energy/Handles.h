// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Handles [handles]: points of a surface that are held, and moved as one rigid piece.
#ifndef SphericalStyle_Handles_h
#define SphericalStyle_Handles_h

#include "StyleSolver.h"

#include <string>

namespace SphericalStyle
{
/// The points within a ball, and their motion p -> to + R (p - place).
struct Handle
{
  Eigen::Vector3d place = Eigen::Vector3d::Zero(); ///< c, in model coordinates
  double radius = 0.0;                             ///< of the ball, length, 0 or more
  Eigen::Vector3d to = Eigen::Vector3d::Zero();    ///< where c goes
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();  ///< rotation vector of R, radians, of any length

  /// Whether it neither moves nor turns: its points keep their bits.
  bool Stays() const { return this->to == this->place && this->turn.isZero(0.0); }
};

/// The rotation about the vector's direction by its length, radians.
Eigen::Matrix3d RotationOfVector(const Eigen::Vector3d& turn);

/// Where a handle takes points, m x 3.
Points MovedByHandle(const Handle& handle, const Points& P);

/// Two handles hold the same point.
class PointInTwoHandles : public std::invalid_argument
{
public:
  PointInTwoHandles(int point, int first, int second)
    : std::invalid_argument("point " + std::to_string(point) + " is in handles " +
        std::to_string(first) + " and " + std::to_string(second))
    , Point(point)
    , First(first)
    , Second(second)
  {
  }

  int Point; ///< the first one
  int First; ///< place of the handles among the handles
  int Second;
};

/// The handle of each point: those within its radius of its place, borders included, and always the
/// nearest one, of equally near ones the first. n times the number of handles.
/// @param P  n x 3, n > 0 @param handles  finite, radii 0 or more
/// @return n, places among the handles; -1 for points of none @throw PointInTwoHandles
std::vector<int> HandlesOfPoints(const Points& P, const std::vector<Handle>& handles);

/// Holds the points of handles: sets the fixed points of the options, with their positions and
/// turns. With parts that are Independent, those without a handle are held where they are.
/// @param ofPoints  n, see HandlesOfPoints
/// @throw std::invalid_argument for a handle, counted from 1, that takes a point farther than a
///        million diagonals of the bounds
void HoldHandles(const TriangleMesh& mesh, const std::vector<Handle>& handles,
  const std::vector<int>& ofPoints, StyleOptions& options);
} // namespace SphericalStyle

#endif
