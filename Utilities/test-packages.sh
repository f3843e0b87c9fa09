#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: Utilities/test-packages.sh [-v]
#
# Builds the Debian packages and tests them in a clean system of the same release (made by mmdebstrap in BUILD_DIR):
# ParaView and Python must find the filters without any environment variable, in scripts and in the window; a C++
# program outside the project must build and run; and removing the packages must leave no file behind. Needs
# root, 4 GB of disk space and the Debian archive (DEBIAN_MIRROR=URL chooses another mirror).
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
source "$(dirname "${BASH_SOURCE[0]}")/debian-root.sh"

take_test_options "$@"
need_root
root=$build/debian
release=$(. /etc/os-release && echo "$VERSION_CODENAME")

make_packages()
{
  rm -f "$build"/packages/*.deb
  (cd "$build" && cpack)
}

make_clean_debian()
{
  make_debian "$release"
  mkdir -p "$root/tmp/test"
  cp "$build"/packages/*.deb "$project"/Testing/Install/TestInstalled.py \
    "$project"/Testing/Python/TestImport.py "$project"/Testing/XML/*.xml \
    "$project"/Testing/Window/*_window.py \
    "$project"/Testing/Window/window_steps.py "$root/tmp/test"
  chown -R nobody "$root/tmp/test"
}

with_screen()
{
  alone=1 as_user /tmp/test xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" "$@"
}

# field PACKAGE FIELD : prints a field of the package's control file
field()
{
  dpkg-deb -f "$build/packages/$1_"[0-9]*.deb "$2"
}

# Installs what a package depends on and what the tests need, then lists all files to compare with later.
install_depends()
{
  in_debian apt-get -qq update
  in_debian apt-get -qq -y --no-install-recommends satisfy "$@"
  list_files >"$build/files-before.txt"
}

install_packages()
{
  local package
  for package in "$@"; do
    # All dependencies are installed, so apt-get must not install anything but the package itself.
    in_debian sh -c "apt-get -y --no-install-recommends install /tmp/test/${package}_[0-9]*.deb"
  done
}

list_files()
{
  find "$root" -xdev \( -path "$root/tmp" -o -path "$root/run" -o -path "$root/var/cache" \
    -o -path "$root/var/lib/apt" -o -path "$root/var/lib/dpkg" -o -path "$root/var/log" \) -prune \
    -o -print | sort
}

remove_packages()
{
  in_debian apt-get -qq -y purge "$@"
  list_files | diff "$build/files-before.txt" -
}

# play NAME : the test of the window, of which most are a script of clicks and some a script of Python, too. The exit
# code of ParaView does not tell of messages.
play()
{
  local name=$1 said=$build/window.txt wanted='' unwanted='^ERROR: |ERR\|' options=()
  case $name in
    Trace) wanted=traced ;;
    Handles) wanted=dragged ;;
    Errors) unwanted='returned failure|Unhandled error' ;; # others are wanted
    Parts) unwanted='ERROR: (rows|shown)' ;;
  esac
  [ ! -e "$root/tmp/test/${name,,}_window.py" ] || options+=("--script=${name,,}_window.py")
  [ ! -e "$root/tmp/test/Test${name}Window.xml" ] ||
    options+=("--test-script=Test${name}Window.xml" --test-directory=/tmp/test --exit)
  # A script that fails leaves the window open. Scripts find window_steps.py by PYTHONPATH, the filters without it.
  with_screen env PYTHONPATH=/tmp/test timeout 300 paraview --dr "${options[@]}" 2>&1 | tee "$said"
  if grep -E "$unwanted" "$said"; then
    return 1
  fi
  grep "$wanted" "$said"
}

try_paraview()
{
  local names script version name
  names=$(sed -n 's/.*<SourceProxy .*name="\([A-Za-z]*\)".*/\1/p' "$project"/ParaViewPlugin/*.xml |
    sed 's/Filter$//')
  as_user /tmp/test pvpython TestInstalled.py /usr pvserver $names
  as_user /tmp/test pvbatch TestInstalled.py /usr - $names
  version=$(field sphericalstyle Version)
  as_user /tmp/test python3 TestImport.py "${version%-*}" /usr
  as_user /tmp/test sphericalstyle /usr/share/doc/sphericalstyle/examples/creature.vtp command.ply --preset Toy
  test -s "$root/tmp/test/command.ply" && test -s "$root/usr/share/man/man1/sphericalstyle.1"
  with_screen pvpython --dr /usr/share/doc/sphericalstyle/examples/Python/round_model.py \
    /usr/share/doc/sphericalstyle/examples/creature.vtp --output /tmp/test/rounded
  play Handles
  for script in "$root"/tmp/test/*Window.xml; do
    name=${script##*/Test}
    name=${name%Window.xml}
    # Its ParaView cannot make help pages (Testing/Systems.md).
    [ "$name $release" != "Help trixie" ] || continue
    play "$name"
  done
}

try_cxx()
{
  as_user /tmp/test cmake -S /usr/share/doc/sphericalstyle/examples/Cxx -B cxx
  as_user /tmp/test cmake --build cxx
  with_screen cxx/RoundModel /usr/share/doc/sphericalstyle/examples/creature.vtp --detail-size 0.03 \
    --output cxx.vtp --off-screen cxx.png
  test -s "$root/tmp/test/cxx.vtp" && test -s "$root/tmp/test/cxx.png"
}

# The package that shows icons of ParaView.
case $release in
  bookworm) icons=libqt5svg5 ;;
  *) icons=qt6-svg-plugins ;;
esac

step_count=14
set_up --packages
step "Configuring" configure.log configure release
step "Building" build.log cmake --build "$build"
step "Building the packages" cpack.log make_packages
step "Creating a Debian system" debian.log make_clean_debian
step "Installing what sphericalstyle depends on" depends.log \
  install_depends "$(field sphericalstyle Depends)" "$(field sphericalstyle Recommends)" \
  xdotool xvfb xauth libgl1-mesa-dri "$icons"
step "Installing sphericalstyle" install.log install_packages sphericalstyle
step "Using it in ParaView and Python" use.log try_paraview
step "Removing it" remove.log remove_packages sphericalstyle
step "Installing what sphericalstyle-dev depends on" dev-depends.log install_depends \
  "$(field sphericalstyle-dev Depends | sed 's/^sphericalstyle [^,]*, //')" \
  "$(field sphericalstyle-dev Recommends)" cmake g++ make
step "Installing sphericalstyle-dev" dev-install.log install_packages sphericalstyle sphericalstyle-dev
step "Building and running a C++ program" dev-use.log try_cxx
step "Removing both" dev-remove.log remove_packages sphericalstyle sphericalstyle-dev
step "Removing the Debian system" debian-remove.log remove_debian

for package in "$build"/packages/*.deb; do
  echo "  $package: $(($(stat -c %s "$package") / 1024)) KB, $(dpkg-deb -f "$package" Installed-Size) KB installed"
done
echo "Done in $(minutes)."
