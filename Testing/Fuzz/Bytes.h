// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Numbers, flags and choices read from bytes, one after the other; zeros when there are no more.
#ifndef Bytes_h
#define Bytes_h

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

class Bytes
{
public:
  Bytes(const std::uint8_t* data, std::size_t size)
    : Data(data)
    , Size(size)
  {
  }

  std::size_t Left() const { return this->Size; }

  int Byte()
  {
    if (this->Size == 0)
    {
      return 0;
    }
    --this->Size;
    return *this->Data++;
  }

  /// 0, ..., n - 1
  int Below(int n) { return this->Byte() % n; }

  bool Flag() { return this->Byte() % 2 == 1; }

  /// 0..1
  double Share() { return this->Byte() / 255.0; }

  /// A sixteenth of a small whole number.
  double Small() { return (this->Byte() - 128) / 16.0; }

  /// Any double: small, one of those that break things, or by its bits.
  double Any()
  {
    using Limits = std::numeric_limits<double>;
    constexpr double special[] = { 0.0, -0.0, 1e-300, Limits::denorm_min(), Limits::min(), 1e-30,
      1e-12, 0.5, 1.0, 50.0, 1e6, 1e30, 1e38, 3e38, 1e150, 1e299, 1e300, -1e300, 1.1e300,
      Limits::max(), Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN() };
    const int kind = this->Byte();
    if (kind < 128)
    {
      return this->Small();
    }
    if (kind < 240)
    {
      return special[this->Below(sizeof(special) / sizeof(special[0]))];
    }
    std::uint64_t bits = 0;
    for (int shift = 0; shift < 64; shift += 8)
    {
      bits |= static_cast<std::uint64_t>(this->Byte()) << shift;
    }
    double number;
    std::memcpy(&number, &bits, sizeof(number));
    return number;
  }

private:
  const std::uint8_t* Data;
  std::size_t Size;
};

#endif
