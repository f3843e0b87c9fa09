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

protected:
  vtkStyleAlgorithm();
  ~vtkStyleAlgorithm() override;

  /// Any vtkDataSet, so that what is not a surface is refused with a message of its own.
  int FillInputPortInformation(int port, vtkInformation* info) override;

  int OutputPointsPrecision = DEFAULT_PRECISION;
  int NumberOfThreads = 0;
  bool GenerateNormals = false;

private:
  vtkStyleAlgorithm(const vtkStyleAlgorithm&) = delete;
  void operator=(const vtkStyleAlgorithm&) = delete;
};

#endif
