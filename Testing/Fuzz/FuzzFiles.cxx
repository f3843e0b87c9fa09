// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// The fuzz target of files: bytes are a glTF file that gets a slider, or a surface that is written
/// as glTF and as 3MF. Whatever they are: there is a file and no error, or one error in words of
/// ours and no file; and a file with a slider is one that can get another.
///
/// The first byte has flags (see Flags below). A glTF file follows: its JSON, a 0, and the bytes of
/// its buffer.
#include "FuzzTesting.h"
#include "SurfaceFromBytes.h"
#include "vtkGLTFDocument.h" // its JSON, no function of it

#include "vtk3MFWriter.h"
#include "vtkStyleGLTFWriter.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

using namespace FilterTesting;
using Json = vtkGLTFDocument::Json;

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t room);
extern "C" std::size_t LLVMFuzzerCustomMutator(
  std::uint8_t* data, std::size_t size, std::size_t room, unsigned seed);

namespace
{
enum Flags
{
  OF_SURFACE = 1, ///< no file: a surface that is written
  AS_IT_IS = 2,   ///< what follows is the file
  SOURCE_IS_TEXT = 4,
  RESULT_IS_TEXT = 8,
  WITH_DETAILS = 16,
  KEEPS_SIZE = 32,
  AGAIN = 64 ///< and the file with a slider gets another one
};

/// A folder of this process.
class Folder
{
public:
  Folder()
  {
    std::random_device random;
    do
    {
      this->Path =
        std::filesystem::temp_directory_path() / ("FuzzFiles-" + std::to_string(random()));
    } while (!std::filesystem::create_directory(this->Path));
  }
  ~Folder()
  {
    std::error_code error;
    std::filesystem::remove_all(this->Path, error);
  }
  Folder(const Folder&) = delete;
  void operator=(const Folder&) = delete;

