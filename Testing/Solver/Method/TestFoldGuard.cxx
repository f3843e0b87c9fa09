// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The guard against folds [guard]: what is counted, that nothing is left, how much roundness stays,
// and its ways out. Intersections are found here by brute force; those of CGAL are guarded with the
// filter, Testing/Cxx/TestSphericalStyleFilterFoldGuard.cxx.
#include "Check.h"
#include "DeformationMeasures.h"
#include "FoldGuard.h"
#include "Meshes.h"
#include "RestContacts.h"
#include "StyleSolver.h"
#include "SurfaceMeasures.h"

#include <Eigen/Dense>

#include <algorithm>

using namespace SphericalStyle;
using Eigen::Vector3d;

namespace
{
using Pair = std::array<int, 2>;

// Whether the segment ab goes through the inside of the triangle f.
bool Pierces(const TriangleMesh& mesh, int a, int b, int f)
{
  const Vector3d p = mesh.P.row(mesh.F(f, 0));
  Eigen::Matrix3d M;
  M.col(0) = mesh.P.row(mesh.F(f, 1)).transpose() - p;
  M.col(1) = mesh.P.row(mesh.F(f, 2)).transpose() - p;
  M.col(2) = (mesh.P.row(a) - mesh.P.row(b)).transpose();
  const Vector3d x = M.fullPivLu().solve(mesh.P.row(a).transpose() - p);
  return x.minCoeff() >= 0.0 && x(0) + x(1) <= 1.0 && x(2) <= 1.0;
}

// Triangles without a common point of which an edge of one pierces the other.
std::vector<Pair> BruteForce(const TriangleMesh& mesh)
{
  std::vector<Pair> pairs;
  for (int f = 0; f < mesh.F.rows(); ++f)
  {
    const Eigen::Matrix3d A = mesh.P(mesh.F.row(f).transpose(), AllColumns);
    for (int g = f + 1; g < mesh.F.rows(); ++g)
    {
      const Eigen::Matrix3d B = mesh.P(mesh.F.row(g).transpose(), AllColumns);
      bool apart = (A.colwise().maxCoeff().array() < B.colwise().minCoeff().array()).any() ||
        (B.colwise().maxCoeff().array() < A.colwise().minCoeff().array()).any();
      for (const int i : mesh.F.row(f))
      {
        apart = apart || (mesh.F.row(g).array() == i).any();
      }
      for (int k = 0; k < 3 && !apart; ++k)
      {
        if (Pierces(mesh, mesh.F(f, k), mesh.F(f, (k + 1) % 3), g) ||
          Pierces(mesh, mesh.F(g, k), mesh.F(g, (k + 1) % 3), f))
        {
          pairs.push_back({ f, g });
          break;
        }
      }
    }
  }
  return pairs;
}

std::vector<Pair> NoPairs(const TriangleMesh&)
{
  return {};
}

// Two balls with a waist.
TriangleMesh Dumbbell()
{
  TriangleMesh mesh = Meshes::EllipsoidUV(16, 17);
  for (Eigen::Index i = 0; i < mesh.P.rows(); ++i)
  {
    const double z = mesh.P(i, 2) / 0.5;
    mesh.P.row(i).head<2>() *= 0.3 + 0.7 * z * z;
    mesh.P(i, 2) *= 3.0;
  }
  return mesh;
}

StyleOptions Strong(double lambda = 5.0)
{
  StyleOptions options;
  options.lambda = lambda;
  options.normalBlend = 1.0;
  return options;
}

// The solver as a function of the shares; counts its solves.
ShareSolve SolveOf(StyleSolver& solver, const StyleOptions& options, int& solves)
{
  return [&solver, options, &solves](const Eigen::VectorXd& shares)
  {
    ++solves;
    StyleOptions shared = options;
    shared.roundnessFactors = shares;
    solver.Solve(shared);
    return solver.GetPositions();
  };
}

// Turned over and, without the guard's own finder, pierced.
int CountFolds(const TriangleMesh& rest, const Points& Q)
{
  return CountTurnedOver(rest.P, Q, rest.F, SurfaceRotations(rest, Q, 1)) +
    static_cast<int>(BruteForce({ Q, rest.F }).size());
}

// Moves a point along the ball, to behind one of its neighbors, by so much of the edge to it.
void DrawOver(const TriangleMesh& ball, int point, Points& Q, double behind = 1.2)
{
  for (Eigen::Index f = 0; f < ball.F.rows(); ++f)
  {
    if (ball.F(f, 0) == point)
    {
      const double radius = Q.row(point).norm();
      Q.row(point) =
        ((1.0 + behind) * Q.row(ball.F(f, 1)) - behind * Q.row(point)).normalized() * radius;
      return;
    }
  }
}

double WeightedMean(const TriangleMesh& mesh, const Eigen::VectorXd& x)
{
  const Eigen::VectorXd areas = PointAreas(mesh.P, mesh.F);
  return areas.dot(x) / areas.sum();
}

void TestFinder()
{
  const TriangleMesh rest = Meshes::Icosphere(1);
  FoldFinder clean(rest, NoPairs, false, 1);
  CHECK(!clean.Find(rest.P).Any(), "the rest shape has no folds");
  CHECK(!clean.Find(3.0 * rest.P).Any(), "nor has a larger one");

  // One point drawn over its neighbor: triangles at it turn over.
  Points pushed = rest.P;
  DrawOver(rest, 7, pushed);
  const Folds folds = clean.Find(pushed);
  const std::vector<char> over =
    TurnedOver(rest.P, pushed, rest.F, SurfaceRotations(rest, pushed, 1));
  std::vector<int> expected;
  for (std::size_t f = 0; f < over.size(); ++f)
  {
    if (over[f])
    {
      expected.push_back(static_cast<int>(f));
    }
  }
  CHECK(!expected.empty() && folds.triangles == expected, "the triangles that turned over");
  CHECK(folds.turnedOver == static_cast<int>(expected.size()) && folds.newPairs == 0, "counts");

  // Pairs that are there at rest do not count, in numbers of the whole mesh even where a triangle
  // lost its area before them.
  Points flat = rest.P;
  flat.row(rest.F(0, 0)) = flat.row(rest.F(0, 1));
  bool sawDegenerate = false;
  FoldFinder some(
    rest,
    [&](const TriangleMesh& mesh) -> std::vector<Pair>
    {
      for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
      {
        sawDegenerate |= IsDegenerate(
          mesh.P.row(mesh.F(f, 0)), mesh.P.row(mesh.F(f, 1)), mesh.P.row(mesh.F(f, 2)));
      }
      const int last = static_cast<int>(mesh.F.rows()) - 1;
      return mesh.F.rows() == rest.F.rows() ? std::vector<Pair>{ { 20, last }, { 21, last } }
                                            : std::vector<Pair>{ { 1, last }, { 2, last } };
    },
    false, 1);
  CHECK(!some.Find(2.0 * rest.P).Any(), "pairs of the rest shape are not new");
  const Folds mapped = some.Find(flat);
  const int last = static_cast<int>(rest.F.rows()) - 1;
  CHECK(!sawDegenerate, "triangles without an area should not be searched");
  CHECK(mapped.newPairs == 2 && mapped.triangles.back() == last,
    "two new pairs with triangle " << last << " expected, not " << mapped.newPairs);

  bool rounded = true;
  FoldFinder single(
    rest,
    [&](const TriangleMesh& mesh)
    {
      rounded = rounded && mesh.P == Points(mesh.P.cast<float>().cast<double>());
      return std::vector<Pair>();
    },
    true, 1);
  single.Find(rest.P / 3.0);
  CHECK(rounded, "with single precision the points that are written should be searched");
}

// Around places of triangles: all pairs with one of them, and no search far away.
void TestFindAtPlaces()
{
  const TriangleMesh mesh = Dumbbell();
  StyleSolver solver;
  solver.SetMesh(mesh);
  int solves = 0;
  const Points Q = SolveOf(solver, Strong(), solves)(Eigen::VectorXd::Ones(mesh.P.rows()));
  Eigen::Index searched = 0;
  const auto search = [&searched](const TriangleMesh& other)
  {
    searched = other.F.rows();
    return BruteForce(other);
  };
  FoldFinder finder(mesh, search, false, 1);
  const int all = finder.Find(Q).newPairs; // searches the rest shape, too
  int inOne = 0;
  for (int f = 0; f < mesh.F.rows(); f += 29)
  {
    const std::vector<std::vector<int>> places = { { f }, { (f + 100) % 200 } };
    const Folds folds = finder.Find(Q, places);
    CHECK(folds.newPairs <= all && searched < mesh.F.rows() / 2, searched << " were searched");
    int expected = 0;
    for (const auto& [g, h] : BruteForce({ Q, mesh.F }))
    {
      for (const std::vector<int>& place : places)
      {
        if (g == place[0] || h == place[0])
        {
          ++expected;
          CHECK(std::binary_search(folds.triangles.begin(), folds.triangles.end(), g) &&
              std::binary_search(folds.triangles.begin(), folds.triangles.end(), h),
            "the pair " << g << ", " << h << " at triangle " << place[0]);
        }
      }
    }
    CHECK(folds.newPairs >= expected, "at triangle " << f);
    inOne = std::max(inOne, expected);
  }
  CHECK(inOne > 5, "some triangles should run through many, not " << inOne);
}

// An eye in a head may slide, but not run through the head elsewhere.
void TestContacts()
{
  const TriangleMesh head = Meshes::Icosphere(2);
  TriangleMesh small = Meshes::Icosphere(1);
  small.P *= 0.3;
  TriangleMesh arm = small; // from the side of the head to the outside
  arm.P.col(0) *= 5.0;
  const auto beside = [&](const TriangleMesh& other, const Eigen::RowVector3d& shift) {
    return Meshes::Together({ head, Meshes::Moved(other, shift.transpose()) });
  };
  const TriangleMesh rest = beside(small, { 1.0, 0.1, 0.0 });
  const std::vector<Pair> before = BruteForce(rest);
  FoldFinder finder(rest, BruteForce, false, 1);
  const Points near = beside(small, { 0.98, 0.15, 0.02 }).P;
  const std::vector<Pair> now = BruteForce({ near, rest.F });
  CHECK(!before.empty() && !std::includes(before.begin(), before.end(), now.begin(), now.end()),
    "other triangles run through each other");
  CHECK(!finder.Find(near).Any(), "but next to where they did");
  CHECK(finder.Find(beside(small, { 0.0, 1.0, 0.0 }).P).newPairs > 0, "not so elsewhere");

  // The other end of the arm comes into the head.
  const TriangleMesh held = beside(arm, { 2.3, 0.0, 0.0 });
  FoldFinder ofArm(held, BruteForce, false, 1);
  Points bent = held.P;
  for (Eigen::Index i = head.P.rows(); i < bent.rows(); ++i)
  {
    const double along = std::max(bent(i, 0) - 1.3, 0.0); // from 0 to 2.5
    bent(i, 0) -= 1.9 * along;
    bent(i, 1) += 0.3 * along;
  }
  CHECK(ofArm.Find(held.P).newPairs == 0 && ofArm.Find(bent).newPairs > 0, "an end elsewhere");
}

// Two strips of squares, of which the first ones meet: how far from there pairs do not count.
void TestWidth()
{
  constexpr int Length = 100;
  std::vector<Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  for (const double z : { 0.0, 1.0 })
  {
    const int first = static_cast<int>(points.size());
    for (int i = 0; i <= Length; ++i)
    {
      points.emplace_back(i, 0.0, z);
      points.emplace_back(i, 1.0, z);
    }
    for (int i = first; i < first + 2 * Length; i += 2)
    {
      triangles.push_back({ i, i + 2, i + 1 });
      triangles.push_back({ i + 1, i + 2, i + 3 });
    }
  }
  const TriangleMesh strips = Meshes::Make(points, triangles);
  const int other = 2 * Length; // the first triangle of the second strip
  const RestContacts contacts(strips, { { 0, other } });
  const double reach = 0.03 * Meshes::Diagonal(strips.P);
  for (int i = 0; i < Length; ++i)
  {
    const int f = 2 * i; // begins i - 1 squares behind the place
    const bool isNear = i - 1 <= reach;
    CHECK(contacts.AreNear({ f, other }) == isNear && contacts.AreNear({ 0, other + f }) == isNear,
      "a triangle in square " << i);
    CHECK(!contacts.AreNear({ 0, f }), "two of one part");
  }
  CHECK(!RestContacts(strips, {}).AreNear({ 0, other }), "parts that do not meet");
}

// Nothing folds: one solve with all of lambda, and its bits.
void TestClean()
{
  const TriangleMesh mesh = Meshes::Ellipsoid(2);
  StyleSolver solver;
  solver.SetMesh(mesh);
  StyleOptions options = Strong(0.5);
  options.normalBlend = 0.0;
  solver.Solve(options);
  const Points unguarded = solver.GetPositions();
  int solves = 0;
  const FoldGuardReport report =
    SolveWithoutFolds(mesh, {}, BruteForce, SolveOf(solver, options, solves));
  CHECK(report.positions == unguarded, "the bits should be those without a guard");
  CHECK(solves == 1 && report.solves == 1, "one solve expected, not " << solves);
  CHECK((report.shares.array() == 1.0).all(), "all of lambda should stay");
  CHECK(!report.before.Any() && !report.after.Any() && !report.blended, "no folds");
}

// A similarity but for one point, drawn over its neighbor, where it moves as they do.
void TestRepair()
{
  const TriangleMesh mesh = Meshes::Icosphere(5);
  const double shrink = 0.8;
  Points pushed = shrink * mesh.P;
  DrawOver(mesh, 77, pushed, 0.5);
  int searches = 0;
  Eigen::Index searched = 0;
  const auto search = [&](const TriangleMesh& other) -> std::vector<Pair>
  {
    ++searches;
    searched = other.F.rows();
    return {};
  };
  const FoldGuardReport report =
    SolveWithoutFolds(mesh, {}, search, [&](const Eigen::VectorXd&) { return pushed; });
  CHECK(report.before.turnedOver > 0 && !report.after.Any() && !report.blended, "no fold is left");
  CHECK(report.solves == 1 && (report.shares.array() == 1.0).all() && report.meanShare == 1.0,
    "all of lambda stays");
  const Eigen::VectorXd distances = (report.positions - shrink * mesh.P).rowwise().norm();
  CHECK(distances.maxCoeff() < 1e-13, "and all points follow, to " << distances.maxCoeff());
  const auto moved = (report.positions - pushed).rowwise().norm().array() != 0.0;
  CHECK(report.repaired == moved.count() && report.repaired > 0 && report.repaired < 20,
    report.repaired << " points were moved");
  CHECK(searches == 2 && searched < mesh.F.rows() / 10, "the second search is around the place");

  // Points at rest, such as those outside a region, stay there.
  Points half = mesh.P;
  DrawOver(mesh, 77, half, 0.5);
  const FoldGuardReport region =
    SolveWithoutFolds(mesh, {}, NoPairs, [&](const Eigen::VectorXd&) { return half; });
  CHECK(region.solves == 1 && region.repaired == 1,
    "only the point that moved is moved back, not " << region.repaired);
  CHECK((region.positions - mesh.P).rowwise().norm().maxCoeff() < 1e-13, "to the rest shape");

  // More than 2 % of the diagonal is no repair.
  const TriangleMesh coarse = Meshes::Icosphere(4);
  Points far = shrink * coarse.P;
  DrawOver(coarse, 77, far);
  CHECK((far - shrink * coarse.P).rowwise().norm().maxCoeff() > 0.02 * Meshes::Diagonal(coarse.P),
    "the point is drawn far");
  const FoldGuardReport refused =
    SolveWithoutFolds(coarse, {}, NoPairs, [&](const Eigen::VectorXd&) { return far; });
  CHECK(refused.solves > 1 && refused.repaired == 0 && !refused.after.Any(), "lambda is lowered");
}

// The repair is the same at any size.
void TestRepairSizes()
{
  const TriangleMesh mesh = Meshes::Icosphere(5);
  for (const double size : { 1e-290, 1e-100, 1.0, 1e100, 1e290 })
  {
    const TriangleMesh sized = { size * mesh.P, mesh.F };
    Points pushed = 0.8 * mesh.P;
    DrawOver(mesh, 77, pushed, 0.5);
    pushed *= size;
    const FoldGuardReport report =
      SolveWithoutFolds(sized, {}, NoPairs, [&](const Eigen::VectorXd&) { return pushed; });
    CHECK(report.solves == 1 && report.repaired > 0, "size " << size << ": " << report.solves);
    CHECK((report.positions / size - 0.8 * mesh.P).rowwise().norm().maxCoeff() < 1e-13,
      "size " << size << ": all points follow");
  }
}

// What is repaired does not get below the others, here below the ground.
void TestRepairBounds()
{
  const TriangleMesh mesh = Meshes::Turned(Meshes::Icosphere(5), Meshes::Random(1).Rotation());
  Eigen::Index lowest = 0;
  mesh.P.col(2).minCoeff(&lowest);
  Points pushed = 0.8 * mesh.P;
  DrawOver(mesh, static_cast<int>(lowest), pushed, 0.5);
  const double ground = pushed.col(2).minCoeff();
  CHECK(ground > 0.8 * mesh.P(lowest, 2), "the lowest point is drawn up");
  const FoldGuardReport report =
    SolveWithoutFolds(mesh, {}, NoPairs, [&](const Eigen::VectorXd&) { return pushed; });
  CHECK(report.solves == 1 && report.repaired > 0, "repaired");
  CHECK(report.positions.col(2).minCoeff() == ground, "the ground stays where it was");
}

constexpr int Length = 100; // of a square of squares of size 1

TriangleMesh Square()
{
  return Meshes::Moved(
    Meshes::Scaled(Meshes::Patch(Length, 0.0), Vector3d(0.5 * Length, Length / 1.6, 1.0)),
    Vector3d(0.5 * Length, 0.5 * Length, 0.0));
}

// The first triangle of a square.
int TriangleAt(int i, int j)
{
  return 2 * (i * Length + j);
}

// Pairs as long as one of some points is at height .1.
IntersectionSearch WhileBumps(
  const TriangleMesh& mesh, const std::vector<int>& bumps, const std::vector<Pair>& pairs)
{
  return [&mesh, bumps, pairs](const TriangleMesh& other) -> std::vector<Pair>
  {
    const bool folds =
      std::any_of(bumps.begin(), bumps.end(), [&](int i) { return other.P(i, 2) == 0.1; });
    return !folds                       ? std::vector<Pair>()
      : other.F.rows() == mesh.F.rows() ? pairs
                                        : std::vector<Pair>{ { 0, 1 } };
  };
}

// Two triangles are said to fold as long as a point so many edges away is where it was solved: .5,
// 1 and 2 % of the diagonal reach 0, 1 and 2 edges far.
void TestRepairWidths()
{
  const TriangleMesh square = Square();
  const int fold = TriangleAt(Length / 2, 0);
  for (const int edges : { 0, 1, 2, 3 })
  {
    Points solved = 0.8 * square.P;
    const int bump = square.F(fold, 0) - edges * (Length + 1); // a row each
    solved(bump, 2) = 0.1;
    const FoldGuardReport report =
      SolveWithoutFolds(square, {}, WhileBumps(square, { bump }, { { fold, fold + 1 } }),
        [&](const Eigen::VectorXd&) { return solved; });
    const bool isNear = edges < 3;
    CHECK(isNear == (report.repaired > 0) && isNear == (report.solves == 1) &&
        report.blended == !isNear,
      edges << " edges: " << report.repaired << " points in " << report.solves << " solves");
    if (!isNear)
    {
      continue;
    }
    const double width = (edges == 0 ? 0.005 : 0.01 * edges) * Meshes::Diagonal(square.P);
    for (int i = 0; i < square.P.rows(); ++i)
    {
      double distance = Length;
      for (const int f : { fold, fold + 1 })
      {
        for (const int corner : square.F.row(f))
        {
          distance = std::min(distance, (square.P.row(i) - square.P.row(corner)).norm());
        }
      }
      CHECK(distance < width || report.positions.row(i) == solved.row(i),
        edges << " edges: point " << i << " should stay");
    }
    // The bump is far from all that the others follow, so what stays of it is the fade.
    const double h = 1.0 - edges / width;
    const double left = 0.1 * (1.0 - h * h * (3.0 - 2.0 * h));
    CHECK_NEAR(report.positions(bump, 2), left, 0.004, edges << " edges: what is left of the bump");
  }
}

// With places of 1 % of the surface it is no repair: 4 of 10,000 points each.
void TestRepairAreas()
{
  const TriangleMesh square = Square();
  for (const int places : { 2, 24, 26 })
  {
    Points solved = 0.8 * square.P;
    std::vector<int> bumps;
    std::vector<Pair> pairs;
    for (int k = 0; k < places; ++k)
    {
      const int f = TriangleAt(10 + 15 * (k % 6), 10 + 15 * (k / 6));
      bumps.push_back(square.F(f, 0));
      pairs.push_back({ f, f + 1 });
      solved(bumps.back(), 2) = 0.1;
    }
    std::sort(pairs.begin(), pairs.end());
    std::vector<char> wasSearched(square.F.rows(), 0); // by the last search
    const IntersectionSearch whileBumps = WhileBumps(square, bumps, pairs);
    const FoldGuardReport report = SolveWithoutFolds(
      square, {},
      [&](const TriangleMesh& other)
      {
        std::fill(wasSearched.begin(), wasSearched.end(), 0);
        for (Eigen::Index f = 0, g = 0; f < square.F.rows() && g < other.F.rows(); ++f)
        {
          wasSearched[f] = square.F.row(f) == other.F.row(g);
          g += wasSearched[f];
        }
        return whileBumps(other);
      },
      [&](const Eigen::VectorXd&) { return solved; });
    const bool isSmall = places < 25;
    CHECK((report.solves == 1) == isSmall && (report.repaired >= places) == isSmall,
      places << " places: " << report.repaired << " points in " << report.solves << " solves");
    // All that may meet a triangle that changed, such as those that share a point with it.
    std::vector<char> isNext(square.P.rows(), 0);
    for (Eigen::Index f = 0; f < square.F.rows(); ++f)
    {
      const auto corners = square.F.row(f);
      if (std::any_of(corners.begin(), corners.end(),
            [&](int i) { return report.positions.row(i) != solved.row(i); }))
      {
        std::for_each(corners.begin(), corners.end(), [&isNext](int i) { isNext[i] = 1; });
      }
    }
    for (Eigen::Index f = 0; isSmall && f < square.F.rows(); ++f)
    {
      const auto corners = square.F.row(f);
      CHECK(wasSearched[f] ||
          std::none_of(corners.begin(), corners.end(), [&isNext](int i) { return isNext[i]; }),
        "triangle " << f << " was not searched");
    }
    CHECK(places != 2 || std::count(wasSearched.begin(), wasSearched.end(), 1) < 200,
      "the search is around the places");
  }
}

// Parts move with their surroundings, too: a place goes on to the next part.
void TestRepairParts()
{
  const TriangleMesh square = Square();
  const TriangleMesh both =
    Meshes::Together({ square, Meshes::Moved(square, Vector3d(0.0, 0.0, 0.3)) });
  const int fold = TriangleAt(Length / 2, Length / 2);
  const int bump = static_cast<int>(square.P.rows()) + both.F(fold, 0); // above it
  Points solved = 0.8 * both.P;
  solved(bump, 2) = 0.1;
  const FoldGuardReport report =
    SolveWithoutFolds(both, {}, WhileBumps(both, { bump }, { { fold, fold + 1 } }),
      [&](const Eigen::VectorXd&) { return solved; });
  CHECK(report.solves == 1 && report.positions(bump, 2) != 0.1,
    "the part above moves along, in " << report.solves << " solves");
}

void TestDumbbell()
{
  const TriangleMesh mesh = Dumbbell();
  StyleSolver solver;
  solver.SetMesh(mesh);
  int solves = 0;
  const ShareSolve solve = SolveOf(solver, Strong(), solves);
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(mesh.P.rows());
  const int folds = CountFolds(mesh, solve(all));
  CHECK(CountFolds(mesh, mesh.P) == 0 && folds > 100, "unguarded it should fold, in " << folds);

  solves = 0;
  const FoldGuardOptions options;
  const FoldGuardReport report = SolveWithoutFolds(mesh, options, BruteForce, solve);
  CHECK(report.before.Any() && !report.after.Any() && !report.blended && !report.aborted,
    "folds before, none after, by less lambda alone");
  CHECK(CountFolds(mesh, report.positions) == 0, "counted without the guard there are none");
  CHECK(report.solves == solves && solves <= options.lowerings + options.raisings + 2,
    "solves are bounded and counted: " << solves);
  CHECK(report.shares.minCoeff() > 0.0 && report.shares.maxCoeff() <= 1.0, "shares in 0..1");
  CHECK(solve(report.shares) == report.positions, "the shares are those of the result, to the bit");

  // Smooth: a factor of 2 over a third of the diagonal along every edge.
  const double diagonal = (mesh.P.colwise().maxCoeff() - mesh.P.colwise().minCoeff()).norm();
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int u = mesh.F(f, k), v = mesh.F(f, (k + 1) % 3);
      const double octaves = std::abs(std::log2(report.shares(u) / report.shares(v)));
      const double allowed = (mesh.P.row(u) - mesh.P.row(v)).norm() * 3.0 / diagonal;
      CHECK(octaves <= allowed + 1e-9, "slope along " << u << ", " << v << ": " << octaves);
    }
  }

  // More is kept than the largest share without folds that is the same everywhere.
  double kept = 0.0;
  double tooMuch = 1.0;
  for (int k = 0; k < 10; ++k)
  {
    const double share = kept > 0.0 ? std::sqrt(kept * tooMuch) : tooMuch / 4.0;
    (CountFolds(mesh, solve(share * all)) == 0 ? kept : tooMuch) = share;
  }
  const double mean = WeightedMean(mesh, report.shares);
  CHECK_NEAR(report.meanShare, mean, 1e-14, "the mean share");
  CHECK(mean > 1.05 * kept, "mean share " << mean << " beside " << kept << " everywhere");

  const FoldGuardReport again = SolveWithoutFolds(mesh, options, BruteForce, solve);
  CHECK(again.positions == report.positions && again.shares == report.shares &&
      again.solves == report.solves,
    "the same bits again");
  FoldGuardOptions threads;
  threads.threads = 3;
  CHECK(SolveWithoutFolds(mesh, threads, BruteForce, solve).positions == report.positions,
    "the same bits with three threads");
}

