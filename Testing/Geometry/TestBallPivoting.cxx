// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Triangles from points: ball pivoting against its definition by brute force, the advancing front,
// and the closing of what they leave.
#include "AdvancingFront.h"
#include "BallPivoting.h"
#include "Check.h"
#include "ClosedSurface.h"
#include "ConvexHull.h"
#include "Meshes.h"
#include "SurfaceMeasures.h"

#include <algorithm>
#include <set>
#include <string>

using namespace SphericalStyle;
using Eigen::Vector3d;

namespace
{
struct Samples
{
  std::string name;
  Points P;
  Points normals;
  double radius = 0.0;  ///< no two are nearer
  double missing = 0.0; ///< of the volume of their convex hull, at most: little but at sharp edges
};

Vector3d At(const Points& P, Eigen::Index i)
{
  return P.row(i).transpose();
}

bool IsFree(const std::vector<Vector3d>& points, const Vector3d& place, double radius)
{
  return std::all_of(points.begin(), points.end(),
    [&](const Vector3d& other) { return (other - place).squaredNorm() >= radius * radius; });
}

// Darts thrown at the surface by area; one that lands too near to an earlier one is dropped.
Samples Throw(
  const std::string& name, const TriangleMesh& mesh, int count, std::uint32_t seed, double missing)
{
  const Eigen::VectorXd areas = TriangleAreas(mesh.P, mesh.F);
  std::vector<double> upTo(areas.size());
  std::partial_sum(areas.begin(), areas.end(), upTo.begin());
  Samples samples;
  samples.name = name;
  samples.radius = std::sqrt(0.7 * upTo.back() / count);
  samples.missing = missing;
  Meshes::Random random(seed);
  std::vector<Vector3d> points;
  std::vector<Vector3d> normals;
  for (int dart = 0; dart < 30 * count; ++dart)
  {
    const auto found = std::lower_bound(upTo.begin(), upTo.end(), random.Unit() * upTo.back());
    const auto f = std::min<Eigen::Index>(found - upTo.begin(), mesh.F.rows() - 1);
    const Vector3d a = At(mesh.P, mesh.F(f, 0));
    const Vector3d u = At(mesh.P, mesh.F(f, 1)) - a;
    const Vector3d v = At(mesh.P, mesh.F(f, 2)) - a;
    double s = random.Unit();
    double t = random.Unit();
    if (s + t > 1.0)
    {
      s = 1.0 - s;
      t = 1.0 - t;
    }
    const Vector3d place = a + s * u + t * v;
    if (IsFree(points, place, samples.radius))
    {
      points.push_back(place);
      normals.push_back(u.cross(v).normalized());
    }
  }
  samples.P = Meshes::Make(points, {}).P;
  samples.normals = Meshes::Make(normals, {}).P;
  return samples;
}

std::vector<Samples> Surfaces()
{
  return { Throw("sphere", Meshes::Icosphere(4), 800, 1, 5e-6),
    Throw("box", Meshes::Box(1), 800, 2, 0.012),
    Throw("ellipsoid", Meshes::Ellipsoid(4), 800, 3, 1e-3),
    Throw("plate", Meshes::Box(1, { 0.5, 0.5, 0.01 }), 4000, 4, 0.025) };
}

Triangles Roll(const Samples& samples, std::vector<double> multiples)
{
  for (double& radius : multiples)
  {
    radius *= samples.radius;
  }
  return BallPivoting(samples.P, samples.normals, multiples);
}

int CountUsed(const Triangles& F)
{
  const auto corners = F.reshaped();
  return static_cast<int>(std::set<int>(corners.begin(), corners.end()).size());
}

// Euler's formula for a closed surface of one piece without handles.
int TrianglesOfSphere(Eigen::Index points)
{
  return 2 * static_cast<int>(points) - 4;
}

bool SameTriangles(const Triangles& A, const Triangles& B)
{
  return A.rows() == B.rows() && A == B;
}

// Every edge at most once in each direction.
bool AreEdgesManifold(const Triangles& F)
{
  std::set<std::pair<int, int>> edges;
  for (const auto& t : F.rowwise())
  {
    for (int k = 0; k < 3; ++k)
    {
      if (!edges.insert({ t[k], t[(k + 1) % 3] }).second)
      {
        return false;
      }
    }
  }
  return true;
}

// How far a point reaches into the ball on a triangle, as a fraction of the radius. The points are
// moved by 1e-7 of it before the ball rolls; when the ball just fits between the three corners its
// center moves by the square root of that.
double Intrusion(const Points& P, const Eigen::RowVector3i& t, double radius)
{
  const Vector3d a = At(P, t[0]);
  const Vector3d u = At(P, t[1]) - a;
  const Vector3d v = At(P, t[2]) - a;
  const Vector3d n = u.cross(v);
  const Vector3d toCenter =
    (u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u)) / (2.0 * n.squaredNorm());
  const double height = radius * radius - toCenter.squaredNorm();
  if (height < -1e-6 * radius * radius)
  {
    return 1.0;
  }
  const Vector3d center = a + toCenter + std::sqrt(std::max(0.0, height)) * n.normalized();
  const double nearest = (P.rowwise() - center.transpose()).rowwise().norm().minCoeff();
  return 1.0 - nearest / radius;
}

