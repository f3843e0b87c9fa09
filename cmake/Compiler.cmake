# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Tests which features the compiler has, instead of relying on its name and version. C++17 is required. Every other
# feature has a fallback, and a message says if it is used. GCC and Clang are tested. The code for Microsoft's compiler
# follows its documentation and was never run.
#
# Sets options of targets (sphericalstyle_warnings, sphericalstyle_vtk_warnings, sphericalstyle_contraction,
# sphericalstyle_math, sphericalstyle_missing_definitions) and sphericalstyle_vectors, definitions for
# Filters/Solver/Parallel/Vector4.h.
include(CheckCXXCompilerFlag)
include(CheckCXXSourceCompiles)
include(CheckLinkerFlag)

# A test program that compiles with warnings counts as compiled, even if warnings are errors.
set(CMAKE_REQUIRED_FLAGS -w)

# -------------------------------------------------------------------------------------------- C++17
# Some compilers accept the option but lack parts of the library.
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
    "(${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}) does not have. Choose another compiler with "
    "-DCMAKE_CXX_COMPILER=... in a new build folder.")
endif ()

unset(CMAKE_REQUIRED_FLAGS)

# ------------------------------------------------------------------------------------------ options
# Warnings for our own targets only: we cannot fix VTK's generated wrappers.
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
  # A unity build includes sources, and GCC mistakes local names of an included source for local names in a header.
  check_cxx_compiler_flag(-Wsubobject-linkage SPHERICALSTYLE_HAS_SUBOBJECT_LINKAGE)
  if (CMAKE_UNITY_BUILD AND SPHERICALSTYLE_HAS_SUBOBJECT_LINKAGE)
    list(APPEND sphericalstyle_warnings -Wno-subobject-linkage)
  endif ()
endif ()
# GCC warns that the semicolon after VTK's type macros is an extension, so code that includes VTK goes without
# -Wpedantic.
set(sphericalstyle_vtk_warnings ${sphericalstyle_warnings})
list(REMOVE_ITEM sphericalstyle_vtk_warnings -Wpedantic)

# Without errno the compiler can compute several square roots at once.
check_cxx_compiler_flag(-fno-math-errno SPHERICALSTYLE_HAS_NO_MATH_ERRNO)
set(sphericalstyle_math "$<$<BOOL:${SPHERICALSTYLE_HAS_NO_MATH_ERRNO}>:-fno-math-errno>")

# Rounds each product and sum separately. Tests use this to compare the bits of two compilations.
check_cxx_compiler_flag(-ffp-contract=off SPHERICALSTYLE_HAS_FP_CONTRACT)
set(sphericalstyle_contraction "$<$<BOOL:${SPHERICALSTYLE_HAS_FP_CONTRACT}>:-ffp-contract=off>")

# Makes a missing definition an error when we link, not when a user loads the library. This does not work with Clang's
# sanitizers, whose functions are in the program and not in a library.
set(sphericalstyle_missing_definitions)
if (NOT (CMAKE_CXX_COMPILER_ID MATCHES "Clang" AND CMAKE_CXX_FLAGS MATCHES "-fsanitize"))
  check_linker_flag(CXX "LINKER:--no-undefined" SPHERICALSTYLE_HAS_NO_UNDEFINED)
  if (SPHERICALSTYLE_HAS_NO_UNDEFINED)
    set(sphericalstyle_missing_definitions "LINKER:--no-undefined")
  endif ()
endif ()

# ------------------------------------------------------------------------------------------ vectors
option(SPHERICALSTYLE_SCALAR "Do not use the compiler's vector extensions (slower)" OFF)
mark_as_advanced(SPHERICALSTYLE_SCALAR)

# Tests the header itself: whether its vectors compile, and whether system and linker can choose between versions of a
# function at run time.
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
    message(STATUS "SphericalStyle: one instruction set, since this compiler cannot choose one at run time")
  else ()
    set(sphericalstyle_vectors SPHERICALSTYLE_SCALAR)
    message(STATUS "SphericalStyle: this compiler has no vector extensions, so the solver is slower")
  endif ()
endif ()
unset(CMAKE_REQUIRED_FLAGS)
unset(CMAKE_REQUIRED_INCLUDES)
