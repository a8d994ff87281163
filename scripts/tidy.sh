#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs clang-tidy with the checks of .clang-tidy.
set -euo pipefail

usage() {
  cat <<TEXT
Usage: scripts/tidy.sh [--all]

Runs clang-tidy on the libraries and programs. They are looked at 40 sources at a time, joined into one, for most of the time
goes into headers that all have in common. Left out is the one check that takes as long as all others together. What is as it
was when nothing was found in it, in any clone, is not looked at again: ~/.cache/meshrepair/tidy remembers that.

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
  cmake --preset asan-ubsan -B "$folder" -DCMAKE_UNITY_BUILD=OFF -DMESHREPAIR_BUILD_BENCH=ON \
    -DMESHREPAIR_BUILD_SAMPLES=ON >/dev/null
else
  folder=build/tidy-joined
  checks+=,-performance-unnecessary-value-param
  cmake --preset asan-ubsan -B "$folder" -DCMAKE_UNITY_BUILD_BATCH_SIZE=40 -DMESHREPAIR_BUILD_TESTS=OFF \
    >/dev/null
fi

# Looks at one source, unless all that it includes, the checks and the program are as they were when nothing was found.
look_at() {
  local source=$1 key said
  key=$(PYTHONPATH= python3 - "$folder/compile_commands.json" "$source" "$PWD" <<'PYTHON'
import hashlib, json, re, shlex, subprocess, sys
commands, source, root = sys.argv[1:]
entry = next(one for one in json.load(open(commands)) if one["file"] == source)
words = shlex.split(entry["command"])
words = [word for at, word in enumerate(words) if word not in ("-c", "-o") and words[at - 1] != "-o"]
text = subprocess.run([*words, "-E", "-C", "-P", "-Wno-everything"], cwd=entry["directory"], check=True, capture_output=True).stdout
known = " ".join(words).replace(root, "") + text.decode(errors="replace").replace(root, "")
print(hashlib.sha256(known.encode()).hexdigest())
PYTHON
  ) || return
  key=$(printf '%s' "$key" "$checks" "$(cat .clang-tidy)" "$(clang-tidy --version)" | sha256sum | cut -d ' ' -f 1)
  if [ -e "$remembered/$key" ]; then return; fi
  said=$(clang-tidy --quiet -p "$folder" --checks="$checks" --extra-arg=-Wno-sign-conversion \
    --extra-arg=-Wno-unknown-warning-option "$source" 2>&1) || { printf '%s\n' "$said"; return 1; }
  said=$(grep -v -E '^[0-9]+ warnings? (generated|and )' <<<"$said" || true)
  if [ -n "$said" ]; then printf '%s\n' "$said"; else : >"$remembered/$key"; fi
}

remembered=${XDG_CACHE_HOME:-$HOME/.cache}/meshrepair/tidy
mkdir -p "$remembered"
export -f look_at
export folder checks remembered
sed -n 's/^  "file": "\(.*\)",\?$/\1/p' "$folder/compile_commands.json" |
  grep -v -E '/tests/|_verify_interface_|meshrepair_precompiled_|/cmake_pch\.' | sort -u |
  xargs -P "$(nproc)" -I {} bash -c 'look_at "$1"' look_at {}
