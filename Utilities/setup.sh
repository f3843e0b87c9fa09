#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: Utilities/setup.sh [--plain-vtk | --packages | --system | --benchmarks | --checks | --docs]
#
# Installs the missing packages for building, testing and the demo on Debian 12, 13 and testing (Testing/Systems.md);
# does nothing if all are installed.
#   --plain-vtk   also install what Utilities/test-plain-vtk.sh needs
#   --packages    also install what Utilities/test-packages.sh needs
#   --system      install only what Utilities/test-system.sh needs
#   --benchmarks  also install what Benchmarks/ needs, and the libraries that it compares with
#   --checks      also install what Utilities/check.sh and the checks in Testing/README.md need
#   --docs        install only what Utilities/docs.sh needs
# ANY_RELEASE=1 tries other releases of Debian and Ubuntu 24.04, on which we do not test.
# Uses sudo if you are not root. On other systems, install the equivalents of the packages below.
set -euo pipefail

usage()
{
  sed -n '/^# usage:/,/^[^#]/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
}

[ $# -le 1 ] || { usage >&2; exit 2; }

release=$(. /etc/os-release 2>/dev/null && echo "${ID:-?} ${VERSION_CODENAME:-?}") ||
  release="unknown system"

packages=(
  # build
  ca-certificates cmake g++ git make ninja-build
  libcgal-dev libeigen3-dev nlohmann-json3-dev
  # ParaView with its VTK, its Python, the MPI its CMake package asks for, and mpirun
  libopenmpi-dev openmpi-bin paraview paraview-dev python3-paraview
  # what makes the plugin's help pages
  qhelpgenerator-qt5 qtxmlpatterns5-dev-tools xsltproc
  # headers that VTK's rendering modules require; the tests compare pictures
  libfreetype-dev libgl-dev libglew-dev libjpeg-dev libopengl-dev libpng-dev libx11-dev libxext-dev
  # a screen for tests and demo: X server, software OpenGL, a mouse
  libgl1-mesa-dri xauth xdotool xvfb
  python3-matplotlib python3-numpy python3-pil python3-scipy)
# What the plugin's icons and widgets need, what shows icons and help in ParaView, and PyVista where Debian has it.
case $release in
  # Ubuntu 24.04 has these versions as well; nobody has tried it.
  "debian bookworm" | "ubuntu noble") packages+=(libqt5sql5-sqlite libqt5svg5 qtbase5-dev) ;; # ParaView 5.11, VTK 9.2
  "debian trixie") # ParaView 5.13, VTK 9.4
    packages+=(libpython3-dev libqt6sql6-sqlite python3-pyvista qt6-base-dev qt6-svg-plugins)
    ;;
  *) # ParaView 6.1, which uses the system's VTK 9.6
    packages+=(libpython3-dev libqt6sql6-sqlite libvtk9-dev libvtk9-qt-dev python3-pyvista qt6-base-dev qt6-svg-plugins)
    ;;
esac

documentation=(mkdocs mkdocs-material python3-pymdownx)

case ${1:-} in
  "") ;;
  --plain-vtk)
    # The run-time packages of VTK install the libraries that VTK depends on. libvtk9-dev cannot be
    # installed together with ParaView's Python, so the test unpacks it into the build folder. The
    # -dev packages here have the headers that VTK's CMake package requires. In Debian testing,
    # ParaView uses libvtk9-dev, which is in the list above.
    case $release in
      "debian bookworm" | "ubuntu noble") packages+=(libvtk9.1 libvtk9.1-qt) ;;
      "debian trixie") packages+=(libvtk9.3 libvtk9.3-qt) ;;
    esac
    packages+=(libdouble-conversion-dev libjsoncpp-dev liblz4-dev liblzma-dev libtbb-dev libutfcpp-dev)
    ;;
  --packages) packages+=(debian-archive-keyring dpkg-dev file iproute2 mmdebstrap) ;;
  --system) packages=(debian-archive-keyring iproute2 mmdebstrap) ;;
  --checks)
    packages+=(clang clang-format clang-tidy codespell gcovr libclang-rt-dev pyflakes3 shellcheck valgrind xz-utils
      "${documentation[@]}" python3-yaml)
    ;;
  --docs) packages=(git "${documentation[@]}") ;;
  --benchmarks) packages+=(libbenchmark-dev libopen3d-dev libopenblas-dev libsuitesparse-dev) ;;
  -h | --help) usage; exit 0 ;;
  *) usage >&2; exit 2 ;;
esac

give_up()
{
  printf '%s\n' "$@" >&2
  echo "To continue without this script, set SKIP_SETUP=1 and install these packages yourself:" >&2
  printf '%s\n' "${packages[*]}" | fold -s -w 100 | sed 's/^/  /' >&2
  exit 1
}

command -v apt-get >/dev/null && command -v dpkg-query >/dev/null ||
  give_up "This script needs Debian and its apt-get, which was not found."

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query --show --showformat '${db:Status-Status}' "$package" 2>/dev/null) || true
  # dpkg-query prints the status once for each architecture for which the package is installed.
  [[ $status == installed* ]] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "Nothing to install."
  exit 0
fi

[[ $release == debian\ @(bookworm|trixie|forky) ]] || [ -n "${ANY_RELEASE:-}" ] ||
  give_up "This script supports Debian 12, 13 and testing, but this is: $release. Missing packages: ${missing[*]}"

sudo=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null ||
    give_up "Installing packages requires root: run Utilities/setup.sh as root, or install sudo."
  sudo=(sudo)
fi
apt_get()
{
  "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -qq -o DPkg::Lock::Timeout=600 -o Dpkg::Use-Pty=0 "$@"
}

echo "Installing: ${missing[*]}"
apt_get update || give_up "apt-get update failed. Is there a network connection, and is apt configured?"
apt_get install -y --no-install-recommends "${missing[@]}" </dev/null ||
  give_up "apt-get could not install: ${missing[*]}"
