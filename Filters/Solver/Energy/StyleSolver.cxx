// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "StyleSolver.h"

#include "CenterShares.h"
#include "Handles.h"
#include "Parallel.h"
#include "SolverMesh.h"
#include "Stage.h"
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
  options.componentCoupling = ComponentCoupling::Independent;
  options.linearMethod = LinearMethod::Factor;
  options.centerMode = CenterMode::PointMean;
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
}

void CheckOptions(const StyleOptions& o, int n)
{
  Require(std::isfinite(o.lambda) && o.lambda >= 0.0, "lambda must be finite and not negative");
  Require(o.normalBlend >= 0.0 && o.normalBlend <= 1.0, "the normal blend a must lie in 0..1");
  Require(o.loop.tolerance > 0.0, "the tolerance must be above zero");
  Require(o.loop.maximumNumberOfIterations >= 0, "the number of iterations must be 0 or more");
  const auto sized = [n](Eigen::Index rows) { return rows == 0 || rows == n; };
  Require(sized(o.roundnessFactors.size()), "one roundness factor per point is needed");
  Require(sized(o.partFactors.size()), "one factor of its part per point is needed");
  Require(sized(o.normalBlends.size()), "one normal blend per point is needed");
  Require(sized(o.normals.rows()), "one normal per point is needed");
  Require(sized(o.targets.rows()), "one target direction per point is needed");
  Require(o.targets.rows() == 0 || o.shape.kind == TargetKind::Sphere,
    "with target directions the target must be the sphere");
  Require(o.shape.edges >= 0.0 && o.shape.edges <= 1.0, "edges of the target must lie in 0..1");
  Require(o.shape.lengths.allFinite() &&
      (o.shape.lengths.isZero(0.0) || o.shape.lengths.minCoeff() > 0.0),
    "lengths of the target must all be above zero, or all zero");
  Require(o.shape.kind != TargetKind::Mesh || o.shape.mesh, "there is no target mesh");
  Require(o.roundnessFactors.size() == 0 ||
      (o.roundnessFactors.allFinite() && o.roundnessFactors.minCoeff() >= 0.0),
    "roundness factors must be finite and not negative");
  Require(
    o.partFactors.size() == 0 || (o.partFactors.allFinite() && o.partFactors.minCoeff() >= 0.0),
    "factors of parts must be finite and not negative");
  Require(o.normalBlends.size() == 0 ||
      (o.normalBlends.allFinite() && o.normalBlends.minCoeff() >= 0.0 &&
        o.normalBlends.maxCoeff() <= 1.0),
    "normal blends must lie in 0..1");
  Require(o.normals.allFinite() && o.targets.allFinite(), "directions must be finite");
  Require(static_cast<Eigen::Index>(o.fixedPoints.size()) == o.fixedPositions.rows(),
    "one position per fixed point is needed");
  Require(o.fixedPositions.allFinite(), "positions of fixed points must be finite");
  Require(o.fixedTurns.rows() == 0 || o.fixedTurns.rows() == o.fixedPositions.rows(),
    "one rotation vector per fixed point is needed");
  Require(o.fixedTurns.allFinite(), "rotation vectors of fixed points must be finite");
  for (const int i : o.fixedPoints)
  {
    Require(i >= 0 && i < n, "a fixed point lies outside the mesh");
  }
  Require(!o.sphereOfFreePoints || static_cast<int>(o.fixedPoints.size()) < n,
    "every point is fixed: none is left to take center and radius from");
  Require(o.centerIds.empty() || static_cast<int>(o.centerIds.size()) == n,
    "one center id per point is needed");
  for (const int id : o.centerIds)
  {
    Require(id >= 0, "center ids must not be negative");
  }
  Require(o.centers.rows() == 0 || o.centers.rows() == o.NumberOfCenters(),
    "one center per center id is needed");
  Require(o.centers.allFinite(), "centers must be finite");
  Require(
    o.centerBlend >= 0.0 && std::isfinite(o.centerBlend), "the center blend must be 0 or more");
}

