// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Every filter with too little memory, in a process of its own: an error and no output, or the
/// result that there is with enough of it; and once there is enough again, that result to the bit.
/// Skipped where addresses cannot be limited, which is also so with sanitizers.
#include "FaultTesting.h"

#include "vtkSMPTools.h"

#include <array>
#include <chrono>
#include <thread>

#if defined(__linux__) && !defined(SANITIZED) // a sanitizer takes terabytes of addresses
#define LIMITS_MEMORY
#include <csignal>
#include <cstdio>
#include <fstream>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

using namespace FilterTesting;

namespace
{
#ifdef LIMITS_MEMORY
constexpr int Refused = 10; // exit codes of a child: no memory, and said so
constexpr int Done = 11;    // there was enough
constexpr int EndedByVTK = 12;

rlim_t AddressSpace()
{
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

void LimitAddressSpace(rlim_t bytes)
{
  rlimit limit = {};
  getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = bytes;
  setrlimit(RLIMIT_AS, &limit);
}

/// A thread of VTK that gets no stack is beyond what a filter can report, and oneTBB then waits for
/// it forever. So all threads are there before memory gets short.
void StartThreadsOfVTK()
{
  struct Nap
  {
    void operator()(vtkIdType, vtkIdType)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1)); // so that every thread gets some
    }
  } nap;
  vtkSMPTools::For(0, 8 * vtkIdType{ vtkSMPTools::GetEstimatedNumberOfThreads() }, 1, nap);
}

/// What the child process does, and its exit code.
int RunShort(const Subject& subject, vtkPolyData* input, rlim_t more)
{
  Checker check;
  check.About(subject.name + " with " + Text(static_cast<vtkIdType>(more >> 10)) + " kB");
  std::vector<std::string> errors;
  std::vector<std::string> others;
  errors.reserve(16);
  const auto filter = subject.make();
  Watch(filter, vtkCommand::ErrorEvent, errors);
  Watch(filter, vtkCommand::WarningEvent, others);
  Watch(filter->GetExecutive(), vtkCommand::ErrorEvent, others);
  filter->SetInputData(input);
  filter->UpdateInformation();
  StartThreadsOfVTK();
  malloc_trim(0);
  LimitAddressSpace(AddressSpace() + more);
  filter->Update();
  LimitAddressSpace(RLIM_INFINITY);
  const std::vector<std::string> refused = errors;
  const bool empty = IsEmpty(filter);
  const auto result = AllOutputs(filter);

  errors.clear();
  filter->Modified();
  filter->Update();
  const auto again = AllOutputs(filter);
  const auto fresh = subject.make();
  Watch(fresh, vtkCommand::WarningEvent, others);
  fresh->SetInputData(input);
  fresh->Update();
  const auto expected = AllOutputs(fresh);

  // VTK's own threads have stacks, and the system has words of its own when it cannot give them.
  const bool said = std::any_of(refused.begin(), refused.end(),
    [](const std::string& error)
    { return Contains(error, "memory") || Contains(error, "Resource temporarily unavailable"); });
  check(refused.empty() || (said && empty),
    "there should be an error that names what is short and no output" + Joined(refused));
  check(!refused.empty() || SameOutputs(result, expected),
    "without an error it should be the whole result");
  check(errors.empty() && SameOutputs(again, expected),
    "with memory again it should be the result" + Joined(errors));
  return check.Result() != EXIT_SUCCESS ? EXIT_FAILURE : refused.empty() ? Done : Refused;
}

/// Exit code of the child, or minus the signal that ended it. The parent must not have run a
/// filter: OpenMP does not work in a child of a process that has used it.
int InChild(const std::function<int()>& work)
{
  std::cout.flush();
  std::FILE* said = std::tmpfile();
  const pid_t child = fork();
  if (child == 0)
  {
    dup2(fileno(said), STDERR_FILENO);
    alarm(120);
    const int code = work();
    std::cerr.flush();
    _exit(code);
  }
  int status = 0;
  waitpid(child, &status, 0);
  std::string text(4096, ' ');
  std::rewind(said);
  text.resize(std::fread(text.data(), 1, text.size(), said));
  std::fclose(said);
  // VTK built with assertions, as Debian's, ends the process where one of its arrays gets no
  // memory.
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT && Contains(text, "Unable to allocate"))
  {
    return EndedByVTK;
  }
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  if (code != Refused && code != Done)
  {
    std::cerr << text;
  }
  return code;
}

/// @param first  of the amounts of memory, and then every stride-th
/// @return how often there was not enough
int CheckShort(
  Checker& check, const Subject& subject, vtkPolyData* input, std::size_t first, std::size_t stride)
{
  int refused = 0;
  constexpr std::array<rlim_t, 4> amounts = { 0, 512, 8192, 131072 };
  for (std::size_t k = first; k < amounts.size(); k += stride)
  {
    const rlim_t kilobytes = amounts[k];
    check.About(subject.name + " with " + Text(static_cast<vtkIdType>(kilobytes)) + " kB");
    const int code = InChild([&] { return RunShort(subject, input, kilobytes << 10); });
    check(code == Refused || code == Done || code == EndedByVTK,
      "it should end well and ends with " + Text(code));
    refused += code == Refused;
  }
  return refused;
}
#endif
}

int TestFaultsMemory([[maybe_unused]] int argc, [[maybe_unused]] char* argv[])
{
#ifdef LIMITS_MEMORY
  Checker check;
  const Surface input = MakeBumpyBall(24, 30);
  const std::size_t stride = IsComplete(argc, argv) ? 1 : 2;
  std::size_t number = 0;
  int refused = 0;
  for (const Subject& subject : Subjects())
  {
    refused += CheckShort(check, subject, input, number++ % stride, stride);
  }
  check.About("all filters");
  check(refused > 0, "somewhere memory should not be enough");
  std::cout << refused << " executions ended for want of memory\n";
  return check.Result();
#else
  std::cout << "skipped: addresses cannot be limited here\n";
  return 77;
#endif
}
