// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Systems assembled from elements against the same ones assembled and factored densely: the
// pattern, the solution, badly scaled and singular blocks, and the same bits on any threads.
#include "BlockSystem.h"
#include "Check.h"
#include "Dense.h"
#include "Meshes.h"

#include <set>

using namespace SphericalStyle;

namespace
{
constexpr int Unknowns = 60;

/// Four points of a chain each, in any order; some are no unknowns.
std::vector<PairPattern::Element> MakeElements()
{
  Meshes::Random random(1);
  std::vector<PairPattern::Element> elements;
  for (int i = 0; i + 6 < Unknowns; ++i)
  {
    for (int k = 0; k < 2; ++k)
    {
      PairPattern::Element element = { i, i + 1 + k, i + 4, i + 6 };
      std::swap(element[0], element[static_cast<int>(4.0 * random.Unit())]);
      if (i % 5 == 0)
      {
        element[k] = -1;
      }
      elements.push_back(element);
    }
  }
  return elements;
}

struct Both
{
  explicit Both(const std::vector<PairPattern::Element>& elements, double spread)
    : pattern(Unknowns, elements)
    , sparse(pattern)
    , dense(Eigen::MatrixXd::Zero(3 * Unknowns, 3 * Unknowns))
  {
    Meshes::Random random(2);
    for (const PairPattern::Element& element : elements)
    {
      const double size = std::pow(10.0, spread * random.Signed());
      Eigen::Matrix<double, 12, 12> root;
      for (int i = 0; i < root.size(); ++i)
      {
        root(i) = random.Signed();
      }
      const Eigen::Matrix<double, 12, 12> own = size * root * root.transpose();
      for (int k = 0; k < 4; ++k)
      {
        for (int l = 0; l < 4; ++l)
        {
          if (element[k] < 0 || element[l] < 0)
          {
            continue;
          }
          const Eigen::Matrix3d block = own.block<3, 3>(3 * k, 3 * l);
          this->dense.block<3, 3>(3 * element[k], 3 * element[l]) += block;
          if (l <= k) // each pair once, the points in any order
          {
            this->sparse.Add(
              this->pattern.PlaceOf(element[k], element[l]), element[k] < element[l], block);
          }
        }
      }
    }
  }

