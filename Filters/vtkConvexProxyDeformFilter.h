// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkConvexProxyDeformFilter
 * @brief   round any mesh, or part of it, by the rounding of its convex hull
 *
 * For models that should follow their convex hull, such as cars and houses, and where only part of
 * a model shall change; slivers, cracks and loose parts do no harm. The convex hull of the input is
 * meshed evenly (the proxy) and rounded; each input point is projected to the proxy and goes part
 * of the way with it. No triangle of the input takes part, so none can do harm.
 *
 * Input port 0: vtkPolyData, the model. Any cells; every point takes part, also points of no cell.
 *
 * Input port 1, optional: vtkPolyData, a proxy of your own in the place of the meshed hull. It need
 * not be convex or closed; its triangles should be even.
 *
 * Input port 2, optional: vtkSelection of points or cells of the model. Points outside keep their
 * bits.
 *
 * Input arrays to process, all optional, all of point data:
 *  - 0: normals, 3 components, for Projection SmallestAngle (default: the active normals; computed
 *       when there are none);
 *  - 1: projection directions, 3 components, for Projection DirectionArray; a row of zeros takes
 *       the closest point;
 *  - 2: t, 1 or 3 components (one, or one per axis), 0..1, for BlendFunction Array;
 *  - 3: region, 1 component: points where it is 0 keep their bits. With a selection too, a point
 *       must be in both.
 *
 * Output port 0: vtkPolyData with the cells, point order and every array of the input, unless
 * RefineLongEdges splits cells, and the point arrays
 *  - t (1, or 3 with a t array of 3): the weight of the input point, border included, no unit;
 *  - Displacement (3): output minus input point, model length;
 *  - Normals: recomputed if the input had point normals or GenerateNormals is on;
 *  - with GenerateProjectionArrays: ProxyCell (1, cell of output 1), Barycentric (3), and with
 *    Projection NearestVertices ProjectionCase (1: one foot, 2: several, 3: none at first).
 *
 * Output port 1: vtkPolyData, the proxy. Points are the rounded ones; the point arrays are
 * RestPosition (3) and Displacement (3), both model length. Field data: StageSeconds (Proxy, Round,
 * Project, Transfer; 0 for what was kept from the last execution).
 *
 * Output port 2: vtkPolyData, one line per input point from the point to its foot on the proxy at
 * rest, with the cell arrays PointId and t.
 *
 * Method [proxy], steps: convex hull; even points and triangles on it (ProxyMesher); foot
 * q = sum b_k q_k, b >= 0, sum b = 1 of every point p (Projection); the proxy rounded with
 * NormalBlend 0 by the solver of vtkSphericalStyleFilter, its centroid kept; and
 *
 *     p' = (1 - t) q' + t p,   q' = sum b_k q'_k        (Eq. 5.18)
 *
 * t = 1 leaves a point as it is, to the last bit; t = 0 puts it on the rounded proxy. Coincident
 * points stay coincident: arrays are averaged over them.
 *
 * Source: Research of Spherical Style Deformation on Single Component Models (doctoral thesis),
 * chapter 5, Eq. 5.1 - 5.18. The bracketed labels are those of
 * Filters/Documentation/ConvexProxyDeform.md.
 *
 * Cost: proxy and rounding depend on NumberOfProxyPoints (.2 s for 5000), the projection takes some
 * microseconds per point. All three are kept between executions as long as nothing they depend on
 * has changed: a new t, gain, region or transfer costs milliseconds.
 *
 * @warning Meant for models that are about convex (thesis 5.4). Elsewhere, points that face each
 * other across a gap go to far places of the proxy, lines from point to foot cross, and triangles
 * turn over. A warning says so where the model fills less than a third of its hull or more than one
 * in a hundred triangles turned over.
 *
 * @warning Linked with CGAL, which is GPL.
 *
 * @sa vtkSphericalStyleFilter vtkExtractSelection
 */
#ifndef vtkConvexProxyDeformFilter_h
#define vtkConvexProxyDeformFilter_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkSetRangeMacro.h"            // for its macro
#include "vtkStyleAlgorithm.h"

#include <memory> // for std::unique_ptr
#include <vector> // for std::vector

