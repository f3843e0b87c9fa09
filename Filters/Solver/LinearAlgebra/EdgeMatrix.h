// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Symmetric matrices that are sums over half-edges, on the free points of a mesh.
#ifndef SphericalStyle_EdgeMatrix_h
#define SphericalStyle_EdgeMatrix_h

#include "MeshTopology.h"
#include "SparseCholesky.h"

namespace SphericalStyle
{
/// A = diag(d) + sum_h k_h (x_u - x_v)^2, positive semidefinite sign (diagonal positive), rows and
/// columns of fixed points removed. Half-edges from a point to itself add nothing. The pattern and
/// where each half-edge adds are worked out once.
class EdgeMatrix
{
public:
  EdgeMatrix() = default;
  /// @param fixed  n flags: points whose rows are removed
  EdgeMatrix(const MeshTopology& topology, const std::vector<char>& fixed);

  int GetNumberOfRows() const { return static_cast<int>(this->DiagonalSlots.size()); }
  /// Row of each point, -1 for a fixed one.
  const std::vector<int>& GetRows() const { return this->Rows; }

  /// The lower triangle for the weights k (m x 3) and the diagonal d (n, or empty for 0).
  const SparseCholesky::Matrix& Assemble(const HalfEdgeScalars& k, const Eigen::VectorXd& d = {});

private:
  void NumberRows(const std::vector<char>& fixed);
  void BuildPattern(const Triangles& F);

  SparseCholesky::Matrix A;
  std::vector<int> Rows;
  // Per half-edge: where k adds on the diagonal (start, end) and below it; -1 for nowhere.
  struct Slots
  {
    int start;
    int end;
    int below;
  };
  std::vector<Slots> HalfEdgeSlots;
  std::vector<int> DiagonalSlots; // per row
};
} // namespace SphericalStyle

#endif
