// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGLTFDocument.h"

#include "vtkWholeFile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

using Json = vtkGLTFDocument::Json;
using Bytes = vtkGLTFDocument::Bytes;

namespace
{
constexpr std::uint32_t GlbMagic = 0x46546C67;  // "glTF"
constexpr std::uint32_t JsonChunk = 0x4E4F534A; // "JSON"
constexpr std::uint32_t BinaryChunk = 0x004E4942;
constexpr std::size_t GlbHeader = 12;
constexpr std::size_t ChunkHeader = 8;
constexpr int DeepestJson = 256;                // nothing in glTF is deeper than 20
constexpr std::size_t MostElements = 238609294; // the filters take no more points

constexpr std::size_t ByteType = 5120, UnsignedByteType = 5121, ShortType = 5122,
                      UnsignedShortType = 5123, UnsignedIntType = 5125, FloatType = 5126;
constexpr int VertexTarget = 34962, IndexTarget = 34963;

[[noreturn]] void BadFile(const std::string& message)
{
  throw std::runtime_error(message);
}

std::filesystem::path PathOf(const std::string& utf8)
{
  return std::filesystem::u8path(utf8);
}

Bytes ReadFile(const std::filesystem::path& path, const std::string& what)
{
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
  {
    BadFile(what + " is a folder");
  }
  if (std::filesystem::is_character_file(path, error)) // such as /dev/zero, which has no end
  {
    BadFile(what + " is a device");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file)
  {
    BadFile(what + " cannot be read");
  }
  Bytes bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  return bytes;
}

/// The numbers of glTF are little-endian, whatever the machine is.
std::uint64_t LittleEndian(const unsigned char* first, std::size_t size)
{
  std::uint64_t value = 0;
  for (std::size_t k = size; k-- > 0;)
  {
    value = value << 8U | first[k];
  }
  return value;
}

void AppendLittleEndian(Bytes& bytes, std::uint32_t value)
{
  for (unsigned k = 0; k < 32; k += 8)
  {
    bytes.push_back(static_cast<unsigned char>(value >> k & 0xFFU));
  }
}

void Pad(Bytes& bytes, unsigned char with)
{
  bytes.resize((bytes.size() + 3) / 4 * 4, with);
}

const char* const Base64 = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string Encode(const Bytes& bytes)
{
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3)
  {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - k);
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j)
    {
      group = group << 8U | (j < n ? bytes[k + j] : 0U);
    }
    for (std::size_t j = 0; j < 4; ++j)
    {
      text += j <= n ? Base64[group >> (18 - 6 * j) & 63U] : '=';
    }
  }
  return text;
}

Bytes Decode(const std::string& text, std::size_t from, const std::string& owner)
{
  std::array<int, 256> digits;
  digits.fill(-1);
  for (int k = 0; k < 64; ++k)
  {
    digits[static_cast<unsigned char>(Base64[k])] = k;
  }
  Bytes bytes;
  bytes.reserve((text.size() - from) / 4 * 3);
  std::uint32_t group = 0;
  unsigned bits = 0;
  for (std::size_t k = from; k < text.size() && text[k] != '='; ++k)
  {
    const int digit = digits[static_cast<unsigned char>(text[k])];
    if (digit < 0)
    {
      BadFile(owner + ": its data are not base64");
    }
    group = group << 6U | static_cast<std::uint32_t>(digit);
    bits += 6;
    if (bits >= 8)
    {
      bits -= 8;
      bytes.push_back(static_cast<unsigned char>(group >> bits & 0xFFU));
    }
  }
  return bytes;
}

/// What a file says, for a message: the start of a long text.
std::string Quoted(const std::string& text)
{
  constexpr std::size_t most = 100;
  std::size_t end = std::min(most, text.size());
  while (end > 0 && end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U)
  {
    --end; // not inside a character
  }
  return text.substr(0, end) + (end < text.size() ? "..." : "");
}