namespace
{
bool StartsFromBlend(const StyleOptions& o)
{
  return o.initialGuess != InitialGuess::Rest && !o.localTerm;
}

struct OfPoints
{
  int mesh; // version

  bool operator==(const OfPoints& other) const { return this->mesh == other.mesh; }
};

struct TrianglesKey
{
  int mesh; // version
  EnergyTriangleOptions shape;

  bool operator==(const TrianglesKey& other) const
  {
    return this->mesh == other.mesh && this->shape == other.shape;
  }
};

/// What the energy is a sum over.
struct EnergySum
{
  EnergyTriangleOptions Shape;
  EnergyTriangles Reshaped; // empty where the energy keeps the surface's
  Points RestMeans;         // of the components
  /// Another one for other triangles: points can move, and edges fail to flip, without that.
  int TopologyVersion = 0;
};

struct OfTopology
{
  int topology; // version

  bool operator==(const OfTopology& other) const { return this->topology == other.topology; }
};

struct GlobalKey
{
  int topology; // version
  std::vector<int> fixedPoints;
  LinearMethod method;

  bool operator==(const GlobalKey& other) const
  {
    return this->topology == other.topology && this->fixedPoints == other.fixedPoints &&
      this->method == other.method;
  }
};

struct SharesKey
{
  int triangles; // version
  std::vector<int> ids;
  double blend;
  LinearMethod method; // they are solved for

  bool operator==(const SharesKey& other) const
  {
    return this->triangles == other.triangles && this->ids == other.ids &&
      this->blend == other.blend && this->method == other.method;
  }
};
}

//------------------------------------------------------------------------------------------------
class StyleSolver::State : public SolverMesh
{
public:
  Stage<OfPoints, Eigen::VectorXd> Areas; // of the points
  Stage<TrianglesKey, EnergySum> Sum;
  Stage<OfTopology, CellPattern> Cells;
  Stage<GlobalKey, GlobalStep> Global;      // whose own key is the weights, see SetWeights
  Stage<SharesKey, Eigen::MatrixXd> Shares; // n x centers; no columns for one center
  // Result of the last solve.
  StyleEnergy Energy;
  Points T;
  Points Q; // in the frame
  Points Positions;
  Matrices R;

  /// The triangles of the energy. Areas, normals and spheres are those of the surface.
  const EnergyTriangles& EnergyMesh() const
  {
    return this->Sum->Shape.KeepSurface() ? this->Surface : this->Sum->Reshaped;
  }
  const Triangles& EnergyMeshTriangles() const
  {
    return this->EnergyMesh().Topology.GetTriangles();
  }

  StyleReport Solve(const StyleOptions& options, const Callback& callback);
  void Forget() noexcept;
  void UpdateTriangles(const EnergyTriangleOptions& shape);
  void UpdateShares(const StyleOptions& options);
  Points Directions(const StyleOptions& options, const Eigen::Vector3d& center,
    const TargetShape& shape, std::vector<int>& onCenter) const;
  HalfEdgeField Targets(const StyleOptions& options, StyleReport& report);
  void UpdateGlobal(const StyleOptions& options);
  bool IsClosedForm(const StyleOptions& options, const StyleReport& report) const;
  EdgeWeights Prepare(const StyleOptions& options, StyleReport& report);
  EdgeWeights Weights(const StyleOptions& options, StyleReport& report) const;
  void BuildEnergy(const StyleOptions& options, EdgeWeights weights, StyleReport& report);
  void PrepareSteps(StyleReport& report);
  void FactorGlobal(const EdgeWeights& w, int threads, StyleReport& report);
  void StartFromRest(const StyleOptions& options);
  void StartFromBlend(double radius, Points& Q) const;
  void TurnBetween(const StyleOptions& options);
  void PrepareLoop(const StyleOptions& options, StyleReport& report);
  void Start(StyleSteps& problem, const StyleOptions& options, const StyleReport& report);
  void ToModelUnits(const StyleOptions& options, StyleReport& report);
};

