#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes web/viewer/dist/viewer.html, the page that --html writes, of web/viewer/src and three.js. The same sources give the same bytes.
#
# Usage: scripts/make_viewer.sh [--check]
#
# --check compares with what is there instead: exit code 1 where it differs. Exit code 77: the packages of npm are not there, which
# scripts/setup.sh all installs.
set -euo pipefail

folder=$(cd "$(dirname "${BASH_SOURCE[0]}")/../web/viewer" && pwd)
most_bytes=1048576

command -v node >/dev/null || { echo "make_viewer.sh: there is no node" >&2; exit 77; }
made=$(mktemp)
trap 'rm -f "$made"' EXIT
node "$folder/bundle.mjs" "$made"
if [ "$(stat --format=%s "$made")" -gt "$most_bytes" ]; then
  echo "make_viewer.sh: the viewer has more than $most_bytes bytes" >&2
  exit 1
fi
if [ "${1:-}" = --check ]; then
  cmp "$made" "$folder/dist/viewer.html" || { echo "make_viewer.sh: run scripts/make_viewer.sh" >&2; exit 1; }
else
  cp "$made" "$folder/dist/viewer.html"
fi
