// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The solver as a whole: what it keeps between solves, what its results must not depend on, and
// what it refuses. Also the two backends of the factorization.
#include "Check.h"
#include "Dense.h"
#include "FixedIterations.h"
#include "Meshes.h"
#include "SphericalStyleMethod.h"
#include "SurfaceMeasures.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <string>

using namespace SphericalStyle;
using Eigen::Vector3d;

namespace
{
using Meshes::Named;

TriangleMesh House()
{
  return Meshes::Perturbed(Meshes::House(), 0.02, 2);
}

// Options that use the whole of the solver, without arrays.
std::vector<std::pair<std::string, StyleOptions>> Styles()
{
  std::vector<std::pair<std::string, StyleOptions>> styles;
  StyleOptions options = Fixed({}, 8);
  styles.push_back({ "directions", options });
  options.normalBlend = 0.4;
  options.concaveEdges = ConcaveEdges::Flip;
  styles.push_back({ "normals, flipped", options });
  options.sphericalWeighting = SphericalWeighting::Cotangent;
  options.centerMode = CenterMode::AreaCentroid;
  styles.push_back({ "cotangent weights", options });
  options = Fixed({}, 8);
  options.initialGuess = InitialGuess::Rest;
  options.lambda = 3.0;
  styles.push_back({ "from rest", options });
  return styles;
}

void TestFactorsKept()
{
  StyleSolver solver;
  solver.SetMesh(House());
  StyleOptions options = Fixed({}, 3);
  const auto factored = [&] { return solver.Solve(options).factored; };
  CHECK(factored(), "the first solve should factor");
  CHECK(!factored(), "the same again should not factor");
  options.centerMode = CenterMode::AreaCentroid;
  CHECK(!factored(), "a new center should not factor");
  options.normalBlend = 0.5;
  CHECK(!factored(), "a new a should not factor");
  options.radiusMode = RadiusMode::Custom;
  options.custom.radius = 0.9;
  CHECK(!factored(), "a new radius should not factor");
  options.concaveEdges = ConcaveEdges::Flip;
  CHECK(!factored(), "flipping edges should not factor");
  options.anchor = Anchor::LastPoint;
  CHECK(!factored(), "a new anchor should not factor");
  options.targets = House().P;
  CHECK(!factored(), "new targets should not factor");
  options.targets.resize(0, 3);
  solver.SetMesh(House());
  CHECK(!factored(), "the same mesh again should not factor");
  options.lambda = 0.6;
  CHECK(factored(), "a new lambda with uniform weights should factor");
  options.edgeWeighting = EdgeWeighting::FullEdge;
  CHECK(factored(), "full edges should factor");
  options.edgeWeighting = EdgeWeighting::HalfEdge;
  CHECK(factored(), "half edges should factor again");
  options.fixedPoints = { 3 };
  options.fixedPositions = House().P.row(3);
  CHECK(factored(), "a fixed point should factor");
  options.fixedPositions(0, 1) += 0.1;
  CHECK(!factored(), "a moved fixed point should not factor");
  options.fixedPoints.clear();
  options.fixedPositions.resize(0, 3);
  options.sphericalWeighting = SphericalWeighting::Cotangent;
  CHECK(factored(), "cotangent weights should factor");
  for (const double lambda : { 0.1, 5.0, 0.0 })
  {
    options.lambda = lambda;
    CHECK(!factored(), "a new lambda with cotangent weights should not factor");
  }
  TriangleMesh moved = House();
  moved.P(4, 0) += 0.1;
  solver.SetMesh(moved);
  CHECK(factored(), "moved points should factor");
}

// A random walk over the options: what is kept must never show.
void TestSequences()
{
  Meshes::Random random(21);
  const TriangleMesh meshes[] = { House(), Meshes::TwoComponents() };
  TriangleMesh mesh = meshes[0];
  StyleSolver solver;
  solver.SetMesh(mesh);
  StyleOptions options;
  const auto pick = [&random](int n) { return static_cast<int>(n * random.Unit()); };
  for (int step = 0; step < 200; ++step)
  {
    const int n = mesh.P.rows();
    switch (pick(15))
    {
      case 0:
        options.lambda = pick(3) == 0 ? 0.0 : 2.0 * random.Unit();
        break;
      case 1:
        options.normalBlend = pick(2) * random.Unit();
        break;
      case 2:
        options.centerMode = static_cast<CenterMode>(pick(3));
        options.custom.center = 0.3 * random.InCube();
        break;
      case 3:
        options.radiusMode = static_cast<RadiusMode>(pick(3));
        options.custom.radius = 0.5 + random.Unit();
        break;
      case 4:
        options.sphericalWeighting = static_cast<SphericalWeighting>(pick(2));
        break;
      case 5:
        options.concaveEdges = static_cast<ConcaveEdges>(pick(3));
        break;
      case 6:
        options.edgeWeighting = static_cast<EdgeWeighting>(pick(3));
        break;
      case 7:
        options.anchor = static_cast<Anchor>(pick(2));
        break;
      case 8:
        options.initialGuess = static_cast<InitialGuess>(pick(2));
        break;
      case 9:
        options.loop.stopRule = static_cast<StopRule>(pick(3));
        options.loop.acceleration = pick(2) == 0;
        options.loop.maximumNumberOfIterations = 1 + pick(10);
        break;
      case 10:
        options.roundnessFactors.resize(pick(2) * n);
        for (double& factor : options.roundnessFactors)
        {
          factor = 2.0 * random.Unit();
        }
        break;
      case 11:
        options.fixedPoints.clear();
        for (int k = pick(4); k > 0; --k)
        {
          options.fixedPoints.push_back(n / 4 * k - 1);
        }
        options.fixedPositions.resize(options.fixedPoints.size(), 3);
        for (std::size_t k = 0; k < options.fixedPoints.size(); ++k)
        {
          options.fixedPositions.row(k) =
            mesh.P.row(options.fixedPoints[k]) + 0.1 * random.InCube().transpose();
        }
        break;
      case 12:
        options.componentCoupling = static_cast<ComponentCoupling>(pick(2));
        break;
      case 13: // the same triangles, other points
        mesh = Meshes::Perturbed(mesh, 0.005, step);
        solver.SetMesh(mesh);
        break;
      default: // another mesh: arrays of the last one do not fit
        mesh = meshes[pick(2)];
        solver.SetMesh(mesh);
        options.roundnessFactors.resize(0);
        options.fixedPoints.clear();
        options.fixedPositions.resize(0, 3);
    }
    StyleSolver fresh;
    fresh.SetMesh(mesh);
    const StyleReport kept = solver.Solve(options), anew = fresh.Solve(options);
    CHECK(Meshes::SameBits(solver.GetPositions(), fresh.GetPositions()),
      "step " << step
              << ": a solver that was used before should give the bits of a fresh one, differs "
              << "by " << Meshes::Distance(solver.GetPositions(), fresh.GetPositions()));
    CHECK(kept.loop.iterations == anew.loop.iterations,
      "step " << step << ": a used solver should take as many iterations as a fresh one");
  }

  // A matrix that is not positive definite leaves the multifrontal factor; the next one must be as
  // if that had never been.
  const TriangleMesh skew = []
  {
    TriangleMesh sheet = Meshes::Perturbed(Meshes::Patch(6, 0.3), 0.02, 8);
    sheet.P.col(0) += 1.6 * sheet.P.col(1);
    return sheet;
  }();
  StyleSolver used, fresh;
  used.SetMesh(skew);
  fresh.SetMesh(skew);
  StyleOptions full = Fixed({}, 5);
  full.lambda = 0.05;
  full.edgeWeighting = EdgeWeighting::FullEdge;
  CHECK(!used.Solve(full).hasMinimum, "the matrix should be indefinite");
  CHECK(used.Solve(Fixed({}, 5)).hasMinimum, "and the next one not");
  fresh.Solve(Fixed({}, 5));
  CHECK(Meshes::SameBits(used.GetPositions(), fresh.GetPositions()),
    "a solve after one with full edges should give the bits of a fresh solver");
}

void CheckSame(
  const Points& result, const Points& expected, double diagonal, const std::string& what)
{
  const double difference = Meshes::Distance(result, expected) / diagonal;
  static double worst = 0.0;
  if (difference > worst && difference <= 1e-9)
  {
    worst = difference;
    std::cout << "invariance: " << what << ": " << worst << " diagonals" << std::endl;
  }
  CHECK(difference <= 1e-9, what << ": differs by " << difference << " diagonals");
}

void TestInvariance()
{
  for (const Named& named :
    { Named{ "house", House() }, Named{ "two components", Meshes::TwoComponents() },
      Named{ "patch", Meshes::Perturbed(Meshes::Patch(8, 0.4), 0.02, 3) },
      Named{ "fan", Meshes::NonManifoldFan() } })
  {
    const TriangleMesh& mesh = named.mesh;
    const int n = mesh.P.rows();
    const double diagonal = Meshes::Diagonal(mesh.P);
    Meshes::Random random(22);
    const Eigen::Matrix3d turn = random.Rotation();
    const std::vector<int> place = random.Permutation(n), order = random.Permutation(mesh.F.rows());
    for (const auto& style : Styles())
    {
      const std::string what = named.name + ", " + style.first;
      const auto solve = [&style](const TriangleMesh& other)
      {
        StyleSolver solver;
        solver.SetMesh(other);
        solver.Solve(style.second);
        return solver.GetPositions();
      };
      const Points expected = solve(mesh);

      TriangleMesh other = mesh;
      const Eigen::RowVector3d shift = 1e3 * diagonal * Eigen::RowVector3d(1.0, -0.7, 0.4);
      other.P.rowwise() += shift;
      CheckSame(solve(other).rowwise() - shift, expected, diagonal, what + ", translated");

      for (const double scale : { 1e-6, 1e6 })
      {
        other.P = scale * mesh.P;
        CheckSame(solve(other) / scale, expected, diagonal, what + ", scaled");
      }
      other.P = 1048576.0 * mesh.P;
      CHECK(Meshes::SameBits(solve(other), 1048576.0 * expected),
        what << ": scaled by a power of two the bits should be the same");

      other.P = mesh.P * turn.transpose();
      CheckSame(solve(other) * turn, expected, diagonal, what + ", rotated");

      for (int i = 0; i < n; ++i)
      {
        other.P.row(place[i]) = mesh.P.row(i);
      }
      for (int f = 0; f < mesh.F.rows(); ++f)
      {
        for (int k = 0; k < 3; ++k)
        {
          other.F(order[f], k) = place[mesh.F(f, (k + f) % 3)]; // corners rotated, too
        }
      }
      const Points permuted = solve(other);
      Points back(n, 3);
      for (int i = 0; i < n; ++i)
      {
        back.row(i) = permuted.row(place[i]);
      }
      CheckSame(back, expected, diagonal, what + ", permuted");
    }
  }

  // Orientation matters through normals only.
  const TriangleMesh mesh = House();
  TriangleMesh insideOut = mesh;
  insideOut.F.col(1).swap(insideOut.F.col(2));
  StyleSolver solver, other;
  solver.SetMesh(mesh);
  other.SetMesh(insideOut);
  StyleOptions options = Fixed({}, 8);
  options.radiusMode = RadiusMode::EqualVolume;
  solver.Solve(options);
  other.Solve(options);
  CheckSame(
    other.GetPositions(), solver.GetPositions(), Meshes::Diagonal(mesh.P), "turned inside out");
}

void TestThreads()
{
  // Enough points that several threads really start.
  const TriangleMesh mesh = Meshes::Perturbed(Meshes::Ellipsoid(5), 0.004, 23);
  CHECK(mesh.P.rows() > 10000, "the mesh should be large");
  for (int style = 0; style < 2; ++style)
  {
    StyleOptions options = Fixed({}, 4);
    options.normalBlend = 0.3 * style;
    options.concaveEdges = style == 1 ? ConcaveEdges::Flip : ConcaveEdges::Keep;
    options.loop.acceleration = style == 1;
    Points expected;
    Eigen::VectorXd cells;
    std::vector<HistoryRow> history;
    for (const int threads : { 1, 1, 2, 3 })
    {
      options.threads = threads;
      StyleSolver solver;
      solver.SetMesh(mesh);
      const StyleReport report = solver.Solve(options);
      if (expected.rows() == 0)
      {
        expected = solver.GetPositions();
        cells = solver.GetCellEnergies();
        history = report.loop.history;
        continue;
      }
      CHECK(Meshes::SameBits(solver.GetPositions(), expected),
        threads << " threads: positions should have the same bits as of the first run");
      CHECK(solver.GetCellEnergies() == cells, threads << " threads: cell energies differ");
      for (std::size_t k = 0; k < history.size(); ++k)
      {
        CHECK(report.loop.history[k].energy.Total() == history[k].energy.Total(),
          threads << " threads: the energy of iteration " << k << " should have the same bits");
      }
    }
  }
}

SparseCholesky::Matrix Lower(const Eigen::MatrixXd& A)
{
  const Eigen::MatrixXd lower = A.triangularView<Eigen::Lower>();
  SparseCholesky::Matrix sparse = lower.sparseView();
  sparse.makeCompressed();
  return sparse;
}

void TestBackends()
{
  Meshes::Random random(24);
  const TriangleMesh mesh = Meshes::Ellipsoid(2);
  const int n = mesh.P.rows();
  const HalfEdgeScalars c = HalfEdgeCotangents(mesh.P, mesh.F);
  Eigen::MatrixXd A = 0.1 * Eigen::MatrixXd::Identity(n, n);
  for (int f = 0; f < mesh.F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int u = mesh.F(f, HalfEdgeStart(k)), v = mesh.F(f, HalfEdgeEnd(k));
      A(u, u) += c(f, k);
      A(v, v) += c(f, k);
      A(u, v) -= c(f, k);
      A(v, u) -= c(f, k);
    }
  }
  // The same pattern, some eigenvalues below zero, none near it.
  Eigen::MatrixXd indefinite = A;
  for (int i = 0; i < n; i += 3)
  {
    indefinite(i, i) -= 9.0;
  }
  const Eigen::VectorXd eigenvalues = Dense::Eigenvalues(indefinite);
  CHECK(
    eigenvalues[0] < -1.0 && eigenvalues[n - 1] > 1.0 && eigenvalues.cwiseAbs().minCoeff() > 1e-2,
    "the second matrix should be indefinite and far from singular");
  SparseCholesky::RightHandSides x(n, 3);
  for (int i = 0; i < n; ++i)
  {
    x.row(i) = random.InCube().transpose();
  }
  double worst = 0.0;
  for (const auto backend :
    { SparseCholesky::Backend::Eigen, SparseCholesky::Backend::Multifrontal })
  {
    SparseCholesky factor(backend);
    factor.Analyze(Lower(A));
    SparseCholesky::RightHandSides first;
    for (const Eigen::MatrixXd& matrix : { A, indefinite, A }) // and back again
    {
      factor.Factor(Lower(matrix));
      SparseCholesky::RightHandSides y = matrix * x;
      factor.Solve(y);
      const double error = (y - x).cwiseAbs().maxCoeff();
      worst = std::max(worst, error);
      CHECK(error <= 1e-12, factor.GetName() << ": the solution is off by " << error);
      if (first.rows() == 0)
      {
        first = y;
      }
    }
    SparseCholesky::RightHandSides again = A * x;
    factor.Solve(again);
    CHECK(again == first, factor.GetName() << ": factoring again should give the same bits");

    // Singular: the Laplacian of a closed chain, whose last pivot is exactly zero.
    const int m = 6;
    Eigen::MatrixXd chain = Eigen::MatrixXd::Zero(m, m);
    for (int i = 0; i < m; ++i)
    {
      chain(i, i) = 2.0;
      chain((i + 1) % m, i) = chain(i, (i + 1) % m) = -1.0;
    }
    const auto solveSingular = [backend](const Eigen::MatrixXd& matrix)
    {
      SparseCholesky singular(backend);
      singular.Analyze(Lower(matrix));
      singular.Factor(Lower(matrix));
      SparseCholesky::RightHandSides b = SparseCholesky::RightHandSides::Random(matrix.rows(), 3);
      singular.Solve(b);
    };
    Eigen::MatrixXd path = chain; // every step of its elimination is exact
    path(0, 0) = path(m - 1, m - 1) = 1.0;
    path(m - 1, 0) = path(0, m - 1) = 0.0;
    CHECK_THROWS(SolverError, solveSingular(path), "singular");
    Eigen::MatrixXd pair(2, 2);
    pair << 1, -1, -1, 1;
    CHECK_THROWS(SolverError, solveSingular(pair), "singular");
  }
  std::cout << "largest error of a solution by any backend " << worst << std::endl;
}

