#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs a program for Windows, with a Windows folder of its own in build/wine, without what wine says of itself.
#
# Usage: scripts/run_wine.sh PROGRAM [ARGUMENT...]
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
export WINEPREFIX=${WINEPREFIX:-$root/build/wine} WINEDEBUG=${WINEDEBUG:--all}
wine=$(command -v wine64 || echo /usr/lib/wine/wine64)
# Starting its server takes longer than a program: it waits a minute for the next one. What it starts for itself does not keep the output
# of a program open.
if "$(command -v wineserver64 || echo /usr/lib/wine/wineserver64)" -p60 >/dev/null 2>&1; then
  "$wine" wineboot </dev/null >/dev/null 2>&1
fi
exec "$wine" "$@"
