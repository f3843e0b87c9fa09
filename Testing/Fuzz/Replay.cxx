// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// A fuzz target without a fuzzer, for any compiler:
///
///     ReplayFilters [-runs=N] [FILE or FOLDER ...]
///
/// runs every file, then N inputs made of the files, the same ones at every call: bytes exchanged,
/// left out, put in and taken from another file, or as the target itself changes its inputs.
#include <algorithm>
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
// What libFuzzer offers to a target and what it asks of one; not every target has it.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t room);
extern "C" [[gnu::weak]] std::size_t LLVMFuzzerCustomMutator(
  std::uint8_t* data, std::size_t size, std::size_t room, unsigned seed);

namespace
{
using Input = std::vector<std::uint8_t>;

std::vector<Input> Corpus;
std::mt19937 Random(1);

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
std::size_t Below(std::size_t n)
{
  return n == 0 ? 0 : Random() % n;
}

Input Changed(Input input)
{
  for (std::size_t changes = 1 + Below(8); changes > 0; --changes)
  {
    const auto at = static_cast<std::ptrdiff_t>(Below(input.size()));
    const auto byte = static_cast<std::uint8_t>(Below(256));
    const Input& other = Corpus[Below(Corpus.size())];
    switch (input.empty() ? 1 : Below(4))
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

Input Next()
{
  Input input = Corpus[Below(Corpus.size())];
  if (!LLVMFuzzerCustomMutator)
  {
    return Changed(std::move(input));
  }
  const std::size_t size = input.size();
  input.resize(2 * size + 4096);
  input.resize(
    LLVMFuzzerCustomMutator(input.data(), size, input.size(), static_cast<unsigned>(Random())));
  return input;
}

void Run(const Input& input)
{
  LLVMFuzzerTestOneInput(input.data(), input.size());
}
}

std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t room)
{
  Input changed = Changed({ data, data + size });
  changed.resize(std::min(changed.size(), room));
  std::copy(changed.begin(), changed.end(), data);
  return changed.size();
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
  Corpus.emplace_back();
  for (const std::filesystem::path& file : files)
  {
    Corpus.push_back(Read(file));
    std::cout << file.filename().string() << std::endl; // the last one printed is the culprit
    Run(Corpus.back());
  }
  for (std::size_t k = 0; k < runs; ++k)
  {
    const Input input = Next();
    std::ofstream("last-input.bin", std::ios::binary)
      .write(
        reinterpret_cast<const char*>(input.data()), static_cast<std::streamsize>(input.size()));
    Run(input);
  }
  std::cout << files.size() << " files and " << runs
            << " inputs made of them are as they should be\n";
  return EXIT_SUCCESS;
}
