// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// A surface made printable: sections and feet whose area is known, angles measured again by
/// rolling the solid over, closed manifolds, volumes, and what cannot be done.
#include "Check.h"
#include "ClosedSurface.h"
#include "Meshes.h"
#include "Printable.h"
#include "SelfIntersections.h"
#include "Standing.h"
#include "SurfaceMeasures.h"
#include "WallThickness.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace SphericalStyle;

namespace
{
constexpr double Degrees = 180.0 / Meshes::Pi;

bool IsClosed(const TriangleMesh& mesh)
{
  return IsClosedManifold(mesh.F, static_cast<int>(mesh.P.rows()));
}

/// The angle at which the solid falls over, by turning gravity around in 7200 directions: it falls
/// where the center of mass is no longer over the foot.
double TiltByRolling(const TriangleMesh& mesh, int axis)
{
  const double ground = mesh.P.col(axis).minCoeff();
  const Eigen::Vector3d center = CenterOfMass(mesh);
  const int x = (axis + 1) % 3;
  const int y = (axis + 2) % 3;
  double least = 180.0;
  for (int k = 0; k < 7200; ++k)
  {
    const double turn = 2.0 * Meshes::Pi * k / 7200;
    double reach = -std::numeric_limits<double>::infinity(); // of the foot in this direction
    for (const auto& p : mesh.P.rowwise())
    {
      if (p(axis) == ground)
      {
        reach = std::max(
          reach, std::cos(turn) * (p(x) - center(x)) + std::sin(turn) * (p(y) - center(y)));
      }
    }
    least = std::min(least, Degrees * std::atan2(reach, center(axis) - ground));
  }
  return least;
}

void TestSections()
{
  const TriangleMesh box = Meshes::Box(3, { 1.0, 2.0, 3.0 });
  for (int axis = 0; axis < 3; ++axis)
  {
    const double area = 24.0 / (axis + 1); // of 2 x 4 x 6
    CHECK_NEAR(SectionArea(box, axis, 0.3), area, 1e-12, "section of a box");
    CHECK_NEAR(GroundArea(box, axis, 1e-9), area, 1e-12, "face of a box");
  }
  const TriangleMesh hollow = Meshes::HollowBall(0.5, 4); // radii 1 and .5, about
  const double section = SectionArea(hollow, 1, 0.01);
  CHECK_NEAR(section / Meshes::Pi, 0.75, 0.01, "section of a hollow ball");
  const DerivedSurface cut = CutFlat(hollow, 1, 0.01);
  CHECK(IsClosed(cut.mesh), "half a hollow ball is closed");
  CHECK_NEAR(GroundArea(cut.mesh, 1, 0.0) / section, 1.0, 0.02, "its foot is a ring");
  CHECK(SelfIntersections(cut.mesh).empty(), "and does not run through itself");

  // Two balls that run through each other are closed one by one.
  const TriangleMesh ball = Meshes::Icosphere(3);
  const TriangleMesh two = Meshes::Together({ ball, Meshes::Moved(ball, { 0.7, 0.0, 0.1 }) });
  const DerivedSurface halves = CutFlat(two, 1, -0.3);
  CHECK(halves.mesh.F.rows() > 0 && IsClosed(halves.mesh), "two balls are closed");
}

void TestFans()
{
  TriangleMesh hourglass = Meshes::Tetrahedron(); // and another one at point 0
  const TriangleMesh other = hourglass;
  hourglass.P.conservativeResize(7, 3);
  hourglass.P.bottomRows(3) = (-other.P.bottomRows(3)).rowwise() + 2.0 * other.P.row(0);
  hourglass.F.conservativeResize(8, 3);
  for (int f = 0; f < 4; ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int i = other.F(f, 2 - k);
      hourglass.F(4 + f, k) = i == 0 ? 0 : i + 3;
    }
  }
  CHECK(!IsClosed(hourglass), "an hourglass is no manifold");
  DerivedSurface split = Underived(hourglass);
  MakeManifold(split);
  CHECK(split.mesh.P.rows() == 8 && IsClosed(split.mesh), "its halves are two");
  CHECK(split.ends[7][0] == 0 && split.mesh.P.row(7) == split.mesh.P.row(0), "at one place");
}

/// The surface of unit cubes, with points at one place as one.
TriangleMesh Cubes(const std::vector<std::array<int, 3>>& cubes)
{
  std::map<std::array<int, 3>, int> numbers;
  std::vector<Meshes::Vector> points;
  std::vector<std::array<int, 3>> triangles;
  const auto isThere = [&](const std::array<int, 3>& cube)
  { return std::find(cubes.begin(), cubes.end(), cube) != cubes.end(); };
  for (const auto& cube : cubes)
  {
    for (int side = 0; side < 6; ++side)
    {
      const int axis = side / 2;
      std::array<int, 3> across = cube;
      across[axis] += side % 2 == 1 ? 1 : -1;
      if (isThere(across))
      {
        continue;
      }
      std::array<int, 4> corners{};
      for (int k = 0; k < 4; ++k)
      {
        std::array<int, 3> place = cube;
        place[axis] += side % 2;
        place[(axis + 1) % 3] += k == 1 || k == 2 ? 1 : 0;
        place[(axis + 2) % 3] += k >= 2 ? 1 : 0;
        const auto [found, isNew] = numbers.emplace(place, static_cast<int>(points.size()));
        if (isNew)
        {
          points.emplace_back(place[0], place[1], place[2]);
        }
        corners[k] = found->second;
      }
      if (side % 2 == 0)
      {
        std::swap(corners[1], corners[3]);
      }
      triangles.push_back({ corners[0], corners[1], corners[2] });
      triangles.push_back({ corners[0], corners[2], corners[3] });
    }
  }
  return Meshes::Make(points, triangles);
}

