# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Code that the scripts of this folder share. Source this file; do not run it.
# shellcheck shell=bash
#
#   BUILD_DIR    build folder, relative to the project's folder (default: build)
#   VERBOSE=1    show everything the steps print
#   SKIP_SETUP=1 install nothing and use what the machine has

set -euo pipefail

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
BUILD_DIR=${BUILD_DIR:-build}
case $BUILD_DIR in
  /*) build=$BUILD_DIR ;;
  *) build=$project/$BUILD_DIR ;;
esac
VERBOSE=${VERBOSE:-}
SKIP_SETUP=${SKIP_SETUP:-}

# Settings for another Python would break Debian's Python, with which ParaView is linked.
unset PYTHONHOME PYTHONPATH

# Software rendering gives the same picture on every machine, with or without a graphics card.
export LIBGL_ALWAYS_SOFTWARE=1 GALLIUM_DRIVER=llvmpipe

step_number=0
step_count=0 # set by the script

# step TITLE LOG COMMAND... : runs the command quietly and writes its output to $build/LOG.
# If the command fails, prints the last lines of the log and ends the script.
step()
{
  local title=$1 log=$build/$2 start=$SECONDS status
  shift 2
  mkdir -p "$build"
  step_number=$((step_number + 1))
  printf '[%d/%d] %s ... ' "$step_number" "$step_count" "$title"
  set +e # and set -e in the subshell: after || the shell would not stop at a failing line
  if [ -n "$VERBOSE" ]; then
    printf '\n'
    (set -e; "$@") 2>&1 | tee "$log"
    status=$?
  else
    (set -e; "$@") >"$log" 2>&1
    status=$?
  fi
  set -e
  if [ "$status" -ne 0 ]; then
    printf 'failed after %d s\n' "$((SECONDS - start))"
    [ -n "$VERBOSE" ] || tail -n 60 "$log"
    printf '\nThe step "%s" failed (exit code %d). Its complete output is in %s\n' \
      "$title" "$status" "$log" >&2
    exit 1
  fi
  printf '%d s\n' "$((SECONDS - start))"
}

# set_up [OPTIONS OF setup.sh] : runs setup.sh, unless SKIP_SETUP is set.
set_up()
{
  if [ -n "$SKIP_SETUP" ]; then
    step "Setting up (skipped)" setup.log true
  else
    step "Setting up" setup.log "$project/Utilities/setup.sh" "$@"
  fi
}

# configure PRESET [OPTIONS OF cmake] : runs in the project's folder, where CMake looks for presets.
configure()
{
  (cd "$project" && cmake --preset "$1" -B "$build" "${@:2}")
}

# Runs a command with its own X server. Without -noreset the server may end between two clients.
with_display()
{
  xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" "$@"
}

minutes()
{
  printf '%d min %d s' "$((SECONDS / 60))" "$((SECONDS % 60))"
}

# usage : prints what the head of the script says after "usage:".
usage()
{
  sed -n '/^# usage:/,/^[^#]/s/^# \{0,1\}//p' "$0"
}

# take_test_options OPTIONS... : -h prints the script's usage, -v sets VERBOSE, all others go to ctest. Without any,
# tests of the label Long are left out.
take_test_options()
{
  ctest_options=()
  local option all=
  for option in "$@"; do
    case $option in
      -h | --help)
        usage
        exit 0
        ;;
      -v) VERBOSE=1 ;;
      --all) all=1 ;;
      *) ctest_options+=("$option") ;;
    esac
  done
  if [ -z "$all" ] && [ ${#ctest_options[@]} -eq 0 ]; then
    ctest_options=(-LE Long)
  fi
}

# Runs the tests as the last step of a script, and prints a summary.
run_tests()
{
  # Only two at a time, since the tests themselves use several threads.
  step "Testing" test.log \
    ctest --test-dir "$build" --output-on-failure --no-tests=error --parallel 2 "${ctest_options[@]}"
  local skipped
  skipped=$(grep -c '[*][*][*]Skipped' "$build/test.log") || true
  echo "$(grep 'tests passed' "$build/test.log"), $skipped skipped, in $(minutes), logs: $build/*.log"
}