StyleSolver::StyleSolver()
  : S(std::make_unique<State>())
{
}

StyleSolver::~StyleSolver() = default;

void StyleSolver::SetMesh(const TriangleMesh& mesh)
{
  if (this->S->Compare(mesh) != MeshChange::Nothing)
  {
    this->SetMesh(std::make_shared<const TriangleMesh>(mesh));
  }
}

void StyleSolver::SetMesh(std::shared_ptr<const TriangleMesh> mesh)
{
  const MeshChange change = this->S->Compare(*mesh);
  if (change == MeshChange::Nothing)
  {
    this->S->Given = std::move(mesh); // it may be the only one left
    return;
  }
  ++this->MeshGeneration;
  auto next = std::make_unique<State>();
  next.swap(this->S); // which is empty now, should a line below throw
  if (change == MeshChange::Triangles)
  {
    next.reset(); // its memory is needed
    next = std::make_unique<State>();
  }
  next->Set(std::move(mesh), change);
  next->Areas.Update({ next->Version },
    [&](Eigen::VectorXd& areas) { areas = PointAreas(next->P, next->Given->F); });
  this->S = std::move(next);
}

namespace
{
EnergyTriangleOptions ShapeOf(const StyleOptions& options, const MeshTopology& surface)
{
  EnergyTriangleOptions shape;
  shape.intrinsicDelaunay = options.edgeWeighting == EdgeWeighting::IntrinsicDelaunay;
  shape.stitched =
    options.componentCoupling == ComponentCoupling::Stitched && surface.GetNumberOfComponents() > 1;
  return shape;
}
}

/// Keeps what depends on the mesh alone.
void StyleSolver::State::Forget() noexcept
{
  this->Sum.Forget();
  this->Cells.Forget();
  this->Global.Forget();
  this->Shares.Forget();
}

void StyleSolver::State::UpdateTriangles(const EnergyTriangleOptions& shape)
{
  this->Sum.Update({ this->Version, shape },
    [&](EnergySum& sum)
    {
      // Ordering and symbolic factor stay with the triangles that they were made for.
      if (shape.KeepSurface() != sum.Shape.KeepSurface())
      {
        ++sum.TopologyVersion;
      }
      sum.Shape = shape;
      if (shape.KeepSurface())
      {
        sum.Reshaped = {};
      }
      else if (UpdateEnergyTriangles(this->P, this->Surface, shape, sum.Reshaped))
      {
        ++sum.TopologyVersion;
      }
      sum.RestMeans = this->EnergyMesh().Topology.ComponentMeans(this->P, this->Areas.Get());
    });
}

void StyleSolver::State::UpdateShares(const StyleOptions& options)
{
  const auto make = [&](Eigen::MatrixXd& shares)
  {
    const int centers = options.NumberOfCenters();
    shares.resize(this->P.rows(), 0);
    if (centers > 1)
    {
      const EnergyTriangles& triangles = this->EnergyMesh();
      shares = CenterShares(this->P, triangles.Topology, triangles.Cotangents, options.centerBlend,
        options.centerIds, centers, this->Areas.Get(), options.linearMethod, options.threads);
    }
  };
  this->Shares.Update(
    { this->Sum.GetVersion(), options.centerIds, options.centerBlend, options.linearMethod }, make);
}

/// t [symbols] for one center.
Points StyleSolver::State::Directions(const StyleOptions& options, const Eigen::Vector3d& center,
  const TargetShape& shape, std::vector<int>& onCenter) const
{
  const int n = static_cast<int>(this->P.rows());
  if (options.targets.rows() > 0)
  {
    return options.targets;
  }
  Points d = CenterDirections(this->P, this->Given->F, center, onCenter);
  ReachShape(shape, options.threads, d);
  const Eigen::VectorXd a = options.normalBlends.size() > 0
    ? options.normalBlends
    : Eigen::VectorXd::Constant(n, options.normalBlend);
  if ((a.array() == 0.0).all())
  {
    return d;
  }
  const bool given = options.normals.rows() > 0;
  return BlendDirections(d, given ? options.normals : PointNormals(this->P, this->Given->F), a);
}

