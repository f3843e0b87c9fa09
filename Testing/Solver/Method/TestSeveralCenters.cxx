// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Several centers [energy]: shares, spheres of the parts, targets by brute force, one center given
// back, three balls of a snowman; and spheres of the points that are not fixed.
#include "CenterShares.h"
#include "Check.h"
#include "Dense.h"
#include "FixedIterations.h"
#include "Meshes.h"
#include "Solved.h"
#include "StyleSolver.h"
#include "SurfaceMeasures.h"

#include <algorithm>

using namespace SphericalStyle;
using Eigen::Vector3d;

namespace
{
// 0, 1, ... in slabs across the axis; cuts as fractions of the extent.
std::vector<int> IdsAlong(const Points& P, const Vector3d& axis, const std::vector<double>& cuts)
{
  const Eigen::VectorXd at = P * axis;
  const double low = at.minCoeff(), extent = at.maxCoeff() - low;
  std::vector<int> ids;
  for (const double x : at)
  {
    ids.push_back(static_cast<int>(
      std::count_if(cuts.begin(), cuts.end(), [&](double cut) { return x > low + cut * extent; })));
  }
  return ids;
}

// Balls on top of each other, one surface of revolution: the outline is the outermost of the
// circles.
TriangleMesh Snowman(const std::vector<std::pair<double, double>>& balls, std::vector<int>& ids)
{
  TriangleMesh mesh = Meshes::EllipsoidUV(40, 90);
  ids.assign(mesh.P.rows(), 0);
  const double low = balls.front().second - balls.front().first;
  const double high = balls.back().second + balls.back().first;
  const double bottom = mesh.P.col(2).minCoeff(), top = mesh.P.col(2).maxCoeff();
  for (Eigen::Index i = 0; i < mesh.P.rows(); ++i)
  {
    // From the height on the ellipsoid by its polar angle, so that the poles stay covered.
    const double angle = std::acos(1.0 - 2.0 * (mesh.P(i, 2) - bottom) / (top - bottom)) / Pi;
    const double z = low + angle * (high - low);
    double radius = 0.0;
    for (std::size_t k = 0; k < balls.size(); ++k)
    {
      const double square = balls[k].first * balls[k].first - std::pow(z - balls[k].second, 2);
      if (square > radius * radius)
      {
        radius = std::sqrt(square);
        ids[i] = static_cast<int>(k);
      }
    }
    if (angle > 0.5 && radius == 0.0)
    {
      ids[i] = static_cast<int>(balls.size()) - 1;
    }
    const double from = std::hypot(mesh.P(i, 0), mesh.P(i, 1));
    mesh.P.row(i) << (from > 0.0 ? radius / from : 0.0) * mesh.P(i, 0),
      (from > 0.0 ? radius / from : 0.0) * mesh.P(i, 1), z;
  }
  return mesh;
}

// Least squares on |x|^2 - 2 c x + |c|^2 - r^2 = 0. @return radius, rms distance over it
std::pair<double, double> FittedSphere(const Points& P, const std::vector<int>& ids, int part)
{
  std::vector<int> own;
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    if (ids[i] == part)
    {
      own.push_back(static_cast<int>(i));
    }
  }
  const Points Q = P(own, AllColumns);
  Eigen::MatrixXd A(Q.rows(), 4);
  A << 2.0 * Q, Eigen::VectorXd::Ones(Q.rows());
  const Eigen::VectorXd x = Dense::Solve(A, Q.rowwise().squaredNorm());
  const Eigen::RowVector3d c = x.head(3).transpose();
  const double r = std::sqrt(x[3] + c.squaredNorm());
  const Eigen::VectorXd off = (Q.rowwise() - c).rowwise().norm().array() - r;
  return { r, std::sqrt(off.squaredNorm() / static_cast<double>(Q.rows())) / r };
}

