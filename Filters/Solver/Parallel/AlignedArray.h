// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Memory for vectors.
#ifndef SphericalStyle_AlignedArray_h
#define SphericalStyle_AlignedArray_h

#include "Process.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>

namespace SphericalStyle
{
/// An array of numbers that starts at a multiple of 64 bytes and is not initialized. A large one is
/// in huge pages where the system has them: touching small ones for the first time takes longer
/// than writing to them.
template <typename T>
class AlignedArray
{
public:
  /// Keeps what is there only if it is as large already. @throw std::bad_alloc
  void Resize(std::size_t size)
  {
    if (size != this->Size)
    {
      this->Memory.reset();
      this->Size = 0;
      const std::size_t bytes = std::max<std::size_t>(size * sizeof(T), 1);
      const bool large = bytes >= 2 * HugePage;
      const std::align_val_t alignment{ large ? HugePage : Alignment };
      this->Memory = { static_cast<T*>(::operator new(bytes, alignment)), { alignment } };
      this->Size = size;
      if (large)
      {
        UseHugePages(this->Memory.get(), bytes / HugePage * HugePage);
      }
    }
  }
  T* Get() const { return this->Memory.get(); }
  std::size_t GetSize() const { return this->Size; }

private:
  static constexpr std::size_t Alignment = 64;
  static constexpr std::size_t HugePage = std::size_t(2) << 20;

  struct Delete
  {
    void operator()(T* memory) const { ::operator delete(memory, this->alignment); }
    std::align_val_t alignment{ Alignment };
  };
  std::unique_ptr<T, Delete> Memory;
  std::size_t Size = 0;
};
} // namespace SphericalStyle

#endif
