// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A closed surface cut flat, so that it has a foot to stand on. [foot]
#ifndef SphericalStyle_FlatFoot_h
#define SphericalStyle_FlatFoot_h

#include "ManifoldSurface.h"

namespace SphericalStyle
{
/// Area of the section of a closed surface, facing outward, across an axis. length^2.
double SectionArea(const TriangleMesh& mesh, int axis, double level);

/// Area of the triangles that lie on the lowest level, within `tolerance`. length^2.
double GroundArea(const TriangleMesh& mesh, int axis, double tolerance);

/// The lowest level at which the section is as large as wanted.
/// @param deepest  where the search ends
/// @param most  the largest section up to there
/// @return NaN where none is large enough
double FootLevel(const TriangleMesh& mesh, int axis, double wanted, double deepest, double& most);

/// What is above a level, closed by flat triangles on it (a constrained Delaunay triangulation of
/// the section, CGAL). Points of edges that the cut would leave shorter than a twentieth are moved
/// onto the level instead, so that no sliver comes about. The foot is exactly flat.
/// @param mesh  closed, a manifold
/// @return empty where the section runs through itself
DerivedSurface CutFlat(const TriangleMesh& mesh, int axis, double level);
} // namespace SphericalStyle

#endif