bool StartsWith(const std::string& text, const char* start)
{
  return text.rfind(start, 0) == 0;
}

/// "a%20b" is "a b".
std::string WithoutPercent(const std::string& uri)
{
  std::string text;
  for (std::size_t k = 0; k < uri.size(); ++k)
  {
    const std::string digits = uri[k] == '%' ? uri.substr(k + 1, 2) : "";
    if (digits.size() == 2 &&
      digits.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos)
    {
      text += static_cast<char>(std::stoi(digits, nullptr, 16));
      k += 2;
    }
    else
    {
      text += uri[k];
    }
  }
  return text;
}

std::size_t SizeOfType(std::size_t componentType, const std::string& owner)
{
  switch (componentType)
  {
    case ByteType:
    case UnsignedByteType:
      return 1;
    case ShortType:
    case UnsignedShortType:
      return 2;
    case UnsignedIntType:
    case FloatType:
      return 4;
    default:
      BadFile(owner + ": its componentType " + std::to_string(componentType) + " is unknown");
  }
}

double NumberAt(const unsigned char* at, std::size_t componentType, bool normalized)
{
  const std::size_t size = SizeOfType(componentType, "");
  const std::uint64_t bits = LittleEndian(at, size);
  if (componentType == FloatType)
  {
    const auto bits32 = static_cast<std::uint32_t>(bits);
    float value = 0.0F;
    std::memcpy(&value, &bits32, sizeof(value));
    return static_cast<double>(value);
  }
  const double range = std::ldexp(1.0, static_cast<int>(8 * size));
  const bool isSigned = componentType == ByteType || componentType == ShortType;
  auto value = static_cast<double>(bits);
  if (isSigned && value >= range / 2)
  {
    value -= range;
  }
  if (!normalized)
  {
    return value;
  }
  return std::max(-1.0, value / ((isSigned ? range / 2 : range) - 1.0));
}

std::size_t ComponentsOf(const std::string& type)
{
  for (const auto& [name, components] : std::initializer_list<std::pair<const char*, std::size_t>>{
         { "SCALAR", 1 }, { "VEC2", 2 }, { "VEC3", 3 }, { "VEC4", 4 }, { "MAT4", 16 } })
  {
    if (type == name)
    {
      return components;
    }
  }
  return 1;
}

bool IsOn(const Json& object, const char* key)
{
  const auto found = object.find(key);
  return found != object.end() && found->is_boolean() && found->get<bool>();
}

bool AreObjects(const Json& value)
{
  return value.is_array() &&
    std::all_of(value.begin(), value.end(), [](const Json& item) { return item.is_object(); });
}

Bytes BytesOf(const std::string& text)
{
  return { text.begin(), text.end() };
}
} // namespace

vtkGLTFDocument::vtkGLTFDocument()
  : Root({ { "asset", { { "generator", "SphericalStyle" }, { "version", "2.0" } } } })
  , Binary(true)
{
}

// ---------------------------------------------------------------------------------------- reading
vtkGLTFDocument vtkGLTFDocument::Read(const std::string& path)
{
  vtkGLTFDocument document;
  document.Path = path;
  const Bytes file = ReadFile(PathOf(path), "the file");
  document.Binary = file.size() >= 4 && LittleEndian(file.data(), 4) == GlbMagic;
  if (document.Binary)
  {
    document.ReadBinary(file);
  }
  else
  {
    document.ParseJson(file.data(), file.size());
    document.ReadBuffers();
  }
  return document;
}

