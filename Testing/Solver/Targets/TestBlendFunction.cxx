// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The weight t along an axis against values worked out by hand, and its promises: monotone, exact
// at both ends, nothing but the place along the axis counts.
#include "BlendFunction.h"
#include "Check.h"
#include "Meshes.h"

#include <algorithm>
#include <limits>
#include <string>

using namespace SphericalStyle;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double Epsilon = std::numeric_limits<double>::epsilon();

constexpr BlendFunction Running[] = { BlendFunction::Linear, BlendFunction::Quadratic,
  BlendFunction::Tanh, BlendFunction::Smoothstep };

std::string NameOf(BlendFunction function)
{
  const char* names[] = { "Constant", "Linear", "Quadratic", "Tanh", "Smoothstep" };
  return names[static_cast<int>(function)];
}

BlendOptions Run(BlendFunction function, double atStart = 0.0, double atEnd = 1.0)
{
  BlendOptions options;
  options.function = function;
  options.atStart = atStart;
  options.atEnd = atEnd;
  return options;
}

// n points on the y axis from 0 to 1; i / (n - 1) is exact for n - 1 a power of two.
Points Ladder(int n)
{
  Points P = Points::Zero(n, 3);
  for (int i = 0; i < n; ++i)
  {
    P(i, 1) = static_cast<double>(i) / (n - 1);
  }
  return P;
}

// tanh by 40 digits of decimal arithmetic.
void TestQuarterPoints()
{
  struct Case
  {
    BlendFunction function;
    double steepness;
    double g[5];
  };
  const Case cases[] = {
    { BlendFunction::Linear, 3.0, { 0.0, 0.25, 0.5, 0.75, 1.0 } },
    { BlendFunction::Quadratic, 3.0, { 0.0, 0.0625, 0.25, 0.5625, 1.0 } },
    { BlendFunction::Smoothstep, 3.0, { 0.0, 0.15625, 0.5, 0.84375, 1.0 } },
    { BlendFunction::Tanh, 0.5, { 0.0, 0.23500371220159449, 0.5, 0.76499628779840551, 1.0 } },
    { BlendFunction::Tanh, 3.0, { 0.0, 0.045176659730912132, 0.5, 0.95482334026908787, 1.0 } },
    { BlendFunction::Tanh, 20.0, { 0.0, 2.0611536139418493e-9, 0.5, 0.99999999793884639, 1.0 } },
  };
  for (const Case& c : cases)
  {
    BlendOptions options = Run(c.function);
    options.steepness = c.steepness;
    const Eigen::VectorXd t = BlendAlongAxis(Ladder(5), options);
    options.atStart = 0.8;
    options.atEnd = 0.3;
    const Eigen::VectorXd falling = BlendAlongAxis(Ladder(5), options);
    for (int i = 0; i < 5; ++i)
    {
      const std::string what = NameOf(c.function) + " at quarter " + std::to_string(i);
      CHECK_NEAR(BlendShape(c.function, c.steepness, 0.25 * i), c.g[i], 2 * Epsilon, what);
      CHECK_NEAR(t[i], c.g[i], 2 * Epsilon, what << " along the axis");
      CHECK_NEAR(falling[i], 0.8 - 0.5 * c.g[i], 4 * Epsilon, what << ", from .8 to .3");
    }
  }
  CHECK(BlendShape(BlendFunction::Constant, 3.0, 0.2) == 1.0, "the shape of Constant should be 1");
  // Near 0, Tanh is Linear.
  for (const double steepness : { 1e-4, 1e-150, 1e-300 })
  {
    for (int i = 0; i <= 8; ++i)
    {
      const double s = 0.125 * i;
      CHECK_NEAR(BlendShape(BlendFunction::Tanh, steepness, s), s, 1e-8,
        "Tanh of steepness " << steepness << " at " << s);
    }
  }
}

