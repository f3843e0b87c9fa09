# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Include this before find_package(ParaView). Since Debian 13, ParaView's and VTK's Python modules have names such as
# vtkCommonCore.cpython-313-x86_64-linux-gnu.so, but ParaView's CMake files stop with an error if there is no
# vtkCommonCore.so. We link none of these modules. CMake 3.28 and later skip the check for a target with an
# xcframework, so this names a folder as xcframework for the modules that exist under their longer name.
foreach (modules IN ITEMS VTK=vtkmodules ParaView=paraview/modules ParaView=paraview/incubator)
  string(REGEX MATCH "(.*)=(.*)" matched "${modules}")
  set(namespace "${CMAKE_MATCH_1}")
  set(modules_folder "/usr/lib/python3/dist-packages/${CMAKE_MATCH_2}")
  file(GLOB modules RELATIVE "${modules_folder}" "${modules_folder}/*.cpython-*.so")
  foreach (module IN LISTS modules)
    string(REGEX REPLACE "\\..*" "" module "${module}")
    set("_cmake_import_check_xcframework_for_${namespace}::${module}Python" "${modules_folder}")
  endforeach ()
endforeach ()
unset(matched)
unset(module)
unset(modules)
unset(modules_folder)
unset(namespace)
