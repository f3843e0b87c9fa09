// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What is wrong with a mesh, or could be, before anything is done with it: counts, first numbers,
/// and which points and triangles it is. [diagnosis]
#ifndef SphericalStyle_MeshDiagnosis_h
#define SphericalStyle_MeshDiagnosis_h

#include "TriangleMesh.h"

#include <array>
#include <limits>

namespace SphericalStyle
{
/// Most triangles, and most points, that a mesh may have: entries of its matrices, nine a triangle,
/// are numbered by int.
constexpr int MostTriangles = std::numeric_limits<int>::max() / 9;

/// In the order of their bits. Except for the first four they are marked on triangles. Those of
/// edges are marked on the triangles at the edge and on its ends.
enum class Defect
{
  NonFinitePoints,     ///< a coordinate is NaN or infinite
  CoincidentPoints,    ///< at the place of an earlier point
  UnusedPoints,        ///< of no usable triangle
  NonManifoldPoints,   ///< whose triangles do not hang together by edges at the point (bow-ties)
  DegenerateTriangles, ///< IsDegenerate, or a point twice
  DuplicateTriangles,  ///< of the same three points as an earlier one, in any order
  Slivers,             ///< smallest angle below DiagnosisOptions::sliverAngle
  ObtuseTriangles,     ///< largest angle above 90 degrees; a cosine within RightAngle of 0 is none
  NonManifoldEdges,    ///< of three or more triangles
  BorderEdges,         ///< of one triangle
  MisorientedEdges,    ///< that two triangles run through in the same direction
  NegativeWeights,     ///< whose cotangent sum w (Eq. 2.4) is below -RightAngle
  InsideOutComponents  ///< closed, with a volume below 0, and no cavity of others
};
constexpr int NumberOfDefects = static_cast<int>(Defect::InsideOutComponents) + 1;

/// The bit of a defect in the marks.
constexpr unsigned Bit(Defect defect)
{
  return 1U << static_cast<unsigned>(defect);
}

/// Whether the defect is one of points; the others have triangles.
constexpr bool IsOfPoints(Defect defect)
{
  return defect <= Defect::NonManifoldPoints;
}

struct DiagnosisOptions
{
  bool weld = true;         ///< coincident points are one for all that follows
  double sliverAngle = 1.0; ///< degrees
};

struct Finding
{
  int count = 0;  ///< points, triangles, edges or components
  int first = -1; ///< point or triangle, -1 for none
};

struct MeshDiagnosis
{
  std::array<Finding, NumberOfDefects> findings;
  const Finding& operator[](Defect defect) const
  {
    return this->findings[static_cast<std::size_t>(defect)];
  }

  std::vector<unsigned> pointMarks;    ///< n sums of Bit
  std::vector<unsigned> triangleMarks; ///< m sums of Bit
  std::vector<int> components;         ///< m, component of each triangle, -1 where it is not usable

  Finding parts;       ///< components; the first triangle of the second one
  Finding borderLoops; ///< that do not touch; their first point
  int points = 0;      ///< places of usable triangles
  int usableTriangles = 0;
  int edges = 0;         ///< of usable triangles
  double diagonal = 0.0; ///< of the bounds of usable triangles, length; may be infinite
  double largest = 0.0;  ///< magnitude of their coordinates, length
};

/// Examines any triangles at all. A triangle is usable if its corners are finite and it is not
/// degenerate, as the filters have it; edges, points' neighborhoods, components and angles are
/// those of usable triangles. Some milliseconds per 10,000 triangles.
/// @param P  n x 3, may have NaN @param F  m x 3
/// @throw std::invalid_argument for a corner outside 0..n-1, and for too many triangles or points
MeshDiagnosis Diagnose(const Points& P, const Triangles& F, const DiagnosisOptions& options = {});

/// Decimal digits that are left for the shape: log10 of diagonal over the distance between
/// neighboring numbers at the largest coordinate; 0 or more.
double DigitsLeft(double diagonal, double step);
/// Fewer, and points move by more than a ten-thousandth of the diagonal when they are rounded.
constexpr double FewDigits = 4.0;

/// Diagonals from which squares fit into single precision, in which views and many filters compute:
/// that of the diagonal, and at the lower end those of lengths of a ten-thousandth of it.
constexpr double SmallestDiagonal = 1e-15;
constexpr double LargestDiagonal = 1e19;
} // namespace SphericalStyle

#endif