void TestFixedPoints()
{
  const TriangleMesh mesh = House();
  const int n = mesh.P.rows();
  Meshes::Random random(25);
  StyleOptions options;
  options.fixedPoints = { 11, 2, n - 1, 30 };
  options.fixedPositions.resize(4, 3);
  for (int k = 0; k < 4; ++k)
  {
    options.fixedPositions.row(k) =
      mesh.P.row(options.fixedPoints[k]) + 0.1 * random.InCube().transpose();
  }
  for (const double lambda : { 0.0, 0.5, 5.0 })
  {
    for (const InitialGuess guess : { InitialGuess::Blend, InitialGuess::Rest })
    {
      for (const Anchor anchor : { Anchor::Centroid, Anchor::LastPoint })
      {
        options.lambda = lambda;
        options.initialGuess = guess;
        options.anchor = anchor;
        StyleSolver solver;
        solver.SetMesh(mesh);
        solver.Solve(options);
        for (int k = 0; k < 4; ++k)
        {
          CHECK(
            (solver.GetPositions().row(options.fixedPoints[k]) == options.fixedPositions.row(k)),
            "a fixed point should keep its position to the bit");
        }
      }
    }
  }
  // All of them: nothing is left to solve.
  options = {};
  for (int i = 0; i < n; ++i)
  {
    options.fixedPoints.push_back(i);
  }
  options.fixedPositions = 1.25 * mesh.P;
  StyleSolver solver;
  solver.SetMesh(mesh);
  solver.Solve(options);
  CHECK(Meshes::SameBits(solver.GetPositions(), options.fixedPositions),
    "a mesh with every point fixed should be what was asked for");

  // Anchors without fixed points.
  const TriangleMesh two = Meshes::TwoComponents();
  const MeshTopology topology(two.F, two.P.rows());
  solver.SetMesh(two);
  solver.Solve({});
  const Eigen::VectorXd areas = PointAreas(two.P, two.F);
  Points moves = Points::Zero(topology.GetNumberOfComponents(), 3);
  for (int i = 0; i < static_cast<int>(two.P.rows()); ++i)
  {
    moves.row(topology.GetComponents()[i]) +=
      areas[i] / areas.sum() * (solver.GetPositions().row(i) - two.P.row(i));
  }
  CHECK(moves.rowwise().norm().maxCoeff() <= 1e-14 * Meshes::Diagonal(two.P),
    "the centroid of each component should stay");
  StyleOptions last;
  last.anchor = Anchor::LastPoint;
  solver.Solve(last);
  CHECK(topology.GetNumberOfComponents() == 2, "there are two components");
  for (const int i : topology.GetLastPoints())
  {
    CHECK((solver.GetPositions().row(i) - two.P.row(i)).norm() <= 1e-15 * Meshes::Diagonal(two.P),
      "the last point of each component should stay");
  }
}

