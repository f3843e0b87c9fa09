#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: Utilities/test-system.sh debian:12|debian:13|debian:testing [plain|packages] [-v] [--all] [OPTIONS OF ctest]
#
# Makes a fresh Debian system in build-system/, copies the project there, and runs the two commands of README.md, so
# setup.sh, demo.sh and test.sh, as a user without rights. The tests have no network.
#   plain      runs Utilities/test-plain-vtk.sh instead
#   packages   runs Utilities/test-packages.sh instead, which makes a second system of the same release in the first
#   --all      runs long tests, too, as before a release
# The copy has the files that git knows or does not ignore, as they are now, and sees the real models in ../shared if
# that folder exists. Needs root, 10 GB of disk space and the Debian archive (DEBIAN_MIRROR=URL chooses another
# mirror, see debian-root.sh).
# KEEP_SYSTEM=1 keeps the system and uses it again the next time.
system=${1:-}
[ $# -eq 0 ] || shift
case $system in
  debian:12) release=bookworm ;;
  debian:13) release=trixie ;;
  debian:testing) release=testing ;;
  *)
    sed -n '/^# usage:/,/^[^#]/s/^# \{0,1\}//p' "$0" >&2
    [[ $system == -h || $system == --help ]]
    exit
    ;;
esac
kind=paraview
case ${1:-} in
  plain | packages)
    kind=$1
    shift
    ;;
esac
BUILD_DIR=${BUILD_DIR:-build-system/${system#debian:}-$kind}
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
source "$(dirname "${BASH_SOURCE[0]}")/debian-root.sh"

take_test_options "$@"
test_options=("$@")
need_root
root=$build/root
folder=/home/user/SphericalStyle
shared=
if [ -d "$project/../shared" ]; then
  shared=$(realpath "$project/../shared")
fi

make_system()
{
  if [ -z "${KEEP_SYSTEM:-}" ] || [ ! -e "$root/complete" ]; then
    make_debian "$release"
    touch "$root/complete"
  fi
}

copy_project()
{
  mkdir -p "$root$folder"
  (cd "$project" && git ls-files --cached --others --exclude-standard -z |
    tar --create --null --files-from=- --ignore-failed-read) | tar -x -C "$root$folder"
  if [ -n "$shared" ]; then
    ln -sfn "$shared" "$root$(dirname "$folder")/shared"
  fi
  chown -R nobody "$root$(dirname "$folder")"
}

# in_copy COMMAND... : runs it as the user in the copy, without network.
in_copy()
{
  alone=1 as_user "$folder" "HOME=$(dirname "$folder")" SKIP_SETUP=1 VERBOSE="$VERBOSE" "$@"
}

install()
{
  in_debian "$folder/Utilities/setup.sh" "$@"
}

# Prints what the tests in the system said, and why tests were skipped.
print_results()
{
  sed -n '/tests passed/p' "$build/$1"
  sed -n 's/^.*Test *#[0-9]*: \([^ ]*\).*Skipped.*/  skipped: \1/p' "$root$folder"/build*/test.log
}

step_count=6
[ "$kind" != packages ] || step_count=5
set_up --system
step "Creating $system" debian.log make_system
step "Copying the project" copy.log copy_project
case $kind in
  paraview)
    step "Installing packages" setup.log install
    step "Running demo.sh" demo.log in_copy Utilities/demo.sh
    step "Running test.sh" test.log in_copy Utilities/test.sh "${test_options[@]}"
    print_results test.log
    ;;
  plain)
    step "Installing packages" setup.log install --plain-vtk
    step "Building with plain VTK" build.log as_user "$folder" SKIP_SETUP=1 Utilities/test-plain-vtk.sh --show-only
    step "Running test-plain-vtk.sh" test.log in_copy Utilities/test-plain-vtk.sh "${test_options[@]}"
    print_results test.log
    ;;
  packages)
    step "Installing packages" setup.log install --packages
    step "Running test-packages.sh" test.log in_debian env SKIP_SETUP=1 VERBOSE="$VERBOSE" \
      ${DEBIAN_MIRROR:+"DEBIAN_MIRROR=$DEBIAN_MIRROR"} "$folder/Utilities/test-packages.sh"
    ;;
esac
[ -n "${KEEP_SYSTEM:-}" ] || remove_debian
echo "Done in $(minutes), logs: $build/*.log"
