#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: Utilities/check.sh [--fix] [--quick | --tidy] [--since REF] [--seconds N]
#
# Checks the complete repository: layers, format, American spelling, shell scripts, YAML, documentation, line lengths
# of pages, and our own C++ with clang-tidy. The exit code is 1 if a check fails or a tool is missing
# (Utilities/setup.sh --checks installs them).
#   --fix        correct the format first
#   --quick      leave out clang-tidy; takes seconds
#   --tidy       run only clang-tidy
#   --since REF  run clang-tidy only on files that changed since that commit and on files that include them
#   --seconds N  let clang-tidy start no further file after that time; it lists the files that are left
# The script configures build-dev/ for clang-tidy. You need not build anything.
#
# clang-tidy takes 24 s of processor time per source file (mean of 60, clang-tidy 14), so almost an hour for all 272
# with two processes. It matches its checks against everything that VTK, Eigen and CGAL declare. No
# single check takes a tenth of that time, so dropping one would not help, and the tests have findings just as the
# filters do. Instead, a file that was clean is skipped until something that it includes changes. CI checks only the
# files of a change, within a time limit (.ci/run); .github/workflows/tidy.yml checks all files once a week.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

usage()
{
  sed -n '/^# usage:/,/^[^#]/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
}

fix='' quick='' tidy='' tidy_options=()
while [ $# -gt 0 ]; do
  case $1 in
    --fix) fix=1 ;;
    --quick) quick=1 ;;
    --tidy) tidy=1 ;;
    --since | --seconds)
      [ $# -gt 1 ] || { usage >&2; exit 2; }
      tidy_options+=("$1" "$2")
      shift
      ;;
    -h | --help) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
  shift
done

[ -z "$quick" ] || [ -z "$tidy" ] || { usage >&2; exit 2; }

tools=(git clang-format codespell mkdocs pyflakes3 shellcheck)
[ -n "$quick" ] || tools+=(clang-tidy cmake g++)
missing=()
for tool in "${tools[@]}"; do
  command -v "$tool" >/dev/null || missing+=("$tool")
