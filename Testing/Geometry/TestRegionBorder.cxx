// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The border of a region against distances by brute force, and how smoothly it ends.
#include "Check.h"
#include "Meshes.h"
#include "RegionBorder.h"

#include <limits>
#include <string>

using namespace SphericalStyle;

namespace
{
// The polynomial by Horner from the other end: 1 - (1 - x)^3 (1 + 3 x + 6 x^2).
double Rise(double x)
{
  const double y = 1.0 - x;
  return x >= 1.0 ? 1.0 : 1.0 - y * y * y * (1.0 + 3.0 * x + 6.0 * x * x);
}

Eigen::VectorXd ByBruteForce(const Points& P, const std::vector<char>& inside, double width)
{
  Eigen::VectorXd weights(P.rows());
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (Eigen::Index j = 0; j < P.rows(); ++j)
    {
      if (!inside[j])
      {
        nearest = std::min(nearest, (P.row(i) - P.row(j)).stableNorm());
      }
    }
    weights[i] = inside[i] ? Rise(nearest / width) : 0.0;
  }
  return weights;
}

bool SameBits(const Eigen::VectorXd& a, const Eigen::VectorXd& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

std::vector<char> HalfSpace(const Points& P, const Meshes::Vector& normal, double offset)
{
  std::vector<char> inside(P.rows());
  for (Eigen::Index i = 0; i < P.rows(); ++i)
  {
    inside[i] = P.row(i).dot(normal) > offset;
  }
  return inside;
}

void TestBruteForce()
{
  Meshes::Random random(1);
  const std::vector<Meshes::Named> models = { { "ellipsoid", Meshes::Ellipsoid(3) },
    { "box", Meshes::Box(10) }, { "two parts", Meshes::TwoComponents() },
    { "slivers", Meshes::Slivers() }, { "patch", Meshes::Patch(12, 0.2) } };
  for (const auto& [name, mesh] : models)
  {
    for (int k = 0; k < 30; ++k)
    {
      std::vector<char> inside =
        HalfSpace(mesh.P, random.InCube().normalized(), 0.3 * random.Signed());
      if (k % 3 == 0) // no shape at all
      {
        std::generate(inside.begin(), inside.end(), [&] { return random.Unit() < 0.9; });
      }
      const double width = std::pow(10.0, 1.5 * random.Signed() - 0.5);
      const Eigen::VectorXd weights = BorderWeights(mesh.P, inside, width, 1);
      const double off = (weights - ByBruteForce(mesh.P, inside, width)).cwiseAbs().maxCoeff();
      CHECK(off <= 1e-14, name << ": weights are off by " << off << " for the width " << width);
      CHECK(weights.minCoeff() >= 0.0 && weights.maxCoeff() <= 1.0, name << ": weights in 0..1");
      for (Eigen::Index i = 0; i < weights.size(); ++i)
      {
        CHECK(inside[i] || weights[i] == 0.0, name << ": outside the weight should be 0");
      }
      for (const int threads : { 2, 3, 7 })
      {
        CHECK(SameBits(weights, BorderWeights(mesh.P, inside, width, threads)),
          name << ": " << threads << " threads should give the same bits as one");
      }
    }
  }
}

// Along a line the weights are the polynomial itself; slope and curvature vanish at both ends.
void TestSmoothEnds()
{
  const int n = 100000;
  Points P = Points::Zero(n + 2, 3);
  std::vector<char> inside(n + 2, 1);
  for (int i = 0; i <= n; ++i)
  {
    P(i, 1) = 2.0 * i / n; // width 1 ends in the middle
  }
  inside[0] = 0;
  P(n + 1, 1) = -1.0;
  inside[n + 1] = 0;
  const Eigen::VectorXd w = BorderWeights(P, inside, 1.0, 2);
  const double h = 2.0 / n;
  for (int i = 1; i <= n; ++i)
  {
    CHECK(w[i] >= w[i - 1], "weights should rise, they fall at " << P(i, 1));
  }
  const auto slope = [&](int i) { return (w[i + 1] - w[i - 1]) / (2.0 * h); };
  const auto curvature = [&](int i) { return (w[i + 1] - 2.0 * w[i] + w[i - 1]) / (h * h); };
  for (const int i : { 1, n / 2 - 1, n / 2, n / 2 + 1, n - 1 })
  {
    CHECK_NEAR(slope(i), 0.0, 1e-7, "slope at " << P(i, 1));
    CHECK_NEAR(curvature(i), 0.0, 5e-3, "curvature at " << P(i, 1));
  }
  CHECK_NEAR(w[n / 4], 0.5, 1e-12, "weight in the middle of the band");
  CHECK_NEAR(slope(n / 4), 1.875, 1e-6, "slope in the middle of the band");
  CHECK(w[n / 2] == 1.0 && w[n] == 1.0, "from the width on the weight should be 1 exactly");
}

void TestEnds()
{
  const Points P = Meshes::Ellipsoid(2).P;
  const auto n = static_cast<std::size_t>(P.rows());
  const auto all = [n](char value) { return std::vector<char>(n, value); };
  for (const double width : { 0.0, 0.3, 1e9 })
  {
    CHECK((BorderWeights(P, all(1), width, 2).array() == 1.0).all(),
      "all inside: all weights should be 1 for the width " << width);
    CHECK((BorderWeights(P, all(0), width, 2).array() == 0.0).all(),
      "all outside: all weights should be 0 for the width " << width);
  }
  const std::vector<char> half = HalfSpace(P, { 1, 0, 0 }, 0.1);
  const Eigen::VectorXd step = BorderWeights(P, half, 0.0, 2);
  const Eigen::VectorXd narrow = BorderWeights(P, half, 1e-12, 2);
  for (std::size_t i = 0; i < n; ++i)
  {
    const auto at = static_cast<Eigen::Index>(i);
    CHECK(step[at] == (half[i] ? 1.0 : 0.0), "width 0 should be a step");
    CHECK(narrow[at] == step[at], "a width below all distances should be a step");
  }
  CHECK(BorderWeights(Points(0, 3), {}, 0.1, 2).size() == 0, "no points, no weights");

  // A point inside at the place of one outside stays with it.
  Points twice(4, 3);
  twice << 1, 2, 3, 1, 2, 3, 1, 2, 3.5, 9, 9, 9;
  const Eigen::VectorXd w = BorderWeights(twice, { 1, 0, 1, 1 }, 1.0, 1);
  CHECK(w[0] == 0.0 && w[1] == 0.0, "coincident points should get one weight");
  CHECK_NEAR(w[2], 0.5, 1e-15, "half a width away");
  CHECK(w[3] == 1.0, "far away");
}

void TestInvariance()
{
  Meshes::Random random(3);
  const Points P = Meshes::Perturbed(Meshes::Ellipsoid(2), 0.05, 2).P;
  const std::vector<char> inside = HalfSpace(P, { 0.3, 1.0, -0.2 }, 0.05);
  const Eigen::VectorXd w = BorderWeights(P, inside, 0.5, 1);
  for (const double scale : { 1e-100, 1e-30, 1e-6, 1e6, 1e30, 1e100 })
  {
    const double off = (BorderWeights(scale * P, inside, 0.5 * scale, 1) - w).cwiseAbs().maxCoeff();
    CHECK_NEAR(off, 0.0, 1e-12, "effect of the scale " << scale);
  }
  for (int k = 0; k < 10; ++k)
  {
    const Points turned =
      (P * random.Rotation().transpose()).rowwise() + 100.0 * random.InCube().transpose();
    const double off = (BorderWeights(turned, inside, 0.5, 1) - w).cwiseAbs().maxCoeff();
    CHECK_NEAR(off, 0.0, 1e-11, "effect of place and rotation");
    const std::vector<int> order = random.Permutation(static_cast<int>(P.rows()));
    std::vector<char> there(inside.size());
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      there[i] = inside[order[i]];
    }
    const Points other = P(order, Eigen::all);
    const Eigen::VectorXd permuted = BorderWeights(other, there, 0.5, 1);
    const Eigen::VectorXd expected = w(order);
    CHECK(SameBits(permuted, expected), "another order of the points should change no bit");
  }
}
} // namespace

int main()
{
  TestBruteForce();
  TestSmoothEnds();
  TestEnds();
  TestInvariance();
  return CheckResult();
}
