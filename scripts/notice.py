#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints what has to go with what is linked statically: the licence of the project, and those of all that is in it, as Debian has them.

Usage: notice.py wasm|windows
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
# Of each system what is linked, and what of the compiler's own is in it.
SYSTEMS = {
    "wasm": ("meshrepair.wasm contains", {"emscripten": "emscripten"}),
    "windows": ("The programs contain", {"libgcc and libstdc++": "gcc-mingw-w64-x86-64-posix-runtime", "mingw-w64": "mingw-w64-x86-64-dev"}),
}
LEFT_OUT = ("tests/", "test/", "debian/", "third_party/", "bench/", "unsupported/", "doc/", "docs/", "examples/", "programs/", "contrib/",
            "tools/", "media/", "site/", "system/include/")
RULE = "\n\n" + "=" * 100 + "\n\n"


def field(stanza, name):
    found = re.search(rf"^{name}:(.*(?:\n[ \t].*)*)", stanza, re.MULTILINE)
    return found[1] if found else None


def of_what_is_linked(text):
    """A copyright file without what it says of tests, tools and packaging, and without licences that nothing else has."""
    stanzas = re.split(r"\n[ \t]*\n", text.strip())
    if field(stanzas[0], "Format") is None:
        return text.strip()
    kept = [stanza for stanza in stanzas
            if field(stanza, "Files") is None or not all(name.startswith(LEFT_OUT) for name in field(stanza, "Files").split())]
    used = " ".join(field(stanza, "License").split("\n")[0] for stanza in kept if field(stanza, "Files") and field(stanza, "License"))
    names = set(re.split(r"[\s,()]+", used))
    return "\n\n".join(stanza for stanza in kept
                       if field(stanza, "Files") or field(stanza, "License") is None or field(stanza, "License").split()[0] in names)


def notice(system):
    """The licence, and the copyright files of what is linked, as Debian has them."""
    begins, packages = SYSTEMS[system]
    parts = ["meshrepair\n\n" + (ROOT / "LICENSE").read_text().strip()]
    folder = ROOT / f"build/{system}-dependencies/share/doc"
    others = {path.parent.name: path for path in folder.glob("*/copyright") if path.parent.name != "googletest"}
    others |= {name: pathlib.Path(f"/usr/share/doc/{package}/copyright") for name, package in packages.items()}
    viewer = re.search(r"/\* This file contains three\.js:\n(.*?)\*/", (ROOT / "web/viewer/dist/viewer.html").read_text(), re.DOTALL)
    parts.append("three.js\n\n" + viewer[1].strip())
    for name in sorted(others):
        parts.append(f"{name}\n\n" + of_what_is_linked(others[name].read_text()))
    return begins + " what follows, each with its licence." + RULE + RULE.join(parts) + "\n"


def main():
    if len(sys.argv) != 2 or sys.argv[1] not in SYSTEMS:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    sys.stdout.write(notice(sys.argv[1]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
