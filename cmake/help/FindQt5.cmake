# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# All of Qt that ParaView's paraview_client_generate_help uses is the program, which Debian has in a package
# without Qt's headers and CMake files.
if (NOT TARGET Qt5::qhelpgenerator)
  add_executable(Qt5::qhelpgenerator IMPORTED)
  set_target_properties(Qt5::qhelpgenerator PROPERTIES IMPORTED_LOCATION "${QHELPGENERATOR}")
endif ()
set(Qt5_FOUND TRUE)