void TestConstant()
{
  for (const double value : { 0.0, 0.1, 0.5, 1.0 })
  {
    BlendOptions options;
    options.constant = value;
    // What only the others use does not matter.
    options.axis.setZero();
    options.range = Vector2d(1.0, NaN);
    options.atStart = -3.0;
    options.steepness = -1.0;
    const Eigen::VectorXd t = BlendAlongAxis(Ladder(7), options);
    CHECK(t.size() == 7 && (t.array() == value).all(), "Constant should be " << value);
  }
}

void TestMonotone()
{
  Meshes::Random random(1);
  for (const BlendFunction function : Running)
  {
    for (int k = 0; k < 40; ++k)
    {
      BlendOptions options = Run(function, random.Unit(), random.Unit());
      options.steepness = std::pow(10.0, 3.0 * random.Signed());
      const double start = 1.5 * random.Signed();
      options.range = Vector2d(start, start + 0.01 + random.Unit());
      const Eigen::VectorXd t = BlendAlongAxis(Ladder(1025), options);
      const double sign = options.atEnd >= options.atStart ? 1.0 : -1.0;
      const double low = std::min(options.atStart, options.atEnd);
      const double high = std::max(options.atStart, options.atEnd);
      CHECK(t.minCoeff() >= low && t.maxCoeff() <= high,
        NameOf(function) << ": t should stay between its ends, " << low << " and " << high
                         << "; it runs from " << t.minCoeff() << " to " << t.maxCoeff());
      for (int i = 1; i < t.size(); ++i)
      {
        CHECK(sign * (t[i] - t[i - 1]) >= -Epsilon,
          NameOf(function) << " should not turn back at " << i << ", from " << t[i - 1] << " to "
                           << t[i] << "; from " << options.atStart << " to " << options.atEnd
                           << ", steepness " << options.steepness);
      }
    }
  }
}

// t = 1 must be 1, or points move that should not.
void TestExactEnds()
{
  Meshes::Random random(2);
  for (const BlendFunction function : Running)
  {
    for (int k = 0; k < 200; ++k)
    {
      BlendOptions options = Run(function, random.Unit(), random.Unit());
      options.steepness = std::pow(10.0, 2.0 * random.Signed());
      options.axis = random.InCube();
      const double start = 0.6 * random.Unit();
      options.range = Vector2d(start, start + 0.1 + 0.2 * random.Unit());
      Points P(60, 3);
      for (int i = 0; i < P.rows(); ++i)
      {
        P.row(i) = random.InCube().transpose();
      }
      const Eigen::VectorXd t = BlendAlongAxis(P, options);
      const Eigen::VectorXd place = P * options.axis;
      const double extent = place.maxCoeff() - place.minCoeff();
      int before = 0, behind = 0;
      for (int i = 0; i < P.rows(); ++i)
      {
        const double fraction = (place[i] - place.minCoeff()) / extent;
        if (fraction < options.range[0] - 1e-12)
        {
          ++before;
          CHECK(t[i] == options.atStart,
            NameOf(function) << " before the range: " << t[i] << ", not " << options.atStart);
        }
        if (fraction > options.range[1] + 1e-12)
        {
          ++behind;
          CHECK(t[i] == options.atEnd,
            NameOf(function) << " behind the range: " << t[i] << ", not " << options.atEnd);
        }
      }
      CHECK(before > 0 && behind > 0, "the test should have points before and behind the range");
    }
    // The lowest and the highest point themselves, wherever they are.
    for (int k = 0; k < 200; ++k)
    {
      BlendOptions options = Run(function, 0.1, 0.7);
      options.axis = random.InCube();
      Points P(5, 3);
      for (int i = 0; i < P.rows(); ++i)
      {
        P.row(i) = 100.0 * random.InCube().transpose();
      }
      const Eigen::VectorXd t = BlendAlongAxis(P, options);
      const Eigen::VectorXd place = P * options.axis;
      Eigen::Index low = 0, high = 0;
      place.minCoeff(&low);
      place.maxCoeff(&high);
      CHECK(t[low] == 0.1, NameOf(function) << ": t of the lowest point is " << t[low]);
      CHECK(t[high] == 0.7, NameOf(function) << ": t of the highest point is " << t[high]);
    }
  }
}

