// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the program Stages registers.
#ifndef SphericalStyle_Stages_h
#define SphericalStyle_Stages_h

#include "BenchmarkMesh.h"

namespace Benchmarks
{
struct MeshKey
{
  std::string family;
  int numberOfPoints;
  bool operator==(const MeshKey& other) const
  {
    return this->family == other.family && this->numberOfPoints == other.numberOfPoints;
  }
};

/// "stage/family/points/threads:N"
std::string NameOf(const std::string& stage, const MeshKey& key, int threads);

void RegisterLimits(int threads);
void RegisterSolverStages(const MeshKey& key, int threads);
void RegisterFilter(const MeshKey& key, int threads);
} // namespace Benchmarks

#endif
