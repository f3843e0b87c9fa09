# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# What the sources ask of the compiler, tried rather than read from its name and version. Without C++17 nothing is
# built; all else has a way without it, which is said and taken. GCC and Clang are tested. What is here for Microsoft's
# compiler is written from its documentation and was never run.
#
# Sets options of targets (sphericalstyle_warnings, sphericalstyle_vtk_warnings, sphericalstyle_contraction,
# sphericalstyle_math, sphericalstyle_missing_definitions) and sphericalstyle_vectors, definitions for
# Filters/Solver/Parallel/Vector4.h.
include(CheckCXXCompilerFlag)
include(CheckCXXSourceCompiles)
include(CheckLinkerFlag)

# What compiles with a warning compiles, also where warnings are errors.
set(CMAKE_REQUIRED_FLAGS -w)

# -------------------------------------------------------------------------------------------- C++17
# Some compilers take the option and lack parts of the library.
if ("cxx_std_17" IN_LIST CMAKE_CXX_COMPILE_FEATURES)
  check_cxx_source_compiles([[
    #include <algorithm>
    #include <new>
    #include <optional>
    #include <utility>
    inline int number = 3;
    template <typename T> int Clamped(const std::optional<T>& x)
    {
      if constexpr (sizeof(T) == 1) { return 0; }
      else { return std::clamp(static_cast<int>(*x), 0, number); }
    }
    int main()
    {
      const auto [first, second] = std::pair(1, 2);
      void* memory = ::operator new(64, std::align_val_t(64)); // not on old systems of Apple
      ::operator delete(memory, std::align_val_t(64));
      return first + second - Clamped(std::optional(3));
    }]] SPHERICALSTYLE_HAS_CXX17)
endif ()
if (NOT SPHERICALSTYLE_HAS_CXX17)
  message(FATAL_ERROR "SphericalStyle needs C++17 and its standard library, which ${CMAKE_CXX_COMPILER} "
    "(${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}) does not have. Take another compiler with "
    "-DCMAKE_CXX_COMPILER=... in a new build folder.")
endif ()

unset(CMAKE_REQUIRED_FLAGS)

# ------------------------------------------------------------------------------------------ options
# For our own targets; VTK's generated wrappers are not ours to clean.
if (MSVC)
  set(sphericalstyle_warnings /W4)
else ()
  set(sphericalstyle_warnings)
  foreach (option IN ITEMS -Wall -Wextra -Wpedantic)
    string(MAKE_C_IDENTIFIER "SPHERICALSTYLE_HAS${option}" has)
    check_cxx_compiler_flag(${option} ${has})
    if (${has})
      list(APPEND sphericalstyle_warnings ${option})
    endif ()
  endforeach ()
  # A unity build includes sources, and GCC takes what is local to a source for something local in a header.
  check_cxx_compiler_flag(-Wsubobject-linkage SPHERICALSTYLE_HAS_SUBOBJECT_LINKAGE)
  if (CMAKE_UNITY_BUILD AND SPHERICALSTYLE_HAS_SUBOBJECT_LINKAGE)
    list(APPEND sphericalstyle_warnings -Wno-subobject-linkage)
  endif ()
endif ()
# GCC calls the semicolon behind VTK's type macros an extension: what includes VTK goes without -Wpedantic.
set(sphericalstyle_vtk_warnings ${sphericalstyle_warnings})
list(REMOVE_ITEM sphericalstyle_vtk_warnings -Wpedantic)

# Roots of several numbers at once set no errno.
check_cxx_compiler_flag(-fno-math-errno SPHERICALSTYLE_HAS_NO_MATH_ERRNO)
set(sphericalstyle_math "$<$<BOOL:${SPHERICALSTYLE_HAS_NO_MATH_ERRNO}>:-fno-math-errno>")

