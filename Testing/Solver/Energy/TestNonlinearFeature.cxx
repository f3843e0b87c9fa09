// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The nonlinear feature: the energy and its three updates against their definitions, descent of the
// corrected form, the failure of the form as written, and what the results look like.
#include "Check.h"
#include "Dense.h"
#include "EdgeWeights.h"
#include "Frame.h"
#include "Meshes.h"
#include "NonlinearEnergy.h"
#include "NonlinearFeature.h"
#include "SurfaceMeasures.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <array>
#include <set>
#include <string>

using namespace SphericalStyle;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace
{
using Meshes::Named;

/// Fig. 3.1: an ellipsoid of half axes 1, 1, .45, 24 x 16 points and two poles.
TriangleMesh GoStone()
{
  return Meshes::Scaled(Meshes::EllipsoidUV(24, 16), { 1.0, 1.0 / 0.7, 0.9 });
}

std::vector<Named> AllMeshes()
{
  return { { "go stone", GoStone() }, { "house", Meshes::House() },
    { "obtuse house", Meshes::House(13) }, { "box", Meshes::Box(8) },
    { "sphere", Meshes::Icosphere(3) }, { "ellipsoid", Meshes::Ellipsoid(2) },
    { "slivers", Meshes::Slivers() }, { "patch", Meshes::Patch(8, 0.4) },
    { "two components", Meshes::TwoComponents() }, { "fan", Meshes::NonManifoldFan() },
    { "tetrahedron", Meshes::Tetrahedron() } };
}

NonlinearOptions Fixed(double lambda, int iterations, CenterConstraint constraint)
{
  NonlinearOptions options;
  options.lambda = lambda;
  options.centerConstraint = constraint;
  options.loop.stopRule = StopRule::FixedIterations;
  options.loop.maximumNumberOfIterations = iterations;
  options.loop.acceleration = false;
  return options;
}

StyleReport Run(
  NonlinearFeature& feature, const TriangleMesh& mesh, const NonlinearOptions& options)
{
  feature.SetMesh(mesh);
  return feature.Solve(options);
}

//------------------------------------------------------------------------------------------------
/// An energy on a mesh in the state (Q, R, s), all of them random.
struct RandomState
{
  explicit RandomState(const TriangleMesh& mesh)
    : Topology(mesh.F, static_cast<int>(mesh.P.rows()))
    , Rings(Topology, HalfEdgeCotangents(mesh.P, mesh.F))
  {
    Meshes::Random random(11);
    const int n = static_cast<int>(mesh.P.rows());
    this->Lambda = VectorXd::NullaryExpr(n, [&]() { return 0.2 + random.Unit(); });
    this->S = VectorXd::NullaryExpr(n, [&]() { return 0.1 + random.Unit(); });
    this->Q = mesh.P;
    this->Normals = PointNormals(mesh.P, mesh.F);
    for (int i = 0; i < n; ++i)
    {
      this->Q.row(i) += 0.3 * random.InCube().transpose();
      this->R.push_back(random.Rotation());
    }
    this->Energy = NonlinearEnergy(this->Rings, mesh.P, this->Normals, this->Lambda, 1);
  }
  RandomState(const RandomState&) = delete;
  RandomState& operator=(const RandomState&) = delete;

  MeshTopology Topology;
  OneRings Rings;
  VectorXd Lambda;
  VectorXd S;
  Points Q;
  Points Normals;
  Matrices R;
  NonlinearEnergy Energy;
};

/// Neighbors and Eq. 2.4, from the definition: triangle by triangle, for all pairs of points.
struct BruteForce
{
  explicit BruteForce(const TriangleMesh& mesh)
    : Weights(Eigen::MatrixXd::Zero(mesh.P.rows(), mesh.P.rows()))
    , Neighbors(mesh.P.rows())
  {
    for (int f = 0; f < mesh.F.rows(); ++f)
    {
      for (int k = 0; k < 3; ++k)
      {
        const int a = mesh.F(f, k), b = mesh.F(f, (k + 1) % 3), c = mesh.F(f, (k + 2) % 3);
        const Vector3d x = (mesh.P.row(b) - mesh.P.row(a)).normalized();
        const Vector3d y = (mesh.P.row(c) - mesh.P.row(a)).normalized();
        const double angle = std::acos(x.dot(y));
        this->Weights(b, c) += 0.5 / std::tan(angle);
        this->Weights(c, b) += 0.5 / std::tan(angle);
        this->Neighbors[b].insert(c);
        this->Neighbors[c].insert(b);
      }
    }
  }

  /// Eq. 3.2; target(i, j) is what R_i n_j is compared with.
  template <typename Target>
  EnergyTerms Energy(const RandomState& x, const Points& P, const Target& target) const
  {
    EnergyTerms energy;
    for (int i = 0; i < P.rows(); ++i)
    {
      std::set<int> cell = this->Neighbors[i];
      for (const int j : cell)
      {
        const Vector3d e = P.row(i) - P.row(j), deformed = x.Q.row(i) - x.Q.row(j);
        energy.rigid += this->Weights(i, j) * (deformed - x.R[i] * e).squaredNorm();
      }
      cell.insert(i);
      for (const int j : cell)
      {
        const Vector3d n = x.Normals.row(j);
        energy.spherical += x.Lambda(j) * (x.R[i] * n - target(j)).squaredNorm();
      }
    }
    return energy;
  }

  Eigen::MatrixXd Weights;
  std::vector<std::set<int>> Neighbors;
};

void TestEnergy()
{
  for (const Named& named : AllMeshes())
  {
    RandomState x(named.mesh);
    const BruteForce brute(named.mesh);
    const auto compare = [&](const VectorXd& s, const auto& target, const char* equation)
    {
      const EnergyTerms is = x.Energy.Evaluate(x.Q, x.R, s);
      const EnergyTerms expected = brute.Energy(x, named.mesh.P, target);
      const double tolerance = 1e-10 * (std::abs(expected.rigid) + expected.spherical);
      CHECK_NEAR(is.rigid, expected.rigid, tolerance, named.name << ", rigid, " << equation);
      CHECK_NEAR(is.spherical, expected.spherical, tolerance, named.name << ", " << equation);
      CHECK_NEAR(x.Energy.CellEnergies(x.Q, x.R, s).sum(), expected.Total(), tolerance,
        named.name << ": sum of the cells");
    };
    compare(
      x.S, [&](int j) -> Vector3d { return x.S(j) * x.Q.row(j); }, "Eq. 3.2");
    compare(
      x.Energy.ReciprocalDistances(x.Q), [&](int j) -> Vector3d { return x.Q.row(j).normalized(); },
      "Eq. 3.1");
  }
}

/// dE/dP' = 2 ((2 L_w + D) P' - b), assembled here from the parts; zero at what solves the system.
Points Gradient(const RandomState& x, const BruteForce& brute)
{
  Eigen::MatrixXd A = -2.0 * brute.Weights;
  A.diagonal() = 2.0 * brute.Weights.rowwise().sum() + x.Energy.Diagonal(x.S);
  Points b;
  x.Energy.RightHandSide(x.R, x.S, b);
  return 2.0 * (A * x.Q - b);
}

/// Every update of mathematics and code against central differences of the energy.
void TestGradients()
{
  for (const Named& named :
    { Named{ "house", Meshes::House() }, Named{ "fan", Meshes::NonManifoldFan() } })
  {
    RandomState x(named.mesh);
    const BruteForce brute(named.mesh);
    const double h = 1e-5;
    const double size = x.Energy.Evaluate(x.Q, x.R, x.S).Total();
    const auto slope = [&](double& variable)
    {
      const double at = variable;
      variable = at + h;
      const double above = x.Energy.Evaluate(x.Q, x.R, x.S).Total();
      variable = at - h;
      const double below = x.Energy.Evaluate(x.Q, x.R, x.S).Total();
      variable = at;
      return (above - below) / (2.0 * h);
    };
    const Points gradient = Gradient(x, brute);
    for (int k = 0; k < gradient.size(); ++k)
    {
      CHECK_NEAR(gradient.data()[k], slope(x.Q.data()[k]), 1e-8 * size,
        named.name << ": dE/dP' of coordinate " << k);
    }

    // R_i: no turn by a small angle about any axis lowers E, and E changes by what is told.
    Matrices S;
    const double before = x.Energy.Evaluate(x.Q, x.R, x.S).Total();
    x.Energy.Covariances(x.Q, x.S, S);
    double told = 0.0;
    for (std::size_t i = 0; i < S.size(); ++i)
    {
      const Eigen::JacobiSVD<Matrix3d> svd(S[i], Eigen::ComputeFullU | Eigen::ComputeFullV);
      Matrix3d U = svd.matrixU(); // Eq. 3.8, 3.9
      if ((svd.matrixV() * U.transpose()).determinant() < 0.0)
      {
        U.col(2) = -U.col(2);
      }
      const Matrix3d best = svd.matrixV() * U.transpose();
      told -= 2.0 * ((best - x.R[i]) * S[i]).trace();
      x.R[i] = best;
    }
    CHECK_NEAR(x.Energy.Evaluate(x.Q, x.R, x.S).Total() - before, told, 1e-11 * before,
      named.name << ": change of E by the rotations");
    const Matrices fitted = x.R;
    for (std::size_t i = 0; i < S.size(); ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        const auto turned = [&](double angle)
        {
          x.R[i] = Eigen::AngleAxisd(angle, Vector3d::Unit(axis)).toRotationMatrix() * fitted[i];
          const double energy = x.Energy.Evaluate(x.Q, x.R, x.S).Total();
          x.R[i] = fitted[i];
          return energy;
        };
        CHECK_NEAR((turned(h) - turned(-h)) / (2.0 * h), 0.0, 1e-8 * size,
          named.name << ": slope over the rotation of cell " << i);
        CHECK(turned(0.05) > turned(0.0), named.name << ": rotation " << i << " is no minimum");
      }
    }

    // s_j: zero slope, or zero and a slope that points below zero.
    const double rotated = x.Energy.Evaluate(x.Q, x.R, x.S).Total();
    const double change = x.Energy.FitScales(x.Q, x.R, x.S);
    CHECK_NEAR(x.Energy.Evaluate(x.Q, x.R, x.S).Total() - rotated, change, 1e-11 * before,
      named.name << ": change of E by the scales");
    CHECK(change < 0.0, named.name << ": the scales should lower E");
    for (int j = 0; j < x.S.size(); ++j)
    {
      const double at = slope(x.S(j));
      CHECK(x.S(j) > 0.0 ? std::abs(at) < 1e-8 * size : at > -1e-8 * size && x.S(j) == 0.0,
        named.name << ": scale " << j << " is " << x.S(j) << ", its slope " << at);
    }

    // Eq. 3.12: the slope of its cell's energy over one scale for all of the cell is zero; that of
    // E is not. This is why it is no descent step.
    const double perCell = x.Energy.FitScalesPerCell(x.Q, x.R, x.S);
    const double now = x.Energy.Evaluate(x.Q, x.R, x.S).Total();
    CHECK_NEAR(now - (rotated + change), perCell, 1e-11 * before,
      named.name << ": change of E by the scales of Eq. 3.12");
    CHECK(perCell > 1e-3 * now, named.name << ": Eq. 3.12 should miss the minimum over s");
    for (int i = 0; i < x.S.size(); ++i)
    {
      double cellSlope = 0.0;
      std::set<int> cell = brute.Neighbors[i];
      cell.insert(i);
      for (const int j : cell)
      {
        const Vector3d p = x.Q.row(j), n = x.Normals.row(j);
        cellSlope += p.dot(x.S(i) * p - x.R[i] * n);
      }
      CHECK_NEAR(cellSlope, 0.0, 1e-10, named.name << ": Eq. 3.12 in cell " << i);
    }
  }
}

