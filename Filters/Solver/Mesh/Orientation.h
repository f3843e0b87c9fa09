// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Triangles that agree on what is outside.
#ifndef SphericalStyle_Orientation_h
#define SphericalStyle_Orientation_h

#include "SurfacePart.h"

namespace SphericalStyle
{
/// The triangles with those turned round that disagree with the others: the two at an edge are made
/// to agree, and what hangs together in this way faces the way that most of its area did. Edges of
/// three and more triangles connect nothing; a Moebius strip keeps a seam.
/// Where a surface is spread over processes, what hangs together across them is found from the
/// edges between two points that several processes have.
/// @return m x 3, in the order of F, a triangle that turns round with its last two corners swapped
/// @throw WholeSurfaceNeeded for a surface with one side, as where its seam is depends on the order
///        of its triangles, where it is spread
Triangles OrientAlike(const Points& P, const Triangles& F, const SurfacePart& part = {});

/// The same, turned so that the enclosed volume is not negative.
Triangles OrientOutward(const Points& P, const Triangles& F, const SurfacePart& part = {});
} // namespace SphericalStyle

#endif
