// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The whole method of the proxy [proxy] (thesis chapter 5): options in, deformed points and a
/// report out.
#ifndef SphericalStyle_ProxyDeformation_h
#define SphericalStyle_ProxyDeformation_h

#include "ConvexProxy.h"
#include "ProxyTransfer.h"
#include "StyleSolver.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace SphericalStyle
{
enum class Projection
{
  ClosestPoint,
  NearestVertices,
  SmallestAngle,
  DirectionArray
};

/// What the user wants. Arrays of 0 rows mean "none".
struct ProxyDeformationOptions
{
  ConvexProxyOptions convexProxy;
  TriangleMesh ownProxy; ///< in the place of the convex proxy, if it has triangles
  /// Points whose hull is taken, ascending; all if empty, or if these lie in a plane.
  std::vector<int> hullPoints;
  StyleOptions style; ///< how the proxy is rounded
  Projection projection = Projection::ClosestPoint;
  int neighbors = 4; ///< k of NearestVertices
  Points normals;    ///< n x 3, for SmallestAngle; computed where absent
  Points directions; ///< n x 3, for DirectionArray
  Points t;          ///< n x 3, 0..1 per point and axis
  Transfer transfer = Transfer::Blend;
  Eigen::Vector3d gain = Eigen::Vector3d::Ones(); ///< see TransferOptions
  int threads = 1;
};

struct ProxyDeformationReport
{
  StyleReport style;
  bool aborted = false;
  bool flat = false;    ///< the model lies in a plane, and so does its proxy
  std::string fallback; ///< why the convex proxy was remeshed instead; empty if it was not
  /// Volume of the model over that of its hull; NaN for models that are not closed, and where the
  /// proxy is an own one or that of a part.
  double convexityRatio = 0.0;
  int turnedOver = 0;                       ///< triangles, see CountTurnedOver
  int withoutHit = 0;                       ///< points whose direction meets no proxy
  int firstWithoutHit = -1;                 ///< the first of them
  Eigen::Vector3i caseCounts = { 0, 0, 0 }; ///< points per ProjectionCase
  double projectionError = 0.0;             ///< largest |p q| - |p q_closest|, length
  /// The stages that had to be done; the others were kept.
  struct
  {
    bool proxy = false;
    bool round = false;
    bool project = false;
  } done;
  /// Wall time of the stages, seconds; 0 for what was kept.
  struct
  {
    double proxy = 0.0;
    double round = 0.0;
    double project = 0.0;
    double transfer = 0.0;
  } seconds;
};

/// Kept between calls: proxy, rounding and feet are stages of its State, and each is done again
/// only where its key is another one. The transfer is always done.
class ProxyDeformation
{
public:
  ProxyDeformation();
  ~ProxyDeformation();

  /// Deforms the model. @param model  finite points; triangles may be missing
  /// @param carryOn  gets the share that is done, 0..1; false ends the work
  /// @throw std::invalid_argument: see MakeConvexProxy, StyleSolver @throw SolverError
  ProxyDeformationReport Deform(const std::shared_ptr<const TriangleMesh>& model,
    const ProxyDeformationOptions& options, const std::function<bool(double)>& carryOn = {});
  /// The same with a copy of the model.
  ProxyDeformationReport Deform(const TriangleMesh& model, const ProxyDeformationOptions& options,
    const std::function<bool(double)>& carryOn = {});

  const Points& GetPositions() const;    ///< p', n x 3
  const DeformedProxy& GetProxy() const; ///< at rest and rounded
  const Feet& GetFeet() const;           ///< of every point of the model

private:
  class State;
  std::unique_ptr<State> S;
};
} // namespace SphericalStyle

#endif