/// Solids that touch along edges are taken apart; what is left over is a border.
void TestEdgesOfMany()
{
  const auto apart = [](const TriangleMesh& mesh)
  {
    DerivedSurface surface = Underived(mesh);
    MakeManifold(surface);
    CHECK(surface.mesh.P.topRows(mesh.P.rows()) == mesh.P, "points keep their numbers");
    for (Eigen::Index i = 0; i < surface.mesh.P.rows(); ++i)
    {
      const Eigen::RowVector3d place = (1.0 - surface.shares[i]) * mesh.P.row(surface.ends[i][0]) +
        surface.shares[i] * mesh.P.row(surface.ends[i][1]);
      CHECK(surface.mesh.P.row(i) == place, "and new ones lie between their ends");
    }
    CHECK(surface.triangles.size() == static_cast<std::size_t>(surface.mesh.F.rows()),
      "triangles come from somewhere");
    CHECK_NEAR(EnclosedVolume(surface.mesh.P, surface.mesh.F), EnclosedVolume(mesh.P, mesh.F),
      1e-12, "the volume stays");
    return surface;
  };

  const TriangleMesh two = Cubes({ { 0, 0, 0 }, { 1, 1, 0 } });
  CHECK(two.P.rows() == 14 && FindOpenEdges(two.F).nonManifold == 1, "two cubes at an edge");
  const DerivedSurface cubes = apart(two);
  CHECK(IsClosed(cubes.mesh) && cubes.mesh.P.rows() == 16 && cubes.mesh.F.rows() == 24,
    "become two cubes");

  // The same cubes between two slabs: the edge cannot open at its ends, so it gets two middles.
  std::vector<std::array<int, 3>> tower = { { 0, 0, 1 }, { 1, 1, 1 } };
  for (int k = 0; k < 8; ++k)
  {
    tower.push_back({ k % 2, k / 2 % 2, k / 4 * 2 });
  }
  const TriangleMesh stacked = Cubes(tower);
  CHECK(FindOpenEdges(stacked.F).nonManifold == 1, "cubes between slabs");
  const DerivedSurface opened = apart(stacked);
  CHECK(IsClosed(opened.mesh) && opened.mesh.P.rows() == stacked.P.rows() + 2 &&
      opened.mesh.F.rows() == stacked.F.rows() + 4,
    "the edge is split in two middles");
  PrintableOptions options;
  options.thickness = 0.1;
  const PrintableResult made = MakePrintable(opened.mesh, options);
  CHECK(IsClosed(made.surface.mesh) && made.after.selfIntersecting == 0,
    "parts that touch where they were taken apart do not run through each other");

  // Checkered cubes: every inner edge has four triangles, and points have up to eight fans.
  std::vector<std::array<int, 3>> checkered;
  for (int k = 0; k < 64; ++k)
  {
    if ((k + k / 4 + k / 16) % 2 == 0)
    {
      checkered.push_back({ k % 4, k / 4 % 4, k / 16 });
    }
  }
  const DerivedSurface many = apart(Cubes(checkered));
  CHECK(IsClosed(many.mesh) && many.mesh.P.rows() == 32 * 8, "32 cubes have 8 points each");

  // A wall inside ends at an edge of the outside: it has a border, the outside has none.
  TriangleMesh walled = Cubes({ { 0, 0, 0 }, { 1, 0, 0 } });
  const auto pointAt = [&](const Eigen::RowVector3d& place)
  {
    Eigen::Index point = 0;
    (walled.P.rowwise() - place).rowwise().squaredNorm().minCoeff(&point);
    return static_cast<int>(point);
  };
  walled.F.conservativeResize(walled.F.rows() + 1, 3);
  walled.F.row(walled.F.rows() - 1) << pointAt({ 1, 0, 0 }), pointAt({ 1, 1, 0 }),
    pointAt({ 1, 1, 1 });
  CHECK(FindOpenEdges(walled.F).nonManifold == 2, "a wall inside");
  DerivedSurface inside = Underived(walled);
  MakeManifold(inside);
  const OpenEdges open = FindOpenEdges(inside.mesh.F);
  CHECK(open.nonManifold == 0 && open.misoriented == 0 && open.borders == 3,
    "comes off as a triangle: " << open.borders << " border edges");
}