// Raising a share at one point folds much at others, until they have lost more than was won: what
// was there before stays.
void TestNoGain()
{
  const TriangleMesh mesh = Meshes::Icosphere(2);
  const int point = 11;
  const std::vector<int> others = { 3, 40, 77, 120 };
  Points folded = mesh.P, foldedElsewhere = mesh.P;
  DrawOver(mesh, point, folded);
  for (const int other : others)
  {
    DrawOver(mesh, other, foldedElsewhere);
  }
  int solves = 0;
  Eigen::VectorXd accepted;
  const FoldGuardReport report = SolveWithoutFolds(mesh, {}, NoPairs,
    [&](const Eigen::VectorXd& shares)
    {
      if (++solves == 1)
      {
        return folded;
      }
      if (shares(point) > 0.55)
      {
        return foldedElsewhere;
      }
      accepted = accepted.size() == 0 ? shares : accepted;
      return mesh.P;
    });
  CHECK(solves > 5, "it should be tried to raise, there were " << solves << " solves");
  CHECK(!report.after.Any() && !report.blended, "no folds");
  CHECK(report.shares == accepted, "the shares should be those of the first result without folds");
}

// A solve that folds whatever the shares are: the way back to the rest shape.
void TestLastResort()
{
  const TriangleMesh mesh = Meshes::Icosphere(2);
  Points pushed = 1.5 * mesh.P;
  DrawOver(mesh, 11, pushed);
  const FoldGuardOptions options;
  const FoldGuardReport local =
    SolveWithoutFolds(mesh, options, BruteForce, [&](const Eigen::VectorXd&) { return pushed; });
  CHECK(local.blended && local.before.Any() && !local.after.Any(), "the last resort was needed");
  CHECK(local.solves == options.lowerings + 1, "after every lowering, not " << local.solves);
  CHECK(CountFolds(mesh, local.positions) == 0, "no folds are left");
  CHECK(((local.positions - pushed).rowwise().norm().array() == 0.0).count() > mesh.P.rows() / 2,
    "far from the fold nothing should change");

  // Folds wherever it is not the rest shape: exactly that.
  const auto search = [&](const TriangleMesh& other) -> std::vector<Pair> {
    return other.P == mesh.P ? std::vector<Pair>() : std::vector<Pair>{ { 0, 9 } };
  };
  const FoldGuardReport rest =
    SolveWithoutFolds(mesh, options, search, [&](const Eigen::VectorXd&) { return pushed; });
  CHECK(
    rest.blended && rest.positions == mesh.P && !rest.after.Any(), "the rest shape, to the bit");

  // Folds from half of the way on: nearly half of the way.
  const auto half = [&](const TriangleMesh& other) -> std::vector<Pair>
  {
    return (other.P - mesh.P).rowwise().norm().maxCoeff() > 0.2501 ? std::vector<Pair>{ { 0, 9 } }
                                                                   : std::vector<Pair>();
  };
  const FoldGuardReport way = SolveWithoutFolds(
    mesh, options, half, [&](const Eigen::VectorXd&) { return Points(1.5 * mesh.P); });
  const double moved = (way.positions - mesh.P).rowwise().norm().maxCoeff();
  CHECK(way.blended && moved > 0.24 && moved <= 0.2501, "moved by " << moved << " of 0.25");
}

void TestAbort()
{
  const TriangleMesh mesh = Dumbbell();
  StyleSolver solver;
  solver.SetMesh(mesh);
  int solves = 0;
  const ShareSolve solve = SolveOf(solver, Strong(), solves);
  for (const int last : { 0, 1, 3 })
  {
    solves = 0;
    const FoldGuardReport report = SolveWithoutFolds(mesh, {}, BruteForce,
      [&](const Eigen::VectorXd& shares) { return solves < last ? solve(shares) : Points(0, 3); });
    CHECK(report.aborted && report.solves == last && report.positions.rows() == 0,
      "aborted after " << last << " solves");
  }
}
}

int main()
{
  TestFinder();
  TestFindAtPlaces();
  TestContacts();
  TestWidth();
  TestClean();
  TestRepair();
  TestRepairSizes();
  TestRepairBounds();
  TestRepairWidths();
  TestRepairAreas();
  TestRepairParts();
  TestDumbbell();
  TestNoGain();
  TestLastResort();
  TestAbort();
  return CheckResult();
}
