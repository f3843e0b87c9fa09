#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: Utilities/check.sh [--fix]
#
# Layers, format and, where build-dev/ was configured (cmake --preset dev), clang-tidy of our own
# C++. Exit code 1 if one of them complains. --fix: correct the format instead.
# Debian 12: apt-get install clang-format clang-tidy
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

mapfile -t sources < <(find Filters ParaViewPlugin Testing Examples Benchmarks \
  \( -name '*.h' -o -name '*.cxx' \) | sort)
status=0

# The include path keeps VTK out of the solver. CGAL lies in the compiler's own path, so look.
if grep -nE '#include *[<"](vtk|CGAL)' -r Filters/Solver; then
  echo "Filters/Solver may include Eigen only" >&2
  status=1
fi

if ! command -v clang-format >/dev/null; then
  echo "clang-format is not installed: format not checked" >&2
elif [ "${1:-}" = --fix ]; then
  clang-format -i "${sources[@]}" || status=1
else
  clang-format --dry-run -Werror "${sources[@]}" || status=1
fi

if ! command -v clang-tidy >/dev/null; then
  echo "clang-tidy is not installed: not run" >&2
elif [ ! -e build-dev/compile_commands.json ]; then
  echo "build-dev/ is not configured (cmake --preset dev): clang-tidy not run" >&2
else
  for source in "${sources[@]}"; do
    # Only what the build compiles; headers are checked through the files that include them.
    if [[ $source == *.cxx ]] && grep -qF "/$source\"" build-dev/compile_commands.json; then
      clang-tidy --quiet -p build-dev "$source" || status=1
    fi
  done
fi
exit $status
