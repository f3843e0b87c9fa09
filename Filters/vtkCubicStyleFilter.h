// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCubicStyleFilter
 * @brief   give a surface the style of a cube
 *
 * The output is the input with moved points: the normals of the surface lean toward the coordinate
 * axes as far as Cubeness says, and every small piece of it stays as rigid as that allows. Flat
 * sides and sharp edges form; details stay. Turn the model first to choose the axes of the cube.
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
 * Cubic (energies, length^2), LocalChange, GlobalChange, Residual (Eq. 3.46 of the thesis), Gap
 * (estimated, see Tolerance; NaN while unknown). Its field data: StageSeconds (Base, Weights,
 * Analyze, Factor, Iterate) and LinearSolver.
 *
 * Energy [cubic], minimised over points p' and rotations R by local and global steps:
 *
 *     E = sum over triangles f, half-edges h = uv of f, corners y of f of c_h |e'_uv - R_y e_uv|^2
 *       + Cubeness * sum over points y of a_y |R_y n_y|_1
 *
 * c_h half cotangents, n_y the normal and a_y the area (a third of the triangles at y) of point y,
 * |x|_1 the sum of the absolute components: least for unit vectors on an axis.
 *
 * Source: H.-T. D. Liu, A. Jacobson, Cubic Stylization, ACM Transactions on Graphics 38(6),
 * SIGGRAPH Asia 2019, doi:10.1145/3355089.3356495. The bracketed labels are those of
 * Filters/Documentation/CubicStyle.md.
 *
 * Cost: one sparse factorisation (about n log n in practice), kept while the points stay, then per
 * iteration a small problem per point (some dozens of 3 x 3 rotations) and one triangular solve.
 * Some hundred iterations are usual: the energy is flat where a normal is between two axes.
 *
 * @sa vtkNormalAnalogyFilter vtkSphericalStyleFilter
 */
#ifndef vtkCubicStyleFilter_h
#define vtkCubicStyleFilter_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkWholeSurfaceAlgorithm.h"

#include <memory> // for std::unique_ptr

class SPHERICALSTYLEFILTERS_EXPORT vtkCubicStyleFilter : public vtkWholeSurfaceAlgorithm
{
public:
  static vtkCubicStyleFilter* New();
  vtkTypeMacro(vtkCubicStyleFilter, vtkWholeSurfaceAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum StopRules
  {
    CONVERGED = 0,
    THESIS = 1,
    FIXED_ITERATIONS = 2
  };
  ///@{
  /**
   * Weight lambda of the cubic term. 0 leaves the model as it is, larger is nearer to a cube; 0.1
   * to 1 is usual. No unit. Range 0 and up; a negative or non-finite value is an error. Default
   * 0.5.
   */
  vtkSetMacro(Cubeness, double);
  vtkGetMacro(Cubeness, double);
  ///@}

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
   * Default 1e-3.
   */
  vtkSetClampMacro(Tolerance, double, 1e-14, 0.5);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Bound on local/global iterations, or their exact number with FixedIterations. Reaching it
   * without convergence is a warning. 0 or more. Default 500.
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
  vtkCubicStyleFilter();
  ~vtkCubicStyleFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestWholeData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkCubicStyleFilter(const vtkCubicStyleFilter&) = delete;
  void operator=(const vtkCubicStyleFilter&) = delete;

  /// RequestData, which turns what this throws into a message.
  int Execute(vtkInformationVector** inputVector, vtkInformationVector* outputVector);

  double Cubeness = 0.5;
  int StopRule = CONVERGED;
  double Tolerance = 1e-3;
  int MaximumNumberOfIterations = 500;
  bool Acceleration = true;
  int OutputPointsPrecision = DEFAULT_PRECISION;
  int NumberOfThreads = 0;
  bool GenerateNormals = false;

  int NumberOfIterations = 0;
  bool Converged = false;
  double FinalEnergy = 0.0;

  struct Internals; // the solver, kept between executions
  std::unique_ptr<Internals> Internal;
};

#endif
