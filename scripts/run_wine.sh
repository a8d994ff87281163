#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs a program for Windows, with a Windows folder of its own in build/wine, without what wine says of itself.
#
# Usage: scripts/run_wine.sh PROGRAM [ARGUMENT...]
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
export WINEPREFIX=${WINEPREFIX:-$root/build/wine} WINEDEBUG=${WINEDEBUG:--all}
# Starting its server takes longer than a program: it waits a minute for the next one.
"$(command -v wineserver64 || echo /usr/lib/wine/wineserver64)" -p60 2>/dev/null || true
exec "$(command -v wine64 || echo /usr/lib/wine/wine64)" "$@"
