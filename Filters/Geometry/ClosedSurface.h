// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// From the triangles of a reconstruction to one closed surface.
#ifndef SphericalStyle_ClosedSurface_h
#define SphericalStyle_ClosedSurface_h

#include "TriangleMesh.h"

namespace SphericalStyle
{
/// Every edge has two triangles, in opposite directions, and the triangles at every point form one
/// fan. Points of no triangle are not looked at.
bool IsClosedManifold(const Triangles& F, int numberOfPoints);

struct ClosedSurfaceResult
{
  TriangleMesh mesh;   ///< only points that a triangle uses; oriented outward
  int holesClosed = 0; ///< borders that were filled
  bool closed = false; ///< a manifold of genus 0 in one piece, no triangle without height
};

/// Orients the triangles alike, takes the connected part of most triangles and fills its holes; in
/// large ones with new points. Before that, triangles are taken out that are no triangles, lie on
/// another, are the third at an edge, or form a second fan at a point. A surface with one side is
/// cut open and not closed.
/// @param P, F  any triangles
ClosedSurfaceResult CloseSurface(const Points& P, const Triangles& F);

/// Fills the holes of a surface, where a border lies in a plane in that plane; in large ones with
/// new points. Points and triangles keep their numbers, new ones follow. The same surface is filled
/// alike each time.
/// @param mesh  a manifold, all triangles facing alike @return how many holes there were
int FillHoles(TriangleMesh& mesh);
} // namespace SphericalStyle

#endif
