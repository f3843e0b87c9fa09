// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "LocalGlobal.h"

#include "AndersonAcceleration.h"
#include "Parallel.h"

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

/// Largest value of |a_i - b_i|^2.
double LargestSquaredStep(const Points& a, const Points& b, int threads)
{
  std::vector<double> largest(NumberOfBlocks(static_cast<int>(a.rows())), 0.0);
  ParallelBlocks(static_cast<int>(a.rows()), threads,
    [&](int block, int begin, int end)
    {
      const Eigen::Index size = end - begin;
      largest[block] =
        (a.middleRows(begin, size) - b.middleRows(begin, size)).rowwise().squaredNorm().maxCoeff();
    });
  return largest.empty() ? 0.0 : *std::max_element(largest.begin(), largest.end());
}

/// Eq. 3.46 - 3.48; 0/0, nothing moves, is 0.
double Residual(const Points& Q, const Points& before, const Points& rest, int threads)
{
  const double step = LargestSquaredStep(Q, before, threads);
  return step > 0.0 ? step / LargestSquaredStep(Q, rest, threads) : 0.0;
}

/// @throw SolverError if an energy is no number
void RequireInRange(double energy)
{
  if (!std::isfinite(energy))
  {
    throw SolverError("the energy is beyond the range of double precision; make the roundness or "
                      "weight, the radius and the distance to the center smaller");
  }
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

/// E_k - E* from the first `size` energies, times a safety factor; see EstimateGap.
double EstimateRest(const std::vector<double>& energies, std::size_t size)
{
  constexpr double Safety = 3.0;
  constexpr double Ratio = 1.5;
  // Between two iterations E is taken linear in log k.
  const auto energyAt = [&energies](double x)
  {
    const auto i = static_cast<std::size_t>(x);
    const double weight = std::log(x / i) / std::log((i + 1.0) / i);
    return weight > 0.0 ? (1.0 - weight) * energies[i - 1] + weight * energies[i] : energies[i - 1];
  };
  const auto count = static_cast<double>(size);
  const double middle = energyAt(count / Ratio);
  const double earlier = energyAt(count / (Ratio * Ratio)) - middle;
  const double later = middle - energies[size - 1];
  if (!(later > 1e-14 * std::abs(energies[size - 1])))
  {
    return 0.0; // nothing moved any more, but for rounding
  }
  return earlier > later ? Safety * later * later / (earlier - later)
                         : std::numeric_limits<double>::infinity();
}
}

LoopReport OutOfFrame(const Frame& frame, LoopReport report)
{
  report.restEnergy = frame.EnergyOutOf(report.restEnergy);
  report.negligible = frame.EnergyOutOf(report.negligible);
  for (HistoryRow& row : report.history)
  {
    row.energy.rigid = frame.EnergyOutOf(row.energy.rigid);
    row.energy.spherical = frame.EnergyOutOf(row.energy.spherical);
    row.localChange = frame.EnergyOutOf(row.localChange);
    row.globalChange = frame.EnergyOutOf(row.globalChange);
  }
  return report;
}

Rises CountRises(const LoopReport& report)
{
  Rises rises;
  const std::vector<HistoryRow>& rows = report.history;
  for (std::size_t k = 1; k < rows.size(); ++k)
  {
    const double before = rows[k - 1].energy.Total();
    const double rounding =
      std::max(1e-12 * std::max(report.restEnergy, std::abs(before)), report.negligible);
    rises.iterations += rows[k].energy.Total() - before > rounding ? 1 : 0;
    rises.localSteps += rows[k].localChange > rounding ? 1 : 0;
    rises.globalSteps += rows[k].globalChange > rounding ? 1 : 0;
  }
  return rises;
}

double EstimateGap(const std::vector<double>& energies, double restEnergy)
{
  const std::size_t size = energies.size();
  if (size < 3)
  {
    return Unknown;
  }
  double above = EstimateRest(energies, size); // E_k - E*
  if (size > 3)
  {
    above = std::max(above, EstimateRest(energies, size - 1));
  }
  if (std::isinf(above) || above == 0.0)
  {
    return above;
  }
  const double whole = restEnergy - energies.back() + above; // E_0 - E*
  return whole > 0.0 ? above / whole : Unknown;
}

LoopReport RunLocalGlobal(TwoStepEnergy& problem, const Points& rest, double restEnergy,
  double negligible, Points& Q, const LoopOptions& options, const Callback& callback)
{
  LoopReport report;
  report.restEnergy = restEnergy;
  report.negligible = negligible;
  HistoryRow start;
  start.energy = problem.Evaluate(Q);
  RequireInRange(restEnergy);
  RequireInRange(start.energy.Total());
  start.globalChange = start.energy.Total() - restEnergy;
  const bool nothingToGain = restEnergy <= negligible; // 0/0 is convergence
  start.gap = start.residual = nothingToGain ? 0.0 : Unknown;
  report.history.push_back(start);
  report.converged = Stops(options, start);

  AndersonAcceleration anderson(AndersonWindow, options.threads);
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
      problem.KeepLocal();
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
        problem.RestoreLocal();
        problem.FitLocal(Q);
        row.energy = problem.Evaluate(Q);
      }
    }
    else
    {
      Q.swap(image);
      row.energy = problem.Evaluate(Q);
    }
    RequireInRange(row.energy.Total());
    row.globalChange = row.energy.Total() - bound;
    row.residual = Residual(Q, before, rest, options.threads);
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
