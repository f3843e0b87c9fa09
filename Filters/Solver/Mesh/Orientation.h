// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Triangles that agree on what is outside.
#ifndef SphericalStyle_Orientation_h
#define SphericalStyle_Orientation_h

#include "TriangleMesh.h"

namespace SphericalStyle
{
/// The triangles with those turned round that disagree with the others: the two at an edge are made
/// to agree, and what hangs together in this way faces the way that most of its area did. Edges of
/// three and more triangles connect nothing; a Moebius strip keeps a seam.
/// @return m x 3, in the order of F, a triangle that turns round with its last two corners swapped
Triangles OrientAlike(const Points& P, const Triangles& F);
} // namespace SphericalStyle

#endif
