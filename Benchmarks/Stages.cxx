// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Google Benchmark of every stage, and of what this machine can do at most.
#include "Stages.h"
#include "Frame.h"

namespace
{
constexpr const char* Usage =
  "usage: Stages [--benchmark_...=...] [--sizes 237000,...] [--families even,slivers]\n"
  "              [--threads 1]";

std::vector<std::string> Split(const std::string& list)
{
  std::vector<std::string> words;
  std::istringstream stream(list);
  for (std::string word; std::getline(stream, word, ',');)
  {
    words.push_back(word);
  }
  return words;
}
}

SphericalStyle::TriangleMesh Benchmarks::MakeFramedMesh(const MeshKey& key)
{
  SphericalStyle::TriangleMesh mesh = MakeMesh(FamilyNamed(key.family), key.numberOfPoints);
  mesh.P = SphericalStyle::FrameOf(mesh.P).Into(mesh.P);
  return mesh;
}

int main(int argc, char* argv[])
{
  return Benchmarks::Main(Usage,
    [&]
    {
      benchmark::Initialize(&argc, argv); // takes its own options away
      const Benchmarks::Arguments arguments(
        argc, argv, { { "--sizes", "237000" }, { "--families", "even" }, { "--threads", "1" } });
      const int threads = arguments.Integer("--threads");
      Benchmarks::RegisterLimits(threads);
      for (const std::string& family : Split(arguments.Text("--families")))
      {
        for (const std::string& size : Split(arguments.Text("--sizes")))
        {
          const Benchmarks::MeshKey key = { family, std::stoi(size) };
          Benchmarks::RegisterClosedFormStages(key, threads);
          Benchmarks::RegisterEnergyStages(key, threads);
        }
      }
      benchmark::RunSpecifiedBenchmarks();
    });
}