// The energy of the untouched model may lie below every shape that moved handles allow, so it
// cannot be E_0 there: the promise of Converged is held against the start, every rotation the
// identity.
void TestMovedHandles()
{
  const TriangleMesh mesh = Meshes::Ellipsoid(3);
  StyleSolver solver;
  solver.SetMesh(mesh);
  for (const double lambda : { 0.0, 0.05, 0.5 })
  {
    for (const double pull : { 0.1, 1.0 })
    {
      for (const InitialGuess guess : { InitialGuess::Rest, InitialGuess::Blend })
      {
        StyleOptions options;
        options.lambda = lambda;
        options.initialGuess = guess;
        for (int i = 0; i < mesh.P.rows(); ++i)
        {
          if (std::abs(mesh.P(i, 0)) > 0.85)
          {
            options.fixedPoints.push_back(i);
            options.fixedPositions.conservativeResize(options.fixedPoints.size(), 3);
            options.fixedPositions.bottomRows<1>() =
              mesh.P.row(i) + (mesh.P(i, 0) > 0.0 ? pull : 0.0) * Eigen::RowVector3d(0, 0, 1);
          }
        }
        StyleOptions exact = Fixed(options, 1000);
        exact.loop.acceleration = true;
        exact.initialGuess = InitialGuess::Blend;
        const StyleReport best = solver.Solve(exact);
        const double minimum = best.loop.history.back().energy.Total();
        const double start = best.loop.history.front().energy.Total();
        options.loop.maximumNumberOfIterations = 1000;
        const StyleReport report = solver.Solve(options);
        const double gap = (report.loop.history.back().energy.Total() - minimum) /
          (std::max(start, report.loop.restEnergy) - minimum);
        CHECK(report.loop.converged && gap <= 2.0 * options.loop.tolerance,
          "handles moved by " << pull << ", lambda " << lambda
                              << (guess == InitialGuess::Rest ? ", from rest" : ", from the blend")
                              << ": the energy gap is " << gap << " after "
                              << report.loop.iterations << " iterations, estimated "
                              << report.loop.history.back().gap);
      }
    }
  }
}