/// Faces that a file has twice count once; a wall between two solids stays.
void TestRepetitions()
{
  const TriangleMesh ball = Meshes::Icosphere(2);
  const auto m = static_cast<int>(ball.F.rows());
  std::vector<int> all(m);
  std::iota(all.begin(), all.end(), 0);
  // Begins with another corner, facing the same way.
  const Triangles turned = ball.F(AllColumns, std::vector<int>{ 1, 2, 0 });
  const Triangles back = ball.F(AllColumns, std::vector<int>{ 2, 1, 0 });
  CHECK(WithoutRepetitions(ball.F) == all, "a ball has no repetitions");
  CHECK(WithoutRepetitions((Triangles(2 * m, 3) << ball.F, turned).finished()) == all,
    "all faces twice");
  CHECK(WithoutRepetitions((Triangles(2 * m, 3) << ball.F, back).finished()) == all,
    "all faces with a back");
  CHECK(WithoutRepetitions((Triangles(m + 9, 3) << ball.F, turned.topRows(9)).finished()) == all,
    "some faces twice");

  const TriangleMesh cube = Cubes({ { 0, 0, 0 } });
  const TriangleMesh wide = Cubes({ { 0, 0, 0 }, { 1, 0, 0 } });
  // Two cubes of their own that share the points of the wall between them.
  const Triangles walls = (Triangles(24, 3) << cube.F, cube.F).finished();
  TriangleMesh two = wide;
  two.F = walls;
  const auto numberAt = [&](const Eigen::RowVector3d& place)
  {
    Eigen::Index point = 0;
    (wide.P.rowwise() - place).rowwise().squaredNorm().minCoeff(&point);
    return static_cast<int>(point);
  };
  for (int f = 0; f < 24; ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::RowVector3d shift(f < 12 ? 0.0 : 1.0, 0.0, 0.0);
      two.F(f, k) = numberAt(cube.P.row(walls(f, k)) + shift);
    }
  }
  CHECK(FindOpenEdges(two.F).nonManifold > 0 && WithoutRepetitions(two.F).size() == 24,
    "the wall between two cubes has two sides");
}

/// What holds of every result.
void CheckMade(const PrintableResult& made, const PrintableOptions& options, double volume)
{
  const TriangleMesh& mesh = made.surface.mesh;
  const int axis = options.axis;
  CHECK(IsClosed(mesh), "closed");
  CHECK(mesh.P.rows() == static_cast<Eigen::Index>(made.surface.ends.size()) &&
      mesh.F.rows() == static_cast<Eigen::Index>(made.surface.triangles.size()),
    "every point and triangle comes from somewhere");
  const double ground = mesh.P.col(axis).minCoeff();
  for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
  {
    if (made.surface.triangles[f] < 0)
    {
      for (int k = 0; k < 3; ++k)
      {
        CHECK(mesh.P(mesh.F(f, k), axis) == ground, "the foot is flat to the bit");
      }
    }
  }
  CHECK_NEAR(EnclosedVolume(mesh.P, mesh.F) / volume, 1.0, 1e-12, "volume");
  CHECK(TiltByRolling(mesh, axis) >= options.stabilityAngle - 1e-6,
    "it stands: " << TiltByRolling(mesh, axis));
  CHECK_NEAR(made.after.tiltAngle, TiltByRolling(mesh, axis), 0.02, "tilt angle");
  CHECK(made.after.selfIntersecting <= made.before.selfIntersecting, "nothing runs through it");
}

void TestBall()
{
  const TriangleMesh ball = Meshes::Icosphere(5);
  const double volume = EnclosedVolume(ball.P, ball.F);
  for (int axis = 0; axis < 3; ++axis)
  {
    PrintableOptions options;
    options.axis = axis;
    options.footArea = 0.1;
    const PrintableResult made = MakePrintable(ball, options);
    CheckMade(made, options, volume);
    // A disk of the area .1 * 4 lies at the height sqrt(1 - .4 / pi).
    CHECK_NEAR(made.cutDepth, 1.0 - std::sqrt(1.0 - 0.4 / Meshes::Pi), 2e-3, "depth of the cut");
    CHECK_NEAR(made.after.footArea, 0.4 * made.factor * made.factor, 4e-3, "area of the foot");
    CHECK(made.lean == 0.0, "a ball does not lean");
  }
  PrintableOptions options;
  options.volume = 7.0;
  CheckMade(MakePrintable(ball, options), options, 7.0);
  options.volume = 0.0;
  options.height = 80.0;
  const PrintableResult high = MakePrintable(ball, options);
  CHECK_NEAR(high.after.height, 80.0, 1e-12 * 80.0, "height");
  options = {};
  options.stabilityAngle = 25.0; // needs a larger foot: tan 25 is .47
  const PrintableResult large = MakePrintable(ball, options);
  CheckMade(large, options, volume);
  CHECK(large.after.footArea > 0.2 * 4.0 * 0.05, "the foot grows");
}

void CheckRemark(const PrintableResult& made, const std::string& text)
{
  CHECK(made.remarks.size() == 1 && made.remarks[0].find(text) != std::string::npos,
    "one remark, with '" << text << "': " << made.remarks.size());
}

