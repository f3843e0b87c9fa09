// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Parts with a style of their own keep together [styles]: what styles that are the same everywhere
// lead to, and a long rod, where the place of each point is an integral along the axis. And the
// shares of parts [centers], there and along a strip.
#include "Check.h"
#include "Frame.h"
#include "Meshes.h"
#include "PartShares.h"
#include "SphericalStyleMethod.h"
#include "SurfaceMeasures.h"

#include <algorithm>

using namespace SphericalStyle;

namespace
{
constexpr double HalfLength = 5.0;
constexpr double Thin = 0.25;

struct Rod
{
  TriangleMesh mesh;
  Eigen::VectorXd heights; // z of each point
};

/// Along z, with round ends.
Rod LongRod()
{
  std::vector<std::array<double, 2>> profile;
  constexpr int Rings = 160;
  for (int k = 0; k <= Rings; ++k)
  {
    const double z = HalfLength * (1.0 - 2.0 * k / Rings);
    const double inside = std::max(std::abs(z) - (HalfLength - Thin), 0.0);
    profile.push_back({ std::sqrt(std::max(Thin * Thin - inside * inside, 0.0)), z });
  }
  Rod rod;
  rod.mesh = Meshes::Revolved(profile, 24);
  rod.heights = rod.mesh.P.col(2);
  return rod;
}

/// From `low` at heights below 1 to `high` above 3.
Eigen::VectorXd Rising(const Eigen::VectorXd& z, double low, double high)
{
  const Eigen::ArrayXd x = (0.5 * (z.array() - 1.0)).max(0.0).min(1.0);
  return low + (high - low) * (x * x * (3.0 - 2.0 * x));
}

Points Rounded(const TriangleMesh& mesh, MethodOptions options)
{
  options.sphericalWeighting = SphericalWeighting::Cotangent; // that of the closed form
  SphericalStyleMethod method;
  method.SetMesh(mesh);
  method.Solve(options);
  return method.GetPositions();
}

/// On a strip far longer than s two smoothing steps give 1/2 at the border and e^-x (1 + x / 2) / 2
/// from there on, x = distance over s.
void TestShares()
{
  TriangleMesh strip = Meshes::Scaled(Meshes::Patch(100, 0.0), { 10.0, 0.5, 1.0 });
  strip.P = FrameOf(strip.P).Into(strip.P);
  const Eigen::Index n = strip.P.rows();
  strip.P.conservativeResize(n + 1, 3); // a point of no triangle, in a cell of its own
  strip.P.row(n) << 0.0, 0.0, 10.0;
  std::vector<int> parts(n + 1, 2);
  double below = -1.0, above = 1.0;
  for (Eigen::Index i = 0; i < n; ++i)
  {
    const double x = strip.P(i, 0);
    parts[i] = x < 0.0 ? 0 : 1;
    double& side = x < 0.0 ? below : above;
    side = x < 0.0 ? std::max(side, x) : std::min(side, x);
  }
  const Fields step = PartShares(parts, 3);
  for (Eigen::Index i = 0; i <= n; ++i)
  {
    CHECK(step(i, parts[i]) == 1.0 && step.row(i).sum() == 1.0, "point " << i << " is of one part");
  }

  constexpr double Size = 0.05;
  SurfaceGrid grid(strip.P, strip.F, Size, 1);
  grid.FactorAlong(1);
  const Fields smooth = SmoothShares(grid, step, strip.P, 1);
  const double border = 0.5 * (below + above);
  double worst = 0.0;
  for (Eigen::Index i = 0; i < n; ++i)
  {
    CHECK(smooth.row(i).minCoeff() >= 0.0, "no share below 0 at point " << i);
    CHECK_NEAR(smooth.row(i).sum(), 1.0, 1e-14, "sum of the shares of point " << i);
    const double x = std::abs(strip.P(i, 0) - border) / Size;
    if (x < 6.0)
    {
      const double expected = 0.5 * std::exp(-x) * (1.0 + 0.5 * x);
      worst = std::max(worst, std::abs(smooth(i, 1 - parts[i]) - expected));
    }
  }
  std::cout << "shares along a strip: off by " << worst << " at most\n";
  CHECK(worst < 0.003, "shares along a strip are off by " << worst);
  CHECK((smooth.row(n).array() == step.row(n).array()).all(), "where there is no grid they stay");
}

/// Styles that are the same everywhere are those of the model.
void TestSameEverywhere()
{
  const TriangleMesh mesh = Meshes::Doll();
  const auto n = mesh.P.rows();
  for (const double detailSize : { 0.0, 0.05 })
  {
    MethodOptions whole;
    whole.lambda = 1.5;
    whole.normalBlend = 0.4;
    whole.detailSize = detailSize;
    MethodOptions parts = whole;
    parts.lambda = 3.0;
    parts.partFactors = Eigen::VectorXd::Constant(n, 0.5);
    const Points expected = Rounded(mesh, whole);
    CHECK_NEAR(Meshes::Distance(Rounded(mesh, parts), expected), 0.0, 1e-12,
      "one factor for all, details " << detailSize);
    parts.normalBlend = 0.9;
    parts.normalBlends = Eigen::VectorXd::Constant(n, 0.4);
    parts.blendsOfParts = true;
    CHECK_NEAR(Meshes::Distance(Rounded(mesh, parts), expected), 0.0, 1e-12,
      "one blend for all, details " << detailSize);
    parts.partFactors.setZero();
    CHECK(Meshes::SameBits(Rounded(mesh, parts), mesh.P), "no roundness, no change");
    parts.partFactors = Eigen::VectorXd::Constant(n, 0.25);
    parts.roundnessFactors = Eigen::VectorXd::Constant(n, 2.0);
    CHECK_NEAR(Meshes::Distance(Rounded(mesh, parts), expected), 0.0, 1e-12,
      "both factors multiply, details " << detailSize);
  }
}

/// The mean place along the rod of the ring of points at a height of the rest shape.
double PlaceOf(const Rod& rod, const Points& rounded, double height)
{
  double nearest = 1e30;
  for (const double z : rod.heights)
  {
    nearest = std::abs(z - height) < std::abs(nearest - height) ? z : nearest;
  }
  const Eigen::ArrayXd there = ((rod.heights.array() - nearest).abs() < 1e-9).cast<double>();
  return (there * rounded.col(2).array()).sum() / there.sum();
}

/// The target of a point of the rod is at r z / |p| along it. Where m changes, a point that goes
/// the share m of its way is at z + m (r z / |p| - z), and the rod is drawn out by the gradient of
/// m. Without that it is as long as the integral of 1 + m (r z / |p| - z)'.
void TestLengthOfRod()
{
  const Rod rod = LongRod();
  constexpr double Lambda = 2.0;
  constexpr double From = 0.8;
  constexpr double To = 4.2;
  constexpr int Steps = 4000;
  const double r = std::sqrt(TriangleAreas(rod.mesh.P, rod.mesh.F).sum() / (4.0 * Pi));
  for (const auto& [low, high] : { std::pair(1.0, 0.0), std::pair(0.0, 1.0), std::pair(0.5, 2.0) })
  {
    MethodOptions options;
    options.lambda = Lambda;
    options.partFactors = Rising(rod.heights, low, high);
    const Points together = Rounded(rod.mesh, options);
    std::swap(options.partFactors, options.roundnessFactors);
    const Points alone = Rounded(rod.mesh, options);
    double expected = 0.0;
    for (int k = 0; k < Steps; ++k)
    {
      const double z = From + (k + 0.5) / Steps * (To - From);
      const double mu =
        std::sqrt(3.0) * Lambda * Rising(Eigen::VectorXd::Constant(1, z), low, high)(0);
      const double ofTarget = r * Thin * Thin / std::pow(z * z + Thin * Thin, 1.5);
      expected += (To - From) / Steps * (1.0 + mu * ofTarget) / (1.0 + mu);
    }
    const double length = PlaceOf(rod, together, To) - PlaceOf(rod, together, From);
    const double before = PlaceOf(rod, alone, To) - PlaceOf(rod, alone, From);
    std::cout << "factors " << low << " to " << high << ": length " << length << ", the integral "
              << expected << ", by factors of points " << before << "\n";
    CHECK_NEAR(length / expected, 1.0, 0.02, "factors " << low << " to " << high << ": length");
    CHECK(std::abs(before / expected - 1.0) > 0.15, "factors of points alone should not do it");
    // With factor 0 from a height of 3 on the end stays as it is, and goes along.
    if (high == 0.0)
    {
      const double end = PlaceOf(rod, together, 4.9) - PlaceOf(rod, together, 3.4);
      CHECK_NEAR(end, PlaceOf(rod, rod.mesh.P, 4.9) - PlaceOf(rod, rod.mesh.P, 3.4), 0.02,
        "length of the part that is not rounded");
    }
  }
}

/// The same for blends: the target goes from r d to rho n, which is at z itself on a rod.
void TestBlendsOfRod()
{
  const Rod rod = LongRod();
  MethodOptions options;
  options.lambda = 1e6;
  options.normalBlends = Rising(rod.heights, 0.0, 1.0);
  const Points alone = Rounded(rod.mesh, options);
  options.blendsOfParts = true;
  const Points together = Rounded(rod.mesh, options);
  // All of it is drawn to a ball below, and to what is round by itself about one place above.
  const double before = PlaceOf(rod, alone, 4.2) - PlaceOf(rod, alone, 0.8);
  const double length = PlaceOf(rod, together, 4.2) - PlaceOf(rod, together, 0.8);
  std::cout << "blends 0 to 1: length " << length << ", by blends of points " << before << "\n";
  CHECK_NEAR(length, 0.0, 0.05, "targets that do not change along the rod should not move it");
  CHECK(std::abs(before) > 0.5, "blends of points alone should");
}
}

int main()
{
  TestShares();
  TestSameEverywhere();
  TestLengthOfRod();
  TestBlendsOfRod();
  return CheckResult();
}