/// Points moved onto the opposite edges of their triangles, but for 1e-9 of the size: the matrix
/// stays positive definite, and without roundness the model as it is.
void TestSlivers()
{
  for (int seed = 0; seed < 40; ++seed)
  {
    TriangleMesh mesh = Meshes::Perturbed(Meshes::Icosphere(3), 0.05, seed);
    Meshes::Random random(seed + 1);
    for (int k = 0; k < 40; ++k)
    {
      const auto corners = mesh.F.row(static_cast<int>(random.Unit() * mesh.F.rows()));
      mesh.P.row(corners(0)) = 0.5 * (mesh.P.row(corners(1)) + mesh.P.row(corners(2))) +
        1e-9 * random.InCube().transpose();
    }
    for (const EdgeWeighting weighting :
      { EdgeWeighting::HalfEdge, EdgeWeighting::IntrinsicDelaunay })
    {
      StyleSolver solver;
      solver.SetMesh(mesh);
      StyleOptions options = Fixed({}, 5);
      options.lambda = 0.0;
      options.edgeWeighting = weighting;
      const StyleReport report = solver.Solve(options);
      CHECK(report.linearSolver == "multifrontal LLT",
        "seed " << seed << ": solved by " << report.linearSolver);
      const double moved = Meshes::Distance(solver.GetPositions(), mesh.P);
      CHECK(moved <= 1e-4, "seed " << seed << ": points moved by " << moved);
    }
  }
}

