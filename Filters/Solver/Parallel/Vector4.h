// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Numbers that are worked on together, and functions that are compiled once per instruction set:
/// the only file that knows one compiler from another.
///
/// Vectors are those of GCC and Clang. Other compilers, and SPHERICALSTYLE_SCALAR, take a twin that
/// does the same operations in the same order, number by number. Bits are the same wherever no
/// compiler fuses a product and a sum: it may where the processor can, and not in the same places.
///
/// A function marked SPHERICALSTYLE_PER_INSTRUCTION_SET exists for AVX-512, AVX2 and the baseline;
/// the loader picks what the processor has. Elsewhere (Arm, other compilers, sanitizers) and with
/// SPHERICALSTYLE_BASELINE there is the baseline alone. What it calls must be inlined
/// (SPHERICALSTYLE_INLINE) to be compiled with it. Results differ between instruction sets by
/// rounding only.
#ifndef SphericalStyle_Vector4_h
#define SphericalStyle_Vector4_h

#include <cstring>
#include <functional>

#if !defined(__GNUC__) && !defined(__clang__) && !defined(SPHERICALSTYLE_SCALAR)
#define SPHERICALSTYLE_SCALAR
#endif

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__linux__) &&       \
  !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) &&                               \
  !defined(SPHERICALSTYLE_SCALAR) && !defined(SPHERICALSTYLE_BASELINE)
/// There are instruction sets to choose from.
#define SPHERICALSTYLE_INSTRUCTION_SETS
#define SPHERICALSTYLE_PER_INSTRUCTION_SET                                                         \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
/// A function of one instruction set, which is only called where the processor has it.
#define SPHERICALSTYLE_FOR_AVX2 __attribute__((target("arch=x86-64-v3")))
#define SPHERICALSTYLE_FOR_AVX512 __attribute__((target("arch=x86-64-v4")))
#else
#define SPHERICALSTYLE_PER_INSTRUCTION_SET
#endif

// What is here for Microsoft's compiler is written from its documentation and was never compiled.
#if defined(__GNUC__) || defined(__clang__)
#define SPHERICALSTYLE_INLINE inline __attribute__((always_inline))
#elif defined(_MSC_VER)
#define SPHERICALSTYLE_INLINE __forceinline
#else
#define SPHERICALSTYLE_INLINE inline
#endif