/// tau [energy] from every center; and t, of several centers by their shares.
HalfEdgeField StyleSolver::State::Targets(const StyleOptions& options, StyleReport& report)
{
  report.spheres = SpheresOfCenters(this->P, this->Given->F, options.Into(this->MeshFrame));
  report.sphere = report.spheres.front();
  report.shape = ShapeOf(this->P, this->Given->F, options);
  const Triangles& F = this->EnergyMeshTriangles();
  const bool keep = options.concaveEdges == ConcaveEdges::Keep;
  HalfEdgeVectors tau(0, 9);
  if (report.spheres.size() == 1)
  {
    this->T = this->Directions(options, report.sphere.center, report.shape, report.pointsOnCenter);
    if (keep)
    {
      return HalfEdgeField(this->T, report.sphere.radius);
    }
    tau = HalfEdgeDifferences(report.sphere.radius * this->T, F);
  }
  else
  {
    tau = HalfEdgeVectors::Zero(F.rows(), 9);
    this->T = Points::Zero(this->P.rows(), 3);
    for (std::size_t k = 0; k < report.spheres.size(); ++k)
    {
      const Sphere& sphere = report.spheres[k];
      const Eigen::VectorXd omega = this->Shares->col(static_cast<Eigen::Index>(k));
      std::vector<int> onCenter;
      const Points t = this->Directions(options, sphere.center, report.shape, onCenter);
      AddEdgeTargets(t, sphere.radius, omega, F, tau);
      this->T += omega.asDiagonal() * t;
      report.pointsOnCenter.insert(report.pointsOnCenter.end(), onCenter.begin(), onCenter.end());
    }
  }
  if (!keep)
  {
    report.concaveHalfEdges =
      ChangeConcaveTargets(HalfEdgeDifferences(this->P, F), options.concaveEdges, tau);
  }
  return tau;
}

void StyleSolver::State::UpdateGlobal(const StyleOptions& options)
{
  this->Global.Update({ this->Sum->TopologyVersion, options.fixedPoints, options.linearMethod },
    [&](GlobalStep& global) {
      global = GlobalStep(this->EnergyMesh().Topology, options.fixedPoints, options.linearMethod);
    });
}

/// [blend]: one ratio l / c on all half-edges, targets that are differences of one field, nothing
/// held: the start with R = I is (P + mu r t) / (1 + mu) up to a move of each component.
bool StyleSolver::State::IsClosedForm(const StyleOptions& options, const StyleReport& report) const
{
  return this->Energy.GetWeights().proportional && report.concaveHalfEdges == 0 &&
    options.fixedPoints.empty() && report.spheres.size() == 1;
}

void StyleSolver::State::StartFromBlend(double radius, Points& Q) const
{
  const double mu = this->Energy.GetWeights().ratio;
  if (mu > 0.0)
  {
    Q = (this->P + mu * radius * this->T) / (1.0 + mu);
  }
}

/// [handles] Rotations between those of the fixed points: a solve with the factor that is at hand.
void StyleSolver::State::TurnBetween(const StyleOptions& options)
{
  Points turns = Points::Zero(this->P.rows(), 3);
  turns(options.fixedPoints, AllColumns) = options.fixedTurns;
  const Points nothing = Points::Zero(this->P.rows(), 3);
  this->Global.Use().Solve(nothing, turns, options.threads);
  ParallelFor(static_cast<int>(this->P.rows()), options.threads,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        this->R[i] = RotationOfVector(turns.row(i).transpose());
      }
    });
}

