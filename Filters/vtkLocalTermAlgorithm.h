// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLocalTermAlgorithm
 * @brief   superclass of filters whose style is one further term of the local step
 *
 * What they have in common: the iteration and when it ends, both outputs, and what they take as
 * input.
 *
 * Input port 0: vtkPolyData. Triangles, quads, polygons and strips take part in the solve
 * (triangulated inside, cells unchanged on output); lines, vertices and points of no face are
 * carried along unmoved. Open borders, several components (each keeps its centroid), non-manifold
 * edges and coincident points (solved as one) are allowed.
 *
 * Output port 0: vtkPolyData with the cells, point order and every array of the input, and the
 * point arrays Displacement (3; output minus input point, model length) and normals, recomputed if
 * the input had some or GenerateNormals is on.
 *
 * Output port 1: vtkTable, one row for the start and one per iteration: Iteration, Total, Rigid,
 * the filter's own term (energies, length^2), LocalChange, GlobalChange, Residual (Eq. 3.46 of the
 * thesis), Gap (estimated, see Tolerance; NaN while unknown). Its field data: StageSeconds (Base,
 * Weights, Analyze, Factor, Iterate) and LinearSolver.
 *
 * Energy, minimised over points p' and rotations R by local and global steps:
 *
 *     E = sum over triangles f, half-edges h = uv of f, corners y of f of c_h |e'_uv - R_y e_uv|^2
 *       + sum over points y of the filter's own term of R_y
 *
 * with half cotangents c_h. The own term says nothing of p', so that the matrix is that of the
 * first sum: one sparse factorisation (about n log n in practice), kept while the points stay.
 *
 * @sa vtkCubicStyleFilter vtkNormalAnalogyFilter
 */
#ifndef vtkLocalTermAlgorithm_h
#define vtkLocalTermAlgorithm_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkWholeSurfaceAlgorithm.h"

#include <memory> // for std::unique_ptr, std::shared_ptr

class vtkPolyData;
struct vtkSurfaceMesh;

namespace SphericalStyle
{
class LocalTerm;
}

class SPHERICALSTYLEFILTERS_EXPORT vtkLocalTermAlgorithm : public vtkWholeSurfaceAlgorithm
{
public:
  vtkTypeMacro(vtkLocalTermAlgorithm, vtkWholeSurfaceAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum StopRules
  {
    CONVERGED = 0,
    THESIS = 1,
    FIXED_ITERATIONS = 2
  };

  ///@{
  /**
   * When the iteration ends: Converged (default; estimated energy gap below Tolerance), Thesis (the
   * step of Eq. 3.46 of the thesis below 0.001; may end far from the minimum) or FixedIterations
   * (exactly MaximumNumberOfIterations).
   */
  vtkSetClampMacro(StopRule, int, CONVERGED, FIXED_ITERATIONS);
  vtkGetMacro(StopRule, int);
  void SetStopRuleToConverged() { this->SetStopRule(CONVERGED); }
  void SetStopRuleToThesis() { this->SetStopRule(THESIS); }
  void SetStopRuleToFixedIterations() { this->SetStopRule(FIXED_ITERATIONS); }
  ///@}

  ///@{
  /**
   * Converged: bound on the estimated energy gap (E - E*) / (E_0 - E*), E_0 the energy of the
   * unmoved model, E* that of the minimum. Smaller is nearer and slower. No unit. Above 0, below 1.
   * Default 1e-4; 1e-3 of vtkCubicStyleFilter.
   */
  vtkSetClampMacro(Tolerance, double, 1e-14, 0.5);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Bound on local/global iterations, or their exact number with FixedIterations. Reaching it
   * without convergence is a warning. 0 or more. Default 200; 500 of vtkCubicStyleFilter.
   */
  vtkSetClampMacro(MaximumNumberOfIterations, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumNumberOfIterations, int);
  ///@}

  ///@{
  /**
   * Anderson acceleration (window 5) with an energy guard: fewer iterations, the energy still never
   * rises. Default on.
   */
  vtkSetMacro(Acceleration, bool);
  vtkGetMacro(Acceleration, bool);
  vtkBooleanMacro(Acceleration, bool);
  ///@}

  ///@{
  /**
   * Number type of the output points: vtkAlgorithm::DEFAULT_PRECISION (default: as the input),
   * SINGLE_PRECISION or DOUBLE_PRECISION. The solve is always double.
   */
  vtkSetClampMacro(OutputPointsPrecision, int, SINGLE_PRECISION, DEFAULT_PRECISION);
  vtkGetMacro(OutputPointsPrecision, int);
  ///@}

  ///@{
  /**
   * Threads of the solve; 0 (default) takes VTK_SMP_MAX_THREADS or else all cores. The result has
   * the same bits for any number.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, 1024);
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
   * Facts of the last execution: iterations done, whether the stop rule was met, the energy
   * (length^2).
   */
  vtkGetMacro(NumberOfIterations, int);
  vtkGetMacro(Converged, bool);
  vtkGetMacro(FinalEnergy, double);
  ///@}

protected:
  vtkLocalTermAlgorithm();
  ~vtkLocalTermAlgorithm() override;

  /// The term, as the filter is set. @throw std::invalid_argument naming the property or input
  virtual std::shared_ptr<SphericalStyle::LocalTerm> MakeTerm(vtkInformationVector** inputs) = 0;

  /// Name of the term's column in the table.
  virtual const char* GetTermName() const = 0;

  /// After the solve: point arrays of the filter's own. Adds none by default.
  virtual void AddArrays(
    const SphericalStyle::LocalTerm& term, const vtkSurfaceMesh& surface, vtkPolyData* output);

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestWholeData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  int StopRule = CONVERGED;
  double Tolerance = 1e-4;
  int MaximumNumberOfIterations = 200;
  bool Acceleration = true;
  int OutputPointsPrecision = DEFAULT_PRECISION;
  int NumberOfThreads = 0;
  bool GenerateNormals = false;

private:
  vtkLocalTermAlgorithm(const vtkLocalTermAlgorithm&) = delete;
  void operator=(const vtkLocalTermAlgorithm&) = delete;

  /// RequestData, which turns what this throws into a message.
  int Execute(vtkInformationVector** inputVector, vtkInformationVector* outputVector);

  int NumberOfIterations = 0;
  bool Converged = false;
  double FinalEnergy = 0.0;

  struct Internals; // the solver, kept between executions
  std::unique_ptr<Internals> Internal;
};

#endif