void TestLean()
{
  // A column that leans by 40 degrees over a foot of 1 x 1, five high.
  TriangleMesh column = Meshes::Box(8, { 0.5, 2.5, 0.5 });
  column.P.col(0) += 0.2 * (column.P.col(1).array() + 2.5).matrix();
  PrintableOptions options;
  options.footArea = 0.01;
  options.stabilityAngle = 5.0;
  const PrintableResult made = MakePrintable(column, options);
  CHECK_NEAR(made.before.tiltAngle, 0.0, 1e-6, "the center is over the edge");
  CHECK(made.cutDepth == 0.0, "it has a foot");
  CheckMade(made, options, EnclosedVolume(column.P, column.F));
  CHECK_NEAR(made.after.tiltAngle, 5.0, 1e-9, "as much as is wanted, and no more");
  // The center 2.5 above the foot moves by 2.5 tan 5.
  CHECK_NEAR(made.lean, 5.0, 1e-9, "lean");
  for (Eigen::Index i = 0; i < column.P.rows(); ++i)
  {
    if (column.P(i, 1) == -2.5)
    {
      CHECK(made.surface.mesh.P.row(i) == column.P.row(i), "the foot stays to the bit");
    }
  }
  options.stabilityAngle = 0.0;
  CHECK(Meshes::SameBits(MakePrintable(column, options).surface.mesh.P, column.P),
    "nothing is asked for, nothing changes");
  // The center can move by 2.5 tan 10 at most.
  options.stabilityAngle = 30.0;
  const PrintableResult most = MakePrintable(column, options);
  CHECK_NEAR(most.lean, 10.0, 1e-9, "it leans as far as it may");
  CHECK_NEAR(most.after.tiltAngle, 10.0, 1e-9, "as much as can be reached");
  CheckRemark(most, "StabilityAngle: the model can be tilted by");
  CheckRemark(most, "not 30");
  // The center 2.5 outside of the foot: a lean that does not make it stand is none.
  column.P.col(0) += (column.P.col(1).array() + 2.5).matrix();
  const PrintableResult falls = MakePrintable(column, options);
  CHECK(falls.lean == 0.0 && Meshes::SameBits(falls.surface.mesh.P, column.P), "it stays");
  CheckRemark(falls, "falls over even with the largest");
}

