# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# `cpack` in the build folder makes two Debian packages in packages/: sphericalstyle for users of the filters
# in ParaView and Python, sphericalstyle-dev for C++ programmers. Utilities/test-packages.sh tests them in a
# clean Debian.
set(debian "${CMAKE_CURRENT_SOURCE_DIR}/cmake/debian")
file(READ LICENSE license)
string(STRIP "${license}" license)
string(REPLACE "\n\n" "\n.\n" license "${license}")
string(REPLACE "\n" "\n " license " ${license}") # lines of a field begin with a space, empty ones have a dot
configure_file("${debian}/copyright.in" "${CMAKE_BINARY_DIR}/copyright" @ONLY)
install(FILES "${CMAKE_BINARY_DIR}/copyright" CHANGELOG.md README.md
  DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/doc/sphericalstyle" COMPONENT runtime)
install(DIRECTORY Filters/Documentation # in the folder that links of the two files above name
  DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/doc/sphericalstyle/Filters" COMPONENT runtime
  FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN __pycache__ EXCLUDE)
install(FILES "${CMAKE_BINARY_DIR}/copyright"
  DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/doc/sphericalstyle-dev" COMPONENT development)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_DIRECTORY "${CMAKE_BINARY_DIR}/packages")
set(CPACK_PACKAGE_CONTACT "SphericalStyle contributors <sphericalstyle@example.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# The version says what the packages fit, as in 1.0.0-1+paraview5.13. It grows with ParaView's, so upgrading Debian
# upgrades them.
if (SPHERICALSTYLE_WITH_PARAVIEW)
  set(CPACK_DEBIAN_PACKAGE_RELEASE "1+paraview${ParaView_VERSION_MAJOR}.${ParaView_VERSION_MINOR}")
else ()
  set(CPACK_DEBIAN_PACKAGE_RELEASE "1+vtk${VTK_MAJOR_VERSION}.${VTK_MINOR_VERSION}")
endif ()

# A package is a group of components. The names of the components are those of VTK and ParaView.
set(CPACK_COMPONENTS_ALL runtime paraview_plugins python development)
set(CPACK_COMPONENT_RUNTIME_GROUP run)
set(CPACK_COMPONENT_PARAVIEW_PLUGINS_GROUP run)
set(CPACK_COMPONENT_PYTHON_GROUP run)
set(CPACK_COMPONENT_DEVELOPMENT_GROUP dev)

# SHLIBDEPS finds the packages and versions of the libraries that our library links.
set(run_depends)
set(CPACK_DEBIAN_RUN_PACKAGE_NAME sphericalstyle)
set(CPACK_DEBIAN_RUN_PACKAGE_SECTION graphics)
set(contents "the library")
if (SPHERICALSTYLE_WITH_PARAVIEW)
  string(APPEND contents ", the plugin for ParaView")
endif ()
if (SPHERICALSTYLE_WRAP_PYTHON)
  string(APPEND contents ", the Python package,\nthe program sphericalstyle")
endif ()
set(CPACK_DEBIAN_RUN_DESCRIPTION
  "The result ranges from slightly softened to a ball, with or without the details
of the model. Contents, built for ${sphericalstyle_built_for}:
${contents}.")
set(CPACK_DEBIAN_RUN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
# postinst and prerm create and remove Python's byte code; shlibs is for packages of programs that link the library.
configure_file("${debian}/shlibs.in" "${CMAKE_BINARY_DIR}/shlibs" @ONLY)
set(CPACK_DEBIAN_RUN_PACKAGE_CONTROL_EXTRA
  "${debian}/postinst;${debian}/prerm;${debian}/triggers;${CMAKE_BINARY_DIR}/shlibs")

# mpirun, for several processes; pictures of the command line on a machine without a screen
set(CPACK_DEBIAN_RUN_PACKAGE_SUGGESTS "openmpi-bin, xvfb")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME sphericalstyle-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_DESCRIPTION
  "This package contains what C++ programs need to use the filters: headers and
files for CMake's find_package(SphericalStyle).")
set(dev_depends "sphericalstyle (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
set(vtk_range "(>= ${VTK_MAJOR_VERSION}.${VTK_MINOR_VERSION}), PACKAGE (<< ${VTK_MAJOR_VERSION}.${vtk_next_minor}~)")
string(REPLACE PACKAGE libvtk9-dev vtk_dev "libvtk9-dev ${vtk_range}")
if (SPHERICALSTYLE_WITH_PARAVIEW)
  set(range "(>= ${ParaView_VERSION_MAJOR}.${ParaView_VERSION_MINOR}), PACKAGE (<< ${ParaView_VERSION_MAJOR}.${paraview_next_minor}~)")
  if (SPHERICALSTYLE_WRAP_PYTHON)
    string(REPLACE PACKAGE python3-paraview run_depends "python3-paraview ${range}")
  else ()
    string(REPLACE PACKAGE paraview run_depends "paraview ${range}")
  endif ()
  set(CPACK_DEBIAN_RUN_PACKAGE_RECOMMENDS # without it ParaView's help is empty
    "libqt${PARAVIEW_QT_MAJOR_VERSION}sql${PARAVIEW_QT_MAJOR_VERSION}-sqlite")
  string(REPLACE PACKAGE paraview-dev paraview_dev "paraview-dev ${range}")
  # VTK's CMake package looks for MPI; programs that render also need the recommended packages.
  set(dev_depends "${dev_depends}, ${paraview_dev}, libopenmpi-dev")
  if (NOT IS_DIRECTORY "${ParaView_DIR}/vtk")
    set(dev_depends "${dev_depends}, ${vtk_dev}") # ParaView 6.1 uses the system's VTK
  endif ()
  set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS
    "libfreetype-dev, libgl-dev, libglew-dev, libjpeg-dev, libopengl-dev, libpng-dev, libx11-dev, libxext-dev")
else ()
  if (SPHERICALSTYLE_WRAP_PYTHON)
    string(REPLACE PACKAGE python3-vtk9 run_depends "python3-vtk9 ${vtk_range}")
  endif ()
  set(dev_depends "${dev_depends}, ${vtk_dev}")
endif ()
# The module is linked with VTK's library for this Python.
if (SPHERICALSTYLE_WRAP_PYTHON)
  math(EXPR python_next_minor "${Python3_VERSION_MINOR} + 1")
  set(python3 "python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${python_next_minor}~)")
  set(run_depends "${python3}, python3-numpy, ${run_depends}")
endif ()
set(CPACK_DEBIAN_RUN_PACKAGE_DEPENDS "${run_depends}") # and what SHLIBDEPS finds
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "${dev_depends}")
include(CPack)
