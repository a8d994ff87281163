#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the benchmarks that stand beside the tables of the basis paper, runs them, and writes bench/RESULTS.md.
set -euo pipefail

case "${1:-}" in
  -h | --help)
    cat <<TEXT
Usage: scripts/paper_tables.sh [MESH ...]

Installs what the comparisons need (scripts/setup.sh bench), builds into build/tables, and writes the tables to
bench/RESULTS.md; the section "Beside other tools", which comes from bench/repair_table.py, stays. MESHes are repaired
beside the models of the tables. Takes a quarter of an hour on two cores; nothing else should run meanwhile.
TEXT
    exit 0
    ;;
esac

meshes=()
for mesh in "$@"; do meshes+=("$(realpath "$mesh")"); done
cd "$(dirname "${BASH_SOURCE[0]}")/.."
scripts/setup.sh bench
cmake -B build/tables -G Ninja -DCMAKE_BUILD_TYPE=Release -DMESHREPAIR_BUILD_TESTS=OFF \
  -DMESHREPAIR_BUILD_BENCH=ON -DMESHREPAIR_BENCH_OTHERS=ON
cmake --build build/tables --parallel "$(nproc)" --target paper_tables
bench/paper_tables.py build/tables/bin "${meshes[@]}" > build/tables/RESULTS.md
{ echo; sed -n '/^## Beside other tools$/,$p' bench/RESULTS.md; } >> build/tables/RESULTS.md
mv build/tables/RESULTS.md bench/RESULTS.md
echo "written: bench/RESULTS.md"
