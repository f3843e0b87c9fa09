// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The edges of the part of a surface that this process has, and what hangs together over all
/// parts.
#ifndef SphericalStyle_EdgePart_h
#define SphericalStyle_EdgePart_h

#include "MeshEdges.h"
#include "SurfacePart.h"

namespace SphericalStyle
{
/// Which edges other processes have, too: those between the same two points. Each counts on one of
/// them. By default the surface is all here.
class EdgePart
{
public:
  EdgePart() = default;
  /// @param points  of the triangles; to be called by all processes
  EdgePart(const Triangles& F, const MeshEdges& edges, const SurfacePart& points);

  bool Counts(int e) const { return this->Edges.Counts(e); }
  /// Edges that others have, in no order.
  const std::vector<int>& GetShared() const { return this->Edges.shared; }
  /// Position of an edge among them, -1 for one that is here alone.
  int GetRow(int e) const { return this->Rows.empty() ? -1 : this->Rows[e]; }
  /// Whether the smaller of its points here is the larger one by the numbers that all processes
  /// give to shared points.
  bool IsTurned(int row) const { return this->Turned[row] != 0; }
  /// Rows at edges that several processes have become the sum of theirs.
  /// @param numbers  GetShared().size() x columns, row by row
  void SumRows(double* numbers, int columns) const { this->OfRows.SumAtShared(numbers, columns); }
  /// For sums of what is no edge.
  const SurfacePart& GetProcesses() const { return this->Everybody; }

private:
  SurfacePart Everybody;
  SurfacePart Edges;
  SurfacePart OfRows;
  std::vector<int> Rows;
  std::vector<char> Turned;
};

/// How many parts of the surface are connected by edges or points.
/// @param n  number of points; each belongs to a triangle, on this process or another
int CountComponents(const Triangles& F, Eigen::Index n, const SurfacePart& part);
} // namespace SphericalStyle

#endif
