// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The loop: descent, history, stop rules, and what the result has to be where it is known.
#include "Check.h"
#include "Dense.h"
#include "FixedIterations.h"
#include "Meshes.h"
#include "SphericalStyleMethod.h"
#include "SurfaceMeasures.h"

#include <algorithm>
#include <string>

using namespace SphericalStyle;
using Eigen::Vector3d;

namespace
{
using Meshes::Named;

double WorstRise = 0.0;

void CheckHistory(const StyleReport& report, const std::string& what)
{
  const std::vector<HistoryRow>& rows = report.loop.history;
  CHECK(rows.size() == static_cast<std::size_t>(report.loop.iterations) + 1,
    what << ": " << rows.size() << " rows for " << report.loop.iterations << " iterations");
  for (std::size_t k = 1; k < rows.size(); ++k)
  {
    const double last = rows[k - 1].energy.Total(), now = rows[k].energy.Total();
    WorstRise = std::max(WorstRise, (now - last) / last);
    CHECK(now - last <= 1e-13 * last,
      what << ": the energy rises from " << last << " by " << now - last << " in iteration " << k);
    CHECK(rows[k].iteration == static_cast<int>(k), what << ": rows should be numbered");
    CHECK(rows[k].localChange <= 1e-13 * last,
      what << ": the local step raises the energy by " << rows[k].localChange);
    CHECK(rows[k].globalChange <= 1e-13 * last,
      what << ": the global step raises the energy by " << rows[k].globalChange);
    // Local changes are summed from covariances, so digits are lost against the energy of rest.
    CHECK_NEAR(rows[k].localChange + rows[k].globalChange, now - last,
      1e-12 * (report.loop.restEnergy + last), what + ": local and global change");
    CHECK(rows[k].energy.rigid >= 0.0 && rows[k].energy.spherical >= 0.0,
      what << ": energies should not be negative");
  }
}

void TestDescent()
{
  const std::vector<Named> meshes = { { "ellipsoid", Meshes::EllipsoidUV(16, 9) },
    { "tetrahedron", Meshes::Subdivide(Meshes::Subdivide(Meshes::Tetrahedron())) },
    { "box", Meshes::Box(4) }, { "house", Meshes::House() }, { "patch", Meshes::Patch(8, 0.4) },
    { "two components", Meshes::TwoComponents() }, { "fan", Meshes::NonManifoldFan() },
    { "slivers", Meshes::Slivers() } };
  for (const Named& named : meshes)
  {
    StyleSolver solver;
    solver.SetMesh(named.mesh);
    for (int bits = 0; bits < 16; ++bits)
    {
      const auto bit = [bits](int k) { return ((bits >> k) & 1) != 0; };
      for (const double lambda : { 0.1, 0.5, 5.0 })
      {
        for (const double a : { 0.0, 0.5, 1.0 })
        {
          StyleOptions options;
          options.lambda = lambda;
          options.normalBlend = a;
          options.initialGuess = bit(0) ? InitialGuess::Rest : InitialGuess::Blend;
          options.sphericalWeighting =
            bit(1) ? SphericalWeighting::Cotangent : SphericalWeighting::Uniform;
          options.concaveEdges = bit(2) ? ConcaveEdges::Flip : ConcaveEdges::Keep;
          options = Fixed(options, 25);
          options.loop.acceleration = bit(3);
          std::ostringstream what;
          what << named.name << ", lambda " << lambda << ", a " << a << ", bits " << bits;
          CheckHistory(solver.Solve(options), what.str());
        }
      }
    }
  }
  std::cout << "largest relative rise of the energy " << WorstRise << std::endl;
}

void TestFixedIterations()
{
  StyleSolver solver;
  solver.SetMesh(Meshes::House());
  for (const InitialGuess guess : { InitialGuess::Blend, InitialGuess::Rest })
  {
    for (const int iterations : { 1, 2, 7, 40 })
    {
      StyleOptions options = Fixed({}, iterations);
      options.initialGuess = guess;
      int calls = 0;
      const StyleReport report = solver.Solve(options,
        [&calls](int, double)
        {
          ++calls;
          return true;
        });
      CHECK(report.loop.iterations == iterations && calls == iterations,
        "exactly " << iterations << " iterations should be done, not " << report.loop.iterations
                   << ", with " << calls << " calls");
      CHECK(!report.loop.aborted, "nobody aborted");
    }
  }
}

// Eq. 3.46 from the positions of successive runs.
void TestThesisRule()
{
  for (const Named& named : { Named{ "ellipsoid", Meshes::EllipsoidUV() },
         Named{ "house", Meshes::House() }, Named{ "patch", Meshes::Patch(8, 0.4) } })
  {
    StyleSolver solver;
    solver.SetMesh(named.mesh);
    StyleOptions options;
    options.anchor = Anchor::LastPoint;
    options.initialGuess = InitialGuess::Rest;
    options.loop.acceleration = false;
    options.loop.stopRule = StopRule::Thesis;
    const StyleReport report = solver.Solve(options);
    const int iterations = report.loop.iterations;
    const Points result = solver.GetPositions();
    CHECK(report.loop.converged && iterations > 2 && iterations < 100,
      named.name << ": the thesis' rule should be met, took " << iterations << " iterations");
    Points last = named.mesh.P;
    for (int k = 1; k <= iterations; ++k)
    {
      solver.Solve(Fixed(options, k));
      const Points now = solver.GetPositions();
      const double residual = (now - last).rowwise().squaredNorm().maxCoeff() /
        (now - named.mesh.P).rowwise().squaredNorm().maxCoeff();
      last = now;
      CHECK_NEAR(report.loop.history[k].residual, residual, 1e-9 * residual,
        named.name + ": residual of iteration " + std::to_string(k));
      CHECK((residual < 0.001) == (k == iterations),
        named.name << ": the rule should be met in the last iteration alone, residual " << residual
                   << " in " << k << " of " << iterations);
    }
    CHECK(Meshes::SameBits(result, last),
      named.name << ": the rule should change nothing but the number of iterations");

    // The thesis to the letter.
    MethodOptions odd;
    odd.lambda = 0.3;
    odd.detailSize = 0.1;
    odd.componentCoupling = ComponentCoupling::Stitched;
    odd.sphericalWeighting = SphericalWeighting::Cotangent;
    const MethodOptions thesis = ThesisOptions(odd);
    CHECK(thesis.edgeWeighting == EdgeWeighting::FullEdge && thesis.anchor == Anchor::LastPoint &&
        thesis.componentCoupling == ComponentCoupling::Independent &&
        thesis.initialGuess == InitialGuess::Rest && thesis.detailSize == 0.0 &&
        thesis.sphericalWeighting == SphericalWeighting::Uniform && thesis.lambda == 0.3 &&
        thesis.loop.stopRule == StopRule::Thesis && !thesis.loop.acceleration,
      "ThesisOptions should set every option of the thesis");
  }
}

// The gap that the rule promises against the minimum, found by many more iterations.
void TestConverged()
{
  const std::vector<Named> meshes = { { "ellipsoid", Meshes::Ellipsoid(3) },
    { "perturbed ellipsoid", Meshes::Perturbed(Meshes::Ellipsoid(3), 0.03, 3) },
    { "house", Meshes::House(9) }, { "box", Meshes::Box(8) } };
  double worst = 0.0, least = 1.0;
  for (const Named& named : meshes)
  {
    StyleSolver solver;
    solver.SetMesh(named.mesh);
    for (const double lambda : { 0.1, 0.5, 5.0 })
    {
      for (const double a : { 0.0, 0.5 })
      {
        StyleOptions options;
        options.lambda = lambda;
        options.normalBlend = a;
        for (const InitialGuess guess : { InitialGuess::Blend, InitialGuess::Rest })
        {
          // Local minima may differ with the start (seen for a = 1), so each has its own.
          options.initialGuess = guess;
          StyleOptions exact = Fixed(options, 1500);
          exact.loop.acceleration = true;
          const double minimum = solver.Solve(exact).loop.history.back().energy.Total();
          for (const bool acceleration : { false, true })
          {
            for (const double tolerance : { 1e-3, 1e-4 })
            {
              options.loop.stopRule = StopRule::Converged;
              options.loop.tolerance = tolerance;
              options.loop.acceleration = acceleration;
              options.loop.maximumNumberOfIterations = 2000;
              const StyleReport report = solver.Solve(options);
              std::ostringstream what;
              what << named.name << ", lambda " << lambda << ", a " << a << ", tolerance "
                   << tolerance << (acceleration ? ", accelerated" : ", plain")
                   << (guess == InitialGuess::Rest ? " from rest" : " from the blend");
              CHECK(report.loop.converged,
                what.str() << " should converge, took " << report.loop.iterations << " iterations");
              const double gap = (report.loop.history.back().energy.Total() - minimum) /
                (report.loop.restEnergy - minimum);
              worst = std::max(worst, gap / tolerance);
              least = std::min(least, gap / tolerance);
              CHECK(gap <= 2.0 * tolerance,
                what.str() << ": the energy gap is " << gap << " after " << report.loop.iterations
                           << " iterations, estimated " << report.loop.history.back().gap);
              CHECK(gap >= -1e-9, what.str() << ": the long run should not end above, gap " << gap);
            }
          }
        }
      }
    }
  }
  std::cout << "true gap over tolerance between " << least << " and " << worst << std::endl;

  // Too few iterations: a flag, not an error.
  StyleSolver solver;
  solver.SetMesh(meshes[2].mesh);
  StyleOptions options;
  options.loop.tolerance = 1e-9;
  options.loop.maximumNumberOfIterations = 3;
  const StyleReport report = solver.Solve(options);
  CHECK(!report.loop.converged && report.loop.iterations == 3,
    "three iterations should not converge to 1e-9");
}

// E_k = E* + A q^k and E* + A k^-p: the estimate may be too careful, never too bold.
void TestEstimateGap()
{
  CHECK(std::isnan(EstimateGap({ 1.0 }, 2.0)), "one energy says nothing about the gap");
  const double rounding = 5.0 * (1.0 - 1e-15);
  for (const auto& still :
    { std::vector<double>{ 5.0, 5.0, 5.0, 5.0 }, std::vector<double>{ 5.0, 5.0, 5.0, rounding } })
  {
    CHECK(EstimateGap(still, 5.0) == 0.0, "what began at its minimum has no gap");
  }
  for (const double power : { 1.0, 2.0, 3.0 })
  {
    std::vector<double> energies;
    for (int k = 1; k <= 80; ++k)
    {
      energies.push_back(3.0 + 2.0 * std::pow(k, -power));
      if (k >= 12)
      {
        const double truth = (energies.back() - 3.0) / (5.0 - 3.0);
        const double estimate = EstimateGap(energies, 5.0);
        CHECK(estimate >= truth && estimate <= 6.0 * truth,
          "power " << power << ", " << k << " energies: the gap is " << truth << ", estimated "
                   << estimate);
      }
    }
  }
  for (const double factor : { 0.5, 0.8, 0.95 })
  {
    std::vector<double> energies;
    for (int k = 0; k < 60; ++k)
    {
      energies.push_back(3.0 + 2.0 * std::pow(factor, k));
      const double truth = (energies.back() - 3.0) / (5.0 - 3.0);
      if (k >= 6 && truth > 1e-12)
      {
        const double estimate = EstimateGap(energies, 5.0);
        CHECK(estimate >= truth,
          "factor " << factor << ", " << k << " iterations: the gap is " << truth << ", estimated "
                    << estimate);
      }
    }
  }
}

// Nothing moves but by rounding: that is convergence, and no reason to go on [stop].
void TestNothingMoves()
{
  for (const Named& named :
    { Named{ "house", Meshes::House() }, Named{ "two components", Meshes::TwoComponents() },
      Named{ "patch", Meshes::Patch(8, 0.4) } })
  {
    StyleSolver solver;
    solver.SetMesh(named.mesh);
    for (const StopRule rule : { StopRule::Converged, StopRule::Thesis })
    {
      for (const InitialGuess guess : { InitialGuess::Blend, InitialGuess::Rest })
      {
        for (const SphericalWeighting weighting :
          { SphericalWeighting::Uniform, SphericalWeighting::Cotangent })
        {
          StyleOptions options;
          options.lambda = 0.0;
          options.initialGuess = guess;
          options.sphericalWeighting = weighting;
          options.loop.stopRule = rule;
          const StyleReport report = solver.Solve(options);
          CHECK(report.loop.converged, named.name << ": lambda 0 should be converged");
          CHECK(report.loop.iterations <= 1,
            named.name << (rule == StopRule::Thesis ? ", thesis' rule" : "")
                       << (guess == InitialGuess::Rest ? ", from rest" : "") << ": lambda 0 takes "
                       << report.loop.iterations << " iterations");
          const double moved =
            Meshes::Distance(solver.GetPositions(), named.mesh.P) / Meshes::Diagonal(named.mesh.P);
          CHECK(moved <= 1e-15, named.name << ": lambda 0 moves points by " << moved);
        }
      }
    }
  }
  // A sphere in its own style stays, too: the true sphere given as custom, so that it is at rest.
  const TriangleMesh ball = Meshes::Icosphere(2);
  StyleSolver solver;
  solver.SetMesh(ball);
  for (const InitialGuess guess : { InitialGuess::Blend, InitialGuess::Rest })
  {
    StyleOptions options;
    options.lambda = 2.0;
    options.initialGuess = guess;
    options.centerMode = CenterMode::Custom;
    options.radiusMode = RadiusMode::Custom;
    const StyleReport report = solver.Solve(options);
    CHECK(report.loop.converged, "a sphere should be converged at once");
    CHECK(Meshes::Distance(solver.GetPositions(), ball.P) <= 1e-14,
      "a sphere should stay, moved by " << Meshes::Distance(solver.GetPositions(), ball.P));
  }
}

void TestCallback()
{
  StyleSolver solver;
  solver.SetMesh(Meshes::House());
  StyleOptions options = Fixed({}, 20);
  std::vector<int> numbers;
  const StyleReport report = solver.Solve(options,
    [&numbers](int iteration, double change)
    {
      numbers.push_back(iteration);
      CHECK(std::isfinite(change), "the change given to the callback should be finite");
      return iteration < 3;
    });
  CHECK(report.loop.aborted && !report.loop.converged, "the loop should be aborted");
  CHECK((numbers == std::vector<int>{ 1, 2, 3 }),
    "the callback should be called three times, was " << numbers.size());
  CHECK(
    report.loop.iterations == 3, "three iterations should be done, not " << report.loop.iterations);
  // What is there is the state after the third iteration, and the solver can go on.
  const Points aborted = solver.GetPositions();
  solver.Solve(Fixed({}, 3));
  CHECK(Meshes::SameBits(aborted, solver.GetPositions()),
    "an aborted run should leave the state of its last iteration");
}

// With cotangent weights the minimizer is the blend of the model with the sphere [blend].
void TestClosedForm()
{
  for (const Named& named : { Named{ "ellipsoid", Meshes::Ellipsoid(2) },
         Named{ "box", Meshes::Box(5) }, Named{ "house", Meshes::House() } })
  {
    const int n = named.mesh.P.rows();
    StyleSolver solver;
    solver.SetMesh(named.mesh);
    for (const double lambda : { 0.1, 0.5, 5.0 })
    {
      StyleOptions options;
      options.lambda = lambda;
      options.sphericalWeighting = SphericalWeighting::Cotangent;
      const StyleReport closed = solver.Solve(options);
      std::ostringstream what;
      what << named.name << ", lambda " << lambda;
      CHECK(closed.closedForm && closed.loop.converged,
        what.str() << ": the minimum should be taken from the closed form");

      const double mu = std::sqrt(3.0) * lambda;
      const Vector3d O = closed.sphere.center;
      Points blend =
        (named.mesh.P +
          mu * ((closed.sphere.radius * solver.GetDirections()).rowwise() + O.transpose())) /
        (1.0 + mu);
      const Eigen::VectorXd areas = PointAreas(named.mesh.P, named.mesh.F);
      blend.rowwise() += areas.transpose() * (named.mesh.P - blend) / areas.sum();
      CHECK(
        Meshes::Distance(blend, solver.GetPositions()) <= 1e-13 * Meshes::Diagonal(named.mesh.P),
        what.str() << ": the positions should be the blend, differ by "
                   << Meshes::Distance(blend, solver.GetPositions()));
      for (const Eigen::Matrix3d& R : solver.GetRotations())
      {
        CHECK((R - Eigen::Matrix3d::Identity()).norm() <= 1e-13,
          what.str() << ": rotations of the blend should be the identity");
      }
      const Points closedPositions = solver.GetPositions();
      const double energy = solver.GetCellEnergies().sum();
      CHECK_NEAR(closed.loop.history.back().energy.Total(), energy, 1e-12 * energy,
        what.str() + ": energy of the blend in the history");

      // The loop, from the rest shape, finds nothing lower and gets there.
      options.initialGuess = InitialGuess::Rest;
      options.loop.tolerance = 1e-12;
      options.loop.maximumNumberOfIterations = 5000;
      const StyleReport iterated = solver.Solve(options);
      CHECK(!iterated.closedForm, what.str() << ": the start from rest should be iterated");
      const double reached = iterated.loop.history.back().energy.Total();
      CHECK_NEAR(reached, energy, 1e-8 * energy,
        what.str() + ": energy from rest after " + std::to_string(iterated.loop.iterations) +
          " iterations, against the blend's");
      CHECK(reached >= energy * (1.0 - 1e-12), what.str() << ": nothing is below the minimum");

      // Plain iterations stay where the closed form put them.
      options.initialGuess = InitialGuess::Blend;
      solver.Solve(Fixed(options, 5));
      CHECK(Meshes::Distance(solver.GetPositions(), closedPositions) <=
          1e-12 * Meshes::Diagonal(named.mesh.P),
        what.str() << ": iterations should not leave the closed form");
    }
    // Not where its condition fails.
    StyleOptions options;
    options.sphericalWeighting = SphericalWeighting::Cotangent;
    options.fixedPoints = { 0 };
    options.fixedPositions = 1.1 * named.mesh.P.row(0);
    CHECK(!solver.Solve(options).closedForm || n == 0,
      named.name << ": a pinned point is not the blend");
    options.fixedPoints.clear();
    options.fixedPositions.resize(0, 3);
    options.roundnessFactors = named.mesh.P.col(0).cwiseAbs();
    CHECK(!solver.Solve(options).closedForm,
      named.name << ": roundness that differs from point to point is not the blend");
  }
}

// lambda to infinity: a ball of radius r (A4.7).
void TestLargeLambda()
{
  for (const Named& named : { Named{ "ellipsoid", Meshes::Ellipsoid(3) },
         Named{ "box", Meshes::Box(8) }, Named{ "house", Meshes::House(9) } })
  {
    for (const SphericalWeighting weighting :
      { SphericalWeighting::Uniform, SphericalWeighting::Cotangent })
    {
      StyleSolver solver;
      solver.SetMesh(named.mesh);
      StyleOptions options;
      options.lambda = 50.0;
      options.sphericalWeighting = weighting;
      options.loop.tolerance = 1e-8;
      options.loop.maximumNumberOfIterations = 2000;
      const StyleReport report = solver.Solve(options);
      const Points& Q = solver.GetPositions();
      // Least-squares sphere |q|^2 - 2 q.c = R^2 - |c|^2.
      Eigen::MatrixXd A(Q.rows(), 4);
      A << 2.0 * Q, Eigen::VectorXd::Ones(Q.rows());
      const Eigen::VectorXd right = Q.rowwise().squaredNorm();
      const Eigen::Vector4d x = Dense::Solve(A, right);
      const Vector3d center = x.head<3>();
      const double radius = std::sqrt(x[3] + center.squaredNorm());
      const double spread = RadiusSpread(Q, center);
      std::cout << named.name
                << ", lambda 50: fitted radius / r = " << radius / report.sphere.radius
                << ", spread " << spread << ", was "
                << RadiusSpread(named.mesh.P, report.sphere.center) << std::endl;
      CHECK_NEAR(radius / report.sphere.radius, 1.0, 0.005, named.name + ": fitted radius over r");
      CHECK(spread <= 0.01, named.name << ": the radius should be even, its spread is " << spread);
    }
  }
}

// A4.14: what is close to O gets rounder; a center outside makes the near face hollow.
void TestCenterStudy()
{
  const TriangleMesh box = Meshes::Box(10);
  StyleSolver solver;
  solver.SetMesh(box);
  std::vector<double> sags;
  for (const double z : { 0.0, 0.6, 0.9, 1.5, 3.0 })
  {
    StyleOptions options;
    options.lambda = 2.0;
    options.centerMode = CenterMode::Custom;
    options.custom.center = { 0, 0, z };
    const StyleReport report = solver.Solve(options);
    const Points& Q = solver.GetPositions();
    double middle = 0.0, rim = 0.0;
    int rimCount = 0;
    for (int i = 0; i < Q.rows(); ++i)
    {
      const Eigen::RowVector3d p = box.P.row(i);
      if (p[2] < 1.0 - 1e-9)
      {
        continue;
      }
      if (p.head<2>().norm() < 1e-9)
      {
        middle = Q(i, 2);
      }
      else if (p.head<2>().cwiseAbs().maxCoeff() > 1.0 - 1e-9)
      {
        rim += Q(i, 2);
        ++rimCount;
      }
    }
    sags.push_back((middle - rim / rimCount) / report.sphere.radius);
    std::cout << "center at z = " << z << ": sag of the top face / r = " << sags.back()
              << std::endl;
  }
  CHECK(sags[0] > 0.0 && sags[1] > sags[0] && sags[2] > sags[1],
    "with O inside the top should bulge, the more the nearer it is");
  CHECK(sags[3] < 0.0 && sags[4] < 0.0, "with O outside the top should be hollow");
  CHECK(sags[4] > sags[3], "the farther O is outside, the less hollow");
}
} // namespace

int main()
{
  TestDescent();
  TestFixedIterations();
  TestThesisRule();
  TestConverged();
  TestEstimateGap();
  TestNothingMoves();
  TestCallback();
  TestClosedForm();
  TestLargeLambda();
  TestCenterStudy();
  return CheckResult();
}
