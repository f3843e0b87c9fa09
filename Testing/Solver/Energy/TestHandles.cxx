// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Handles: which points they hold, that these go where they are put to the last bit, what the rest
// of the surface must not depend on, and that rotations start between those of the handles.
#include "Check.h"
#include "Handles.h"
#include "Meshes.h"

#include <Eigen/Dense>

#include <algorithm>
#include <string>

using namespace SphericalStyle;
using Eigen::Vector3d;

namespace
{
/// A cigar along z.
TriangleMesh Cigar()
{
  return Meshes::Perturbed(Meshes::Scaled(Meshes::EllipsoidUV(24, 48), { 1.0, 1.4, 8.0 }), 0.01, 3);
}

Handle Pin(const Vector3d& place, double radius)
{
  Handle handle;
  handle.place = handle.to = place;
  handle.radius = radius;
  return handle;
}

/// The lower end stays, the upper one turns about an axis and moves.
std::vector<Handle> BendOf(const TriangleMesh& mesh, double angle)
{
  const double top = mesh.P.col(2).maxCoeff();
  std::vector<Handle> handles = { Pin({ 0, 0, -top }, 0.3 * top), Pin({ 0, 0, top }, 0.3 * top) };
  handles[1].to = Vector3d(0.1, -0.5 * top, 0.6 * top);
  handles[1].turn = Vector3d(angle, 0.1, 0.0);
  return handles;
}

StyleOptions Held(const TriangleMesh& mesh, const std::vector<Handle>& handles,
  ComponentCoupling coupling = ComponentCoupling::Independent)
{
  StyleOptions options;
  options.lambda = 0.0;
  options.componentCoupling = coupling;
  options.loop.tolerance = 1e-9;
  options.loop.maximumNumberOfIterations = 2000;
  HoldHandles(mesh, handles, HandlesOfPoints(mesh.P, handles), options);
  return options;
}

Points SolvedWith(const TriangleMesh& mesh, const std::vector<Handle>& handles)
{
  StyleSolver solver;
  solver.SetMesh(mesh);
  const StyleReport report = solver.Solve(Held(mesh, handles));
  CHECK(report.loop.converged, "it should converge in " << report.loop.iterations);
  const Rises rises = CountRises(report.loop);
  CHECK(rises.iterations + rises.localSteps + rises.globalSteps == 0, "no step should raise E");
  return solver.GetPositions();
}

void TestPointsOfHandles()
{
  Points P(4, 3);
  P << 0, 0, 0, 1, 0, 0, 2, 0, 0, 5, 0, 0;
  const auto of = [&](const std::vector<Handle>& handles, double scale = 1.0)
  {
    std::vector<Handle> scaled = handles;
    for (Handle& handle : scaled)
    {
      handle.place *= scale;
      handle.radius *= scale;
    }
    return HandlesOfPoints(scale * P, scaled);
  };
  const std::vector<Handle> two = { Pin({ 0, 0, 0 }, 1.0), Pin({ 4, 1, 0 }, 0.0) };
  for (const double scale : { 1.0, 0x1p-900, 0x1p900 })
  {
    CHECK(of(two, scale) == (std::vector<int>{ 0, 0, -1, 1 }),
      "borders count, and of a handle without points the nearest, at scale " << scale);
  }
  CHECK(of({ Pin({ 1.5, 3, 0 }, 0.0) }) == (std::vector<int>{ -1, 0, -1, -1 }),
    "of equally near points the first counts");
  CHECK(of({}) == std::vector<int>(4, -1), "without handles no point is held");
  try
  {
    of({ Pin({ 5, 0, 0 }, 1.0), Pin({ 0, 0, 0 }, 2.0), Pin({ 1, 0, 0 }, 0.5) });
    CHECK(false, "a point in two handles should be refused");
  }
  catch (const PointInTwoHandles& error)
  {
    CHECK(error.Point == 1 && error.First == 1 && error.Second == 2, error.what());
  }
}

void TestBits()
{
  const TriangleMesh mesh = Cigar();
  const std::vector<Handle> handles = BendOf(mesh, 0.5 * Pi);
  const std::vector<int> ofPoints = HandlesOfPoints(mesh.P, handles);
  const Points Q = SolvedWith(mesh, handles);
  int held = 0;
  for (Eigen::Index i = 0; i < Q.rows(); ++i)
  {
    if (ofPoints[i] >= 0)
    {
      ++held;
      const Points p = mesh.P.row(i);
      CHECK(Meshes::SameBits(Q.row(i), MovedByHandle(handles[ofPoints[i]], p)),
        "point " << i << " should be where its handle takes it");
      CHECK(ofPoints[i] != 0 || Meshes::SameBits(Q.row(i), p), "point " << i << " is pinned");
    }
  }
  CHECK(held > 40 && held < Q.rows() / 2, held << " points are held");
  Handle about = handles[1];
  about.place = mesh.P.row(7).transpose();
  CHECK(Meshes::SameBits(MovedByHandle(about, mesh.P.row(7)), about.to.transpose()),
    "a point at the place of a handle goes to where that goes");
}

void TestInvariance()
{
  const TriangleMesh mesh = Cigar();
  const std::vector<Handle> handles = BendOf(mesh, 0.5 * Pi);
  const Points Q = SolvedWith(mesh, handles);
  const double diagonal = Meshes::Diagonal(mesh.P);

  const Eigen::Matrix3d R = RotationOfVector({ 0.3, -1.2, 0.7 });
  const Vector3d move(30.0, -20.0, 55.0);
  TriangleMesh other = mesh;
  other.P = ((mesh.P * R.transpose()).rowwise() + move.transpose()).eval();
  std::vector<Handle> turned = handles;
  for (Handle& handle : turned)
  {
    handle.place = R * handle.place + move;
    handle.to = R * handle.to + move;
    handle.turn = R * handle.turn;
  }
  const Points expected = (Q * R.transpose()).rowwise() + move.transpose();
  CHECK_NEAR(Meshes::Distance(SolvedWith(other, turned), expected) / diagonal, 0.0, 1e-6,
    "difference of a model that is elsewhere");

  other.P = 1000.0 * mesh.P;
  std::vector<Handle> scaled = handles;
  for (Handle& handle : scaled)
  {
    handle.place *= 1000.0;
    handle.to *= 1000.0;
    handle.radius *= 1000.0;
  }
  CHECK_NEAR(Meshes::Distance(SolvedWith(other, scaled), 1000.0 * Q) / (1000.0 * diagonal), 0.0,
    1e-6, "difference of a larger model");

  StyleSolver solver;
  solver.SetMesh(mesh);
  StyleOptions options = Held(mesh, handles);
  for (const int threads : { 1, 2, 5 })
  {
    options.threads = threads;
    solver.Solve(options);
    CHECK(Meshes::SameBits(solver.GetPositions(), Q), "the bits with " << threads << " threads");
  }
}

void TestDragging()
{
  const TriangleMesh mesh = Cigar();
  StyleSolver solver;
  solver.SetMesh(mesh);
  CHECK(solver.Solve(Held(mesh, BendOf(mesh, 0.2))).factored, "the first solve should factor");
  for (const double angle : { 0.4, 0.6, -1.0 })
  {
    const StyleOptions options = Held(mesh, BendOf(mesh, angle));
    CHECK(!solver.Solve(options).factored, "a handle that has moved should not factor");
    CHECK(Meshes::SameBits(solver.GetPositions(), SolvedWith(mesh, BendOf(mesh, angle))),
      "what was before should not show");
  }
}

void TestRigid()
{
  const TriangleMesh mesh = Cigar();
  Handle handle = Pin({ 0, 0, 4 }, 1.0);
  handle.to = { 3.0, 2.0, 1.0 };
  handle.turn = { 4.0, 1.0, 0.5 };
  CHECK_NEAR(Meshes::Distance(SolvedWith(mesh, { handle }), MovedByHandle(handle, mesh.P)), 0.0,
    1e-11, "difference from the rigid motion of one handle");
  CHECK_NEAR(Meshes::Distance(SolvedWith(mesh,
                                { handle,
                                  [&]
                                  {
                                    Handle other = handle;
                                    other.place = { 0, 0, -4 };
                                    const Points to =
                                      MovedByHandle(handle, other.place.transpose());
                                    other.to = to.row(0).transpose();
                                    return other;
                                  }() }),
               MovedByHandle(handle, mesh.P)),
    0.0, 1e-11, "difference from the rigid motion of two that agree");
}

void TestTwists()
{
  // Turned by a multiple of a turn the handle is where it was: rotations alone tell.
  const TriangleMesh mesh = Meshes::Scaled(Cigar(), { 1.0, 1.0, 4.0 });
  const double top = mesh.P.col(2).maxCoeff();
  const auto twisted = [&](double angle, bool turns, int& iterations)
  {
    std::vector<Handle> handles = { Pin({ 0, 0, -top }, 0.2 * top), Pin({ 0, 0, top }, 0.2 * top) };
    handles[1].turn = { 0.0, 0.0, angle };
    StyleOptions options = Held(mesh, handles);
    if (!turns)
    {
      options.fixedTurns.resize(0, 3);
    }
    StyleSolver solver;
    solver.SetMesh(mesh);
    const StyleReport report = solver.Solve(options);
    iterations = report.loop.iterations;
    return report.loop.history.back().energy.Total();
  };
  int with = 0;
  int without = 0;
  const double quarter = twisted(0.5 * Pi, true, with);
  CHECK_NEAR(twisted(0.5 * Pi, false, without) / quarter, 1.0, 1e-3,
    "energy of a quarter from R = I beside that from between the handles");
  CHECK(with < without, with << " iterations, " << without << " from R = I");
  const double half = twisted(Pi, true, with);
  const double turn = twisted(2.0 * Pi, true, with);
  CHECK(half > 2.0 * quarter && turn > 2.0 * half,
    "energies of a quarter, half and whole turn are " << quarter << ", " << half << ", " << turn);
  CHECK_NEAR(twisted(2.0 * Pi, false, without), 0.0, 1e-12 * quarter, "a whole turn from R = I");
}

void TestParts()
{
  TriangleMesh ball = Meshes::Moved(Meshes::Icosphere(1), { 1.8, 0.0, 3.9 });
  ball.P = (0.3 * ball.P).eval();
  const TriangleMesh cigar = Cigar();
  const TriangleMesh both = Meshes::Together({ cigar, Meshes::Moved(ball, { 1.1, 0.0, 2.0 }) });
  const Points before = both.P.bottomRows(ball.P.rows());
  const std::vector<Handle> handles = BendOf(cigar, 0.5 * Pi);
  StyleSolver solver;
  solver.SetMesh(both);
  solver.Solve(Held(both, handles));
  CHECK(Meshes::SameBits(solver.GetPositions().bottomRows(ball.P.rows()), before),
    "a part without a handle stays to the bit");
  CHECK_NEAR(
    Meshes::Distance(solver.GetPositions().topRows(cigar.P.rows()), SolvedWith(cigar, handles)),
    0.0, 1e-4, "the part with handles is as if alone");
  solver.Solve(Held(both, handles, ComponentCoupling::Stitched));
  CHECK(Meshes::Distance(solver.GetPositions().bottomRows(ball.P.rows()), before) > 1.0,
    "a part that is stitched goes along");
}

void TestRefused()
{
  const TriangleMesh mesh = Cigar();
  std::vector<Handle> handles = BendOf(mesh, 0.1);
  handles[1].to[0] = 1e9;
  CHECK_THROWS(std::invalid_argument, Held(mesh, handles), "row 2 takes points farther");
  handles[1].to[0] = 1e308;
  handles[0].to[0] = -1e308;
  CHECK_THROWS(std::invalid_argument, Held(mesh, handles), "row 1 takes points farther");
  StyleOptions options = Held(mesh, BendOf(mesh, 0.1));
  StyleSolver solver;
  solver.SetMesh(mesh);
  options.fixedTurns(0, 0) = std::nan("");
  CHECK_THROWS(std::invalid_argument, solver.Solve(options), "rotation vectors");
  options.fixedTurns.conservativeResize(1, 3);
  CHECK_THROWS(std::invalid_argument, solver.Solve(options), "one rotation vector");
}
}

int main()
{
  TestPointsOfHandles();
  TestBits();
  TestInvariance();
  TestDragging();
  TestRigid();
  TestTwists();
  TestParts();
  TestRefused();
  return CheckResult();
}
