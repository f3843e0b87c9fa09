#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: Utilities/demo.sh [MESH] [--up x|y|z] [--view DEGREES]
#
# Installs what is missing, builds, and rounds MESH (ply, stl, obj, vtk or vtp; default: the model
# Data/creature.vtp). Mesh and pictures go to demo-output/ of the project.
#   --up    axis of the model that points up (default y)
#   --view  where the camera stands, degrees around that axis (default 25)
# VERBOSE=1 shows everything.
for option in "$@"; do
  case $option in
    -h | --help)
      sed -n '5,/^[^#]/{s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"
      exit 0
      ;;
  esac
done
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# The user's path is meant from where the user stands, and a wrong one is to be told at once.
if [ $# -gt 0 ] && [[ $1 != --* ]]; then
  mesh=$(realpath -- "$1") && [ -r "$mesh" ] && [ ! -d "$mesh" ] || {
    echo "No such file, or it cannot be read: $1" >&2
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
# Not the tests, if the folder has them: rounding a model should not wait for them.
step "Building" build.log cmake --build "$build" --target SphericalStyleFiltersPython SphericalStyle
step "Rounding $(basename "$mesh")" demo.log run_demo "$@"

# What was done and where it is; in verbose mode it has been seen already.
[ -n "$VERBOSE" ] || cat "$build/demo.log"
echo "Done in $(minutes)."
