// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSphericalStyleFilter
 * @brief   round a surface the way toys and cartoon characters are round, details kept
 *
 * The output is the input with moved points. A smooth base of the model is blended with its target,
 * one ball or limbs that are round by their own thickness; details ride on the base and turn with
 * it; the result has the size of the model. All of it is in closed form: nothing iterates. The
 * energy of the thesis is minimized only on request (see Energy below).
 *
 * Input port 0: vtkPolyData. Triangles, quads, polygons and strips take part in the solve
 * (triangulated inside, cells unchanged on output); lines, vertices and points of no face are
 * carried along unmoved. Open borders, several components, non-manifold edges and coincident points
 * are allowed. It may be spread over processes: in closed form each rounds its own part, and what
 * is sent does not depend on the number of points, but for those that several processes have. A
 * region, center ids, Symmetry, Target Mesh, a rest pose, AvoidSelfIntersections, a one-sided
 * surface, points that are not welded and edges to be split have it gathered instead, and so has
 * the energy (vtkWholeSurfaceAlgorithm).
 *
 * Input port 1, optional: vtkPointSet, centers of your own for array 5, one point per id: in the
 * order of the ids, or, when it has a point array of that array's name, the point with that id.
 *
 * Input port 2, optional: vtkSelection of points or cells of the model. Points outside keep their
 * bits.
 *
 * Input port 3, optional: vtkPolyData, the rest pose of a model that moves, with the same points
 * and cells: a time step of it, or a skin before it is posed. Grid, thickness, radius and split
 * edges are those of the rest pose, so that nothing jitters and steps are faster [pose]. In closed
 * form only, and not with AvoidSelfIntersections, Symmetry or ReproduceThesis.
 *
 * Input port 4, optional: vtkPolyData, the mesh for Target Mesh: closed, and all of it seen from
 * the centroid of its surface. It may be anywhere, and of any size.
 *
 * Input arrays to process, all optional, all of point data:
 *  - 0: normals, 3 components, used where NormalBlend > 0 with DetailSize 0, and where an energy is
 *       minimized with NormalRadius WholeModel (default: the active normals, or computed ones;
 *       with DetailSize > 0 the base has normals of its own);
 *  - 1: roundness factor, 1 component, >= 0: the Roundness of a point is Roundness times it
 *       (default: the array PartRoundness of vtkPartSizesFilter, where there is one);
 *  - 2: normal blend, 1 component, 0..1: replaces NormalBlend point by point (default: the array
 *       PartNormalBlend of vtkPartSizesFilter, 2 components: a value, and its weight against
 *       NormalBlend);
 *  - 3: target directions, 3 components, replace t (length 1 means radius r);
 *  - 4: region, 1 component: points where it is 0 keep their bits. With a selection too, a point
 *       must be in both;
 *  - 5: center id, 1 component, whole numbers, at most 256 different ones: the points of each id
 *       have a center and a radius of their own (thesis 4.6.6). Coincident points take the id of
 *       the first of them.
 *
 * Output port 0: vtkPolyData with the cells, point order and every array of the input, unless
 * RefineLongEdges splits cells, and the point arrays
 *  - TargetDirection (3): t, no unit [symbols];
 *  - Displacement (3): output minus input point, model length;
 *  - Normals: recomputed if the input had point normals or GenerateNormals is on;
 *  - RegionWeight (1): with a region, 0 outside, 1 inside, between them along the border;
 *  - RemainingRoundness (1): with AvoidSelfIntersections, the Roundness that each point kept;
 *  - Rotation (9, row by row): on demand;
 *  - RefinedPoint (1): with RefineLongEdges, 1 for new points, which come after those of the input.
 *
 * RefineLongEdges [refine] splits long edges before anything else, so that "input" means the split
 * surface from there on: Displacement is against it. Cells with a long edge become triangles, with
 * the cell arrays of the cell they come from; the cell array OriginalCell (1) is its id. On a new
 * point, floating-point arrays and colors are interpolated, whole numbers and center ids are those
 * of the nearest point of the input, and it is in the region, or selected, if all points of the
 * input that it lies between are. Texture seams stay shut and keep the coordinates of both sides.
 *
 * Output port 1: vtkTable, one row for the start and one per iteration, none in closed form:
 * Iteration, Total, Rigid, Spherical (energies, length^2), LocalChange, GlobalChange, Residual
 * (Eq. 3.46), Gap (estimated, see Tolerance; NaN while unknown). Its field data: StageSeconds
 * (Base, Weights, Analyze, Factor, Iterate, Triangles), LinearSolver, Spheres (4: center and
 * radius), one tuple per center id, ascending, NumberOfStitches (vtkThesisStyleFilter) and
 * NumberOfWallStitches (pairs through thin walls [wall]), Advice (GetAdvice) and, where each
 * process has rounded its own part, BytesExchanged (2: sent and received, one tuple per process).
 * With AvoidSelfIntersections the table is that of the last solve, and its field data has
 * TurnedOver and NewIntersectingPairs (2: before, after), GuardSolves, GuardRepairedPoints (moved
 * as their surroundings move) and GuardSeconds.
 *
 * Output port 2: vtkPolyData, the target sphere that was used, as circles of longitude and latitude
 * to look at; one sphere per center id. Empty where there was nothing to solve.
 *
 * Method, with B the base [base], d the directions from the center O, r the radius, n the normals
 * of B, rho half of the thickness of a limb [limb], a NormalBlend, mu = sqrt(3) Roundness, R
 * rotations:
 *
 *     T = O + (1 - a) r d + a rho n,   B' = (B + mu T) / (1 + mu)       [toy]
 *     P' = B' + R (P - B)                                               [carry]
 *
 * then scaled to its old size [size]. With several centers k their targets are blended by shares of
 * each point.
 *
 * Energy [energy], minimized over points p' and rotations R by local and global steps with
 * SphericalWeighting Uniform, EdgeWeighting FullEdge, StopRule FixedIterations and ReproduceThesis:
 *
 *     E = sum over triangles f, half-edges h = uv of f, corners y of f of
 *         c_h |e'_uv - R_y e_uv|^2 + l_h |r R_y (t_u - t_v) - e'_uv|^2
 *
 * c_h half cotangents, l_h = Roundness / 2 (Uniform) or sqrt(3) Roundness c_h (Cotangent), t = (T -
 * O) / r. It knows no details: with DetailSize > 0 they are carried on the base of what it leads
 * to. With several centers k the target of an edge is sum_k omega_k(uv) r_k (t^k_u - t^k_v),
 * omega_k(uv) the mean of the shares at its ends, so that nothing jumps between them.
 *
 * Source: Research of Spherical Style Deformation on Single Component Models (doctoral thesis),
 * chapter 4, Eq. 4.6 - 4.38, and Eq. 3.46 - 3.48; half-edge weights after
 * Chao, Pinkall, Sanan, Schroeder, A simple geometric model for elastic deformations, ACM TOG
 * 29(4), 2010, doi:10.1145/1778765.1778775. The bracketed labels are those of
 * Filters/Documentation/SphericalStyleMethod.md.
 *
 * Cost: a pass over the triangles, sums over the samples of a grid, and a factor of one to some ten
 * thousand unknowns, whatever the number of points; it is kept between executions, so that a new
 * Roundness, Center or NormalBlend takes about a tenth of the first result (.2 s at 949 000 points
 * on one thread). The energy costs a sparse factorization of the mesh (about n log n), then per
 * iteration one rotation per point and one triangular solve.
 *
 * A warning names the first point of parts that keep less than a tenth of their thickness, not
 * in closed form with DetailSize; up to 2000 points are looked at. Others report normals of the
 * model that are off by more than 60 degrees on more than a tenth of its area, where the result
 * follows them, and of a model that changes over time and is its own rest pose.
 *
 * @warning Large Roundness without DetailSize scales details down with everything else: at 5 a face
 * is gone. With NormalRadius WholeModel and NormalBlend > 0 the surface may fold at concave places
 * (thesis 4.5.3).
 *
 * @sa vtkThesisStyleFilter vtkNonlinearStyleFilter vtkPolyDataNormals vtkCurvatures
 * vtkIntersectionPolyDataFilter
 */
