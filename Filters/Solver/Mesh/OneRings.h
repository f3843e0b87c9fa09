// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The points that a point shares an edge with, and the weights of those edges.
#ifndef SphericalStyle_OneRings_h
#define SphericalStyle_OneRings_h

#include "MeshTopology.h"

namespace SphericalStyle
{
/// N(i) of every point with w_ij, the sum of c_h over the triangles at edge ij (Eq. 2.4): once per
/// undirected edge, on open and non-manifold meshes too.
class OneRings
{
public:
  struct Neighbor
  {
    int point;
    double weight; ///< w_ij, no unit
  };
  /// To be used in range-based for loops.
  struct Range
  {
    const Neighbor* first;
    const Neighbor* last;
    const Neighbor* begin() const { return this->first; }
    const Neighbor* end() const { return this->last; }
    int size() const { return static_cast<int>(this->last - this->first); }
  };

  OneRings() = default;
  /// @param c  m x 3 half cotangents
  OneRings(const MeshTopology& topology, const HalfEdgeScalars& c);

  int GetNumberOfPoints() const { return static_cast<int>(this->Offset.size()) - 1; }
  /// N(i), points ascending; i is not among them.
  Range operator[](int i) const
  {
    const Neighbor* data = this->Neighbors.data();
    return { data + this->Offset[i], data + this->Offset[i + 1] };
  }

private:
  std::vector<int> Offset = { 0 };
  std::vector<Neighbor> Neighbors;
};
} // namespace SphericalStyle

#endif