void TestShares()
{
  for (const auto& [name, mesh] : std::vector<Meshes::Named>{ { "ellipsoid", Meshes::Ellipsoid(3) },
         { "slivers", Meshes::Slivers() }, { "two parts", Meshes::TwoComponents() },
         { "open", Meshes::Patch(12, 0.2) } })
  {
    const MeshTopology topology(mesh.F, static_cast<int>(mesh.P.rows()));
    const HalfEdgeScalars c = HalfEdgeCotangents(mesh.P, mesh.F);
    const Vector3d axis = Vector3d(1.0, 0.2, -0.3).normalized();
    const std::vector<int> ids = IdsAlong(mesh.P, axis, { 0.3, 0.5, 0.55, 0.8 });
    const Eigen::MatrixXd step = CenterShares(mesh.P, topology, c, 0.0, ids, 5);
    const Eigen::MatrixXd smooth = CenterShares(mesh.P, topology, c, 0.1, ids, 5);
    for (Eigen::Index i = 0; i < mesh.P.rows(); ++i)
    {
      for (int k = 0; k < 5; ++k)
      {
        CHECK(step(i, k) == (ids[i] == k ? 1.0 : 0.0), name << ": width 0 should be a step");
      }
      CHECK_NEAR(smooth.row(i).sum(), 1.0, 1e-14, name << ": sum of the shares of point " << i);
      CHECK(smooth.row(i).minCoeff() >= 0.0, name << ": shares should not be negative");
    }
  }
  // Obtuse triangles, and one point on its own: beside it the smooth shares would be below 0.
  TriangleMesh sheared = Meshes::Patch(12, 0.0);
  sheared.P.col(0) += 3.0 * sheared.P.col(1);
  std::vector<int> alone(sheared.P.rows(), 0);
  alone[6 * 13 + 6] = 1;
  const Eigen::MatrixXd beside =
    CenterShares(sheared.P, MeshTopology(sheared.F, static_cast<int>(sheared.P.rows())),
      HalfEdgeCotangents(sheared.P, sheared.F), 0.3, alone, 2);
  CHECK(beside.minCoeff() == 0.0, "shares below 0 should be 0, not " << beside.minCoeff());
  CHECK_NEAR(beside.rowwise().sum().maxCoeff(), 1.0, 1e-14, "and the others add up to 1");
  CHECK_NEAR(beside.rowwise().sum().minCoeff(), 1.0, 1e-14, "and the others add up to 1");

  // On a strip far longer than the blend two steps give 1/2 at the border and e^-x (1 + x / 2) / 2
  // from there on, x = distance over size.
  const TriangleMesh patch = Meshes::Scaled(Meshes::Patch(120, 0.0), { 10.0, 0.5, 1.0 });
  const MeshTopology topology(patch.F, static_cast<int>(patch.P.rows()));
  const std::vector<int> ids = IdsAlong(patch.P, { 1, 0, 0 }, { 0.5 });
  const double size = 1.0;
  const Eigen::MatrixXd shares =
    CenterShares(patch.P, topology, HalfEdgeCotangents(patch.P, patch.F), size, ids, 2);
  // The border lies halfway between the last point of one id and the first of the other.
  double below = -1e30, above = 1e30;
  for (Eigen::Index i = 0; i < patch.P.rows(); ++i)
  {
    double& side = ids[i] == 0 ? below : above;
    side = ids[i] == 0 ? std::max(side, patch.P(i, 0)) : std::min(side, patch.P(i, 0));
  }
  const double border = 0.5 * (below + above);
  const double length = patch.P.col(0).maxCoeff() - border;
  for (Eigen::Index i = 0; i < patch.P.rows(); ++i)
  {
    const double x = std::abs(patch.P(i, 0) - border) / size;
    if (x < 0.4 * length)
    {
      const double expected = 0.5 * std::exp(-x) * (1.0 + 0.5 * x);
      CHECK_NEAR(shares(i, 1 - ids[i]), expected, 0.004, "share at " << x << " sizes");
    }
  }
}

