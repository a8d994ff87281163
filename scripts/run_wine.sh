#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs a program for Windows, with a Windows folder of its own in build/wine, without what wine says of itself.
#
# Usage: scripts/run_wine.sh PROGRAM [ARGUMENT...]
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
export WINEPREFIX=${WINEPREFIX:-$root/build/wine} WINEDEBUG=${WINEDEBUG:--all}
exec "$(command -v wine64 || echo /usr/lib/wine/wine64)" "$@"
