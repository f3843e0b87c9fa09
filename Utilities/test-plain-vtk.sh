#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: Utilities/test-plain-vtk.sh [-v] [--all] [OPTIONS OF ctest]
#
# Builds with Debian's plain VTK (9.1 in Debian 12, 9.3 in 13, 9.6 in testing) instead of ParaView and runs the tests, in
# build-plain-vtk/. In Debian 12 and 13 the script only unpacks VTK's packages there, since they cannot be installed
# together with ParaView's Python.
BUILD_DIR=${BUILD_DIR:-build-plain-vtk}
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

take_test_options "$@"

# Prints the version of VTK's packages, such as 9.1.
vtk_version()
{
  apt-cache show --no-all-versions libvtk9-dev | sed -n 's/^Version: \([0-9]*\.[0-9]*\).*/\1/p'
}

fetch_vtk()
{
  [ -e "$build/vtk/complete" ] && return
  local version
  version=$(vtk_version)
  rm -rf "$build/vtk" "$build/debs"
  mkdir -p "$build/vtk" "$build/debs"
  # The CMake configuration in libvtk9-dev refers to files of all these packages.
  (cd "$build/debs" &&
    apt-get download libvtk9-dev libvtk9-java "libvtk$version-qt" "libvtk$version" python3-vtk9 vtk9)
  local package
  for package in "$build"/debs/*.deb; do
    dpkg -x "$package" "$build/vtk"
  done
  touch "$build/vtk/complete"
}

configure_plain()
{
  configure release -DSPHERICALSTYLE_WITH_PARAVIEW=OFF -DSPHERICALSTYLE_BUILD_TESTING=ON "$@"
}

step_count=5
set_up --plain-vtk
if dpkg-query --show --showformat '${db:Status-Status}' libvtk9-dev 2>/dev/null | grep -qx installed; then
  step "Using the installed VTK" fetch.log dpkg-query --show libvtk9-dev
  step "Configuring" configure.log configure_plain
else
  step "Fetching VTK" fetch.log fetch_vtk
  vtk_libraries=$build/vtk/usr/lib/$(gcc -print-multiarch 2>/dev/null || echo x86_64-linux-gnu)
  step "Configuring" configure.log configure_plain -DVTK_DIR="$vtk_libraries/cmake/vtk-$(vtk_version)"
  # VTK's libraries do not record where their dependencies are; the linker and the loader look here.
  export LD_LIBRARY_PATH=$vtk_libraries
  export PYTHONPATH=$build/vtk/usr/lib/python3/dist-packages
fi
step "Building" build.log cmake --build "$build"
run_tests
