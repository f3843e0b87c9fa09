// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// A surface is cut where it is narrow, and nowhere else.
#include "Check.h"
#include "Frame.h"
#include "Meshes.h"
#include "SurfaceMeasures.h"
#include "SurfaceParts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

using namespace SphericalStyle;
using Meshes::Vector;

namespace
{
constexpr int AnyNumber = 0;

SurfacePartsResult PartsOf(TriangleMesh mesh, int number = AnyNumber, int threads = 2)
{
  mesh.P = FrameOf(mesh.P).Into(mesh.P);
  PartsOptions options;
  options.numberOfParts = number;
  options.threads = threads;
  return FindParts(mesh.P, mesh.F, options);
}

/// Two balls of radius 1 that run through each other at x = 0.
TriangleMesh TwoBalls(double edge)
{
  const auto distance = [](const Vector& x)
  { return std::min((x - Vector(-0.85, 0, 0)).norm(), (x - Vector(0.85, 0, 0)).norm()) - 1.0; };
  return Meshes::Isosurface(distance, { -2.03, -1.11, -1.11 }, { 2.0, 1.1, 1.1 }, edge);
}

/// Whether each point has the part that its place says.
template <typename Expected>
double ShareOfAgreement(
  const TriangleMesh& mesh, const std::vector<int>& parts, const Expected& expected)
{
  std::map<int, std::map<int, double>> areas; // by expected, then by found
  const Eigen::VectorXd area = PointAreas(mesh.P, mesh.F);
  for (Eigen::Index i = 0; i < mesh.P.rows(); ++i)
  {
    areas[expected(Vector(mesh.P.row(i)))][parts[i]] += area(i);
  }
  double agreed = 0.0;
  std::set<int> taken;
  for (const auto& [name, found] : areas)
  {
    int best = found.begin()->first;
    for (const auto& [part, a] : found)
    {
      best = a > found.at(best) ? part : best;
    }
    CHECK(taken.insert(best).second, "part " << best << " should not be of two things");
    agreed += found.at(best);
  }
  return agreed / area.sum();
}

void CheckTwoBalls()
{
  const TriangleMesh mesh = TwoBalls(0.06);
  const SurfacePartsResult parts = PartsOf(mesh);
  CHECK(parts.count == 2, "two balls should be 2 parts, not " << parts.count);
  const double agreed =
    ShareOfAgreement(mesh, parts.parts, [](const Vector& x) { return x(0) > 0.0 ? 1 : 0; });
  CHECK(agreed > 0.98, "each ball should be a part, and " << agreed << " agrees");
  // Each part is a ball without a cap, of area 2 pi 1.85.
  const double diagonal = std::sqrt(3.7 * 3.7 + 2.0 * 2.0 + 2.0 * 2.0);
  const Eigen::VectorXd pointAreas = PointAreas(mesh.P, mesh.F);
  for (int p = 0; p < 2; ++p)
  {
    double area = 0.0;
    Eigen::RowVector3d center = Eigen::RowVector3d::Zero();
    for (Eigen::Index i = 0; i < mesh.P.rows(); ++i)
    {
      area += parts.parts[i] == p ? pointAreas(i) : 0.0;
      center += (parts.parts[i] == p ? pointAreas(i) : 0.0) * mesh.P.row(i);
    }
    const double finest = 0.03 * diagonal; // how far a border may be off
    CHECK_NEAR(area, 2.0 * Meshes::Pi * 1.85, finest * 2.0 * Meshes::Pi * 0.527, "ball " << p);
    CHECK_NEAR(std::abs(center(0) / area), 0.925, 0.5 * finest, "place of " << p);
    CHECK_NEAR(parts.thickness[p] * diagonal, 0.9, 0.15, "thickness of ball " << p);
  }
  // Another triangulation, the same parts.
  CHECK(PartsOf(TwoBalls(0.17)).count == 2, "two coarse balls should be 2 parts");
}

void CheckConvexThings()
{
  CHECK(PartsOf(Meshes::Icosphere(4)).count == 1, "a ball should be one part");
  CHECK(PartsOf(Meshes::Box(8)).count == 1, "a cube should be one part");
  CHECK(PartsOf(Meshes::Scaled(Meshes::Icosphere(4), { 2.0, 1.0, 1.0 })).count == 1,
    "an ellipsoid should be one part");
}

void CheckDoll()
{
  const TriangleMesh mesh = Meshes::Doll();
  const SurfacePartsResult parts = PartsOf(mesh);
  CHECK(parts.count == 6, "a doll should have 6 parts, not " << parts.count);
  const auto expected = [](const Vector& x)
  {
    const bool far = x.norm() > 1.05;
    return !far ? 0 : x(1) > 0.8 ? 1 : x(1) > -0.6 ? (x(0) > 0.0 ? 2 : 3) : (x(0) > 0.0 ? 4 : 5);
  };
  const double agreed = ShareOfAgreement(mesh, parts.parts, expected);
  CHECK(agreed > 0.93, "body, head and limbs should be parts, and " << agreed << " agrees");
  // The same for any number of threads.
  CHECK(PartsOf(mesh, AnyNumber, 8).parts == parts.parts, "eight threads should find the same");
  // A wanted number: more parts divide those that fewer give.
  std::vector<int> coarser(parts.parts.size(), 0);
  for (const int number : { 2, 4, 6 })
  {
    const SurfacePartsResult some = PartsOf(mesh, number);
    CHECK(some.count == number, "there should be " << number << " parts, not " << some.count);
    std::map<int, std::map<int, int>> within; // points of each part in those of before
    for (std::size_t i = 0; i < coarser.size(); ++i)
    {
      ++within[some.parts[i]][coarser[i]];
    }
    for (const auto& [part, counts] : within)
    {
      int most = 0;
      int all = 0;
      for (const auto& [before, count] : counts)
      {
        most = std::max(most, count);
        all += count;
      }
      CHECK(most > 0.97 * all,
        "part " << part << " of " << number << " should lie in one of fewer: " << most << " of "
                << all);
    }
    coarser = some.parts;
  }
}

void CheckLoosePieces()
{
  const TriangleMesh ball = Meshes::Icosphere(3);
  const TriangleMesh apart = Meshes::Together({ ball, Meshes::Moved(ball, { 5.0, 0.0, 0.0 }) });
  const SurfacePartsResult two = PartsOf(apart);
  CHECK(two.count == 2, "two balls should be two parts, not " << two.count);
  const Eigen::Index n = ball.P.rows();
  CHECK(std::set<int>(two.parts.begin(), two.parts.begin() + n).size() == 1 &&
      std::set<int>(two.parts.begin() + n, two.parts.end()).size() == 1,
    "each ball should be a part");
  CHECK(PartsOf(apart, 1).count == 2, "what is loose should not become one");
  // A bead that is too small for a part is of the nearest.
  const TriangleMesh bead =
    Meshes::Moved(Meshes::Scaled(ball, Vector::Constant(0.05)), { 3.5, 0.0, 0.0 });
  const SurfacePartsResult beads = PartsOf(Meshes::Together({ apart, bead }));
  CHECK(beads.count == 2, "a bead should be no part");
  CHECK(beads.parts.back() == beads.parts[n], "a bead should be of the nearest part");
}

void CheckAbort()
{
  TriangleMesh mesh = TwoBalls(0.17);
  mesh.P = FrameOf(mesh.P).Into(mesh.P);
  int asked = 0;
  bool aborted = false;
  try
  {
    FindParts(mesh.P, mesh.F, {}, [&](int, double) { return ++asked < 2; });
  }
  catch (const SolveAborted&)
  {
    aborted = true;
  }
  CHECK(aborted && asked == 2, "the second search should have been given up");
}
}

int main()
{
  CheckTwoBalls();
  CheckConvexThings();
  CheckDoll();
  CheckLoosePieces();
  CheckAbort();
  return CheckResult();
}