void CheckOrientation(const Samples& samples, const Triangles& F, const std::string& what)
{
  for (const auto& t : F.rowwise())
  {
    const Vector3d a = At(samples.P, t[0]);
    const Vector3d n = (At(samples.P, t[1]) - a).cross(At(samples.P, t[2]) - a);
    bool agrees = false;
    for (int k = 0; k < 3; ++k)
    {
      agrees = agrees || n.dot(At(samples.normals, t[k])) > 0.0;
    }
    CHECK(agrees, what << ": a triangle should be oriented like the normals");
  }
}

void TestDefinition(const Samples& samples)
{
  double worst = 0.0;
  for (const double multiple : { 1.0, 1.2, 1.5, 2.0, 4.0 })
  {
    const std::string what = samples.name + ", radius " + std::to_string(multiple);
    const Triangles F = Roll(samples, { multiple });
    CHECK(F.rows() > samples.P.rows(), what << ": there should be triangles, are " << F.rows());
    CHECK(AreEdgesManifold(F), what << ": an edge should have each direction once");
    CheckOrientation(samples, F, what);
    for (const auto& t : F.rowwise())
    {
      const double intrusion = Intrusion(samples.P, t, multiple * samples.radius);
      worst = std::max(worst, intrusion);
      CHECK(intrusion <= 1e-3, what << ": the ball should be empty, holds " << intrusion);
    }
  }
  std::cout << samples.name << ": " << samples.P.rows() << " points reach into balls by " << worst
            << std::endl;
}

double ShareOfAnglesAbove(double degrees, const TriangleMesh& mesh)
{
  int above = 0;
  for (const auto& t : mesh.F.rowwise())
  {
    for (int k = 0; k < 3; ++k)
    {
      const Vector3d a = At(mesh.P, t[k]);
      const Vector3d u = At(mesh.P, t[(k + 1) % 3]) - a;
      const Vector3d v = At(mesh.P, t[(k + 2) % 3]) - a;
      above += std::atan2(u.cross(v).norm(), u.dot(v)) > degrees * Pi / 180.0 ? 1 : 0;
    }
  }
  return static_cast<double>(above) / static_cast<double>(mesh.F.size());
}

void CheckClosed(const ClosedSurfaceResult& surface, const std::string& what)
{
  const int n = static_cast<int>(surface.mesh.P.rows());
  CHECK(surface.closed, what << ": the surface should be closed");
  CHECK(IsClosedManifold(surface.mesh.F, n), what << ": the surface should be a closed manifold");
  CHECK(surface.mesh.F.rows() == TrianglesOfSphere(n), what << ": the genus should be 0");
  CHECK(CountUsed(surface.mesh.F) == n, what << ": every point should be used");
  CHECK(EnclosedVolume(surface.mesh.P, surface.mesh.F) > 0.0, what << ": should face outward");
}

// All four surfaces are convex: the convex hull of their points is a reference that has nothing to
// do with balls.
void CheckVolume(
  const ClosedSurfaceResult& surface, const Samples& samples, const std::string& what)
{
  const Hull hull = ConvexHull(samples.P);
  const double share =
    EnclosedVolume(surface.mesh.P, surface.mesh.F) / EnclosedVolume(hull.mesh.P, hull.mesh.F);
  CHECK(share <= 1.0 + 1e-12 && share >= 1.0 - samples.missing,
    what << ": the volume is " << share << " times that of the hull");
}

