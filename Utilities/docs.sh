#!/usr/bin/env bash
# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# usage: Utilities/docs.sh [FOLDER]
#
# Builds a website from the pages of the project in FOLDER (default: build/site). Open index.html
# there; it needs no server and no network. A broken link is an error, also a link to a heading.
# Needs MkDocs and its theme Material; Utilities/setup.sh --docs installs them.
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
  echo "MkDocs or its theme Material is missing. Utilities/setup.sh --docs installs them." >&2
  exit 1
}
git -C "$project" rev-parse --git-dir >/dev/null 2>&1 || {
  echo "This needs a clone made by git, not the source archive." >&2
  exit 1
}

DOCS_SITE=$(realpath -m -- "${1:-$project/build/site}")
# MkDocs empties the folder first, so accept only a folder that is empty or that MkDocs made.
if [ -n "$(ls -A "$DOCS_SITE" 2>/dev/null)" ] && [ ! -e "$DOCS_SITE/search/search_index.json" ]; then
  echo "This folder is not empty and does not contain a site: $DOCS_SITE" >&2
  exit 1
fi
mkdir -p "$DOCS_SITE"
DOCS_PAGES=$(mktemp -d "$DOCS_SITE.XXXXXX")
trap 'rm -rf "$DOCS_PAGES"' EXIT
export DOCS_SITE DOCS_PAGES
/usr/bin/python3 "$project/Utilities/docs.py" pages "$project" "$DOCS_PAGES"
# --strict turns warnings into errors. MkDocs prints a lot, so show its output only if it fails.
log=$(mkdocs build --strict --clean -f "$project/mkdocs.yml" 2>&1) || {
  printf '%s\n' "$log" >&2
  exit 1
}
/usr/bin/python3 "$project/Utilities/docs.py" links "$DOCS_SITE"