/// Walls of known thickness, measured and made thicker.
void TestWalls()
{
  const TriangleMesh plate = Meshes::Box(20, { 1.0, 0.01, 1.0 });
  const Eigen::VectorXd thickness = FindWalls(plate, 2).thickness;
  for (Eigen::Index i = 0; i < plate.P.rows(); ++i)
  {
    if (std::max(std::abs(plate.P(i, 0)), std::abs(plate.P(i, 2))) < 0.95)
    {
      CHECK_NEAR(thickness(i), 0.02, 1e-12, "a plate");
    }
  }
  CHECK(Meshes::SameBits(ThickenWalls(plate, 0.015, 2), plate.P), "thick enough: nothing moves");
  const TriangleMesh thick{ ThickenWalls(plate, 0.1, 2), plate.F };
  CHECK(FindWalls(thick, 2).thickness.minCoeff() >= 0.1, "as thick as is wanted");
  CHECK(thick.P.col(1).cwiseAbs().maxCoeff() < 0.0525, "and no thicker than that takes");
  CHECK(SelfIntersections(thick).empty(), "a thick plate does not run through itself");
  CHECK(Meshes::SameBits(ThickenWalls(plate, 0.1, 1), thick.P), "with any number of threads");

  const TriangleMesh ball = Meshes::Icosphere(4);
  CHECK_NEAR(
    FindWalls(ball, 2).thickness.minCoeff(), 2.0, 0.01, "a ball is as thick as its diameter");
  CHECK(!std::isfinite(FindWalls(ball, 2, 1.5).thickness.minCoeff()), "nothing within reach");
  const TriangleMesh hollow = Meshes::HollowBall(0.05, 4);
  const TriangleMesh shell{ ThickenWalls(hollow, 0.2, 2), hollow.F };
  CHECK(FindWalls(shell, 2).thickness.minCoeff() >= 0.2, "the wall of a hollow ball");
  CHECK_NEAR(shell.P.rowwise().norm().minCoeff(), 0.874, 0.01, "moves inward inside");

  // A sharp edge is no wall, and a wedge of 20 degrees is one.
  TriangleMesh wedge = Meshes::Box(8, { 1.0, 1.0, 1.0 });
  wedge.P.col(1).array() *= 1.01 + wedge.P.col(0).array();
  const auto atItsEdge = [&wedge]
  {
    const auto nearEdge = wedge.P.col(0).array() < 0.0;
    return nearEdge.select(FindWalls(wedge, 2).thickness.array(), 10.0).minCoeff();
  };
  CHECK(atItsEdge() > 0.5, "a wedge of 90 degrees: " << atItsEdge());
  wedge.P.col(1) *= std::tan(10.0 / Degrees);
  CHECK(atItsEdge() < 0.1, "a wedge of 20 degrees");

  // A rod through a ball is no thinner there.
  TriangleMesh rod = Meshes::Box(20, { 2.0, 0.05, 0.05 });
  const TriangleMesh both = Meshes::Together({ ball, rod });
  const Eigen::VectorXd ofBoth = FindWalls(both, 2).thickness;
  for (Eigen::Index i = ball.P.rows(); i < both.P.rows(); ++i)
  {
    const double x = std::abs(both.P(i, 0));
    CHECK(x < 0.95 ? !std::isfinite(ofBoth(i)) : x < 1.05 || x > 1.9 || ofBoth(i) < 0.15,
      "a rod through a ball at " << x << ": " << ofBoth(i));
  }

  // Plates that lie in each other are one wall, and one in front of them changes nothing.
  const TriangleMesh pair = Meshes::Together(
    { plate, Meshes::Moved(plate, { 0.3, 0.015, 0.3 }), Meshes::Moved(plate, { 0.0, 1.0, 0.0 }) });
  const Eigen::VectorXd ofPair = FindWalls(pair, 2).thickness;
  for (Eigen::Index i = 0; i < plate.P.rows(); ++i)
  {
    const Eigen::RowVector3d p = plate.P.row(i);
    if (std::min(p(0), p(2)) > -0.65 && std::max(p(0), p(2)) < 0.95)
    {
      CHECK(p(1) > 0.0 ? !std::isfinite(ofPair(i)) : std::abs(ofPair(i) - 0.035) < 1e-12,
        "a plate in a plate: " << ofPair(i));
    }
  }

  // Sides that stand 19 degrees off: where the ray meets one, another one goes to the bottom.
  TriangleMesh funnel = Meshes::Box(20, { 1.0, 1.0, 1.0 });
  funnel.P.col(0).array() *= 0.65 + 0.35 * funnel.P.col(1).array();
  const Walls ofFunnel = FindWalls(funnel, 2);
  for (Eigen::Index i = 0; i < funnel.P.rows(); ++i)
  {
    const bool isInside = std::abs(funnel.P(i, 2)) < 0.95;
    if (isInside && funnel.P(i, 1) == 1.0 && std::abs(std::abs(funnel.P(i, 0)) - 0.9) < 1e-9)
    {
      CHECK_NEAR(ofFunnel.thickness(i), 2.0 / std::cos(30.0 / Degrees), 1e-9, "a tilted ray");
      CHECK(ofFunnel.opposite[i] == -1, "none along the normal");
    }
  }

  // A part that a ray enters and leaves again covers nothing.
  const TriangleMesh two = Meshes::Together({ plate, Meshes::Moved(plate, { 0.0, 0.04, 0.0 }) });
  const Eigen::VectorXd ofTwo = FindWalls(two, 2).thickness;
  for (Eigen::Index i = 0; i < two.P.rows(); ++i)
  {
    if (std::max(std::abs(two.P(i, 0)), std::abs(two.P(i, 2))) < 0.95)
    {
      CHECK_NEAR(ofTwo(i), 0.02, 1e-12, "a plate with another one in front of it");
    }
  }

  // No room: they are nearer to each other than they have to grow.
  const TriangleMesh tight{ ThickenWalls(two, 0.1, 2), two.F };
  CHECK(SelfIntersections(tight).empty(), "plates do not run through each other");
  CHECK(FindWalls(tight, 2).thickness.minCoeff() < 0.1, "so they stay thinner");
  CHECK((tight.P - two.P).rowwise().norm().maxCoeff() < 0.0505 + 1e-12,
    "and do not grow on their other sides instead");
}

/// The rim of a cut: a wedge that lies on the ground grows up, since its rim would stay as sharp as
/// it is if it grew aside.
void TestRim()
{
  TriangleMesh wedge = Meshes::Box(20, { 1.0, 0.5, 1.0 });
  for (auto p : wedge.P.rowwise())
  {
    p(1) = (p(1) + 0.5) * (0.02 + 0.3 * (p(0) + 1.0));
  }
  const TriangleMesh thick{ ThickenWalls(wedge, 0.2, 2, { 1, 0.0 }), wedge.F };
  CHECK((FindWalls(wedge, 2).thickness.array() < 0.2).count() > 200, "a thin rim");
  const Eigen::VectorXd after = FindWalls(thick, 2).thickness;
  CHECK((after.array() < 0.2).count() < 10, "it is thick but for its corners");
  CHECK(SelfIntersections(thick).empty(), "and does not run through itself");
  for (Eigen::Index i = 0; i < wedge.P.rows(); ++i)
  {
    const Eigen::RowVector3d motion = thick.P.row(i) - wedge.P.row(i);
    CHECK(after(i) >= 0.2 || std::abs(wedge.P(i, 2)) > 0.85, "thick: " << wedge.P.row(i));
    CHECK(wedge.P(i, 1) > 0.0 || motion(1) == 0.0, "the base stays on the ground");
    if (std::abs(wedge.P(i, 2)) < 0.75 && wedge.P(i, 0) < -0.45)
    {
      CHECK(after(i) >= 0.2, "the rim is thick");
      CHECK(wedge.P(i, 1) == 0.0 || (motion(0) == 0.0 && motion(2) == 0.0), "it moves straight up");
    }
  }
}

