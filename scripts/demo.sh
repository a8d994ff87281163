#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds meshrepair and repairs the broken sample meshes with it.
set -euo pipefail

usage() {
  cat <<TEXT
Usage: scripts/demo.sh [MESH...]

Installs what a build needs (scripts/setup.sh), builds the programs and repairs each MESH, by default the
broken ones in samples/meshes. Prints what was wrong and what came out. Results go to build/demo.
TEXT
}
case "${1:-}" in -h | --help) usage; exit 0 ;; esac

# The user's own meshes are named relative to where the user is.
meshes=()
for mesh in "$@"; do meshes+=("$(realpath -- "$mesh")"); done

cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [ "${#meshes[@]}" -eq 0 ]; then
  shopt -s nullglob
  meshes=(samples/meshes/broken_*.{stl,obj})
fi

scripts/setup.sh build
cmake --preset release >/dev/null
cmake --build build/release --parallel "$(nproc)" --target app_meshrepair
mkdir -p build/demo

failures=0
for mesh in "${meshes[@]}"; do
  name=$(basename -- "$mesh")
  result=build/demo/repaired_${name%.*}.obj
  report=build/demo/${name%.*}.json
  echo
  echo "== $mesh"
  code=0
  build/release/bin/meshrepair "$mesh" "$result" --report "$report" || code=$?
  # 1 is "written, but not every guarantee could be shown": worth saying, no failure of the demonstration.
  case $code in
    0) echo "result: $PWD/$result" ;;
    1) echo "result: $PWD/$result (not certified: see the report)" ;;
    *) echo "demo.sh: meshrepair ended with exit code $code" >&2; failures=$((failures + 1)) ;;
  esac
  echo "report: $PWD/$report"
done
[ "$failures" -eq 0 ]