/// All that depends on the mesh and on few options: triangles, weights, shares.
EdgeWeights StyleSolver::State::Prepare(const StyleOptions& options, StyleReport& report)
{
  const Stopwatch triangles;
  this->UpdateTriangles(ShapeOf(options, this->Surface.Topology));
  report.seconds.triangles = triangles.Seconds();
  report.components = this->Surface.Topology.GetNumberOfComponents();
  report.edgeFlips = this->EnergyMesh().NumberOfFlips;
  report.negativeEdges = this->EnergyMesh().NumberOfNegativeEdges;
  report.stitches = this->EnergyMesh().NumberOfStitches;
  this->UpdateGlobal(options);
  EdgeWeights weights = this->Weights(options, report);
  const Stopwatch shares;
  this->UpdateShares(options);
  report.seconds.base = shares.Seconds();
  return weights;
}

EdgeWeights StyleSolver::State::Weights(const StyleOptions& options, StyleReport& report) const
{
  const Stopwatch watch;
  Eigen::VectorXd lambda = Eigen::VectorXd::Constant(this->P.rows(), options.lambda);
  const Eigen::VectorXd factors = options.Factors();
  if (factors.size() > 0)
  {
    lambda = options.lambda * factors;
  }
  EdgeWeights weights =
    ComputeEdgeWeights(this->EnergyMesh().Cotangents, this->EnergyMeshTriangles(), lambda,
      options.edgeWeighting, options.sphericalWeighting, this->EnergyMesh().NumberOfStitches);
  report.seconds.weights += watch.Seconds();
  return weights;
}

/// Edges, targets and weights of [energy].
void StyleSolver::State::BuildEnergy(
  const StyleOptions& options, EdgeWeights weights, StyleReport& report)
{
  const Stopwatch watch;
  this->Energy = {}; // its memory is needed
  HalfEdgeField tau = this->Targets(options, report);
  this->Energy = StyleEnergy(this->EnergyMesh().Topology, std::move(weights),
    HalfEdgeField(this->P), std::move(tau), options.threads);
  report.seconds.weights += watch.Seconds();
}

/// What the steps need beyond the energy itself.
void StyleSolver::State::PrepareSteps(StyleReport& report)
{
  const Stopwatch watch;
  this->Cells.Update({ this->Sum->TopologyVersion },
    [&](CellPattern& cells)
    {
      cells = {}; // its memory is needed
      cells = CellPattern(this->EnergyMesh().Topology);
    });
  this->Energy.PrepareSteps(this->Cells.Get());
  report.seconds.weights += watch.Seconds();
}

void StyleSolver::State::FactorGlobal(const EdgeWeights& w, int threads, StyleReport& report)
{
  GlobalStep& global = this->Global.Use();
  report.factored = w.proportional ? global.SetWeights(w.c, 1.0 + w.ratio, threads)
                                   : global.SetWeights(w.c + w.l, 1.0, threads);
  report.seconds.analyze = global.GetAnalyzeSeconds();
  report.seconds.factor = global.GetFactorSeconds();
  report.linearSolver = global.GetSolverName();
  report.hasMinimum = global.IsDefinite();
}

/// Rest points with the fixed ones at their positions, every rotation the identity.
void StyleSolver::State::StartFromRest(const StyleOptions& options)
{
  this->R.assign(this->P.rows(), Eigen::Matrix3d::Identity());
  this->Q = this->P;
  if (!options.fixedPoints.empty())
  {
    this->Q(options.fixedPoints, AllColumns) = this->MeshFrame.Into(options.fixedPositions);
  }
}

void StyleSolver::State::ToModelUnits(const StyleOptions& options, StyleReport& report)
{
  const Frame& frame = this->MeshFrame;
  this->Positions = frame.OutOf(this->Q);
  if (!options.fixedPoints.empty())
  {
    this->Positions(options.fixedPoints, AllColumns) = options.fixedPositions; // exactly
  }
  if (!this->Positions.allFinite())
  {
    throw SolverError("the result is not finite");
  }
  for (Sphere& sphere : report.spheres)
  {
    sphere.center = frame.scale * sphere.center + frame.origin.transpose();
    sphere.radius *= frame.scale;
  }
  report.sphere = report.spheres.front();
  report.loop = OutOfFrame(frame, std::move(report.loop));
}

