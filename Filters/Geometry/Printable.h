// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A closed surface made ready for a 3D printer: options in, surface and report out.
#ifndef SphericalStyle_Printable_h
#define SphericalStyle_Printable_h

#include "FlatFoot.h"

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace SphericalStyle
{
/// No cut is deeper than this share of the height, and nothing leans more than this, in degrees.
constexpr double DeepestCut = 0.2;
constexpr double MostLean = 10.0;

struct PrintableOptions
{
  int axis = 1;           ///< that points up
  double footArea = 0.03; ///< share of the bounds' rectangle, or more so that it stands; 0: no cut
  double stabilityAngle = 10.0; ///< degrees; 0: it does not lean
  double thickness = 0.0;       ///< of walls of the result at least, length; 0: as they are
  double volume = 0.0;          ///< of the result, length^3; 0: that of the mesh
  double height = 0.0;          ///< of the result, length; 0: as the volume says
  int threads = 1;
  std::function<void()> onStep = [] {}; ///< called before each step; what it throws ends all of it
};

/// What is measured before and after.
struct PrintableMeasures
{
  double footLevel = 0.0; ///< lowest level, length
  double footArea = 0.0;  ///< of what lies on it, length^2
  double height = 0.0;    ///< length
  double volume = 0.0;    ///< length^3
  Eigen::Vector3d centerOfMass = Eigen::Vector3d::Zero();
  double tiltAngle = 0.0;                                     ///< degrees
  int selfIntersecting = 0;                                   ///< triangles
  double thickness = std::numeric_limits<double>::infinity(); ///< the least one [walls], length
};

struct PrintableResult
{
  DerivedSurface surface;
  PrintableMeasures before;
  PrintableMeasures after;
  Eigen::VectorXd thickness;        ///< of each point, or infinite [walls], length
  double cutDepth = 0.0;            ///< length, of the mesh
  double lean = 0.0;                ///< degrees
  double factor = 1.0;              ///< of the size
  double thickened = 0.0;           ///< the longest motion of a point, length, of the mesh
  bool isSizeShort = false;         ///< thicker walls are no thicker after the scale to the size
  std::vector<std::string> remarks; ///< of a foot or an angle out of reach, or a deep cut
};

/// @param mesh  closed, a manifold by edges, facing outward
/// @throw std::invalid_argument naming the property and the way out
PrintableResult MakePrintable(const TriangleMesh& mesh, const PrintableOptions& options);
} // namespace SphericalStyle

#endif
