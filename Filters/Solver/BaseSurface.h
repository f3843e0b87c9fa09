// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The smooth base of a model [detail]: what goes to the sphere while the details only turn.
#ifndef SphericalStyle_BaseSurface_h
#define SphericalStyle_BaseSurface_h

#include "MeshTopology.h"

namespace SphericalStyle
{
/// Two implicit smoothing steps (M + s^2 L_c) B_{k+1} = M B_k from B_0 = P, M the lumped areas, L_c
/// the cotangent matrix (positive semidefinite sign).
/// @param P  n x 3 @param cotangents  HalfEdgeCotangents of P
/// @param size  s, model length; details below it leave the base
/// @return B, n x 3. One factorisation of the size of the global step's.
/// @throw SolverError when the system cannot be factored
Points SmoothBase(
  const Points& P, const MeshTopology& topology, const HalfEdgeScalars& cotangents, double size);
} // namespace SphericalStyle

#endif