void TestClosed(const Samples& samples)
{
  const Triangles F = Roll(samples, { 1.4, 2.0, 3.0 });
  CHECK(CountUsed(F) == samples.P.rows(), samples.name << ": every point should be used");
  CHECK(F.rows() >= 0.99 * TrianglesOfSphere(samples.P.rows()),
    samples.name << ": little should be missing, there are " << F.rows() << " triangles");
  const ClosedSurfaceResult surface = CloseSurface(samples.P, F);
  CheckClosed(surface, samples.name);
  CheckVolume(surface, samples, samples.name);
  const double share = ShareOfAnglesAbove(25.0, surface.mesh);
  CHECK(share > 0.99, samples.name << ": angles above 25 degrees are " << share);
  std::cout << samples.name << ": " << surface.holesClosed
            << " holes closed, angles above 25 degrees " << share << std::endl;
}

void TestInvariance(const Samples& samples)
{
  const std::vector<double> multiples = { 1.0, 1.5, 2.2 };
  const Triangles F = Roll(samples, multiples);
  CHECK(SameTriangles(F, Roll(samples, multiples)), samples.name << ": should be deterministic");
  for (const double scale : { 1e-150, 1e-6, 3.0, 1e6, 1e150 })
  {
    Samples other = samples;
    other.P *= scale;
    other.radius *= scale;
    other.normals *= 1.0 / scale;
    CHECK(SameTriangles(F, Roll(other, multiples)), samples.name << ": scaled by " << scale);
  }
  Samples moved = samples;
  moved.P.rowwise() += Eigen::RowVector3d(31.0, -17.0, 5.0);
  CHECK(SameTriangles(F, Roll(moved, multiples)), samples.name << ": moved");
}

// Squares: four points on every ball, all points of a side in one plane.
void TestLattice()
{
  for (const int k : { 2, 5, 12 })
  {
    for (const double multiple : { 0.75, 1.0, 1.7 })
    {
      const TriangleMesh box = Meshes::Box(k);
      const Triangles F = BallPivoting(box.P, PointNormals(box.P, box.F), { multiple * 2.0 / k });
      CHECK(F.rows() == TrianglesOfSphere(box.P.rows()),
        "lattice " << k << ", radius " << multiple << ": there are " << F.rows() << " triangles");
      const ClosedSurfaceResult surface = CloseSurface(box.P, F);
      CheckClosed(surface, "lattice");
      CHECK(surface.holesClosed == 0, "the lattice should need no filling");
      CHECK_NEAR(EnclosedVolume(surface.mesh.P, surface.mesh.F), 8.0, 1e-12, "lattice: volume");
    }
  }
  // All points on one ball.
  const TriangleMesh sphere = Meshes::Icosphere(2);
  const Triangles F = BallPivoting(sphere.P, sphere.P, { 0.6 });
  CHECK(CloseSurface(sphere.P, F).closed, "an icosphere should be closed");
}

// Nothing to find, but also nothing to stumble over.
void TestDegenerate()
{
  const auto roll = [](const Points& P)
  {
    const Points up = Eigen::RowVector3d::UnitZ().replicate(P.rows(), 1);
    Triangles F = BallPivoting(P, up, { 0.5, 1.0, 5.0 });
    CHECK(F.rows() == 0 || F.maxCoeff() < P.rows(), "corners should be points");
    CHECK(AreEdgesManifold(F), "an edge should have each direction once");
    const ClosedSurfaceResult front = CloseSurface(P, AdvancingFront(P));
    CHECK(!CloseSurface(P, F).closed || P.rows() > 3, "three points close nothing");
    CHECK(!front.closed || P.rows() > 3, "three points close nothing");
    return F;
  };
  for (const int n : { 0, 1, 2, 3, 1000 })
  {
    CHECK(roll(Points::Zero(n, 3)).rows() == 0, n << " points at one place have no triangles");
    CHECK(roll(Points::Constant(n, 3, 7.7)).rows() == 0, n << " points at one place");
    const Points line = 0.3 * Eigen::VectorXd::LinSpaced(n, 0, n) * Eigen::RowVector3d::UnitY();
    CHECK(roll(line).rows() == 0 || n > 3, n << " points on a line have no triangles");
  }
  const TriangleMesh patch = Meshes::Patch(8, 0.0);
  roll(patch.P);
  Points twice(2 * patch.P.rows(), 3);
  twice << patch.P, patch.P;
  roll(twice);
  roll(Points::Random(300, 3));
  roll(1e-9 * Points::Random(300, 3));
  roll(1e300 * Points::Random(300, 3));
  roll(1e9 * Points::Random(300, 3));
  Points cluster = Points::Random(300, 3);
  cluster.topRows(150) *= 1e-7;
  roll(cluster);
  roll(Meshes::Box(6, { 2, 1e-7, 1e-7 }).P);

  const Points P = Points::Random(5, 3);
  CHECK_THROWS(std::invalid_argument, BallPivoting(P, P.topRows(4), { 1.0 }), "normal");
  CHECK_THROWS(std::invalid_argument, BallPivoting(P, P, { 1.0, 1.0 }), "ascend");
  CHECK_THROWS(std::invalid_argument, BallPivoting(P, P, { 0.0 }), "ascend");
  CHECK(BallPivoting(P, P, {}).rows() == 0, "no ball, no triangles");
}

