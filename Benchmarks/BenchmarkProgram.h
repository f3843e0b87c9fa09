// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the programs that measure one run have in common: options, a JSON object as their output,
/// memory, a hash of results.
#ifndef SphericalStyle_BenchmarkProgram_h
#define SphericalStyle_BenchmarkProgram_h

#include "Stopwatch.h"

#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace Benchmarks
{
/// "--name value" pairs after the positional arguments.
class Arguments
{
public:
  /// @param known  the options and their defaults
  Arguments(int argc, char* argv[], std::map<std::string, std::string> known)
    : Options(std::move(known))
  {
    for (int i = 1; i < argc; ++i)
    {
      const std::string word = argv[i];
      if (word.rfind("--", 0) != 0)
      {
        this->Positional.push_back(word);
        continue;
      }
      if (this->Options.count(word) == 0 || i + 1 == argc)
      {
        throw std::invalid_argument("unknown option or no value: " + word);
      }
      this->Options[word] = argv[++i];
    }
  }

  const std::string& At(std::size_t k) const
  {
    if (k >= this->Positional.size())
    {
      throw std::invalid_argument("too few arguments");
    }
    return this->Positional[k];
  }
  const std::string& Text(const std::string& name) const { return this->Options.at(name); }
  double Number(const std::string& name) const { return this->Value<double>(name); }
  int Integer(const std::string& name) const { return this->Value<int>(name); }

private:
  template <typename T>
  T Value(const std::string& name) const
  {
    std::istringstream text(this->Options.at(name));
    T value{};
    if (!(text >> value) || !(text >> std::ws).eof())
    {
      throw std::invalid_argument(name + ": not a number: " + text.str());
    }
    return value;
  }

  std::vector<std::string> Positional;
  std::map<std::string, std::string> Options;
};

/// A flat JSON object, in the order of the calls.
class Record
{
public:
  Record& Add(const std::string& name, double value) { return this->AddField(name, Format(value)); }
  Record& Add(const std::string& name, const std::string& value)
  {
    return this->AddField(name, '"' + value + '"');
  }
  void Print() const { std::cout << "{" << this->Text << "}" << std::endl; }

private:
  Record& AddField(const std::string& name, const std::string& value)
  {
    this->Text += (this->Text.empty() ? "\"" : ", \"") + name + "\": " + value;
    return *this;
  }
  static std::string Format(double value)
  {
    std::ostringstream os;
    os << std::setprecision(17) << value;
    return value - value == 0.0 ? os.str() : "null"; // JSON has no infinities and no NaN
  }

  std::string Text;
};

/// Wall time and processor time of all threads since construction, seconds. They differ where other
/// programs keep the machine busy.
class Timer
{
public:
  double Seconds() const { return this->Wall.Seconds(); }
  double ProcessorSeconds() const
  {
    return static_cast<double>(std::clock() - this->Start) / CLOCKS_PER_SEC;
  }

private:
  SphericalStyle::Stopwatch Wall;
  std::clock_t Start = std::clock();
};

/// Largest memory of this process so far, MB. getrusage would count the process that started it.
inline double PeakMegabytes()
{
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word)
  {
    double kilobytes = 0.0;
    if (word == "VmHWM:" && status >> kilobytes)
    {
      return kilobytes / 1024.0;
    }
  }
  return 0.0;
}

/// FNV-1a of the bytes: equal for equal bits.
inline std::string Hash(const void* data, std::size_t size)
{
  std::uint64_t hash = 14695981039346656037u;
  for (std::size_t i = 0; i < size; ++i)
  {
    hash = (hash ^ static_cast<const unsigned char*>(data)[i]) * 1099511628211u;
  }
  std::ostringstream os;
  os << std::hex << hash;
  return os.str();
}

/// Runs a program's body; an exception becomes a message and exit code 1.
template <typename Body>
int Main(const char* usage, Body&& body)
{
  try
  {
    body();
    return EXIT_SUCCESS;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n" << usage << std::endl;
    return EXIT_FAILURE;
  }
}
} // namespace Benchmarks

#endif