/// A wall is measured where the ray along its normal meets the tips of two parts above it.
void TestTipsAbove()
{
  const TriangleMesh plate = Meshes::Box(20, { 1.0, 0.01, 1.0 });
  TriangleMesh spike;
  spike.P.resize(4, 3);
  spike.P << -0.015, 3.0, -0.015, 0.015, 3.0, -0.015, 0.0, 3.0, 0.015, 0.0, 3.05, 0.0;
  spike.F.resize(4, 3);
  spike.F << 0, 1, 2, 1, 0, 3, 2, 1, 3, 0, 2, 3;
  TriangleMesh turned = spike;
  turned.P.col(0) *= -1.0;
  turned.P.col(2) *= -1.0;
  turned.P(3, 1) = 3.04;
  const Eigen::VectorXd alone = FindWalls(plate, 2).thickness;
  const Eigen::VectorXd below = FindWalls(Meshes::Together({ plate, spike, turned }), 2).thickness;
  for (Eigen::Index i = 0; i < plate.P.rows(); ++i)
  {
    CHECK(std::isfinite(below(i)) == std::isfinite(alone(i)), "measured below the tips");
  }
}

/// Parts that run through each other, and have no room, stay; other walls become thick.
void TestNoRoomAtOnePlace()
{
  const TriangleMesh plate = Meshes::Box(20, { 1.0, 0.01, 1.0 });
  const TriangleMesh level = Meshes::Moved(Meshes::Box(1, { 1.0, 0.01, 1.0 }), { 0.0, 3.0, 0.0 });
  const TriangleMesh upright = Meshes::Moved(Meshes::Box(1, { 0.01, 1.0, 1.0 }), { 0.0, 3.0, 0.0 });
  const TriangleMesh block = Meshes::Moved(Meshes::Box(1, { 0.1, 0.1, 0.1 }), { 0.5, 3.115, 0.0 });
  const TriangleMesh all = Meshes::Together({ plate, level, upright, block });
  CHECK(!SelfIntersections(all).empty(), "a plate through another");
  const TriangleMesh thick{ ThickenWalls(all, 0.1, 2), all.F };
  CHECK(FindWalls(thick, 2).thickness.head(plate.P.rows()).minCoeff() >= 0.1,
    "a plate far from them becomes thick");
  const std::vector<char> now = IntersectingTriangles(thick);
  CHECK(
    std::count(now.end() - block.F.rows(), now.end(), 1) == 0, "nothing runs through the block");
}

/// The thickness is that of the result, whatever cut and size do to it.
void TestThickResult()
{
  const TriangleMesh plate = Meshes::Box(20, { 1.0, 1.0, 0.02 });
  PrintableOptions options;
  options.thickness = 5.0;
  options.stabilityAngle = 1.0;
  options.height = 80.0;
  options.threads = 2;
  const PrintableResult made = MakePrintable(plate, options);
  CheckMade(made, options, made.after.volume);
  CHECK_NEAR(made.before.thickness, 0.04, 1e-12, "thickness before");
  CHECK(made.after.thickness >= 5.0 && made.after.thickness < 5.2,
    "thickness after: " << made.after.thickness);
  CHECK_NEAR(made.after.height, 80.0, 1e-10, "height of the plate");
  CHECK(made.thickened > 0.04 && made.thickened < 0.1, "how far points moved");
  options.height = 0.0;
  options.thickness = 0.06; // by keeping the volume the plate becomes smaller
  const PrintableResult kept = MakePrintable(plate, options);
  CheckMade(kept, options, made.before.volume);
  CHECK(kept.factor < 0.9 && kept.after.thickness >= 0.06,
    "thick enough after it was scaled: " << kept.after.thickness);
}

/// A ball as thick as its volume lets it be cannot be made thicker: it stays what it is.
void TestThickBall()
{
  const TriangleMesh ball = Meshes::Icosphere(3);
  PrintableOptions options;
  options.footArea = options.stabilityAngle = 0.0;
  const PrintableResult plain = MakePrintable(ball, options);
  for (const double thickness : { 2.1, 3.0, 6.0 })
  {
    options.thickness = thickness;
    const PrintableResult made = MakePrintable(ball, options);
    CHECK(made.isSizeShort && made.thickened == 0.0, "thickness " << thickness);
    CHECK_NEAR((made.surface.mesh.P - plain.surface.mesh.P).norm(), 0.0, 1e-12, "the ball");
    CHECK_NEAR(made.after.thickness, made.before.thickness, 1e-12, "its thickness");
  }
  options.height = 4.0; // with more room it can
  options.thickness = 3.0;
  const PrintableResult larger = MakePrintable(ball, options);
  CHECK(!larger.isSizeShort && larger.after.thickness >= 3.0, "a larger ball");
}

