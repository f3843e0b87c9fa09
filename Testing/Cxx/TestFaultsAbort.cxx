// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Every filter aborted at every progress event: no error, nothing half done that looks whole, and
/// the next execution gives what one without an abort gives, to the bit.
#include "FaultTesting.h"

using namespace FilterTesting;

namespace
{
struct Aborter
{
  int at = -1; ///< the event that aborts, -1 for none
  int events = 0;
  int after = 0; ///< events after the abort
};

void CountAndAbort(vtkObject* caller, unsigned long, void* data, void*)
{
  auto* aborter = static_cast<Aborter*>(data);
  aborter->after += aborter->at >= 0 && aborter->events > aborter->at;
  if (aborter->events++ == aborter->at)
  {
    vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
  }
}

/// Executes, with an abort at the event `at`.
Aborter Execute(vtkAlgorithm* filter, int at)
{
  Aborter aborter;
  aborter.at = at;
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&aborter);
  command->SetCallback(CountAndAbort);
  const unsigned long tag = filter->AddObserver(vtkCommand::ProgressEvent, command);
  filter->Modified();
  filter->Update();
  filter->RemoveObserver(tag);
  filter->SetAbortExecute(0); // VTK 9.1 does that by itself
  return aborter;
}

void CheckAborted(Checker& check, const Subject& subject, vtkPolyDataAlgorithm* filter,
  vtkPolyData* input, const std::vector<std::string>& errors)
{
  vtkPolyData* output = filter->GetOutput();
  check(errors.empty(), "an abort should be no error" + Joined(errors));
  if (subject.deforms && !IsEmpty(filter))
  {
    check(output->GetNumberOfPoints() == input->GetNumberOfPoints() && SameCells(output, input) &&
        AllFinite(output->GetPoints()->GetData()),
      "what is there should be finite and have all points and cells");
  }
}

/// @param first  event, and then every stride-th
void AbortAtEvents(
  Checker& check, const Subject& subject, vtkPolyData* input, int first, int stride)
{
  check.About(subject.name);
  std::vector<std::string> errors; // outlives what writes to it
  std::vector<std::string> warnings;
  const auto whole = subject.make();
  Watch(whole, vtkCommand::WarningEvent, warnings);
  whole->SetInputData(input);
  const int events = Execute(whole, -1).events;
  const auto expected = AllOutputs(whole);
  check(events > 0, "there should be progress");

  const auto kept = subject.make(); // aborted again and again
  Watch(kept, vtkCommand::ErrorEvent, errors);
  Watch(kept, vtkCommand::WarningEvent, warnings);
  kept->SetInputData(input);
  for (int k = first; k < events; k += stride)
  {
    check.About(subject.name + ", aborted at event " + Text(k) + " of " + Text(events));
    const auto fresh = subject.make();
    Watch(fresh, vtkCommand::ErrorEvent, errors);
    Watch(fresh, vtkCommand::WarningEvent, warnings);
    fresh->SetInputData(input);
    for (const auto& filter : { fresh, kept })
    {
      const Aborter aborter = Execute(filter, k);
      CheckAborted(check, subject, filter, input, errors);
      check(
        aborter.after <= 3, "it should end soon; there were more events: " + Text(aborter.after));
      Execute(filter, -1);
      check(SameOutputs(AllOutputs(filter), expected),
        "the next execution should give what one without an abort gives");
    }
  }
}
}

int TestFaultsAbort(int argc, char* argv[])
{
  Checker check;
  const Surface input = MakeBumpyBall(16, 9);
  const int stride = IsComplete(argc, argv) ? 1 : 3;
  int number = 0;
  for (const Subject& subject : Subjects())
  {
    AbortAtEvents(check, subject, input, number++ % stride, stride);
  }
  return check.Result();
}