  std::filesystem::path Path;
};

std::string Name(const char* file)
{
  static const Folder folder;
  return (folder.Path / file).string();
}

void Save(const std::string& name, const std::string& content)
{
  std::ofstream(name, std::ios::binary)
    .write(content.data(), static_cast<std::streamsize>(content.size()));
}

std::string Word(std::size_t number)
{
  std::string word;
  for (unsigned shift = 0; shift < 32; shift += 8)
  {
    word += static_cast<char>(number >> shift & 0xFFU);
  }
  return word;
}

std::string Chunk(const char* type, std::string content, char filling)
{
  content.resize((content.size() + 3) / 4 * 4, filling);
  return Word(content.size()) + std::string(type, 4) + content;
}

/// Saves the file that the bytes are. @return its name
std::string Source(const std::string& content, int flags)
{
  std::string all = content;
  const std::size_t end = std::min(content.find('\0'), content.size());
  if (!(flags & AS_IT_IS) && (flags & SOURCE_IS_TEXT))
  {
    all.resize(end);
  }
  else if (!(flags & AS_IT_IS))
  {
    all = Chunk("JSON", content.substr(0, end), ' ');
    if (end < content.size())
    {
      all += Chunk("BIN\0", content.substr(end + 1), '\0');
    }
    all = "glTF" + Word(2) + Word(12 + all.size()) + all;
  }
  std::string name = Name(flags & SOURCE_IS_TEXT ? "source.gltf" : "source.glb");
  Save(name, all);
  return name;
}

/// Words of libraries tell nobody what is wrong with a file, and a message is no place for the
/// numbers of one.
bool IsReadable(const std::string& text, const std::string& source)
{
  constexpr const char* others[] = { "json.exception", "std::", "vector::", "basic_string", "stoi",
    "filesystem error" };
  return text.size() < 2000 &&
    std::none_of(std::begin(others), std::end(others),
      [&](const char* word)
      { return text.find(word) != std::string::npos && source.find(word) == std::string::npos; });
}

/// @param source  bytes of a file that is read
/// @return the error, nothing where there is a file
std::string Write(vtkWriter* writer, const std::string& name, const std::string& source = "")
{
  std::filesystem::remove(name);
  std::vector<std::string> errors, warnings;
  writer->RemoveAllObservers();
  Watch(writer, vtkCommand::ErrorEvent, errors);
  Watch(writer, vtkCommand::WarningEvent, warnings);
  Others()->Errors.clear();
  const bool written = writer->Write() == 1;
  writer->RemoveAllObservers();
  Demand(Others()->Errors.empty(), "no other object complains", writer, Joined(Others()->Errors));
  Demand(errors.size() == (written ? 0 : 1), "one error or a file", writer, Joined(errors));
  const std::string said = Joined(errors) + Joined(warnings);
  Demand(IsReadable(said, source), "words for people", writer, said);
  Demand(std::filesystem::exists(name) == written, "a file without an error", writer);
  return Joined(errors);
}

vtkSmartPointer<vtkStyleGLTFWriter> MakeWriter(int flags, const std::string& result)
{
  auto writer = vtkSmartPointer<vtkStyleGLTFWriter>::New();
  vtkSphericalStyleFilter* style = writer->GetStyle();
  style->SetDetailSize(flags & WITH_DETAILS ? style->GetDetailSize() : 0.0);
  if (!(flags & KEEPS_SIZE))
  {
    style->SetKeepSizeToOff();
  }
  style->SetNumberOfThreads(1);
  writer->SetMaximumNumberOfTargets(3);
  writer->SetFileName(result.c_str());
  return writer;
}

/// Gives a file a slider, and that one another.
void Slide(const std::string& source, int flags, const std::string& content = "")
{
  const std::string result = Name(flags & RESULT_IS_TEXT ? "result.gltf" : "result.glb");
  const auto first = MakeWriter(flags, result);
  first->SetSourceFileName(source.c_str());
  if (!Write(first, result, content).empty() || !(flags & AGAIN))
  {
    return;
  }
  const std::string again = Name("again.glb");
  const auto second = MakeWriter(flags, again);
  second->SetSourceFileName(result.c_str());
  const std::string error = Write(second, again, content);
  Demand(error.empty(), "the file with a slider gets another one", second, error);
}

void WriteSurface(Bytes bytes, int flags)
{
  const Surface surface = SurfaceFromBytes(bytes);
  const auto before = vtkSmartPointer<vtkPolyData>::New();
  before->DeepCopy(surface);
  // Not a name that Slide writes: it would remove what it is to read.
  const std::string written = Name(flags & RESULT_IS_TEXT ? "surface.gltf" : "surface.glb");
  const auto slider = MakeWriter(flags, written);
  slider->SetInputData(surface);
  if (Write(slider, written).empty())
  {
    Slide(written, flags);
  }
  const std::string print = Name("result.3mf");
  const auto printer = vtkSmartPointer<vtk3MFWriter>::New();
  printer->SetUnit(flags / AS_IT_IS % 6);
  printer->SetFileName(print.c_str());
  printer->SetInputData(surface);
  Write(printer, print);
  Demand(SamePolyData(before, surface), "the input is unchanged", slider);
}

// ------------------------------------------------------------------------------- changes of inputs
std::size_t Below(std::mt19937& random, std::size_t n)
{
  return random() % n;
}

/// Adds the lists and objects with something in them.
void Collect(Json& json, std::vector<Json*>& holders)
{
  if (json.is_structured() && !json.empty())
  {
    holders.push_back(&json);
    for (Json& item : json)
    {
      Collect(item, holders);
    }
  }
}

Json& AnyItem(std::vector<Json*>& holders, std::mt19937& random)
{
  Json& holder = *holders[Below(random, holders.size())];
  return *std::next(holder.begin(), static_cast<std::ptrdiff_t>(Below(random, holder.size())));
}

/// Puts another value in, or leaves one out: what comes of it is JSON again, unlike what changed
/// bytes make of it.
void Change(Json& root, std::mt19937& random)
{
  static const Json values = { 0, 1, 2, 3, 4, 5, 6, 12, 255, 5120, 5121, 5123, 5125, 5126, 65536,
    1000000000, 4294967296, 9007199254740993, 18446744073709551615U, -1, 0.5, -2.5, 1e-40, 1e38,
    1e300, true, false, nullptr, "", "x", "SCALAR", "VEC3", "VEC4", "MAT4", "LINEAR", "CUBICSPLINE",
    "weights", "data:;base64,AAAAAAAAAAAAAIA/AAAAAA==", "beside%2Fthis", Json::array(),
    Json::object() };
  static const std::vector<std::string> keys = { "mesh", "skin", "joints", "nodes", "children",
    "mode", "indices", "targets", "weights", "extras", "targetNames", "scale", "rotation", "matrix",
    "translation", "scene", "sparse", "count", "byteOffset", "byteStride", "byteLength",
    "normalized", "bufferView", "uri", "NORMAL", "JOINTS_0", "WEIGHTS_0", "JOINTS_1", "WEIGHTS_1",
    "channels", "samplers", "sampler", "output", "target", "path", "interpolation" };
  std::vector<Json*> holders;
  Collect(root, holders);
  if (holders.empty())
  {
    root = { { "asset", { { "version", "2.0" } } } };
    return;
  }
  const Json value =
    Below(random, 2) ? values[Below(random, values.size())] : AnyItem(holders, random);
  Json& holder = *holders[Below(random, holders.size())];
  const std::size_t at = Below(random, holder.size());
  switch (Below(random, 6))
  {
    case 0:
      holder.erase(std::next(holder.begin(), static_cast<std::ptrdiff_t>(at)));
      break;
    case 1:
      if (holder.is_array())
      {
        holder.push_back(value);
      }
      else
      {
        holder[keys[Below(random, keys.size())]] = value;
      }
      break;
    default:
      *std::next(holder.begin(), static_cast<std::ptrdiff_t>(at)) = value;
  }
}
}

std::size_t LLVMFuzzerCustomMutator(
  std::uint8_t* data, std::size_t size, std::size_t room, unsigned seed)
{
  std::mt19937 random(seed);
  const bool isText = size > 1 && !(data[0] & (OF_SURFACE | AS_IT_IS));
  if (isText && Below(random, 4) > 0)
  {
    const std::string content(data + 1, data + size);
    const std::size_t end = std::min(content.find('\0'), content.size());
    Json root = Json::parse(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(end),
      nullptr, false); // does not throw
    if (!root.is_discarded())
    {
      for (std::size_t changes = 1 + Below(random, 3); changes > 0; --changes)
      {
        Change(root, random);
      }
      const std::string changed = static_cast<char>(data[0]) +
        root.dump(-1, ' ', false, Json::error_handler_t::replace) + content.substr(end);
      if (changed.size() <= room)
      {
        std::copy(changed.begin(), changed.end(), data);
        return changed.size();
      }
    }
  }
  return LLVMFuzzerMutate(data, size, room);
}

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  Others();
  const int flags = size > 0 ? data[0] : 0;
  const std::uint8_t* const rest = size > 0 ? data + 1 : data;
  const std::size_t left = size > 0 ? size - 1 : 0;
  if (flags & OF_SURFACE)
  {
    WriteSurface(Bytes(rest, left), flags);
  }
  else
  {
    const std::string content(rest, rest + left);
    Slide(Source(content, flags), flags, content);
  }
  return 0;
}