// Twice the same sphere, the second time in other places of the list.
void TestDuplicates(const Samples& samples)
{
  Samples twice = samples;
  const Eigen::Index n = samples.P.rows();
  twice.P.resize(2 * n, 3);
  twice.P << samples.P, samples.P.colwise().reverse();
  twice.normals.resize(2 * n, 3);
  twice.normals << samples.normals, samples.normals.colwise().reverse();
  CHECK(SameTriangles(Roll(samples, { 1.5 }), Roll(twice, { 1.5 })), "the first should be taken");
}

// An open sheet: the ball must not come round to its back.
void TestOpenSheet()
{
  const TriangleMesh patch = Meshes::Patch(10, 0.02);
  const double spacing = (patch.P.row(1) - patch.P.row(0)).norm();
  const Points normals = PointNormals(patch.P, patch.F);
  const Triangles F = BallPivoting(patch.P, normals, { spacing, 2.0 * spacing });
  CHECK(F.rows() == 200, "a sheet of 100 squares has " << F.rows() << " triangles");
  const Triangles back = BallPivoting(patch.P, -normals, { spacing });
  CHECK(back.rows() == 200, "its back has " << back.rows() << " triangles");
}

// A larger ball goes on from a triangle only if it can lie there: over the triangle abc hangs a
// point that the second ball would hold, so that it never gets to d. What hangs there, and d, face
// the other way: they are no places to start from.
void TestNoRoomToGoOn()
{
  const Points P = Meshes::Make(
    { { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, -0.8, 0 }, { 0.5, 1, 0 }, { 0.5, -1, 1.2 } }, {})
                     .P;
  Points normals = Points::Zero(5, 3);
  normals.col(2) << 1, 1, 1, -1, -1;
  const Triangles F = BallPivoting(P, normals, { 0.6, 1.0 });
  CHECK(F.rows() == 1 && F.maxCoeff() == 2, "the second ball has no room: " << F.rows());
  Points free = P;
  free(4, 2) = 5.0;
  CHECK(BallPivoting(free, normals, { 0.6, 1.0 }).rows() == 2, "with room it should get to d");
}

Triangles Without(const Triangles& F, const std::set<Eigen::Index>& removed)
{
  Triangles kept(F.rows() - static_cast<Eigen::Index>(removed.size()), 3);
  Eigen::Index m = 0;
  for (Eigen::Index f = 0; f < F.rows(); ++f)
  {
    if (removed.count(f) == 0)
    {
      kept.row(m++) = F.row(f);
    }
  }
  return kept;
}

std::set<Eigen::Index> TrianglesAround(
  const TriangleMesh& mesh, const Vector3d& place, double reach)
{
  std::set<Eigen::Index> near;
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    const Vector3d middle =
      (At(mesh.P, mesh.F(f, 0)) + At(mesh.P, mesh.F(f, 1)) + At(mesh.P, mesh.F(f, 2))) / 3.0;
    if ((middle - place).norm() < reach)
    {
      near.insert(f);
    }
  }
  return near;
}

void TestHoles()
{
  const TriangleMesh sphere = Meshes::Icosphere(3);
  const double volume = EnclosedVolume(sphere.P, sphere.F);
  for (const double reach : { 0.1, 0.3, 0.7 })
  {
    std::set<Eigen::Index> removed = TrianglesAround(sphere, { 1, 0, 0 }, reach);
    removed.merge(TrianglesAround(sphere, { 0, 0.6, -0.8 }, reach));
    Triangles F = Without(sphere.F, removed);
    for (Eigen::Index f = 0; f < F.rows(); f += 3)
    {
      std::swap(F(f, 0), F(f, 1)); // in disorder
    }
    const ClosedSurfaceResult surface = CloseSurface(sphere.P, F);
    CheckClosed(surface, "punched by " + std::to_string(reach));
    CHECK(surface.holesClosed == 2, "two holes were punched, " << surface.holesClosed << " closed");
    CHECK_NEAR(EnclosedVolume(surface.mesh.P, surface.mesh.F) / volume, 1.0,
      0.01 + 0.3 * std::pow(reach, 4), "volume after holes of " << reach);
  }
  const ClosedSurfaceResult whole = CloseSurface(sphere.P, sphere.F);
  CheckClosed(whole, "a whole sphere");
  CHECK(whole.holesClosed == 0 && Meshes::SameBits(whole.mesh.P, sphere.P), "nothing to do");
  Triangles inward = sphere.F;
  inward.col(0).swap(inward.col(1));
  CheckClosed(CloseSurface(sphere.P, inward), "an inward sphere");
}