//------------------------------------------------------------------------------------------------
void CheckHistory(const StyleReport& report, const std::string& what)
{
  const std::vector<HistoryRow>& rows = report.loop.history;
  for (std::size_t k = 1; k < rows.size(); ++k)
  {
    CHECK_NEAR(rows[k].energy.Total(),
      rows[k - 1].energy.Total() + rows[k].localChange + rows[k].globalChange,
      1e-11 * report.loop.restEnergy + report.loop.negligible, what << ": columns of row " << k);
  }
}

/// The corrected form on every mesh: every step lowers E, with and without acceleration.
void TestDescent()
{
  for (const Named& named : AllMeshes())
  {
    for (const double lambda : { 0.1, 1.0, 5.0 })
    {
      for (const bool acceleration : { false, true })
      {
        std::ostringstream what;
        what << named.name << ", lambda " << lambda << ", acceleration " << acceleration;
        NonlinearFeature feature;
        NonlinearOptions options = Fixed(lambda, 30, CenterConstraint::Corrected);
        options.loop.acceleration = acceleration;
        const StyleReport report = Run(feature, named.mesh, options);
        const Rises rises = CountRises(report.loop);
        CHECK(report.loop.iterations == 30 &&
            rises.iterations + rises.localSteps + rises.globalSteps == 0,
          what.str() << ": E rises in " << rises.iterations << " iterations, " << rises.localSteps
                     << " local and " << rises.globalSteps << " global steps");
        CheckHistory(report, what.str());
        const VectorXd s = feature.GetScales();
        CHECK(s.allFinite() && s.minCoeff() >= 0.0, what.str() << ": least s " << s.minCoeff());
        CHECK_NEAR(feature.GetCellEnergies().sum(), report.loop.history.back().energy.Total(),
          1e-10 * report.loop.restEnergy + report.loop.negligible,
          what.str() << ": sum of the cell energies");
        CHECK(feature.GetNumberOfAnalyses() == 1 && feature.GetNumberOfFactorizations() == 30,
          what.str() << ": " << feature.GetNumberOfAnalyses() << " symbolic and "
                     << feature.GetNumberOfFactorizations() << " numeric factorizations");
      }
    }
  }
}

