#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the programs for Windows on x86-64, and of them build/packages/meshrepair-VERSION-windows-x64.zip.
#
# Usage: scripts/make_windows.sh [PARALLEL]
#
# PARALLEL: how many compilers run at a time; as many as there are processors by default. Needs what scripts/setup.sh windows installs.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
case "${1:-}" in
  -h | --help) sed -n '3,7s/^# \{0,1\}//p' "$0"; exit 0 ;;
esac
"$root/scripts/make_dependencies.sh" windows
cd "$root"
cmake --preset windows
cmake --build --preset windows --parallel "${1:-$(nproc)}"

version=$(sed -n 's/^project(meshrepair VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
name=meshrepair-$version-windows-x64
folder=build/windows/package/$name
rm -rf "build/windows/package" "build/packages/$name.zip"
mkdir -p "$folder" build/packages
cp build/windows/bin/*.exe LICENSE README.md CHANGELOG.md "$folder"
python3 scripts/notice.py windows >"$folder/NOTICE"
# The same in, the same out.
find "$folder" -exec touch --date="@${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct)}" {} +
(cd build/windows/package && find "$name" -type f | LC_ALL=C sort | zip --quiet -X "$root/build/packages/$name.zip" -@)
ls -l "build/packages/$name.zip"
