// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "SphericalStyleMethod.h"

#include "Stopwatch.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace SphericalStyle
{
MethodOptions ThesisOptions(MethodOptions options)
{
  static_cast<StyleOptions&>(options) = ThesisOptions(static_cast<const StyleOptions&>(options));
  options.detailSize = 0.0;
  options.normalRadius = NormalRadius::WholeModel;
  options.size = {};
  return options;
}

void CheckOptions(const MethodOptions& o, int n)
{
  CheckOptions(static_cast<const StyleOptions&>(o), n);
  if (!(o.detailSize >= 0.0 && std::isfinite(o.detailSize)))
  {
    throw std::invalid_argument("the detail size must be 0 or more");
  }
}

bool IsClosedForm(const StyleOptions& o)
{
  return !o.localTerm && o.sphericalWeighting == SphericalWeighting::Cotangent &&
    o.edgeWeighting != EdgeWeighting::FullEdge && o.concaveEdges == ConcaveEdges::Keep &&
    o.initialGuess != InitialGuess::Rest && o.loop.stopRule != StopRule::FixedIterations;
}

namespace
{
void CheckMesh(const TriangleMesh& mesh, const SurfacePart& part, const TriangleMesh* rest,
  const std::optional<MirrorPlane>& plane)
{
  if (part.Max(mesh.F.rows() > 0 ? 1.0 : 0.0) == 0.0)
  {
    throw std::invalid_argument("the mesh has no triangle");
  }
  if (rest && !HaveSameTriangles(*rest, mesh))
  {
    throw std::invalid_argument("the rest pose has other triangles than the mesh");
  }
  if (plane && (rest || !part.IsWhole()))
  {
    throw std::invalid_argument("a plane of symmetry needs a whole surface without a rest pose");
  }
}
}

void SphericalStyleMethod::SetMesh(const TriangleMesh& mesh)
{
  this->SetMesh(std::make_shared<const TriangleMesh>(mesh));
}

void SphericalStyleMethod::SetMesh(std::shared_ptr<const TriangleMesh> mesh, SurfacePart part,
  std::shared_ptr<const TriangleMesh> rest, const std::optional<MirrorPlane>& plane)
{
  CheckMesh(*mesh, part, rest.get(), plane);
  const TriangleMesh* kept = this->Rest ? this->Rest.get() : this->Mesh.get();
  const bool equal = kept && !this->Rest == !rest && this->Part.IsWhole() == part.IsWhole() &&
    *kept == (rest ? *rest : *mesh) && this->Mirrored.has_value() == plane.has_value() &&
    (!plane || this->Mirrored->GetPlane() == *plane);
  const bool known = part.Max(equal ? 0.0 : 1.0) == 0.0;
  const bool moved = !known || (rest && !(*this->Mesh == *mesh));
  if (moved)
  {
    if (!mesh->P.allFinite() || (rest && !rest->P.allFinite()))
    {
      throw std::invalid_argument("a point is not finite");
    }
    ++this->MeshGeneration;
    this->Mesh.reset(); // should a line below throw, the next mesh is another one
    this->Rest.reset();
  }
  this->Part = std::move(part);
  this->TakeAtRest(rest ? *rest : *mesh, plane, known);
  if (rest)
  {
    if (moved)
    {
      this->X = this->MeshFrame.Into(mesh->P);
    }
    this->Closed.SetPose(this->X, moved);
  }
  this->Mesh = std::move(mesh); // one of those that are equal may be the only one left
  this->Rest = std::move(rest);
}

/// @param known  whether they are equal to the last ones
void SphericalStyleMethod::TakeAtRest(
  const TriangleMesh& still, const std::optional<MirrorPlane>& plane, bool known)
{
  if (!known)
  {
    this->Mirrored.reset();
    this->MeshFrame = FrameOf(still.P, this->Part);
    if (plane)
    {
      this->Mirrored.emplace(still, this->MeshFrame, *plane);
      this->MeshFrame = this->Mirrored->GetFrame();
    }
    this->P = this->MeshFrame.Into(still.P);
  }
  const Points& points = this->Mirrored ? this->Mirrored->GetPoints() : this->P;
  const Triangles& triangles = this->Mirrored ? this->Mirrored->GetTriangles() : still.F;
  if (known)
  {
    this->Closed.SetEqualMesh(points, triangles, this->Part);
  }
  else
  {
    this->Closed.SetMesh(points, triangles, this->Part);
  }
}

ClosedFormOptions SphericalStyleMethod::InFrame(const MethodOptions& o) const
{
  ClosedFormOptions framed;
  static_cast<TargetOptions&>(framed) = o.Into(this->MeshFrame);
  static_cast<DetailOptions&>(framed) = o;
  framed.keepLastPoint = o.anchor == Anchor::LastPoint;
  return this->Mirrored ? this->Mirrored->Into(std::move(framed)) : framed;
}

/// Exactly where they are to be.
void SphericalStyleMethod::HoldFixedPoints(const MethodOptions& o)
{
  if (!o.fixedPoints.empty())
  {
    this->Positions(o.fixedPoints, AllColumns) = o.fixedPositions;
  }
}

/// Results of the closed form into model units.
/// @return directions
Points SphericalStyleMethod::Take(
  const MethodOptions& o, const ClosedFormReport& closed, StyleReport& report)
{
  const Frame& frame = this->MeshFrame;
  ClosedFormResult result = this->Closed.TakeResult();
  if (this->Mirrored)
  {
    result = this->Mirrored->OutOf(std::move(result));
  }
  this->Positions = frame.OutOf(std::move(result.positions));
  this->R = std::move(result.rotations);
  this->HoldFixedPoints(o);
  report.gridFunctions = closed.functions;
  report.gridSpacing = closed.spacing;
  report.coarserGrid = closed.coarser;
  report.walls = closed.walls;
  report.sizeFactor = closed.scale;
  report.seconds.base += closed.baseSeconds;
  report.seconds.iterate += closed.carrySeconds;
  return std::move(result.directions);
}

void SphericalStyleMethod::ReportClosedForm(
  const ClosedFormReport& closed, StyleReport& report) const
{
  const Frame& frame = this->MeshFrame;
  report.closedForm = true;
  report.loop.converged = true;
  std::copy_if(closed.pointsOnCenter.begin(), closed.pointsOnCenter.end(),
    std::back_inserter(report.pointsOnCenter), [&](int i) { return i < this->P.rows(); });
  report.spheres = closed.spheres;
  report.shape = closed.shape;
  if (this->Mirrored)
  {
    report.shape.Turn(this->Mirrored->GetTurn().transpose());
  }
  for (Sphere& sphere : report.spheres)
  {
    if (this->Mirrored)
    {
      sphere = this->Mirrored->OutOf(sphere);
    }
    sphere.center = frame.scale * sphere.center + frame.origin.transpose();
    sphere.radius *= frame.scale;
  }
  report.sphere = report.spheres.front();
}

void SphericalStyleMethod::SolveClosedForm(
  const MethodOptions& o, const Callback& callback, StyleReport& report)
{
  const ClosedFormReport closed = this->Closed.Solve(this->InFrame(o), callback);
  this->T = this->Take(o, closed, report);
  this->ReportClosedForm(closed, report);
  const Eigen::VectorXd factors = o.Factors();
  const double most = factors.size() > 0 ? factors.maxCoeff() : this->P.rows() > 0 ? 1.0 : 0.0;
  if (o.lambda * this->Part.Max(most) == 0.0) // to the bit
  {
    this->Positions = this->Mesh->P;
    this->HoldFixedPoints(o);
  }
}

void SphericalStyleMethod::StayAtRest(const MethodOptions& o)
{
  this->Positions = this->Mesh->P;
  this->HoldFixedPoints(o);
  this->T = Points::Zero(this->P.rows(), 3);
  this->R.assign(o.keepRotations ? this->P.rows() : 0, Eigen::Matrix3d::Identity());
  this->CellEnergies.resize(0);
}

/// The energy knows no details: B' is the base of what it leads to.
void SphericalStyleMethod::SolveEnergy(
  const MethodOptions& o, const Callback& callback, StyleReport& report)
{
  if (this->Rest)
  {
    throw std::invalid_argument(
      "a rest pose needs the closed form: no energy is minimized with it");
  }
  if (this->Mirrored)
  {
    throw std::invalid_argument("Symmetry needs the closed form: no energy is minimized with it");
  }
  ClosedFormOptions inFrame = this->InFrame(o);
  StyleOptions rigid = o;
  const Stopwatch watch;
  if (o.normalRadius == NormalRadius::OwnThickness)
  {
    rigid.normals = this->Closed.ThickNormals(inFrame, callback);
  }
  const double baseSeconds = watch.Seconds();
  this->Energy.SetMesh(this->Mesh);
  report = this->Energy.Solve(rigid, callback);
  report.seconds.base += baseSeconds;
  StyleResult result = this->Energy.TakeResult();
  this->T = std::move(result.directions);
  this->CellEnergies = std::move(result.cellEnergies);
  this->Positions = std::move(result.positions);
  this->R = std::move(result.rotations);
  if (o.detailSize > 0.0 || o.size.keep != KeepSize::Off || o.size.keepOnGround)
  {
    const ClosedFormReport closed =
      this->Closed.Carry(this->MeshFrame.Into(this->Positions), inFrame, callback);
    Matrices turns = std::move(this->R);
    this->Take(o, closed, report);
    if (o.detailSize == 0.0)
    {
      this->R = std::move(turns); // its cells have not turned since
    }
  }
}

void SphericalStyleMethod::ForgetResult()
{
  this->Positions.resize(0, 3);
  this->T.resize(0, 3);
  this->R = {};
  this->CellEnergies.resize(0);
}

StyleReport SphericalStyleMethod::Preview(const std::shared_ptr<const PreviewPlaces>& places,
  const MethodOptions& options, const Callback& callback)
{
  if (!this->Mesh)
  {
    throw std::invalid_argument("there is no mesh: SetMesh was not called or has thrown");
  }
  if (this->Mirrored)
  {
    throw std::invalid_argument("with a plane of symmetry there is no preview");
  }
  CheckOptions(options, static_cast<int>(this->P.rows()));
  StyleReport report;
  this->CellEnergies.resize(0);
  bool moves = options.lambda > 0.0; // else to the bit
  try
  {
    const ClosedFormReport closed = this->Closed.Preview(places, this->InFrame(options), callback);
    this->T = this->Take(options, closed, report);
    this->ReportClosedForm(closed, report);
  }
  catch (const SolveAborted&)
  {
    const auto n = static_cast<Eigen::Index>(places->points.size());
    this->T = Points::Zero(n, 3);
    this->R.assign(options.keepRotations ? n : 0, Eigen::Matrix3d::Identity());
    report.loop.aborted = true;
    moves = false;
  }
  if (!moves)
  {
    this->Positions = this->Mesh->P(places->points, AllColumns);
  }
  if (!this->Positions.allFinite())
  {
    throw SolverError("the result is not finite");
  }
  return report;
}

StyleReport SphericalStyleMethod::Solve(const MethodOptions& options, const Callback& callback)
{
  if (!this->Mesh)
  {
    throw std::invalid_argument("there is no mesh: SetMesh was not called or has thrown");
  }
  CheckOptions(options, static_cast<int>(this->P.rows()));
  StyleReport report;
  this->CellEnergies.resize(0);
  try
  {
    if (IsClosedForm(options))
    {
      this->SolveClosedForm(options, callback, report);
    }
    else
    {
      this->SolveEnergy(options, callback, report);
    }
  }
  catch (const SolveAborted&)
  {
    this->StayAtRest(options);
    report.loop.aborted = true;
  }
  if (!this->Positions.allFinite())
  {
    throw SolverError("the result is not finite");
  }
  return report;
}
} // namespace SphericalStyle
