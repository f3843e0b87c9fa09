// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The linear system by each of its methods, against known solutions; what is chosen when; and whole
// solves by each method against the exact one.
#include "Check.h"
#include "LinearSystem.h"
#include "Meshes.h"
#include "StyleSolver.h"

#include <algorithm>
#include <cmath>

using namespace SphericalStyle;
using Rows = LinearSystem::RightHandSides;

namespace
{
/// The matrix of springs between neighbors on a square grid, and of one weak or strong spring from
/// each point to its place. @param anisotropy  of the springs along one direction
LinearSystem::Matrix Grid(int side, double hold, double anisotropy = 1.0)
{
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int a, int b, double k)
  {
    entries.emplace_back(a, a, k);
    entries.emplace_back(b, b, k);
    entries.emplace_back(std::max(a, b), std::min(a, b), -k);
  };
  for (int i = 0; i < side * side; ++i)
  {
    entries.emplace_back(i, i, hold);
    if ((i + 1) % side != 0)
    {
      add(i, i + 1, anisotropy);
    }
    if (i + side < side * side)
    {
      add(i, i + side, 1.0);
    }
  }
  LinearSystem::Matrix A(side * side, side * side);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

Rows RandomRows(Eigen::Index n, int seed)
{
  Meshes::Random random(seed);
  Rows x(n, 3);
  for (Eigen::Index i = 0; i < n; ++i)
  {
    x.row(i) = random.InCube();
  }
  return x;
}

/// Relative, in the norm of A, squared: the share of the energy that is left.
double ShareLeft(const LinearSystem::Matrix& A, const Rows& X, const Rows& from, const Rows& exact)
{
  const auto energy = [&](const Rows& d)
  { return d.cwiseProduct(Rows(A.selfadjointView<Eigen::Lower>() * d)).sum(); };
  return energy(X - exact) / energy(from - exact);
}

std::string Solve(
  LinearSystem& system, const LinearSystem::Matrix& A, const Rows& B, Rows& X, int threads = 1)
{
  system.Analyze(A);
  system.Factor(A, threads);
  system.Solve(B, X, threads);
  return system.GetName();
}

void TestMethods()
{
  const LinearSystem::Matrix A = Grid(60, 0.01);
  const Rows exact = RandomRows(A.rows(), 1);
  const Rows B = A.selfadjointView<Eigen::Lower>() * exact;
  const Rows guess = exact + 0.1 * RandomRows(A.rows(), 2);
  const auto left = [&](LinearMethod method, double share, std::string& name)
  {
    LinearSystem system(method);
    system.SetShareLeft(share);
    Rows X = guess;
    name = Solve(system, A, B, X);
    return ShareLeft(A, X, guess, exact);
  };
  std::string name;
  CHECK(left(LinearMethod::Factor, 0.01, name) <= 1e-24, "a factor should be exact");
  CHECK(name == SparseCholesky().GetName(), "it should be named, not " << name);
  const double once = left(LinearMethod::SingleFactor, 0.01, name);
  const double twice = left(LinearMethod::SingleFactor, 1e-15, name);
  CHECK(once > 0.0 && once <= 1e-8, "one correction in single precision leaves " << once);
  CHECK(twice <= 1e-2 * once, "two should leave less than " << once << ", not " << twice);
  CHECK(name.find("single") != std::string::npos, "single precision should be named: " << name);
  for (const double share : { 0.1, 0.01, 1e-4, 1e-8, 1e-12 })
  {
    const double rest = left(LinearMethod::ConjugateGradients, share, name);
    CHECK(rest <= 3.0 * share, "of share " << share << " conjugate gradients left " << rest);
    CHECK(rest > 0.0, "conjugate gradients end when that is reached, not exactly");
  }
  CHECK(name.find("conjugate") != std::string::npos, "they should be named: " << name);
}

/// From the solution there is nothing to do, and nothing may go wrong.
void TestFromTheSolution()
{
  const LinearSystem::Matrix A = Grid(40, 0.01);
  const Rows exact = RandomRows(A.rows(), 3);
  const Rows B = A.selfadjointView<Eigen::Lower>() * exact;
  for (const LinearMethod method :
    { LinearMethod::Factor, LinearMethod::SingleFactor, LinearMethod::ConjugateGradients })
  {
    LinearSystem system(method);
    Rows X = exact;
    const std::string name = Solve(system, A, B, X);
    CHECK((X - exact).cwiseAbs().maxCoeff() <= 1e-12, name << " should stay at the solution");
    CHECK(system.GetNumberOfSteps() <= 20, name << " took " << system.GetNumberOfSteps());
    Rows zero = Rows::Zero(A.rows(), 3);
    system.Solve(zero, zero);
    CHECK(zero.cwiseAbs().maxCoeff() == 0.0, name << " should give 0 for 0");
  }
}

void TestThreads()
{
  const LinearSystem::Matrix A = Grid(150, 0.01);
  const Rows B = RandomRows(A.rows(), 4);
  for (const LinearMethod method :
    { LinearMethod::Factor, LinearMethod::SingleFactor, LinearMethod::ConjugateGradients })
  {
    Rows first = Rows::Zero(A.rows(), 3);
    LinearSystem one(method);
    const std::string name = Solve(one, A, B, first, 1);
    for (const int threads : { 2, 5 })
    {
      Rows X = Rows::Zero(A.rows(), 3);
      LinearSystem system(method);
      Solve(system, A, B, X, threads);
      CHECK(X == first, name << ": " << threads << " threads should give the same bits as one");
    }
  }
}

void TestChoice()
{
  const auto name = [](int side, double largestFactor, double hold, double anisotropy)
  {
    LinearSystem system;
    if (largestFactor >= 0.0)
    {
      system.SetLargestFactor(largestFactor);
    }
    const LinearSystem::Matrix A = Grid(side, hold, anisotropy);
    const Rows B = RandomRows(A.rows(), 5);
    Rows X = Rows::Zero(A.rows(), 3);
    std::string used = Solve(system, A, B, X);
    const Rows left = B - A.selfadjointView<Eigen::Lower>() * X;
    CHECK(left.norm() <= 0.1 * B.norm(), used << " leaves " << left.norm() / B.norm());
    return used;
  };
  const std::string exact = SparseCholesky().GetName();
  CHECK(name(100, -1.0, 0.01, 1.0) == exact, "few rows should be factored in double precision");
  CHECK(name(150, -1.0, 0.01, 1.0) != exact, "many rows in single precision");
  CHECK(name(150, -1.0, 1e-9, 1e7) == exact, "but not where that has no digits");
  CHECK(name(100, 1000.0, 0.01, 1.0).find("conjugate") != std::string::npos,
    "a factor that does not fit should not be made");
}

/// Lengths far beyond the exponents of single precision make no difference.
void TestRange()
{
  const LinearSystem::Matrix A = Grid(40, 0.01);
  const Rows exact = RandomRows(A.rows(), 8);
  const Rows B = A.selfadjointView<Eigen::Lower>() * exact;
  for (const LinearMethod method :
    { LinearMethod::Factor, LinearMethod::SingleFactor, LinearMethod::ConjugateGradients })
  {
    for (const double size : { 1e-150, 1e-60, 1.0, 1e60, 1e150 })
    {
      LinearSystem system(method);
      system.SetShareLeft(1e-20);
      Rows X = Rows::Zero(A.rows(), 3);
      Solve(system, A, size * B, X);
      CHECK((X / size - exact).cwiseAbs().maxCoeff() <= 1e-9,
        system.GetName() << ", size " << size << ": off by "
                         << (X / size - exact).cwiseAbs().maxCoeff());
    }
  }
  LinearSystem system(LinearMethod::SingleFactor);
  for (const double size : { 1e-120, 1e120 })
  {
    Rows X = Rows::Zero(A.rows(), 3);
    const std::string name = Solve(system, size * A, B, X);
    CHECK((size * X - exact).cwiseAbs().maxCoeff() <= 1e-9,
      name << ", matrix of " << size << ": off by " << (size * X - exact).cwiseAbs().maxCoeff());
  }
}

/// Conjugate gradients that end at their limit are counted, and those that do not are not.
void TestLimit()
{
  int unfinished = 0;
  for (const double power : { 0.0, 2.0, 4.0, 8.0 })
  {
    // As slivers make them: the numbers of neighbors differ by many orders.
    LinearSystem::Matrix A = Grid(120, 1e-9);
    Meshes::Random random(3);
    for (int j = 0; j < A.outerSize(); ++j)
    {
      const double k = std::pow(10.0, power * random.InCube().x());
      for (LinearSystem::Matrix::InnerIterator entry(A, j); entry; ++entry)
      {
        if (entry.row() != j)
        {
          A.coeffRef(j, j) += k - 1.0;
          A.coeffRef(entry.row(), entry.row()) += k - 1.0;
          entry.valueRef() = -k;
        }
      }
    }
    const Rows exact = RandomRows(A.rows(), 8);
    const Rows B = A.selfadjointView<Eigen::Lower>() * exact;
    LinearSystem system(LinearMethod::ConjugateGradients);
    system.SetShareLeft(1e-12);
    Rows X = Rows::Zero(A.rows(), 3);
    Solve(system, A, B, X);
    const int limit = ConjugateGradients::LargestNumberOfSteps;
    CHECK((system.GetNumberOfUnfinishedSolves() == 1) == (system.GetNumberOfSteps() == limit),
      system.GetNumberOfUnfinishedSolves() << " unfinished after " << system.GetNumberOfSteps());
    unfinished += system.GetNumberOfUnfinishedSolves();
    system.Factor(A);
    CHECK(system.GetNumberOfUnfinishedSolves() == 0, "a new matrix should begin anew");
    LinearSystem factored(LinearMethod::Factor);
    Solve(factored, A, B, X);
    CHECK(factored.GetNumberOfUnfinishedSolves() == 0, "a factor leaves nothing");
  }
  CHECK(unfinished > 0 && unfinished < 4, unfinished << " of 4 should be unfinished");
}

/// Only with full-edge weights.
void TestIndefinite()
{
  LinearSystem::Matrix A = Grid(30, 0.01);
  A.coeffRef(450, 450) = -1.0;
  const Rows exact = RandomRows(A.rows(), 6);
  const Rows B = A.selfadjointView<Eigen::Lower>() * exact;
  for (const LinearMethod method : { LinearMethod::Automatic, LinearMethod::Factor,
         LinearMethod::SingleFactor, LinearMethod::ConjugateGradients })
  {
    LinearSystem system(method);
    Rows X = Rows::Zero(A.rows(), 3);
    CHECK(Solve(system, A, B, X) == "Eigen LDLT", "an indefinite matrix needs LDLT");
    CHECK((X - exact).cwiseAbs().maxCoeff() <= 1e-8, "and is solved");
  }
  // Where no diagonal tells, the incomplete factor does, or a step.
  int factored = 0;
  int refused = 0;
  for (const double below : { -3.9, -4.0, -4.1, -4.2, -4.5, -6.0, -40.0 })
  {
    LinearSystem::Matrix hidden = Grid(30, 0.01);
    hidden.coeffRef(451, 450) = below;
    LinearSystem system(LinearMethod::ConjugateGradients);
    Rows X = Rows::Zero(hidden.rows(), 3);
    try
    {
      CHECK(Solve(system, hidden, B, X) == "Eigen LDLT", "indefinite with " << below);
      ++factored;
    }
    catch (const SolverError& error)
    {
      CHECK(std::string(error.what()).find("not positive definite") != std::string::npos,
        "the message should tell: " << error.what());
      ++refused;
    }
  }
  CHECK(factored > 0 && refused > 0, factored << " factored, " << refused << " refused");
}

/// What is used for a matrix does not depend on the one before it.
void TestIndefiniteBefore()
{
  const LinearSystem::Matrix good = Grid(30, 0.01);
  LinearSystem::Matrix bad = good;
  bad.coeffRef(450, 450) = -1.0;
  const Rows B = RandomRows(good.rows(), 7);
  for (const LinearMethod method : { LinearMethod::Automatic, LinearMethod::Factor,
         LinearMethod::SingleFactor, LinearMethod::ConjugateGradients })
  {
    LinearSystem fresh(method);
    Rows expected = Rows::Zero(good.rows(), 3);
    const std::string name = Solve(fresh, good, B, expected);
    LinearSystem used(method);
    Rows X = Rows::Zero(good.rows(), 3);
    Solve(used, bad, B, X);
    X.setZero();
    used.Factor(good);
    used.Solve(B, X);
    CHECK(used.GetName() == name, used.GetName() << " should be " << name << " again");
    CHECK(X == expected, name << " should give the same bits after an indefinite matrix");
  }
}

/// Whole solves: single precision gives the energy to 4 digits and points to 1e-5 of the diagonal;
/// conjugate gradients come as near to the minimum as the tolerance says.
void TestSolves()
{
  TriangleMesh mesh = Meshes::Scaled(Meshes::Icosphere(4), { 1.0, 0.6, 0.4 });
  Meshes::Random random(7);
  for (Eigen::Index i = 0; i < mesh.P.rows(); ++i)
  {
    mesh.P.row(i) += 0.004 * random.InCube();
  }
  const double diagonal = (mesh.P.colwise().maxCoeff() - mesh.P.colwise().minCoeff()).norm();
  const auto solve = [&](StyleOptions options, LinearMethod method, Points& Q)
  {
    options.linearMethod = method;
    StyleSolver solver;
    solver.SetMesh(mesh);
    StyleReport report = solver.Solve(options);
    const Rises rises = CountRises(report.loop);
    CHECK(rises.globalSteps == 0 && rises.localSteps == 0,
      report.linearSolver << ": the energy should never rise");
    CHECK(report.loop.converged, report.linearSolver << " should converge");
    Q = solver.GetPositions();
    return report;
  };
  StyleOptions options;
  options.centerMode = CenterMode::AreaCentroid;
  Points exact;
  Points Q;
  const StyleReport reference = solve(options, LinearMethod::Factor, exact);
  const double energy = reference.loop.history.back().energy.Total();
  const StyleReport single = solve(options, LinearMethod::SingleFactor, Q);
  CHECK(std::abs(single.loop.history.back().energy.Total() / energy - 1.0) <= 1e-4,
    "single precision: energy " << single.loop.history.back().energy.Total() << ", " << energy);
  CHECK(Meshes::Distance(Q, exact) <= 1e-5 * diagonal,
    "single precision: points off by " << Meshes::Distance(Q, exact) / diagonal);
  CHECK(single.loop.iterations == reference.loop.iterations, "in as many iterations");

  StyleOptions tight = options;
  tight.loop.tolerance = 1e-9;
  tight.loop.maximumNumberOfIterations = 5000;
  const StyleReport best = solve(tight, LinearMethod::Factor, exact);
  const double least = best.loop.history.back().energy.Total();
  const StyleReport gradients = solve(options, LinearMethod::ConjugateGradients, Q);
  const double gap =
    (gradients.loop.history.back().energy.Total() - least) / (gradients.loop.restEnergy - least);
  CHECK(gap <= 1e-4, "conjugate gradients: gap " << gap);
  CHECK(gradients.linearSolver != reference.linearSolver, "the report should tell them apart");
}
}

int main()
{
  TestMethods();
  TestFromTheSolution();
  TestThreads();
  TestChoice();
  TestRange();
  TestLimit();
  TestIndefinite();
  TestIndefiniteBefore();
  TestSolves();
  return CheckResult();
}
