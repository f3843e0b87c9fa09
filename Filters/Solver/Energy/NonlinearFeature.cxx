// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "NonlinearFeature.h"

#include "LocalStep.h"
#include "NonlinearEnergy.h"
#include "SolverMesh.h"
#include "Stopwatch.h"
#include "SurfaceMeasures.h"

#include <Eigen/SparseLU>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace SphericalStyle
{
using Eigen::VectorXd;

NonlinearOptions ThesisOptions(NonlinearOptions options)
{
  options.centerMode = CenterMode::PointMean;
  options.centerConstraint = CenterConstraint::AsWritten;
  options.loop.stopRule = StopRule::Thesis;
  options.loop.acceleration = false;
  return options;
}

namespace
{
void Require(bool condition, const std::string& message)
{
  if (!condition)
  {
    throw std::invalid_argument(message);
  }
}

void CheckOptions(const NonlinearOptions& o, int n)
{
  Require(n > 0, "there is no mesh: SetMesh was not called or has thrown");
  Require(std::isfinite(o.lambda) && o.lambda >= 0.0, "lambda must be finite and not negative");
  Require(o.loop.tolerance > 0.0, "the tolerance must be above zero");
  Require(o.loop.maximumNumberOfIterations >= 0, "the number of iterations must be 0 or more");
  Require(o.roundnessFactors.size() == 0 ||
      (o.roundnessFactors.size() == n && o.roundnessFactors.allFinite() &&
        o.roundnessFactors.minCoeff() >= 0.0),
    "one roundness factor per point is needed, finite and not negative");
  Require(o.normals.rows() == 0 || (o.normals.rows() == n && o.normals.allFinite()),
    "one finite normal per point is needed");
}

/// Rather than to take hours.
void CheckSizeAsWritten(const OneRings& rings)
{
  const int n = rings.GetNumberOfPoints();
  const int dense = rings[n - 1].size();
  const std::string size =
    std::to_string(n) + " points, the last one with " + std::to_string(dense) + " neighbors: ";
  Require(n <= NonlinearFeature::MaximumPointsAsWritten &&
      static_cast<double>(n) * dense <= NonlinearFeature::MaximumDenseEntriesAsWritten,
    "CenterConstraint AsWritten takes no model of " + size +
      "it would factor a matrix with that many rows without a zero in every iteration. Take "
      "Corrected, or at most " +
      std::to_string(NonlinearFeature::MaximumPointsAsWritten) + " points and " +
      std::to_string(NonlinearFeature::MaximumDenseEntriesAsWritten) + " entries in such rows");
}

/// Factorizations done and their time.
struct Effort
{
  int analyses = 0;
  int factorizations = 0;
  double analyzeSeconds = 0.0;
  double factorSeconds = 0.0;
};

//------------------------------------------------------------------------------------------------
/// [nonlinear] (2 L_w + D) P' = b: what changes from call to call is the diagonal.
class CorrectedSystem
{
public:
  void SetTopology(const MeshTopology& topology)
  {
    this->Topology = &topology;
    this->Matrix = EdgeMatrix(topology, std::vector<char>(topology.GetNumberOfPoints(), 0));
    this->Analyzed = false;
  }
  /// @param c  m x 3 half cotangents
  void SetCotangents(const HalfEdgeScalars& c) { this->Weights = 2.0 * c; }
  const char* GetSolverName() const { return this->Factor.GetName(); }

  /// @param d, b  diagonal and right-hand side @param Q  replaced by the solution
  void Solve(VectorXd d, const Points& b, Points& Q, Effort& effort)
  {
    this->Right = b;
    this->HoldComponentsWithoutPull(d, Q);
    const SparseCholesky::Matrix& A = this->Matrix.Assemble(this->Weights, d);
    if (!this->Analyzed)
    {
      const Stopwatch analyze;
      this->Factor.Analyze(A);
      this->Analyzed = true;
      ++effort.analyses;
      effort.analyzeSeconds += analyze.Seconds();
    }
    const Stopwatch factor;
    this->Factor.Factor(A);
    ++effort.factorizations;
    effort.factorSeconds += factor.Seconds();
    this->Factor.Solve(this->Right);
    Q = this->Right;
  }

private:
  /// Adds W |p' - q|^2 for the last point q of a component that is free to travel.
  void HoldComponentsWithoutPull(VectorXd& d, const Points& Q)
  {
    const std::vector<int>& component = this->Topology->GetComponents();
    const Triangles& F = this->Topology->GetTriangles();
    VectorXd pull = VectorXd::Zero(this->Topology->GetNumberOfComponents());
    VectorXd stiffness = pull;
    for (Eigen::Index i = 0; i < d.size(); ++i)
    {
      pull(component[i]) += d(i);
    }
    for (Eigen::Index f = 0; f < F.rows(); ++f)
    {
      stiffness(component[F(f, 0)]) += 2.0 * this->Weights.row(f).sum(); // both ends: the trace
    }
    for (Eigen::Index c = 0; c < pull.size(); ++c)
    {
      if (!(pull(c) > 1e-10 * stiffness(c)))
      {
        const int last = this->Topology->GetLastPoints()[c];
        d(last) += stiffness(c);
        this->Right.row(last) += stiffness(c) * Q.row(last);
      }
    }
  }

  const MeshTopology* Topology = nullptr;
  EdgeMatrix Matrix;
  SparseCholesky Factor;
  HalfEdgeScalars Weights;
  SparseCholesky::RightHandSides Right;
  bool Analyzed = false;
};

//------------------------------------------------------------------------------------------------
/// Eq. 3.35 - 3.42: L_non2 H_3 = B_non1 by LU, then p'_n.
class AsWrittenSystem
{
public:
  static const char* GetSolverName() { return "Eigen SparseLU"; }

  /// @param d, b  twice the g_i of Eq. 3.25 and the b_i of Eq. 3.22
  void Solve(const OneRings& rings, const VectorXd& d, const Points& b, Points& Q, Effort& effort)
  {
    const Eigen::Index unknowns = d.size() - 1;
    this->Assemble(rings, d);
    const Stopwatch factor;
    Eigen::SparseLU<Eigen::SparseMatrix<double>> lu; // made anew in every iteration, as printed
    lu.compute(this->Matrix);
    if (lu.info() != Eigen::Success)
    {
      throw SolverError("CenterConstraint AsWritten: the matrix of Eq. 3.35 is singular");
    }
    ++effort.analyses;
    ++effort.factorizations;
    effort.factorSeconds += factor.Seconds();
    const Eigen::MatrixXd right = 0.5 * b.topRows(unknowns);
    const Eigen::MatrixXd solution = lu.solve(right);
    if (!solution.allFinite())
    {
      throw SolverError(
        "CenterConstraint AsWritten: the matrix of Eq. 3.35 is singular to machine precision");
    }
    Q.topRows(unknowns) = solution;
    Q.row(unknowns) = -solution.colwise().sum(); // Eq. 3.42
  }

private:
  /// Eq. 3.35. A neighbor of the last point n has w_in in every column.
  void Assemble(const OneRings& rings, const VectorXd& d)
  {
    const int n = static_cast<int>(d.size()) - 1; // the last point, and the number of unknowns
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i)
    {
      double W = 0.0; // Eq. 3.24
      for (const OneRings::Neighbor& j : rings[i])
      {
        W += j.weight;
        if (j.point != n)
        {
          entries.emplace_back(i, j.point, -j.weight);
          continue;
        }
        for (int column = 0; column < n; ++column)
        {
          entries.emplace_back(i, column, j.weight);
        }
      }
      entries.emplace_back(i, i, W + 0.5 * d(i));
    }
    this->Matrix.resize(n, n);
    this->Matrix.setFromTriplets(entries.begin(), entries.end());
  }

  Eigen::SparseMatrix<double> Matrix;
};
}