void vtkGLTFDocument::ReadBinary(const Bytes& file)
{
  const char* const cut = "the file is cut off or not a .glb";
  if (file.size() < GlbHeader + ChunkHeader)
  {
    BadFile(cut);
  }
  const std::uint64_t version = LittleEndian(file.data() + 4, 4);
  if (version != 2)
  {
    BadFile("it is glTF of version " + std::to_string(version) + ", and only 2 is known");
  }
  const std::uint64_t length = LittleEndian(file.data() + 8, 4);
  if (length > file.size())
  {
    BadFile(cut);
  }
  Bytes binary;
  bool hasBinary = false;
  std::size_t at = GlbHeader;
  for (int chunk = 0; at + ChunkHeader <= length; ++chunk)
  {
    const std::uint64_t size = LittleEndian(file.data() + at, 4);
    const std::uint64_t type = LittleEndian(file.data() + at + 4, 4);
    const unsigned char* const first = file.data() + at + ChunkHeader;
    if (size > length - at - ChunkHeader || (chunk == 0 && type != JsonChunk))
    {
      BadFile(cut);
    }
    if (chunk == 0)
    {
      this->ParseJson(first, size);
    }
    else if (chunk == 1 && type == BinaryChunk)
    {
      binary.assign(first, first + size);
      hasBinary = true;
    }
    else
    {
      this->OtherChunks.insert(this->OtherChunks.end(), first - ChunkHeader, first + size);
    }
    at += ChunkHeader + size;
  }
  this->ReadBuffers();
  this->Binary = hasBinary && !this->Buffers.empty() && !this->Root["buffers"][0].contains("uri");
  if (this->Binary)
  {
    const std::size_t size = Number(this->Root["buffers"][0], "byteLength", 0, "buffer 0");
    if (size > binary.size())
    {
      BadFile("buffer 0: the file is cut off");
    }
    binary.resize(size); // the rest is padding
    this->Buffers[0] = std::move(binary);
  }
}

void vtkGLTFDocument::ParseJson(const unsigned char* first, std::size_t size)
{
  try
  {
    // The library writes nested values by recursion.
    const auto check = [](int depth, Json::parse_event_t, Json&)
    {
      if (depth > DeepestJson)
      {
        BadFile("its JSON is nested too deeply");
      }
      return true;
    };
    this->Root = Json::parse(first, first + size, check);
  }
  catch (const nlohmann::json::exception& error)
  {
    // "[json.exception.parse_error.101] parse error at ...; last read: ", and then all of a string
    std::string text = error.what();
    text.erase(std::min(text.find("; last read: "), text.size()));
    text.erase(0, text.find("] ") == std::string::npos ? 0 : text.find("] ") + 2);
    BadFile("it is not glTF: " + text);
  }
  const std::string version = this->Root.is_object() && this->Root.contains("asset")
    ? Text(this->Root["asset"], "version")
    : "";
  if (!StartsWith(version, "2."))
  {
    BadFile(version.empty() ? "it is not glTF: no asset.version"
                            : "it is glTF of version " + Quoted(version) + ", and only 2 is known");
  }
  for (const char* name : { "KHR_draco_mesh_compression", "EXT_meshopt_compression" })
  {
    const auto required = this->Root.find("extensionsRequired");
    if (required != this->Root.end() && required->is_array() &&
      std::find(required->begin(), required->end(), name) != required->end())
    {
      BadFile(std::string("its meshes are compressed (") + name +
        "); decompress it first, as with: npx @gltf-transform/cli copy in.glb out.glb");
    }
  }
  for (const auto& [key, value] : this->Root.items())
  {
    for (const char* list : { "accessors", "animations", "bufferViews", "buffers", "images",
           "meshes", "nodes", "scenes", "skins" })
    {
      if (key == list && !AreObjects(value))
      {
        BadFile("its " + key + " are not a list of objects");
      }
    }
  }
}

void vtkGLTFDocument::ReadBuffers()
{
  const auto found = this->Root.find("buffers");
  if (found == this->Root.end())
  {
    return;
  }
  for (const Json& buffer : *found)
  {
    const std::string owner = "buffer " + std::to_string(this->Buffers.size());
    const std::string uri = Text(buffer, "uri");
    Bytes bytes;
    if (!uri.empty())
    {
      bytes = this->ReadUri(uri, owner);
      const std::size_t size = Number(buffer, "byteLength", 0, owner);
      if (size > bytes.size())
      {
        BadFile(
          owner + ": has " + std::to_string(bytes.size()) + " bytes of " + std::to_string(size));
      }
      bytes.resize(size);
    }
    this->Buffers.push_back(std::move(bytes));
  }
}

