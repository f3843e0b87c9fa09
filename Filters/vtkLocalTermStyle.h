// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the filters do alike whose style is one further term of the local step. Private.
#ifndef vtkLocalTermStyle_h
#define vtkLocalTermStyle_h

#include "vtkSurfaceMeshConversion.h"

#include <memory>

class vtkPolyData;
class vtkPolyDataAlgorithm;
class vtkTable;

/// Solves and fills the outputs. Kept between executions, since the solver keeps its factorisation.
class vtkLocalTermStyle
{
public:
  /// Surface of the input, and the solve if it has a triangle. Reports progress, ends on abort.
  /// @param threads  as the property NumberOfThreads
  /// @throw std::exception with a message for the user
  void Solve(vtkPolyDataAlgorithm* self, vtkPolyData* input,
    const SphericalStyle::LoopOptions& loop, int threads,
    std::shared_ptr<SphericalStyle::LocalTerm> term);

  /// After Solve: the moved input with the array Displacement, the table of the energy, warnings.
  /// @param secondTerm  name of the term's column in the table
  void FillOutputs(vtkPolyDataAlgorithm* self, vtkPolyData* input, vtkPolyData* output,
    vtkTable* history, int precision, bool generateNormals, const char* secondTerm) const;

  const vtkSurfaceMesh& GetSurface() const { return this->Surface; }
  const SphericalStyle::LoopReport& GetReport() const { return this->Report.loop; }

  /// @throw std::invalid_argument naming the property Tolerance
  static SphericalStyle::LoopOptions MakeLoopOptions(
    int stopRule, double tolerance, int maximumNumberOfIterations, bool acceleration);

private:
  SphericalStyle::StyleSolver Solver;
  vtkSurfaceMesh Surface;
  SphericalStyle::StyleReport Report;
};

#endif
