// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "ProxyDeformation.h"

#include "ConvexHull.h"
#include "DeformationMeasures.h"
#include "Stage.h"
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

bool Same(const Triangles& a, const Triangles& b)
{
  return a.rows() == b.rows() && a == b;
}

bool Same(const TriangleMesh& a, const TriangleMesh& b)
{
  return Same(a.P, b.P) && Same(a.F, b.F);
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

/// The points of the model.
struct ModelKey
{
  std::shared_ptr<const TriangleMesh> mesh;

  bool operator==(const ModelKey& other) const
  {
    return this->mesh == other.mesh || Same(this->mesh->P, other.mesh->P);
  }
};

/// The model's points, which the key has: a value of their own would be a copy of them.
struct Nothing
{
};

struct ProxyKey
{
  int model; // version; an own proxy depends on no model
  TriangleMesh own;
  ConvexProxyOptions convex;
  std::vector<int> hullPoints;

  bool operator==(const ProxyKey& other) const
  {
    return this->model == other.model && Same(this->own, other.own) &&
      Same(this->convex, other.convex) && this->hullPoints == other.hullPoints;
  }
};

struct RoundingKey
{
  int proxy; // version
  StyleOptions style;

  bool operator==(const RoundingKey& other) const
  {
    return this->proxy == other.proxy && Same(this->style, other.style);
  }
};

struct FeetKey
{
  int model; // version
  int proxy; // version
  Projection projection;
  int neighbors;
  Points normals;
  Points directions;

  bool operator==(const FeetKey& other) const
  {
    return this->model == other.model && this->proxy == other.proxy &&
      this->projection == other.projection && this->neighbors == other.neighbors &&
      Same(this->normals, other.normals) && Same(this->directions, other.directions);
  }
};

struct ConvexityKey
{
  int model;                                // version
  int proxy;                                // version
  std::shared_ptr<const TriangleMesh> mesh; // its triangles

  bool operator==(const ConvexityKey& other) const
  {
    return this->model == other.model && this->proxy == other.proxy &&
      (this->mesh == other.mesh || Same(this->mesh->F, other.mesh->F));
  }
};

struct RestProxy
{
  ConvexProxy Hull;    // empty with an own proxy
  bool OfPart = false; // whether it is the hull of some of the points
  std::unique_ptr<SurfaceProjection> Searches;
};

struct ProjectedFeet
{
  Feet OfPoints;
  double Surplus = 0.0;
};

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
  void UpdateProxy(
    const std::shared_ptr<const TriangleMesh>& model, const ProxyDeformationOptions& options);
  void MakeProxy(
    const TriangleMesh& model, const ProxyDeformationOptions& options, RestProxy& proxy);
  void UpdateRounding(const ProxyDeformationOptions& options, const Callback& callback);
  StyleReport Round(const ProxyDeformationOptions& options, const Callback& callback);
  void UpdateFeet(const TriangleMesh& model, const ProxyDeformationOptions& options);
  ProjectedFeet Project(
    const Points& P, const Points& normals, const ProxyDeformationOptions& options) const;
  void Move(const TriangleMesh& model, const ProxyDeformationOptions& options);
  void UpdateConvexity(const std::shared_ptr<const TriangleMesh>& model);

  Stage<ModelKey, Nothing> Model;
  Stage<ProxyKey, RestProxy> Proxy;
  Stage<RoundingKey, StyleReport> Rounding;
  Stage<FeetKey, ProjectedFeet> Projected;
  Stage<ConvexityKey, double> Convexity;

  StyleSolver Solver;     // of the proxy
  DeformedProxy Deformed; // at rest that of the stage, and what rounding made of it
  Points Q;
  ProxyDeformationReport Report;
};

void ProxyDeformation::State::UpdateProxy(
  const std::shared_ptr<const TriangleMesh>& model, const ProxyDeformationOptions& options)
{
  this->Model.Update({ model }, [](Nothing&) {});
  ProxyKey key = {};
  if (options.ownProxy.F.rows() > 0)
  {
    key.own = options.ownProxy;
  }
  else
  {
    key.model = this->Model.GetVersion();
    key.convex = options.convexProxy;
    key.hullPoints = options.hullPoints;
  }
  const Stopwatch watch;
  const auto make = [&](RestProxy& proxy) { this->MakeProxy(*model, options, proxy); };
  if (this->Proxy.Update(std::move(key), make))
  {
    this->Report.done.proxy = true;
    this->Report.seconds.proxy = watch.Seconds();
  }
}

void ProxyDeformation::State::MakeProxy(
  const TriangleMesh& model, const ProxyDeformationOptions& options, RestProxy& proxy)
{
  const bool own = options.ownProxy.F.rows() > 0;
  proxy.OfPart = !own && HullDimension(model.P(options.hullPoints, AllColumns)) == 3;
  const Points P = proxy.OfPart ? Points(model.P(options.hullPoints, AllColumns)) : model.P;
  proxy.Hull = own ? ConvexProxy() : MakeConvexProxy(P, options.convexProxy);
  this->Deformed.rest = own ? options.ownProxy : proxy.Hull.mesh;
  this->Solver.SetMesh(this->Deformed.rest);
  proxy.Searches = std::make_unique<SurfaceProjection>(this->Deformed.rest);
}

void ProxyDeformation::State::UpdateRounding(
  const ProxyDeformationOptions& options, const Callback& callback)
{
  const Stopwatch watch;
  const auto make = [&](StyleReport& report) { report = this->Round(options, callback); };
  if (this->Rounding.Update({ this->Proxy.GetVersion(), options.style }, make))
  {
    this->Report.done.round = true;
    this->Report.seconds.round = watch.Seconds();
  }
  if (this->Rounding->loop.aborted)
  {
    this->Rounding.Forget();
  }
}

