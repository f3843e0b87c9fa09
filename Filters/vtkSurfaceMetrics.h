// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceMetrics
 * @brief   how round, how well meshed and how much deformed a surface is
 *
 * Measures a surface, and what a deformation did to it if the surface before is given as well.
 *
 * Input port 0: vtkPolyData, the surface. Polygons and strips count as the triangles they are cut
 * into; triangles without an area (an angle below 1e-10) are left out and counted. Other cells
 * pass.
 *
 * Input port 1, optional: vtkPolyData, the reference: the surface before the deformation, with the
 * same points and cells in the same order.
 *
 * Output port 0: vtkPolyData, the input with the cell arrays
 *  - SmallestAngle, LargestAngle (1): of its triangles, degrees; 0 for cells without triangles;
 *  - SelfIntersections (1): how many pairs of triangles of which one is of the cell intersect;
 *  - with a reference AreaRatio (1): area over that before, 0 where there is none before or after,
 *    and TurnedOver (1): whether a triangle of the cell turned over;
 *
 * the point arrays
 *  - RadialCosine (1): cosine of the angle between normal and direction from the center; below 0
 * the surface is not star-shaped;
 *  - Opposition (1): share of the edges at the point whose normals' difference opposes them;
 *  - with a reference and MeasureThickness ThicknessRatio (1): thickness at the point over that
 *    before, NaN where the surface has none;
 *
 * and as field data all columns of output port 1.
 *
 * Output port 1: vtkTable of one row. Always there:
 *  - Points, Triangles, DegenerateTriangles, Edges, BorderEdges (of one triangle), NonManifoldEdges
 *    (of three or more), MisorientedEdges (two triangles that do not agree on the outside), Closed
 *    (1 if the triangles bound a volume), Components, EulerCharacteristic;
 *  - Area, Volume (NaN if not closed, below 0 if inside out), Sphericity (1 for a ball, less for
 * all else, NaN if not closed), Center (3), RadiusSpread (standard deviation over mean of the
 * distance from the center), OverhangShare (of points with RadialCosine below 0), FittedCenter (3),
 *    FittedRadius, FittedSphereError (rms distance from the nearest sphere over its radius; NaN for
 *    points in a plane);
 *  - SmallestAngle, LargestAngle, ObtuseShare (of triangles), RmsDihedral (roughness, degrees),
 *    NegativeWeights (edges with a negative cotangent sum), LambdaStar (smallest Roundness that
 *    outweighs all of them), OpposedEdges.
 *
 * With FindSelfIntersections: SelfIntersectionPairs (of triangles), SelfIntersectingTriangles.
 * With EstimateCondition: Condition, PinnedCondition, ConditionAccuracy.
 * With a reference: AreaRatio, VolumeRatio, SmallestAreaRatio, LargestAreaRatio and AreaRatioSpread
 * (over cells), TurnedOver (triangles), DetailError, DihedralChange (degrees), LargestDisplacement
 * (length), with MeasureThickness SmallestThicknessRatio and ThinnedShare (of points with a
 * ThicknessRatio below 0.1, among those that have one; NaN both where none has), and with
 * FindSelfIntersections NewSelfIntersectionPairs, NewSelfIntersectingTriangles.
 *
 * Of a surface that is spread over processes each measures its part, and sums, shared points and
 * what is near other parts go between them; the table, the field data of output 0 and messages are
 * on the first process, and the table's field data have BytesExchanged, sent and received by each
 * process. EstimateCondition, and WeldCoincidentPoints off, gather the surface on the first process
 * (vtkWholeSurfaceAlgorithm).
 *
 * All but areas, volumes and lengths are numbers without a unit and do not depend on place and
 * size. Exact definitions: Filters/Documentation/SurfaceMetrics.md.
 *
 * Source: Research of Spherical Style Deformation on Single Component Models (doctoral
 * thesis), 4.5, 4.6 and Eq. 4.40; what is not there is marked on the page.
 *
 * Cost: some milliseconds per 10,000 triangles, self-intersections about ten times that;
 * EstimateCondition factors the matrix and takes seconds on large meshes.
 *
 * @warning The test for self-intersections is CGAL's, which is GPL; builds without it leave it out
 * and say so.
 *
 * @sa vtkSphericalStyleFilter vtkConvexProxyDeformFilter vtkMeshQuality
 */
#ifndef vtkSurfaceMetrics_h
#define vtkSurfaceMetrics_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkSetRangeMacro.h"            // for its macro
#include "vtkWholeSurfaceAlgorithm.h"

