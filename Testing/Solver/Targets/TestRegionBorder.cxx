// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The border of a region: the polynomial written the other way round, and how smoothly it ends. The
// distances are guarded with the filters, Testing/Cxx/TestSphericalStyleFilterRegions.cxx.
#include "Check.h"
#include "RegionBorder.h"

#include <limits>

using namespace SphericalStyle;

namespace
{
// By Horner from the other end: 1 - (1 - x)^3 (1 + 3 x + 6 x^2).
double Rise(double x)
{
  const double y = 1.0 - x;
  return x >= 1.0 ? 1.0 : 1.0 - y * y * y * (1.0 + 3.0 * x + 6.0 * x * x);
}

void TestPolynomial()
{
  const Eigen::VectorXd distances = Eigen::VectorXd::LinSpaced(2001, 0.0, 2.0);
  for (const double width : { 1e-100, 0.3, 1.0, 1e100 })
  {
    const Eigen::VectorXd w = BorderWeights(width * distances, width);
    for (Eigen::Index i = 0; i < w.size(); ++i)
    {
      CHECK_NEAR(w[i], Rise(distances[i]), 1e-14, "weight at " << distances[i] << " widths");
      CHECK(i == 0 || w[i] >= w[i - 1], "weights should rise, they fall at " << distances[i]);
    }
  }
}

// Slope and curvature vanish at both ends.
void TestSmoothEnds()
{
  const int n = 100000;
  const Eigen::VectorXd w = BorderWeights(Eigen::VectorXd::LinSpaced(n + 1, 0.0, 2.0), 1.0);
  const double h = 2.0 / n;
  const auto slope = [&](int i) { return (w[i + 1] - w[i - 1]) / (2.0 * h); };
  const auto curvature = [&](int i) { return (w[i + 1] - 2.0 * w[i] + w[i - 1]) / (h * h); };
  for (const int i : { 1, n / 2 - 1, n / 2, n / 2 + 1, n - 1 })
  {
    CHECK_NEAR(slope(i), 0.0, 1e-7, "slope at " << i * h);
    CHECK_NEAR(curvature(i), 0.0, 5e-3, "curvature at " << i * h);
  }
  CHECK_NEAR(slope(n / 4), 1.875, 1e-6, "slope in the middle of the band");
  CHECK(w[n / 2] == 1.0 && w[n] == 1.0, "from the width on the weight should be 1 exactly");
}

void TestStep()
{
  const Eigen::Vector3d distances(0.0, 1e-300, std::numeric_limits<double>::infinity());
  for (const double width : { 0.0, 1e-310 })
  {
    const Eigen::VectorXd w = BorderWeights(distances, width);
    CHECK(w[0] == 0.0 && w[1] == 1.0 && w[2] == 1.0, "width " << width << " should be a step");
  }
  CHECK(BorderWeights(distances, 1.0)[2] == 1.0, "nothing outside: the weight should be 1");
  CHECK(BorderWeights({}, 1.0).size() == 0, "no distances, no weights");
}
} // namespace

int main()
{
  TestPolynomial();
  TestSmoothEnds();
  TestStep();
  return CheckResult();
}