void TestAxis()
{
  Meshes::Random random(3);
  const Points P = Meshes::Perturbed(Meshes::Ellipsoid(2), 0.1, 4).P;
  for (const BlendFunction function : Running)
  {
    for (int k = 0; k < 20; ++k)
    {
      BlendOptions options = Run(function, 0.2, 0.9);
      options.axis = random.InCube();
      const Eigen::VectorXd t = BlendAlongAxis(P, options);

      // The formula, written out.
      const Eigen::VectorXd place = P * options.axis;
      const double low = place.minCoeff(), extent = place.maxCoeff() - low;
      for (int i = 0; i < P.rows(); ++i)
      {
        const double s = (place[i] - low) / extent;
        CHECK_NEAR(
          t[i], 0.2 + 0.7 * BlendShape(function, 3.0, s), 1e-14, "t at point " << i << " by hand");
      }
      for (const double length : { 1e-300, 1e-9, 1e9, 1e300 })
      {
        BlendOptions longer = options;
        longer.axis *= length;
        const double off = (BlendAlongAxis(P, longer) - t).cwiseAbs().maxCoeff();
        CHECK_NEAR(off, 0.0, 1e-14, "effect of an axis " << length << " times as long");
      }
      // Place, scale and rotation of model and axis together.
      const Eigen::Matrix3d turn = random.Rotation();
      BlendOptions turned = options;
      turned.axis = turn * options.axis;
      Points Q = P * turn.transpose();
      CHECK_NEAR(
        (BlendAlongAxis(Q, turned) - t).cwiseAbs().maxCoeff(), 0.0, 1e-13, "effect of a rotation");
      Q = 1e-8 * P;
      CHECK_NEAR(
        (BlendAlongAxis(Q, options) - t).cwiseAbs().maxCoeff(), 0.0, 1e-14, "effect of the scale");
      Q = P.rowwise() + Eigen::RowVector3d(1e3, -2e3, 5e2);
      CHECK_NEAR(
        (BlendAlongAxis(Q, options) - t).cwiseAbs().maxCoeff(), 0.0, 1e-11, "effect of the place");
    }
  }
  BlendOptions up = Run(BlendFunction::Linear);
  BlendOptions down = Run(BlendFunction::Linear, 1.0, 0.0);
  down.axis *= -1.0;
  CHECK_NEAR((BlendAlongAxis(P, up) - BlendAlongAxis(P, down)).cwiseAbs().maxCoeff(), 0.0, 1e-15,
    "axis turned round and ends swapped: difference");
}

void TestRange()
{
  BlendOptions options = Run(BlendFunction::Linear, 0.0, 1.0);
  options.range = Vector2d(0.25, 0.75);
  const double middle[] = { 0.0, 0.0, 0.0, 0.25, 0.5, 0.75, 1.0, 1.0, 1.0 };
  Eigen::VectorXd t = BlendAlongAxis(Ladder(9), options);
  for (int i = 0; i < 9; ++i)
  {
    CHECK(t[i] == middle[i], "range .25 to .75: t of point " << i << " is " << t[i]);
  }
  options.range = Vector2d(-1.0, 3.0); // wider than the model
  t = BlendAlongAxis(Ladder(9), options);
  for (int i = 0; i < 9; ++i)
  {
    CHECK(t[i] == 0.25 + i / 32.0, "range -1 to 3: t of point " << i << " is " << t[i]);
  }
  options.range = Vector2d(2.0, 3.0);
  CHECK((BlendAlongAxis(Ladder(9), options).array() == 0.0).all(), "all before the range");
  options.range = Vector2d(-3.0, -2.0);
  CHECK((BlendAlongAxis(Ladder(9), options).array() == 1.0).all(), "all behind the range");
  options.range = Vector2d(0.5, 0.5 + 1e-300 + Epsilon); // a step
  t = BlendAlongAxis(Ladder(9), options);
  CHECK(t[4] == 0.0 && t[5] == 1.0, "a short range should be a step");
}