// A ring of k squares whose ends meet after half a turn (odd) or none.
TriangleMesh Ring(int k, bool moebius)
{
  std::vector<Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < k; ++i)
  {
    const double phi = 2.0 * Pi * i / k;
    const double tilt = moebius ? 0.5 * phi : 0.4;
    for (const double side : { -0.3, 0.3 })
    {
      const double r = 1.0 + side * std::cos(tilt);
      points.emplace_back(r * std::cos(phi), r * std::sin(phi), side * std::sin(tilt));
    }
    const bool swapped = moebius && i == k - 1;
    const int a = 2 * i;
    const int c = 2 * ((i + 1) % k) + (swapped ? 1 : 0);
    const int d = 2 * ((i + 1) % k) + (swapped ? 0 : 1);
    triangles.push_back({ a, c, a + 1 });
    triangles.push_back({ a + 1, c, d });
  }
  return Meshes::Make(points, triangles);
}

TriangleMesh Torus(int k)
{
  std::vector<Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < k; ++i)
  {
    for (int j = 0; j < k; ++j)
    {
      const double phi = 2.0 * Pi * i / k;
      const double psi = 2.0 * Pi * j / k;
      const double r = 1.0 + 0.4 * std::cos(psi);
      points.emplace_back(r * std::cos(phi), r * std::sin(phi), 0.4 * std::sin(psi));
      const int next = (i + 1) % k;
      const int a = i * k + j, b = next * k + j, c = next * k + (j + 1) % k,
                d = i * k + (j + 1) % k;
      triangles.push_back({ a, b, c });
      triangles.push_back({ a, c, d });
    }
  }
  return Meshes::Make(points, triangles);
}

TriangleMesh Joined(const TriangleMesh& first, const TriangleMesh& second)
{
  TriangleMesh mesh;
  mesh.P.resize(first.P.rows() + second.P.rows(), 3);
  mesh.P << first.P, second.P;
  mesh.F.resize(first.F.rows() + second.F.rows(), 3);
  mesh.F << first.F, (second.F.array() + static_cast<int>(first.P.rows())).matrix();
  return mesh;
}

// Two spheres of different size that share the first point.
TriangleMesh BowTie()
{
  const TriangleMesh large = Meshes::Icosphere(2);
  TriangleMesh small = Meshes::Scaled(Meshes::Icosphere(1), { 0.5, 0.5, 0.5 });
  small.P.rowwise() += large.P.row(0) - small.P.row(3);
  TriangleMesh mesh = Joined(large, small);
  const int shared = static_cast<int>(large.P.rows()) + 3;
  for (int& corner : mesh.F.reshaped())
  {
    corner = corner == shared ? 0 : corner;
  }
  return mesh;
}

