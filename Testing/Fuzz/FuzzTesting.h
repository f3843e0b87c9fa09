// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What fuzz targets demand, and what VTK says meanwhile.
#ifndef FuzzTesting_h
#define FuzzTesting_h

#include "vtkLogger.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

/// Errors of objects that are not ours: something was handed to VTK that it cannot take.
class Strangers : public vtkOutputWindow
{
public:
  static Strangers* New();
  vtkTypeMacro(Strangers, vtkOutputWindow);
  void DisplayText(const char*) override {}
  void DisplayErrorText(const char* text) override { this->Errors.emplace_back(text); }

  std::vector<std::string> Errors;
};
vtkStandardNewMacro(Strangers);

inline Strangers* Others()
{
  static const vtkSmartPointer<Strangers> window = []
  {
    auto made = vtkSmartPointer<Strangers>::New();
    vtkOutputWindow::SetInstance(made);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    return made;
  }();
  return window;
}

/// Ends the process where something is not `good`.
inline void Demand(bool good, const char* what, vtkObject* about, const std::string& more = "")
{
  if (!good)
  {
    std::cerr << "VIOLATED: " << what << more << "\n";
    about->Print(std::cerr);
    std::abort();
  }
}

#endif