//------------------------------------------------------------------------------------------------
class NonlinearFeature::State : public SolverMesh
{
public:
  // Depends on the mesh.
  OneRings Rings;
  CorrectedSystem Corrected;
  Effort Done;
  // Result of the last solve.
  Frame SolveFrame; // around o
  NonlinearEnergy Energy;
  bool InwardNormals = false;
  Points Q; // in the frame
  Points Positions;
  Matrices R;
  VectorXd Scales;

  void BuildEnergy(const NonlinearOptions& options, StyleReport& report);
  void ToModelUnits(StyleReport& report);
};

namespace
{
/// Lets LocalGlobal run the steps of chapter 3.
class Steps : public TwoStepEnergy
{
public:
  Steps(const NonlinearEnergy& energy, Matrices& R, VectorXd& s, Effort& effort)
    : Energy(energy)
    , R(R)
    , Scales(s)
    , Done(effort)
  {
  }

  /// R for the last s, then s for that R, as in the thesis: each lowers E.
  double FitLocal(const Points& Q) override
  {
    this->Energy.Covariances(Q, this->Scales, this->S);
    const double change = FitRotations(this->S, this->R, this->Energy.GetThreads());
    return change + this->FitScales(Q);
  }

  void SolveGlobal(Points& Q) override
  {
    this->Energy.RightHandSide(this->R, this->Scales, this->B);
    this->SolveSystem(this->Energy.Diagonal(this->Scales), this->B, Q);
  }

