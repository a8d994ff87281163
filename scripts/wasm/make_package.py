#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Puts the package of npm together in build/wasm/package, of web/package and the module in build/wasm. The same in, the same out.

Usage: make_package.py
"""

import pathlib
import re
import shutil
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
MODULE = ROOT / "build/wasm/web/wasm"
DEPENDENCIES = ROOT / "build/wasm-dependencies/share/doc"
TARGET = ROOT / "build/wasm/package"
LEFT_OUT = ("tests/", "test/", "debian/", "third_party/", "bench/", "unsupported/", "doc/", "docs/", "examples/", "programs/", "contrib/",
            "tools/", "media/", "site/", "system/include/")
RULE = "\n\n" + "=" * 100 + "\n\n"


def version():
    return re.search(r"project\(meshrepair VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


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


def notice():
    """The licence, and the copyright files of what is linked into the module, as Debian has them."""
    parts = ["meshrepair\n\n" + (ROOT / "LICENSE").read_text().strip()]
    others = {path.parent.name: path for path in DEPENDENCIES.glob("*/copyright")}
    others["emscripten"] = pathlib.Path("/usr/share/doc/emscripten/copyright")
    viewer = re.search(r"/\* This file contains three\.js:\n(.*?)\*/", (ROOT / "web/viewer/dist/viewer.html").read_text(), re.DOTALL)
    parts.append("three.js\n\n" + viewer[1].strip())
    for name in sorted(others):
        parts.append(f"{name}\n\n" + of_what_is_linked(others[name].read_text()))
    return "meshrepair.wasm contains what follows, each with its licence." + RULE + RULE.join(parts) + "\n"


def main():
    if len(sys.argv) > 1:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    if not (MODULE / "meshrepair.wasm").is_file():
        print("make_package.py: there is no module; run scripts/make_wasm.sh", file=sys.stderr)
        return 1
    shutil.rmtree(TARGET, ignore_errors=True)
    TARGET.mkdir(parents=True)
    for path in sorted((ROOT / "web/package/src").iterdir()):
        shutil.copyfile(path, TARGET / path.name)
    for name in ("meshrepair.mjs", "meshrepair.wasm"):
        shutil.copyfile(MODULE / name, TARGET / name)
    for name in ("README.md", "index.d.ts"):
        shutil.copyfile(ROOT / "web/package" / name, TARGET / name)
    shutil.copyfile(ROOT / "LICENSE", TARGET / "LICENSE")
    manifest = (ROOT / "web/package/package.json").read_text()
    (TARGET / "package.json").write_text(manifest.replace("@VERSION@", version()))
    (TARGET / "NOTICE").write_text(notice())
    return 0


if __name__ == "__main__":
    sys.exit(main())
