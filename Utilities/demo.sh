#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: Utilities/demo.sh [MESH] [--up x|y|z] [--view DEGREES]
#
# Installs missing packages, builds, and rounds MESH (ply, stl, obj, vtk or vtp; default:
# Data/creature.vtp). Writes the rounded mesh and pictures to demo-output/ in the project's folder.
#   --up    axis of the model that points up (default: z for .stl, y for others)
#   --view  angle of the camera around that axis, in degrees (default 25)
# VERBOSE=1 shows everything that the steps print.
for option in "$@"; do
  case $option in
    -h | --help)
      sed -n '5,/^[^#]/{s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"
      exit 0
      ;;
  esac
done
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# The path is relative to the user's current folder. Check it now, not after the build.
if [ $# -gt 0 ] && [[ $1 != --* ]]; then
  mesh=$(realpath -- "$1") && [ -r "$mesh" ] && [ ! -d "$mesh" ] || {
    echo "This file does not exist or cannot be read: $1" >&2
    exit 1
  }
  shift
else
  mesh=$project/Data/creature.vtp
fi
output=$project/demo-output

run_demo()
{
  PYTHONPATH=$build/lib/python3/dist-packages with_display \
    pvpython --dr "$project/Utilities/demo.py" "$mesh" "$output" "$@"
}

step_count=4
set_up
step "Configuring" configure.log configure release
# Build only what the demo needs: tests, if configured in this folder, would take longer.
step "Building" build.log cmake --build "$build" --target SphericalStyleFiltersPython SphericalStyle
step "Rounding $(basename "$mesh")" demo.log run_demo "$@"

# Print the results and the names of the files; in verbose mode the user has seen them already.
[ -n "$VERBOSE" ] || cat "$build/demo.log"
echo "Done in $(minutes)."