void TestSpheresOfParts()
{
  TriangleMesh mesh = Meshes::TwoComponents();
  const MeshTopology topology(mesh.F, static_cast<int>(mesh.P.rows()));
  const std::vector<int>& parts = topology.GetComponents();
  for (const CenterMode center : { CenterMode::PointMean, CenterMode::AreaCentroid })
  {
    for (const RadiusMode radius : { RadiusMode::EqualArea, RadiusMode::EqualVolume })
    {
      const std::vector<Sphere> spheres =
        TargetSpheres(mesh.P, mesh.F, parts, 2, center, radius, Sphere());
      for (int k = 0; k < 2; ++k)
      {
        // The component alone.
        std::vector<int> own, rank(parts.size(), -1);
        for (std::size_t i = 0; i < parts.size(); ++i)
        {
          if (parts[i] == k)
          {
            rank[i] = static_cast<int>(own.size());
            own.push_back(static_cast<int>(i));
          }
        }
        std::vector<int> triangles;
        for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
        {
          if (parts[mesh.F(f, 0)] == k)
          {
            triangles.push_back(static_cast<int>(f));
          }
        }
        Triangles F = mesh.F(triangles, AllColumns);
        F = F.unaryExpr([&](int i) { return rank[i]; }).eval();
        const Points P = mesh.P(own, AllColumns);
        const Sphere alone = TargetSphere(P, F, center, radius, Sphere());
        CHECK_NEAR((spheres[k].center - alone.center).norm(), 0.0, 1e-13, "center of part " << k);
        CHECK_NEAR(spheres[k].radius, alone.radius, 1e-13, "radius of part " << k);
      }
    }
  }
  // Every triangle counts for one part: areas add up.
  mesh = Meshes::Ellipsoid(3);
  const std::vector<int> ids = IdsAlong(mesh.P, { 0, 0, 1 }, { 0.3, 0.45, 0.55, 0.7 });
  const std::vector<Sphere> spheres =
    TargetSpheres(mesh.P, mesh.F, ids, 5, CenterMode::PointMean, RadiusMode::EqualArea, Sphere());
  double area = 0.0;
  for (const Sphere& sphere : spheres)
  {
    area += 4.0 * Pi * sphere.radius * sphere.radius;
  }
  CHECK_NEAR(area, TriangleAreas(mesh.P, mesh.F).sum(), 1e-12, "sum of the areas of the parts");
  CHECK_THROWS(std::invalid_argument,
    TargetSpheres(mesh.P, mesh.F, ids, 6, CenterMode::PointMean, RadiusMode::EqualArea, Sphere()),
    "part 5");
}

StyleOptions WithIds(StyleOptions options, const std::vector<int>& ids, double blend)
{
  options.centerIds = ids;
  options.centerBlend = blend;
  return options;
}

// Several centers at one place are one center.
void TestOneCenterGivenBack()
{
  const TriangleMesh mesh = Meshes::Perturbed(Meshes::House(), 0.02, 2);
  const auto n = static_cast<std::size_t>(mesh.P.rows());
  const Vector3d O(0.1, -0.05, 0.2);
  for (const double a : { 0.0, 0.7 })
  {
    StyleOptions one = Fixed({}, 6);
    one.lambda = 1.3;
    one.normalBlend = a;
    const Points byDefault = Solved(mesh, one);
    CHECK(Meshes::SameBits(byDefault, Solved(mesh, WithIds(one, std::vector<int>(n, 0), 0.1))),
      "one id for all should be the same as none");
    one.centerMode = CenterMode::Custom;
    one.radiusMode = RadiusMode::Custom;
    one.custom = { O, 0.8 };
    const Points custom = Solved(mesh, one);
    for (const double blend : { 0.0, 0.1 })
    {
      StyleOptions three = WithIds(one, IdsAlong(mesh.P, { 0, 1, 0 }, { 0.3, 0.7 }), blend);
      CHECK_NEAR(Meshes::Distance(custom, Solved(mesh, three)), 0.0, 1e-11,
        "a " << a << ", blend " << blend << ": three at one place");
      three.centerMode = CenterMode::PointMean;
      three.centers = O.transpose().replicate<3, 1>();
      CHECK_NEAR(Meshes::Distance(custom, Solved(mesh, three)), 0.0, 1e-11,
        "a " << a << ", blend " << blend << ": three given centers");
    }
  }
}