#include <memory> // for std::shared_ptr

class vtkProcesses;

class SPHERICALSTYLEFILTERS_EXPORT vtkSurfaceMetrics : public vtkWholeSurfaceAlgorithm
{
public:
  static vtkSurfaceMetrics* New();
  vtkTypeMacro(vtkSurfaceMetrics, vtkWholeSurfaceAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum CenterModes
  {
    POINT_MEAN = 0,
    AREA_CENTROID = 1,
    CUSTOM_CENTER = 2
  };

  /// The surface before the deformation. @{
  void SetReferenceConnection(vtkAlgorithmOutput* reference);
  void SetReferenceData(vtkPolyData* reference);
  /// @}

  ///@{
  /**
   * Where the center lies that RadiusSpread and RadialCosine are measured from: PointMean (default;
   * mean of the points), AreaCentroid (of the surface) or Custom (Center).
   */
  vtkSetRangeMacro(CenterMode, int, POINT_MEAN, CUSTOM_CENTER);
  vtkGetMacro(CenterMode, int);
  void SetCenterModeToPointMean() { this->SetCenterMode(POINT_MEAN); }
  void SetCenterModeToAreaCentroid() { this->SetCenterMode(AREA_CENTROID); }
  void SetCenterModeToCustom() { this->SetCenterMode(CUSTOM_CENTER); }
  ///@}

  ///@{
  /**
   * Center when CenterMode is Custom, in model coordinates. Default (0, 0, 0).
   */
  vtkSetVector3Macro(Center, double);
  vtkGetVector3Macro(Center, double);
  ///@}

  ///@{
  /**
   * Look for triangles that intersect. The slowest of the measures that are on by default. Default
   * on.
   */
  vtkSetMacro(FindSelfIntersections, bool);
  vtkGetMacro(FindSelfIntersections, bool);
  vtkBooleanMacro(FindSelfIntersections, bool);
  ///@}

  ///@{
  /**
   * With a reference: measure how much of its thickness each point has kept, along its normal to
   * the other side of the surface. Default on.
   */
  vtkSetMacro(MeasureThickness, bool);
  vtkGetMacro(MeasureThickness, bool);
  vtkBooleanMacro(MeasureThickness, bool);
  ///@}

  ///@{
  /**
   * Estimate the condition number (Eq. 4.40) of the matrix that vtkSphericalStyleFilter solves with
   * at Roundness, to a relative accuracy of 1e-6. Default off.
   */
  vtkSetMacro(EstimateCondition, bool);
  vtkGetMacro(EstimateCondition, bool);
  vtkBooleanMacro(EstimateCondition, bool);
  ///@}

  ///@{
  /**
   * Weight lambda of the spherical term in the matrix of EstimateCondition. No unit. Range 0 and
   * up; a negative or non-finite value is an error. Default 0.5.
   */
  vtkSetMacro(Roundness, double);
  vtkGetMacro(Roundness, double);
  ///@}

  ///@{
  /**
   * Measure coincident points as one, so that texture seams and split normals are no borders.
   * Default on.
   */
  vtkSetMacro(WeldCoincidentPoints, bool);
  vtkGetMacro(WeldCoincidentPoints, bool);
  vtkBooleanMacro(WeldCoincidentPoints, bool);
  ///@}

protected:
  vtkSurfaceMetrics();
  ~vtkSurfaceMetrics() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestWholeData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestPart(vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSurfaceMetrics(const vtkSurfaceMetrics&) = delete;
  void operator=(const vtkSurfaceMetrics&) = delete;

  /// RequestWholeData, which turns what this throws into a message, or RequestPart.
  /// @param processes  that the surface is spread over, or nullptr
  int Execute(vtkInformationVector** inputVector, vtkInformationVector* outputVector,
    const std::shared_ptr<const vtkProcesses>& processes = nullptr);
  /// Whether the processes can work with the parts of the surface that they have.
  bool WorksOnParts(vtkInformationVector** inputVector, const vtkProcesses& processes) const;

  int CenterMode = POINT_MEAN;
  double Center[3] = { 0.0, 0.0, 0.0 };
  bool FindSelfIntersections = true;
  bool MeasureThickness = true;
  bool EstimateCondition = false;
  double Roundness = 0.5;
  bool WeldCoincidentPoints = true;

  struct Measurement; // one execution
};

#endif
