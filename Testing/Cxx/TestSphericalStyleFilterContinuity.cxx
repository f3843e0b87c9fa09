// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// The result is continuous in Roundness, also where the base turns inside out: between two values
/// that come closer and closer, the largest move of a point goes to 0.
#include "FilterTesting.h"

#include <algorithm>
#include <array>
#include <vector>

using namespace FilterTesting;

namespace
{
struct Result
{
  double roundness;
  std::vector<Vector> points;
};

/// The preset Puffy, or Toy beyond its Roundness.
struct Case
{
  const char* name;
  double normalBlend, detailSize;
  int normalRadius;
};

Result At(vtkSphericalStyleFilter* style, double roundness)
{
  style->SetRoundness(roundness);
  style->Update();
  Result result{ roundness, {} };
  for (vtkIdType i = 0; i < style->GetOutput()->GetNumberOfPoints(); ++i)
  {
    result.points.push_back(PointOf(style->GetOutput(), i));
  }
  return result;
}

/// The largest move of a point.
double Move(const Result& a, const Result& b)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < a.points.size(); ++i)
  {
    const Vector& x = a.points[i];
    const Vector& y = b.points[i];
    largest = std::max(largest, std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]));
  }
  return largest;
}

/// The move that is left when the interval is halved to 1e-6, always into the half that moves more.
double LastMove(vtkSphericalStyleFilter* style, Result a, Result b)
{
  while (b.roundness - a.roundness > 1e-6)
  {
    Result middle = At(style, 0.5 * (a.roundness + b.roundness));
    (Move(a, middle) > Move(middle, b) ? b : a) = std::move(middle);
  }
  return Move(a, b);
}

void TestContinuity(Checker& check, vtkPolyData* model, const Case& set)
{
  vtkNew<vtkSphericalStyleFilter> style;
  style->SetInputData(model);
  style->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  style->SetNormalBlend(set.normalBlend);
  style->SetDetailSize(set.detailSize);
  style->SetNormalRadius(set.normalRadius);
  style->SetRefineLongEdgesToOff();
  std::vector<Result> results;
  for (int step = 1; step < 40; ++step)
  {
    results.push_back(At(style, 0.1 * step));
  }
  std::vector<std::pair<double, std::size_t>> moves;
  for (std::size_t i = 0; i + 1 < results.size(); ++i)
  {
    moves.emplace_back(Move(results[i], results[i + 1]), i);
  }
  std::sort(moves.rbegin(), moves.rend());
  double largest = 0.0;
  for (int k = 0; k < 8; ++k)
  {
    const std::size_t i = moves[k].second;
    largest = std::max(largest, LastMove(style, results[i], results[i + 1]));
  }
  const double diagonal = model->GetLength();
  std::cout << set.name << ": of the diagonal, a tenth of Roundness moves a point by at most "
            << moves[0].first / diagonal << ", a millionth by " << largest / diagonal << "\n";
  check.About(set.name);
  check.AtMost(largest / diagonal, 1e-5, "what a millionth of Roundness moves a point");
}
}

int TestSphericalStyleFilterContinuity(int argc, char* argv[])
{
  Checker check;
  const Surface creature = ReadModel(argc, argv, "creature.vtp");
  TestContinuity(
    check, creature, { "Puffy", 1.0, 0.03, vtkSphericalStyleFilter::WHOLE_MODEL_RADIUS });
  TestContinuity(check, creature, { "Toy", 0.6, 0.06, vtkSphericalStyleFilter::OWN_THICKNESS });
  return check.Result();
}