// Another edge weighting has other triangles, and with them other shares.
void TestSharesOfOtherTriangles()
{
  const TriangleMesh mesh = Meshes::Slivers();
  StyleOptions options = WithIds(Fixed({}, 3), IdsAlong(mesh.P, Vector3d(1, 0, 0), { 0.4 }), 0.1);
  StyleSolver solver;
  solver.SetMesh(mesh);
  solver.Solve(options);
  const Points before = solver.GetPositions();
  options.edgeWeighting = EdgeWeighting::IntrinsicDelaunay;
  solver.Solve(options);
  CHECK(Meshes::SameBits(solver.GetPositions(), Solved(mesh, options)),
    "a solver that has solved with other triangles should forget their shares");
  options.edgeWeighting = EdgeWeighting::HalfEdge;
  solver.Solve(options);
  CHECK(Meshes::SameBits(solver.GetPositions(), before), "and take the former ones again");
}

// At lambda 1e9 and a = 0 an edge is its target, where the targets fit together: two parts that
// share no edge become balls of their own around their means.
void TestTwoBalls()
{
  const TriangleMesh mesh = Meshes::TwoComponents();
  const MeshTopology topology(mesh.F, static_cast<int>(mesh.P.rows()));
  const std::vector<int>& parts = topology.GetComponents();
  StyleOptions options = WithIds({}, parts, 0.05);
  options.lambda = 1e9;
  StyleSolver solver;
  solver.SetMesh(mesh);
  const StyleReport report = solver.Solve(options);
  CHECK(report.spheres.size() == 2, "there should be two spheres");
  for (int k = 0; k < 2; ++k)
  {
    const auto [radius, error] = FittedSphere(solver.GetPositions(), parts, k);
    CHECK_NEAR(error, 0.0, 1e-6, "error of the sphere fitted to part " << k);
    CHECK_NEAR(radius / report.spheres[k].radius, 1.0, 1e-6, "its radius over r");
  }
}

void TestSnowman()
{
  std::vector<int> ids;
  const TriangleMesh mesh = Snowman({ { 1.0, 0.0 }, { 0.7, 1.3 }, { 0.5, 2.2 } }, ids);
  // Drums of the balls, so that there is something to round.
  TriangleMesh drums = mesh;
  for (Eigen::Index i = 0; i < drums.P.rows(); ++i)
  {
    const double from = std::hypot(mesh.P(i, 0), mesh.P(i, 1));
    drums.P.row(i).head(2) *= 1.0 - 0.2 * from;
  }
  StyleOptions options = WithIds({}, ids, 0.02);
  options.lambda = 5.0;
  options.loop.tolerance = 1e-6;
  StyleSolver solver;
  solver.SetMesh(drums);
  const StyleReport report = solver.Solve(options);
  const Points three = solver.GetPositions();
  for (std::size_t k = 1; k < report.loop.history.size(); ++k)
  {
    const HistoryRow& row = report.loop.history[k];
    CHECK(row.localChange <= 0.0 && row.globalChange <= 1e-12 * report.loop.restEnergy,
      "the energy should not rise in iteration " << k);
  }
  options.centerIds.clear();
  const Points one = Solved(drums, options);
  double ofOne = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    const auto [rest, before] = FittedSphere(drums.P, ids, k);
    const auto [radius, error] = FittedSphere(three, ids, k);
    const auto [other, unused] = FittedSphere(one, ids, k);
    const double r = report.spheres[k].radius;
    std::cout << "ball " << k << ": error at rest " << before << ", three centers " << error
              << "; radius over r three " << radius / r << ", one " << other / r << "\n";
    CHECK(error < 0.03, "ball " << k << " should be within 3 % of a sphere, is " << error);
    CHECK_NEAR(radius / r, 1.0, 0.03, "ball " << k << ": fitted radius over r");
    ofOne = std::max(ofOne, other / r);
  }
  CHECK(
    ofOne > 1.5, "one center should make one ball of all: the largest radius over r is " << ofOne);
  // No jump at the joints: no edge across them grows out of line with the edges beside it.
  double across = 0.0, within = 0.0;
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int u = mesh.F(f, k), v = mesh.F(f, (k + 1) % 3);
      const double growth =
        (three.row(u) - three.row(v)).norm() / (drums.P.row(u) - drums.P.row(v)).norm();
      (ids[u] == ids[v] ? within : across) = std::max(ids[u] == ids[v] ? within : across, growth);
    }
  }
  std::cout << "largest growth of an edge across joints " << across << ", elsewhere " << within
            << "\n";
  CHECK(across <= within, "edges across joints should not grow more than others");
}

