// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Going on from the last result, and stopping in time: where a solve starts changes how long it
// takes and not where it ends.
#include "Check.h"
#include "Meshes.h"
#include "StyleSolver.h"

#include <algorithm>

using namespace SphericalStyle;

namespace
{
/// Something to iterate on: details on an uneven model.
StyleOptions Details()
{
  StyleOptions o;
  o.detailSize = 0.05;
  o.sphericalWeighting = SphericalWeighting::Cotangent;
  o.initialGuess = InitialGuess::LastResult;
  return o;
}

TriangleMesh Model()
{
  return Meshes::Perturbed(Meshes::Box(8, { 1.0, 0.6, 0.4 }), 0.03, 1);
}

double Last(const StyleReport& report)
{
  return report.loop.history.back().energy.Total();
}

StyleOptions At(StyleOptions o, double x)
{
  o.centerMode = CenterMode::Custom;
  o.custom.center = { x, 0.0, 0.0 };
  return o;
}

/// E* - E_0 of the options, from a solve of its own.
struct Reference
{
  double minimum;
  double whole;

  explicit Reference(const TriangleMesh& mesh, StyleOptions o)
  {
    o.initialGuess = InitialGuess::Blend;
    o.loop.tolerance = 1e-10;
    o.loop.maximumNumberOfIterations = 2000;
    StyleSolver solver;
    solver.SetMesh(mesh);
    const StyleReport report = solver.Solve(o);
    this->minimum = Last(report);
    this->whole = report.loop.restEnergy - this->minimum;
  }
  double Gap(const StyleReport& report) const
  {
    return (Last(report) - this->minimum) / this->whole;
  }
};

void TestDragging()
{
  const TriangleMesh mesh = Model();
  StyleSolver dragged;
  dragged.SetMesh(mesh);
  dragged.Solve(At(Details(), 0.0));
  int warm = 0;
  int cold = 0;
  for (int step = 1; step <= 10; ++step)
  {
    StyleOptions o = At(Details(), 0.02 * step);
    o.lambda = 0.5 + 0.03 * step;
    const StyleReport report = dragged.Solve(o);
    CHECK(!report.factored, "a moved center should not factor");
    const Rises rises = CountRises(report.loop);
    CHECK(
      rises.iterations + rises.localSteps + rises.globalSteps == 0, "the energy should not rise");
    const double gap = Reference(mesh, o).Gap(report);
    CHECK(gap < 1e-4, "step " << step << ": the gap is " << gap);
    warm += report.loop.iterations;
    o.initialGuess = InitialGuess::Blend;
    StyleSolver fresh;
    fresh.SetMesh(mesh);
    const StyleReport blend = fresh.Solve(o);
    cold += blend.loop.iterations;
    CHECK(report.loop.history.front().energy.Total() < blend.loop.history.front().energy.Total(),
      "step " << step << ": the start should lie below the blend");
  }
  std::cout << "10 moved centers: " << warm << " iterations from the last result, " << cold
            << " from the blend" << std::endl;
  CHECK(2 * warm < cold, "going on should take half the iterations at most");
}

/// Far outside, and back: what was turned inside out there must not stay.
void TestBackFromOutside()
{
  const TriangleMesh mesh = Model();
  StyleSolver solver;
  solver.SetMesh(mesh);
  for (const double x : { 5.0, -0.9, 0.0 })
  {
    StyleOptions o = At(Details(), x);
    o.lambda = x == 0.0 ? 0.3 : 20.0;
    const StyleReport report = solver.Solve(o);
    o.initialGuess = InitialGuess::Blend;
    StyleSolver fresh;
    fresh.SetMesh(mesh);
    const StyleReport blend = fresh.Solve(o);
    CHECK(report.loop.history.front().energy.Total() <= blend.loop.history.front().energy.Total(),
      "center at " << x << ": the start should not lie above the blend");
    CHECK(Last(report) <= Last(blend) + 1e-4 * (blend.loop.restEnergy - Last(blend)),
      "center at " << x << ": the result should not lie above that of the blend");
  }
}

/// What there is nothing to go on from, or must not.
void TestSameBitsAsBlend()
{
  const TriangleMesh mesh = Model();
  const auto fresh = [](const TriangleMesh& of, StyleOptions o)
  {
    o.initialGuess = InitialGuess::Blend;
    StyleSolver solver;
    solver.SetMesh(of);
    solver.Solve(o);
    return solver.GetPositions();
  };
  StyleSolver solver;
  const auto same = [&](const TriangleMesh& of, const StyleOptions& o, const char* what)
  {
    solver.SetMesh(of);
    solver.Solve(o);
    CHECK(Meshes::SameBits(solver.GetPositions(), fresh(of, o)),
      what << " should be as from the blend");
  };
  same(mesh, Details(), "the first solve");
  TriangleMesh moved = mesh;
  moved.P.col(2) *= 1.1;
  same(moved, Details(), "other points");
  same(Meshes::House(), Details(), "another mesh");
  StyleOptions fixed = Details();
  fixed.loop.stopRule = StopRule::FixedIterations;
  fixed.loop.maximumNumberOfIterations = 3;
  same(Meshes::House(), fixed, "a fixed number of iterations");
  StyleOptions closed = Details();
  closed.detailSize = 0.0;
  same(Meshes::House(), closed, "the closed form");
  same(Meshes::House(), Details(), "what follows the closed form");
}

void TestTimeBudget()
{
  const TriangleMesh mesh = Model();
  StyleOptions o = Details();
  o.loop.tolerance = 1e-7;
  const Reference reference(mesh, o);
  StyleSolver solver;
  solver.SetMesh(mesh);
  const StyleReport whole = solver.Solve(o);
  CHECK(whole.loop.converged && !whole.loop.outOfTime, "without a budget there is time");
  CHECK(whole.loop.iterations > 5, "there should be something to interrupt");

  StyleSolver hurried;
  hurried.SetMesh(mesh);
  o.loop.timeBudget = 1e-9;
  double before = std::numeric_limits<double>::infinity();
  for (int update = 0; update < 40; ++update)
  {
    const StyleReport report = hurried.Solve(o);
    CHECK(report.loop.iterations == 1 && report.loop.outOfTime && !report.loop.converged,
      "a budget of nothing should end after one iteration");
    CHECK(Last(report) <= before * (1.0 + 1e-12), "the next solve should go on from the last");
    before = Last(report);
  }
  CHECK(before - reference.minimum < 1e-3 * reference.whole,
    "40 updates of one iteration should come near the minimum, the gap is "
      << (before - reference.minimum) / reference.whole);
  o.loop.timeBudget = 1e9;
  CHECK(hurried.Solve(o).loop.converged, "with time it should converge");
  CHECK(ThesisOptions(o).loop.timeBudget == 0.0, "the thesis knows no budget");
}
}

int main()
{
  TestDragging();
  TestBackFromOutside();
  TestSameBitsAsBlend();
  TestTimeBudget();
  return CheckResult();
}