Bytes vtkGLTFDocument::ReadUri(const std::string& uri, const std::string& owner) const
{
  if (StartsWith(uri, "data:"))
  {
    const std::size_t comma = uri.find(";base64,");
    if (comma == std::string::npos)
    {
      BadFile(owner + ": its data are not base64");
    }
    return Decode(uri, comma + std::strlen(";base64,"), owner);
  }
  if (uri.find("://") != std::string::npos)
  {
    BadFile(owner + ": is not a file beside the model: " + Quoted(uri));
  }
  const std::string name = WithoutPercent(uri);
  return ReadFile(
    PathOf(this->Path).parent_path() / PathOf(name), owner + ": the file " + Quoted(name));
}

const Json& vtkGLTFDocument::Item(
  const char* list, std::size_t index, const std::string& owner) const
{
  const auto found = this->Root.find(list);
  if (found == this->Root.end() || !found->is_array() || index >= found->size())
  {
    BadFile(owner + ": names item " + std::to_string(index) + " of \"" + list + "\", which has " +
      std::to_string(found == this->Root.end() ? 0 : found->size()));
  }
  return (*found)[index];
}

Json& vtkGLTFDocument::Item(const char* list, std::size_t index, const std::string& owner)
{
  return const_cast<Json&>( // NOLINT(*-const-cast): this is not const
    static_cast<const vtkGLTFDocument*>(this)->Item(list, index, owner));
}

std::size_t vtkGLTFDocument::Number(
  const Json& object, const char* key, std::size_t missing, const std::string& owner)
{
  const auto found = object.find(key);
  if (found == object.end())
  {
    return missing;
  }
  constexpr double largest = 9007199254740992.0; // above, doubles are not exact
  const double value = found->is_number() ? found->get<double>() : -1.0;
  if (!(value >= 0.0 && value <= largest && value == std::floor(value)))
  {
    BadFile(owner + ": its " + key + " must be a whole number; it is " + Quoted(found->dump()));
  }
  return static_cast<std::size_t>(value);
}

std::size_t vtkGLTFDocument::Index(const Json& object, const char* key, const std::string& owner)
{
  const std::size_t index = Number(object, key, None, owner);
  if (index == None)
  {
    BadFile(owner + ": has no " + key);
  }
  return index;
}