// Points in a plane across the axis are all at its start; what rounding leaves of the plane is no
// extent.
void TestNoExtent()
{
  for (const BlendFunction function : Running)
  {
    const BlendOptions options = Run(function, 0.3, 0.9);
    Points P = Ladder(9);
    P.col(1).setConstant(7.25);
    P.col(0) = Eigen::VectorXd::LinSpaced(9, 0.0, 3.0);
    CHECK((BlendAlongAxis(P, options).array() == 0.3).all(),
      NameOf(function) << " of a plane should be its start");
    BlendOptions inside = options;
    inside.range = Vector2d(-1.0, 0.0);
    CHECK((BlendAlongAxis(P, inside).array() == 0.9).all(),
      NameOf(function) << " of a plane at the end of the range should be its end");
    const Points one = Points::Constant(1, 3, 5.0);
    CHECK((BlendAlongAxis(one, options).array() == 0.3).all(), "one point is at the start");
    CHECK(BlendAlongAxis(Points(0, 3), options).size() == 0, "no points, no weights");

    Meshes::Random random(5);
    for (int k = 0; k < 20; ++k)
    {
      const Eigen::Matrix3d turn = random.Rotation();
      BlendOptions turned = options;
      turned.axis = turn.col(1);
      const Points tilted = (P * turn.transpose()).rowwise() + 10.0 * random.InCube().transpose();
      const Eigen::VectorXd t = BlendAlongAxis(tilted, turned);
      CHECK((t.array() == 0.3).all(),
        NameOf(function) << " of a tilted plane should be its start, is up to " << t.maxCoeff());
    }
  }
}

void TestErrors()
{
  const Points P = Ladder(3);
  for (const double bad : { -0.1, 1.1, -1e-300, 1.0 + Epsilon, NaN, Infinity, -Infinity })
  {
    BlendOptions options;
    options.constant = bad;
    CHECK_THROWS(std::invalid_argument, BlendAlongAxis(P, options), "Blend ");
    for (const BlendFunction function : Running)
    {
      CHECK_THROWS(
        std::invalid_argument, BlendAlongAxis(P, Run(function, bad, 1.0)), "BlendAtStart");
      CHECK_THROWS(std::invalid_argument, BlendAlongAxis(P, Run(function, 0.0, bad)), "BlendAtEnd");
    }
  }
  for (const BlendFunction function : Running)
  {
    BlendOptions options = Run(function);
    const Vector3d noAxes[] = { { 0.0, 0.0, 0.0 }, { 0.0, -0.0, 0.0 }, { NaN, 1.0, 0.0 },
      { 0.0, Infinity, 0.0 } };
    for (const Vector3d& axis : noAxes)
    {
      options.axis = axis;
      CHECK_THROWS(std::invalid_argument, BlendAlongAxis(P, options), "BlendAxis");
    }
    options = Run(function);
    const Vector2d noRanges[] = { { 0.5, 0.5 }, { 1.0, 0.0 }, { NaN, 1.0 }, { 0.0, NaN },
      { -Infinity, 1.0 }, { 0.0, Infinity } };
    for (const Vector2d& range : noRanges)
    {
      options.range = range;
      CHECK_THROWS(std::invalid_argument, BlendAlongAxis(P, options), "BlendRange");
    }
    for (const double bad : { 0.0, -1.0, NaN, Infinity })
    {
      options = Run(function);
      options.steepness = bad;
      if (function == BlendFunction::Tanh)
      {
        CHECK_THROWS(std::invalid_argument, BlendAlongAxis(P, options), "TanhSteepness");
      }
      else
      {
        CHECK(BlendAlongAxis(P, options).size() == 3, "the steepness matters to Tanh alone");
      }
    }
    // Also without a point to weigh.
    options = Run(function, 2.0);
    CHECK_THROWS(std::invalid_argument, BlendAlongAxis(Points(0, 3), options), "BlendAtStart");
  }
}
} // namespace

int main()
{
  TestQuarterPoints();
  TestConstant();
  TestMonotone();
  TestExactEnds();
  TestAxis();
  TestRange();
  TestNoExtent();
  TestErrors();
  return CheckResult();
}
