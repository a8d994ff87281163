#!/usr/bin/env bash
# Runs clang-tidy with the checks of .clang-tidy.
set -euo pipefail

usage() {
  cat <<TEXT
Usage: scripts/tidy.sh [--all]

Runs clang-tidy on the libraries and programs. They are looked at 40 sources at a time, joined into one, for most of the time
goes into headers that all have in common. Left out is the one check that takes as long as all others together.

  --all   all checks and clang's static analyzer, on each source alone: samples and benchmarks, too, but for those that
          need other libraries; takes about an hour. The tests' macros cost more time than they find.

Needs what scripts/setup.sh all installs.
TEXT
}
all=no
case "${1:-}" in
  -h | --help) usage; exit 0 ;;
  --all) all=yes ;;
  "") ;;
  *) usage >&2; exit 2 ;;
esac

cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Of joined sources one includes the other.
checks=-bugprone-suspicious-include
if [ "$all" = yes ]; then
  folder=build/tidy
  checks=clang-analyzer-*,-clang-analyzer-optin.*
  cmake --preset asan-ubsan -B "$folder" -DCMAKE_UNITY_BUILD=OFF -DMESHREPAIR_PRECOMPILE=OFF \
    -DMESHREPAIR_BUILD_BENCH=ON -DMESHREPAIR_BUILD_SAMPLES=ON >/dev/null
else
  folder=build/tidy-joined
  checks+=,-performance-unnecessary-value-param
  cmake --preset asan-ubsan -B "$folder" -DCMAKE_UNITY_BUILD_BATCH_SIZE=40 -DMESHREPAIR_BUILD_TESTS=OFF >/dev/null
  # The headers that are compiled before all others have to be there.
  cmake --build "$folder" --target meshrepair_precompiled_common meshrepair_precompiled_apps >/dev/null
fi

sed -n 's/^  "file": "\(.*\)",\?$/\1/p' "$folder/compile_commands.json" |
  grep -v -E '/tests/|_verify_interface_|meshrepair_precompiled_|/cmake_pch\.' | sort -u |
  xargs -P "$(nproc)" -n 1 clang-tidy --quiet -p "$folder" --checks="$checks" \
    --extra-arg=-Wno-sign-conversion --extra-arg=-Wno-unknown-warning-option 2>&1 |
  { grep -v -E '^[0-9]+ warnings? (generated|and )' || true; }
