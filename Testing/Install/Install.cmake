# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# cmake -DBUILD=folder -DPREFIX=folder [-DUNINSTALL=ON] -P Install.cmake
#
# Installs into an empty PREFIX; with UNINSTALL also removes it again and fails if something is left. What
# the user has installed from BUILD can still be uninstalled afterwards: CMake's list of it comes back.
cmake_minimum_required(VERSION 3.22)

function (run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction ()

set(manifest "${BUILD}/install_manifest.txt")
set(kept "${PREFIX}.manifest")
file(REMOVE "${kept}")
if (EXISTS "${manifest}")
  file(RENAME "${manifest}" "${kept}")
endif ()

file(REMOVE_RECURSE "${PREFIX}")
run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${PREFIX}")
if (UNINSTALL)
  # Python leaves byte code.
  file(GLOB_RECURSE init "${PREFIX}/__init__.py")
  foreach (file IN LISTS init)
    get_filename_component(folder "${file}" DIRECTORY)
    file(WRITE "${folder}/__pycache__/__init__.pyc" "")
  endforeach ()
  # A file that cannot be removed is an error, and a second try has the list. (Rights do not bind root, so a folder
  # stands for the file.)
  set(blocked "${PREFIX}/share/doc/sphericalstyle/CHANGELOG.md")
  file(REMOVE "${blocked}")
  file(WRITE "${blocked}/file" "")
  execute_process(COMMAND "${CMAKE_COMMAND}" -P "${BUILD}/uninstall.cmake" RESULT_VARIABLE code ERROR_VARIABLE error
    OUTPUT_QUIET)
  if (code EQUAL 0 OR NOT error MATCHES "CHANGELOG.md[ \n]+cannot[ \n]+be[ \n]+removed" OR NOT EXISTS "${manifest}")
    message(FATAL_ERROR "Uninstalling ${blocked} should fail and keep the list of files; it says: ${error}")
  endif ()
  file(REMOVE_RECURSE "${blocked}")
  run("${CMAKE_COMMAND}" -P "${BUILD}/uninstall.cmake")
  if (EXISTS "${PREFIX}")
    file(GLOB_RECURSE left LIST_DIRECTORIES true "${PREFIX}/*")
    message(FATAL_ERROR "Left after uninstalling: ${PREFIX} ${left}")
  endif ()

  # What others have in the same folders stays, also the files of a package that cpack has listed.
  file(WRITE "${PREFIX}/lib/cmake/Other/OtherConfig.cmake" "")
  set(listed "${BUILD}/install_manifest_listed.txt")
  file(WRITE "${listed}" "${PREFIX}/lib/cmake/Other/OtherConfig.cmake")
  run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${PREFIX}")
  run("${CMAKE_COMMAND}" -P "${BUILD}/uninstall.cmake")
  file(REMOVE "${listed}")
  file(GLOB_RECURSE left RELATIVE "${PREFIX}" "${PREFIX}/*")
  if (NOT left STREQUAL "lib/cmake/Other/OtherConfig.cmake")
    message(FATAL_ERROR "Should be left after uninstalling: lib/cmake/Other/OtherConfig.cmake; is: ${left}")
  endif ()
endif ()

file(REMOVE "${manifest}")
if (EXISTS "${kept}")
  file(RENAME "${kept}" "${manifest}")
endif ()
