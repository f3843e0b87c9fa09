// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the code that works on vectors comes to, however it was compiled.
#ifndef SphericalStyle_TwinResults_h
#define SphericalStyle_TwinResults_h

#include <string>
#include <vector>

struct TwinResult
{
  std::string name;
  std::vector<double> numbers;
};

// One source, compiled twice; see CMakeLists.txt.
namespace VectorTwin
{
std::vector<TwinResult> GetResults();
}
namespace ScalarTwin
{
std::vector<TwinResult> GetResults();
}

#endif
