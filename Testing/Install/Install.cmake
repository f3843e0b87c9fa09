# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# cmake -DBUILD=folder -DPREFIX=folder [-DUNINSTALL=ON] [-DPVSERVER=file] [-DPVPYTHON=file] -P Install.cmake
#
# Installs into a PREFIX that is empty but for these programs of ParaView; with UNINSTALL first without them, also
# removes it again and fails if something is left. What the user has installed from BUILD can still be uninstalled
# afterwards: CMake's list of it comes back.
cmake_minimum_required(VERSION 3.22)

function (run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction ()

# ParaView looks beside its programs, so links to the plugin and the macros are installed there, and only there.
function (copy_paraview)
  if (PVSERVER)
    file(MAKE_DIRECTORY "${PREFIX}/bin")
    run("${CMAKE_COMMAND}" -E copy ${PVSERVER} ${PVPYTHON} "${PREFIX}/bin") # what links stand for
  endif ()
endfunction ()
function (check_links)
  file(GLOB links RELATIVE "${PREFIX}/bin" "${PREFIX}/bin/plugins/*" "${PREFIX}/bin/Macros/*.py")
  list(LENGTH links count)
  if (PVSERVER AND EXISTS "${PREFIX}/bin/pvserver")
    if (NOT "plugins/SphericalStyle" IN_LIST links OR count LESS 2)
      message(FATAL_ERROR "Links to the plugin and macros are missing beside ParaView's programs; there are: ${links}")
    endif ()
  elseif (links)
    message(FATAL_ERROR "Without ParaView's programs nobody needs these links: ${links}")
  endif ()
endfunction ()

set(manifest "${BUILD}/install_manifest.txt")
set(kept "${PREFIX}.manifest")
file(REMOVE "${kept}")
if (EXISTS "${manifest}")
  file(RENAME "${manifest}" "${kept}")
endif ()

file(REMOVE_RECURSE "${PREFIX}")
if (NOT UNINSTALL)
  copy_paraview()
endif ()
run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${PREFIX}")
check_links()
foreach (page IN ITEMS README.md CHANGELOG.md)
  file(STRINGS "${PREFIX}/share/doc/sphericalstyle/${page}" lines REGEX "\\(Filters/Documentation/")
  string(REGEX MATCHALL "\\(Filters/Documentation/[^)#]+" links "${lines}")
  foreach (link IN LISTS links)
    string(SUBSTRING "${link}" 1 -1 link)
    if (NOT EXISTS "${PREFIX}/share/doc/sphericalstyle/${link}")
      message(FATAL_ERROR "The installed ${page} names ${link}, which was not installed")
    endif ()
  endforeach ()
  if (NOT links)
    message(FATAL_ERROR "The installed ${page} has no links to pages")
  endif ()
endforeach ()
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
  copy_paraview()
  file(GLOB_RECURSE others RELATIVE "${PREFIX}" "${PREFIX}/*")
  run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${PREFIX}")
  check_links()
  run("${CMAKE_COMMAND}" -P "${BUILD}/uninstall.cmake")
  file(REMOVE "${listed}")
  file(GLOB_RECURSE left RELATIVE "${PREFIX}" "${PREFIX}/*")
  if (NOT left STREQUAL others)
    message(FATAL_ERROR "Should be left after uninstalling: ${others}; is: ${left}")
  endif ()
endif ()

file(REMOVE "${manifest}")
if (EXISTS "${kept}")
  file(RENAME "${kept}" "${manifest}")
endif ()
