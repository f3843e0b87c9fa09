// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSphereProjectionFilter
 * @brief   move the points of a surface toward a sphere, each along its ray from the center
 *
 * The ray from the center O through a point p meets the sphere of radius r at q; the output point
 * is
 *
 *     p' = (1 - Coefficient) p + Coefficient q,      q = O + r (p - O) / |p - O|      [projection]
 *
 * The simplest way to round a model, and what vtkSphericalStyleFilter and
 * vtkConvexProxyDeformFilter are to be compared with: nothing is kept rigid, so details stretch or
 * flatten with their distance from the sphere. Where several points lie on one ray, the surface
 * touches itself on the sphere.
 *
 * Input port 0: vtkPolyData. Every point takes part, also those of lines, vertices and no cell: a
 * cloud of points will do, unless area or volume are asked for. Coincident points count once for
 * the center and stay together.
 *
 * Output port 0: vtkPolyData with the cells, point order and every array of the input, the point
 * array Displacement (3; output minus input point, model length), and normals, recomputed if the
 * input had some or GenerateNormals is on. A point on the center, which has no ray, stays, with a
 * warning.
 *
 * Source: Research of Spherical Style Deformation on Single Component Models (doctoral thesis),
 * Fig. 4.26, "outSphere". The bracketed label is that of Filters/Documentation/SphereProjection.md.
 *
 * Cost: closed form, linear in the number of points.
 *
 * @sa vtkSphericalStyleFilter vtkConvexProxyDeformFilter
 */
#ifndef vtkSphereProjectionFilter_h
#define vtkSphereProjectionFilter_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkSetRangeMacro.h"            // for its macro
#include "vtkStyleAlgorithm.h"

class SPHERICALSTYLEFILTERS_EXPORT vtkSphereProjectionFilter : public vtkStyleAlgorithm
{
public:
  static vtkSphereProjectionFilter* New();
  vtkTypeMacro(vtkSphereProjectionFilter, vtkStyleAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum CenterModes
  {
    POINT_MEAN = 0,
    AREA_CENTROID = 1,
    CUSTOM_CENTER = 2
  };
  enum RadiusModes
  {
    OUTER = 0,
    EQUAL_AREA = 1,
    EQUAL_VOLUME = 2,
    CUSTOM_RADIUS = 3
  };

  ///@{
  /**
   * How far the points go: 0 leaves the model as it is, 1 puts every point on the sphere. No unit.
   * Range 0..1. Default 0.5.
   */
  vtkSetRangeMacro(Coefficient, double, 0.0, 1.0);
  vtkGetMacro(Coefficient, double);
  ///@}

  ///@{
  /**
   * Where the center O of the sphere lies: PointMean (default; mean of the points, coincident ones
   * once), AreaCentroid (the same for any sampling of the surface) or Custom (Center).
   */
  vtkSetRangeMacro(CenterMode, int, POINT_MEAN, CUSTOM_CENTER);
  vtkGetMacro(CenterMode, int);
  void SetCenterModeToPointMean() { this->SetCenterMode(POINT_MEAN); }
  void SetCenterModeToAreaCentroid() { this->SetCenterMode(AREA_CENTROID); }
  void SetCenterModeToCustom() { this->SetCenterMode(CUSTOM_CENTER); }
  ///@}

  ///@{
  /**
   * Center O when CenterMode is Custom, in model coordinates. Outside the model only the part of
   * the sphere that the model is seen at from O gets points. Default (0, 0, 0).
   */
  vtkSetVector3Macro(Center, double);
  vtkGetVector3Macro(Center, double);
  ///@}

  ///@{
  /**
   * Radius r of the sphere: Outer (default; max |p - O|, the sphere around the model; thesis),
   * EqualArea (sqrt(A / 4 pi)), EqualVolume (cube root of 3 V / 4 pi, for closed surfaces) or
   * Custom (Radius).
   */
  vtkSetRangeMacro(RadiusMode, int, OUTER, CUSTOM_RADIUS);
  vtkGetMacro(RadiusMode, int);
  void SetRadiusModeToOuter() { this->SetRadiusMode(OUTER); }
  void SetRadiusModeToEqualArea() { this->SetRadiusMode(EQUAL_AREA); }
  void SetRadiusModeToEqualVolume() { this->SetRadiusMode(EQUAL_VOLUME); }
  void SetRadiusModeToCustom() { this->SetRadiusMode(CUSTOM_RADIUS); }
  ///@}

  ///@{
  /**
   * Radius r when RadiusMode is Custom, model length. Larger grows the model. Above 0. Default 1.
   */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * Facts of the last execution: the center and radius that were used (model coordinates and
   * length).
   */
  vtkGetVector3Macro(EffectiveCenter, double);
  vtkGetMacro(EffectiveRadius, double);
  ///@}

protected:
  vtkSphereProjectionFilter();
  ~vtkSphereProjectionFilter() override = default;

  int RequestWholeData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSphereProjectionFilter(const vtkSphereProjectionFilter&) = delete;
  void operator=(const vtkSphereProjectionFilter&) = delete;

  /// RequestData, which turns what this throws into a message.
  int Execute(vtkInformationVector** inputVector, vtkInformationVector* outputVector);

  double Coefficient = 0.5;
  int CenterMode = POINT_MEAN;
  double Center[3] = { 0.0, 0.0, 0.0 };
  int RadiusMode = OUTER;
  double Radius = 1.0;

  double EffectiveCenter[3] = { 0.0, 0.0, 0.0 };
  double EffectiveRadius = 0.0;
};

#endif
