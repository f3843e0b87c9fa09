// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Edges through thin walls [wall]. Which points they join and how strongly: on plates by the
// formula, nothing in solids, sheets and gaps. What they do to the base, whatever the triangles.
// And what a solve keeps of walls.
#include "BaseSurface.h"
#include "Check.h"
#include "EnergyTriangles.h"
#include "FixedIterations.h"
#include "Meshes.h"
#include "Solved.h"
#include "StyleSolver.h"
#include "SurfaceMeasures.h"
#include "WallStitches.h"

#include <map>

using namespace SphericalStyle;
using Eigen::Vector3d;

namespace
{
constexpr double Thin = 0.02;

/// A plate of half axes 1, 1 and thickness / 2, k squares along every edge.
TriangleMesh Plate(int k, double thickness)
{
  return Meshes::Box(k, { 1.0, 1.0, 0.5 * thickness });
}

using Weights = std::map<std::pair<int, int>, double>;

Weights Find(const TriangleMesh& mesh, double size, int threads = 1)
{
  Weights weights;
  const std::vector<Stitch> stitches = FindWallStitches(mesh.P, mesh.F, size, threads);
  std::pair<int, int> before = { -1, -1 };
  for (const Stitch& s : stitches)
  {
    const std::pair<int, int> ends = { s.u, s.v };
    CHECK(s.u < s.v && before < ends, "stitches should ascend, each once");
    CHECK(s.weight > 0.0 && std::isfinite(s.weight), "weight " << s.weight);
    weights[ends] = s.weight;
    before = ends;
  }
  return weights;
}

/// Whether a point lies on the upper or lower side of a plate, not on its rim.
bool InSide(const TriangleMesh& plate, int i)
{
  return plate.P.row(i).head<2>().cwiseAbs().maxCoeff() < 1.0 - 1e-9;
}

// In a plate every point is joined to the one below it, at c = A (1 / d^2 - 1 / (2 s)^2), from
// both ends together; at a tenth of s and below like at a tenth; at 2 s and above not at all.
void TestPlate()
{
  const int k = 12;
  const double area = 4.0 / (k * k); // of six triangles, a third of each
  for (const double size : { 0.2, 0.03, 0.02, 0.0101, 0.0099 })
  {
    const double d = Thin * std::sqrt(8.0); // as a fraction of the diagonal: Thin, nearly
    const TriangleMesh plate = Plate(k, d);
    const double s = size * Meshes::Diagonal(plate.P);
    const double length = std::max(d, 0.1 * s);
    const Weights weights = Find(plate, size);
    std::vector<int> joined(plate.P.rows(), 0);
    for (const auto& [ends, weight] : weights)
    {
      if (InSide(plate, ends.first) && InSide(plate, ends.second))
      {
        const Vector3d across = plate.P.row(ends.first) - plate.P.row(ends.second);
        CHECK_NEAR(across.head<2>().norm(), 0.0, 1e-12, "a stitch's offset");
        CHECK_NEAR(weight, area * (1.0 / (length * length) - 0.25 / (s * s)), 1e-9 * weight,
          "weight for size " << size);
        ++joined[ends.first];
        ++joined[ends.second];
      }
    }
    for (int i = 0; i < plate.P.rows(); ++i)
    {
      CHECK(!InSide(plate, i) || joined[i] == (d < 2.0 * s),
        "size " << size << ": point " << i << " should be joined or not, is " << joined[i]);
    }
  }
}

// No wall, no stitch: solids, sheets without thickness, what lies near each other outside, and
// points that are too far apart.
void TestNoWalls()
{
  for (const TriangleMesh& mesh : { Meshes::Icosphere(4), Meshes::Ellipsoid(3), Meshes::Box(20),
         Meshes::Patch(12, 0.0), Meshes::Patch(20, 0.3), Meshes::Tetrahedron() })
  {
    CHECK(Find(mesh, 0.05).empty(), "a model of " << mesh.P.rows() << " points has no thin wall");
  }
  // Solids with a gap of a hundredth: rays go inward.
  const TriangleMesh apart =
    Meshes::Together({ Meshes::Box(8), Meshes::Moved(Meshes::Box(8), { 2.01, 0, 0 }) });
  CHECK(Find(apart, 0.05).empty(), "a gap is no wall");
  // Two sheets that face the same way: a ray does not go out through the other.
  const TriangleMesh sheet = Meshes::Patch(12, 0.0), above = Meshes::Moved(sheet, { 0, 0, Thin });
  CHECK(Find(Meshes::Together({ sheet, above }), 0.05).empty(), "sheets on sheets are no wall");
  // Facing apart they are one. Where the lower has two triangles only, its corners are too far for
  // most points of the upper.
  for (const int k : { 12, 1 })
  {
    TriangleMesh lower = Meshes::Patch(k, 0.0);
    lower.F = lower.F.rowwise().reverse().eval();
    const TriangleMesh wall = Meshes::Together({ above, lower });
    std::size_t near = 0;
    for (const auto& p : above.P.rowwise())
    {
      near += (lower.P.rowwise() - p).rowwise().norm().minCoeff() < 0.1 * Meshes::Diagonal(wall.P);
    }
    const std::size_t found = Find(wall, 0.05).size();
    CHECK(found == near && near >= 16, found << " stitches, " << near << " points are near enough");
  }
  // Two plates with a gap: each is a wall of its own.
  const TriangleMesh plate = Plate(8, Thin);
  const TriangleMesh plates =
    Meshes::Together({ plate, Meshes::Moved(plate, { 0, 0, 1.5 * Thin }) });
  for (const auto& stitch : Find(plates, 0.05))
  {
    CHECK((stitch.first.first < plate.P.rows()) == (stitch.first.second < plate.P.rows()),
      "a stitch should not run from plate to plate");
  }
}

// Sides that lean against each other by theta are joined by cos^2 theta, from one end or both.
void TestWedge()
{
  const int k = 16;
  TriangleMesh wedge = Meshes::Box(k, { 1.0, 1.0, 0.5 });
  const double slope = 0.25;
  for (int i = 0; i < wedge.P.rows(); ++i)
  {
    wedge.P(i, 2) = (wedge.P(i, 2) + 0.5) * (0.3 + slope * wedge.P(i, 0));
  }
  const double size = 0.15, s = size * Meshes::Diagonal(wedge.P);
  const double square = 1.0 / (1.0 + slope * slope); // of the cosine
  const double below = 4.0 / (k * k), above = below / std::sqrt(square);
  int both = 0, joined = 0;
  for (const auto& [ends, weight] : Find(wedge, size))
  {
    if (InSide(wedge, ends.first) && InSide(wedge, ends.second))
    {
      const double length = (wedge.P.row(ends.first) - wedge.P.row(ends.second)).norm();
      const double share = weight / (1.0 / (length * length) - 0.25 / (s * s)) / (0.5 * square);
      double nearest = 1.0;
      for (const double area : { below, above, below + above })
      {
        nearest = std::min(nearest, std::abs(share / area - 1.0));
      }
      CHECK(
        nearest < 1e-9, "area " << share << " should be " << below << ", " << above << " or both");
      both += std::abs(share / (below + above) - 1.0) < 1e-9;
      ++joined;
    }
  }
  CHECK(joined >= 200 && both >= joined / 2, joined << " stitches, " << both << " from both ends");
}

TriangleMesh Bowl()
{
  return Meshes::Perturbed(Meshes::Cup(0.1), 0.003, 4); // nothing is equally near
}

bool Equal(const Weights& a, const Weights& b)
{
  return a.size() == b.size() &&
    std::equal(a.begin(), a.end(), b.begin(),
      [](const auto& x, const auto& y)
      { return x.first == y.first && std::abs(x.second - y.second) <= 1e-6 * x.second; });
}

// The same stitches at another place, size, pose and order, inside out, with triangles that
// disagree and for any number of threads.
void TestInvariance()
{
  const TriangleMesh bowl = Bowl();
  const Weights expected = Find(bowl, 0.03);
  CHECK(expected.size() > 900, expected.size() << " stitches in a bowl");
  const auto check = [&](const TriangleMesh& other, const char* what)
  { CHECK(Equal(Find(other, 0.03), expected), "other stitches " << what); };
  Meshes::Random random(5);
  check(Meshes::Moved(bowl, { 3, -2, 5 }), "at another place");
  check(Meshes::Scaled(bowl, { 1e-6, 1e-6, 1e-6 }), "a million times smaller");
  check(Meshes::Scaled(bowl, { 1e6, 1e6, 1e6 }), "a million times larger");
  CHECK(Find(bowl, 0.03, 7) == expected, "threads should not matter");

  // The size is a fraction of the diagonal of the bounds, which turns with the axes.
  const TriangleMesh turned = Meshes::Turned(bowl, random.Rotation());
  const double size = 0.03 * Meshes::Diagonal(bowl.P) / Meshes::Diagonal(turned.P);
  CHECK(Equal(Find(turned, size), expected), "other stitches when turned");

  TriangleMesh other = bowl;
  other.F = bowl.F.rowwise().reverse().eval();
  check(other, "inside out");
  other = bowl;
  for (int f = 0; f < other.F.rows(); f += 3)
  {
    std::swap(other.F(f, 0), other.F(f, 1));
  }
  check(other, "with a third of the triangles turned round");

  const std::vector<int> place = random.Permutation(static_cast<int>(bowl.P.rows()));
  Weights renumbered;
  for (const auto& [ends, weight] : expected)
  {
    renumbered[std::minmax({ place[ends.first], place[ends.second] })] = weight;
  }
  CHECK(Equal(Find(Meshes::Renumbered(bowl, place), 0.03), renumbered),
    "other stitches with points in another order");
}

// [wall] and [detail]: of the thickness d of a wall the base keeps (d / 2 s)^4, all of it at
// d = 2 s, whatever the triangles.
void TestBaseOfAPlate()
{
  for (const double thicknessOverSize : { 0.5, 1.0, 1.5, 1.99, 2.5 })
  {
    for (const int k : { 24, 48 })
    {
      const double s = 0.03;
      const TriangleMesh plate = Plate(k, thicknessOverSize * s);
      EnergyTriangles surface, triangles;
      surface.Topology = MeshTopology(plate.F, static_cast<int>(plate.P.rows()));
      surface.Cotangents = HalfEdgeCotangents(plate.P, plate.F);
      EnergyTriangleOptions options;
      options.wallSize = s / Meshes::Diagonal(plate.P);
      UpdateEnergyTriangles(plate.P, surface, options, triangles);
      const Points base = SmoothBase(
        plate.P, triangles.Topology, triangles.Cotangents, s, PointAreas(plate.P, plate.F));
      const double kept = std::pow(std::min(1.0, 0.5 * thicknessOverSize), 4.0);
      for (int i = 0; i < plate.P.rows(); ++i)
      {
        if (plate.P.row(i).head<2>().norm() < 0.3) // far from the rim
        {
          CHECK_NEAR(base(i, 2) / plate.P(i, 2), kept, 1e-8,
            k << " squares, thickness " << thicknessOverSize << " s: share that stays");
        }
      }
    }
  }
}

StyleOptions Kept(double detailSize, ComponentCoupling coupling = ComponentCoupling::Stitched)
{
  StyleOptions options;
  options.lambda = 5.0;
  options.detailSize = detailSize;
  options.sphericalWeighting = SphericalWeighting::Cotangent;
  options.centerMode = CenterMode::AreaCentroid;
  options.componentCoupling = coupling;
  return options;
}

// Where there are no details or no thin walls, there are no stitches, and results keep their bits.
void TestNothingElse()
{
  const auto independent = ComponentCoupling::Independent;
  const TriangleMesh bowl = Bowl(), solid = Meshes::Perturbed(Meshes::Ellipsoid(3), 0.02, 1);
  CHECK(Meshes::SameBits(Solved(bowl, Kept(0.0)), Solved(bowl, Kept(0.0, independent))),
    "without details walls should come out the same");
  CHECK(Meshes::SameBits(Solved(solid, Kept(0.03)), Solved(solid, Kept(0.03, independent))),
    "a solid should come out the same");
  CHECK(Meshes::Distance(Solved(bowl, Kept(0.03)), Solved(bowl, Kept(0.03, independent))) > 0.01,
    "walls should matter");
}

// What is kept between solves: other sizes, couplings and points give the bits of a fresh solver.
void TestKept()
{
  const TriangleMesh bowl = Bowl();
  const StyleOptions some[] = { Kept(0.03), Kept(0.0), Kept(0.03), Kept(0.05),
    Kept(0.05, ComponentCoupling::Independent), Kept(0.05), Kept(0.03) };
  StyleSolver solver;
  solver.SetMesh(bowl);
  for (const StyleOptions& options : some)
  {
    const StyleReport report = solver.Solve(Fixed(options, 3));
    CHECK(Meshes::SameBits(solver.GetPositions(), Solved(bowl, Fixed(options, 3))),
      "a change should give the bits of a fresh solver");
    const bool walls =
      options.detailSize > 0.0 && options.componentCoupling == ComponentCoupling::Stitched;
    CHECK(report.wallStitches ==
          (walls ? static_cast<int>(Find(bowl, options.detailSize).size()) : 0) &&
        report.stitches == 0,
      report.wallStitches << " stitches through walls, " << report.stitches << " between parts");
  }
  StyleOptions other = Fixed(Kept(0.03), 3);
  other.normalBlend = 0.5;
  CHECK(!solver.Solve(other).factored, "other targets need no other stitches");
  const TriangleMesh moved = Meshes::Perturbed(bowl, 0.002, 8);
  solver.SetMesh(moved);
  solver.Solve(other);
  CHECK(Meshes::SameBits(solver.GetPositions(), Solved(moved, other)),
    "other points should give the bits of a fresh solver");
}

// The energy never rises, in all modes, with walls of next to no thickness and with points that
// coincide.
void TestSound()
{
  std::vector<Meshes::Named> meshes = { { "bowl", Bowl() }, { "leaf", Plate(10, 1e-5) },
    { "two leaves", Meshes::Together({ Plate(6, 1e-4), Plate(6, 1e-4) }) } };
  for (const Meshes::Named& named : meshes)
  {
    for (const EdgeWeighting edges : { EdgeWeighting::HalfEdge, EdgeWeighting::IntrinsicDelaunay })
    {
      for (const SphericalWeighting weighting :
        { SphericalWeighting::Cotangent, SphericalWeighting::Uniform })
      {
        StyleOptions options = Kept(0.03);
        options.edgeWeighting = edges;
        options.sphericalWeighting = weighting;
        options.normalBlend = 0.2;
        StyleSolver solver;
        solver.SetMesh(named.mesh);
        const StyleReport report = solver.Solve(options);
        CHECK(solver.GetPositions().allFinite() && report.wallStitches > 0,
          named.name << ": " << report.wallStitches << " stitches");
        CHECK(
          CountRises(report.loop).iterations == 0, named.name << ": the energy should never rise");
        CHECK_NEAR(solver.GetCellEnergies().sum(), report.loop.history.back().energy.Total(),
          1e-9 * report.loop.restEnergy, named.name << ": sum of the cells' energies");
      }
    }
  }
}
}

int main()
{
  TestPlate();
  TestNoWalls();
  TestWedge();
  TestInvariance();
  TestBaseOfAPlate();
  TestNothingElse();
  TestKept();
  TestSound();
  return CheckResult();
}
