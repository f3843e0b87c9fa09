// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Process.h"

#include <algorithm>
#include <limits>

#ifdef _WIN32
#define NOMINMAX
#include <windows.h>
#else
#include <unistd.h>
#endif
#ifdef __linux__
#include <sched.h>
#include <sys/mman.h>
#endif

namespace SphericalStyle
{
// The branches of Windows are written from its documentation and have not been compiled.

long ProcessId()
{
#ifdef _WIN32
  return static_cast<long>(GetCurrentProcessId());
#else
  return getpid();
#endif
}

int CoresOfProcess(int machine)
{
#ifdef __linux__
  cpu_set_t cores;
  if (sched_getaffinity(0, sizeof(cores), &cores) == 0)
  {
    return std::clamp(CPU_COUNT(&cores), 1, machine);
  }
#endif
  return machine;
}

double MemoryOfMachine()
{
#ifdef _WIN32
  MEMORYSTATUSEX status = {};
  status.dwLength = sizeof(status);
  if (GlobalMemoryStatusEx(&status))
  {
    return static_cast<double>(status.ullTotalPhys);
  }
#elif defined(_SC_PHYS_PAGES)
  const long pages = sysconf(_SC_PHYS_PAGES);
  if (pages > 0)
  {
    return static_cast<double>(pages) * static_cast<double>(sysconf(_SC_PAGESIZE));
  }
#endif
  return std::numeric_limits<double>::infinity();
}

void UseHugePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes)
{
#ifdef MADV_HUGEPAGE
  madvise(memory, bytes, MADV_HUGEPAGE); // no more than a wish
#endif
}
} // namespace SphericalStyle
