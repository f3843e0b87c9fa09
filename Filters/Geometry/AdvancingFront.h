// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Triangles from points by an advancing front over their Delaunay triangulation.
#ifndef SphericalStyle_AdvancingFront_h
#define SphericalStyle_AdvancingFront_h

#include "TriangleMesh.h"

namespace SphericalStyle
{
/// CGAL's advancing front surface reconstruction (Cohen-Steiner, Da, A greedy Delaunay-based
/// surface reconstruction algorithm, The Visual Computer 20, 2004). May have holes: see
/// ClosedSurface. Each connected part is oriented alike, but not outward. Points in a plane give no
/// triangles.
/// @param P  n x 3, finite. Deterministic, about n log n.
Triangles AdvancingFront(const Points& P);
} // namespace SphericalStyle

#endif
