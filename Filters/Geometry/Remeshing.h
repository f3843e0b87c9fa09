// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// New triangles for a surface that stays where it is.
#ifndef SphericalStyle_Remeshing_h
#define SphericalStyle_Remeshing_h

#include "TriangleMesh.h"

namespace SphericalStyle
{
/// Length of the edges of n points in equilateral triangles on a surface of that area.
double EdgeLengthFor(double area, int numberOfPoints);

/// Even, well-shaped triangles (Botsch, Kobbelt, A remeshing approach to multiresolution modeling,
/// 2004). Sharp edges and corners stay, blunt corners of a border are rounded.
/// @param mesh  a manifold
TriangleMesh IsotropicRemeshing(const TriangleMesh& mesh, double edgeLength);

/// Cuts edges in half until none is longer: the surface stays exactly what it is, slivers stay
/// slivers.
TriangleMesh SplitLongEdges(TriangleMesh mesh, double edgeLength);
} // namespace SphericalStyle

#endif