/// The blend is not only the start but the minimum, as long as the weights are positive
/// semidefinite in every triangle: then nothing needs to be solved. Else makes ready what the loop
/// needs.
void StyleSolver::State::PrepareLoop(const StyleOptions& options, StyleReport& report)
{
  report.closedForm = StartsFromBlend(options) && this->IsClosedForm(options, report) &&
    options.edgeWeighting != EdgeWeighting::FullEdge &&
    options.loop.stopRule != StopRule::FixedIterations;
  if (report.closedForm)
  {
    return;
  }
  this->PrepareSteps(report);
  this->FactorGlobal(this->Energy.GetWeights(), options.threads, report);
}

/// [start]
void StyleSolver::State::Start(
  StyleSteps& problem, const StyleOptions& options, const StyleReport& report)
{
  if (!StartsFromBlend(options))
  {
    return;
  }
  if (this->IsClosedForm(options, report))
  {
    this->StartFromBlend(report.sphere.radius, this->Q);
    problem.MoveComponents(this->Q);
  }
  else
  {
    if (options.fixedTurns.rows() > 0)
    {
      this->TurnBetween(options);
    }
    problem.SolveGlobal(this->Q);
  }
}

StyleReport StyleSolver::State::Solve(const StyleOptions& options, const Callback& callback)
{
  StyleReport report;
  this->BuildEnergy(options, this->Prepare(options, report), report);
  this->StartFromRest(options);
  StyleSteps problem(this->Energy, this->Global.Use(), this->R, this->P, this->Areas.Get(),
    this->Sum->RestMeans, options.anchor, options.localTerm.get());
  if (options.localTerm)
  {
    options.localTerm->SetMesh(this->P, this->Given->F);
  }
  double restEnergy = problem.Evaluate(this->P).Total();
  this->PrepareLoop(options, report);
  const auto unfinishedSolves = [this] { return this->Global.Use().GetNumberOfUnfinishedSolves(); };
  const int unfinishedBefore = unfinishedSolves();

  const Stopwatch iterate;
  this->Start(problem, options, report);
  if (!options.fixedPoints.empty())
  {
    // Held points can lie anywhere: what is to be gained is then measured from the blend too.
    Points blend = this->Q;
    if (!StartsFromBlend(options))
    {
      problem.SolveGlobal(blend);
    }
    restEnergy = std::max(restEnergy, problem.Evaluate(blend).Total());
  }

  LoopOptions loop = options.loop;
  loop.threads = options.threads;
  loop.maximumNumberOfIterations = report.closedForm ? 0 : loop.maximumNumberOfIterations;
  report.loop = RunLocalGlobal(
    problem, this->P, restEnergy, 1e-14 * this->Energy.GetScale(), this->Q, loop, callback);
  report.unfinishedSolves = unfinishedSolves() - unfinishedBefore;
  if (report.closedForm)
  {
    report.loop.converged = true;
    report.loop.history.back().gap = 0.0;
  }
  report.seconds.iterate = iterate.Seconds();
  this->ToModelUnits(options, report);
  return report;
}

StyleReport StyleSolver::Solve(const StyleOptions& options, const Callback& callback)
{
  State& s = *this->S;
  Require(s.P.rows() > 0, "there is no mesh: SetMesh was not called or has thrown");
  CheckOptions(options, static_cast<int>(s.P.rows()));
  try
  {
    return s.Solve(options, callback);
  }
  catch (...)
  {
    s.Forget(); // what a stage uses, as the global step its matrix, may be half done
    throw;
  }
}

StyleResult StyleSolver::TakeResult()
{
  State& s = *this->S;
  StyleResult result;
  result.cellEnergies = this->GetCellEnergies();
  result.positions = std::exchange(s.Positions, Points(0, 3));
  result.directions = std::exchange(s.T, Points(0, 3));
  result.rotations = std::exchange(s.R, {});
  s.Q.resize(0, 3);
  s.Energy = {}; // whose targets are differences of T
  return result;
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
  return this->S->MeshFrame.EnergyOutOf(this->S->Energy.CellEnergies(this->S->Q, this->S->R));
}
} // namespace SphericalStyle