/// E has a lower bound for negative w too: 2 x^T L_w x >= 0 outweighs what is linear in x.
void TestLowerBound()
{
  for (const Named& named :
    { Named{ "obtuse house", Meshes::House(13) }, Named{ "slivers", Meshes::Slivers() } })
  {
    RandomState x(named.mesh);
    const BruteForce brute(named.mesh);
    CHECK(brute.Weights.minCoeff() < -1e-3, named.name << " should have negative weights");
    Eigen::MatrixXd L = -brute.Weights;
    L.diagonal() = brute.Weights.rowwise().sum();
    const VectorXd eigenvalues = Dense::Eigenvalues(L);
    CHECK(eigenvalues(0) > -1e-12 * eigenvalues.maxCoeff() && eigenvalues(1) > 1e-6,
      named.name << ": eigenvalues of L_w begin with " << eigenvalues(0) << ", " << eigenvalues(1));

    NonlinearFeature feature;
    NonlinearOptions options = Fixed(0.01, 300, CenterConstraint::Corrected);
    const StyleReport report = Run(feature, named.mesh, options);
    CHECK(std::isfinite(report.loop.history.back().energy.Total()) &&
        CountRises(report.loop).iterations == 0,
      named.name << ": 300 iterations should go down to a finite energy");
    const std::vector<HistoryRow>& rows = report.loop.history;
    const double last = rows[299].energy.Total() - rows[300].energy.Total();
    CHECK(last < 1e-3 * (rows[0].energy.Total() - rows[300].energy.Total()),
      named.name << ": still falls by " << last << " per iteration");
  }
}