void TestOddInputs()
{
  const TriangleMesh moebius = Ring(15, true);
  const ClosedSurfaceResult strip = CloseSurface(moebius.P, moebius.F);
  CHECK(!strip.closed && strip.mesh.F.rows() > 0, "a Moebius strip cannot be closed");
  const TriangleMesh ring = Ring(15, false);
  const ClosedSurfaceResult disk = CloseSurface(ring.P, ring.F);
  CHECK(disk.holesClosed == 2, "a ring has two borders, " << disk.holesClosed << " were closed");
  const TriangleMesh torus = Torus(12);
  const ClosedSurfaceResult handle = CloseSurface(torus.P, torus.F);
  CHECK(!handle.closed && handle.mesh.F.rows() == 288, "a torus is not of genus 0");

  const TriangleMesh two =
    Joined(Meshes::Tetrahedron(), Meshes::Scaled(Meshes::Icosphere(1), { 9, 9, 9 }));
  const ClosedSurfaceResult larger = CloseSurface(two.P, two.F);
  CheckClosed(larger, "the larger of two");
  CHECK(larger.mesh.P.rows() == 42, "the larger part has " << larger.mesh.P.rows() << " points");

  const TriangleMesh bowTie = BowTie();
  const ClosedSurfaceResult part = CloseSurface(bowTie.P, bowTie.F);
  CheckClosed(part, "the larger wing");
  CHECK(part.mesh.P.rows() == 162, "the larger wing has " << part.mesh.P.rows() << " points");

  for (const TriangleMesh& mesh : { Meshes::NonManifoldFan(), Meshes::ThreeAtAnEdge(),
         Meshes::Patch(5, 0.1), Meshes::Patch(5, 0.0), Meshes::Slivers() })
  {
    const ClosedSurfaceResult result = CloseSurface(mesh.P, mesh.F);
    const int n = static_cast<int>(result.mesh.P.rows());
    CHECK(CountUsed(result.mesh.F) == n, "only points in use should be left");
    CHECK(!result.closed || IsClosedManifold(result.mesh.F, n), "closed should mean a manifold");
  }
  const ClosedSurfaceResult none = CloseSurface(Points(0, 3), Triangles(0, 3));
  CHECK(!none.closed && none.mesh.F.rows() == 0, "nothing closes nothing");
  Triangles wrong(3, 3);
  wrong << 0, 0, 1, 0, 1, 9, -1, 2, 3;
  CHECK(!CloseSurface(Meshes::Tetrahedron().P, wrong).closed, "no triangle of these is one");
}

void TestIsClosedManifold()
{
  const auto closed = [](const TriangleMesh& mesh)
  { return IsClosedManifold(mesh.F, static_cast<int>(mesh.P.rows())); };
  const TriangleMesh tetrahedron = Meshes::Tetrahedron();
  CHECK(closed(tetrahedron), "a tetrahedron is closed");
  CHECK(closed(Torus(8)), "a torus is closed");
  CHECK(closed(Meshes::TwoComponents()), "two surfaces are closed");
  CHECK(IsClosedManifold(tetrahedron.F, 7), "points of no triangle are not looked at");
  CHECK(!IsClosedManifold(tetrahedron.F, 3), "corners must be points");
  CHECK(!closed(BowTie()), "two fans at a point");
  CHECK(!closed(Meshes::Patch(3, 0.0)) && !closed(Ring(9, true)), "borders");
  CHECK(!closed(Meshes::ThreeAtAnEdge()), "three triangles at an edge");
  CHECK(!IsClosedManifold(Triangles(0, 3), 4), "no triangles");
  CHECK(!IsClosedManifold(Without(tetrahedron.F, { 2 }), 4), "a hole");
  TriangleMesh flipped = tetrahedron;
  std::swap(flipped.F(1, 0), flipped.F(1, 1));
  CHECK(!closed(flipped), "one triangle in the other direction");
  flipped = Joined(tetrahedron, tetrahedron);
  flipped.F.bottomRows(4) = tetrahedron.F;
  CHECK(!closed(flipped), "every triangle twice");
}

void TestAdvancingFront(const Samples& samples)
{
  const Triangles F = AdvancingFront(samples.P);
  const ClosedSurfaceResult surface = CloseSurface(samples.P, F);
  CheckClosed(surface, "advancing front, " + samples.name);
  CheckVolume(surface, samples, "advancing front, " + samples.name);
  for (const int exponent : { -400, -20, 0, 20, 400 }) // exact: the same points
  {
    CHECK(SameTriangles(F, AdvancingFront(std::ldexp(1.0, exponent) * samples.P)),
      "advancing front, " << samples.name << ", scaled by 2^" << exponent);
  }
  for (const double scale : { 1e-6, 1e6 })
  {
    const Points P = scale * samples.P;
    CheckClosed(CloseSurface(P, AdvancingFront(P)), "advancing front, scaled " + samples.name);
  }
}
} // namespace

int main()
{
  const std::vector<Samples> surfaces = Surfaces();
  for (const Samples& samples : surfaces)
  {
    TestDefinition(samples);
    TestClosed(samples);
    TestInvariance(samples);
  }
  TestLattice();
  TestDegenerate();
  TestDuplicates(surfaces[0]);
  TestOpenSheet();
  TestHoles();
  TestNoRoomToGoOn();
  TestOddInputs();
  TestIsClosedManifold();
  for (const int k : { 0, 1, 2 }) // the sides of the plate are too near to each other
  {
    TestAdvancingFront(surfaces[k]);
  }
  return CheckResult();
}
