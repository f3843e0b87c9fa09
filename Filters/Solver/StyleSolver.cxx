// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "StyleSolver.h"

#include "BaseSurface.h"
#include "LocalStep.h"
#include "Stopwatch.h"
#include "SurfaceMeasures.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace SphericalStyle
{
StyleOptions ThesisOptions(StyleOptions options)
{
  options.edgeWeighting = EdgeWeighting::FullEdge;
  options.sphericalWeighting = SphericalWeighting::Uniform;
  options.loop.stopRule = StopRule::Thesis;
  options.loop.acceleration = false;
  options.initialGuess = InitialGuess::Rest;
  options.anchor = Anchor::LastPoint;
  options.centerMode = CenterMode::PointMean;
  options.detailSize = 0.0;
  return options;
}

namespace
{
void Require(bool condition, const char* message)
{
  if (!condition)
  {
    throw std::invalid_argument(message);
  }
}

void CheckOptions(const StyleOptions& o, int n)
{
  Require(std::isfinite(o.lambda) && o.lambda >= 0.0, "lambda must be finite and not negative");
  Require(o.normalBlend >= 0.0 && o.normalBlend <= 1.0, "the normal blend a must lie in 0..1");
  Require(o.detailSize >= 0.0 && std::isfinite(o.detailSize), "the detail size must be 0 or more");
  Require(o.loop.tolerance > 0.0, "the tolerance must be above zero");
  const auto sized = [n](Eigen::Index rows) { return rows == 0 || rows == n; };
  Require(sized(o.roundnessFactors.size()), "one roundness factor per point is needed");
  Require(sized(o.normalBlends.size()), "one normal blend per point is needed");
  Require(sized(o.normals.rows()), "one normal per point is needed");
  Require(sized(o.targets.rows()), "one target direction per point is needed");
  Require(o.roundnessFactors.size() == 0 ||
      (o.roundnessFactors.allFinite() && o.roundnessFactors.minCoeff() >= 0.0),
    "roundness factors must be finite and not negative");
  Require(o.normalBlends.size() == 0 ||
      (o.normalBlends.minCoeff() >= 0.0 && o.normalBlends.maxCoeff() <= 1.0),
    "normal blends must lie in 0..1");
  Require(o.normals.allFinite() && o.targets.allFinite(), "directions must be finite");
  Require(static_cast<Eigen::Index>(o.fixedPoints.size()) == o.fixedPositions.rows(),
    "one position per fixed point is needed");
  for (const int i : o.fixedPoints)
  {
    Require(i >= 0 && i < n, "a fixed point lies outside the mesh");
  }
}

/// The mesh is solved around the origin at diagonal 1, so that nothing depends on place and scale.
struct Frame
{
  Eigen::RowVector3d origin = Eigen::RowVector3d::Zero();
  double scale = 1.0;

  Points Into(const Points& x) const { return (x.rowwise() - this->origin) / this->scale; }
  Points OutOf(const Points& x) const { return (this->scale * x).rowwise() + this->origin; }
};

Frame FrameOf(const Points& P)
{
  const Eigen::RowVector3d low = P.colwise().minCoeff();
  const Eigen::RowVector3d high = P.colwise().maxCoeff();
  Frame frame;
  frame.origin = 0.5 * low + 0.5 * high;
  frame.scale = (0.5 * high - 0.5 * low).stableNorm() * 2.0;
  if (!(frame.scale > 0.0) || !std::isfinite(frame.scale))
  {
    throw std::invalid_argument("the points are all equal or too far apart");
  }
  return frame;
}

/// Lets LocalGlobal run the two steps of StyleEnergy.
class LinearFeature : public TwoStepEnergy
{
public:
  LinearFeature(StyleEnergy& energy, GlobalStep& global, Matrices& R, const Points& P,
    const Points& restMeans, Anchor anchor)
    : Energy(energy)
    , Global(global)
    , R(R)
    , P(P)
    , RestMeans(restMeans)
    , Anchored(anchor)
  {
  }

  double FitLocal(const Points& Q) override
  {
    this->Energy.Covariances(Q, this->S);
    return FitRotations(this->S, this->R, this->Energy.GetThreads());
  }

  void SolveGlobal(Points& Q) override
  {
    this->Energy.RightHandSide(this->R, this->B);
    this->Global.Solve(this->B, Q);
    this->MoveComponents(Q);
  }

  EnergyTerms Evaluate(const Points& Q) const override { return this->Energy.Evaluate(Q, this->R); }

  /// Puts the anchor of every component back where it was; components with a fixed point stay.
  void MoveComponents(Points& Q) const
  {
    const MeshTopology& topology = this->Energy.GetTopology();
    Points move;
    if (this->Anchored == Anchor::Centroid)
    {
      move = this->RestMeans - topology.ComponentMeans(Q);
    }
    else
    {
      const std::vector<int>& last = topology.GetLastPoints();
      move = this->P(last, Eigen::all) - Q(last, Eigen::all);
    }
    for (Eigen::Index c = 0; c < move.rows(); ++c)
    {
      if (this->Global.GetComponentIsPinned()[c])
      {
        move.row(c).setZero();
      }
    }
    const std::vector<int>& component = topology.GetComponents();
    for (Eigen::Index i = 0; i < Q.rows(); ++i)
    {
      Q.row(i) += move.row(component[i]);
    }
  }

private:
  StyleEnergy& Energy;
  GlobalStep& Global;
  Matrices& R;
  const Points& P;
  const Points& RestMeans;
  Anchor Anchored;
  Matrices S;
  Points B;
};
}

//------------------------------------------------------------------------------------------------
class StyleSolver::State
{
public:
  // Depends on the mesh.
  Frame MeshFrame;
  TriangleMesh Given; // as given, to recognise it
  Points P;           // in the frame
  MeshTopology Topology;
  HalfEdgeScalars Cotangents;
  HalfEdgeVectors Edges;
  Points RestMeans;
  // Depends on detail size too.
  double BaseSize = -1.0;
  Points Base;
  // Depends on weights and fixed points too.
  std::vector<int> FixedPoints;
  bool HasGlobal = false;
  GlobalStep Global;
  // Result of the last solve.
  StyleEnergy Energy;
  Points T;
  Points Q; // in the frame
  Points Positions;
  Matrices R;

  void UpdateBase(double detailSize);
  Points Directions(const StyleOptions& options, StyleReport& report) const;
  void UpdateGlobal(const std::vector<int>& fixedPoints);
  bool IsClosedForm(const StyleOptions& options, const StyleReport& report) const;
  void StartFromBlend(double radius);
};

StyleSolver::StyleSolver()
  : S(std::make_unique<State>())
{
}

StyleSolver::~StyleSolver() = default;

void StyleSolver::SetMesh(const TriangleMesh& mesh)
{
  State& s = *this->S;
  const bool sameTriangles =
    s.Given.F.rows() == mesh.F.rows() && s.Given.P.rows() == mesh.P.rows() && s.Given.F == mesh.F;
  if (sameTriangles && s.Given.P == mesh.P)
  {
    return;
  }
  if (!mesh.P.allFinite())
  {
    throw std::invalid_argument("a point is not finite");
  }
  auto next = sameTriangles ? std::move(this->S) : std::make_unique<State>();
  this->S = std::make_unique<State>(); // empty, should a line below throw
  next->Given = mesh;
  if (!sameTriangles)
  {
    next->Topology = MeshTopology(mesh.F, static_cast<int>(mesh.P.rows()));
  }
  next->MeshFrame = FrameOf(mesh.P);
  next->P = next->MeshFrame.Into(mesh.P);
  next->Cotangents = HalfEdgeCotangents(next->P, mesh.F);
  if (!next->Cotangents.allFinite())
  {
    throw std::invalid_argument("a triangle has no area");
  }
  next->Edges = HalfEdgeDifferences(next->P, mesh.F);
  next->RestMeans = next->Topology.ComponentMeans(next->P);
  next->BaseSize = -1.0;
  this->S = std::move(next);
}

void StyleSolver::State::UpdateBase(double detailSize)
{
  if (detailSize == this->BaseSize)
  {
    return;
  }
  this->BaseSize = -1.0;
  // The frame's diagonal is 1, so the fraction is the length.
  this->Base =
    detailSize > 0.0 ? SmoothBase(this->P, this->Topology, this->Cotangents, detailSize) : this->P;
  this->BaseSize = detailSize;
}

Points StyleSolver::State::Directions(const StyleOptions& options, StyleReport& report) const
{
  const int n = static_cast<int>(this->P.rows());
  if (options.targets.rows() > 0)
  {
    return options.targets;
  }
  const Points d =
    CenterDirections(this->Base, this->Topology, report.sphere.center, report.pointsOnCenter);
  const Eigen::VectorXd a = options.normalBlends.size() > 0
    ? options.normalBlends
    : Eigen::VectorXd::Constant(n, options.normalBlend);
  if ((a.array() == 0.0).all())
  {
    return d;
  }
  const bool given = options.normals.rows() > 0 && options.detailSize == 0.0;
  return BlendDirections(d, given ? options.normals : PointNormals(this->Base, this->Given.F), a);
}

void StyleSolver::State::UpdateGlobal(const std::vector<int>& fixedPoints)
{
  if (!this->HasGlobal || fixedPoints != this->FixedPoints)
  {
    this->Global = GlobalStep(this->Topology, fixedPoints);
    this->FixedPoints = fixedPoints;
    this->HasGlobal = true;
  }
}

/// [blend]: one ratio l / c on all half-edges, targets that are differences of one field, nothing
/// held: the start with R = I is (P + mu (r t + P - B)) / (1 + mu) up to a move of each component.
bool StyleSolver::State::IsClosedForm(const StyleOptions& options, const StyleReport& report) const
{
  return this->Energy.GetWeights().proportional && report.concaveHalfEdges == 0 &&
    options.fixedPoints.empty();
}

void StyleSolver::State::StartFromBlend(double radius)
{
  const double mu = this->Energy.GetWeights().ratio;
  if (mu > 0.0)
  {
    this->Q = (this->P + mu * (radius * this->T + this->P - this->Base)) / (1.0 + mu);
  }
}

StyleReport StyleSolver::Solve(const StyleOptions& options, const Callback& callback)
{
  State& s = *this->S;
  const Triangles& F = s.Given.F;
  CheckOptions(options, static_cast<int>(s.P.rows()));
  StyleReport report;

  const Stopwatch base;
  s.UpdateBase(options.detailSize);
  report.seconds.base = base.Seconds();

  // Targets and weights.
  const Stopwatch targets;
  const double unit = s.MeshFrame.scale;
  const Sphere custom = { (options.custom.center - s.MeshFrame.origin.transpose()) / unit,
    options.custom.radius / unit };
  report.sphere = TargetSphere(s.Base, F, options.centerMode, options.radiusMode, custom);
  s.T = s.Directions(options, report);
  const bool details = options.detailSize > 0.0;
  const HalfEdgeVectors baseEdges = details ? HalfEdgeDifferences(s.Base, F) : s.Edges;
  HalfEdgeVectors tau = EdgeTargets(
    s.T, report.sphere.radius, F, baseEdges, options.concaveEdges, report.concaveHalfEdges);
  Eigen::VectorXd lambda = Eigen::VectorXd::Constant(s.P.rows(), options.lambda);
  if (options.roundnessFactors.size() > 0)
  {
    lambda = options.lambda * options.roundnessFactors;
  }
  EdgeWeights weights =
    ComputeEdgeWeights(s.Cotangents, F, lambda, options.edgeWeighting, options.sphericalWeighting);
  s.Energy = details ? StyleEnergy(s.Topology, std::move(weights), s.Edges, s.Edges - baseEdges,
                         std::move(tau), options.threads)
                     : StyleEnergy(s.Topology, std::move(weights), s.Edges, std::move(tau),
                         HalfEdgeVectors(0, 9), options.threads);
  report.seconds.weights = targets.Seconds();

  // Start.
  s.UpdateGlobal(options.fixedPoints);
  s.R.assign(s.P.rows(), Eigen::Matrix3d::Identity());
  s.Q = s.P;
  for (std::size_t i = 0; i < options.fixedPoints.size(); ++i)
  {
    s.Q.row(options.fixedPoints[i]) =
      s.MeshFrame.Into(options.fixedPositions.row(static_cast<Eigen::Index>(i)));
  }
  LinearFeature problem(s.Energy, s.Global, s.R, s.P, s.RestMeans, options.anchor);
  const double restEnergy = s.Energy.Evaluate(s.P, s.R).Total();
  const bool blend = options.initialGuess == InitialGuess::Blend;
  const bool closedForm = s.IsClosedForm(options, report);
  // Without details the blend is not only the start but the minimum, on weights that are positive
  // semidefinite in every triangle.
  LoopOptions loop = options.loop;
  report.closedForm = closedForm && blend && !details &&
    options.edgeWeighting == EdgeWeighting::HalfEdge && loop.stopRule != StopRule::FixedIterations;
  if (!report.closedForm)
  {
    const EdgeWeights& w = s.Energy.GetWeights();
    report.factored = w.proportional ? s.Global.SetWeights(w.c, 1.0 + w.ratio)
                                     : s.Global.SetWeights(w.c + w.l, 1.0);
    report.seconds.analyze = s.Global.GetAnalyzeSeconds();
    report.seconds.factor = s.Global.GetFactorSeconds();
    report.linearSolver = s.Global.GetSolverName();
  }
  const Stopwatch iterate;
  if (blend && closedForm)
  {
    s.StartFromBlend(report.sphere.radius);
    problem.MoveComponents(s.Q);
  }
  else if (blend)
  {
    problem.SolveGlobal(s.Q);
  }
  if (report.closedForm)
  {
    loop.maximumNumberOfIterations = 0;
  }
  report.loop =
    RunLocalGlobal(problem, s.P, restEnergy, 1e-14 * s.Energy.GetScale(), s.Q, loop, callback);
  if (report.closedForm)
  {
    report.loop.converged = true;
    report.loop.history.back().gap = 0.0;
  }
  report.seconds.iterate = iterate.Seconds();

  // Back to model units.
  s.Positions = s.MeshFrame.OutOf(s.Q);
  for (std::size_t i = 0; i < options.fixedPoints.size(); ++i)
  {
    s.Positions.row(options.fixedPoints[i]) =
      options.fixedPositions.row(static_cast<Eigen::Index>(i));
  }
  report.sphere.center = unit * report.sphere.center + s.MeshFrame.origin.transpose();
  report.sphere.radius *= unit;
  report.loop.restEnergy *= unit * unit;
  for (HistoryRow& row : report.loop.history)
  {
    for (double* energy :
      { &row.energy.rigid, &row.energy.spherical, &row.localChange, &row.globalChange })
    {
      *energy *= unit * unit;
    }
  }
  if (!s.Positions.allFinite())
  {
    throw SolverError("the result is not finite");
  }
  return report;
}

const Points& StyleSolver::GetPositions() const
{
  return this->S->Positions;
}

const Points& StyleSolver::GetDirections() const
{
  return this->S->T;
}

const Matrices& StyleSolver::GetRotations() const
{
  return this->S->R;
}

Eigen::VectorXd StyleSolver::GetCellEnergies() const
{
  const double unit = this->S->MeshFrame.scale;
  return unit * unit * this->S->Energy.CellEnergies(this->S->Q, this->S->R);
}
} // namespace SphericalStyle
