#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the Python in README.md and docs/*.md: blocks that look like a session of Python, one after the other.

Usage: documents_test.py PACKAGES

PACKAGES is the folder that holds the package meshrepair, as build/release/python.

Example: tests/python/documents_test.py build/release/python
"""

import doctest
import os
import pathlib
import shutil
import sys
import tempfile

sys.dont_write_bytecode = True

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "docs"))
import documents

# What the examples read.
MESHES = {"broken.stl": "broken_torus_box.stl", "part.stl": "cube.stl", "scans/one.stl": "broken_torus_box.stl"}


def examples_of(document):
    """All of a document as one session."""
    found = []
    for block in documents.blocks(document):
        if block.language == "python":
            if not block.lines[0].startswith(">>> "):
                sys.exit(f"{documents.name_of(document)}:{block.line}: is no session of Python")
            found += [*block.lines, ""]
    return "\n".join(found)


def main():
    sys.path.insert(0, os.path.abspath(sys.argv[1]))
    failed = attempted = 0
    for document in documents.DOCUMENTS:
        text = examples_of(document)
        if not text:
            continue
        test = doctest.DocTestParser().get_doctest(text, {}, documents.name_of(document), str(document), 0)
        with tempfile.TemporaryDirectory(prefix="documents_") as folder:
            for name, mesh in MESHES.items():
                (pathlib.Path(folder) / name).parent.mkdir(exist_ok=True)
                shutil.copy(ROOT / "samples" / "meshes" / mesh, pathlib.Path(folder) / name)
            os.chdir(folder)
            result = doctest.DocTestRunner().run(test)
            os.chdir(ROOT)
        failed, attempted = failed + result.failed, attempted + result.attempted
    print(f"{attempted} examples, {failed} fail")
    return 1 if failed or not attempted else 0


if __name__ == "__main__":
    sys.exit(main())
