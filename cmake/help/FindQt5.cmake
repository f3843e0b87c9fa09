# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# ParaView's paraview_client_generate_help uses only one program of Qt, qhelpgenerator. Debian has it in a package
# without Qt's headers and CMake files. Other components (Core, for the icons) come from Qt itself.
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
