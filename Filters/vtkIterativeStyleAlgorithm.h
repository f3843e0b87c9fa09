// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIterativeStyleAlgorithm
 * @brief   superclass of the filters that minimize the energy of a style by local and global steps
 *
 * What they have in common: when the iteration ends, the table of the energy at output port 1, and
 * the facts of an execution.
 *
 * Output port 1: vtkTable, one row for the start and one per iteration: Iteration, Total, Rigid,
 * the filter's own term (energies, length^2), LocalChange, GlobalChange, Residual (Eq. 3.46 of the
 * thesis), Gap (estimated, see Tolerance; NaN while unknown). Its field data: StageSeconds (Base,
 * Weights, Analyze, Factor, Iterate, Triangles), LinearSolver, Spheres (4: center and radius;
 * empty where the filter has no sphere), and NumberOfStitches and NumberOfWallStitches, which are 0
 * where it makes none.
 *
 * @sa vtkSphericalStyleFilter vtkNonlinearStyleFilter vtkLocalTermAlgorithm
 */
#ifndef vtkIterativeStyleAlgorithm_h
#define vtkIterativeStyleAlgorithm_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkSetRangeMacro.h"            // for its macro
#include "vtkStyleAlgorithm.h"

namespace SphericalStyle
{
struct LoopOptions;
struct LoopReport;
}

class SPHERICALSTYLEFILTERS_EXPORT vtkIterativeStyleAlgorithm : public vtkStyleAlgorithm
{
public:
  vtkTypeMacro(vtkIterativeStyleAlgorithm, vtkStyleAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum StopRules
  {
    CONVERGED = 0,
    THESIS = 1,
    FIXED_ITERATIONS = 2
  };

  ///@{
  /**
   * When the iteration ends: Converged (default; estimated energy gap below Tolerance, reached in
   * fewer iterations by Anderson acceleration), Thesis (the step of Eq. 3.46 below 0.001; stops
   * with up to 30 % of the displacement still missing) or FixedIterations (exactly
   * MaximumNumberOfIterations). The last two do plain local and global steps.
   */
  vtkSetRangeMacro(StopRule, int, CONVERGED, FIXED_ITERATIONS);
  vtkGetMacro(StopRule, int);
  void SetStopRuleToConverged() { this->SetStopRule(CONVERGED); }
  void SetStopRuleToThesis() { this->SetStopRule(THESIS); }
  void SetStopRuleToFixedIterations() { this->SetStopRule(FIXED_ITERATIONS); }
  ///@}

  ///@{
  /**
   * Converged: bound on the estimated energy gap (E - E*) / (E_0 - E*), E_0 the energy of the
   * unmoved model, E* that of the minimum. Smaller is nearer and slower. No unit. Range 1e-14..0.5.
   * Default 1e-4; 1e-3 of vtkCubicStyleFilter, 1e-5 of vtkHandleDeformFilter.
   */
  vtkSetRangeMacro(Tolerance, double, 1e-14, 0.5);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Bound on local/global iterations, or their exact number with FixedIterations. Reaching it
   * without convergence is a warning. 0 or more. Default 200; 500 of vtkCubicStyleFilter and
   * vtkHandleDeformFilter.
   */
  vtkSetRangeMacro(MaximumNumberOfIterations, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumNumberOfIterations, int);
  ///@}

  ///@{
  /**
   * Facts of the last execution: iterations done, whether the stop rule was met, the energy
   * (length^2).
   */
  vtkGetMacro(NumberOfIterations, int);
  vtkGetMacro(Converged, bool);
  vtkGetMacro(FinalEnergy, double);
  ///@}

protected:
  /// Output port 1 is the table.
  vtkIterativeStyleAlgorithm();
  ~vtkIterativeStyleAlgorithm() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;

  /// @throw std::invalid_argument naming the property
  SphericalStyle::LoopOptions MakeLoopOptions() const;
  void SetLoopFacts(const SphericalStyle::LoopReport& loop);

  int StopRule = CONVERGED;
  double Tolerance = 1e-4;
  int MaximumNumberOfIterations = 200;

private:
  vtkIterativeStyleAlgorithm(const vtkIterativeStyleAlgorithm&) = delete;
  void operator=(const vtkIterativeStyleAlgorithm&) = delete;

  int NumberOfIterations = 0;
  bool Converged = false;
  double FinalEnergy = 0.0;
};

#endif