  PairPattern pattern;
  BlockSystem sparse;
  Eigen::MatrixXd dense;
};

BlockSystem::Rows RightHandSide()
{
  Meshes::Random random(3);
  BlockSystem::Rows B(Unknowns, 3);
  for (int i = 0; i < Unknowns; ++i)
  {
    B.row(i) = random.InCube();
  }
  return B;
}

Eigen::VectorXd Flat(const BlockSystem::Rows& X)
{
  return Eigen::Map<const Eigen::VectorXd>(X.data(), X.size());
}

void TestPattern()
{
  const std::vector<PairPattern::Element> elements = MakeElements();
  const PairPattern pattern(Unknowns, elements);
  std::set<std::pair<int, int>> pairs;
  for (int i = 0; i < Unknowns; ++i)
  {
    pairs.emplace(i, i);
  }
  for (const PairPattern::Element& element : elements)
  {
    for (const int a : element)
    {
      for (const int b : element)
      {
        if (b >= 0 && a > b)
        {
          pairs.emplace(b, a);
        }
      }
    }
  }
  CHECK(pattern.GetNumberOfPairs() == pairs.size(), "each pair is there once");
  const ConjugateGradients::Matrix matrix = pattern.MakeMatrix();
  int place = 0;
  for (const auto& [column, row] : pairs) // column by column
  {
    CHECK(pattern.PlaceOf(row, column) == place && pattern.PlaceOf(column, row) == place,
      "the place of " << row << ", " << column);
    CHECK(matrix.innerIndexPtr()[place] == row, "its row");
    ++place;
  }
  CHECK(matrix.isCompressed() && matrix.nonZeros() == place && matrix.sum() == 0.0, "the matrix");
}

void TestSolution()
{
  for (const double spread : { 0.0, 3.0 })
  {
    Both both(MakeElements(), spread);
    const BlockSystem::Rows B = RightHandSide();
    BlockSystem::Rows X;
    const Eigen::VectorXd exact = Dense::Solve(both.dense, Flat(B));
    const auto left = [&](const BlockSystem::Rows& x)
    {
      const Eigen::VectorXd error = Flat(x) - exact;
      return error.dot(both.dense * error) / exact.dot(both.dense * exact);
    };
    const int steps = both.sparse.Solve(B, X, 1e-9, 1);
    CHECK(steps > 4 && steps < BlockSystem::LargestNumberOfSteps, "steps: " << steps);
    CHECK(left(X) < 1e-6, "what is left of the energy: " << left(X));
    BlockSystem::Rows rough;
    CHECK(both.sparse.Solve(B, rough, 0.1, 1) < steps, "less is asked for");
    CHECK(left(rough) > left(X) && left(rough) < 0.5, "and got: " << left(rough));
    both.sparse.SetZero();
    both.sparse.Add(both.pattern.PlaceOf(0, 0), false, Eigen::Matrix3d::Identity());
    BlockSystem::Rows first = BlockSystem::Rows::Zero(Unknowns, 3);
    first.row(0) = B.row(0);
    both.sparse.Solve(first, X, 1e-9, 1);
    CHECK_NEAR((X - first).norm(), 0.0, 1e-7, "the numbers before are gone");
  }
}

/// A block without an inverse, one of zeros, and a right-hand side of zeros: no number is infinite.
void TestSingular()
{
  const PairPattern pattern(3, {});
  BlockSystem system(pattern);
  const Eigen::Vector3d normal(1.0, 2.0, 2.0);
  system.Add(pattern.PlaceOf(0, 0), false, normal * normal.transpose());
  system.Add(pattern.PlaceOf(1, 1), false, 4.0 * Eigen::Matrix3d::Identity());
  BlockSystem::Rows B = BlockSystem::Rows::Zero(3, 3);
  BlockSystem::Rows X;
  CHECK(system.Solve(B, X, 0.01, 1) == 0 && X.isZero(0.0), "nothing to solve");
  B.row(0) = 9.0 * normal;
  B.row(1).setConstant(4.0);
  system.Solve(B, X, 1e-9, 1);
  CHECK(X.allFinite(), "finite");
  CHECK_NEAR(normal.dot(X.row(0).transpose()), 9.0, 1e-4, "in the direction that there is");
  CHECK_NEAR((X.row(1).array() - 1.0).abs().maxCoeff(), 0.0, 1e-4, "beside it");
}

/// A long chain, so that there is something to share out.
void TestThreads()
{
  constexpr int n = 20000;
  std::vector<PairPattern::Element> elements;
  for (int i = 0; i + 1 < n; ++i)
  {
    elements.push_back({ i, i + 1, -1, -1 });
  }
  const PairPattern pattern(n, elements);
  BlockSystem system(pattern);
  Meshes::Random random(4);
  BlockSystem::Rows B(n, 3);
  for (int i = 0; i < n; ++i)
  {
    const Eigen::Matrix3d root = random.Matrix();
    const Eigen::Matrix3d block = root * root.transpose();
    system.Add(pattern.PlaceOf(i, i), false, block + 0.1 * Eigen::Matrix3d::Identity());
    if (i + 1 < n)
    {
      system.Add(pattern.PlaceOf(i, i), false, block);
      system.Add(pattern.PlaceOf(i + 1, i + 1), false, block);
      system.Add(pattern.PlaceOf(i + 1, i), false, -block);
    }
    B.row(i) = random.InCube();
  }
  BlockSystem::Rows one;
  BlockSystem::Rows three;
  CHECK(system.Solve(B, one, 1e-6, 1) == system.Solve(B, three, 1e-6, 3), "the same steps");
  CHECK(one == three, "the same bits");
}
}

int main()
{
  TestPattern();
  TestSolution();
  TestSingular();
  TestThreads();
  return CheckResult();
}
