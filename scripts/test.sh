#!/usr/bin/env bash
# Sets up, builds the release and runs all tests but those that take long.
set -euo pipefail

if [ "$#" -gt 0 ]; then
  echo "Usage: scripts/test.sh"
  echo
  echo "Installs what a build needs (scripts/setup.sh), builds build/release and runs all tests but those with the label long,"
  echo "which scripts/check_all.sh runs, too."
  case "$1" in -h | --help) exit 0 ;; *) exit 2 ;; esac
fi

cd "$(dirname "${BASH_SOURCE[0]}")/.."
jobs=$(nproc)

scripts/setup.sh build
cmake --preset release
cmake --build build/release --parallel "$jobs"
# In an order of chance: none may need what another one leaves.
ctest --test-dir build/release --output-on-failure --parallel "$jobs" --schedule-random --no-tests=error --label-exclude long
