// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Triangles inside of polygons in a plane.
#ifndef SphericalStyle_PlanarPolygons_h
#define SphericalStyle_PlanarPolygons_h

#include "TriangleMesh.h"

#include <array>
#include <functional>
#include <vector>

namespace SphericalStyle
{
/// The constrained Delaunay triangulation of all places that an odd number of polygons is around.
/// It is unique, also where more than three points lie on a circle (CGAL).
/// @param edges  of all polygons, by numbers of points, in any order
/// @param placeOf  of a point with such a number
/// @param triangles  gets numbers of points, counterclockwise
/// @return false where edges cross each other, or two points have one place; triangles are as
/// before then
bool FillPlanarPolygons(const std::vector<std::array<int, 2>>& edges,
  const std::function<Eigen::Vector2d(int)>& placeOf, std::vector<std::array<int, 3>>& triangles);
} // namespace SphericalStyle

#endif
