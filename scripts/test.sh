#!/usr/bin/env bash
# Sets up, builds the release and runs all tests but those that take long.
set -euo pipefail

usage() {
  cat <<TEXT
Usage: scripts/test.sh [--joined]

Installs what a build needs (scripts/setup.sh), builds build/release and runs all tests but those with the label long,
which scripts/check_all.sh runs, too.

  --joined   compile a dozen sources at a time, for most of the time goes into headers that all have in common: a whole
             build takes less time, one after a change takes more
TEXT
}
if [ "$#" -gt 1 ]; then usage >&2; exit 2; fi
options=()
case "${1:-}" in
  -h | --help) usage; exit 0 ;;
  --joined) options=(-DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=12) ;;
  "") ;;
  *) usage >&2; exit 2 ;;
esac

cd "$(dirname "${BASH_SOURCE[0]}")/.."
jobs=$(nproc)

scripts/setup.sh build
cmake --preset release "${options[@]}"
cmake --build build/release --parallel "$jobs"
# In an order of chance: none may need what another one leaves.
ctest --test-dir build/release --output-on-failure --parallel "$jobs" --schedule-random --no-tests=error --label-exclude long