/// What lies flat still does when it becomes thicker.
void TestFlatBase()
{
  const TriangleMesh plate = Meshes::Box(20, { 1.0, 1.0, 0.05 });
  PrintableOptions options;
  options.axis = 2;
  options.thickness = 0.2;
  options.footArea = options.stabilityAngle = 0.0;
  options.height = 0.2;
  const PrintableResult made = MakePrintable(plate, options);
  CHECK_NEAR(made.before.footArea, 4.0, 1e-12, "foot of the plate before");
  CHECK(made.after.footArea > 4.0 && made.after.thickness >= 0.2,
    "foot of the plate: " << made.after.footArea << ", thickness " << made.after.thickness);
}

/// A solid that lies in another one is closed where it is cut, as one that runs through it is.
void TestNested()
{
  const TriangleMesh ball = Meshes::Icosphere(4);
  for (const double inner : { 0.5, 0.98, 0.99, 0.995 })
  {
    const TriangleMesh both =
      Meshes::Together({ ball, Meshes::Scaled(ball, inner * Eigen::Vector3d::Ones()) });
    PrintableOptions options;
    const PrintableResult made = MakePrintable(both, options);
    CHECK(IsClosed(made.surface.mesh), "balls in each other are closed");
    CHECK_NEAR(EnclosedVolume(made.surface.mesh.P, made.surface.mesh.F),
      EnclosedVolume(both.P, both.F), 1e-9, "their volume");
  }
}

/// Near a tip, where short edges are not cut, the foot is somewhat larger than wanted: it must not
/// be a point.
void TestTip()
{
  const TriangleMesh tips = Meshes::Make(
    { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { -1, 0, 0 }, { 0, -1, 0 }, { 0, 0, -1 } },
    { { 0, 1, 2 }, { 1, 3, 2 }, { 3, 4, 2 }, { 4, 0, 2 }, { 1, 0, 5 }, { 3, 1, 5 }, { 4, 3, 5 },
      { 0, 4, 5 } });
  for (const double angle : { 0.0, 0.1 })
  {
    for (const double area : { 1e-4, 1e-3, 2e-3, 1e-2 })
    {
      PrintableOptions options;
      options.footArea = area;
      options.stabilityAngle = angle;
      const PrintableResult made = MakePrintable(tips, options);
      const double foot = GroundArea(made.surface.mesh, options.axis, 1e-9) / 4.0;
      CHECK(foot >= (1.0 - 1e-9) * area && foot <= 1.2 * std::max(area, 0.05 * 0.05 / 2.0),
        "the foot of a double pyramid is " << foot << ", wanted was " << area);
    }
  }
}

/// What is out of reach comes as near as it can, with a remark.
void TestOutOfReach()
{
  const TriangleMesh ball = Meshes::Icosphere(4);
  PrintableOptions options;
  options.footArea = 0.9;
  const PrintableResult made = MakePrintable(ball, options);
  CHECK_NEAR(made.cutDepth, 0.4, 1e-6, "the deepest cut, where the section is largest");
  // Of a ball of radius 1 the section at .4 has pi (2 .4 - .4^2).
  CHECK_NEAR(made.after.footArea / (made.factor * made.factor), 0.64 * Pi, 0.01, "its area");
  CheckRemark(made, "makes a foot of 0.50");
  CheckRemark(made, "not 0.9");
  // A wedge on its base: every cut makes the foot smaller.
  TriangleMesh wedge = Meshes::Box(4, { 1.0, 1.0, 1.0 });
  for (auto p : wedge.P.rowwise())
  {
    p(0) = p(0) * (0.75 - 0.25 * p(1)) + 0.4 * (p(1) + 1.0); // the bounds are wider than its base
  }
  options.footArea = 1.0;
  const PrintableResult uncut = MakePrintable(wedge, options);
  CHECK(uncut.cutDepth == 0.0 && Meshes::SameBits(uncut.surface.mesh.P, wedge.P),
    "the largest foot is the one that it has");
  CheckRemark(uncut, "FootArea");
  options.footArea = 0.0;
  const PrintableResult onPoint = MakePrintable(ball, options);
  CHECK(onPoint.lean == 0.0 && Meshes::SameBits(onPoint.surface.mesh.P, ball.P), "it stays");
  CheckRemark(onPoint, "on a point or a line");
  options.stabilityAngle = 0.0;
  CHECK(MakePrintable(ball, options).remarks.empty(), "nothing is asked for");
  for (const double thickness : { 0.0, 1e-7 }) // of a sheet in space, rounding
  {
    CHECK_THROWS(std::invalid_argument,
      MakePrintable(Meshes::Box(2, { 1.0, thickness, 1.0 }), options), "volume");
  }
  CHECK(MakePrintable(Meshes::Box(2, { 1.0, 1e-4, 1.0 }), options).surface.mesh.F.rows() > 0,
    "foil is no sheet");
}

/// A tube around z, open at both ends. @param radiusOf, heightOf  of corner i
TriangleMesh Tube(
  int n, const std::function<double(int)>& radiusOf, const std::function<double(int)>& heightOf)
{
  TriangleMesh tube;
  tube.P.resize(2 * n, 3);
  tube.F.resize(2 * n, 3);
  for (int i = 0; i < n; ++i)
  {
    const double phi = 2.0 * Meshes::Pi * i / n;
    const double x = radiusOf(i) * std::cos(phi);
    const double y = radiusOf(i) * std::sin(phi);
    const int next = (i + 1) % n;
    tube.P.row(i) << x, y, -heightOf(i);
    tube.P.row(n + i) << x, y, heightOf(i);
    tube.F.row(2 * i) << i, next, n + next;
    tube.F.row(2 * i + 1) << i, n + next, n + i;
  }
  return tube;
}

