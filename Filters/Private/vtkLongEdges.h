// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A copy of a surface whose long edges are split, so that a flat panel has points that can move.
/// Private.
///
/// VTK's vtkAdaptiveSubdivisionFilter splits, every triangle on its own: what happens to an edge
/// depends on its length alone, so neighbors agree. Used as it is, it would number the new points
/// by their coordinates, and the two sides of a texture seam, or panels that touch, would get one
/// point in common with the texture coordinates of one of them. Here a new point is numbered by the
/// points that it lies between: triangles that share an edge share its points, whether one, two or
/// three of them do, and triangles whose edges only coincide each have their own, at the same place
/// to the last bit. VTK's other subdivision filters split all edges and refuse those of three
/// triangles; CGAL's split_long_edges knows manifolds only and carries no arrays.
#ifndef vtkLongEdges_h
#define vtkLongEdges_h

#include "vtkSmartPointer.h"
#include "vtkSurfaceMeshConversion.h"

#include <utility>
#include <vector>

class vtkDataArray;
class vtkSelection;

namespace vtkLongEdges
{
/// More triangles in place of the split ones are a mistake in the length.
constexpr vtkIdType MaximumNumberOfTriangles = 2000000;

/// Input points that a new point lies between, ascending, and their shares, which sum to 1.
using Origin = std::vector<std::pair<vtkIdType, double>>;

struct Refined
{
  vtkSmartPointer<vtkPolyData> Surface;
  std::vector<Origin> NewPoints; ///< the points after those of the input
};

/// Point arrays whose values are not to be blended, though they may be floating-point numbers.
struct NominalArrays
{
  vtkDataArray* Region = nullptr; ///< 0 at a new point if it is 0 at one of its origin
  vtkDataArray* CenterId = nullptr;
};

/// Splits the edges of all triangles, those of polygons and strips included, that are longer than
/// `length` until none is. Faces without such an edge stay as they are; the others become
/// triangles, in the place of a polygon, and after all polygons for a strip. Vertices and lines
/// stay.
///
/// Points: those of the input first, with their bits, then the new ones, in the input's number type
/// (double unless float). Point arrays: floating-point numbers, and unsigned char of 3 or 4
/// components (colors), are interpolated, active normals at length 1; all others, and nominal ones,
/// have the value of the nearest point of the origin, of the first one if several are equally near.
/// Cell arrays: every child has its parent's value. Global ids lose that role where something was
/// split. Arrays that are too short stay. New arrays: of points RefinedPoint (unsigned char, 1
/// where new), of cells OriginalCell (vtkIdType, the input's cell).
/// @param surface  FromPolyData(input, ...) @param length  fraction of the diagonal of its bounds
/// @throw std::invalid_argument naming MaximumEdgeLength for more than MaximumNumberOfTriangles
Refined Split(vtkPolyData* input, const vtkSurfaceMesh& surface, double length,
  const NominalArrays& nominal = {});

/// What the property RefineLongEdges of a filter means.
enum Refinements
{
  NEVER = 0,
  WHERE_COARSE = 1, ///< where the model has coarse panels: SphericalStyle::CoarseShare
  ALWAYS = 2
};

/// Whether the edges of a model are to be split.
/// @param refinement  a Refinements @param longEdgeShare  see SphericalStyle::LongEdgeShare
bool IsWanted(int refinement, double longEdgeShare);

/// The same selection for the refined surface: by indices, the selected points and the new ones
/// whose origin is all selected.
/// @param selected  one per point of the input
vtkSmartPointer<vtkSelection> Select(const std::vector<char>& selected, const Refined& refined);
}

#endif
