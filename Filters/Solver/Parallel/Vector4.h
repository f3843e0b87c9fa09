// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Doubles that are worked on together, and functions that are compiled once per instruction set.
///
/// A function marked SPHERICALSTYLE_PER_INSTRUCTION_SET exists for AVX-512, AVX2 and the baseline;
/// the loader picks what the processor has. Elsewhere (Arm, other compilers, sanitizers) there is
/// the baseline alone. What it calls must be inlined (SPHERICALSTYLE_INLINE) to be compiled with
/// it. Results differ between instruction sets by rounding only.
#ifndef SphericalStyle_Vector4_h
#define SphericalStyle_Vector4_h

#include <cstring>

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__linux__) &&       \
  !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// There are instruction sets to choose from.
#define SPHERICALSTYLE_INSTRUCTION_SETS
#define SPHERICALSTYLE_PER_INSTRUCTION_SET                                                         \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define SPHERICALSTYLE_PER_INSTRUCTION_SET
#endif
#define SPHERICALSTYLE_INLINE inline __attribute__((always_inline))

// Nothing here crosses a call: all of it is inlined.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace SphericalStyle
{
/// Two doubles: what every processor has vectors for.
using Vector2 = double __attribute__((vector_size(16), aligned(16)));
/// Four doubles: a vector of three and what follows it in memory.
using Vector4 = double __attribute__((vector_size(32), aligned(32)));
/// Eight doubles: the same number of eight cells.
using Vector8 = double __attribute__((vector_size(64), aligned(64)));

/// p[0..3], which need not be aligned.
SPHERICALSTYLE_INLINE Vector4 Load4(const double* p)
{
  Vector4 x;
  std::memcpy(&x, p, sizeof(x));
  return x;
}

SPHERICALSTYLE_INLINE void Store4(double* p, Vector4 x)
{
  std::memcpy(p, &x, sizeof(x));
}

/// p[0..2] and 0: where nothing may follow.
SPHERICALSTYLE_INLINE Vector4 Load3(const double* p)
{
  return Vector4{ p[0], p[1], p[2], 0.0 };
}

/// The columns of a 3 x 3 matrix of nine doubles; the fourth numbers mean nothing.
struct Columns4
{
  Vector4 x;
  Vector4 y;
  Vector4 z;
};

SPHERICALSTYLE_INLINE Columns4 LoadColumns(const double* matrix)
{
  // The last column is read from the number before it, so that nothing behind it is touched.
  const Vector4 last = Load4(matrix + 5);
#if defined(__clang__) || __GNUC__ >= 12
  return { Load4(matrix), Load4(matrix + 3), __builtin_shufflevector(last, last, 1, 2, 3, 0) };
#else
  using Order = long long __attribute__((vector_size(32)));
  return { Load4(matrix), Load4(matrix + 3), __builtin_shuffle(last, Order{ 1, 2, 3, 0 }) };
#endif
}

SPHERICALSTYLE_INLINE Vector4 operator*(const Columns4& m, const double* v)
{
  return m.x * v[0] + m.y * v[1] + m.z * v[2];
}

SPHERICALSTYLE_INLINE Vector4 operator*(const Columns4& m, const Vector4& v)
{
  return m.x * v[0] + m.y * v[1] + m.z * v[2];
}
} // namespace SphericalStyle

#endif
