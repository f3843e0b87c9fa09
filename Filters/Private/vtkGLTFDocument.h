// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A glTF file: its JSON, which stays as it is but for what we add, and the bytes of its buffers.
/// Private, and with vtkGLTFScene and vtkGLTFTargets the only code that includes the JSON library.
#ifndef vtkGLTFDocument_h
#define vtkGLTFDocument_h

// VTK's headers include VTK's own copy of the library since 9.4, and two copies do not compile
// together.
#if __has_include(<vtk_nlohmannjson.h>)
#include <vtk_nlohmannjson.h>
#include VTK_NLOHMANN_JSON(json.hpp)
#else
#include <nlohmann/json.hpp>
#endif

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

class vtkGLTFDocument
{
public:
  using Json = nlohmann::ordered_json; // keeps the order of the file
  using Bytes = std::vector<unsigned char>;

  /// A document without anything in it.
  vtkGLTFDocument();

  /// @param path  of a .glb or .gltf, told apart by content
  /// @throw std::runtime_error saying what is wrong with the file. Only what is read is checked.
  static vtkGLTFDocument Read(const std::string& path);

  /// Writes .gltf where the name ends so, and .glb else.
  /// @throw std::runtime_error where it cannot be written, or would lose files that it refers to
  void Write(const std::string& path);

  Json Root;

  /// Root[list][index]. @param owner  what names it, for the message
  /// @throw std::runtime_error where there is no such item
  const Json& Item(const char* list, std::size_t index, const std::string& owner) const;
  Json& Item(const char* list, std::size_t index, const std::string& owner);

  /// A whole number, or `missing` where the key is absent.
  /// @throw std::runtime_error where it is something else
  static std::size_t Number(
    const Json& object, const char* key, std::size_t missing, const std::string& owner);
  /// The number of an item. @throw std::runtime_error where it is absent or something else
  static std::size_t Index(const Json& object, const char* key, const std::string& owner);
  static constexpr std::size_t None = SIZE_MAX;
  /// A text, empty where the key is absent or has something else.
  static std::string Text(const Json& object, const char* key);
  /// A list of objects, an empty one where the key is absent.
  /// @throw std::runtime_error where it is something else
  static Json Objects(const Json& object, const char* key, const std::string& owner);

  /// The elements of an accessor, one after another; normalized integers as shares of one.
  /// @param type  "VEC3", ...
  /// @throw std::runtime_error naming the accessor where it is of another type, is compressed or
  ///        leads out of its buffer
  std::vector<double> Values(std::size_t accessor, const char* type) const;
  std::size_t NumberOfElements(std::size_t accessor) const;

  /// What an accessor is for.
  enum class Use
  {
    Vertices, ///< of a primitive
    Indices,
    Animation
  };
  /// Adds an accessor with its buffer view and its bytes. @return its number
  /// @param bounds  whether to say what its smallest and largest numbers are
  std::size_t AddFloats(
    const std::vector<float>& values, const char* type, Use use, bool bounds = false);
  std::size_t AddIndices(const std::vector<std::uint32_t>& values);
  std::size_t AddColors(const Bytes& rgba);

  /// Root[list], made if it is not there.
  Json& List(const char* list);

private:
  struct Range // in a buffer
  {
    const unsigned char* First;
    std::size_t Size;
  };

  void ReadBinary(const Bytes& file);
  void ParseJson(const unsigned char* first, std::size_t size);
  void ReadBuffers();
  Bytes ReadUri(const std::string& uri, const std::string& owner) const;
  Range View(std::size_t view, const std::string& owner) const;
  std::size_t NumberOfBytes() const; // of all buffers
  void Replace(const Json& sparse, std::size_t components, std::vector<double>& values,
    std::size_t componentType, bool normalized, const std::string& owner) const;
  std::size_t AddAccessor(const void* data, std::size_t size, const Json& accessor, Use use);
  std::size_t BufferToFill();
  void MergeBuffers();
  void CheckFolder(const std::string& path) const;
  void WriteBinary(const std::string& path);
  void WriteText(const std::string& path);

  std::string Path;           // that it was read from
  std::vector<Bytes> Buffers; // of Root["buffers"]
  Bytes OtherChunks;          // of a binary file, kept as they are
  bool Binary = false;        // buffer 0 is the chunk of a binary file
  std::size_t Filled = None;  // the buffer that takes what is added
};

#endif