#ifndef vtkSphericalStyleFilter_h
#define vtkSphericalStyleFilter_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkIterativeStyleAlgorithm.h"
#include "vtkSetRangeMacro.h" // for its macro
#include "vtkTimeStamp.h"     // for vtkTimeStamp

#include <memory> // for std::shared_ptr
#include <string> // for std::string

class vtkPointSet;
class vtkPolyData;
class vtkProcesses;

namespace SphericalStyle
{
struct MethodOptions;
}

class SPHERICALSTYLEFILTERS_EXPORT vtkSphericalStyleFilter : public vtkIterativeStyleAlgorithm
{
public:
  static vtkSphericalStyleFilter* New();
  vtkTypeMacro(vtkSphericalStyleFilter, vtkIterativeStyleAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Targets
  {
    SPHERE = 0,
    ELLIPSOID = 1,
    CAPSULE = 2,
    CYLINDER = 3,
    ROUNDED_BOX = 4,
    SUPERQUADRIC = 5,
    TARGET_MESH = 6
  };
  enum NormalRadii
  {
    OWN_THICKNESS = 0,
    WHOLE_MODEL_RADIUS = 1
  };
  enum KeptSizes
  {
    NO_SIZE = 0,
    AREA = 1,
    VOLUME = 2,
    EXTENT = 3
  };
  enum UpAxes
  {
    X_AXIS = 0,
    Y_AXIS = 1,
    Z_AXIS = 2
  };
  enum Symmetries
  {
    NO_SYMMETRY = 0,
    FOUND_PLANE = 1,
    ACROSS_X = 2,
    ACROSS_Y = 3,
    ACROSS_Z = 4
  };
  enum Refinements
  {
    NEVER = 0,
    WHERE_COARSE = 1,
    ALWAYS = 2
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
  enum EdgeWeightings
  {
    HALF_EDGE = 0,
    FULL_EDGE = 1,
    INTRINSIC_DELAUNAY = 2
  };
  enum SphereSources
  {
    WHOLE_MODEL = 0,
    REGION = 1
  };

  /// Centers of your own for the center ids. @{
  void SetCentersConnection(vtkAlgorithmOutput* centers);
  void SetCentersData(vtkPointSet* centers);
  /// @}

  /// What may move. @{
  void SetSelectionConnection(vtkAlgorithmOutput* selection);
  void SetSelectionData(vtkDataObject* selection);
  /// @}

  /// The model in its rest pose. @{
  void SetRestPoseConnection(vtkAlgorithmOutput* rest);
  void SetRestPoseData(vtkPolyData* rest);
  /// @}

  /// The mesh for Target Mesh. @{
  void SetTargetMeshConnection(vtkAlgorithmOutput* mesh);
  void SetTargetMeshData(vtkPolyData* mesh);
  /// @}

  ///@{
  /**
   * How round the model becomes: 0 leaves it as it is, 0.3 softens it, 1 is clearly round, 5 is
   * nearly a ball. The weight lambda of the spherical term, no unit. Range 0 and up; a negative or
   * non-finite value is an error. Default 1.
   */
  vtkSetMacro(Roundness, double);
  vtkGetMacro(Roundness, double);
  ///@}

  ///@{
  /**
   * What becomes round: from 0, the whole model toward one ball, to 1, every limb by itself (see
   * NormalRadius). The blend a between the direction from the center and the normal of the base, no
   * unit. Range 0..1. Default 0.6.
   */
  vtkSetRangeMacro(NormalBlend, double, 0.0, 1.0);
  vtkGetMacro(NormalBlend, double);
  ///@}

  ///@{
  /**
   * How thick NormalBlend makes a limb [limb]: OwnThickness (default; as it is, so that limbs
   * become shorter and keep their thickness) or WholeModel (thesis; every limb wants to be a ball
   * as large as the model).
   */
  vtkSetRangeMacro(NormalRadius, int, OWN_THICKNESS, WHOLE_MODEL_RADIUS);
  vtkGetMacro(NormalRadius, int);
  void SetNormalRadiusToOwnThickness() { this->SetNormalRadius(OWN_THICKNESS); }
  void SetNormalRadiusToWholeModel() { this->SetNormalRadius(WHOLE_MODEL_RADIUS); }
  ///@}

  ///@{
  /**
   * Scale the result so that this stays what it was [size]: Area (default), Volume (an error where
   * none is enclosed) or Extent (along UpAxis); Off does not scale. The center of the scaling is
   * the mean of the points, each with a third of the rest area of its triangles. With a region it
   * is the region that is measured and scaled, before its border fades.
   */
  vtkSetRangeMacro(KeepSize, int, NO_SIZE, EXTENT);
  vtkGetMacro(KeepSize, int);
  void SetKeepSizeToOff() { this->SetKeepSize(NO_SIZE); }
  void SetKeepSizeToArea() { this->SetKeepSize(AREA); }
  void SetKeepSizeToVolume() { this->SetKeepSize(VOLUME); }
  void SetKeepSizeToExtent() { this->SetKeepSize(EXTENT); }
  ///@}

  ///@{
  /**
   * Move the result along UpAxis so that its lowest point lies on the level of the model's lowest
   * point. Does nothing where there is a region: the rest of the model stays on the ground anyway.
   * Default off.
   */
  vtkSetMacro(KeepOnGround, bool);
  vtkGetMacro(KeepOnGround, bool);
  vtkBooleanMacro(KeepOnGround, bool);
  ///@}

  ///@{
  /**
   * The axis that points up, for KeepOnGround and KeepSize Extent: X, Y (default) or Z.
   */
  vtkSetRangeMacro(UpAxis, int, X_AXIS, Z_AXIS);
  vtkGetMacro(UpAxis, int);
  void SetUpAxisToX() { this->SetUpAxis(X_AXIS); }
  void SetUpAxisToY() { this->SetUpAxis(Y_AXIS); }
  void SetUpAxisToZ() { this->SetUpAxis(Z_AXIS); }
  ///@}

  ///@{
  /**
   * What the model is drawn toward as a whole [target]: Sphere (default), Ellipsoid, Capsule,
   * Cylinder, RoundedBox, Superquadric, or Mesh (input port 4). As large as the sphere, and about
   * its center. NormalBlend says how much of it there is against limbs that are round by
   * themselves; at 0 and a large Roundness the model becomes the shape. An error together with
   * ReproduceThesis and with an array of target directions. There is no Preview with shapes other
   * than the sphere.
   */
  vtkSetRangeMacro(Target, int, SPHERE, TARGET_MESH);
  vtkGetMacro(Target, int);
  void SetTargetToSphere() { this->SetTarget(SPHERE); }
  void SetTargetToEllipsoid() { this->SetTarget(ELLIPSOID); }
  void SetTargetToCapsule() { this->SetTarget(CAPSULE); }
  void SetTargetToCylinder() { this->SetTarget(CYLINDER); }
  void SetTargetToRoundedBox() { this->SetTarget(ROUNDED_BOX); }
  void SetTargetToSuperquadric() { this->SetTarget(SUPERQUADRIC); }
  void SetTargetToMesh() { this->SetTarget(TARGET_MESH); }
  ///@}

  ///@{
  /**
   * How round the edges of cylinders, boxes and superquadrics are: the radius of the edges as a
   * share of the shortest half length, and both exponents of a superquadric (PhiRoundness and
   * ThetaRoundness of vtkSuperquadric). No unit. Range 0 (sharp)..1, default .5.
   */
  vtkSetRangeMacro(TargetEdges, double, 0.0, 1.0);
  vtkGetMacro(TargetEdges, double);
  ///@}

  ///@{
  /**
   * Lengths of the target along x, y and z, of which only the ratios count, no shorter than a tenth
   * of the longest. 0 0 0 (default): the axes and proportions of the model, by the second moments
   * of its surface; axes within 20 degrees of x, y or z are that, so that targets stand upright.
   * All above 0 or all 0, else an error. A cylinder lies along the axis that differs most, a
   * capsule along the longest. Ignored for Sphere and Mesh.
   */
  vtkSetVector3Macro(TargetLengths, double);
  vtkGetVector3Macro(TargetLengths, double);
  ///@}

  ///@{
  /**
   * Whether the deformation is symmetric about a plane [symmetry]: Off (default), Automatic (the
   * plane that the model is nearest to being symmetric about; an error where there is none), or X,
   * Y, Z (a plane across that axis, where the model is nearest to its mirror image; a warning where
   * that is far). Points that are mirror images of each other stay so to 1e-12 of the diagonal;
   * what is on one side only stays there. A custom center is moved onto the plane, with a warning.
   * An error where something is minimized, and with center ids, AvoidSelfIntersections,
   * ReproduceThesis or a rest pose. Takes twice the time and memory, and the search, once for each
   * model, .1 to 3 s in one thread. The field data of output 1 have the plane (SymmetryPlane: a
   * point and the normal).
   */
  vtkSetRangeMacro(Symmetry, int, NO_SYMMETRY, ACROSS_Z);
  vtkGetMacro(Symmetry, int);
  void SetSymmetryToOff() { this->SetSymmetry(NO_SYMMETRY); }
  void SetSymmetryToAutomatic() { this->SetSymmetry(FOUND_PLANE); }
  void SetSymmetryToX() { this->SetSymmetry(ACROSS_X); }
  void SetSymmetryToY() { this->SetSymmetry(ACROSS_Y); }
  void SetSymmetryToZ() { this->SetSymmetry(ACROSS_Z); }
  ///@}

  ///@{
  /**
   * Where the center O of the target sphere lies: AreaCentroid (default; the same for any sampling
   * of the surface), PointMean (mean of the points that take part, coincident ones once; thesis) or
   * Custom (Center).
   */
  vtkSetRangeMacro(CenterMode, int, POINT_MEAN, CUSTOM_CENTER);
  vtkGetMacro(CenterMode, int);
  void SetCenterModeToPointMean() { this->SetCenterMode(POINT_MEAN); }
  void SetCenterModeToAreaCentroid() { this->SetCenterMode(AREA_CENTROID); }
  void SetCenterModeToCustom() { this->SetCenterMode(CUSTOM_CENTER); }
  ///@}

  ///@{
  /**
   * Center O when CenterMode is Custom, in model coordinates. Surface near O becomes rounder;
   * outside the model it makes the facing side flatter, and concave with a low NormalBlend. Default
   * (0, 0, 0).
   */
  vtkSetVector3Macro(Center, double);
  vtkGetVector3Macro(Center, double);
  ///@}

  ///@{
  /**
   * Radius r of the target sphere: EqualArea (default, sqrt(A / 4 pi); thesis), EqualVolume
   * (cube root of 3 V / 4 pi, for closed surfaces) or Custom (Radius).
   */
  vtkSetRangeMacro(RadiusMode, int, EQUAL_AREA, CUSTOM_RADIUS);
  vtkGetMacro(RadiusMode, int);
  void SetRadiusModeToEqualArea() { this->SetRadiusMode(EQUAL_AREA); }
  void SetRadiusModeToEqualVolume() { this->SetRadiusMode(EQUAL_VOLUME); }
  void SetRadiusModeToCustom() { this->SetRadiusMode(CUSTOM_RADIUS); }
  ///@}

  ///@{
  /**
   * Radius r when RadiusMode is Custom, model length. A larger one makes the model rounder, and
   * larger where KeepSize is Off. Above 0. Default 1.
   */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * Size of the details that keep their shape and only turn, as a fraction of the diagonal of the
   * model's bounds [base]: they ride on a base that is smooth at this size. 0: no details, all of
   * the model is blended (thesis). .03 keeps a face, .06 (default) also ears and hands.
   * Walls thinner than twice the size keep most of their thickness [wall]. Where the model has so
   * much area that the grid would have more than 60000 functions, the base is smoother than asked
   * for, and a warning says so. Range 0..0.2.
   */
  vtkSetRangeMacro(DetailSize, double, 0.0, 0.2);
  vtkGetMacro(DetailSize, double);
  ///@}

  ///@{
  /**
   * Whose points and area give center and radius where there is a region: Region (default; a head
   * becomes round in itself) or WholeModel. A Custom center or radius is taken as it is.
   */
  vtkSetRangeMacro(SphereOf, int, WHOLE_MODEL, REGION);
  vtkGetMacro(SphereOf, int);
  void SetSphereOfToWholeModel() { this->SetSphereOf(WHOLE_MODEL); }
  void SetSphereOfToRegion() { this->SetSphereOf(REGION); }
  ///@}

  ///@{
  /**
   * Width of the transition inside a region, as a fraction of the diagonal of the bounds. After the
   * solve, with everything outside held, displacements fade to 0 over it: neither slope nor
   * curvature jumps at the border. 0 leaves a crease. Range 0..1, default 0.1.
   */
  vtkSetRangeMacro(BorderWidth, double, 0.0, 1.0);
  vtkGetMacro(BorderWidth, double);
  ///@}

  ///@{
  /**
   * Length over which several centers pass into each other along the surface, as a fraction of the
   * diagonal of the bounds. 0 changes from one edge to the next; in closed form anything else is at
   * least 0.02. Range 0..1, default 0.02.
   */
  vtkSetRangeMacro(CenterBlendWidth, double, 0.0, 1.0);
  vtkGetMacro(CenterBlendWidth, double);
  ///@}

  ///@{
  /**
   * Weight of an edge in the spherical term: Cotangent (default), with which the result does not
   * depend on the triangulation and has a closed form; or Uniform (thesis), with which finely
   * meshed parts become rounder.
   */
  vtkSetRangeMacro(SphericalWeighting, int, UNIFORM, COTANGENT);
  vtkGetMacro(SphericalWeighting, int);
  void SetSphericalWeightingToUniform() { this->SetSphericalWeighting(UNIFORM); }
  void SetSphericalWeightingToCotangent() { this->SetSphericalWeighting(COTANGENT); }
  ///@}

  ///@{
  /**
   * Move small places where triangles would turn over or newly run through each other as their
   * surroundings move; where that is not enough, use less Roundness and solve again until none does
   * [guard]. The result is checked as it is written, in the number type of the output. What the
   * input has already stays. With NormalBlend 0 on models without thin parts it rarely changes
   * anything: then the result has the same bits as without. Off with ReproduceThesis. Cost: a
   * search for self-intersections, and where it finds some up to 26 solves and 30 searches, usually
   * 1 to 14, and after each solve up to three searches around small places. Needs CGAL: an error in
   * libraries built without it. Default off.
   */
  vtkSetMacro(AvoidSelfIntersections, bool);
  vtkGetMacro(AvoidSelfIntersections, bool);
  vtkBooleanMacro(AvoidSelfIntersections, bool);
  ///@}

  ///@{
  /**
   * HalfEdge (default): every triangle brings its own cotangents; the energy is never negative and
   * never rises. FullEdge: Eq. 4.13 and 4.22 to the letter, kept for reproduction; on obtuse or
   * open meshes its energy can rise and triangles turn over, and where it has no minimum (the
   * system matrix is not positive definite) a warning says so. IntrinsicDelaunay: as HalfEdge, but
   * over other triangles on the same points, the Delaunay triangles of the surface's own metric
   * (Fisher et al. 2007): no edge between two of them has a negative weight, so slivers and obtuse
   * triangles pull evenly. On a mesh without them it gives the bits of HalfEdge. Borders and edges
   * of three triangles stay. Costs about a second per million triangles, once per set of points.
   */
  vtkSetRangeMacro(EdgeWeighting, int, HALF_EDGE, INTRINSIC_DELAUNAY);
  vtkGetMacro(EdgeWeighting, int);
  void SetEdgeWeightingToHalfEdge() { this->SetEdgeWeighting(HALF_EDGE); }
  void SetEdgeWeightingToFullEdge() { this->SetEdgeWeighting(FULL_EDGE); }
  void SetEdgeWeightingToIntrinsicDelaunay() { this->SetEdgeWeighting(INTRINSIC_DELAUNAY); }
  ///@}

  ///@{
  /**
   * Split edges longer than MaximumEdgeLength before all else, so that a panel of two triangles
   * can become round. The output then has more points and cells than the input (RefinedPoint,
   * OriginalCell). Automatic (default) splits where a twentieth of the area is of triangles with an
   * edge above a tenth of the diagonal of the bounds.
   */
  vtkSetRangeMacro(RefineLongEdges, int, NEVER, ALWAYS);
  vtkGetMacro(RefineLongEdges, int);
  void SetRefineLongEdgesToOff() { this->SetRefineLongEdges(NEVER); }
  void SetRefineLongEdgesToAutomatic() { this->SetRefineLongEdges(WHERE_COARSE); }
  void SetRefineLongEdgesToOn() { this->SetRefineLongEdges(ALWAYS); }
  ///@}

  ///@{
  /**
   * Longest edge with RefineLongEdges, as a fraction of the diagonal of the model's bounds. Smaller
   * is smoother and slower: half of it takes four times the triangles; more than 2000000 new ones
   * are an error. Range 0.001..1. Default 0.04.
   */
  vtkSetRangeMacro(MaximumEdgeLength, double, 0.001, 1.0);
  vtkGetMacro(MaximumEdgeLength, double);
  ///@}

  ///@{
  /**
   * Run the method of the thesis to the letter. On overrides EdgeWeighting FullEdge,
   * SphericalWeighting Uniform, StopRule Thesis, CenterMode PointMean, DetailSize 0, NormalRadius
   * WholeModel, KeepSize Off, no KeepOnGround, no AvoidSelfIntersections and no RefineLongEdges;
   * the iteration starts from the model as it is, in plain steps, and the last point of each
   * component stays in place. Single steps of it: vtkThesisStyleFilter. Default off.
   */
  vtkSetMacro(ReproduceThesis, bool);
  vtkGetMacro(ReproduceThesis, bool);
  vtkBooleanMacro(ReproduceThesis, bool);
  ///@}

  ///@{
  /**
   * Add the point array Displacement. Default on.
   */
  vtkSetMacro(GenerateDisplacement, bool);
  vtkGetMacro(GenerateDisplacement, bool);
  vtkBooleanMacro(GenerateDisplacement, bool);
  ///@}

  ///@{
  /**
   * Add the point array Rotation. Default off.
   */
  vtkSetMacro(GenerateRotation, bool);
  vtkGetMacro(GenerateRotation, bool);
  vtkBooleanMacro(GenerateRotation, bool);
  ///@}

  ///@{
  /**
   * For programs, while something is dragged: a model of more than 50000 points comes out as a
   * coarse copy of about 25000 of its points [preview], which is quicker. They are about where the
   * full result has them, with all of their arrays. The full result has to be there, of this input:
   * else it is made instead, as it is where the result is not in closed form, with
   * AvoidSelfIntersections, Symmetry, a Target other than Sphere, a rest pose, a region, several
   * centers, input arrays or those of Part Sizes, and with NormalBlend and given normals at
   * DetailSize 0. The thickness of limbs stays that of the last full result. Warnings,
   * Advice and the facts of the guard come with the full result only. With several processes (MPI)
   * each makes its part coarse, where the full result is made in parts; the number of points is
   * that of all of them. Default off.
   */
  vtkSetMacro(Preview, bool);
  vtkGetMacro(Preview, bool);
  vtkBooleanMacro(Preview, bool);
  ///@}

  ///@{
  /**
   * Facts of the last execution: the center and radius that were used (model coordinates and
   * length; of the lowest id with several).
   */
  vtkGetVector3Macro(EffectiveCenter, double);
  vtkGetMacro(EffectiveRadius, double);
  ///@}

  ///@{
  /**
   * Facts of the last execution with AvoidSelfIntersections: triangles turned over (as
   * vtkSurfaceMetrics defines it) and new pairs of intersecting triangles, but for those next to
   * where parts run through each other in the input, with all of Roundness (before) and in the
   * result (after; 0). -1 without it, and where it was aborted.
   */
  vtkGetMacro(TurnedOverBefore, int);
  vtkGetMacro(TurnedOverAfter, int);
  vtkGetMacro(NewIntersectionsBefore, int);
  vtkGetMacro(NewIntersectionsAfter, int);
  ///@}

  /**
   * What AvoidSelfIntersections did in the last execution, in words: "418 pairs ... now none".
   * Empty without it, and as GetAdvice from a change of a property to the next execution.
   */
  const char* GetFoldSummary();

  /**
   * Frees what is kept to make the next execution quick: grid, base and thickness, the factor of
   * the energy where there was one, and the model as it is solved; about 0.4 kB a point in closed
   * form. Outputs stay. The next execution takes as long as the first. Called while an execution
   * runs, it frees all this when that ends.
   */
  void ReleaseCache();

  /**
   * Where the center lies: "Inside" or "Outside" of the model of the last execution (for open
   * surfaces by the solid angle that they fill), "NearSurface" inside where the surface comes
   * nearer to it than half of EffectiveRadius, or empty before the first and where it is not known
   * yet (or no more, after ReleaseCache). With CenterMode Custom that of Center as it is now,
   * before it is executed, so that one can ask while dragging it; else of the center that was used.
   * Not known where each process has rounded its own part.
   * O(triangles) for each call.
   */
  const char* GetCenterPosition();

  /**
   * The one change that would improve the result of the last execution most, in one line, from what
   * was measured: "SphericalWeighting Cotangent: 53 % of the triangles are obtuse". For the
   * property Input it names a filter to put in front: "Input LoopSubdivision: ...". Text without a
   * property and a value before it where no value helps, and where there is no other advice and the
   * model has time steps but no rest pose: how to use one. Else empty, and so with ReproduceThesis
   * and from a change of a property to the next execution. Nothing is changed by itself.
   */
  const char* GetAdvice();

protected:
  vtkSphericalStyleFilter();
  ~vtkSphericalStyleFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestWholeData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestPart(vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  /// Points of a preview, about; what has no more than twice as many is shown in full.
  int PreviewSize = 25000;

  // What only a study of the thesis changes: vtkThesisStyleFilter says what they are.
  int ConcaveEdges = 0;
  bool Acceleration = true;
  int Anchor = 0;
  int ComponentCoupling = 0;
  int InitialGuess = 0;
  bool WeldCoincidentPoints = true;
  bool GenerateCellEnergy = false;

private:
  vtkSphericalStyleFilter(const vtkSphericalStyleFilter&) = delete;
  void operator=(const vtkSphericalStyleFilter&) = delete;

  /// RequestData, which turns what this throws into a message.
  /// @param processes  that the surface is spread over, or nullptr
  int Execute(vtkInformationVector** inputVector, vtkInformationVector* outputVector,
    const std::shared_ptr<const vtkProcesses>& processes = nullptr);
  /// Whether the properties of all processes are the same, and need no whole surface.
  bool WorksOnParts(vtkInformationVector** inputVector, const vtkProcesses& processes);
  bool AllAgree(bool can, const vtkProcesses& processes) const; // with the same properties
  std::shared_ptr<const vtkProcesses> TakeProcesses() const;

  struct Internals; // what is kept between executions
  struct Execution; // what one execution solves, and how it ends

  // The steps of an execution.
  void CheckProperties() const;
  void TakePlane(Internals& internal, Execution& execution);
  void TakeTarget(vtkPolyData* mesh, Internals& internal, Execution& execution);
  void Take(vtkInformationVector** inputVector, Internals& internal,
    const std::shared_ptr<const vtkProcesses>& processes, Execution& execution);
  SphericalStyle::MethodOptions MakeOptions() const;
  void Solve(Internals& internal, Execution& execution);
  void AttachArrays(
    const Internals& internal, const Execution& execution, vtkPolyData* output) const;
  void SetFacts(const Execution& execution);
  void Review(Internals& internal, const Execution& execution);

  // A preview.
  void KeepBasis(Internals& internal, const Execution& execution, vtkPolyData* input) const;
  int RequestPreview(vtkInformationVector** inputVector, vtkInformationVector* outputVector);
  bool CanPreview(vtkInformationVector** inputVector, const vtkProcesses* processes);
  void MakePreview(
    vtkPolyData* input, vtkInformationVector* outputVector, const vtkProcesses* processes);

  static constexpr int NotCounted = -1;

  double Roundness = 1.0;
  double NormalBlend = 0.6;
  int NormalRadius = OWN_THICKNESS;
  int KeepSize = AREA;
  bool KeepOnGround = false;
  int UpAxis = Y_AXIS;
  int Target = SPHERE;
  double TargetEdges = 0.5;
  double TargetLengths[3] = { 0.0, 0.0, 0.0 };
  int Symmetry = NO_SYMMETRY;
  int CenterMode = AREA_CENTROID;
  double Center[3] = { 0.0, 0.0, 0.0 };
  int RadiusMode = EQUAL_AREA;
  double Radius = 1.0;
  double DetailSize = 0.06;
  int SphereOf = REGION;
  double BorderWidth = 0.1;
  double CenterBlendWidth = 0.02;
  int SphericalWeighting = COTANGENT;
  bool AvoidSelfIntersections = false;
  int EdgeWeighting = HALF_EDGE;
  int RefineLongEdges = WHERE_COARSE;
  double MaximumEdgeLength = 0.04;
  bool ReproduceThesis = false;
  bool GenerateDisplacement = true;
  bool GenerateRotation = false;
  bool Preview = false;

  double EffectiveCenter[3] = { 0.0, 0.0, 0.0 };
  double EffectiveRadius = 0.0;
  int TurnedOverBefore = NotCounted;
  int TurnedOverAfter = NotCounted;
  int NewIntersectionsBefore = NotCounted;
  int NewIntersectionsAfter = NotCounted;
  std::string FoldSummary;
  std::string Advice;
  vtkTimeStamp AdviceTime;
  int EffectiveCenterMode = AREA_CENTROID; // of the last execution

  std::shared_ptr<Internals> Internal; // an execution holds on to its own, see ReleaseCache
};

#endif
