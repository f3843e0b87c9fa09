// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// The fuzz target without a fuzzer, for any compiler:
///
///     FuzzReplay [-runs=N] [FILE or FOLDER ...]
///
/// runs every file, then N inputs made of the files, the same ones at every call: bytes exchanged,
/// left out, put in and taken from another file.
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <set>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace
{
using Input = std::vector<std::uint8_t>;

Input Read(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  if (!file)
  {
    std::cerr << path << " cannot be read\n";
    std::exit(EXIT_FAILURE);
  }
  return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
}

/// Distributions of the standard library differ from one to the other; this does not.
std::size_t Below(std::mt19937& random, std::size_t n)
{
  return n == 0 ? 0 : random() % n;
}

Input Changed(const std::vector<Input>& corpus, std::mt19937& random)
{
  Input input = corpus[Below(random, corpus.size())];
  for (std::size_t changes = 1 + Below(random, 8); changes > 0; --changes)
  {
    const auto at = static_cast<std::ptrdiff_t>(Below(random, input.size()));
    const auto byte = static_cast<std::uint8_t>(Below(random, 256));
    const Input& other = corpus[Below(random, corpus.size())];
    switch (input.empty() ? 1 : Below(random, 4))
    {
      case 0:
        input[at] = byte;
        break;
      case 1:
        input.insert(input.begin() + at, byte);
        break;
      case 2:
        input.erase(input.begin() + at);
        break;
      default: // the rest of another
        input.resize(at);
        input.insert(
          input.end(), other.begin() + std::min<std::ptrdiff_t>(at, other.size()), other.end());
    }
  }
  return input;
}

void Run(const Input& input)
{
  LLVMFuzzerTestOneInput(input.data(), input.size());
}
}

int main(int argc, char* argv[])
{
  std::size_t runs = 0;
  std::set<std::filesystem::path> files; // in one order everywhere
  for (int k = 1; k < argc; ++k)
  {
    const std::string word = argv[k];
    if (word.rfind("-runs=", 0) == 0)
    {
      runs = std::stoul(word.substr(6));
    }
    else if (std::filesystem::is_directory(word))
    {
      for (const auto& entry : std::filesystem::directory_iterator(word))
      {
        files.insert(entry.path());
      }
    }
    else
    {
      files.insert(word);
    }
  }
  std::vector<Input> corpus = { {} };
  for (const std::filesystem::path& file : files)
  {
    corpus.push_back(Read(file));
    std::cout << file.filename().string() << std::endl; // the last one printed is the culprit
    Run(corpus.back());
  }
  std::mt19937 random(1);
  for (std::size_t k = 0; k < runs; ++k)
  {
    const Input input = Changed(corpus, random);
    std::ofstream("last-input.bin", std::ios::binary)
      .write(
        reinterpret_cast<const char*>(input.data()), static_cast<std::streamsize>(input.size()));
    Run(input);
  }
  std::cout << files.size() << " files and " << runs
            << " inputs made of them are as they should be\n";
  return EXIT_SUCCESS;
}