struct vtkSurfaceMesh;

namespace SphericalStyle
{
struct ProxyDeformationOptions;
struct ProxyDeformationReport;
}

class SPHERICALSTYLEFILTERS_EXPORT vtkConvexProxyDeformFilter : public vtkStyleAlgorithm
{
public:
  static vtkConvexProxyDeformFilter* New();
  vtkTypeMacro(vtkConvexProxyDeformFilter, vtkStyleAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Refinements
  {
    NEVER = 0,
    WHERE_COARSE = 1,
    ALWAYS = 2
  };
  enum ProxyMeshers
  {
    ISOTROPIC_REMESHING = 0,
    BALL_PIVOTING = 1,
    ADVANCING_FRONT = 2,
    SUBDIVIDED_HULL = 3
  };
  enum HullSources
  {
    WHOLE_MODEL = 0,
    REGION = 1
  };
  enum CenterModes
  {
    POINT_MEAN = 0,
    AREA_CENTROID = 1,
    CUSTOM_CENTER = 2
  };
  enum RadiusModes
  {
    EQUAL_AREA = 0,
    EQUAL_VOLUME = 1,
    CUSTOM_RADIUS = 2
  };
  enum SphericalWeightings
  {
    UNIFORM = 0,
    COTANGENT = 1
  };
  enum Projections
  {
    CLOSEST_POINT = 0,
    NEAREST_VERTICES = 1,
    SMALLEST_ANGLE = 2,
    DIRECTION_ARRAY = 3
  };
  enum BlendFunctions
  {
    CONSTANT = 0,
    LINEAR = 1,
    QUADRATIC = 2,
    TANH = 3,
    SMOOTHSTEP = 4,
    ARRAY = 5
  };
  enum Transfers
  {
    BLEND = 0,
    OFFSET = 1
  };

  /// The proxy of your own. @{
  void SetProxyConnection(vtkAlgorithmOutput* proxy);
  void SetProxyData(vtkPolyData* proxy);
  /// @}

  /// What may move. @{
  void SetSelectionConnection(vtkAlgorithmOutput* selection);
  void SetSelectionData(vtkDataObject* selection);
  /// @}

  ///@{
  /**
   * How the hull becomes a mesh of even triangles: IsotropicRemeshing (default; by CGAL),
   * BallPivoting (thesis; Poisson-disk samples and a rolling ball), AdvancingFront (by CGAL on the
   * same samples) or SubdividedHull (the hull's own triangles with long edges cut: exactly the
   * hull, slivers included). A mesher that fails, on thin and flat hulls, hands over to
   * IsotropicRemeshing with a warning. No effect with a proxy of your own.
   */
  vtkSetRangeMacro(ProxyMesher, int, ISOTROPIC_REMESHING, SUBDIVIDED_HULL);
  vtkGetMacro(ProxyMesher, int);
  void SetProxyMesherToIsotropicRemeshing() { this->SetProxyMesher(ISOTROPIC_REMESHING); }
  void SetProxyMesherToBallPivoting() { this->SetProxyMesher(BALL_PIVOTING); }
  void SetProxyMesherToAdvancingFront() { this->SetProxyMesher(ADVANCING_FRONT); }
  void SetProxyMesherToSubdividedHull() { this->SetProxyMesher(SUBDIVIDED_HULL); }
  ///@}

  ///@{
  /**
   * Whose hull is taken where a region is given: Region (default; a head becomes round in itself)
   * or WholeModel (it is pulled to the ball of the whole model). A region that lies in a plane
   * takes the whole model's.
   */
  vtkSetRangeMacro(HullOf, int, WHOLE_MODEL, REGION);
  vtkGetMacro(HullOf, int);
  void SetHullOfToWholeModel() { this->SetHullOf(WHOLE_MODEL); }
  void SetHullOfToRegion() { this->SetHullOf(REGION); }
  ///@}

  ///@{
  /**
   * Points of the proxy, about: more follow the hull closer and take longer. SubdividedHull has at
   * least those of the hull. Range 4 to 1,000,000. Default 5000.
   */
  vtkSetRangeMacro(NumberOfProxyPoints, int, 4, 1000000);
  vtkGetMacro(NumberOfProxyPoints, int);
  ///@}

  ///@{
  /**
   * Seed of the samples of BallPivoting and AdvancingFront: the same seed, the same bits. 0 or
   * more. Default 0.
   */
  vtkSetRangeMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * How round the proxy gets: weight lambda of the spherical term. 0 leaves it as it is, 5 is
   * nearly a ball. How much of it the model takes over is a matter of t. No unit. Range 0 and up; a
   * negative or non-finite value is an error. Default 5.
   */
  vtkSetMacro(Roundness, double);
  vtkGetMacro(Roundness, double);
  ///@}

  ///@{
  /**
   * Where the center O of the target sphere lies: AreaCentroid (default; of the proxy's surface),
   * PointMean (mean of the proxy's points; thesis) or Custom (Center).
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
   * Radius r of the target sphere: EqualArea (default, sqrt(A / 4 pi) of the proxy), EqualVolume
   * (cube root of 3 V / 4 pi) or Custom (Radius).
   */
  vtkSetRangeMacro(RadiusMode, int, EQUAL_AREA, CUSTOM_RADIUS);
  vtkGetMacro(RadiusMode, int);
  void SetRadiusModeToEqualArea() { this->SetRadiusMode(EQUAL_AREA); }
  void SetRadiusModeToEqualVolume() { this->SetRadiusMode(EQUAL_VOLUME); }
  void SetRadiusModeToCustom() { this->SetRadiusMode(CUSTOM_RADIUS); }
  ///@}

  ///@{
  /**
   * Radius r when RadiusMode is Custom, model length. Larger grows the proxy. Above 0. Default 1.
   */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * Weight of an edge of the proxy in the spherical term: Cotangent (default), so that the rounding
   * does not depend on the proxy's triangles and comes in closed form, or Uniform (thesis). On even
   * triangles both are the same; on those of SubdividedHull only Cotangent is smooth.
   */
  vtkSetRangeMacro(SphericalWeighting, int, UNIFORM, COTANGENT);
  vtkGetMacro(SphericalWeighting, int);
  void SetSphericalWeightingToUniform() { this->SetSphericalWeighting(UNIFORM); }
  void SetSphericalWeightingToCotangent() { this->SetSphericalWeighting(COTANGENT); }
  ///@}

  ///@{
  /**
   * Which foot a point gets on the proxy: ClosestPoint (default; exact), NearestVertices (thesis;
   * only triangles at the NumberOfNeighbors nearest proxy points are looked at), SmallestAngle (the
   * projection along the proxy's normal that deviates least from the point's own normal: recesses
   * such as doors do not sink further) or DirectionArray (along a vector per point, input array 1).
   */
  vtkSetRangeMacro(Projection, int, CLOSEST_POINT, DIRECTION_ARRAY);
  vtkGetMacro(Projection, int);
  void SetProjectionToClosestPoint() { this->SetProjection(CLOSEST_POINT); }
  void SetProjectionToNearestVertices() { this->SetProjection(NEAREST_VERTICES); }
  void SetProjectionToSmallestAngle() { this->SetProjection(SMALLEST_ANGLE); }
  void SetProjectionToDirectionArray() { this->SetProjection(DIRECTION_ARRAY); }
  ///@}

  ///@{
  /**
   * k of NearestVertices: with more, the true nearest triangle is missed less often. Range 1 to
   * 100. Default 4 (thesis).
   */
  vtkSetRangeMacro(NumberOfNeighbors, int, 1, 100);
  vtkGetMacro(NumberOfNeighbors, int);
  ///@}

  ///@{
  /**
   * How t runs: Constant (default; Blend everywhere) or, along BlendAxis, from BlendAtStart to
   * BlendAtEnd as Linear s, Quadratic s^2, Tanh (steepest in the middle) or Smoothstep
   * s^2 (3 - 2 s), s = 0..1 over BlendRange; or Array (input array 2).
   */
  vtkSetRangeMacro(BlendFunction, int, CONSTANT, ARRAY);
  vtkGetMacro(BlendFunction, int);
  void SetBlendFunctionToConstant() { this->SetBlendFunction(CONSTANT); }
  void SetBlendFunctionToLinear() { this->SetBlendFunction(LINEAR); }
  void SetBlendFunctionToQuadratic() { this->SetBlendFunction(QUADRATIC); }
  void SetBlendFunctionToTanh() { this->SetBlendFunction(TANH); }
  void SetBlendFunctionToSmoothstep() { this->SetBlendFunction(SMOOTHSTEP); }
  void SetBlendFunctionToArray() { this->SetBlendFunction(ARRAY); }
  ///@}

  ///@{
  /**
   * t of BlendFunction Constant: 1 leaves the model as it is, 0 puts it on the rounded proxy. No
   * unit. Range 0..1. Default 0.5.
   */
  vtkSetRangeMacro(Blend, double, 0.0, 1.0);
  vtkGetMacro(Blend, double);
  ///@}

  ///@{
  /**
   * Direction along which t runs, of any length but 0, in model coordinates. Default (0, 1, 0).
   */
  vtkSetVector3Macro(BlendAxis, double);
  vtkGetVector3Macro(BlendAxis, double);
  ///@}

  ///@{
  /**
   * Where along BlendAxis the run of t starts and ends, as fractions of the extent of the input:
   * (0, 1), the default, is from its lowest to its highest point. Before and behind, t stays as at
   * that end. Start below end.
   */
  vtkSetVector2Macro(BlendRange, double);
  vtkGetVector2Macro(BlendRange, double);
  ///@}

  ///@{
  /**
   * t where the run starts and where it ends. Range 0..1. Default 0 and 1: from the rounded proxy
   * to the unmoved model.
   */
  vtkSetRangeMacro(BlendAtStart, double, 0.0, 1.0);
  vtkGetMacro(BlendAtStart, double);
  vtkSetRangeMacro(BlendAtEnd, double, 0.0, 1.0);
  vtkGetMacro(BlendAtEnd, double);
  ///@}

  ///@{
  /**
   * k of Tanh, (1 + tanh(k (2 s - 1)) / tanh k) / 2: near 0 it is Linear, larger is nearer to a
   * step. Above 0. Default 3.
   */
  vtkSetMacro(TanhSteepness, double);
  vtkGetMacro(TanhSteepness, double);
  ///@}

  ///@{
  /**
   * Emphasis: factors that stretch the rounded proxy from the center along x, y, z before it is
   * blended. 1 is none, above 1 enlarges along that axis. Finite and 0 or more. Default (1, 1, 1).
   */
  vtkSetVector3Macro(AxisGain, double);
  vtkGetVector3Macro(AxisGain, double);
  ///@}

  ///@{
  /**
   * Width of the band inside a region over which t rises to 1, as a fraction of the diagonal of the
   * input's bounds. Wider is smoother, 0 leaves a step. No effect without a region. Range 0..1.
   * Default 0.2.
   */
  vtkSetRangeMacro(BorderWidth, double, 0.0, 1.0);
  vtkGetMacro(BorderWidth, double);
  ///@}

  ///@{
  /**
   * What becomes of the distance between point and proxy: Blend (default; Eq. 5.18, it shrinks by
   * t, so that details flatten) or Offset (it is kept, turned with the proxy).
   */
  vtkSetRangeMacro(Transfer, int, BLEND, OFFSET);
  vtkGetMacro(Transfer, int);
  void SetTransferToBlend() { this->SetTransfer(BLEND); }
  void SetTransferToOffset() { this->SetTransfer(OFFSET); }
  ///@}

  ///@{
  /**
   * Split edges longer than .04 diagonals of the bounds before all else, so that a panel of two
   * triangles can become round: Off, Automatic (default; where a twentieth of the area is of
   * triangles with an edge above a tenth of the diagonal) or On. The output then has more points
   * and cells than the input (RefinedPoint, OriginalCell), as with vtkSphericalStyleFilter.
   */
  vtkSetRangeMacro(RefineLongEdges, int, NEVER, ALWAYS);
  vtkGetMacro(RefineLongEdges, int);
  void SetRefineLongEdgesToOff() { this->SetRefineLongEdges(NEVER); }
  void SetRefineLongEdgesToAutomatic() { this->SetRefineLongEdges(WHERE_COARSE); }
  void SetRefineLongEdgesToOn() { this->SetRefineLongEdges(ALWAYS); }
  ///@}

  ///@{
  /**
   * Add the point arrays ProxyCell, Barycentric and ProjectionCase. Default off.
   */
  vtkSetMacro(GenerateProjectionArrays, bool);
  vtkGetMacro(GenerateProjectionArrays, bool);
  vtkBooleanMacro(GenerateProjectionArrays, bool);
  ///@}

  ///@{
  /**
   * Facts of the last execution: points of the proxy; the mesher that made it (a ProxyMeshers, -1
   * for a proxy of your own); volume of the model over that of its hull (NaN if the model is not
   * closed, or the proxy your own or that of a region); triangles that turned over; points in each
   * ProjectionCase (NearestVertices); largest surplus of such a foot's distance over that of the
   * closest point, as a fraction of the diagonal (NearestVertices); the center and radius that were
   * used.
   */
  vtkGetMacro(EffectiveNumberOfProxyPoints, int);
  vtkGetMacro(EffectiveProxyMesher, int);
  vtkGetMacro(ConvexityRatio, double);
  vtkGetMacro(TrianglesTurnedOver, int);
  vtkGetVector3Macro(ProjectionCaseCounts, int);
  vtkGetMacro(ProjectionError, double);
  vtkGetVector3Macro(EffectiveCenter, double);
  vtkGetMacro(EffectiveRadius, double);
  ///@}

protected:
  vtkConvexProxyDeformFilter();
  ~vtkConvexProxyDeformFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestWholeData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkConvexProxyDeformFilter(const vtkConvexProxyDeformFilter&) = delete;
  void operator=(const vtkConvexProxyDeformFilter&) = delete;

  /// RequestData, which turns what this throws into a message.
  int Execute(vtkInformationVector** inputVector, vtkInformationVector* outputVector);

  // Its steps.
  void CheckProperties() const;
  SphericalStyle::ProxyDeformationOptions MakeOptions() const;
  void TakeArrays(const vtkSurfaceMesh& surface, vtkPolyData* model,
    SphericalStyle::ProxyDeformationOptions& options);
  /// t of every mesh point and axis. @return whether an array of 3 components gave it
  bool TakeBlend(const vtkSurfaceMesh& surface, vtkPolyData* model, const std::vector<char>& region,
    SphericalStyle::ProxyDeformationOptions& options);
  void SetFacts(const SphericalStyle::ProxyDeformationReport& report, int proxyPoints,
    double diagonal, bool ownProxy);

  int ProxyMesher = ISOTROPIC_REMESHING;
  int HullOf = REGION;
  int NumberOfProxyPoints = 5000;
  int Seed = 0;
  double Roundness = 5.0;
  int CenterMode = AREA_CENTROID;
  double Center[3] = { 0.0, 0.0, 0.0 };
  int RadiusMode = EQUAL_AREA;
  double Radius = 1.0;
  int SphericalWeighting = COTANGENT;
  int Projection = CLOSEST_POINT;
  int NumberOfNeighbors = 4;
  int BlendFunction = CONSTANT;
  double Blend = 0.5;
  double BlendAxis[3] = { 0.0, 1.0, 0.0 };
  double BlendRange[2] = { 0.0, 1.0 };
  double BlendAtStart = 0.0;
  double BlendAtEnd = 1.0;
  double TanhSteepness = 3.0;
  double AxisGain[3] = { 1.0, 1.0, 1.0 };
  double BorderWidth = 0.2;
  int Transfer = BLEND;
  int RefineLongEdges = WHERE_COARSE;
  bool GenerateProjectionArrays = false;

  int EffectiveNumberOfProxyPoints = 0;
  int EffectiveProxyMesher = -1;
  double ConvexityRatio = 0.0;
  int TrianglesTurnedOver = 0;
  int ProjectionCaseCounts[3] = { 0, 0, 0 };
  double ProjectionError = 0.0;
  double EffectiveCenter[3] = { 0.0, 0.0, 0.0 };
  double EffectiveRadius = 0.0;

  struct Internals; // proxy, solver and feet, kept between executions
  std::unique_ptr<Internals> Internal;
};

#endif