void TestRefusedOptions()
{
  const TriangleMesh mesh = House();
  const int n = mesh.P.rows();
  StyleSolver solver;
  solver.SetMesh(mesh);
  solver.Solve({});
  const Points before = solver.GetPositions();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const auto refused = [&](const std::string& word, const std::function<void(StyleOptions&)>& set)
  {
    StyleOptions options;
    set(options);
    CHECK_THROWS(std::invalid_argument, solver.Solve(options), word);
  };
  for (const double bad : { -0.1, nan, infinite })
  {
    refused("lambda", [bad](StyleOptions& o) { o.lambda = bad; });
    MethodOptions details;
    details.detailSize = bad;
    CHECK_THROWS(std::invalid_argument, CheckOptions(details, n), "detail size");
    refused("Radius",
      [bad](StyleOptions& o)
      {
        o.radiusMode = RadiusMode::Custom;
        o.custom.radius = bad;
      });
    refused("roundness",
      [bad, n](StyleOptions& o)
      {
        o.roundnessFactors = Eigen::VectorXd::Ones(n);
        o.roundnessFactors[5] = bad;
      });
  }
  for (const double bad : { -0.1, 1.1, nan, infinite })
  {
    refused("normal blend", [bad](StyleOptions& o) { o.normalBlend = bad; });
    // Also where NaN stands last or among many: maxima may pass over it.
    for (const int at : { 0, 5, n - 1 })
    {
      refused("normal blends",
        [bad, n, at](StyleOptions& o)
        {
          o.normalBlends = Eigen::VectorXd::Constant(n, 0.5);
          o.normalBlends[at] = bad;
        });
    }
  }
  for (const double bad : { 0.0, -1.0, nan })
  {
    refused("tolerance", [bad](StyleOptions& o) { o.loop.tolerance = bad; });
  }
  for (const double bad : { nan, infinite })
  {
    refused("Center",
      [bad](StyleOptions& o)
      {
        o.centerMode = CenterMode::Custom;
        o.custom.center[1] = bad;
      });
    refused("directions",
      [bad, &mesh](StyleOptions& o)
      {
        o.targets = mesh.P;
        o.targets(3, 2) = bad;
      });
    refused("directions",
      [bad, &mesh](StyleOptions& o)
      {
        o.normals = mesh.P;
        o.normals(3, 2) = bad;
      });
    refused("fixed",
      [bad, &mesh](StyleOptions& o)
      {
        o.fixedPoints = { 1 };
        o.fixedPositions = mesh.P.row(1);
        o.fixedPositions(0, 2) = bad;
      });
  }
  refused("roundness factor", [n](StyleOptions& o) { o.roundnessFactors.setOnes(n - 1); });
  refused("normal blend", [n](StyleOptions& o) { o.normalBlends.setZero(n + 1); });
  refused("normal", [n](StyleOptions& o) { o.normals.setOnes(n - 1, 3); });
  refused("target", [](StyleOptions& o) { o.targets.setOnes(1, 3); });
  refused("fixed point", [](StyleOptions& o) { o.fixedPoints = { 1 }; });
  for (const int bad : { -1, n })
  {
    refused("fixed point",
      [bad](StyleOptions& o)
      {
        o.fixedPoints = { bad };
        o.fixedPositions.setZero(1, 3);
      });
  }
  StyleSolver flat;
  flat.SetMesh(Meshes::Patch(4, 0.0));
  StyleOptions volume;
  volume.radiusMode = RadiusMode::EqualVolume;
  CHECK_THROWS(std::invalid_argument, flat.Solve(volume), "volume");

  // Refusing spoils nothing.
  solver.Solve({});
  CHECK(Meshes::SameBits(solver.GetPositions(), before),
    "after refused options the solver should work as before");
}

