#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: Utilities/release.sh [-v] [--list | --only STEP | --from STEP]
#
# Checks what is to be released, one step after the other, stops at what fails, and leaves in build-release/packages/
# the source archive and the Debian packages of each system. All of it takes a day on two cores; --from goes on after a
# step that failed. Needs root (fresh Debian systems, see test-system.sh) and a work tree without changes. Each step is
# noted with the commit that it passed at, and archive asks for all of them at this one.
#   --list       lists the steps
#   --only STEP  runs that step alone, after the first one
#   --from STEP  runs that step and all after it, after the first one
# RELEASE_FUZZ_SECONDS and RELEASE_MUTATIONS choose how long each fuzzer runs (7200) and how many changes of the sources
# are tried (200). Look also at the results in build-release/: survivors in mutations.log, lines.txt, branches.txt,
# quality/ and benchmarks/. The last line names the tag to set; nothing is tagged or uploaded.
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

# In a folder that has no settings from before.
step_tests()
{
  rm -rf "$build/build"
  BUILD_DIR=$build/build "$project/Utilities/test.sh" --all
}

# system RELEASE : README's two commands with all tests, the build without ParaView, and the packages.
system()
{
  local kind root
  for kind in "" plain packages; do
    root=$build/system-$1-${kind:-paraview}
    rm -rf --one-file-system "$root/root" # of a run that failed
    # shellcheck disable=SC2086 # no argument where there is no kind
    BUILD_DIR=$root KEEP_SYSTEM=1 "$project/Utilities/test-system.sh" "debian:$1" $kind --all
    if [ "$kind" = packages ]; then
      rm -rf "$build/packages/debian-$1"
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
  cmake --fresh --preset "$1" -DPython3_EXECUTABLE=/usr/bin/python3
  cmake --build "build-$1"
  ctest --test-dir "build-$1" --output-on-failure --no-tests=error --parallel 2 "${@:2}"
}

step_asan() { preset asan -LE Window; }
step_clang() { ASAN_OPTIONS=detect_container_overflow=0 preset fuzz -LE Window; }

step_tsan()
{
  cd "$project"
  cmake --fresh --preset tsan -DSPHERICALSTYLE_WITH_CGAL=OFF -DPython3_EXECUTABLE=/usr/bin/python3
  cmake --build build-tsan --target Testing/Solver/all
  ctest --test-dir build-tsan --output-on-failure --no-tests=error -L Solver
}

step_fuzz()
{
  local target longest
  cmake --build "$project/build-fuzz" --target FuzzFilters FuzzFiles
  rm -rf "$build/fuzz"
  mkdir "$build/fuzz"
  cd "$build"
  for target in Filters Files; do
    longest=$([ "$target" = Filters ] && echo 420 || echo 8000)
    mkdir -p "corpus/${target,,}"
    cp "$project/Testing/Fuzz/Corpus/${target,,}"/* "corpus/${target,,}"
    # With -fork, hangs and inputs that take too much memory would be passed over.
    ASAN_OPTIONS=detect_container_overflow=0 "$project/build-fuzz/bin/Fuzz$target" -fork=1 "-max_len=$longest" \
      -timeout=150 -report_slow_units=150 -ignore_timeouts=0 -ignore_ooms=0 "-artifact_prefix=$build/fuzz/" \
      "-max_total_time=${RELEASE_FUZZ_SECONDS:-7200}" "corpus/${target,,}"
  done
  rmdir "$build/fuzz" # inputs that failed are there
}

# In a clone, since the sources are changed there.
step_mutations()
{
  local clone=$build/mutations
  if [ "$(git -C "$clone" rev-parse HEAD 2>/dev/null)" != "$(git -C "$project" rev-parse HEAD)" ]; then
    rm -rf "$clone"
    git clone --quiet "$project" "$clone"
  fi
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
  gcovr --root . --filter Filters/ --fail-under-line 98 --txt "$build/lines.txt" build-coverage
}

step_quality()
{
  local script status
  cd "$project"
  for script in contact_sheet detail_sizes dirty_meshes every_model limbs mesh_morphing part_sizes parts printable \
    targets triangulations weights; do
    status=0
    PYTHONPATH=$build/build/lib/python3/dist-packages with_display /usr/bin/python3 "Testing/Quality/$script.py" \
      --output "$build/quality/$script" || status=$?
    [ "$status" -eq 0 ] || [ "$status" -eq 77 ] || return "$status"
    [ "$status" -ne 77 ] || echo "skipped: $script" # says why: without the models of ../shared
  done
}

# The machine has to be idle: look at the tables in build-release/benchmarks/.
step_benchmarks()
{
  cd "$project"
  Utilities/setup.sh --benchmarks
  cmake --fresh --preset benchmarks -B build-benchmarks -DPython3_EXECUTABLE=/usr/bin/python3
  cmake --build build-benchmarks
  /usr/bin/python3 Benchmarks/report_goals.py --programs build-benchmarks/Benchmarks --output "$build/benchmarks"
}

# The steps that have not passed at this commit, but for those that are given.
missing_steps()
{
  local head name
  head=$(git -C "$project" rev-parse HEAD)
  for name in "${steps[@]}"; do
    [[ " $* " == *" $name "* ]] || [ "$(cat "$build/$name.commit" 2>/dev/null)" = "$head" ] || printf '%s ' "$name"
  done
}

step_archive()
{
  local missing system
  missing=$(missing_steps archive)
  [ -z "$missing" ] || { echo "Not passed at this commit: $missing"; return 1; }
  for system in 12 13 testing; do
    [ "$(find "$build/packages/debian-$system" -name "sphericalstyle*_$version-*.deb" | wc -l)" = 2 ] ||
      { echo "$build/packages/debian-$system does not have two packages of $version"; return 1; }
  done
  rm -f "$build"/packages/*.tar.xz
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

# Runs a step and notes the commit: what was changed meanwhile is not what it has tested.
noted()
{
  local head
  head=$(git -C "$project" rev-parse HEAD)
  rm -f "$build/$1.commit"
  "step_$1"
  step_state
  [ "$(git -C "$project" rev-parse HEAD)" = "$head" ] || { echo "The commit has changed meanwhile"; return 1; }
  echo "$head" >"$build/$1.commit"
}

[ "${chosen[0]}" = state ] || chosen=(state "${chosen[@]}")
step_count=${#chosen[@]}
for name in "${chosen[@]}"; do
  step "$name" "$name.log" noted "$name"
done
missing=$(missing_steps)
if [ -n "$missing" ]; then
  echo "Done in $(minutes). Not passed at this commit yet: $missing"
else
  echo "Done in $(minutes). What is released: $build/packages. Tag it:" \
    "git tag -a v$version -m \"SphericalStyle $version\" $(git -C "$project" rev-parse HEAD)"
fi
