// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Whoever watches the progress of a filter may do to it what he likes: ask it for an update, print
/// it, change its properties, free its cache, take its input away. The execution ends well, with
/// what it began with, and the next gives what that of a new filter gives, to the bit.
#include "FaultTesting.h"

#include <sstream>

using namespace FilterTesting;

namespace
{
using Interference = std::function<void(vtkPolyDataAlgorithm*)>;

/// Does something at one progress event.
struct Meddler
{
  int at;
  const Interference& interfere;
  int events = 0;
};

void Meddle(vtkObject* caller, unsigned long, void* data, void*)
{
  auto* meddler = static_cast<Meddler*>(data);
  if (meddler->events++ == meddler->at)
  {
    meddler->interfere(vtkPolyDataAlgorithm::SafeDownCast(caller));
  }
}

/// Executes a surface that nobody else holds. @return events
int Execute(vtkPolyDataAlgorithm* filter, int at, const Interference& interfere)
{
  Meddler meddler = { at, interfere };
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&meddler);
  command->SetCallback(Meddle);
  const unsigned long tag = filter->AddObserver(vtkCommand::ProgressEvent, command);
  filter->SetInputData(MakeBumpyBall(16, 9));
  filter->Update();
  filter->RemoveObserver(tag);
  return meddler.events;
}

struct Disturbance
{
  std::string name;
  Interference interfere;
  Interference restore; ///< or none: the next execution gets its input anyhow
};

void OtherProperties(vtkPolyDataAlgorithm* filter)
{
  if (auto* main = vtkSphericalStyleFilter::SafeDownCast(filter))
  {
    main->SetGenerateRotation(!main->GetGenerateRotation());
    main->SetReproduceThesis(!main->GetReproduceThesis());
  }
  if (auto* thesis = vtkThesisStyleFilter::SafeDownCast(filter))
  {
    thesis->SetGenerateCellEnergy(!thesis->GetGenerateCellEnergy());
  }
  if (auto* nonlinear = vtkNonlinearStyleFilter::SafeDownCast(filter))
  {
    nonlinear->SetGenerateRotation(!nonlinear->GetGenerateRotation());
    nonlinear->SetGenerateCellEnergy(!nonlinear->GetGenerateCellEnergy());
    nonlinear->SetGenerateAuxiliaryScale(!nonlinear->GetGenerateAuxiliaryScale());
  }
}

std::vector<Disturbance> Disturbances()
{
  return { { "asked for an update", [](vtkPolyDataAlgorithm* f) { f->Update(); }, {} },
    { "printed",
      [](vtkPolyDataAlgorithm* f)
      {
        std::ostringstream text;
        f->Print(text);
      },
      {} },
    { "given another input",
      [](vtkPolyDataAlgorithm* f) {
        f->SetInputData(MakeEllipsoid({ 1, 2, 3 }));
      },
      {} },
    { "without an input", [](vtkPolyDataAlgorithm* f) { f->RemoveAllInputs(); }, {} },
    { "without its cache",
      [](vtkPolyDataAlgorithm* f)
      {
        if (auto* main = vtkSphericalStyleFilter::SafeDownCast(f))
        {
          main->ReleaseCache();
        }
      },
      {} },
    { "with other properties", OtherProperties, OtherProperties } };
}

void MeddleAtEveryEvent(Checker& check, const Subject& subject)
{
  check.About(subject.name);
  std::vector<std::string> said; // outlives what writes to it
  std::vector<std::string> ofExecutive;
  const auto make = [&]
  {
    auto filter = subject.make();
    Watch(filter, vtkCommand::WarningEvent, said);
    Watch(filter, vtkCommand::ErrorEvent, said);
    Watch(filter->GetExecutive(), vtkCommand::ErrorEvent, ofExecutive); // of updates in updates
    return filter;
  };
  const auto nothing = [](vtkPolyDataAlgorithm*) {};
  const auto undisturbed = make();
  const int events = Execute(undisturbed, -1, nothing);
  const auto expected = AllOutputs(undisturbed);
  const std::size_t remarks = said.size();
  // Many events are those of a loop, one like the other: each of them then meets two disturbances.
  const int stride = subject.isSlow ? 7 : events > 8 ? 3 : 1;
  int number = 0;
  for (const auto& [name, interfere, restore] : Disturbances())
  {
    for (int k = number++ % stride; k < events; k += stride)
    {
      check.About(subject.name + ", " + name + " at event " + Text(k) + " of " + Text(events));
      const auto filter = make();
      Execute(filter, k, interfere);
      vtkPolyData* output = filter->GetOutput();
      check(output->GetNumberOfPoints() == 0 || AllFinite(output->GetPoints()->GetData()),
        "points should be finite");
      if (restore)
      {
        restore(filter);
      }
      said.clear();
      Execute(filter, -1, nothing);
      check(said.size() == remarks, "the next should say what a new one says" + Joined(said));
      check(SameOutputs(AllOutputs(filter), expected), "the next should give what a new one gives");
    }
  }
}
}

int TestFaultsObservers(int, char*[])
{
  Checker check;
  for (const Subject& subject : Subjects())
  {
    MeddleAtEveryEvent(check, subject);
  }
  return check.Result();
}