void TestRefusedMeshes()
{
  const TriangleMesh good = Meshes::Tetrahedron();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  StyleSolver solver;
  const auto refused = [&](const std::string& word, const std::function<void(TriangleMesh&)>& set)
  {
    TriangleMesh mesh = good;
    set(mesh);
    CHECK_THROWS(std::invalid_argument, solver.SetMesh(mesh), word);
  };
  refused("point", [](TriangleMesh& m) { m.F(1, 1) = 4; });
  refused("point", [](TriangleMesh& m) { m.F(1, 1) = -1; });
  refused("twice", [](TriangleMesh& m) { m.F(2, 0) = m.F(2, 2); });
  refused("point 4",
    [](TriangleMesh& m)
    {
      m.P.conservativeResize(5, 3);
      m.P.row(4) << 1, 2, 3;
    });
  refused("finite", [nan](TriangleMesh& m) { m.P(3, 1) = nan; });
  refused("finite", [](TriangleMesh& m) { m.P(0, 0) = std::numeric_limits<double>::infinity(); });
  refused("equal", [](TriangleMesh& m) { m.P.setConstant(2.0); });
  refused("area", [](TriangleMesh& m) { m.P.row(1) = m.P.row(0); });
  refused("area",
    [](TriangleMesh& m)
    {
      m.P.row(0) << 0, 0, 0;
      m.P.row(1) << 1, 0, 0;
      m.P.row(2) << 3, 0, 0;
    });
  refused("", [](TriangleMesh& m) { m.F.resize(0, 3); });
  refused("",
    [](TriangleMesh& m)
    {
      m.F.resize(0, 3);
      m.P.resize(0, 3);
    });

  CHECK_THROWS(std::invalid_argument, solver.Solve({}), "no mesh");
  StyleSolver untouched;
  CHECK_THROWS(std::invalid_argument, untouched.Solve({}), "no mesh");

  // After all this a good mesh works.
  solver.SetMesh(good);
  solver.Solve({});
  StyleSolver fresh;
  fresh.SetMesh(good);
  fresh.Solve({});
  CHECK(Meshes::SameBits(solver.GetPositions(), fresh.GetPositions()),
    "after refused meshes the solver should work as a fresh one");
}
} // namespace

int main()
{
  TestFactorsKept();
  TestSequences();
  TestInvariance();
  TestThreads();
  TestBackends();
  TestFixedPoints();
  TestMovedHandles();
  TestSlivers();
  TestRefusedOptions();
  TestRefusedMeshes();
  return CheckResult();
}