  EnergyTerms Evaluate(const Points& Q) const override
  {
    return this->Energy.Evaluate(Q, this->R, this->Scales);
  }

  void KeepLocal() override
  {
    this->KeptR = this->R;
    this->KeptScales = this->Scales;
  }

  void RestoreLocal() override
  {
    this->R.swap(this->KeptR);
    this->Scales.swap(this->KeptScales);
  }

protected:
  virtual double FitScales(const Points& Q) = 0;
  virtual void SolveSystem(const VectorXd& d, const Points& b, Points& Q) = 0;

  const NonlinearEnergy& Energy;
  Matrices& R;
  VectorXd& Scales;
  Effort& Done;

private:
  Matrices S;
  Points B;
  Matrices KeptR;
  VectorXd KeptScales;
};

class CorrectedSteps : public Steps
{
public:
  CorrectedSteps(const NonlinearEnergy& energy, Matrices& R, VectorXd& s, Effort& effort,
    CorrectedSystem& system)
    : Steps(energy, R, s, effort)
    , System(system)
  {
  }

private:
  double FitScales(const Points& Q) override
  {
    return this->Energy.FitScales(Q, this->R, this->Scales);
  }
  void SolveSystem(const VectorXd& d, const Points& b, Points& Q) override
  {
    this->System.Solve(d, b, Q, this->Done);
  }

  CorrectedSystem& System;
};

class AsWrittenSteps : public Steps
{
public:
  using Steps::Steps;

private:
  double FitScales(const Points& Q) override
  {
    return this->Energy.FitScalesPerCell(Q, this->R, this->Scales);
  }
  void SolveSystem(const VectorXd& d, const Points& b, Points& Q) override
  {
    this->System.Solve(this->Energy.GetRings(), d, b, Q, this->Done);
  }

  AsWrittenSystem System;
};
}

//------------------------------------------------------------------------------------------------
NonlinearFeature::NonlinearFeature()
  : S(std::make_unique<State>())
{
}

NonlinearFeature::~NonlinearFeature() = default;

void NonlinearFeature::SetMesh(const TriangleMesh& mesh)
{
  if (this->S->Compare(mesh) != MeshChange::Nothing)
  {
    this->SetMesh(std::make_shared<const TriangleMesh>(mesh));
  }
}

void NonlinearFeature::SetMesh(std::shared_ptr<const TriangleMesh> mesh)
{
  const MeshChange change = this->S->Compare(*mesh);
  if (change == MeshChange::Nothing)
  {
    this->S->Given = std::move(mesh); // it may be the only one left
    return;
  }
  auto next = std::make_unique<State>();
  next.swap(this->S); // which is empty now, should a line below throw
  if (change == MeshChange::Triangles)
  {
    next.reset(); // its memory is needed
    next = std::make_unique<State>();
  }
  next->Set(std::move(mesh), change);
  if (change == MeshChange::Triangles)
  {
    next->Corrected.SetTopology(next->Surface.Topology);
  }
  next->Corrected.SetCotangents(next->Surface.Cotangents);
  next->Rings = OneRings(next->Surface.Topology, next->Surface.Cotangents);
  this->S = std::move(next);
}

