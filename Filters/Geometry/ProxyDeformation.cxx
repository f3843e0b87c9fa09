// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ProxyDeformation.h"

#include "ConvexHull.h"
#include "DeformationMeasures.h"
#include "Stopwatch.h"
#include "SurfaceMeasures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace SphericalStyle
{
namespace
{
bool Same(const Points& a, const Points& b)
{
  return a.rows() == b.rows() && a == b;
}

bool Same(const TriangleMesh& a, const TriangleMesh& b)
{
  return Same(a.P, b.P) && a.F.rows() == b.F.rows() && a.F == b.F;
}

/// What the convex proxy depends on, apart from the points.
bool Same(const ConvexProxyOptions& a, const ConvexProxyOptions& b)
{
  const bool sampled =
    a.mesher == ProxyMesher::BallPivoting || a.mesher == ProxyMesher::AdvancingFront;
  return a.mesher == b.mesher && a.numberOfPoints == b.numberOfPoints &&
    (!sampled || a.seed == b.seed);
}

/// What the filters let users choose about the rounding.
bool Same(const StyleOptions& a, const StyleOptions& b)
{
  return a.lambda == b.lambda && a.centerMode == b.centerMode && a.radiusMode == b.radiusMode &&
    a.sphericalWeighting == b.sphericalWeighting && a.custom.center == b.custom.center &&
    a.custom.radius == b.custom.radius;
}

/// Every edge is passed as often one way as the other: the surface encloses a volume.
bool IsClosed(const Triangles& F)
{
  std::vector<std::pair<int, int>> up;
  std::vector<std::pair<int, int>> down;
  for (const auto& t : F.rowwise())
  {
    for (int k = 0; k < 3; ++k)
    {
      const int u = t[HalfEdgeStart(k)];
      const int v = t[HalfEdgeEnd(k)];
      (u < v ? up : down).emplace_back(std::minmax(u, v));
    }
  }
  std::sort(up.begin(), up.end());
  std::sort(down.begin(), down.end());
  return up == down;
}

double ConvexityRatio(const TriangleMesh& model, double hullVolume)
{
  return hullVolume > 0.0 && model.F.rows() > 0 && IsClosed(model.F)
    ? std::abs(EnclosedVolume(model.P, model.F)) / hullVolume
    : std::numeric_limits<double>::quiet_NaN();
}

/// A flat proxy becomes the disc of its area: the sphere of that area would halve it.
void TakeDiscRadius(const TriangleMesh& proxy, StyleOptions& style)
{
  if (style.radiusMode != RadiusMode::Custom)
  {
    style.radiusMode = RadiusMode::Custom;
    style.custom.radius = std::sqrt(TriangleAreas(proxy.P, proxy.F).sum() / Pi);
  }
}

/// Largest |p q| - |p c|, q the feet, c the closest points.
double LargestSurplus(
  const Points& P, const TriangleMesh& proxy, const Feet& feet, const Feet& closest)
{
  const Points q = Interpolate(proxy.F, feet, proxy.P);
  const Points c = Interpolate(proxy.F, closest, proxy.P);
  return P.rows() > 0
    ? ((P - q).rowwise().norm() - (P - c).rowwise().norm()).cwiseMax(0.0).maxCoeff()
    : 0.0;
}
} // namespace

//------------------------------------------------------------------------------------------------
class ProxyDeformation::State
{
public:
  void MakeProxy(const TriangleMesh& model, const ProxyDeformationOptions& options);
  void Round(const ProxyDeformationOptions& options, const Callback& callback);
  void Project(const TriangleMesh& model, const ProxyDeformationOptions& options);
  void Move(const TriangleMesh& model, const ProxyDeformationOptions& options);
  void MeasureConvexity(const Triangles& F);

  // What each stage was last done for.
  Points ModelPoints;
  Triangles ModelTriangles; // of the convexity alone
  ProxyDeformationOptions Last;

  ConvexProxy Proxy;
  bool OfPart = false; // whether it is the hull of some of the points
  StyleSolver Solver;
  StyleReport Rounding;
  DeformedProxy Deformed;
  std::unique_ptr<SurfaceProjection> Searches;
  Feet FeetOfPoints;
  double Surplus = 0.0;
  double Convexity = 0.0;
  Points Q;

  // A stage whose flag is down is done again; each takes the later ones down with it.
  bool HasProxy = false;
  bool HasRounding = false;
  bool HasFeet = false;
  bool HasConvexity = false;

  ProxyDeformationReport Report;
};

void ProxyDeformation::State::MakeProxy(
  const TriangleMesh& model, const ProxyDeformationOptions& options)
{
  const bool own = options.ownProxy.F.rows() > 0;
  const bool sameModel = Same(model.P, this->ModelPoints);
  this->HasFeet = this->HasFeet && sameModel;
  this->HasConvexity = this->HasConvexity && sameModel;
  this->HasProxy = this->HasProxy && (own || sameModel);
  this->ModelPoints = model.P;
  if (this->HasProxy && Same(options.ownProxy, this->Last.ownProxy) &&
    (own ||
      (Same(options.convexProxy, this->Last.convexProxy) &&
        options.hullPoints == this->Last.hullPoints)))
  {
    return;
  }
  this->HasProxy = this->HasRounding = this->HasFeet = this->HasConvexity = false;
  const Stopwatch watch;
  this->OfPart = !own && HullDimension(model.P(options.hullPoints, Eigen::all)) == 3;
  const Points P = this->OfPart ? Points(model.P(options.hullPoints, Eigen::all)) : model.P;
  this->Proxy = own ? ConvexProxy() : MakeConvexProxy(P, options.convexProxy);
  this->Deformed.rest = own ? options.ownProxy : this->Proxy.mesh;
  this->Solver.SetMesh(this->Deformed.rest);
  this->Searches = std::make_unique<SurfaceProjection>(this->Deformed.rest);
  this->Last.ownProxy = options.ownProxy;
  this->Last.convexProxy = options.convexProxy;
  this->Last.hullPoints = options.hullPoints;
  this->HasProxy = true;
  this->Report.done.proxy = true;
  this->Report.seconds.proxy = watch.Seconds();
}

void ProxyDeformation::State::Round(
  const ProxyDeformationOptions& options, const Callback& callback)
{
  if (this->HasRounding && Same(options.style, this->Last.style))
  {
    return;
  }
  this->HasRounding = false;
  const Stopwatch watch;
  StyleOptions style = options.style;
  style.threads = options.threads;
  if (this->Proxy.flat)
  {
    TakeDiscRadius(this->Deformed.rest, style);
  }
  try
  {
    this->Rounding = this->Solver.Solve(style, callback);
  }
  catch (const SolverError& error)
  {
    throw SolverError(std::string("the proxy cannot be rounded: ") + error.what() +
      "; with SphericalWeighting Cotangent there is nothing to solve");
  }
  this->Deformed.rounded = this->Solver.GetPositions();
  this->Deformed.rotations =
    SurfaceRotations(this->Deformed.rest, this->Deformed.rounded, options.threads);
  this->Last.style = options.style;
  this->HasRounding = !this->Rounding.loop.aborted;
  this->Report.done.round = true;
  this->Report.seconds.round = watch.Seconds();
}

void ProxyDeformation::State::Project(
  const TriangleMesh& model, const ProxyDeformationOptions& options)
{
  Points normals;
  if (options.projection == Projection::SmallestAngle)
  {
    normals = options.normals.rows() > 0 ? options.normals : PointNormals(model.P, model.F);
  }
  if (this->HasFeet && options.projection == this->Last.projection &&
    options.neighbors == this->Last.neighbors && Same(normals, this->Last.normals) &&
    Same(options.directions, this->Last.directions))
  {
    return;
  }
  this->HasFeet = false;
  const Stopwatch watch;
  const Points& P = model.P;
  const int threads = options.threads;
  this->Surplus = 0.0;
  switch (options.projection)
  {
    case Projection::ClosestPoint:
      this->FeetOfPoints = this->Searches->ClosestPoint(P, threads);
      break;
    case Projection::NearestVertices:
      this->FeetOfPoints = this->Searches->NearestVertices(P, options.neighbors, threads);
      this->Surplus = LargestSurplus(
        P, this->Deformed.rest, this->FeetOfPoints, this->Searches->ClosestPoint(P, threads));
      break;
    case Projection::SmallestAngle:
      this->FeetOfPoints = this->Searches->SmallestAngle(P, normals, threads);
      break;
    case Projection::DirectionArray:
      this->FeetOfPoints = this->Searches->AlongDirections(P, options.directions, threads);
      break;
  }
  this->Last.projection = options.projection;
  this->Last.neighbors = options.neighbors;
  this->Last.normals = std::move(normals);
  this->Last.directions = options.directions;
  this->HasFeet = true;
  this->Report.done.project = true;
  this->Report.seconds.project = watch.Seconds();
}

void ProxyDeformation::State::Move(
  const TriangleMesh& model, const ProxyDeformationOptions& options)
{
  const Stopwatch watch;
  const Matrices rotations = RotationsAtFeet(this->Deformed, this->FeetOfPoints, options.threads);
  this->Q = TransferFromProxy(model.P, this->Deformed, this->FeetOfPoints, rotations, options.t,
    { options.transfer, options.gain, this->Rounding.sphere.center });
  this->Report.turnedOver = CountTurnedOver(model.P, this->Q, model.F, rotations);
  this->Report.seconds.transfer = watch.Seconds();
}

void ProxyDeformation::State::MeasureConvexity(const Triangles& F)
{
  if (this->HasConvexity && F.rows() == this->ModelTriangles.rows() && F == this->ModelTriangles)
  {
    return;
  }
  this->Convexity =
    ConvexityRatio({ this->ModelPoints, F }, this->OfPart ? 0.0 : this->Proxy.hullVolume);
  this->ModelTriangles = F;
  this->HasConvexity = true;
}

//------------------------------------------------------------------------------------------------
ProxyDeformation::ProxyDeformation()
  : S(std::make_unique<State>())
{
}

ProxyDeformation::~ProxyDeformation() = default;

ProxyDeformationReport ProxyDeformation::Deform(const TriangleMesh& model,
  const ProxyDeformationOptions& options, const std::function<bool(double)>& carryOn)
{
  State& s = *this->S;
  ProxyDeformationReport& report = s.Report = {};
  const auto goOn = [&](double share)
  {
    report.aborted = report.aborted || (carryOn && !carryOn(share));
    return !report.aborted;
  };
  const auto roundOn = [&](int iteration, double) { return goOn(0.5 - 0.2 / (1.0 + iteration)); };

  if (goOn(0.0))
  {
    s.MakeProxy(model, options);
  }
  if (goOn(0.3))
  {
    s.Round(options, roundOn);
  }
  if (goOn(0.5))
  {
    s.Project(model, options);
  }
  if (goOn(0.9))
  {
    s.Move(model, options);
  }
  if (report.aborted)
  {
    return report;
  }

  report.style = s.Rounding;
  report.flat = s.Proxy.flat;
  report.fallback = s.Proxy.fallback;
  s.MeasureConvexity(model.F);
  report.convexityRatio = s.Convexity;
  report.projectionError = s.Surplus;
  for (const int number : s.FeetOfPoints.projectionCase)
  {
    ++report.caseCounts[number - 1];
  }
  if (options.projection == Projection::DirectionArray)
  {
    for (Eigen::Index i = 0; i < model.P.rows(); ++i)
    {
      const bool asked = !options.directions.row(i).isZero(0.0);
      if (asked && s.FeetOfPoints.byClosestPoint[i] != 0)
      {
        report.firstWithoutHit =
          report.withoutHit++ == 0 ? static_cast<int>(i) : report.firstWithoutHit;
      }
    }
  }
  return report;
}

const Points& ProxyDeformation::GetPositions() const
{
  return this->S->Q;
}

const DeformedProxy& ProxyDeformation::GetProxy() const
{
  return this->S->Deformed;
}

const Feet& ProxyDeformation::GetFeet() const
{
  return this->S->FeetOfPoints;
}
} // namespace SphericalStyle
