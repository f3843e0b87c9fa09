// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkZipArchive.h"

#include "vtkWholeFile.h"

#include "vtkNew.h"
#include "vtkZLibDataCompressor.h"

#include <array>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace
{
using ZipBytes = vtkWholeFile::Bytes;

constexpr std::uint32_t FileSignature = 0x04034B50;
constexpr std::uint32_t ContentsSignature = 0x02014B50;
constexpr std::uint32_t EndSignature = 0x06054B50;
constexpr std::uint16_t ZipVersion = 20; // 2.0 knows folders and deflate
constexpr std::uint16_t Deflate = 8;
constexpr std::uint16_t FirstDay = 0x21; // 1980-01-01: equal models make equal files
constexpr std::size_t MostBytes = std::numeric_limits<std::uint32_t>::max();

/// Little-endian, whatever the machine is.
template <typename Number>
void AppendNumber(ZipBytes& bytes, Number value)
{
  for (std::size_t k = 0; k < sizeof(value); ++k)
  {
    bytes.push_back(static_cast<unsigned char>(value >> 8 * k & 0xFFU));
  }
}

void AppendText(ZipBytes& bytes, const std::string& text)
{
  bytes.insert(bytes.end(), text.begin(), text.end());
}

/// CRC-32 of ISO 3309, as zip has it.
std::uint32_t Checksum(const std::string& text)
{
  std::array<std::uint32_t, 256> table;
  for (std::uint32_t byte = 0; byte < table.size(); ++byte)
  {
    std::uint32_t rest = byte;
    for (int bit = 0; bit < 8; ++bit)
    {
      rest = rest >> 1U ^ ((rest & 1U) != 0 ? 0xEDB88320U : 0U);
    }
    table[byte] = rest;
  }
  std::uint32_t sum = 0xFFFFFFFFU;
  for (const char c : text)
  {
    sum = table[(sum ^ static_cast<unsigned char>(c)) & 0xFFU] ^ sum >> 8U;
  }
  return ~sum;
}

/// The text as zip wants it: a stream of deflate without the two bytes that zlib puts before it and
/// the four behind it (RFC 1950).
ZipBytes Deflated(const std::string& text)
{
  constexpr std::size_t Before = 2;
  constexpr std::size_t Behind = 4;
  vtkNew<vtkZLibDataCompressor> zlib;
  ZipBytes bytes(zlib->GetMaximumCompressionSpace(text.size()));
  const std::size_t size = zlib->Compress(
    reinterpret_cast<const unsigned char*>(text.data()), // NOLINT(*-reinterpret-cast)
    text.size(), bytes.data(), bytes.size());
  if (size <= Before + Behind)
  {
    throw std::runtime_error("zlib cannot compress the model");
  }
  return { bytes.begin() + Before, bytes.begin() + static_cast<std::ptrdiff_t>(size - Behind) };
}

void CheckZipSize(std::size_t size)
{
  if (size > MostBytes)
  {
    throw std::runtime_error("a zip file has at most 4 GB, and this would have " +
      std::to_string(size) + " bytes; write another format, or fewer triangles");
  }
}
}

void vtkZipArchive::Add(const std::string& name, const std::string& text)
{
  CheckZipSize(text.size());
  const ZipBytes packed = Deflated(text);
  CheckZipSize(this->Files.size() + packed.size());
  // What the header of the file and its entry in the contents have in common.
  ZipBytes common;
  AppendNumber(common, ZipVersion);
  AppendNumber<std::uint16_t>(common, 0); // flags
  AppendNumber(common, Deflate);
  AppendNumber<std::uint16_t>(common, 0); // midnight
  AppendNumber(common, FirstDay);
  AppendNumber(common, Checksum(text));
  AppendNumber(common, static_cast<std::uint32_t>(packed.size()));
  AppendNumber(common, static_cast<std::uint32_t>(text.size()));
  AppendNumber(common, static_cast<std::uint16_t>(name.size()));
  AppendNumber<std::uint16_t>(common, 0); // further fields

  AppendNumber(this->Contents, ContentsSignature);
  AppendNumber(this->Contents, ZipVersion); // that made it, on a system without permissions
  this->Contents.insert(this->Contents.end(), common.begin(), common.end());
  AppendNumber<std::uint16_t>(this->Contents, 0); // length of a comment
  AppendNumber<std::uint16_t>(this->Contents, 0); // disk
  AppendNumber<std::uint16_t>(this->Contents, 0); // internal attributes
  AppendNumber<std::uint32_t>(this->Contents, 0); // external attributes
  AppendNumber(this->Contents, static_cast<std::uint32_t>(this->Files.size()));
  AppendText(this->Contents, name);

  AppendNumber(this->Files, FileSignature);
  this->Files.insert(this->Files.end(), common.begin(), common.end());
  AppendText(this->Files, name);
  this->Files.insert(this->Files.end(), packed.begin(), packed.end());
  ++this->Count;
}

void vtkZipArchive::Write(const std::string& path) const
{
  CheckZipSize(this->Files.size());
  ZipBytes end;
  AppendNumber(end, EndSignature);
  AppendNumber<std::uint16_t>(end, 0); // this disk
  AppendNumber<std::uint16_t>(end, 0); // that of the contents
  AppendNumber(end, this->Count);
  AppendNumber(end, this->Count);
  AppendNumber(end, static_cast<std::uint32_t>(this->Contents.size()));
  AppendNumber(end, static_cast<std::uint32_t>(this->Files.size()));
  AppendNumber<std::uint16_t>(end, 0); // length of a comment
  vtkWholeFile::Save(path, { &this->Files, &this->Contents, &end });
}
