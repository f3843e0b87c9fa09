// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Filters start no more threads than those around them allow: the property, vtkSMPTools, the
/// environment, or the launcher of several processes.
#include "FaultTesting.h"

#include "vtkSMPTools.h"

#include <chrono>
#include <cstdlib>
#include <set>
#include <thread>
#ifdef __linux__
#include <filesystem>
#endif

using namespace FilterTesting;

namespace
{
#ifdef __linux__
using Threads = std::set<std::string>;

Threads ThreadsOfProcess()
{
  Threads all;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task"))
  {
    all.insert(entry.path().filename());
  }
  return all;
}

/// VTK starts threads of its own at its first loop and keeps them: Debian's plain VTK uses oneTBB.
void StartThreadsOfVTK()
{
  const auto wait = [](vtkIdType, vtkIdType)
  { std::this_thread::sleep_for(std::chrono::milliseconds(1)); };
  vtkSMPTools::For(0, 64 * static_cast<vtkIdType>(std::thread::hardware_concurrency()), 1, wait);
}

Surface Round(vtkPolyData* input, int threads = 0)
{
  vtkNew<vtkSphericalStyleFilter> filter;
  filter->SetNumberOfThreads(threads);
  filter->SetInputData(input);
  filter->Update();
  return filter->GetOutput();
}
#endif
}

int TestThreadLimits(int, char*[])
{
#ifdef __linux__
  if (std::thread::hardware_concurrency() < 2)
  {
    std::cout << "skipped: one core\n";
    return 77;
  }
  Checker check;
  const Surface input = MakeBumpyBall(96, 100); // enough points for threads inside the filter
  unsetenv("VTK_SMP_MAX_THREADS");
  StartThreadsOfVTK();
  const Threads before = ThreadsOfProcess();
  const Surface expected = Round(input, 1);
  const auto alone = [&](vtkPolyData* result, const char* why)
  {
    check.About(why);
    check(ThreadsOfProcess() == before, "the filter should start no thread");
    check(SamePoints(expected, result), "the same bits");
  };
  alone(expected, "NumberOfThreads");

  vtkSMPTools::Initialize(1);
  alone(Round(input), "vtkSMPTools::Initialize");
  vtkSMPTools::Initialize(0);

  Surface scoped;
  vtkSMPTools::LocalScope(vtkSMPTools::Config(1), [&] { scoped = Round(input); });
  alone(scoped, "vtkSMPTools::LocalScope");
  vtkSMPTools::Initialize(0);

  for (const char* name : { "VTK_SMP_MAX_THREADS", "OMPI_COMM_WORLD_LOCAL_SIZE" })
  {
    setenv(name, name[0] == 'V' ? "1" : "100000", 1);
    alone(Round(input), name);
    unsetenv(name);
  }

  check.About("no limit");
  const Surface all = Round(input, 2);
  check(ThreadsOfProcess().size() > before.size(), "the filter should start threads");
  check(SamePoints(expected, all), "the same bits");
  return check.Result();
#else
  std::cout << "skipped: no way to count threads\n";
  return 77;
#endif
}
