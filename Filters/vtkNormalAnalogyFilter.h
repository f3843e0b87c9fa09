// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNormalAnalogyFilter
 * @brief   give a surface the normals of a style shape
 *
 * The output is the input with moved points: each piece of the surface turns to the normal of the
 * style shape that is closest to its own, as far as Weight says, and stays as rigid as that allows.
 * A cube as style makes a model blocky, a tetrahedron makes it pointed. A style with many normals,
 * such as a fine sphere, changes next to nothing: every direction is already one of the style's.
 *
 * Input port 0: vtkPolyData. Triangles, quads, polygons and strips take part in the solve
 * (triangulated inside, cells unchanged on output); lines, vertices and points of no face are
 * carried along unmoved. Open borders, several components (each keeps its centroid), non-manifold
 * edges and coincident points (solved as one) are allowed.
 *
 * Input port 1, optional: vtkPolyData, the style shape for Style Mesh. Only the normals of its
 * faces count, so they must point outward (vtkPolyDataNormals); equal ones count once.
 *
 * Output port 0: vtkPolyData with the cells, point order and every array of the input, and the
 * point arrays Displacement (3; output minus input point, model length), TargetNormal (3; t, see
 * GenerateTargetNormal) and normals, recomputed if the input had some or GenerateNormals is on.
 *
 * Output port 1: vtkTable, one row for the start and one per iteration: Iteration, Total, Rigid,
 * Analogy (energies, length^2), LocalChange, GlobalChange, Residual (Eq. 3.46 of the thesis), Gap
 * (estimated, see Tolerance; NaN while unknown). Its field data: StageSeconds (Base, Weights,
 * Analyze, Factor, Iterate) and LinearSolver.
 *
 * Energy [analogy], minimised over points p' and rotations R by local and global steps:
 *
 *     E = sum over triangles f, half-edges h = uv of f, corners y of f of c_h |e'_uv - R_y e_uv|^2
 *       + Weight * sum over points y of a_y |R_y n_y - t_y|^2
 *
 * c_h half cotangents, n_y the normal and a_y the area (a third of the triangles at y) of point y,
 * t_y the style normal closest to n_y.
 *
 * Source: H.-T. D. Liu, A. Jacobson, Normal-Driven Spherical Shape Analogies, Computer Graphics
 * Forum 40(5), SGP 2021, with the closest-normal mapping: the method that the thesis compares with
 * in Fig. 4.23. The bracketed labels are those of Filters/Documentation/NormalAnalogy.md.
 *
 * Cost: one sparse factorisation (about n log n in practice), kept while the points stay, then per
 * iteration one 3 x 3 rotation per point and one triangular solve.
 *
 * @sa vtkCubicStyleFilter vtkSphericalStyleFilter vtkPlatonicSolidSource
 */
#ifndef vtkNormalAnalogyFilter_h
#define vtkNormalAnalogyFilter_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkWholeSurfaceAlgorithm.h"

#include <memory> // for std::unique_ptr

class SPHERICALSTYLEFILTERS_EXPORT vtkNormalAnalogyFilter : public vtkWholeSurfaceAlgorithm
{
public:
  static vtkNormalAnalogyFilter* New();
  vtkTypeMacro(vtkNormalAnalogyFilter, vtkWholeSurfaceAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Styles
  {
    TETRAHEDRON = 0,
    CUBE = 1,
    OCTAHEDRON = 2,
    ICOSAHEDRON = 3,
    DODECAHEDRON = 4,
    MESH = 5
  };
  enum StopRules
  {
    CONVERGED = 0,
    THESIS = 1,
    FIXED_ITERATIONS = 2
  };
  ///@{
  /**
   * The style shape of input port 1, for Style Mesh.
   */
  void SetStyleMeshConnection(vtkAlgorithmOutput* mesh);
  void SetStyleMeshData(vtkPolyData* mesh);
  ///@}

  ///@{
  /**
   * Shape whose normals the surface gets: one of the five regular solids as vtkPlatonicSolidSource
   * makes them (Cube, the default, along the axes), or Mesh, input port 1.
   */
  vtkSetClampMacro(Style, int, TETRAHEDRON, MESH);
  vtkGetMacro(Style, int);
  void SetStyleToTetrahedron() { this->SetStyle(TETRAHEDRON); }
  void SetStyleToCube() { this->SetStyle(CUBE); }
  void SetStyleToOctahedron() { this->SetStyle(OCTAHEDRON); }
  void SetStyleToIcosahedron() { this->SetStyle(ICOSAHEDRON); }
  void SetStyleToDodecahedron() { this->SetStyle(DODECAHEDRON); }
  void SetStyleToMesh() { this->SetStyle(MESH); }
  ///@}

  ///@{
  /**
   * Weight lambda of the normals. 0 leaves the model as it is, larger is nearer to the style, 10 is
   * large. No unit. Range 0 and up; a negative or non-finite value is an error. Default 1.
   */
  vtkSetMacro(Weight, double);
  vtkGetMacro(Weight, double);
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
   * Default 1e-4.
   */
  vtkSetClampMacro(Tolerance, double, 1e-14, 0.5);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Bound on local/global iterations, or their exact number with FixedIterations. Reaching it
   * without convergence is a warning. 0 or more. Default 200.
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
   * Add the point array TargetNormal. Default on.
   */
  vtkSetMacro(GenerateTargetNormal, bool);
  vtkGetMacro(GenerateTargetNormal, bool);
  vtkBooleanMacro(GenerateTargetNormal, bool);
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
   * Facts of the last execution: normals that the style has, iterations done, whether the stop rule
   * was met, the energy (length^2).
   */
  vtkGetMacro(NumberOfStyleNormals, int);
  vtkGetMacro(NumberOfIterations, int);
  vtkGetMacro(Converged, bool);
  vtkGetMacro(FinalEnergy, double);
  ///@}

protected:
  vtkNormalAnalogyFilter();
  ~vtkNormalAnalogyFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestWholeData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkNormalAnalogyFilter(const vtkNormalAnalogyFilter&) = delete;
  void operator=(const vtkNormalAnalogyFilter&) = delete;

  /// RequestData, which turns what this throws into a message.
  int Execute(vtkInformationVector** inputVector, vtkInformationVector* outputVector);

  int Style = CUBE;
  double Weight = 1.0;
  int StopRule = CONVERGED;
  double Tolerance = 1e-4;
  int MaximumNumberOfIterations = 200;
  bool Acceleration = true;
  int OutputPointsPrecision = DEFAULT_PRECISION;
  int NumberOfThreads = 0;
  bool GenerateNormals = false;
  bool GenerateTargetNormal = true;

  int NumberOfStyleNormals = 0;
  int NumberOfIterations = 0;
  bool Converged = false;
  double FinalEnergy = 0.0;

  struct Internals; // the solver, kept between executions
  std::unique_ptr<Internals> Internal;
};

#endif
