#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: Utilities/docs.sh [FOLDER]
#
# Makes a site of the pages of the project in FOLDER (default: build/site): start with index.html
# there, no server and no network needed. A link that leads nowhere is an error, also to a heading.
# Needs MkDocs and its theme Material: Utilities/setup.sh --docs
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

case ${1:-} in
  -*)
    sed -n '5,/^[^#]/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
    [[ $1 == -h || $1 == --help ]]
    exit
    ;;
esac
command -v mkdocs >/dev/null && [ -d /usr/share/mkdocs/themes/material ] || {
  echo "MkDocs or its theme Material is not there: Utilities/setup.sh --docs" >&2
  exit 1
}

DOCS_SITE=$(realpath -m -- "${1:-$project/build/site}")
# MkDocs empties the folder first, so it has to be one that it made.
if [ -n "$(ls -A "$DOCS_SITE" 2>/dev/null)" ] && [ ! -e "$DOCS_SITE/search/search_index.json" ]; then
  echo "Not empty, and no site: $DOCS_SITE" >&2
  exit 1
fi
mkdir -p "$DOCS_SITE"
DOCS_PAGES=$(mktemp -d "$DOCS_SITE.XXXXXX")
trap 'rm -rf "$DOCS_PAGES"' EXIT
export DOCS_SITE DOCS_PAGES
/usr/bin/python3 "$project/Utilities/docs.py" pages "$project" "$DOCS_PAGES"
# Strict: its warnings are errors. It has much to say otherwise.
log=$(mkdocs build --strict --clean -f "$project/mkdocs.yml" 2>&1) || {
  printf '%s\n' "$log" >&2
  exit 1
}
/usr/bin/python3 "$project/Utilities/docs.py" links "$DOCS_SITE"
