// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "LocalGlobal.h"

#include "AndersonAcceleration.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace SphericalStyle
{
namespace
{
constexpr double Unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double ThesisTolerance = 0.001; // Eq. 3.46
constexpr int AndersonWindow = 5;

double LargestSquaredStep(const Points& a, const Points& b)
{
  return a.rows() > 0 ? (a - b).rowwise().squaredNorm().maxCoeff() : 0.0;
}

/// Eq. 3.46 - 3.48; 0/0, nothing moves, is 0.
double Residual(const Points& Q, const Points& before, const Points& rest)
{
  const double step = LargestSquaredStep(Q, before);
  return step > 0.0 ? step / LargestSquaredStep(Q, rest) : 0.0;
}

bool Stops(const LoopOptions& options, const HistoryRow& row)
{
  switch (options.stopRule)
  {
    case StopRule::Converged:
      return row.gap < options.tolerance;
    case StopRule::Thesis:
      return row.residual < ThesisTolerance;
    case StopRule::FixedIterations:
      break;
  }
  return false;
}
}

double EstimateGap(const std::vector<double>& energies, double restEnergy)
{
  constexpr double Safety = 3.0;
  constexpr double Ratio = 1.5;
  const double count = static_cast<double>(energies.size());
  if (count < 3.0)
  {
    return Unknown;
  }
  // Between two iterations E is taken linear in log k.
  const auto energyAt = [&energies](double x)
  {
    const std::size_t i = static_cast<std::size_t>(x);
    const double weight = i < energies.size() ? std::log(x / i) / std::log((i + 1.0) / i) : 0.0;
    return weight > 0.0 ? (1.0 - weight) * energies[i - 1] + weight * energies[i] : energies[i - 1];
  };
  const double middle = energyAt(count / Ratio);
  const double last = energies.back();
  const double earlier = energyAt(count / (Ratio * Ratio)) - middle;
  const double later = middle - last;
  if (!(later > 0.0))
  {
    return 0.0; // nothing moved any more
  }
  if (!(earlier > later))
  {
    return std::numeric_limits<double>::infinity();
  }
  const double above = Safety * later * later / (earlier - later); // E - E*
  return above / (restEnergy - last + above);
}

LoopReport RunLocalGlobal(TwoStepEnergy& problem, const Points& rest, double restEnergy,
  double negligible, Points& Q, const LoopOptions& options, const Callback& callback)
{
  LoopReport report;
  report.restEnergy = restEnergy;
  HistoryRow start;
  start.energy = problem.Evaluate(Q);
  start.globalChange = start.energy.Total() - restEnergy;
  start.residual = Unknown;
  start.gap = Unknown;
  const bool nothingToGain = restEnergy <= negligible; // 0/0 is convergence
  if (nothingToGain)
  {
    start.gap = start.residual = 0.0;
  }
  report.history.push_back(start);
  report.converged = Stops(options, start);

  AndersonAcceleration anderson(AndersonWindow);
  std::vector<double> energies = { start.energy.Total() };
  bool fitted = false; // R is already the best for Q
  Points before;
  Points image;
  Points mixed;
  while (!report.converged && report.iterations < options.maximumNumberOfIterations)
  {
    HistoryRow row;
    row.iteration = ++report.iterations;
    before = Q;
    row.localChange = fitted ? 0.0 : problem.FitLocal(Q); // [local]
    const double bound = energies.back() + row.localChange;
    image = Q;
    problem.SolveGlobal(image); // [global]
    fitted = options.acceleration && anderson.Mix(Q, image, mixed);
    if (fitted)
    {
      problem.FitLocal(mixed);
      row.energy = problem.Evaluate(mixed);
      if (row.energy.Total() <= bound)
      {
        Q.swap(mixed);
      }
      else // the plain step is safe; the rotations follow it
      {
        anderson.Reset();
        Q.swap(image);
        problem.FitLocal(Q);
        row.energy = problem.Evaluate(Q);
      }
    }
    else
    {
      Q.swap(image);
      row.energy = problem.Evaluate(Q);
    }
    row.globalChange = row.energy.Total() - bound;
    row.residual = Residual(Q, before, rest);
    energies.push_back(row.energy.Total());
    row.gap = nothingToGain ? 0.0 : EstimateGap(energies, restEnergy);
    report.history.push_back(row);
    report.converged = Stops(options, row);
    const double change =
      restEnergy > 0.0 ? (row.localChange + row.globalChange) / restEnergy : 0.0;
    if (callback && !callback(row.iteration, change))
    {
      report.aborted = true;
      break;
    }
  }
  if (options.stopRule == StopRule::FixedIterations)
  {
    report.converged = !report.aborted;
  }
  return report;
}
} // namespace SphericalStyle
