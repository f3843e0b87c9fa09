// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFoldGuard.h"

#ifdef SPHERICALSTYLE_WITH_CGAL
#include "SelfIntersections.h"
#endif
#include "Stopwatch.h"
#include "vtkFilterSupport.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkTable.h"

#include <stdexcept>

using namespace SphericalStyle;

namespace
{
IntersectionSearch Search()
{
#ifdef SPHERICALSTYLE_WITH_CGAL
  return [](const TriangleMesh& mesh) { return SelfIntersections(mesh); };
#else
  throw std::invalid_argument("AvoidSelfIntersections needs CGAL, and this library was built "
                              "without it: switch it off");
#endif
}

/// lambda of each point.
Eigen::VectorXd Roundness(const StyleOptions& options, Eigen::Index n)
{
  const Eigen::VectorXd factors = options.Factors();
  return factors.size() > 0 ? Eigen::VectorXd(options.lambda * factors)
                            : Eigen::VectorXd::Constant(n, options.lambda);
}

MethodOptions WithShares(MethodOptions options, const Eigen::VectorXd& shares)
{
  if ((shares.array() < 1.0).any()) // or else the options as they are: the same bits
  {
    options.roundnessFactors = options.roundnessFactors.size() > 0
      ? Eigen::VectorXd(options.roundnessFactors.cwiseProduct(shares))
      : shares;
  }
  return options;
}

constexpr double LittleLeft = 0.3; // of Roundness

void AddBeforeAfter(vtkFieldData* data, const char* name, int before, int after)
{
  vtkNew<vtkIntArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(2);
  array->SetComponentName(0, "Before");
  array->SetComponentName(1, "After");
  array->InsertNextTuple2(before, after);
  data->AddArray(array);
}

std::string Percent(double share)
{
  const int percent = static_cast<int>(100.0 * share);
  return (percent > 0 ? std::to_string(percent) : std::string("less than 1")) + " %";
}
}

namespace vtkFoldGuard
{
Result Solve(SphericalStyleMethod& solver, const MethodOptions& wanted,
  const std::shared_ptr<const TriangleMesh>& rest, bool singlePrecision, const Finish& finish,
  const Callback& callback)
{
  const IntersectionSearch search = Search();
  const Stopwatch watch;
  Result result;
  solver.SetMesh(rest);
  int iterations = 0;
  const Callback onward = [&](int, double change) { return callback(++iterations, change); };
  const ShareSolve solve = [&](const Eigen::VectorXd& shares)
  {
    const MethodOptions shared = WithShares(wanted, shares);
    result.Style = solver.Solve(shared, onward);
    result.Roundness = Roundness(shared, shares.size());
    // Closed forms have no iteration, and the search that comes takes longer than one.
    const bool goOn = !result.Style.loop.aborted && onward(0, 0.0);
    return goOn ? finish(solver.GetPositions()) : Points(0, 3);
  };
  FoldGuardOptions guard;
  guard.singlePrecision = singlePrecision;
  guard.threads = wanted.threads;
  result.Guard = SolveWithoutFolds(*rest, guard, search, solve);
  result.Positions = result.Guard.aborted ? finish(solver.GetPositions()) : result.Guard.positions;
  result.Seconds = watch.Seconds();
  return result;
}

std::string Remark(const Result& result)
{
  if (!result.HasCounted())
  {
    return {};
  }
  if (result.Guard.blended)
  {
    return "AvoidSelfIntersections: less roundness alone did not remove all folds; the result was "
           "moved back toward the input where they were, or all over";
  }
  if (result.Guard.meanShare >= LittleLeft)
  {
    return {};
  }
  return "AvoidSelfIntersections leaves " + Percent(result.Guard.meanShare) +
    " of Roundness, in the mean over the surface, since the model folds where it becomes "
    "rounder (RemainingRoundness). Another preset may fold less";
}

std::string Summary(const Result& result)
{
  if (!result.HasCounted())
  {
    return {};
  }
  const FoldGuardReport& guard = result.Guard;
  if (guard.before.turnedOver + guard.before.newPairs == 0)
  {
    return "nothing turned over, and nothing newly ran through itself";
  }
  std::string text = vtkFilterSupport::Count(guard.before.turnedOver, "triangle") +
    " turned over and " + vtkFilterSupport::Count(guard.before.newPairs, "pair") +
    " newly ran through each other; now none. ";
  if (guard.repaired > 0)
  {
    text += vtkFilterSupport::Count(guard.repaired, "point") + " repaired. ";
  }
  return text + (guard.blended ? "Moved back toward the input where that was not enough. " : "") +
    Percent(guard.meanShare) + " of Roundness left, in the mean over the surface";
}

void Fill(vtkTable* table, const Result& result)
{
  if (!result.HasCounted())
  {
    return;
  }
  const FoldGuardReport& guard = result.Guard;
  vtkFieldData* data = table->GetFieldData();
  AddBeforeAfter(data, "TurnedOver", guard.before.turnedOver, guard.after.turnedOver);
  AddBeforeAfter(data, "NewIntersectingPairs", guard.before.newPairs, guard.after.newPairs);
  vtkFilterSupport::AddCount(data, "GuardSolves", guard.solves);
  vtkFilterSupport::AddCount(data, "GuardRepairedPoints", guard.repaired);
  vtkNew<vtkDoubleArray> seconds;
  seconds->SetName("GuardSeconds");
  seconds->InsertNextValue(result.Seconds);
  data->AddArray(seconds);
}
}
