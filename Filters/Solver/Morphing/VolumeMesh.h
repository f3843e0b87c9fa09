// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Tetrahedra, pyramids, wedges and hexahedra: their corners, their faces, and how good they are.
#ifndef SphericalStyle_VolumeMesh_h
#define SphericalStyle_VolumeMesh_h

#include "TriangleMesh.h"

#include <array>
#include <vector>

namespace SphericalStyle
{
/// Linear cells, with their points in VTK's order.
enum class CellShape
{
  Tetrahedron,
  Pyramid,
  Wedge,
  Hexahedron
};

struct VolumeMesh
{
  Points P;                      ///< n x 3, length
  std::vector<CellShape> Shapes; ///< m
  std::vector<int> Offsets;      ///< m + 1: where the points of a cell begin in Ids
  std::vector<int> Ids;          ///< 0-based points of the cells

  int GetNumberOfCells() const { return static_cast<int>(this->Shapes.size()); }
  const int* PointsOf(int cell) const { return &this->Ids[this->Offsets[cell]]; }
};

/// A corner of a cell: the point and the three at the other ends of its edges, numbered within the
/// cell and so that the edges are right-handed in a cell that is not inverted.
using CellCorner = std::array<int, 4>;
const std::vector<CellCorner>& CornersOf(CellShape shape);
int NumberOfPoints(CellShape shape);
/// The three edges at a corner of the best cell of a shape, as columns, of length 1. The best
/// pyramid has edges of equal length.
Eigen::Matrix3d BestCorner(CellShape shape);
/// det of those: 1 / sqrt(2), 1 / sqrt(2), sqrt(3) / 2, 1
double BestDeterminant(CellShape shape);

/// Numbers cells the other way round where files mean it, who do not agree on what is up in a wedge
/// and what is left in a tetrahedron: first those that do not agree with their neighbors, who pass
/// a common face in the opposite direction, and then all that hang together by faces if most of
/// their volume is negative. A cell that agrees with its neighbors and is negative has been turned
/// inside out, and stays. @return whether any were
bool OrientCells(VolumeMesh& mesh);

/// Scaled Jacobian [jacobian] of a cell, 1 for the best, 0 or less for an inverted one: the
/// smallest det(e1, e2, e3) / (|e1| |e2| |e3|) over the corners, and the middle of a hexahedron, in
/// units of that of the best cell. 0 where an edge has no length.
/// @param P  n x 3, where the points are
double ScaledJacobian(const VolumeMesh& mesh, int cell, const Points& P);
Eigen::VectorXd ScaledJacobians(const VolumeMesh& mesh, const Points& P, int threads);

/// n flags: 1 for the points of faces that are of one cell only.
std::vector<char> BoundaryPoints(const VolumeMesh& mesh);
/// n flags: 1 for the points of cells.
std::vector<char> UsedPoints(const VolumeMesh& mesh);
} // namespace SphericalStyle

#endif
