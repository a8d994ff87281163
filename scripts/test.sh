#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Sets up, builds the release and runs all tests but those that take long.
set -euo pipefail

usage() {
  cat <<TEXT
Usage: scripts/test.sh

Installs what a build needs (scripts/setup.sh), builds build/release and runs the tests: all but those with the label long, and of
those that try many cases at random a share, 0.2 unless MESHREPAIR_TEST_SHARE says another one. scripts/check_all.sh runs all of it.
TEXT
}
case "${1:-}" in
  -h | --help) usage; exit 0 ;;
  "") ;;
  *) usage >&2; exit 2 ;;
esac

cd "$(dirname "${BASH_SOURCE[0]}")/.."
jobs=$(nproc)

scripts/setup.sh build
cmake --preset release
cmake --build build/release --parallel "$jobs"
# In an order of chance: none may need what another one leaves.
MESHREPAIR_TEST_SHARE=${MESHREPAIR_TEST_SHARE:-0.2} ctest --test-dir build/release --output-on-failure --parallel "$jobs" --schedule-random --no-tests=error --label-exclude long