/// Both forms against a dense solve of their equations from the same rotations and scales.
void TestGlobalStep()
{
  const TriangleMesh mesh = Meshes::House();
  const int n = static_cast<int>(mesh.P.rows());
  for (const CenterConstraint constraint :
    { CenterConstraint::Corrected, CenterConstraint::AsWritten })
  {
    NonlinearFeature feature;
    const double lambda = 0.7;
    const StyleReport report = Run(feature, mesh, Fixed(lambda, 3, constraint));
    const Frame frame = { report.sphere.center.transpose(), report.sphere.radius };
    TriangleMesh unit = mesh;
    unit.P = frame.Into(mesh.P);
    RandomState x(unit);
    const BruteForce brute(unit);
    x.Energy = NonlinearEnergy(x.Rings, unit.P, x.Normals, VectorXd::Constant(n, lambda), 1);
    x.R = feature.GetRotations();
    x.S = feature.GetScales() * frame.scale;
    x.Q = frame.Into(feature.GetPositions());
    const double size = Gradient(RandomState(unit), brute).norm();
    const Points gradient = Gradient(x, brute);
    if (constraint == CenterConstraint::Corrected)
    {
      CHECK_NEAR(gradient.norm(), 0.0, 1e-11 * size, "gradient after the corrected global step");
      continue;
    }
    // As written: the equations of all points but the last hold, and the mean is o.
    CHECK_NEAR(gradient.topRows(n - 1).norm(), 0.0, 1e-10 * size, "Eq. 3.37, rows 1 to n - 1");
    CHECK(gradient.row(n - 1).norm() > 1e-3 * size, "Eq. 3.37: the dropped row should not hold");
    CHECK_NEAR(x.Q.colwise().sum().norm(), 0.0, 1e-10, "Eq. 3.42: the mean");
    // A8.3: the least energy among points of mean o has equal gradients at all points.
    const double written = x.Energy.Evaluate(x.Q, x.R, x.S).Total();
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + 1, n + 1);
    A.topLeftCorner(n, n) = -2.0 * brute.Weights;
    A.topLeftCorner(n, n).diagonal() = 2.0 * brute.Weights.rowwise().sum() + x.Energy.Diagonal(x.S);
    A.col(n).head(n).setOnes();
    A.row(n).head(n).setOnes();
    Points b;
    x.Energy.RightHandSide(x.R, x.S, b);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n + 1, 3);
    right.topRows(n) = b;
    x.Q = Dense::Solve(A, right).topRows(n);
    const double constrained = x.Energy.Evaluate(x.Q, x.R, x.S).Total();
    CHECK_NEAR(x.Q.colwise().sum().norm(), 0.0, 1e-10, "the constrained minimizer's mean");
    CHECK(constrained < 0.99 * written,
      "the constrained minimum " << constrained << " should lie below what Eq. 3.37 finds, "
                                 << written);
  }
}

