// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Triangles made to agree: what was turned round by hand comes back, and meshes that have no two
// sides come through.
#include "Check.h"
#include "MeshQuality.h"
#include "Meshes.h"
#include "Orientation.h"
#include "SurfaceMeasures.h"

using namespace SphericalStyle;

namespace
{
/// A share of the triangles, at random, turned round as OrientAlike does it.
TriangleMesh SomeTurned(TriangleMesh mesh, double share, std::uint32_t seed)
{
  Meshes::Random random(seed);
  for (int f = 0; f < mesh.F.rows(); ++f)
  {
    if (random.Unit() < share)
    {
      std::swap(mesh.F(f, 1), mesh.F(f, 2));
    }
  }
  return mesh;
}

void TestTurnedBack()
{
  const TriangleMesh parts = Meshes::Together({ Meshes::Ellipsoid(3), Meshes::HollowBall(0.1, 2),
    Meshes::Moved(Meshes::Cup(0.1), { 3, 0, 0 }) });
  for (const TriangleMesh& mesh : { Meshes::Ellipsoid(3), Meshes::Cup(0.1), Meshes::Box(4), parts })
  {
    CHECK(OrientAlike(mesh.P, mesh.F) == mesh.F, "what agrees should stay");
    for (const double share : { 0.1, 0.3 })
    {
      CHECK(OrientAlike(mesh.P, SomeTurned(mesh, share, 7).F) == mesh.F,
        "what was turned round, a share of " << share << ", should come back");
      CHECK(OrientOutward(mesh.P, SomeTurned(mesh, 1.0 - share, 7).F) == mesh.F,
        "what faces inward for the most should come out");
    }
  }
  const TriangleMesh hollow = Meshes::HollowBall(0.5, 2);
  CHECK(OrientAlike(hollow.P, hollow.F) == hollow.F, "a cavity should stay one");
}

// Half of an open sheet disagrees with the other: the larger half is right.
void TestOpen()
{
  const TriangleMesh patch = Meshes::Patch(6, 0.3);
  TriangleMesh turned = patch;
  turned.F.topRows(25).col(1).swap(turned.F.topRows(25).col(2));
  CHECK(
    OrientAlike(turned.P, turned.F) == patch.F, "a sheet should face the way that most of it does");
}

// A strip of one side, an edge of three triangles, and nothing: triangles stay triangles.
void TestWithoutOutside()
{
  std::vector<Meshes::Vector> points;
  std::vector<std::array<int, 3>> triangles;
  const int n = 24;
  for (int i = 0; i < n; ++i)
  {
    const double a = 2.0 * Meshes::Pi * i / n;
    const Meshes::Vector out(std::cos(a), std::sin(a), 0.0);
    const Meshes::Vector across = std::cos(a / 2) * out + std::sin(a / 2) * Meshes::Vector::UnitZ();
    points.emplace_back(out + 0.3 * across);
    points.emplace_back(out - 0.3 * across);
    const int a0 = 2 * i, a1 = 2 * i + 1;
    const int b0 = i + 1 < n ? a0 + 2 : 1, b1 = i + 1 < n ? a1 + 2 : 0;
    triangles.push_back({ a0, a1, b0 });
    triangles.push_back({ a1, b1, b0 });
  }
  const TriangleMesh fan =
    Meshes::Make({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 0, -1, -1 } },
      { { 0, 1, 2 }, { 1, 0, 3 }, { 0, 1, 4 } });
  for (const TriangleMesh& mesh :
    { Meshes::Make(points, triangles), fan, TriangleMesh{ fan.P, Triangles(0, 3) } })
  {
    const Triangles oriented = OrientAlike(mesh.P, mesh.F);
    CHECK(oriented.rows() == mesh.F.rows(), "no triangle should be lost");
    for (Eigen::Index f = 0; f < oriented.rows(); ++f)
    {
      const bool swapped = oriented(f, 1) == mesh.F(f, 2) && oriented(f, 2) == mesh.F(f, 1);
      CHECK(oriented(f, 0) == mesh.F(f, 0) && (swapped || oriented.row(f) == mesh.F.row(f)),
        "triangle " << f << " should be the same, or turned round");
    }
  }
}
}

int main()
{
  TestTurnedBack();
  TestOpen();
  TestWithoutOutside();
  return CheckResult();
}
