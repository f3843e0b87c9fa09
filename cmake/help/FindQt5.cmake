# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# All of Qt that ParaView's paraview_client_generate_help uses is the program, which Debian has in a package
# without Qt's headers and CMake files. What else is asked for (Core, for the icons) comes from Qt itself.
list(REMOVE_ITEM Qt5_FIND_COMPONENTS Help)
if (Qt5_FIND_COMPONENTS)
  find_package(Qt5 CONFIG QUIET COMPONENTS ${Qt5_FIND_COMPONENTS})
else ()
  set(Qt5_FOUND TRUE)
endif ()
if (NOT TARGET Qt5::qhelpgenerator)
  add_executable(Qt5::qhelpgenerator IMPORTED)
  set_target_properties(Qt5::qhelpgenerator PROPERTIES IMPORTED_LOCATION "${QHELPGENERATOR}")
endif ()