done
/usr/bin/python3 -c 'import yaml' 2>/dev/null || missing+=(python3-yaml)
if [ ${#missing[@]} -gt 0 ]; then
  echo "Nothing was checked, since tools are missing: ${missing[*]}. Utilities/setup.sh --checks installs them." >&2
  exit 1
fi
git rev-parse --git-dir >/dev/null 2>&1 || {
  echo "This needs a clone made by git, not the source archive." >&2
  exit 1
}

# files PATTERN... : puts the matching files of the repository, and new ones that git does not ignore, into the array
# "found".
files()
{
  local name
  found=()
  while IFS= read -r -d '' name; do
    [ -f "$name" ] && found+=("$name")
  done < <(git ls-files -z --cached --others --exclude-standard -- "$@" | sort -zu)
}

scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT

status=0
# check TITLE COMMAND... : reports whether the command passes, and continues either way.
check()
{
  local title=$1
  shift
  if "$@"; then
    echo "ok      $title"
  else
    echo "FAILED  $title" >&2
    status=1
  fi
}

# forbid PATTERN FOLDERS... : fails if a file includes a header that matches the pattern
forbid()
{
  ! grep -rnE "^[[:space:]]*#[[:space:]]*include[[:space:]]*[<\"]$1" --include='*.h' --include='*.cxx' "${@:2}" >&2
}

# Filters/README.md says who may include whom. The include path keeps VTK out of solver and geometry. It cannot keep
# out CGAL, which is in the compiler's default path, or our own headers, which any relative path can name.
layers()
{
  local geometry wrong=0
  geometry=$(find Filters/Geometry -name '*.h' -printf '%f|')
  forbid "(vtk|CGAL/|pq|(.*/)?(${geometry%|})[>\"])" Filters/Solver || wrong=1
  forbid '(vtk|pq)' Filters/Geometry || wrong=1
  find Filters ParaViewPlugin -path Filters/Geometry -prune -o -path Filters/Solver -prune -o -type f \
    \( -name '*.h' -o -name '*.cxx' \) -print0 >"$scratch/files"
  mapfile -d '' -t found <"$scratch/files"
  forbid 'CGAL/' "${found[@]}" || wrong=1
  forbid 'pq' Filters || wrong=1
  [ "$wrong" -eq 0 ] || echo "These includes violate the layers in Filters/README.md." >&2
  return "$wrong"
}

format()
{
  files '*.h' '*.cxx'
  [ -z "$fix" ] || clang-format -i "${found[@]}" || return 1
  clang-format --dry-run -Werror "${found[@]}"
}

spelling()
{
  files ':!*.png' ':!*.vtp' ':!*.ply' ':!*.stl' ':!*.svg' ':!Testing/Fuzz/Corpus'
  codespell "${found[@]}" || return 1
  # codespell knows only the most common verbs in -ise.
  ! grep -nIE '(factor|orthogonal|triangul|discret|paramet[r]|symmetr|regular|stabil)is(e|ed|es|ing|ation|ations)\b' \
    "${found[@]}" >&2
}

scripts()
{
  local script wrong=0 shell=()
  files '*' ':!*.png'
  for script in "${found[@]}"; do
    if [[ $script == *.sh ]] || head -c 64 "$script" | LC_ALL=C grep -qaE '^#!.*[/ ](ba)?sh'; then
      bash -n "$script" || wrong=1
      shell+=("$script")
    fi
  done
  shellcheck --severity=warning --external-sources --source-path=SCRIPTDIR "${shell[@]}" || wrong=1
  return "$wrong"
}

# Names that Python would not find. LoadPlugin makes SphericalStyle.
names()
{
  files '*.py'
  pyflakes3 "${found[@]}" >"$scratch/names" 2>"$scratch/syntax"
  if [ -s "$scratch/syntax" ]; then # files that are not Python
    cat "$scratch/syntax" >&2
    return 1
  fi
  ! grep "undefined name '" "$scratch/names" | grep -v "'SphericalStyle'" >&2
}

yaml()
{
  files '*.yml' '*.yaml' '*.cff'
  # mkdocs.yml contains tags that only MkDocs understands; MkDocs reads it below.
  /usr/bin/python3 -c '
import sys, yaml
wrong = 0
for name in sys.argv[1:]:
    try:
        yaml.safe_load(open(name)) if name != "mkdocs.yml" else yaml.parse(open(name))
    except yaml.YAMLError as error:
        wrong = 1
        print(f"{name}: {error}", file=sys.stderr)
sys.exit(wrong)' "${found[@]}"
}

documentation()
{
  Utilities/docs.sh "$scratch/site"
}

# Checks line lengths of pages, except code, tables, and lines that consist of a link or an address.
columns()
{
  files '*.md'
  awk 'FNR == 1 { fence = 0 }
    /^```/ { fence = !fence }
    !fence && length($0) >= 120 && !/^( *\||    |!?\[|<?https?:)/ { print FILENAME ":" FNR ": " length($0) " columns"; bad = 1 }
    END { exit bad }' "${found[@]}" >&2
}

# Checks that every row of a table has as many cells as the first one and is one line, and that an empty line follows.
tables()
{
  files '*.md'
  awk 'function wrong(what) { print FILENAME ":" FNR ": " what; bad = 1 }
    function bars(row) { gsub(/\\\|/, "", row); return gsub(/\|/, "", row) }
    FNR == 1 || /^ *```/ { cells = 0 }
    /^ *\|( *:?-+:? *\|)+$/ { cells = bars(before) }
    cells && !/^ *\|/ && /[^ ]/ { wrong("text right after a table, or a row in two lines") }
    !/^ *\|/ { cells = 0 }
    cells && bars($0) != cells { wrong(bars($0) - 1 " cells in a table of " cells - 1) }
    { before = $0 }
    END { exit bad }' "${found[@]}" >&2
}

run_tidy()
{
  local log
  # Besides the sources, clang-tidy needs only what configuring generates.
  if ! log=$(cmake --preset dev -DSPHERICALSTYLE_BUILD_TESTING=ON 2>&1); then
    printf '%s\n' "$log" >&2
    return 1
  fi
  /usr/bin/python3 Utilities/tidy.py build-dev "${tidy_options[@]}"
}

if [ -z "$tidy" ]; then
  check "layers" layers
  check "format" format
  check "spelling" spelling
  check "scripts" scripts
  check "Python names" names
  check "YAML" yaml
  check "documentation" documentation
  check "columns" columns
  check "tables" tables
fi
[ -n "$quick" ] || check "clang-tidy" run_tidy
exit $status