StyleReport ProxyDeformation::State::Round(
  const ProxyDeformationOptions& options, const Callback& callback)
{
  StyleOptions style = options.style;
  style.threads = options.threads;
  if (this->Proxy->Hull.flat)
  {
    TakeDiscRadius(this->Deformed.rest, style);
  }
  StyleReport report;
  try
  {
    report = this->Solver.Solve(style, callback);
  }
  catch (const SolverError& error)
  {
    throw SolverError(std::string("the proxy cannot be rounded: ") + error.what() +
      "; with SphericalWeighting Cotangent there is nothing to solve");
  }
  this->Deformed.rounded = this->Solver.GetPositions();
  this->Deformed.rotations =
    SurfaceRotations(this->Deformed.rest, this->Deformed.rounded, options.threads);
  return report;
}

void ProxyDeformation::State::UpdateFeet(
  const TriangleMesh& model, const ProxyDeformationOptions& options)
{
  FeetKey key = { this->Model.GetVersion(), this->Proxy.GetVersion(), options.projection,
    options.neighbors, Points(0, 3), options.directions };
  if (options.projection == Projection::SmallestAngle)
  {
    key.normals = options.normals.rows() > 0 ? options.normals : PointNormals(model.P, model.F);
  }
  const Points normals = key.normals;
  const Stopwatch watch;
  const auto make = [&](ProjectedFeet& feet) { feet = this->Project(model.P, normals, options); };
  if (this->Projected.Update(std::move(key), make))
  {
    this->Report.done.project = true;
    this->Report.seconds.project = watch.Seconds();
  }
}

ProjectedFeet ProxyDeformation::State::Project(
  const Points& P, const Points& normals, const ProxyDeformationOptions& options) const
{
  const SurfaceProjection& searches = *this->Proxy->Searches;
  const int threads = options.threads;
  ProjectedFeet feet;
  switch (options.projection)
  {
    case Projection::ClosestPoint:
      feet.OfPoints = searches.ClosestPoint(P, threads);
      break;
    case Projection::NearestVertices:
      feet.OfPoints = searches.NearestVertices(P, options.neighbors, threads);
      feet.Surplus =
        LargestSurplus(P, this->Deformed.rest, feet.OfPoints, searches.ClosestPoint(P, threads));
      break;
    case Projection::SmallestAngle:
      feet.OfPoints = searches.SmallestAngle(P, normals, threads);
      break;
    case Projection::DirectionArray:
      feet.OfPoints = searches.AlongDirections(P, options.directions, threads);
      break;
  }
  return feet;
}

void ProxyDeformation::State::Move(
  const TriangleMesh& model, const ProxyDeformationOptions& options)
{
  const Stopwatch watch;
  const Matrices rotations =
    RotationsAtFeet(this->Deformed, this->Projected->OfPoints, options.threads);
  this->Q = TransferFromProxy(model.P, this->Deformed, this->Projected->OfPoints, rotations,
    options.t, { options.transfer, options.gain, this->Rounding->sphere.center });
  this->Report.turnedOver = CountTurnedOver(model.P, this->Q, model.F, rotations);
  this->Report.seconds.transfer = watch.Seconds();
}

void ProxyDeformation::State::UpdateConvexity(const std::shared_ptr<const TriangleMesh>& model)
{
  const RestProxy& proxy = this->Proxy.Get();
  this->Convexity.Update({ this->Model.GetVersion(), this->Proxy.GetVersion(), model },
    [&](double& ratio)
    { ratio = ConvexityRatio(*model, proxy.OfPart ? 0.0 : proxy.Hull.hullVolume); });
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
  return this->Deform(std::make_shared<const TriangleMesh>(model), options, carryOn);
}

ProxyDeformationReport ProxyDeformation::Deform(const std::shared_ptr<const TriangleMesh>& model,
  const ProxyDeformationOptions& options, const std::function<bool(double)>& carryOn)
{
  State& s = *this->S;
  ProxyDeformationReport& report = s.Report;
  report = ProxyDeformationReport();
  const auto goOn = [&](double share)
  {
    report.aborted = report.aborted || (carryOn && !carryOn(share));
    return !report.aborted;
  };
  const auto roundOn = [&](int iteration, double) { return goOn(0.5 - 0.2 / (1.0 + iteration)); };

  if (goOn(0.0))
  {
    s.UpdateProxy(model, options);
  }
  if (goOn(0.3))
  {
    s.UpdateRounding(options, roundOn);
  }
  if (goOn(0.5))
  {
    s.UpdateFeet(*model, options);
  }
  if (goOn(0.9))
  {
    s.Move(*model, options);
  }
  if (report.aborted)
  {
    return report;
  }

  report.style = s.Rounding.Get();
  report.flat = s.Proxy->Hull.flat;
  report.fallback = s.Proxy->Hull.fallback;
  s.UpdateConvexity(model);
  report.convexityRatio = s.Convexity.Get();
  report.projectionError = s.Projected->Surplus;
  for (const int number : s.Projected->OfPoints.projectionCase)
  {
    ++report.caseCounts[number - 1];
  }
  if (options.projection == Projection::DirectionArray)
  {
    for (Eigen::Index i = 0; i < model->P.rows(); ++i)
    {
      const bool asked = !options.directions.row(i).isZero(0.0);
      if (asked && s.Projected->OfPoints.byClosestPoint[i] != 0)
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
  return this->S->Projected->OfPoints;
}
} // namespace SphericalStyle
