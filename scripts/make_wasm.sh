#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the module of WebAssembly, and of it the package of npm in build/wasm/package, and of that the page in build/wasm/page.
#
# Usage: scripts/make_wasm.sh [PARALLEL]
#
# PARALLEL: how many compilers run at a time; as many as there are processors by default. Needs what scripts/setup.sh wasm installs.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
export NODE_PATH=${NODE_PATH:-/usr/share/nodejs}

case "${1:-}" in
  -h | --help) sed -n '2,6s/^# \{0,1\}//p' "$0"; exit 0 ;;
esac
"$root/scripts/make_dependencies.sh" wasm
cd "$root"
cmake --preset wasm
cmake --build --preset wasm --parallel "${1:-$(nproc)}"
python3 "$root/scripts/wasm/make_package.py"
node "$root/web/page/bundle.mjs" "$root/build/wasm/package" "$root/web/viewer/dist/viewer.html" "$root/build/wasm/page"
