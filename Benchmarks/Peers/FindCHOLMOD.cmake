# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
# SuiteSparse brings no CMake package before version 7. Defines the target SuiteSparse::CHOLMOD.
find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(CHOLMOD_LIBRARY cholmod)
mark_as_advanced(CHOLMOD_INCLUDE_DIR CHOLMOD_LIBRARY)

if (CHOLMOD_INCLUDE_DIR)
  set(CHOLMOD_VERSION)
  file(GLOB cholmod_headers
    "${CHOLMOD_INCLUDE_DIR}/cholmod.h" "${CHOLMOD_INCLUDE_DIR}/cholmod_core.h")
  foreach (part IN ITEMS MAIN SUB SUBSUB)
    foreach (header IN LISTS cholmod_headers)
      file(STRINGS "${header}" line REGEX "#define CHOLMOD_${part}_VERSION +[0-9]+")
      if (line MATCHES "VERSION +([0-9]+)")
        list(APPEND CHOLMOD_VERSION ${CMAKE_MATCH_1})
      endif ()
    endforeach ()
  endforeach ()
  list(JOIN CHOLMOD_VERSION "." CHOLMOD_VERSION)
endif ()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CHOLMOD
  REQUIRED_VARS CHOLMOD_LIBRARY CHOLMOD_INCLUDE_DIR
  VERSION_VAR CHOLMOD_VERSION)

if (CHOLMOD_FOUND AND NOT TARGET SuiteSparse::CHOLMOD)
  add_library(SuiteSparse::CHOLMOD UNKNOWN IMPORTED)
  set_target_properties(SuiteSparse::CHOLMOD PROPERTIES
    IMPORTED_LOCATION "${CHOLMOD_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${CHOLMOD_INCLUDE_DIR}")
endif ()
