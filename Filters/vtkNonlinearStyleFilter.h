// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNonlinearStyleFilter
 * @brief   for study: the nonlinear spherical feature of the thesis, the attempt before its method
 *
 * The normals of the turned cells are to point away from the center, at any distance from it. To
 * round a model take vtkSphericalStyleFilter; what fails here, and why, is on the page.
 *
 * Input port 0: vtkPolyData. Triangles, quads, polygons and strips take part in the solve
 * (triangulated inside, cells unchanged on output); lines, vertices and points of no face are
 * carried along unmoved. Open borders, several components, non-manifold edges and coincident points
 * (solved as one) are allowed.
 *
 * Input arrays to process, both optional, of point data:
 *  - 0: normals, 3 components (default: the active normals, or computed ones);
 *  - 1: roundness factor, 1 component, >= 0: the Roundness of a point is Roundness times it.
 *
 * Output port 0: vtkPolyData with the cells, point order and every array of the input, and the
 * point arrays
 *  - Displacement (3): output minus input point, model length;
 *  - Normals: recomputed if the input had point normals or GenerateNormals is on;
 *  - on demand Rotation (9, row by row), CellEnergy (1, length^2), AuxiliaryScale (1; s, 1 /
 *    length).
 *
 * Output port 1: vtkTable, the energy (vtkIterativeStyleAlgorithm; its own term is Spherical).
 *
 * Energy [nonlinear], minimized over points p', rotations R and scales s by local and global steps,
 * r = sqrt(A / 4 pi) with A the area of the model:
 *
 *     E = sum over points i of [ sum over neighbors j of w_ij |e'_ij - R_i e_ij|^2
 *         + Roundness r^2 sum over j = i and neighbors of |R_i n_j - s_j (p'_j - O)|^2 ]
 *
 * Source: Research of Spherical Style Deformation on Single Component Models (doctoral thesis),
 * chapter 3, Eq. 3.1 - 3.48. The bracketed label is that of
 * Filters/Documentation/NonlinearStyle.md.
 *
 * Cost: a sparse factorization in every iteration, on an ordering that is kept while the triangles
 * stay.
 *
 * @sa vtkSphericalStyleFilter
 */
#ifndef vtkNonlinearStyleFilter_h
#define vtkNonlinearStyleFilter_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkIterativeStyleAlgorithm.h"
#include "vtkSetRangeMacro.h" // for its macro

#include <memory> // for std::unique_ptr

namespace SphericalStyle
{
struct StyleReport;
}

class SPHERICALSTYLEFILTERS_EXPORT vtkNonlinearStyleFilter : public vtkIterativeStyleAlgorithm
{
public:
  static vtkNonlinearStyleFilter* New();
  vtkTypeMacro(vtkNonlinearStyleFilter, vtkIterativeStyleAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum CenterConstraints
  {
    CORRECTED = 0,
    AS_WRITTEN = 1
  };
  enum CenterModes
  {
    POINT_MEAN = 0,
    AREA_CENTROID = 1,
    CUSTOM_CENTER = 2
  };

  ///@{
  /**
   * Weight lambda of the spherical term. 0 leaves the model as it is. No unit. 0 or more; a
   * negative or non-finite value is an error. Default 1.
   */
  vtkSetMacro(Roundness, double);
  vtkGetMacro(Roundness, double);
  ///@}

  ///@{
  /**
   * Corrected (default; every step lowers the energy) or AsWritten (Eq. 3.12 and 3.26 - 3.42 to the
   * letter, with CenterMode PointMean, plain steps and the rule of Thesis in place of Converged).
   * As written the energy can rise, which is the failure that the thesis reports; a warning counts
   * the steps. At most 50000 points, and 1000000 points times neighbors of the last point: more is
   * an error.
   */
  vtkSetRangeMacro(CenterConstraint, int, CORRECTED, AS_WRITTEN);
  vtkGetMacro(CenterConstraint, int);
  void SetCenterConstraintToCorrected() { this->SetCenterConstraint(CORRECTED); }
  void SetCenterConstraintToAsWritten() { this->SetCenterConstraint(AS_WRITTEN); }
  ///@}

  ///@{
  /**
   * Where the center O lies: AreaCentroid (default; the same for any sampling of the surface),
   * PointMean (mean of the points that take part, coincident ones once; thesis) or Custom (Center).
   */
  vtkSetRangeMacro(CenterMode, int, POINT_MEAN, CUSTOM_CENTER);
  vtkGetMacro(CenterMode, int);
  void SetCenterModeToPointMean() { this->SetCenterMode(POINT_MEAN); }
  void SetCenterModeToAreaCentroid() { this->SetCenterMode(AREA_CENTROID); }
  void SetCenterModeToCustom() { this->SetCenterMode(CUSTOM_CENTER); }
  ///@}

  ///@{
  /**
   * Center O when CenterMode is Custom, in model coordinates. Default (0, 0, 0).
   */
  vtkSetVector3Macro(Center, double);
  vtkGetVector3Macro(Center, double);
  ///@}

  ///@{
  /**
   * Run chapter 3 to the letter: on overrides CenterConstraint AsWritten, StopRule Thesis and
   * CenterMode PointMean. Default off.
   */
  vtkSetMacro(ReproduceThesis, bool);
  vtkGetMacro(ReproduceThesis, bool);
  vtkBooleanMacro(ReproduceThesis, bool);
  ///@}

  ///@{
  /**
   * Switches of output arrays. Default off.
   */
  vtkSetMacro(GenerateCellEnergy, bool);
  vtkGetMacro(GenerateCellEnergy, bool);
  vtkBooleanMacro(GenerateCellEnergy, bool);
  vtkSetMacro(GenerateRotation, bool);
  vtkGetMacro(GenerateRotation, bool);
  vtkBooleanMacro(GenerateRotation, bool);
  vtkSetMacro(GenerateAuxiliaryScale, bool);
  vtkGetMacro(GenerateAuxiliaryScale, bool);
  vtkBooleanMacro(GenerateAuxiliaryScale, bool);
  ///@}

  ///@{
  /**
   * Facts of the last execution: the center that was used (model coordinates), and the radius r,
   * the unit of length in the energy (model length).
   */
  vtkGetVector3Macro(EffectiveCenter, double);
  vtkGetMacro(EffectiveRadius, double);
  ///@}

protected:
  vtkNonlinearStyleFilter();
  ~vtkNonlinearStyleFilter() override;

  int RequestWholeData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkNonlinearStyleFilter(const vtkNonlinearStyleFilter&) = delete;
  void operator=(const vtkNonlinearStyleFilter&) = delete;

  /// RequestData, which turns what this throws into a message.
  int Execute(vtkInformationVector** inputVector, vtkInformationVector* outputVector);

  void Warn(const SphericalStyle::StyleReport& report);

  double Roundness = 1.0;
  int CenterConstraint = CORRECTED;
  int CenterMode = AREA_CENTROID;
  double Center[3] = { 0.0, 0.0, 0.0 };
  bool ReproduceThesis = false;
  bool GenerateCellEnergy = false;
  bool GenerateRotation = false;
  bool GenerateAuxiliaryScale = false;

  double EffectiveCenter[3] = { 0.0, 0.0, 0.0 };
  double EffectiveRadius = 0.0;

  struct Internals; // the solver, kept between executions
  std::unique_ptr<Internals> Internal;
};

#endif
