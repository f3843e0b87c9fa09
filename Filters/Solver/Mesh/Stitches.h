// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Edges between the parts of a model [stitch]: parts that share no triangle travel and turn with
/// their surroundings.
#ifndef SphericalStyle_Stitches_h
#define SphericalStyle_Stitches_h

#include "TriangleMesh.h"

namespace SphericalStyle
{
/// c_h of a stitch: the half cotangent of an equilateral triangle, 1 / (2 sqrt(3)). Half cotangents
/// have no unit and the energy of a sheet does not depend on its triangles, so this is the size of
/// an edge of any mesh, also where its own triangles are slivers.
constexpr double StitchWeight = 0.28867513459481287;

/// An edge besides those of the triangles, u < v.
struct Stitch
{
  int u;
  int v;
  double weight = 1.0; ///< of StitchWeight, above 0 to 1
};

/// Joins the parts of a model by its rest positions: few edges where parts touch or lie nearest,
/// none through empty space where shorter ones do. With gap(A) the distance of part A to the part
/// nearest to it and h the mean edge length (at the end where it is smaller), a point of A is
/// joined to the nearest point of any other part B, when that is within
///
///     reach = 1.5 max(gap(A), gap(B)) + h,
///
/// and each point is taken as nearest by at most one point of a part: the closest. What this has
/// joined counts as one part then, until there is one. Where two parts would hang on a hinge (all
/// their stitches within h / 4 of a line), up to three are added from a reach that doubles until it
/// is none.
///
/// The energy of an edge grows with the square of its length, and a speck that nothing else holds
/// goes along with any weight: a stitch that is more than ten times as long as the smaller of the
/// two parts has the weight (10 extent / length)^2, but at least 1e-6. Else one speck far away
/// would brace a model.
/// @param P  n x 3 @param F  m x 3 @param components  n, 0..K-1: the part of each point
/// @return ascending, each once; none for one part. Depends on neither place, scale nor the order
/// of
///         points, up to ties. About n log n for each time that the number of parts halves at least
std::vector<Stitch> FindStitches(
  const Points& P, const Triangles& F, const std::vector<int>& components);
} // namespace SphericalStyle

#endif