/// A3.13: as written E rises on the house, and not on go stone and box.
void TestAsWritten()
{
  for (const double lambda : { 0.1, 1.0, 5.0 })
  {
    for (const Named& named : { Named{ "go stone", GoStone() }, Named{ "box", Meshes::Box(8) },
           Named{ "house", Meshes::House() } })
    {
      NonlinearFeature feature;
      const StyleReport report =
        Run(feature, named.mesh, Fixed(lambda, 30, CenterConstraint::AsWritten));
      const Rises rises = CountRises(report.loop);
      std::cout << "as written, " << named.name << ", lambda " << lambda << ": rises in "
                << rises.globalSteps << " global steps, " << rises.iterations << " totals of 30\n";
      CheckHistory(report, named.name);
      if (named.name == "house")
      {
        CHECK(rises.globalSteps >= 20, named.name << ": " << rises.globalSteps << " global rises");
      }
      else
      {
        CHECK(rises.globalSteps + rises.iterations == 0, named.name << " should not rise");
      }
      CHECK(std::isnan(report.loop.history.back().gap), "no gap is known as written");
      CHECK(feature.GetNumberOfAnalyses() == 30 && feature.GetNumberOfFactorizations() == 30,
        named.name << ": as written each of 30 iterations should factor anew, not "
                   << feature.GetNumberOfFactorizations());
    }
  }
  // No gap rule as written: Converged means Eq. 3.46.
  NonlinearFeature feature;
  NonlinearOptions options;
  options.centerConstraint = CenterConstraint::AsWritten;
  const StyleReport report = Run(feature, GoStone(), options);
  const std::vector<HistoryRow>& rows = report.loop.history;
  CHECK(
    report.loop.converged && rows.back().residual < 1e-3 && rows[rows.size() - 2].residual >= 1e-3,
    "as written the loop should end at the first residual below .001");
}

