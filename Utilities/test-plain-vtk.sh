#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: Utilities/test-plain-vtk.sh [-v] [OPTIONS OF ctest]
#
# Builds with Debian's plain VTK 9.1 instead of ParaView and runs the tests, in build-vtk91/. The script
# only unpacks VTK's packages there, since they cannot be installed together with ParaView's Python.
BUILD_DIR=${BUILD_DIR:-build-vtk91}
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

take_test_options "$@"

fetch_vtk()
{
  [ -e "$build/vtk/complete" ] && return
  rm -rf "$build/vtk" "$build/debs"
  mkdir -p "$build/vtk" "$build/debs"
  # The CMake configuration in libvtk9-dev refers to files of all these packages.
  (cd "$build/debs" &&
    apt-get download libvtk9-dev libvtk9-java libvtk9.1-qt libvtk9.1 python3-vtk9 vtk9)
  local package
  for package in "$build"/debs/*.deb; do
    dpkg -x "$package" "$build/vtk"
  done
  touch "$build/vtk/complete"
}

vtk_libraries=$build/vtk/usr/lib/$(gcc -print-multiarch 2>/dev/null || echo x86_64-linux-gnu)
step_count=5
set_up --plain-vtk
step "Fetching VTK 9.1" fetch.log fetch_vtk
step "Configuring" configure.log configure release \
  -DSPHERICALSTYLE_WITH_PARAVIEW=OFF -DSPHERICALSTYLE_BUILD_TESTING=ON \
  -DVTK_DIR="$vtk_libraries/cmake/vtk-9.1"

# VTK's libraries do not record where their dependencies are; the linker and the loader look here.
export LD_LIBRARY_PATH=$vtk_libraries
step "Building" build.log cmake --build "$build"
export PYTHONPATH=$build/vtk/usr/lib/python3/dist-packages
run_tests