std::string vtkGLTFDocument::Text(const Json& object, const char* key)
{
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

Json vtkGLTFDocument::Objects(const Json& object, const char* key, const std::string& owner)
{
  const auto found = object.find(key);
  if (found == object.end())
  {
    return Json::array();
  }
  if (!AreObjects(*found))
  {
    BadFile(owner + ": its " + key + " are not a list of objects");
  }
  return *found;
}

vtkGLTFDocument::Range vtkGLTFDocument::View(std::size_t view, const std::string& owner) const
{
  const Json& json = this->Item("bufferViews", view, owner);
  const std::string name = "bufferView " + std::to_string(view);
  const std::size_t buffer = Index(json, "buffer", name);
  this->Item("buffers", buffer, name);
  const std::size_t from = Number(json, "byteOffset", 0, name);
  const std::size_t size = Index(json, "byteLength", name);
  const Bytes& bytes = this->Buffers[buffer];
  if (from > bytes.size() || size > bytes.size() - from)
  {
    BadFile(name + ": leads out of buffer " + std::to_string(buffer) + ", which has " +
      std::to_string(bytes.size()) + " bytes");
  }
  return { bytes.data() + from, size };
}

std::size_t vtkGLTFDocument::NumberOfElements(std::size_t accessor) const
{
  const std::string owner = "accessor " + std::to_string(accessor);
  return Number(this->Item("accessors", accessor, owner), "count", 0, owner);
}

std::vector<double> vtkGLTFDocument::Values(std::size_t accessor, const char* type) const
{
  const std::string owner = "accessor " + std::to_string(accessor);
  const Json& json = this->Item("accessors", accessor, owner);
  if (Text(json, "type") != type)
  {
    BadFile(owner + ": must be of type " + type);
  }
  const std::size_t components = ComponentsOf(type);
  const std::size_t count = this->NumberOfElements(accessor);
  const std::size_t componentType = Index(json, "componentType", owner);
  const std::size_t size = SizeOfType(componentType, owner);
  const bool normalized = IsOn(json, "normalized");
  if (count > MostElements)
  {
    BadFile(owner + ": has too many elements, " + std::to_string(count));
  }
  const auto sparse = json.find("sparse");
  if (!json.contains("bufferView") && sparse == json.end())
  {
    BadFile(owner + ": has no data; if the file is compressed, decompress it first");
  }
  if (!json.contains("bufferView") &&
    count > this->NumberOfBytes()) // a few bytes ask for gigabytes
  {
    BadFile(owner + ": has " + std::to_string(count) +
      " elements without data, more than the file's buffers have bytes");
  }
  std::vector<double> values;
  if (json.contains("bufferView"))
  {
    const std::size_t view = Index(json, "bufferView", owner);
    const Range range = this->View(view, owner);
    const std::size_t from = Number(json, "byteOffset", 0, owner);
    const std::size_t stride =
      Number(this->Item("bufferViews", view, owner), "byteStride", components * size, owner);
    const bool fits = count == 0 ||
      (stride >= components * size && stride <= 252 * 4 && from <= range.Size &&
        (count - 1) * stride + components * size <= range.Size - from);
    if (!fits)
    {
      BadFile(owner + ": leads out of bufferView " + std::to_string(view));
    }
    values.resize(count * components);
    for (std::size_t k = 0; k < values.size(); ++k)
    {
      values[k] = NumberAt(range.First + from + k / components * stride + k % components * size,
        componentType, normalized);
    }
  }
  else
  {
    values.resize(count * components);
  }
  if (sparse != json.end())
  {
    this->Replace(*sparse, components, values, componentType, normalized, owner);
  }
  return values;
}

std::size_t vtkGLTFDocument::NumberOfBytes() const
{
  return std::accumulate(this->Buffers.begin(), this->Buffers.end(), std::size_t(0),
    [](std::size_t sum, const Bytes& buffer) { return sum + buffer.size(); });
}

/// What a sparse accessor says in place of some elements.
void vtkGLTFDocument::Replace(const Json& sparse, std::size_t components,
  std::vector<double>& values, std::size_t componentType, bool normalized,
  const std::string& owner) const
{
  const std::size_t count = Index(sparse, "count", owner);
  const auto part = [&](const char* key) -> const Json&
  {
    const auto found = sparse.find(key);
    if (found == sparse.end())
    {
      BadFile(owner + ": has no sparse " + key);
    }
    return *found;
  };
  const auto rangeOf = [&](const char* key, std::size_t size) -> const unsigned char*
  {
    const Range range = this->View(Index(part(key), "bufferView", owner), owner);
    const std::size_t from = Number(part(key), "byteOffset", 0, owner);
    if (count > MostElements || from > range.Size || count * size > range.Size - from)
    {
      BadFile(owner + ": its sparse " + key + " lead out of their bufferView");
    }
    return range.First + from;
  };
  const std::size_t size = SizeOfType(componentType, owner);
  const unsigned char* const numbers = rangeOf("values", components * size);
  const std::size_t indexType = Index(part("indices"), "componentType", owner);
  const std::size_t indexSize = SizeOfType(indexType, owner);
  const unsigned char* const indices = rangeOf("indices", indexSize);
  for (std::size_t k = 0; k < count; ++k)
  {
    const std::uint64_t index = LittleEndian(indices + k * indexSize, indexSize);
    if (index >= values.size() / components)
    {
      BadFile(owner + ": its sparse indices lead out of it");
    }
    for (std::size_t c = 0; c < components; ++c)
    {
      values[index * components + c] =
        NumberAt(numbers + (k * components + c) * size, componentType, normalized);
    }
  }
}

// ----------------------------------------------------------------------------------------- adding
Json& vtkGLTFDocument::List(const char* list)
{
  Json& found = this->Root[list];
  if (found.is_null())
  {
    found = Json::array();
  }
  return found;
}

std::size_t vtkGLTFDocument::BufferToFill()
{
  if (this->Filled == None)
  {
    this->Filled = this->Binary ? 0 : this->Buffers.size();
    if (this->Filled == this->Buffers.size())
    {
      this->List("buffers").push_back({ { "byteLength", 0 } });
      this->Buffers.emplace_back();
    }
  }
  return this->Filled;
}

std::size_t vtkGLTFDocument::AddAccessor(
  const void* data, std::size_t size, const Json& accessor, Use use)
{
  const std::size_t buffer = this->BufferToFill();
  Bytes& bytes = this->Buffers[buffer];
  Pad(bytes, 0);
  Json view = { { "buffer", buffer }, { "byteOffset", bytes.size() }, { "byteLength", size } };
  if (use != Use::Animation)
  {
    view["target"] = use == Use::Vertices ? VertexTarget : IndexTarget;
  }
  const auto* const first = static_cast<const unsigned char*>(data);
  bytes.insert(bytes.end(), first, first + size);
  this->Root["buffers"][buffer]["byteLength"] = bytes.size();
  this->List("bufferViews").push_back(std::move(view));
  Json full = { { "bufferView", this->Root["bufferViews"].size() - 1 } };
  full.update(accessor);
  this->List("accessors").push_back(std::move(full));
  return this->Root["accessors"].size() - 1;
}

std::size_t vtkGLTFDocument::AddFloats(
  const std::vector<float>& values, const char* type, Use use, bool bounds)
{
  const std::size_t components = ComponentsOf(type);
  if (!std::all_of(values.begin(), values.end(), [](float x) { return std::isfinite(x); }))
  {
    BadFile("a number is too large for glTF, which has single precision; scale the model down");
  }
  Json accessor = { { "componentType", FloatType }, { "count", values.size() / components },
    { "type", type } };
  if (bounds)
  {
    Json smallest = Json::array(), largest = Json::array();
    for (std::size_t c = 0; c < components; ++c)
    {
      float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
      for (std::size_t k = c; k < values.size(); k += components)
      {
        low = std::min(low, values[k]);
        high = std::max(high, values[k]);
      }
      smallest.push_back(static_cast<double>(low)); // every digit of it
      largest.push_back(static_cast<double>(high));
    }
    accessor["min"] = std::move(smallest);
    accessor["max"] = std::move(largest);
  }
  return this->AddAccessor(values.data(), values.size() * sizeof(float), accessor, use);
}

std::size_t vtkGLTFDocument::AddIndices(const std::vector<std::uint32_t>& values)
{
  return this->AddAccessor(values.data(), values.size() * sizeof(std::uint32_t),
    { { "componentType", UnsignedIntType }, { "count", values.size() }, { "type", "SCALAR" } },
    Use::Indices);
}

std::size_t vtkGLTFDocument::AddColors(const Bytes& rgba)
{
  return this->AddAccessor(rgba.data(), rgba.size(),
    { { "componentType", UnsignedByteType }, { "normalized", true }, { "count", rgba.size() / 4 },
      { "type", "VEC4" } },
    Use::Vertices);
}

// ---------------------------------------------------------------------------------------- writing
void vtkGLTFDocument::Write(const std::string& path)
{
  this->CheckFolder(path);
  if (vtkWholeFile::EndsIn(path, { ".gltf" }))
  {
    this->WriteText(path);
  }
  else
  {
    this->WriteBinary(path);
  }
}

/// The names of textures and buffers in files of their own are relative to the model's folder.
void vtkGLTFDocument::CheckFolder(const std::string& path) const
{
  std::error_code error;
  const auto folderOf = [&error](const std::string& file)
  {
    return std::filesystem::weakly_canonical(
      std::filesystem::absolute(PathOf(file), error).parent_path(), error);
  };
  if (this->Path.empty() || folderOf(this->Path) == folderOf(path))
  {
    return;
  }
  for (const char* list : { "buffers", "images" })
  {
    const auto found = this->Root.find(list);
    for (const Json& item : found == this->Root.end() ? Json::array() : *found)
    {
      const std::string uri = Text(item, "uri");
      if (!uri.empty() && !StartsWith(uri, "data:") && uri.find("://") == std::string::npos)
      {
        BadFile("the model refers to files beside it, such as " + Quoted(WithoutPercent(uri)) +
          "; write the result into the same folder");
      }
    }
  }
}

/// A binary file has one buffer inside it: all bytes become that one.
void vtkGLTFDocument::MergeBuffers()
{
  Bytes all;
  std::vector<std::size_t> starts;
  for (const Bytes& bytes : this->Buffers)
  {
    Pad(all, 0);
    starts.push_back(all.size());
    all.insert(all.end(), bytes.begin(), bytes.end());
  }
  std::size_t number = 0;
  for (Json& view : this->List("bufferViews"))
  {
    const std::string owner = "bufferView " + std::to_string(number++);
    const std::size_t buffer = Index(view, "buffer", owner);
    this->Item("buffers", buffer, owner);
    view["byteOffset"] = Number(view, "byteOffset", 0, owner) + starts[buffer];
    view["buffer"] = 0;
  }
  this->Root["buffers"] = Json::array({ { { "byteLength", all.size() } } });
  this->Buffers = { std::move(all) };
}

void vtkGLTFDocument::WriteBinary(const std::string& path)
{
  if (!this->Buffers.empty() && !this->Binary)
  {
    this->MergeBuffers();
  }
  Bytes json = BytesOf(this->Root.dump());
  Pad(json, ' ');
  Bytes binary = this->Buffers.empty() ? Bytes() : this->Buffers[0];
  Pad(binary, 0);
  const std::size_t length = GlbHeader + ChunkHeader + json.size() +
    (binary.empty() ? 0 : ChunkHeader + binary.size()) + this->OtherChunks.size();
  if (length > std::numeric_limits<std::uint32_t>::max())
  {
    BadFile("a .glb has at most 4 GB, and this would have " + std::to_string(length) + " bytes");
  }
  const auto append = [](Bytes& to, std::size_t value)
  { AppendLittleEndian(to, static_cast<std::uint32_t>(value)); };
  Bytes head, middle;
  append(head, GlbMagic);
  append(head, 2);
  append(head, length);
  append(head, json.size());
  append(head, JsonChunk);
  if (!binary.empty())
  {
    append(middle, binary.size());
    append(middle, BinaryChunk);
  }
  vtkWholeFile::Save(path, { &head, &json, &middle, &binary, &this->OtherChunks });
}

void vtkGLTFDocument::WriteText(const std::string& path)
{
  for (std::size_t k = 0; k < this->Buffers.size(); ++k)
  {
    Json& buffer = this->Root["buffers"][k];
    if (!buffer.contains("uri") && !this->Buffers[k].empty())
    {
      buffer["uri"] = "data:application/octet-stream;base64," + Encode(this->Buffers[k]);
    }
  }
  const Bytes text = BytesOf(this->Root.dump(2) + "\n");
  vtkWholeFile::Save(path, { &text });
}
