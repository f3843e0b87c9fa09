#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: Utilities/release.sh [-v] [--list | --only STEP | --from STEP]
#
# Checks what is to be released, one step after the other, stops at what fails, and leaves in build-release/packages/
# the source archive and the Debian packages of each system. All of it takes a day on two cores; --from goes on after a
# step that failed. Needs root (fresh Debian systems, see test-system.sh) and a work tree without changes.
#   --list       lists the steps
#   --only STEP  runs that step alone
#   --from STEP  runs that step and all after it
# RELEASE_FUZZ_SECONDS and RELEASE_MUTATIONS choose how long each fuzzer runs (7200) and how many changes of the sources
# are tried (200). The last line names the tag to set; nothing is tagged or uploaded.
BUILD_DIR=${BUILD_DIR:-build-release}
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

steps=(state checks tests system-12 system-13 system-testing asan clang tsan fuzz mutations coverage
  quality benchmarks archive)
version=$(sed -n 's/^  VERSION \([0-9.]*\)$/\1/p' "$project/CMakeLists.txt")

# What is released is a commit, and its number is the same everywhere.
step_state()
{
  local changes date line
  cd "$project"
  changes=$(git status --porcelain)
  [ -z "$changes" ] || { echo "The work tree has changes:"; echo "$changes"; return 1; }
  date=$(sed -n "s/^## \[$version\] - \(20[0-9-]*\)$/\1/p" CHANGELOG.md)
  [ -n "$date" ] || { echo "CHANGELOG.md has no section \"## [$version] - DATE\""; return 1; }
  for line in "version: $version" "date-released: $date"; do
    grep -qxF "$line" CITATION.cff || { echo "CITATION.cff has no line \"$line\""; return 1; }
  done
  ! git rev-parse --quiet --verify "refs/tags/v$version" ||
    { echo "The tag v$version is there already: raise VERSION in CMakeLists.txt"; return 1; }
}

step_checks()
{
  "$project/Utilities/setup.sh" --checks
  "$project/Utilities/check.sh"
}

step_tests()
{
  BUILD_DIR=build "$project/Utilities/test.sh" --all
}

# system RELEASE : README's two commands with all tests, the build without ParaView, and the packages.
system()
{
  local kind root
  for kind in "" plain packages; do
    root=$build/system-$1-${kind:-paraview}
    # shellcheck disable=SC2086 # no argument where there is no kind
    BUILD_DIR=$root KEEP_SYSTEM=1 "$project/Utilities/test-system.sh" "debian:$1" $kind --all
    if [ "$kind" = packages ]; then
      mkdir -p "$build/packages/debian-$1"
      cp "$root"/root/home/user/SphericalStyle/build/packages/*.deb "$build/packages/debian-$1"
    fi
    rm -rf --one-file-system "$root/root"
  done
}

step_system-12() { system 12; }
step_system-13() { system 13; }
step_system-testing() { system testing; }

# preset NAME [OPTIONS OF ctest] : builds and tests a preset with a checker in it.
preset()
{
  cd "$project"
  cmake --preset "$1" -DPython3_EXECUTABLE=/usr/bin/python3
  cmake --build "build-$1"
  ctest --test-dir "build-$1" --output-on-failure --no-tests=error "${@:2}"
}

step_asan() { preset asan -LE Window; }
step_clang() { ASAN_OPTIONS=detect_container_overflow=0 preset fuzz -LE Window; }

step_tsan()
{
  cd "$project"
  cmake --preset tsan -DSPHERICALSTYLE_WITH_CGAL=OFF -DPython3_EXECUTABLE=/usr/bin/python3
  cmake --build build-tsan --target Testing/Solver/all
  ctest --test-dir build-tsan --output-on-failure --no-tests=error -L Solver
}

step_fuzz()
{
  local target longest
  cd "$build"
  for target in Filters Files; do
    longest=$([ "$target" = Filters ] && echo 420 || echo 8000)
    mkdir -p "corpus/${target,,}"
    cp "$project/Testing/Fuzz/Corpus/${target,,}"/* "corpus/${target,,}"
    ASAN_OPTIONS=detect_container_overflow=0 "$project/build-fuzz/bin/Fuzz$target" -fork=1 "-max_len=$longest" \
      -timeout=150 "-max_total_time=${RELEASE_FUZZ_SECONDS:-7200}" "corpus/${target,,}"
  done
}

# In a clone, since the sources are changed there.
step_mutations()
{
  local clone=$build/mutations
  [ -d "$clone" ] || git clone --quiet "$project" "$clone"
  cd "$clone"
  cmake --preset release -DCMAKE_UNITY_BUILD=OFF -DCMAKE_LINK_DEPENDS_NO_SHARED=ON -DSPHERICALSTYLE_BUILD_TESTING=ON \
    -DPython3_EXECUTABLE=/usr/bin/python3
  cmake --build build
  Utilities/mutate.py build --count "${RELEASE_MUTATIONS:-200}"
}

# NoFiles: what counts the lines writes files of its own.
step_coverage()
{
  preset coverage -E '^Python\.NoFiles$'
  gcovr --root . --filter Filters/ --branches --exclude-throw-branches --txt "$build/branches.txt" build-coverage
  gcovr --root . --filter Filters/ --txt "$build/lines.txt" build-coverage
}

step_quality()
{
  local script
  cd "$project"
  for script in contact_sheet detail_sizes dirty_meshes limbs mesh_morphing part_sizes parts printable targets \
    triangulations; do
    PYTHONPATH=build/lib/python3/dist-packages with_display /usr/bin/python3 "Testing/Quality/$script.py" \
      --output "$build/quality/$script"
  done
}

# The machine has to be idle: look at the tables in build-release/benchmarks/.
step_benchmarks()
{
  cd "$project"
  cmake --preset benchmarks -B build-benchmarks -DPython3_EXECUTABLE=/usr/bin/python3
  cmake --build build-benchmarks
  /usr/bin/python3 Benchmarks/report_goals.py --programs build-benchmarks/Benchmarks --output "$build/benchmarks"
}

step_archive()
{
  mkdir -p "$build/packages"
  git -C "$project" archive --prefix="sphericalstyle-$version/" HEAD |
    xz -9 >"$build/packages/sphericalstyle-$version.tar.xz"
  (cd "$build/packages" && find . -type f ! -name SHA256SUMS -print0 | sort -z | xargs -0 sha256sum >SHA256SUMS)
}

chosen=("${steps[@]}")
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help) usage; exit 0 ;;
    -v) VERBOSE=1 ;;
    --list) printf '%s\n' "${steps[@]}"; exit 0 ;;
    --only | --from)
      [[ $# -gt 1 && " ${steps[*]} " == *" $2 "* ]] || { echo "No such step; --list lists them" >&2; exit 2; }
      if [ "$1" = --only ]; then
        chosen=("$2")
      else
        rest=" ${steps[*]} "
        read -ra chosen <<<"$2 ${rest#* "$2" }"
      fi
      shift
      ;;
    *) usage >&2; exit 2 ;;
  esac
  shift
done

step_count=${#chosen[@]}
for name in "${chosen[@]}"; do
  step "$name" "$name.log" "step_$name"
done
echo "Done in $(minutes). What is released: $build/packages. Tag it: git tag -a v$version -m \"SphericalStyle $version\""
