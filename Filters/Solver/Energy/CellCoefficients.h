// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The two sums over cells that every iteration needs. Each reads its memory once, in order.
#ifndef SphericalStyle_CellCoefficients_h
#define SphericalStyle_CellCoefficients_h

#include "MeshTopology.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace SphericalStyle
{
/// Who shares a triangle with whom: for every point the others of its triangles, ascending.
class CellPattern
{
public:
  CellPattern() = default;
  explicit CellPattern(const MeshTopology& topology);

  int GetNumberOfPoints() const { return static_cast<int>(this->Offset.size()) - 1; }
  /// Those of point i: GetNeighbors()[GetOffset()[i] .. [i + 1]).
  const std::vector<int>& GetOffset() const { return this->Offset; }
  const std::vector<int>& GetNeighbors() const { return this->Neighbors; }
  /// Where j is in GetNeighbors(), as one of point i; by bisection, since all points may be
  /// neighbors of one. @param less  compares point ids
  template <typename Less = std::less<int>>
  std::ptrdiff_t Find(int i, int j, Less less = {}) const
  {
    const auto begin = this->Neighbors.begin();
    return std::lower_bound(begin + this->Offset[i], begin + this->Offset[i + 1], j, less) - begin;
  }

private:
  std::vector<int> Offset = { 0 };
  std::vector<int> Neighbors;
};

/// What the steps of [energy] need of the weighted edges g_h = c_h e_h + l_h tau_h. With d_k = g of
/// the half-edge that starts at corner k of a triangle, minus g of the one that ends there, and
///
///     w_yj = sum over the triangles at y and j of d at j,
///
/// both steps are sums over neighbors:
///
///     [local]   sum_{f at y} sum_{h in f} g_h e'_h^T = sum_j w_yj (q_j - q_y)^T     (Eq. 4.13)
///     [global]  b_j = sum_y R_y w_yj                                               (Eq. 4.26)
///
/// because e'_h = q_u - q_v, and sum_j w_yj = 0. Nothing is allocated after construction; results
/// have the same bits for any number of threads.
class CellCoefficients
{
public:
  CellCoefficients() = default;
  /// @param pattern  that of the topology; kept by reference, must outlive this
  /// @param weightedEdges  g of the three half-edges of a triangle, as columns, length
  CellCoefficients(const CellPattern& pattern, const MeshTopology& topology,
    const std::function<Eigen::Matrix3d(int triangle)>& weightedEdges, int threads);

  /// S_y of the points begin..end-1. @param Q  n x 3 @param S  9 numbers for each, column-major,
  /// and room for one more
  void Covariances(const Points& Q, int begin, int end, double* S) const;
  /// b of all points, n x 3, replaced.
  void RightHandSide(const Matrices& R, Points& b, int threads) const;

private:
  const CellPattern* Pattern = nullptr;
  // Three numbers per neighbor j of y, and one more number at the end.
  std::vector<double> OfCell;  // w_yj, of the cell of y
  std::vector<double> OfPoint; // w_jy, of the cell of j
  Points Own;                  // w_yy
};
} // namespace SphericalStyle

#endif