#if !defined(SPHERICALSTYLE_SCALAR)
// Nothing here crosses a call: all of it is inlined.
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace SphericalStyle
{
#ifdef SPHERICALSTYLE_INSTRUCTION_SETS
inline bool HasAvx2()
{
  return __builtin_cpu_supports("x86-64-v3");
}
inline bool HasAvx512()
{
  return __builtin_cpu_supports("x86-64-v4");
}
#endif

#ifndef SPHERICALSTYLE_SCALAR
/// Two doubles: what every processor has vectors for.
using Vector2 = double __attribute__((vector_size(16), aligned(16)));
/// Four doubles: a vector of three and what follows it in memory.
using Vector4 = double __attribute__((vector_size(32), aligned(32)));
/// Eight doubles: the same number of eight cells.
using Vector8 = double __attribute__((vector_size(64), aligned(64)));
/// The same in single precision.
using Float4 = float __attribute__((vector_size(16), aligned(16)));
using Float8 = float __attribute__((vector_size(32), aligned(32)));

SPHERICALSTYLE_INLINE Vector8 Magnitude(const Vector8& x)
{
  return x < 0.0 ? -x : x;
}
#else
/// Stands for the vectors of the compiler, with what is used of them. Not initialized, as they.
template <typename Scalar, int Width>
struct alignas(Width * sizeof(Scalar)) ScalarVector
{
  Scalar lane[Width];

  SPHERICALSTYLE_INLINE Scalar& operator[](int k) { return this->lane[k]; }
  SPHERICALSTYLE_INLINE const Scalar& operator[](int k) const { return this->lane[k]; }

  friend SPHERICALSTYLE_INLINE ScalarVector operator-(const ScalarVector& a)
  {
    ScalarVector result;
    for (int k = 0; k < Width; ++k)
    {
      result[k] = -a[k];
    }
    return result;
  }
  friend SPHERICALSTYLE_INLINE ScalarVector operator+(const ScalarVector& a, const ScalarVector& b)
  {
    return ForEach(a, b, std::plus<>());
  }
  friend SPHERICALSTYLE_INLINE ScalarVector operator-(const ScalarVector& a, const ScalarVector& b)
  {
    return ForEach(a, b, std::minus<>());
  }
  friend SPHERICALSTYLE_INLINE ScalarVector operator*(const ScalarVector& a, const ScalarVector& b)
  {
    return ForEach(a, b, std::multiplies<>());
  }
  friend SPHERICALSTYLE_INLINE ScalarVector operator/(const ScalarVector& a, const ScalarVector& b)
  {
    return ForEach(a, b, std::divides<>());
  }
  friend SPHERICALSTYLE_INLINE ScalarVector operator+(const ScalarVector& a, Scalar b)
  {
    return a + Same(b);
  }
  friend SPHERICALSTYLE_INLINE ScalarVector operator-(const ScalarVector& a, Scalar b)
  {
    return a - Same(b);
  }
  friend SPHERICALSTYLE_INLINE ScalarVector operator-(Scalar a, const ScalarVector& b)
  {
    return Same(a) - b;
  }
  friend SPHERICALSTYLE_INLINE ScalarVector operator*(const ScalarVector& a, Scalar b)
  {
    return a * Same(b);
  }
  friend SPHERICALSTYLE_INLINE ScalarVector operator*(Scalar a, const ScalarVector& b)
  {
    return Same(a) * b;
  }
  SPHERICALSTYLE_INLINE ScalarVector& operator+=(const ScalarVector& b)
  {
    return *this = *this + b;
  }
  SPHERICALSTYLE_INLINE ScalarVector& operator-=(const ScalarVector& b)
  {
    return *this = *this - b;
  }
  SPHERICALSTYLE_INLINE ScalarVector& operator*=(Scalar b) { return *this = *this * b; }
  SPHERICALSTYLE_INLINE ScalarVector& operator/=(const ScalarVector& b)
  {
    return *this = *this / b;
  }

private:
  SPHERICALSTYLE_INLINE static ScalarVector Same(Scalar x)
  {
    ScalarVector result;
    for (Scalar& lane : result.lane)
    {
      lane = x;
    }
    return result;
  }
  template <typename Operation>
  SPHERICALSTYLE_INLINE static ScalarVector ForEach(
    const ScalarVector& a, const ScalarVector& b, const Operation& operation)
  {
    ScalarVector result;
    for (int k = 0; k < Width; ++k)
    {
      result[k] = operation(a[k], b[k]);
    }
    return result;
  }
};

using Vector2 = ScalarVector<double, 2>;
using Vector4 = ScalarVector<double, 4>;
using Vector8 = ScalarVector<double, 8>;
using Float4 = ScalarVector<float, 4>;
using Float8 = ScalarVector<float, 8>;

SPHERICALSTYLE_INLINE Vector8 Magnitude(const Vector8& x)
{
  Vector8 result = x;
  for (double& lane : result.lane)
  {
    lane = lane < 0.0 ? -lane : lane;
  }
  return result;
}
#endif

/// p[0..3], which need not be aligned.
SPHERICALSTYLE_INLINE Vector4 Load4(const double* p)
{
  Vector4 x;
  std::memcpy(&x, p, sizeof(x));
  return x;
}

SPHERICALSTYLE_INLINE Float4 Load4(const float* p)
{
  Float4 x;
  std::memcpy(&x, p, sizeof(x));
  return x;
}

SPHERICALSTYLE_INLINE void Store4(double* p, const Vector4& x)
{
  std::memcpy(p, &x, sizeof(x));
}

SPHERICALSTYLE_INLINE void Store4(float* p, const Float4& x)
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

#if !defined(SPHERICALSTYLE_SCALAR) && (defined(__clang__) || __GNUC__ >= 12)
#define SPHERICALSTYLE_SHUFFLES
#endif

SPHERICALSTYLE_INLINE Columns4 LoadColumns(const double* matrix)
{
  // The last column is read from the number before it, so that nothing behind it is touched.
  const Vector4 last = Load4(matrix + 5);
#ifdef SPHERICALSTYLE_SHUFFLES
  return { Load4(matrix), Load4(matrix + 3), __builtin_shufflevector(last, last, 1, 2, 3, 0) };
#else
  return { Load4(matrix), Load4(matrix + 3), Vector4{ last[1], last[2], last[3], last[0] } };
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

/// The sum of the numbers of each of four vectors: halves first, then neighbors.
/// @tparam Four  vectors of four numbers @tparam Eight  of eight of the same
template <typename Four, typename Eight>
SPHERICALSTYLE_INLINE Four SumEach(const Eight* a)
{
#ifdef SPHERICALSTYLE_SHUFFLES
  Four half[4];
  for (int i = 0; i < 4; ++i)
  {
    half[i] = __builtin_shufflevector(a[i], a[i], 0, 1, 2, 3) +
      __builtin_shufflevector(a[i], a[i], 4, 5, 6, 7);
  }
  const Four first = __builtin_shufflevector(half[0], half[1], 0, 4, 2, 6) +
    __builtin_shufflevector(half[0], half[1], 1, 5, 3, 7);
  const Four second = __builtin_shufflevector(half[2], half[3], 0, 4, 2, 6) +
    __builtin_shufflevector(half[2], half[3], 1, 5, 3, 7);
  return __builtin_shufflevector(first, second, 0, 1, 4, 5) +
    __builtin_shufflevector(first, second, 2, 3, 6, 7);
#else
  Four sum;
  for (int i = 0; i < 4; ++i)
  {
    sum[i] =
      ((a[i][0] + a[i][4]) + (a[i][1] + a[i][5])) + ((a[i][2] + a[i][6]) + (a[i][3] + a[i][7]));
  }
  return sum;
#endif
}
} // namespace SphericalStyle

#endif
