// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Every filter gives back what it takes: no object outlives it, and executions, whole,
/// aborted or refused, do not make the process grow.
#include "FaultTesting.h"

#include "vtkWeakPointer.h"

#include <cstddef>

#if defined(SANITIZED)
// Of sanitizer/allocator_interface.h, which Clang installs and GCC does not.
extern "C" std::size_t __sanitizer_get_current_allocated_bytes(); // NOLINT(*-reserved-identifier)
#define COUNTS_BYTES
#elif defined(__GLIBC__) && __GLIBC_PREREQ(2, 33) // mallinfo2
#include <malloc.h>
#define COUNTS_BYTES
#endif

using namespace FilterTesting;

namespace
{
/// Bytes that are taken from malloc and not given back.
std::size_t BytesInUse()
{
#if defined(SANITIZED)
  return __sanitizer_get_current_allocated_bytes();
#elif defined(COUNTS_BYTES)
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
#else
  return 0;
#endif
}

void NoObjectOutlives(Checker& check, const Subject& subject)
{
  const Surface input = MakeBumpyBall(16, 9);
  AddArrays(input);
  const std::vector<vtkObjectBase*> shared = { input, input->GetPoints(), input->GetPolys(),
    input->GetPointData()->GetArray("vectors") };
  std::vector<int> before;
  for (vtkObjectBase* object : shared)
  {
    before.push_back(object->GetReferenceCount());
  }
  std::vector<vtkWeakPointer<vtkObject>> made;
  {
    std::vector<std::string> messages;
    const auto filter = subject.make();
    Watch(filter, vtkCommand::WarningEvent, messages);
    filter->SetInputData(input);
    filter->Update();
    made.emplace_back(filter);
    made.emplace_back(filter->GetExecutive());
    for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
    {
      made.emplace_back(filter->GetOutputDataObject(port));
    }
    if (filter->GetOutput()->GetPoints() && filter->GetOutput()->GetPoints() != input->GetPoints())
    {
      made.emplace_back(filter->GetOutput()->GetPoints());
    }
  }
  for (const vtkWeakPointer<vtkObject>& object : made)
  {
    check(!object, "an object outlives the filter");
  }
  for (std::size_t k = 0; k < shared.size(); ++k)
  {
    check(shared[k]->GetReferenceCount() == before[k],
      std::string("something of the filter still holds on to a ") + shared[k]->GetClassName());
  }
}

/// What an execution can be like.
enum class Execution
{
  Whole,
  Aborted,
  Refused
};

void Execute(const Subject& subject, vtkPolyDataAlgorithm* filter, Execution execution)
{
  const Surface input = MakeBumpyBall(16, 9);
  if (execution == Execution::Refused && subject.refuses)
  {
    input->GetPoints()->SetPoint(3, HUGE_VAL, 0.0, 0.0);
  }
  filter->SetInputData(input);
  unsigned long tag = 0;
  if (execution == Execution::Aborted)
  {
    vtkNew<vtkCallbackCommand> command;
    command->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
      { vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1); });
    tag = filter->AddObserver(vtkCommand::ProgressEvent, command);
  }
  filter->Update();
  filter->RemoveObserver(tag);
  filter->SetAbortExecute(0);
}

/// @param keep  one filter for all executions, or one for each
void DoesNotGrow(Checker& check, const Subject& subject, Execution execution, bool keep)
{
  std::vector<std::string> messages;
  messages.reserve(4096);
  const auto kept = subject.make();
  const auto executions = [&](int n)
  {
    for (int k = 0; k < n; ++k)
    {
      const auto filter = keep ? kept : subject.make();
      vtkNew<vtkCallbackCommand> ignore; // prints nothing
      filter->AddObserver(vtkCommand::WarningEvent, ignore);
      filter->AddObserver(vtkCommand::ErrorEvent, ignore);
      filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, ignore);
      Execute(subject, filter, execution);
      filter->RemoveAllObservers();
      filter->GetExecutive()->RemoveAllObservers();
    }
  };
  // What is made once, and what malloc keeps back for the next one, comes and goes; a leak grows by
  // its size with every execution.
  const int executionsAtOnce = subject.isSlow ? 4 : 15;
  constexpr std::ptrdiff_t smallestLeak = 16;
  std::ptrdiff_t growth = 0;
  for (int attempt = 0; attempt < 6; ++attempt)
  {
    const std::size_t before = BytesInUse();
    executions(executionsAtOnce);
    growth = static_cast<std::ptrdiff_t>(BytesInUse() - before);
    if (growth < executionsAtOnce * smallestLeak)
    {
      return;
    }
  }
  check(false, "each execution takes bytes: " + Text(growth / executionsAtOnce));
}

/// ReleaseCache gives back what an execution keeps, and nothing else changes.
void ReleasesItsCache(Checker& check)
{
  check.About("ReleaseCache");
  const Surface input = MakeBumpyBall(64, 33);
  vtkNew<vtkSphericalStyleFilter> filter;
  filter->SetInputData(input);
  filter->SetDetailSize(0.05);
  filter->Update();
  const auto first = AllOutputs(filter);
  const std::size_t before = BytesInUse();
  filter->ReleaseCache();
  [[maybe_unused]] const auto freed = static_cast<std::ptrdiff_t>(before - BytesInUse());
#ifdef COUNTS_BYTES
  const auto points = static_cast<std::ptrdiff_t>(input->GetNumberOfPoints());
  check(
    freed > 500 * points, "it should free more than " + Text(freed / points) + " bytes a point");
#endif
  check(SameOutputs(AllOutputs(filter), first), "outputs should stay");
  check(std::string(filter->GetCenterPosition()).empty(), "the model should be gone");
  filter->Modified();
  filter->Update();
  check(SameOutputs(AllOutputs(filter), first), "the next execution should give the same bits");
}
}

int TestFaultsLeaks(int, char*[])
{
  Checker check;
  ReleasesItsCache(check);
  for (const Subject& subject : Subjects())
  {
    check.About(subject.name);
    NoObjectOutlives(check, subject);
    for (const bool keep : { true, false })
    {
      const std::string which = subject.name + (keep ? ", one filter, " : ", a filter each, ");
      check.About(which + "whole");
      DoesNotGrow(check, subject, Execution::Whole, keep);
      check.About(which + "aborted");
      DoesNotGrow(check, subject, Execution::Aborted, keep);
      check.About(which + "refused");
      DoesNotGrow(check, subject, Execution::Refused, keep);
    }
  }
  return check.Result();
}
