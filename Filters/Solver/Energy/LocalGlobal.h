// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The loop of local and global steps, its stop rules [stop], acceleration and history.
#ifndef SphericalStyle_LocalGlobal_h
#define SphericalStyle_LocalGlobal_h

#include "Callback.h"
#include "Frame.h"
#include "StyleEnergy.h"

namespace SphericalStyle
{
enum class StopRule
{
  Converged,      ///< estimated energy gap below the tolerance
  Thesis,         ///< Eq. 3.46 below 0.001
  FixedIterations ///< exactly maximumNumberOfIterations
};

struct LoopOptions
{
  StopRule stopRule = StopRule::Converged;
  double tolerance = 1e-4; ///< of Converged
  int maximumNumberOfIterations = 200;
  bool acceleration = true;
  int threads = 1;
};

/// State after an iteration; row 0 is the start.
struct HistoryRow
{
  int iteration = 0;
  EnergyTerms energy;
  double localChange = 0.0;  ///< of the energy, by the local step
  double globalChange = 0.0; ///< by the global step, and by acceleration where it was taken
  double residual = 0.0;     ///< Eq. 3.46 - 3.48; NaN at the start
  double gap = 0.0;          ///< estimated (E - E*) / (E_0 - E*); NaN while unknown
};

/// What the loop did. Energies are length^2.
struct LoopReport
{
  int iterations = 0;
  bool converged = false;
  bool aborted = false;
  double restEnergy = 0.0; ///< E_0: the unmoved model; with fixed points, of the start if more
  double negligible = 0.0; ///< energies below this are zero
  std::vector<HistoryRow> history;
};

/// Steps that raised E by more than rounding: 1e-12 of E or of E_0, or what is negligible.
struct Rises
{
  int iterations = 0;
  int localSteps = 0;
  int globalSteps = 0;
};

Rises CountRises(const LoopReport& report);

/// The same report with its energies taken out of the frame.
LoopReport OutOfFrame(const Frame& frame, LoopReport report);

/// An energy E(Q, R) with two exact steps. R (and whatever else the local step finds) is held here.
class TwoStepEnergy
{
public:
  virtual ~TwoStepEnergy() = default;
  /// [local]: R := argmin E(Q, .), or nearer to it. @return the change of E, <= 0
  virtual double FitLocal(const Points& Q) = 0;
  /// [global]: Q := argmin E(., R).
  virtual void SolveGlobal(Points& Q) = 0;
  virtual EnergyTerms Evaluate(const Points& Q) const = 0;
  /// For a local step that goes on from what it found last: remembers that, and goes back to it. A
  /// local step that depends on Q alone needs neither.
  virtual void KeepLocal() {}
  virtual void RestoreLocal() {}
};

/// Estimated energy gap (E_k - E*) / (E_0 - E*) [stop], E* extrapolated from the decay of E.
///
/// The energies at iterations k / 2.25, k / 1.5 and k (counted from 1 at the start) are taken as
/// three terms of a geometric series: exact when the gap decays by a power of k, as plain
/// local/global steps do, and above the truth when it decays by a factor per iteration, as
/// accelerated ones do. Multiplied by 3 for what the first few iterations hide.
/// @param energies  E after the start and after each iteration @param restEnergy  E_0
/// @return the gap; NaN before two iterations, infinite while the decay speeds up
double EstimateGap(const std::vector<double>& energies, double restEnergy);

/// Lowers E from (Q, R) until the stop rule is met; E rises in no step (both steps exact).
/// @param rest  rest positions, for Eq. 3.48 @param restEnergy  E_0
/// @param negligible  energies below this are zero: nothing to do
/// @throw SolverError where the energy is infinite or NaN
LoopReport RunLocalGlobal(TwoStepEnergy& problem, const Points& rest, double restEnergy,
  double negligible, Points& Q, const LoopOptions& options, const Callback& callback);
} // namespace SphericalStyle

#endif
