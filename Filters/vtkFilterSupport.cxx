// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFilterSupport.h"

#include "vtkAlgorithm.h"
#include "vtkVersion.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace vtkFilterSupport
{
void Require(bool good, const char* name, const char* must, double value)
{
  if (!good)
  {
    std::ostringstream message;
    message << name << " must be " << must << "; it is " << value;
    throw std::invalid_argument(message.str());
  }
}

int ThreadsToUse(int wanted)
{
  if (wanted > 0)
  {
    return wanted;
  }
  const char* limit = std::getenv("VTK_SMP_MAX_THREADS");
  const int fromEnvironment = limit ? std::atoi(limit) : 0;
  return fromEnvironment > 0 ? fromEnvironment
                             : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

bool Aborted(vtkAlgorithm* self)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220823) // the first with CheckAbort
  return self->CheckAbort();
#else
  return self->GetAbortExecute() != 0;
#endif
}

std::string Count(vtkIdType n, const char* noun)
{
  return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

const char* OnOff(bool on)
{
  return on ? "On" : "Off";
}

std::string Triple(const double* x)
{
  std::ostringstream text;
  text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ")";
  return text.str();
}
}
