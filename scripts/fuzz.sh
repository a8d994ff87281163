#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the fuzz targets and runs them for a while.
set -euo pipefail

all=(stl obj off ply gltf om threemf packed points tree clip repair)

usage() {
  cat <<TEXT
Usage: scripts/fuzz.sh TARGET|all SECONDS [LIBFUZZER OPTION...]

Installs what the checks need (scripts/setup.sh all), builds build/fuzz and runs a fuzz target for SECONDS, on
the seeds in tests/fuzz/seeds and on what earlier runs found worth keeping, in FUZZ_CORPUS or build/fuzz/corpus. With 0
seconds it only replays these. "all" runs each target for SECONDS, as many at a time as there are processors.

Targets: ${all[*]}

Inputs that break a promise, crash, hang or eat memory go to build/fuzz/findings/TARGET, and the exit code is 1.
To look at one again:

  build/fuzz/bin/fuzz_TARGET build/fuzz/findings/TARGET/crash-...

One of fuzz_repair becomes a mesh, which scripts/minimize.py shrinks, by

  build/fuzz/bin/show_repair_input build/fuzz/findings/repair/crash-... mesh.off

Examples:
  scripts/fuzz.sh ply 60
  scripts/fuzz.sh repair 3600 -jobs=2
  scripts/fuzz.sh all 5
TEXT
}

case "${1:-}" in -h | --help) usage; exit 0 ;; esac
if [ "$#" -lt 2 ] || ! [[ $2 =~ ^[0-9]+$ ]]; then
  usage >&2
  exit 2
fi
name=$1
seconds=$2
shift 2
if [ "$name" = all ]; then targets=("${all[@]}"); else targets=("$name"); fi
if [[ $name == *" "* || " ${all[*]} all " != *" $name "* ]]; then
  echo "fuzz.sh: no target $name: there are ${all[*]}" >&2
  exit 2
fi

cd "$(dirname "${BASH_SOURCE[0]}")/.."
jobs=$(nproc)

scripts/setup.sh all
cmake --preset fuzz >/dev/null
cmake --build build/fuzz --parallel "$jobs"

# Inputs are small: the slowest take a third of this time alone. What takes longer, or more memory, is a finding. An allocation of
# this size by a small file would mean that a count in it was trusted.
limits=(-timeout=60 -rss_limit_mb=2048 -malloc_limit_mb=256)

fuzz() {
  local target=$1
  shift
  local seeds=$PWD/tests/fuzz/seeds/$target corpus=${FUZZ_CORPUS:-$PWD/build/fuzz/corpus}/$target
  local findings=$PWD/build/fuzz/findings/$target dictionary=$PWD/tests/fuzz/dictionaries/$target.dict
  local options=("${limits[@]}" "-artifact_prefix=$findings/" -print_final_stats=1)
  mkdir -p "$corpus" "$findings"
  corpus=$(realpath "$corpus")
  if [ -e "$dictionary" ]; then options+=("-dict=$dictionary"); fi
  # 0 is "for ever" to libFuzzer.
  if [ "$seconds" -eq 0 ]; then options+=(-runs=0); else options+=("-max_total_time=$seconds"); fi
  # With -jobs the logs of each go where it runs.
  (cd build/fuzz && UBSAN_OPTIONS=print_stacktrace=1 \
    "bin/fuzz_$target" "${options[@]}" "$@" "$corpus" "$seeds") >"build/fuzz/$target.log" 2>&1
}

# A line on how it went; what the target said only if it found something.
fuzz_and_tell() {
  local target=$1 verdict=ok code=0
  fuzz "$@" || { code=1; verdict=FINDING; }
  [ "$code" -eq 0 ] || cat "build/fuzz/$target.log"
  printf 'fuzz_%-8s %-8s %s\n' "$target" "$verdict" "$(grep -E 'INITED|DONE' "build/fuzz/$target.log" | tail -1)"
  return "$code"
}

failed=0
running=0
for target in "${targets[@]}"; do
  if [ "$running" -ge "$jobs" ]; then
    wait -n || failed=1
    running=$((running - 1))
  fi
  fuzz_and_tell "$target" "$@" &
  running=$((running + 1))
done
while [ "$running" -gt 0 ]; do
  wait -n || failed=1
  running=$((running - 1))
done
exit "$failed"