/// Holes in planes, filled in them: the shape is known.
void TestStars()
{
  for (const int n : { 6, 300, 3000 })
  {
    const auto radiusOf = [](int i) { return i % 2 == 0 ? 1.0 : 0.6; };
    TriangleMesh star = Tube(n, radiusOf, [](int) { return 0.5; });
    star.P.col(2) += 0.3 * star.P.col(0); // planes that lie along no axis
    const double area = 0.5 * n * 0.6 * std::sin(2.0 * Meshes::Pi / n);
    const double walls = TriangleAreas(star.P, star.F).sum();
    CHECK(FillHoles(star) == 2 && IsClosed(star), "both ends of a star are filled");
    CHECK_NEAR(EnclosedVolume(star.P, star.F) / area, 1.0, 1e-12, "volume of a star");
    const double ends = TriangleAreas(star.P, star.F).sum() - walls;
    CHECK_NEAR(
      ends / (2.0 * area * std::sqrt(1.09)), 1.0, 1e-10, "triangles of a filling do not overlap");
  }
}

/// Wherever in memory the work is done, a hole is filled alike. Symmetric ones have many equal
/// choices.
void TestHoleElsewhere()
{
  for (const int n : { 24, 64, 128, 400 })
  {
    const auto heightOf = [n](int i) { return 1.0 + 0.2 * std::cos(8.0 * Meshes::Pi * i / n); };
    const TriangleMesh tube = Tube(
      n, [](int) { return 1.0; }, heightOf);
    TriangleMesh first = tube;
    FillHoles(first);
    CHECK(IsClosed(first) && first.P.topRows(2 * n) == tube.P, "wavy ends are filled");
    std::mt19937 engine;
    std::vector<std::vector<char>> taken(400);
    for (int k = 0; k < 20; ++k)
    {
      for (auto& memory : taken)
      {
        memory = std::vector<char>(engine() % 20000);
      }
      TriangleMesh again = tube;
      FillHoles(again);
      CHECK(again == first, "a hole of " << n << " corners is filled alike each time");
    }
  }
}

/// Sizes whose squares are no numbers, and borders without an area or with three points on a line.
void TestOddBorders()
{
  const auto one = [](int) { return 1.0; };
  for (const double wave : { 0.0, 0.2 })
  {
    const auto heightOf = [wave](int i) { return 1.0 + wave * std::cos(Meshes::Pi * i / 3.0); };
    TriangleMesh expected = Tube(24, one, heightOf);
    const TriangleMesh tube = expected;
    FillHoles(expected);
    for (const double size : { 1e-200, 1e200 })
    {
      TriangleMesh mesh = tube;
      mesh.P *= size;
      CHECK(FillHoles(mesh) == 2 && IsClosed(mesh) && mesh.P.allFinite(), "of size " << size);
      CHECK_NEAR(EnclosedVolume(mesh.P / size, mesh.F) / EnclosedVolume(expected.P, expected.F),
        1.0, 0.01, "volume of size " << size);
    }
  }
  TriangleMesh line = Tube(3, one, one);
  for (int i = 0; i < 3; ++i)
  {
    line.P.row(i) << i, 0.0, -1.0;
  }
  FillHoles(line);
  CHECK(IsClosed(line) && line.P.rows() == 7, "a border on a line gets a point in the middle");
}

void TestHoles()
{
  TriangleMesh ball = Meshes::Icosphere(3);
  const double volume = EnclosedVolume(ball.P, ball.F);
  ball.F = ball.F.topRows(ball.F.rows() - 9).eval();
  const Points before = ball.P;
  CHECK(FindOpenEdges(ball.F).borders > 0, "it is open");
  CHECK(FillHoles(ball) >= 1, "it has holes");
  CHECK(IsClosed(ball), "they are filled");
  CHECK(ball.P.topRows(before.rows()) == before, "points keep their numbers");
  CHECK_NEAR(EnclosedVolume(ball.P, ball.F) / volume, 1.0, 0.02, "volume");
  const OpenEdges three = FindOpenEdges(Meshes::ThreeAtAnEdge().F);
  CHECK(three.nonManifold > 0 && three.firstNonManifold >= 0, "three triangles at an edge");
}
} // namespace

int main()
{
  TestSections();
  TestFans();
  TestEdgesOfMany();
  TestRepetitions();
  TestBall();
  TestLean();
  TestWalls();
  TestRim();
  TestTipsAbove();
  TestNoRoomAtOnePlace();
  TestThickResult();
  TestThickBall();
  TestFlatBase();
  TestNested();
  TestTip();
  TestOutOfReach();
  TestHoles();
  TestStars();
  TestHoleElsewhere();
  TestOddBorders();
  return CheckResult();
}