// With a region, center and radius are those of what may move.
void TestSphereOfFreePoints()
{
  const TriangleMesh mesh = Meshes::Ellipsoid(3);
  const std::vector<int> side = IdsAlong(mesh.P, { 1, 0, 0 }, { 0.55 });
  StyleOptions options;
  for (std::size_t i = 0; i < side.size(); ++i)
  {
    if (side[i] == 0)
    {
      options.fixedPoints.push_back(static_cast<int>(i));
    }
  }
  options.fixedPositions = mesh.P(options.fixedPoints, AllColumns);
  StyleSolver solver;
  solver.SetMesh(mesh);
  const StyleReport all = solver.Solve(options);
  options.sphereOfFreePoints = true;
  const StyleReport free = solver.Solve(options);
  CHECK(!free.factored, "another sphere should not factor");
  const Sphere whole =
    TargetSphere(mesh.P, mesh.F, CenterMode::PointMean, RadiusMode::EqualArea, Sphere());
  const Sphere part = TargetSpheres(
    mesh.P, mesh.F, side, 2, CenterMode::PointMean, RadiusMode::EqualArea, Sphere())[1];
  CHECK_NEAR((all.sphere.center - whole.center).norm(), 0.0, 1e-13, "center of the whole");
  CHECK_NEAR((free.sphere.center - part.center).norm(), 0.0, 1e-13, "center of the free points");
  CHECK_NEAR(free.sphere.radius, part.radius, 1e-13, "radius of the free points");
  const Points Q = solver.GetPositions();
  CHECK(Meshes::SameBits(Points(Q(options.fixedPoints, AllColumns)), options.fixedPositions),
    "fixed points should keep their bits");
  options.fixedPoints.resize(mesh.P.rows());
  std::iota(options.fixedPoints.begin(), options.fixedPoints.end(), 0);
  options.fixedPositions = mesh.P;
  CHECK_THROWS(std::invalid_argument, solver.Solve(options), "every point is fixed");
  options.sphereOfFreePoints = false;
  CHECK(solver.Solve(options).loop.converged, "with every point fixed there is nothing to do");
  CHECK(Meshes::SameBits(solver.GetPositions(), mesh.P), "and nothing should move");
}

void TestRefused()
{
  const TriangleMesh mesh = Meshes::Box(3);
  const auto n = static_cast<std::size_t>(mesh.P.rows());
  StyleSolver solver;
  solver.SetMesh(mesh);
  const std::vector<int> ids = IdsAlong(mesh.P, { 1, 0, 0 }, { 0.5 });
  StyleOptions options;
  options.centerIds = std::vector<int>(n - 1, 0);
  CHECK_THROWS(std::invalid_argument, solver.Solve(options), "center id");
  options.centerIds = std::vector<int>(n, 0);
  options.centerIds[3] = -1;
  CHECK_THROWS(std::invalid_argument, solver.Solve(options), "negative");
  options.centerIds = ids;
  options.centers = Points::Zero(3, 3);
  CHECK_THROWS(std::invalid_argument, solver.Solve(options), "one center per center id");
  options.centers = Points::Constant(2, 3, std::nan(""));
  CHECK_THROWS(std::invalid_argument, solver.Solve(options), "finite");
  options.centers.resize(0, 3);
  options.centerBlend = -0.1;
  CHECK_THROWS(std::invalid_argument, solver.Solve(options), "center blend");
}
} // namespace

int main()
{
  TestShares();
  TestSpheresOfParts();
  TestOneCenterGivenBack();
  TestSharesOfOtherTriangles();
  TestTwoBalls();
  TestSnowman();
  TestSphereOfFreePoints();
  TestRefused();
  return CheckResult();
}
