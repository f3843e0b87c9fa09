#!/bin/sh
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# Makes all models of this folder again. Needs CGAL, Eigen, and a python3 with
# numpy and VTK; name another one with PYTHON=pvpython.
#
#   generate_models.sh [build folder]

set -e
folder=$(cd "$(dirname "$0")" && pwd)
python=${PYTHON:-/usr/bin/python3}
build=${1:-$(mktemp -d)}

# No __pycache__ beside the models.
export PYTHONDONTWRITEBYTECODE=1

cmake -S "$folder" -B "$build"
cmake --build "$build"

"$python" "$folder/generate_models.py"
"$python" "$folder/generate_models.py" --contour "$build/contour.off"
# This edge length gives about 5000 points.
"$build/CreatureMesher" "$build/contour.off" "$build/creature.off" 0.0232
"$python" "$folder/generate_models.py" --creature "$build/creature.off"
