# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# FindQt5.cmake or FindQt6.cmake, whatever ParaView uses. ParaView's paraview_client_generate_help uses only one program
# of Qt, qhelpgenerator. Debian has it in a package without Qt's headers and CMake files. Other components (Core, for
# the icons) come from Qt itself.
set(qt "${CMAKE_FIND_PACKAGE_NAME}")
list(REMOVE_ITEM ${qt}_FIND_COMPONENTS Help ToolsTools)
if (${qt}_FIND_COMPONENTS)
  find_package(${qt} CONFIG QUIET COMPONENTS ${${qt}_FIND_COMPONENTS})
else ()
  set(${qt}_FOUND TRUE)
endif ()
if (NOT TARGET ${qt}::qhelpgenerator)
  add_executable(${qt}::qhelpgenerator IMPORTED)
  set_target_properties(${qt}::qhelpgenerator PROPERTIES IMPORTED_LOCATION "${QHELPGENERATOR}")
endif ()
