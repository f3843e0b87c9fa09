// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A zip file with some files of text in it (PKWARE's APPNOTE 6.3), compressed by VTK's own zlib,
/// so that the build needs no library for it. Private.
#ifndef vtkZipArchive_h
#define vtkZipArchive_h

#include <cstdint>
#include <string>
#include <vector>

class vtkZipArchive
{
public:
  /// @param name  ASCII, folders with /
  /// @throw std::runtime_error where the text or the archive has more than 4 GB
  void Add(const std::string& name, const std::string& text);

  /// @throw std::runtime_error where it cannot be written
  void Write(const std::string& path) const;

private:
  std::vector<unsigned char> Files;    // each behind its header
  std::vector<unsigned char> Contents; // the central directory
  std::uint16_t Count = 0;
};

#endif
