#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the interface of libmeshrepair.so: abi_test.py LIBRARY WORK [--update]

- The library shows the functions that meshrepair.h declares, and no other symbol.
- abidiff finds that programs that were built with the interface in capi/meshrepair_0.abi still run. Types are read out of a library
  of empty functions that is made of the header, so that they are what the header says.

--update writes capi/meshrepair_0.abi anew: after functions were added, or when the number of the library changes. Ends with 77 where
there is no abidiff.
"""

import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
HEADER = ROOT / "capi/include/meshrepair.h"
BASE = ROOT / "capi/meshrepair_0.abi"
DECLARATION = re.compile(r"^MESHREPAIR_API ([^;]*?(meshrepair_\w+)\([^;]*\));", re.MULTILINE)


def shown_by(library):
    lines = subprocess.run(["nm", "-D", "--defined-only", library], check=True, capture_output=True, text=True).stdout.splitlines()
    return {line.split()[2].split("@")[0] for line in lines} - {"MESHREPAIR_0"}


def interface_of(work):
    """The XML of a library with the functions of the header, all empty."""
    work.mkdir(parents=True, exist_ok=True)
    source = work / "interface.c"
    functions = "".join(f"{declaration} {{ __builtin_trap(); }}\n" for declaration, _ in DECLARATION.findall(HEADER.read_text()))
    source.write_text(f"#include <meshrepair.h>\n{functions}")
    library = work / "libmeshrepair.so.0"
    subprocess.run(["gcc", "-g", "-O0", "-w", "-shared", "-fPIC", "-Wl,-soname,libmeshrepair.so.0", "-I", HEADER.parent, source, "-o", library],
                   check=True)
    written = work / "interface.abi"
    subprocess.run(["abidw", "--no-show-locs", "--no-corpus-path", "--no-comp-dir-path", "--out-file", written, library], check=True)
    return written


def main():
    library, work = sys.argv[1:3]
    if shutil.which("abidiff") is None or shutil.which("gcc") is None:
        print("skipped: there is no abidiff; scripts/setup.sh all installs it")
        return 77
    declared = {name for _, name in DECLARATION.findall(HEADER.read_text())}
    assert len(declared) > 30, declared
    shown = shown_by(library)
    assert shown == declared, f"only in the header: {declared - shown}; only in the library: {shown - declared}"
    now = interface_of(Path(work) / "abi")
    if "--update" in sys.argv:
        shutil.copy(now, BASE)
        return 0
    compared = subprocess.run(["abidiff", BASE, now], capture_output=True, text=True)
    print(compared.stdout + compared.stderr)
    if compared.returncode != 0:
        verb = "breaks programs" if compared.returncode & 8 else "differs, which may be fine"
        print(f"the interface {verb}: see docs/stability.md, then run tests/capi/abi_test.py with --update")
    return 1 if compared.returncode else 0


if __name__ == "__main__":
    sys.exit(main())
