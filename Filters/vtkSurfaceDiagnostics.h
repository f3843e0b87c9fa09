// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceDiagnostics
 * @brief   what is wrong with a surface, where, and what the filters do about it
 *
 * Inspects a surface before anything is done with it. Nothing is repaired or left out.
 *
 * Input: vtkPolyData of any kind: points that are not finite, cells of all kinds. Polygons and
 * strips count as the triangles they are cut into; vertices and lines pass.
 *
 * Output port 0: vtkPolyData, the input with point and cell arrays of the names below, 1 where the
 * defect is and 0 elsewhere (those of edges: at the edge's ends and on the cells beside it), and
 *  - Diagnosis (1), points and cells: the sum of 2^k over the defects k that are there;
 *  - Component (1), cells: which part the cell belongs to, from 0; -1 for cells without a triangle
 *    that has an area.
 *
 * Output port 1: vtkTable, one row for each kind of finding, always the same rows in this order
 * (first the defects k = 0..12 of Diagnosis): NonFinitePoints, CoincidentPoints, UnusedPoints,
 * NonManifoldPoints (points only), DegenerateTriangles, DuplicateTriangles, Slivers,
 * ObtuseTriangles (cells only), NonManifoldEdges, BorderEdges, MisorientedEdges, NegativeWeights
 * (points and cells), InsideOutComponents (cells only); then, not marked, BorderLoops, Components,
 * UncutPolygons, ExtremeScale, FewDigits, ManyTriangles. Its columns:
 *  - Name; Count; Value (share of what there is of it; for the last three the diagonal, the decimal
 *    digits left, the share of what can be solved at once);
 *  - Association ("point" or "cell") and FirstId: the first one, -1 for none;
 *  - Meaning, and Consequence: what the filters do about it.
 *
 * Exact definitions: Filters/Documentation/SurfaceDiagnostics.md.
 *
 * Source: obtuse triangles and negative weights are those of Research of Spherical Style
 * Deformation on Single Component Models (doctoral thesis), Eq. 2.4 and 4.7; the rest is not in it.
 *
 * Errors: a point id out of range (the first cell is named), more than 238,609,294 points or
 * triangles, SliverAngle not finite; where the surface is spread over processes, see
 * vtkWholeSurfaceAlgorithm, also a point that is not finite.
 *
 * Cost: some milliseconds per 10,000 triangles.
 *
 * @sa vtkSurfaceMetrics vtkCleanPolyData vtkFeatureEdges
 */
#ifndef vtkSurfaceDiagnostics_h
#define vtkSurfaceDiagnostics_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkSetRangeMacro.h"            // for its macro
#include "vtkWholeSurfaceAlgorithm.h"

class SPHERICALSTYLEFILTERS_EXPORT vtkSurfaceDiagnostics : public vtkWholeSurfaceAlgorithm
{
public:
  static vtkSurfaceDiagnostics* New();
  vtkTypeMacro(vtkSurfaceDiagnostics, vtkWholeSurfaceAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * A triangle with an angle below this counts as a sliver. Degrees. Default 1, range 0 to 60.
   */
  vtkSetRangeMacro(SliverAngle, double, 0.0, 60.0);
  vtkGetMacro(SliverAngle, double);
  ///@}

  ///@{
  /**
   * Take coincident points as one, as the filters do, so that texture seams and split normals are
   * no borders. Coincident points are counted either way. Default on.
   */
  vtkSetMacro(WeldCoincidentPoints, bool);
  vtkGetMacro(WeldCoincidentPoints, bool);
  vtkBooleanMacro(WeldCoincidentPoints, bool);
  ///@}

protected:
  vtkSurfaceDiagnostics();
  ~vtkSurfaceDiagnostics() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestWholeData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSurfaceDiagnostics(const vtkSurfaceDiagnostics&) = delete;
  void operator=(const vtkSurfaceDiagnostics&) = delete;

  /// RequestWholeData, which turns what this throws into a message.
  int Execute(vtkInformationVector** inputVector, vtkInformationVector* outputVector);

  double SliverAngle = 1.0;
  bool WeldCoincidentPoints = true;
};

#endif
