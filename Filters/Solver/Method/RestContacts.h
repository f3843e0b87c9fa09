// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where parts of a surface run through each other before it is deformed [guard].
#ifndef SphericalStyle_RestContacts_h
#define SphericalStyle_RestContacts_h

#include "TriangleMesh.h"

#include <array>
#include <vector>

namespace SphericalStyle
{
/// Eyes run through the head that they are in, and hair does, too. When such a model is deformed
/// they slide along, so that other triangles than before run through each other, next to those.
class RestContacts
{
public:
  RestContacts() = default;

  /// @param pairs  of triangles that run through each other
  /// Cost: for each two parts of the surface that meet, shortest paths in a strip along the place.
  RestContacts(const TriangleMesh& rest, const std::vector<std::array<int, 2>>& pairs);

  /// Whether the triangles are of two connected parts, and both lie within 3 % of the diagonal,
  /// along edges, of where these parts run through each other in the rest shape.
  bool AreNear(const std::array<int, 2>& pair) const;

private:
  int GetPart(int f) const { return this->PartOf[this->F(f, 0)]; }
  bool IsNear(int f, int part) const;

  Triangles F;
  std::vector<int> PartOf;             // of each point
  std::vector<std::vector<int>> Parts; // of each point those near, ascending; none without pairs
};
} // namespace SphericalStyle

#endif
