// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkWholeFile.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <new>
#include <random>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace
{
/// A name in the same folder that no other file has: 64 random bits.
std::filesystem::path UnfinishedBeside(const std::filesystem::path& path)
{
  std::random_device random;
  std::ostringstream name;
  name << '.' << std::hex << random() << random() << ".part";
  return path.parent_path() / name.str();
}

bool WriteParts(
  const std::filesystem::path& path, std::initializer_list<const vtkWholeFile::Bytes*> parts)
{
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  for (const vtkWholeFile::Bytes* part : parts)
  {
    if (!part->empty())
    {
      file.write(reinterpret_cast<const char*>(part->data()), // NOLINT(*-reinterpret-cast): bytes
        static_cast<std::streamsize>(part->size()));
    }
  }
  file.close();
  return !file.fail();
}
}

namespace vtkWholeFile
{
bool EndsIn(std::string name, std::initializer_list<const char*> endings)
{
  std::transform(name.begin(), name.end(), name.begin(),
    [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return std::any_of(endings.begin(), endings.end(),
    [&name](const std::string& ending)
    {
      return name.size() > ending.size() &&
        name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
    });
}

void Naming(const char* file, const std::function<void()>& call)
{
  try
  {
    call();
  }
  catch (const std::bad_alloc&) // not the fault of this file
  {
    throw;
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error(std::string(file) + ": " + error.what());
  }
}

void Save(const std::string& path, std::initializer_list<const Bytes*> parts)
{
  const std::filesystem::path place = std::filesystem::u8path(path);
  const std::filesystem::path unfinished = UnfinishedBeside(place);
  std::error_code error;
  bool written = WriteParts(unfinished, parts);
  if (written)
  {
    std::filesystem::rename(unfinished, place, error);
    written = !error;
  }
  if (!written)
  {
    std::filesystem::remove(unfinished, error);
    throw std::runtime_error(
      "cannot be written; is there such a folder, may you write there, and is there space?");
  }
}
}
