// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Filters in several threads at once, each with a pipeline of its own: every one gives the bits
/// that it gives alone.
#include "FaultTesting.h"

#include <thread>

using namespace FilterTesting;

namespace
{
using Outputs = std::vector<vtkSmartPointer<vtkDataObject>>;

Outputs Run(const Subject& subject, vtkPolyData* input)
{
  std::vector<std::string> messages;
  const auto filter = subject.make();
  Watch(filter, vtkCommand::WarningEvent, messages);
  filter->SetInputData(input);
  filter->Update();
  return AllOutputs(filter);
}

Surface Copy(vtkPolyData* surface)
{
  auto copy = Surface::New();
  copy->DeepCopy(surface);
  return copy;
}
}

int TestFaultsThreads(int, char*[])
{
  Checker check;
  const Surface input = MakeBumpyBall(48, 50); // enough points for threads inside the filters
  const std::vector<Subject> subjects = Subjects();
  std::vector<Outputs> alone;
  for (const Subject& subject : subjects)
  {
    alone.push_back(Run(subject, input));
  }

  // The same filters at the same time, then others: the second thread runs down the list.
  const std::size_t n = subjects.size();
  std::vector<Outputs> beside[3];
  std::vector<std::thread> threads;
  for (int t = 0; t < 3; ++t)
  {
    beside[t].resize(n);
    threads.emplace_back(
      [&, t, own = Copy(input)]
      {
        for (std::size_t k = 0; k < n; ++k)
        {
          const std::size_t which = t < 2 ? k : n - 1 - k;
          beside[t][which] = Run(subjects[which], own);
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (std::size_t k = 0; k < n; ++k)
  {
    check.About(subjects[k].name);
    for (const auto& outputs : beside)
    {
      check(
        SameOutputs(outputs[k], alone[k]), "beside others it should give the bits it gives alone");
    }
  }
  return check.Result();
}
