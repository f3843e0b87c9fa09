// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStyleAlgorithm
 * @brief   superclass of the filters that move the points of a surface
 *
 * What they have in common: a surface at input port 0 (vtkWholeSurfaceAlgorithm), number type and
 * normals of the output, and threads.
 *
 * @sa vtkIterativeStyleAlgorithm
 */
#ifndef vtkStyleAlgorithm_h
#define vtkStyleAlgorithm_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkSetRangeMacro.h"            // for its macro
#include "vtkWholeSurfaceAlgorithm.h"

class SPHERICALSTYLEFILTERS_EXPORT vtkStyleAlgorithm : public vtkWholeSurfaceAlgorithm
{
public:
  vtkTypeMacro(vtkStyleAlgorithm, vtkWholeSurfaceAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Number type of the output points: vtkAlgorithm::DEFAULT_PRECISION (default: as the input),
   * SINGLE_PRECISION or DOUBLE_PRECISION. Computed in double always.
   */
  vtkSetRangeMacro(OutputPointsPrecision, int, SINGLE_PRECISION, DEFAULT_PRECISION);
  vtkGetMacro(OutputPointsPrecision, int);
  ///@}

  ///@{
  /**
   * Threads to compute with; 0 (default) takes what vtkSMPTools was given, or else
   * VTK_SMP_MAX_THREADS, or else all cores that the process may run on, with MPI its share of those
   * of the machine. The result has the same bits for any number.
   */
  vtkSetRangeMacro(NumberOfThreads, int, 0, 1024);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  ///@{
  /**
   * Add point normals of the result also if the input has none; if it has, they are always
   * recomputed. Default off.
   */
  vtkSetMacro(GenerateNormals, bool);
  vtkGetMacro(GenerateNormals, bool);
  vtkBooleanMacro(GenerateNormals, bool);
  ///@}

  ///@{
  /**
   * Turn vectors and tensors with the surface [vectors], as vtkTransformFilter does: arrays of
   * points and cells of floating-point numbers with 3 components (R v), and with 9 or 6 (R T R^T; 6
   * are xx, yy, zz, xy, yz, xz). R is the rotation of the surface at a point, and of a cell the one
   * closest to the mean of those of its points. Lengths stay. Active texture coordinates stay as
   * they are, and so does what belongs to points at which no triangle moves. Default off.
   */
  vtkSetMacro(TransformAllInputVectors, bool);
  vtkGetMacro(TransformAllInputVectors, bool);
  vtkBooleanMacro(TransformAllInputVectors, bool);
  ///@}

protected:
  vtkStyleAlgorithm();
  ~vtkStyleAlgorithm() override;

  /// Any vtkDataSet, so that what is not a surface is refused with a message of its own.
  int FillInputPortInformation(int port, vtkInformation* info) override;

  int OutputPointsPrecision = DEFAULT_PRECISION;
  int NumberOfThreads = 0;
  bool GenerateNormals = false;
  bool TransformAllInputVectors = false;

private:
  vtkStyleAlgorithm(const vtkStyleAlgorithm&) = delete;
  void operator=(const vtkStyleAlgorithm&) = delete;
};

#endif