//------------------------------------------------------------------------------------------------
void TestInvariance()
{
  const TriangleMesh mesh = Meshes::House(13);
  const Matrix3d turn = Eigen::AngleAxisd(0.8, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  for (const CenterConstraint constraint :
    { CenterConstraint::Corrected, CenterConstraint::AsWritten })
  {
    NonlinearFeature reference;
    const NonlinearOptions options = Fixed(0.5, 10, constraint);
    const StyleReport report = Run(reference, mesh, options);
    const double diagonal = Meshes::Diagonal(mesh.P);
    for (const double scale : { 1e-6, 1.0, 1e6 })
    {
      const Eigen::RowVector3d move = scale * Eigen::RowVector3d(3.0, -2.0, 5.0);
      TriangleMesh moved = mesh;
      moved.P = (scale * mesh.P * turn.transpose()).rowwise() + move;
      NonlinearFeature feature;
      const StyleReport other = Run(feature, moved, options);
      const Points back = (feature.GetPositions().rowwise() - move) * turn / scale;
      CHECK_NEAR(Meshes::Distance(back, reference.GetPositions()), 0.0, 1e-9 * diagonal,
        "positions of a copy of size " << scale);
      CHECK_NEAR((feature.GetScales() * scale - reference.GetScales()).norm(), 0.0,
        1e-9 * reference.GetScales().norm(), "s is 1 / length, size " << scale);
      CHECK_NEAR(other.loop.history.back().energy.Total() / (scale * scale),
        report.loop.history.back().energy.Total(), 1e-9 * report.loop.restEnergy,
        "energy is length^2, size " << scale);
      CHECK_NEAR(other.sphere.radius / scale, report.sphere.radius, 1e-12 * diagonal, "unit");
    }
  }
}

void TestThreads()
{
  const TriangleMesh mesh = Meshes::Perturbed(Meshes::Box(30), 0.01, 3);
  for (const CenterConstraint constraint :
    { CenterConstraint::Corrected, CenterConstraint::AsWritten })
  {
    NonlinearFeature reference;
    NonlinearOptions options = Fixed(0.5, 3, constraint);
    options.loop.acceleration = true;
    Run(reference, mesh, options);
    for (const int threads : { 1, 2, 5 })
    {
      NonlinearFeature feature;
      options.threads = threads;
      Run(feature, mesh, options);
      CHECK(Meshes::SameBits(feature.GetPositions(), reference.GetPositions()),
        threads << " threads give other bits");
    }
  }
}

/// What is kept between solves gives the same result as a fresh start.
void TestReuse()
{
  NonlinearFeature kept;
  NonlinearOptions options;
  Run(kept, Meshes::House(), options);
  CHECK(kept.GetNumberOfAnalyses() == 1, "one symbolic factorization for a mesh");
  for (const double lambda : { 0.1, 2.0 })
  {
    for (const double stretch : { 1.0, 1.3 })
    {
      const TriangleMesh mesh = Meshes::Scaled(Meshes::House(), { 1.0, stretch, 1.0 });
      options.lambda = lambda;
      NonlinearFeature fresh;
      Run(fresh, mesh, options);
      Run(kept, mesh, options);
      CHECK(Meshes::SameBits(kept.GetPositions(), fresh.GetPositions()),
        "lambda " << lambda << ", stretch " << stretch << ": a kept solver differs");
    }
  }
  CHECK(kept.GetNumberOfAnalyses() == 1, "lambda and points keep the symbolic factorization");
  Run(kept, Meshes::Box(3), options);
  CHECK(kept.GetNumberOfAnalyses() == 1, "other triangles are analyzed anew");
}

//------------------------------------------------------------------------------------------------
/// Where the pull vanishes the matrix has to stay positive definite, and nothing may be NaN.
void TestNoPull()
{
  const TriangleMesh mesh = Meshes::TwoComponents();
  const int n = static_cast<int>(mesh.P.rows());
  const double diagonal = Meshes::Diagonal(mesh.P);
  {
    NonlinearFeature feature;
    Run(feature, mesh, Fixed(0.0, 5, CenterConstraint::Corrected));
    CHECK_NEAR(Meshes::Distance(feature.GetPositions(), mesh.P), 0.0, 1e-12 * diagonal,
      "lambda 0 should leave the model");
    NonlinearOptions options;
    options.lambda = 0.0;
    const StyleReport report = feature.Solve(options);
    CHECK(report.loop.converged && report.loop.iterations == 0, "lambda 0: nothing to do");
  }
  const auto descends = [&](const NonlinearOptions& options, const char* what)
  {
    NonlinearFeature feature;
    const StyleReport report = Run(feature, mesh, options);
    CHECK(feature.GetPositions().allFinite() && feature.GetScales().allFinite() &&
        feature.GetScales().minCoeff() >= 0.0,
      what << ": finite, and s not negative");
    const Rises rises = CountRises(report.loop);
    CHECK(rises.iterations + rises.globalSteps + rises.localSteps == 0, what << ": E rises");
    CHECK(feature.HasInwardNormals() == (std::string(what) == "normals inward"),
      what << ": which way the normals point");
    return feature.GetScales();
  };
  NonlinearOptions options = Fixed(1.0, 20, CenterConstraint::Corrected);
  options.normals = Points::Zero(n, 3);
  CHECK(descends(options, "no normals").maxCoeff() == 0.0, "no normal: no pull, s is 0");
  options.normals = -PointNormals(mesh.P, mesh.F);
  descends(options, "normals inward");
  options.normals.resize(0, 3);
  for (const double lambda : { 1e-300, 1e-14, 1e-9, 1e9 })
  {
    options.lambda = lambda;
    descends(options, "extreme lambda");
  }
  options.lambda = 1.0;
  options.roundnessFactors = VectorXd::Zero(n);
  descends(options, "factors 0");
  options.roundnessFactors(3) = 1.0;
  descends(options, "one point is pulled");
  options.roundnessFactors.resize(0);
  options.centerMode = CenterMode::Custom;
  options.center = mesh.P.row(7).transpose();
  descends(options, "o on a point");
  options.center = Vector3d(50.0, 0.0, 0.0);
  descends(options, "o far outside");
}

/// A sphere with its own normals is the minimum: it stays.
void TestSphereStays()
{
  const TriangleMesh mesh = Meshes::Icosphere(3);
  NonlinearOptions options = Fixed(1.0, 10, CenterConstraint::Corrected);
  options.normals = mesh.P;
  options.centerMode = CenterMode::Custom;
  NonlinearFeature feature;
  const StyleReport report = Run(feature, mesh, options);
  CHECK_NEAR(Meshes::Distance(feature.GetPositions(), mesh.P), 0.0, 1e-12, "a sphere moves");
  CHECK_NEAR(report.loop.restEnergy, 0.0, 1e-20, "Eq. 3.1 of a sphere");
  CHECK_NEAR((feature.GetScales().array() - 1.0).abs().maxCoeff(), 0.0, 1e-12, "s is 1 / radius");
}

void TestStopRules()
{
  for (const double lambda : { 0.1, 1.0 })
  {
    NonlinearOptions options;
    options.lambda = lambda;
    options.loop.maximumNumberOfIterations = 4000;
    options.loop.tolerance = 1e-6;
    options.loop.acceleration = false;
    NonlinearFeature feature;
    const StyleReport plain = Run(feature, GoStone(), options);
    options.loop.acceleration = true;
    const StyleReport fast = feature.Solve(options);
    CHECK(plain.loop.converged && fast.loop.converged, "both should converge");
    CHECK(3 * fast.loop.iterations < plain.loop.iterations,
      "acceleration: " << fast.loop.iterations << " for " << plain.loop.iterations);
    CHECK_NEAR(fast.loop.history.back().energy.Total(), plain.loop.history.back().energy.Total(),
      1e-3 * plain.loop.history.back().energy.Total(), "lambda " << lambda << ": one minimum");
  }
  NonlinearOptions options;
  NonlinearFeature feature;
  feature.SetMesh(GoStone());
  const StyleReport aborted =
    feature.Solve(options, [](int iteration, double) { return iteration < 3; });
  CHECK(aborted.loop.aborted && aborted.loop.iterations == 3, "the callback should end the loop");
}

/// |A - c B Rot - move| over |A| for the best c, rotation and move.
double ProcrustesDistance(Points A, Points B)
{
  A.rowwise() -= A.colwise().mean().eval();
  B.rowwise() -= B.colwise().mean().eval();
  A /= A.norm();
  B /= B.norm();
  const Eigen::JacobiSVD<Matrix3d> svd(A.transpose() * B);
  const double overlap = svd.singularValues().sum();
  return std::sqrt(std::max(0.0, 1.0 - overlap * overlap));
}

/// Mean curvature at point i, signed: positive where convex. sum_j w_ij (p_i - p_j) . outward,
/// over the area of the point.
double MeanCurvature(const Points& Q, const Triangles& F, int i, const Vector3d& outward)
{
  const MeshTopology topology(F, static_cast<int>(Q.rows()));
  const OneRings rings(topology, HalfEdgeCotangents(Q, F));
  Vector3d sum = Vector3d::Zero();
  for (const OneRings::Neighbor& j : rings[i])
  {
    sum += j.weight * (Q.row(i) - Q.row(j.point)).transpose();
  }
  return 0.5 * sum.dot(outward) / PointAreas(Q, F)(i);
}

/// Fig. 3.2 and section 3.6 on the go stone. After 30 iterations the poles are hollow, as printed,
/// and the stone is the larger the larger lambda. Neither is a property of the minimum: there the
/// poles bulge more than at rest, the stone is taller than wide, and with lambda the shape goes to
/// a limit.
void TestGoStone()
{
  const TriangleMesh mesh = GoStone();
  const auto poles = [&](const Points& Q)
  {
    const int north = static_cast<int>(mesh.P.rows()) - 2;
    return std::array<double, 2>{ MeanCurvature(Q, mesh.F, north, Vector3d::UnitZ()),
      MeanCurvature(Q, mesh.F, north + 1, -Vector3d::UnitZ()) };
  };
  const double rest = poles(mesh.P)[0];
  CHECK(rest > 0.0, "the poles at rest are convex");
  std::vector<Points> after30, converged;
  for (const double lambda : { 1.0, 5.0, 20.0 })
  {
    NonlinearFeature feature;
    Run(feature, mesh, Fixed(lambda, 30, CenterConstraint::Corrected));
    after30.push_back(feature.GetPositions());
    NonlinearOptions options;
    options.lambda = lambda;
    options.loop.tolerance = 1e-8;
    options.loop.maximumNumberOfIterations = 5000;
    CHECK(feature.Solve(options).loop.converged, "lambda " << lambda << " should converge");
    converged.push_back(feature.GetPositions());
    const auto early = poles(after30.back()), late = poles(converged.back());
    std::cout << "go stone, lambda " << lambda << ": mean curvature at the poles, rest " << rest
              << ", after 30 iterations " << early[0] << ", converged " << late[0]
              << "; diagonal, rest " << Meshes::Diagonal(mesh.P) << ", after 30 "
              << Meshes::Diagonal(after30.back()) << ", converged "
              << Meshes::Diagonal(converged.back()) << "\n";
    // Points of like normals are asked to lie in like directions from o: the flat sides go outward.
    const Eigen::RowVector3d size =
      converged.back().colwise().maxCoeff() - converged.back().colwise().minCoeff();
    CHECK(size(2) > 1.1 * size(0), "the flat stone should become a tall egg, its size is " << size);
    CHECK(early[0] < 0.0 && early[1] < 0.0, "poles after 30 iterations should be hollow");
    CHECK(late[0] > rest && late[1] > rest, "poles of the minimum should bulge");
  }
  for (const auto* results : { &after30, &converged })
  {
    const double first = ProcrustesDistance((*results)[0], (*results)[1]);
    const double second = ProcrustesDistance((*results)[1], (*results)[2]);
    std::cout << "shape without size, lambda 1 against 5: " << first << ", 5 against 20: " << second
              << "\n";
    CHECK(second < 0.6 * first, "the shape should change less and less with lambda");
  }
  CHECK(ProcrustesDistance(converged[1], converged[2]) < 0.05, "lambda 5 and 20 differ in shape");
  for (int k = 0; k < 2; ++k)
  {
    CHECK(Meshes::Diagonal(after30[k]) < Meshes::Diagonal(after30[k + 1]),
      "after 30 iterations a larger lambda should give a larger stone");
  }
}

void TestErrors()
{
  const TriangleMesh mesh = Meshes::Box(3);
  const int n = static_cast<int>(mesh.P.rows());
  NonlinearFeature feature;
  CHECK_THROWS(std::invalid_argument, feature.Solve({}), "no mesh");
  CHECK_THROWS(std::invalid_argument, feature.SetMesh({ mesh.P, Triangles(0, 3) }), "no triangle");
  feature.SetMesh(mesh);
  const auto with = [](const auto& change)
  {
    NonlinearOptions options;
    change(options);
    return options;
  };
  CHECK_THROWS(std::invalid_argument,
    feature.Solve(with([](NonlinearOptions& o) { o.lambda = -1.0; })), "lambda");
  CHECK_THROWS(std::invalid_argument,
    feature.Solve(with([](NonlinearOptions& o) { o.lambda = std::nan(""); })), "lambda");
  CHECK_THROWS(std::invalid_argument,
    feature.Solve(with([](NonlinearOptions& o) { o.loop.tolerance = 0.0; })), "tolerance");
  CHECK_THROWS(std::invalid_argument,
    feature.Solve(with([](NonlinearOptions& o) { o.loop.maximumNumberOfIterations = -1; })),
    "iterations");
  CHECK_THROWS(std::invalid_argument,
    feature.Solve(with([n](NonlinearOptions& o) { o.roundnessFactors = VectorXd::Ones(n - 1); })),
    "factor");
  CHECK_THROWS(std::invalid_argument,
    feature.Solve(with([n](NonlinearOptions& o) { o.normals = Points::Zero(n + 1, 3); })),
    "normal");
  feature.SetMesh(Meshes::EllipsoidUV(2000, 2));
  NonlinearOptions options;
  options.centerConstraint = CenterConstraint::AsWritten;
  CHECK_THROWS(std::invalid_argument, feature.Solve(options), "AsWritten");
}
}

int main()
{
  TestEnergy();
  TestGradients();
  TestDescent();
  TestLowerBound();
  TestGlobalStep();
  TestAsWritten();
  TestInvariance();
  TestThreads();
  TestReuse();
  TestNoPull();
  TestSphereStays();
  TestStopRules();
  TestGoStone();
  TestErrors();
  return CheckResult();
}
