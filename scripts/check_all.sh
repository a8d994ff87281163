#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What .ci/run checks, at length: all cases, all sources alone, one thread and many, new inputs for the fuzz targets.
set -euo pipefail

usage() {
  cat <<TEXT
Usage: scripts/check_all.sh [STEP...]

Does at length what .ci/run does in a hurry, and prints how long each STEP took. Steps, all by default:

  release   builds without precompiled headers, so that each source has to include what it uses, and runs all tests
  serial    builds as where there is no oneTBB, runs all tests, and compares results with those of threads
  plain     builds as on macOS and BSD, without what only Linux has, with clang, and runs all tests
  headers   each header compiles alone
  tidy      clang-tidy with all checks and the static analyzer, on each source alone
  sanitize  all tests but those of the package and of memory under ASan and UBSan, with all their cases
  fuzz      each fuzz target tries its stored inputs and changes of them, 1,000 in all
  threads   all tests but those of programs, scripts, the package and memory under the thread sanitizer

Structure and formatting are checked by .ci/run alone. Takes some hours on two cores. Exit code 1 if anything failed.
TEXT
}
case "${1:-}" in -h | --help) usage; exit 0 ;; esac

steps=(release serial plain headers tidy sanitize fuzz threads)
chosen=("$@")
if [ "$#" -eq 0 ]; then chosen=("${steps[@]}"); fi
for name in "${chosen[@]}"; do
  [[ " ${steps[*]} " == *" $name "* ]] || { usage >&2; exit 2; }
done

cd "$(dirname "${BASH_SOURCE[0]}")/.."
jobs=$(nproc)
summary=()
failed=0

run_tests() { ctest --test-dir "$1" --output-on-failure --parallel "$jobs" --schedule-random --no-tests=error "${@:2}"; }

check_release() {
  cmake --preset release -B build/check &&
    cmake build/check -DMESHREPAIR_PRECOMPILE=OFF -DCMAKE_UNITY_BUILD=OFF &&
    cmake --build build/check --parallel "$jobs" &&
    run_tests build/check
}

# Headers of oneTBB may be there all the same, but none may be read.
check_serial() {
  cmake --preset release -B build/serial -DMESHREPAIR_PARALLEL=OFF -DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON &&
    cmake --build build/serial --parallel "$jobs" &&
    ninja -C build/serial -t deps >build/serial/headers.txt && ldd build/serial/bin/meshrepair >build/serial/libraries.txt &&
    ! grep -F -e /tbb/ -e /oneapi/ build/serial/headers.txt && ! grep -F libtbb build/serial/libraries.txt &&
    run_tests build/serial &&
    cmake --preset release -B build/check &&
    cmake --build build/check --parallel "$jobs" --target app_meshrepair &&
    compare_results build/serial build/check
}

compare_results() {
  local mesh
  for mesh in samples/meshes/*.{obj,off,ply,stl}; do
    "$1/bin/meshrepair" "$mesh" build/serial/one.ply --sources --always --quiet &&
      "$2/bin/meshrepair" "$mesh" build/serial/other.ply --sources --always --quiet --threads 7 &&
      cmp build/serial/one.ply build/serial/other.ply || return
  done
}

check_plain() {
  local options=(-DMESHREPAIR_PLAIN_POSIX=ON -DCMAKE_CXX_COMPILER=clang++ -DMESHREPAIR_PRECOMPILE=OFF
                 -DMESHREPAIR_BUILD_{BENCH,SAMPLES,PYTHON}=OFF)
  cmake --preset release -B build/plain "${options[@]}" &&
    cmake --build build/plain --parallel "$jobs" &&
    run_tests build/plain --label-exclude package
}

check_headers() {
  cmake --preset release -B build/check &&
    cmake --build build/check --parallel "$jobs" --target all_verify_interface_header_sets
}

check_tidy() { scripts/tidy.sh --all; }

# Sanitizers end the process where memory ends.
check_sanitize() {
  cmake --preset asan-ubsan &&
    cmake --build build/asan-ubsan --parallel "$jobs" &&
    ASAN_OPTIONS=detect_leaks=1 UBSAN_OPTIONS=print_stacktrace=1 \
      run_tests build/asan-ubsan --label-exclude 'package|memory'
}

# The same random numbers each time, and nothing that was found before: whether a commit passes should not be chance.
check_fuzz() { rm -rf build/fuzz/none && FUZZ_CORPUS=$PWD/build/fuzz/none scripts/fuzz.sh all 0 -seed=1 -runs=1000; }

# oneTBB is not built for it: libbase/src/parallel.cpp tells what that does, so what is found is ours.
check_threads() {
  cmake --preset tsan &&
    cmake --build build/tsan --parallel "$jobs" &&
    TSAN_OPTIONS=ignore_noninstrumented_modules=1 \
      run_tests build/tsan --label-exclude 'package|memory|scripts|cli'
}

scripts/setup.sh all
for name in "${chosen[@]}"; do
  echo
  echo "==== $name"
  start=$SECONDS verdict=ok
  "check_$name" || { verdict=FAILED; failed=1; }
  summary+=("$(printf '%-7s %5d s  %s' "$verdict" "$((SECONDS - start))" "$name")")
done

echo
printf '%s\n' "${summary[@]}"
exit "$failed"
