// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Google Benchmark of every stage, and of what this machine can do at most.
#include "Stages.h"

#include "BenchmarkProgram.h"

#include <benchmark/benchmark.h>

namespace
{
constexpr const char* Usage =
  "usage: Stages [--benchmark_...=...] [--sizes 2000,35000,...] [--families even,slivers]\n"
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

std::string Benchmarks::NameOf(const std::string& stage, const MeshKey& key, int threads)
{
  return stage + '/' + key.family + '/' + std::to_string(key.numberOfPoints) +
    "/threads:" + std::to_string(threads);
}

int main(int argc, char* argv[])
{
  return Benchmarks::Main(Usage,
    [&]
    {
      benchmark::Initialize(&argc, argv); // takes its own options away
      const Benchmarks::Arguments arguments(argc, argv,
        { { "--sizes", "2000,10000,35000,99000,237000,949000" }, { "--families", "even,slivers" },
          { "--threads", "1" } });
      const int threads = arguments.Integer("--threads");
      Benchmarks::RegisterLimits(threads);
      for (const std::string& family : Split(arguments.Text("--families")))
      {
        for (const std::string& size : Split(arguments.Text("--sizes")))
        {
          const Benchmarks::MeshKey key = { family, std::stoi(size) };
          Benchmarks::RegisterSolverStages(key, threads);
          Benchmarks::RegisterFilter(key, threads);
        }
      }
      benchmark::RunSpecifiedBenchmarks();
    });
}
