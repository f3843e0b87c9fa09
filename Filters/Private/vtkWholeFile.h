// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the writers do alike: names and files. Private.
#ifndef vtkWholeFile_h
#define vtkWholeFile_h

#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

namespace vtkWholeFile
{
using Bytes = std::vector<unsigned char>;

/// Whether the name has one of these endings, in capitals or not, and something in front of it.
/// @param endings  in small letters, with the dot
bool EndsIn(std::string name, std::initializer_list<const char*> endings);

/// Calls, with the name of the file before messages.
void Naming(const char* file, const std::function<void()>& call);

/// Writes the parts one after another, all of them or none: the file gets its name when it is
/// complete, so that after a failure there is the one of before or none. A link is replaced, not
/// followed.
/// @param path  UTF-8
/// @throw std::runtime_error where it cannot be written
void Save(const std::string& path, std::initializer_list<const Bytes*> parts);
}

#endif