/// The frame around o of unit radius, and the energy in it.
void NonlinearFeature::State::BuildEnergy(const NonlinearOptions& options, StyleReport& report)
{
  const Stopwatch watch;
  const Triangles& F = this->Given->F;
  const Frame& frame = this->MeshFrame;
  const bool asWritten = options.centerConstraint == CenterConstraint::AsWritten;
  const Sphere custom = { (options.center - frame.origin.transpose()) / frame.scale, 1.0 };
  const Sphere unit = TargetSphere(this->P, F,
    asWritten ? CenterMode::PointMean : options.centerMode, RadiusMode::EqualArea, custom);
  const Frame sphereFrame = { unit.center.transpose(), unit.radius };
  this->SolveFrame = { frame.origin + frame.scale * sphereFrame.origin, frame.scale * unit.radius };
  report.sphere = { this->SolveFrame.origin.transpose(), this->SolveFrame.scale };
  report.spheres = { report.sphere };
  VectorXd lambda = VectorXd::Constant(this->P.rows(), options.lambda);
  if (options.roundnessFactors.size() > 0)
  {
    lambda = options.lambda * options.roundnessFactors;
  }
  const Points normals = options.normals.rows() > 0 ? options.normals : PointNormals(this->P, F);
  this->Energy = NonlinearEnergy(
    this->Rings, sphereFrame.Into(this->P), normals, std::move(lambda), options.threads);
  const Points& P = this->Energy.GetRestPoints();
  const VectorXd s = NonlinearEnergy::ReciprocalDistances(P);
  this->InwardNormals = P.cwiseProduct(normals).rowwise().sum().dot(s) < 0.0;
  report.seconds.weights = watch.Seconds();
}

void NonlinearFeature::State::ToModelUnits(StyleReport& report)
{
  this->Positions = this->SolveFrame.OutOf(this->Q);
  if (!this->Positions.allFinite())
  {
    throw SolverError("the result is not finite");
  }
  report.loop = OutOfFrame(this->SolveFrame, std::move(report.loop));
}

StyleReport NonlinearFeature::Solve(const NonlinearOptions& options, const Callback& callback)
{
  State& s = *this->S;
  CheckOptions(options, static_cast<int>(s.P.rows()));
  if (options.centerConstraint == CenterConstraint::AsWritten)
  {
    CheckSizeAsWritten(s.Rings);
  }
  StyleReport report;
  s.BuildEnergy(options, report);
  s.Q = s.Energy.GetRestPoints();
  s.R.assign(s.Q.rows(), Eigen::Matrix3d::Identity());
  s.Scales = NonlinearEnergy::ReciprocalDistances(s.Q);

  const Stopwatch iterate;
  const Effort before = s.Done;
  const auto run = [&](Steps& steps, LoopOptions loop)
  {
    loop.threads = options.threads;
    report.loop = RunLocalGlobal(steps, s.Energy.GetRestPoints(), steps.Evaluate(s.Q).Total(),
      1e-14 * s.Energy.GetScale(), s.Q, loop, callback);
  };
  if (options.centerConstraint == CenterConstraint::Corrected)
  {
    CorrectedSteps steps(s.Energy, s.R, s.Scales, s.Done, s.Corrected);
    run(steps, options.loop);
    report.linearSolver = s.Corrected.GetSolverName();
  }
  else
  {
    LoopOptions loop = options.loop;
    loop.acceleration = false;
    loop.stopRule = loop.stopRule == StopRule::Converged ? StopRule::Thesis : loop.stopRule;
    AsWrittenSteps steps(s.Energy, s.R, s.Scales, s.Done);
    run(steps, loop);
    report.linearSolver = AsWrittenSystem::GetSolverName();
    for (HistoryRow& row : report.loop.history)
    {
      row.gap = std::numeric_limits<double>::quiet_NaN(); // no minimum is being approached
    }
  }
  report.factored = s.Done.factorizations > before.factorizations;
  report.seconds.analyze = s.Done.analyzeSeconds - before.analyzeSeconds;
  report.seconds.factor = s.Done.factorSeconds - before.factorSeconds;
  report.seconds.iterate = iterate.Seconds() - report.seconds.analyze - report.seconds.factor;
  s.ToModelUnits(report);
  return report;
}

const Points& NonlinearFeature::GetPositions() const
{
  return this->S->Positions;
}

const Matrices& NonlinearFeature::GetRotations() const
{
  return this->S->R;
}

VectorXd NonlinearFeature::GetScales() const
{
  return this->S->Scales / this->S->SolveFrame.scale;
}

VectorXd NonlinearFeature::GetCellEnergies() const
{
  const State& s = *this->S;
  return s.SolveFrame.EnergyOutOf(s.Energy.CellEnergies(s.Q, s.R, s.Scales));
}

bool NonlinearFeature::HasInwardNormals() const
{
  return this->S->InwardNormals;
}

int NonlinearFeature::GetNumberOfAnalyses() const
{
  return this->S->Done.analyses;
}

int NonlinearFeature::GetNumberOfFactorizations() const
{
  return this->S->Done.factorizations;
}
} // namespace SphericalStyle
