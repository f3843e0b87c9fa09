// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Repairs, and less roundness, where the surface would fold or run through itself [guard].
#ifndef SphericalStyle_FoldGuard_h
#define SphericalStyle_FoldGuard_h

#include "RestContacts.h"
#include "TriangleMesh.h"

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace SphericalStyle
{
/// Pairs (f, g), f < g, in order, of triangles that run through each other. Every triangle that it
/// is given has an area. See Geometry/SelfIntersections.
using IntersectionSearch = std::function<std::vector<std::array<int, 2>>(const TriangleMesh&)>;

/// Solves with lambda_i times shares(i), n shares in 0..1, and gives the n deformed points; no
/// point when somebody asked to end. The same shares give the same bits. n shares of exactly 1 are
/// the solve without a guard.
using ShareSolve = std::function<Points(const Eigen::VectorXd& shares)>;

/// What is wrong with a deformed surface.
struct Folds
{
  int turnedOver = 0;         ///< triangles, see TurnedOver in DeformationMeasures.h
  int newPairs = 0;           ///< of intersecting triangles, see FoldFinder
  std::vector<int> triangles; ///< all that are meant by either, ascending

  bool Any() const { return !this->triangles.empty(); }
};

/// Looks for folds of one rest surface in any number of deformed ones: triangles that turn over,
/// and pairs of triangles that run through each other and did not at rest, unless parts of the
/// surface did so next to them (RestContacts).
class FoldFinder
{
public:
  /// @param rest  every triangle has an area; kept by reference, must outlive this
  /// @param singlePrecision  look at the points rounded to float, as they will be written
  FoldFinder(
    const TriangleMesh& rest, IntersectionSearch search, bool singlePrecision, int threads);

  /// Triangles without an area in Q have no side and meet nothing. The rest shape is searched once,
  /// when first something intersects in a Q. @param Q  n x 3
  /// @param places  of triangles. If there are any, only pairs with a triangle in a place are sure
  /// to
  ///        be found: the caller knows that all others have no new pairs
  Folds Find(const Points& Q, const std::vector<std::vector<int>>& places = {});

private:
  std::vector<std::array<int, 2>> Pairs(const Points& Q, const std::vector<int>& triangles) const;
  std::vector<int> Near(const Points& Q, const std::vector<int>& triangles,
    const std::vector<std::vector<int>>& places) const;
  std::vector<std::array<int, 2>> NewPairs(const std::vector<std::array<int, 2>>& pairs);
  Points Written(const Points& Q) const;

  const TriangleMesh& Rest;
  IntersectionSearch Search;
  bool SinglePrecision;
  int Threads;
  std::optional<std::vector<std::array<int, 2>>> RestPairs;
  RestContacts Contacts; // of the rest pairs
};

struct FoldGuardOptions
{
  int lowerings = 12;           ///< most rounds of less lambda
  int raisings = 12;            ///< most rounds of more where there is room
  int repairs = 3;              ///< most widths of the small places that are repaired, each round
  int blends = 8;               ///< most rounds of the last resort, then again as many
  bool singlePrecision = false; ///< see FoldFinder
  int threads = 1;
};

struct FoldGuardReport
{
  Points positions;       ///< n x 3: of the last solve, but where repaired or blended
  Eigen::VectorXd shares; ///< n, above 0 to 1: of lambda, what remained; of the last solve
  double meanShare = 1.0; ///< their mean over the surface
  Folds before;           ///< with all of lambda
  Folds after;            ///< none, unless aborted
  int solves = 0;
  int repaired = 0;     ///< points that were moved as their surroundings move
  bool blended = false; ///< the last resort was needed
  bool aborted = false; ///< somebody asked to end: there are no positions
};

/// Deforms without folds [guard]. Where triangles turn over or newly intersect in small places, the
/// points there are moved as their surroundings move. Else lambda is lowered everywhere and the
/// model solved again, at most `lowerings` times; then it grows again where that brings nothing
/// back. Shares differ by no more than a factor of 2 over a third of the diagonal along edges and
/// stitches. If folds are left, the result goes back to the rest shape, first where they are and
/// then all over: there it has none.
/// @param rest  every triangle has an area
/// Cost: at most lowerings + raisings + 1 solves and searches, 2 * blends searches more with the
/// last resort, and one of each if the last trial was not the best; one of each where nothing
/// folds. After each solve, up to `repairs` searches around small places.
FoldGuardReport SolveWithoutFolds(const TriangleMesh& rest, const FoldGuardOptions& options,
  const IntersectionSearch& search, const ShareSolve& solve);
} // namespace SphericalStyle

#endif
