// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What would improve a result, from what is measured on mesh and result. [advice]
#ifndef SphericalStyle_Advice_h
#define SphericalStyle_Advice_h

#include "Creases.h"
#include "SphericalStyleMethod.h"

#include <string>

namespace SphericalStyle
{
/// What matters of the mesh alone. Shares are 0..1.
struct SurfaceFacts
{
  double obtuseShare = 0.0; ///< triangles with an angle above a right one, of all
  double areaFactor = 1.0;  ///< by which areas of triangles differ: exp of the deviation of the log
  double longEdgeShare = 0.0; ///< area of triangles with an edge of LongEdge diagonals or more
  double curvature = 0.0;     ///< integral of |Gaussian curvature| over 4 pi: 1 for convex bodies
  double cornerShare = 0.0;   ///< of that integral at points of at least Corner
  int components = 0;
  /// How often it is as long as wide, by its moments. Only looked for on simple bodies of flat
  /// faces.
  double elongation = 1.0;
  double planarShare = 0.0; ///< these three as in CreaseProbes; 0 of a surface that is spread
  double boxEdges = 0.0;
  double border = 0.0;
  /// The creases that a result makes are looked for by these; none of a surface that is spread over
  /// processes.
  CreaseProbes creases;
};
constexpr double LongEdge = 0.1;
/// |Gaussian curvature| that makes a point a corner: half of what a corner of a box has. The points
/// of a ball of 8 x 8 panels have a quarter of this.
constexpr double Corner = Pi / 4.0;
/// From this longEdgeShare on a model has coarse panels. Scans have none, a teapot of 3751
/// triangles 10 %, the cut stem of a vase 17 %, drawings of cars and devices half and more.
constexpr double CoarseShare = 0.05;
/// SurfaceFacts::longEdgeShare alone; 0 without triangles.
double LongEdgeShare(const TriangleMesh& mesh, const SurfacePart& part = {});
/// @param components  of the mesh: StyleReport::components
/// @param part  of a surface that is spread over processes, all of which call this and
/// MeasureResult; its areaFactor is not looked for
SurfaceFacts MeasureSurface(const TriangleMesh& mesh, int components, const SurfacePart& part = {});

/// What matters of a result. Shares are 0..1.
struct ResultFacts
{
  bool centerOutside = false;   ///< O lies outside of a closed surface
  bool centroidOutside = false; ///< so does the centroid of its area; only looked for where O does,
                                ///< and is a center of one's own
  bool blendsByArray = false;   ///< NormalBlend has an array; a process without points has none
  double facingAwayShare = 0.0; ///< area whose normal at rest points toward O, of all; with normals
                                ///< in play only looked for around a center of one's own
  double creasedShare = 0.0; ///< area at new creases (NewCreases); only looked for on open shells
  /// Triangles turned over, of all; only looked for where as many have turned by a right angle.
  double turnedOverShare = 0.0;
};
/// @param Q  the points of the result @param o, report  those of the solve that led there
ResultFacts MeasureResult(const TriangleMesh& mesh, const SurfaceFacts& surface, const Points& Q,
  const MethodOptions& o, const StyleReport& report, const SurfacePart& part = {});

/// What matters of the model before long edges are split.
struct ModelFacts
{
  int points = 0;         ///< coincident ones are one; 0 if they are too many to be looked at
  double meanAngle = 0.0; ///< these two as in CreaseProbes
  double planarShare = 0.0;
  bool isSubdividable = false; ///< a manifold without coincident points
};
/// @param hasCoincident  whether points of the model are one in the mesh
ModelFacts MeasureModel(const TriangleMesh& mesh, bool hasCoincident);

/// What the caller can do besides MethodOptions.
struct AdviceChoices
{
  bool avoidsFolds = false; ///< AvoidSelfIntersections is on
  bool refine = true;       ///< RefineLongEdges is off
  /// Share of the area that had long edges before they were split, 0..1; 0 where none were.
  double splitShare = 0.0;
  ModelFacts model;
  bool canAvoidFolds = true; ///< AvoidSelfIntersections is there
};

/// The one change that helps most, and the fact that says so, as "Property Value: fact", in one
/// line: words as in the class, On and Off for true and false, and for Input the filter to put in
/// front; where nothing here has the value, a sentence. The property does not have that value yet,
/// so advice that was followed does not come again. Empty where nothing is to be said, as with
/// lambda 0.
std::string Advise(const MethodOptions& o, const SurfaceFacts& surface, const ResultFacts& result,
  const AdviceChoices& choices);
} // namespace SphericalStyle

#endif