# Each product and sum rounded by itself: what tests take that compare bits of two ways to compile.
check_cxx_compiler_flag(-ffp-contract=off SPHERICALSTYLE_HAS_FP_CONTRACT)
set(sphericalstyle_contraction "$<$<BOOL:${SPHERICALSTYLE_HAS_FP_CONTRACT}>:-ffp-contract=off>")

# A missing definition is an error here and not when somebody loads the library. Clang's sanitizers are in the program,
# though, and not in a library.
set(sphericalstyle_missing_definitions)
if (NOT (CMAKE_CXX_COMPILER_ID MATCHES "Clang" AND CMAKE_CXX_FLAGS MATCHES "-fsanitize"))
  check_linker_flag(CXX "LINKER:--no-undefined" SPHERICALSTYLE_HAS_NO_UNDEFINED)
  if (SPHERICALSTYLE_HAS_NO_UNDEFINED)
    set(sphericalstyle_missing_definitions "LINKER:--no-undefined")
  endif ()
endif ()

# ------------------------------------------------------------------------------------------ vectors
option(SPHERICALSTYLE_SCALAR "Take no vectors of the compiler, as with one that has none: slower" OFF)
mark_as_advanced(SPHERICALSTYLE_SCALAR)

# The header itself is tried: whether its vectors compile, and whether system and linker can choose among functions.
set(vectors_try [[
  #include "Vector4.h"
  namespace SphericalStyle
  {
  SPHERICALSTYLE_PER_INSTRUCTION_SET void Twice(const double* from, double* to)
  {
    Store4(to, Load4(from) * 2.0 + LoadColumns(from) * from + Magnitude(Vector8{})[0]);
  }
  #ifdef SPHERICALSTYLE_INSTRUCTION_SETS
  SPHERICALSTYLE_FOR_AVX2 void First(const double* from, double* to) { Store4(to, Load4(from)); }
  SPHERICALSTYLE_FOR_AVX512 void Second(const double* from, double* to) { Store4(to, Load4(from)); }
  #else
  void First(const double*, double*) {}
  void Second(const double*, double*) {}
  bool HasAvx2() { return false; }
  bool HasAvx512() { return false; }
  #endif
  }
  int main()
  {
    double x[16] = {};
    SphericalStyle::Twice(x, x + 12);
    (SphericalStyle::HasAvx512() ? SphericalStyle::Second : SphericalStyle::First)(x, x + 12);
    return SphericalStyle::HasAvx2() ? 0 : static_cast<int>(x[12]);
  }]])
set(CMAKE_REQUIRED_FLAGS -w)
set(CMAKE_REQUIRED_INCLUDES "${CMAKE_CURRENT_SOURCE_DIR}/Filters/Solver/Parallel")
check_cxx_source_compiles("${vectors_try}" SPHERICALSTYLE_HAS_VECTORS)
set(sphericalstyle_vectors)
if (SPHERICALSTYLE_SCALAR)
  set(sphericalstyle_vectors SPHERICALSTYLE_SCALAR)
elseif (NOT SPHERICALSTYLE_HAS_VECTORS)
  set(CMAKE_REQUIRED_DEFINITIONS -DSPHERICALSTYLE_BASELINE)
  check_cxx_source_compiles("${vectors_try}" SPHERICALSTYLE_HAS_BASELINE_VECTORS)
  unset(CMAKE_REQUIRED_DEFINITIONS)
  if (SPHERICALSTYLE_HAS_BASELINE_VECTORS)
    set(sphericalstyle_vectors SPHERICALSTYLE_BASELINE)
    message(STATUS "SphericalStyle: one instruction set, since this compiler cannot choose while a program runs")
  else ()
    set(sphericalstyle_vectors SPHERICALSTYLE_SCALAR)
    message(STATUS "SphericalStyle: no vectors, since this compiler has none: the solver is slower")
  endif ()
endif ()
unset(CMAKE_REQUIRED_FLAGS)
unset(CMAKE_REQUIRED_INCLUDES)
