// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeshMorphingFilter
 * @brief   carry a volume mesh, an image or points along with a rounded surface
 *
 * The surface of a simulation mesh can be rounded, and this filter takes the rest of the mesh
 * along:
 *
 *     volume mesh -> vtkDataSetSurfaceFilter -> vtkSphericalStyleFilter -> Surface
 *     volume mesh -----------------------------------------------------> Input
 *
 * Input port 0: any vtkDataSet.
 *  - Volume cells (tetrahedra, pyramids, wedges, hexahedra, voxels; also those of a structured
 *    grid): points of the boundary go where the surface went, and inner points to where a
 *    foldover-free energy [untangle] is smallest, which keeps each cell as it was and none
 *    inverted, where that is possible.
 *  - Points of no volume cell (of surfaces, lines, clouds), and images and rectilinear grids: the
 *    surface carries the space around it [near], rigidly where it moves rigidly.
 *
 * Input port 1: vtkPolyData, the surface after it has moved, with the point array Displacement (3,
 * length; moved minus rest) that the filters which move points make. For volume cells it needs a
 * point at each point of their boundary, in any order; it may have more, as where long edges were
 * split. For other points it needs triangles.
 *
 * Output: the same kind of data set, or vtkStructuredGrid for an image or a rectilinear grid, with
 * the same cells and arrays and moved points, in the number type of the input's points (double for
 * images), and
 *  - Displacement (3), points: output minus input point, length.
 *
 * With volume cells, field data of one value each: SmallestScaledJacobianBefore,
 * SmallestScaledJacobianAfter. The scaled Jacobian [jacobian] is 1 for the best cell, 0 for a flat
 * one, below 0 for an inverted one: that of vtkMeshQuality, but for pyramids. No unit.
 *
 * Cells whose points most of the volume of their shape is negative with are taken as numbered the
 * other way round, as wedges of some programs are.
 *
 * Errors, with the first id: cells of other kinds with a volume (quadratic, polyhedra); a point of
 * the boundary with no point of the surface within 1e-6 of the diagonal; cells that are inverted in
 * the output and were not in the input, with their number and the smallest scaled Jacobian, and
 * whether the surface alone makes that so; points that are not finite; no surface, which is
 * optional for VTK only, so that the message can say what to take; no array Displacement. A
 * warning: cells that were inverted in the input and still are.
 *
 * Source: V. Garanzha, I. Kaporin, L. Kudryavtseva, F. Protais, N. Ray, D. Sokolov, Foldover-free
 * maps in 50 lines of code, ACM Transactions on Graphics 40(4), 2021 [untangle]; E. Luke, E.
 * Collins, E. Blades, A fast mesh deformation method using explicit interpolation, Journal of
 * Computational Physics 231(2), 2012 [near]. The thesis rounds surfaces only. The bracketed labels
 * are those of Filters/Documentation/MeshMorphing.md.
 *
 * Cost: volume cells: two to some tens of steps, each a solve by conjugate gradients of three rows
 * for each inner point; 0.5 kB for each tetrahedron, 3 kB for each hexahedron. Other points: 20
 * microseconds for each.
 *
 * @sa vtkSphericalStyleFilter vtkWarpVector vtkMeshQuality
 */
#ifndef vtkMeshMorphingFilter_h
#define vtkMeshMorphingFilter_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkPointSetAlgorithm.h"

class vtkPolyData;

class SPHERICALSTYLEFILTERS_EXPORT vtkMeshMorphingFilter : public vtkPointSetAlgorithm
{
public:
  static vtkMeshMorphingFilter* New();
  vtkTypeMacro(vtkMeshMorphingFilter, vtkPointSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The surface of input port 1.
   */
  void SetSurfaceConnection(vtkAlgorithmOutput* surface);
  void SetSurfaceData(vtkPolyData* surface);
  ///@}

  ///@{
  /**
   * Turn vectors and tensors with the mesh [turn]: arrays of points and cells of floating-point
   * numbers with 3 components (R v), and with 9 or 6 (R T R^T; 6 are xx, yy, zz, xy, yz, xz). R is
   * the rotation of the volume cells around a point, or of the surface near it, and of a cell the
   * one closest to the mean of those of its points. Active texture coordinates and what belongs to
   * points at which nothing moves stay as they are, and active normals turn in any case. Default
   * off.
   */
  vtkSetMacro(TransformAllInputVectors, bool);
  vtkGetMacro(TransformAllInputVectors, bool);
  vtkBooleanMacro(TransformAllInputVectors, bool);
  ///@}

  ///@{
  /**
   * Facts of the last execution: volume cells, those of them that are inverted in the output (they
   * were in the input, or there is an error), the smallest scaled Jacobians, NaN without volume
   * cells, and the steps that it took.
   */
  vtkGetMacro(NumberOfVolumeCells, vtkIdType);
  vtkGetMacro(NumberOfInvertedCells, vtkIdType);
  vtkGetMacro(SmallestScaledJacobianBefore, double);
  vtkGetMacro(SmallestScaledJacobianAfter, double);
  vtkGetMacro(NumberOfIterations, int);
  ///@}

protected:
  vtkMeshMorphingFilter();
  ~vtkMeshMorphingFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMeshMorphingFilter(const vtkMeshMorphingFilter&) = delete;
  void operator=(const vtkMeshMorphingFilter&) = delete;

  /// RequestData, which turns what this throws into a message.
  int Execute(vtkInformationVector** inputVector, vtkInformationVector* outputVector);

  // Its steps.
  struct Execution;
  void MoveVolume(Execution& e);
  void MoveOthers(Execution& e);
  void FillOutput(const Execution& e);
  void JudgeVolume(const Execution& e);
  void GoOn(double progress);

  bool TransformAllInputVectors = false;
  vtkIdType NumberOfVolumeCells = 0;
  vtkIdType NumberOfInvertedCells = 0;
  double SmallestScaledJacobianBefore = 0.0;
  double SmallestScaledJacobianAfter = 0.0;
  int NumberOfIterations = 0;
};

#endif
