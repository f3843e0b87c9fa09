// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Creases, angles and borders by hand: folded sheets and boxes.
#include "Check.h"
#include "Creases.h"
#include "Meshes.h"

using namespace SphericalStyle;

namespace
{
/// Two squares of side 1 with an edge in common along y, the second one turned up by the angle.
TriangleMesh Fold(double angle)
{
  TriangleMesh mesh;
  mesh.P.resize(6, 3);
  mesh.P << -1, 0, 0, -1, 1, 0, 0, 0, 0, 0, 1, 0, std::cos(angle), 0, std::sin(angle),
    std::cos(angle), 1, std::sin(angle);
  mesh.F.resize(4, 3);
  mesh.F << 0, 2, 3, 0, 3, 1, 2, 4, 5, 2, 5, 3;
  return mesh;
}

/// The second square faces the other way.
TriangleMesh Turned(TriangleMesh mesh)
{
  mesh.F.bottomRows(2) = mesh.F.bottomRows(2).rowwise().reverse().eval();
  return mesh;
}

void TestFold()
{
  // Three edges of two triangles: two diagonals, which stay flat, and the fold.
  constexpr double Degree = Pi / 180.0;
  for (const bool turned : { false, true })
  {
    const auto fold = [turned](double angle) { return turned ? Turned(Fold(angle)) : Fold(angle); };
    for (const double before : { 0.0, 19.0, -19.0, 21.0 })
    {
      for (const double after : { 0.0, 39.0, 41.0, -41.0, 175.0 })
      {
        const CreaseProbes probes = PlaceCreaseProbes(fold(before * Degree));
        const double made = NewCreases(probes, Fold(after * Degree).P);
        const bool isNew = std::abs(before) < 20.0 && std::abs(after) > 40.0;
        CHECK_NEAR(made, isNew ? 1.0 / 3.0 : 0.0, 1e-14,
          "a fold of " << before << " that becomes one of " << after << " degrees");
        CHECK_NEAR(probes.meanAngle, std::abs(before) * Degree / 3.0, 1e-12, "angles before");
        CHECK(probes.manifold != turned, "whether the squares agree");
        CHECK_NEAR(probes.border, 6.0 / std::sqrt(2.0), 1e-12, "the border");
      }
    }
  }
  // The area before counts, so what shrinks does not hide.
  const TriangleMesh flat = Fold(0.0);
  CHECK_NEAR(NewCreases(PlaceCreaseProbes(flat), 1e-3 * Fold(1.0).P), 1.0 / 3.0, 1e-14, "shrunk");
}

void TestBox()
{
  for (const int k : { 1, 4 })
  {
    // Of the area at edges 12 k of 18 k^2 have a right angle.
    const TriangleMesh box = Meshes::Box(k);
    const CreaseProbes probes = PlaceCreaseProbes(box);
    CHECK(probes.border == 0.0 && probes.manifold, "a box is closed");
    CHECK(NewCreases(probes, box.P) == 0.0, "what stays as it is");
    // Twelve edges of length 2, and an area of 24.
    CHECK_NEAR(probes.boxEdges, 24.0 / std::sqrt(24.0), 1e-12, "sharp edges of a box");
    CHECK_NEAR(probes.planarShare, 1.0 - 12.0 / (18.0 * k), 1e-12, "faces of a box");
    CHECK_NEAR(probes.meanAngle, 0.5 * Pi * 12.0 / (18.0 * k), 1e-12, "angles of a box of " << k);
  }
}

void TestSteps()
{
  // A sheet that becomes a row of roofs: what every step-th triangle says of it.
  TriangleMesh sheet = Meshes::Patch(200, 0.0);
  Points roofs = sheet.P;
  for (int i = 0; i < roofs.rows(); ++i)
  {
    roofs(i, 2) = 0.2 * std::abs(std::remainder(10.0 * roofs(i, 0), 1.0));
  }
  CHECK_NEAR(PlaceCreaseProbes(Meshes::Box(60), 7).boxEdges, std::sqrt(24.0), 0.5, "every 7th");
  const CreaseProbes all = PlaceCreaseProbes(sheet);
  const double ridges = NewCreases(all, roofs);
  CHECK(ridges > 0.02 && ridges < 0.2, "roofs have ridges: " << ridges);
  CHECK_NEAR(all.border, 7.2 / std::sqrt(3.2), 1e-11, "the border");
  for (const int step : { 3, 11 })
  {
    const CreaseProbes some = PlaceCreaseProbes(sheet, step);
    CHECK(10 * step * some.flat.size() < 21 * all.flat.size(), "fewer edges"); // two of a pair
    CHECK_NEAR(NewCreases(some, roofs), ridges, 0.05 * ridges, "every " << step << "th");
    CHECK_NEAR(some.border, all.border, 0.2 * all.border, "every " << step << "th");
  }
}

void TestNothing()
{
  for (const TriangleMesh& mesh : { TriangleMesh{ Points(0, 3), Triangles(0, 3) },
         TriangleMesh{ Points::Zero(6, 3), Fold(0.0).F } })
  {
    const CreaseProbes probes = PlaceCreaseProbes(mesh);
    CHECK(NewCreases(probes, mesh.P) == 0.0 && probes.meanAngle == 0.0 && probes.border == 0.0,
      "nothing there");
  }
  TriangleMesh three = Fold(0.0); // a wall on the fold: no crease, no border
  three.F.conservativeResize(5, 3);
  three.F.row(4) << 2, 3, 0;
  const CreaseProbes probes = PlaceCreaseProbes(three);
  CHECK(NewCreases(probes, Fold(2.0).P) == 0.0 && !probes.manifold,
    "an edge of three triangles is none of two");
}
}

int main()
{
  TestFold();
  TestBox();
  TestSteps();
  TestNothing();
  return CheckResult();
}
