#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tries the Python package that is installed: the examples of the README, the program, and a folder.

Usage: try_python.py README MESH REPAIRED

MESH is what the README calls broken.stl; REPAIRED is what the program makes of it, as OBJ. Works in a folder of its own. Says where
the package is.
"""

import doctest
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import meshrepair


def check(is_so, what):
    if not is_so:
        sys.exit(f"try_python.py: {what}")


def try_examples(readme):
    """The README's examples, here, where broken.stl is."""
    text = re.sub(r"^```.*", "", readme.read_text(encoding="utf-8"), flags=re.MULTILINE)  # ends of blocks are no output
    result = doctest.DocTestRunner().run(doctest.DocTestParser().get_doctest(text, {}, readme.name, str(readme), 0))
    check(result.attempted > 0, f"{readme} has no example")
    check(result.failed == 0, f"{result.failed} examples of {readme} fail")
    check(pathlib.Path("repaired.stl").stat().st_size > 0, "the examples wrote no repaired.stl")


def try_program(repaired):
    subprocess.run([sys.executable, "-m", "meshrepair", "--quiet", "broken.stl", "program.obj"], check=True)
    check(pathlib.Path("program.obj").read_bytes() == repaired, "python -m meshrepair gives other bytes than meshrepair")


def try_folder(repaired):
    pathlib.Path("scans/deep").mkdir(parents=True)
    shutil.copy("broken.stl", "scans/deep/part.stl")
    summary = meshrepair.repair_folder("scans", "made", format="obj")
    check(pathlib.Path("made/deep/part.obj").read_bytes() == repaired, f"repair_folder() gives other bytes: {summary}")


def main():
    readme, mesh, repaired = (pathlib.Path(name).absolute() for name in sys.argv[1:])
    with tempfile.TemporaryDirectory(prefix="try_python_") as folder:
        os.chdir(folder)
        shutil.copy(mesh, "broken.stl")
        try_examples(readme)
        try_program(repaired.read_bytes())
        try_folder(repaired.read_bytes())
        os.chdir("/")
    print(f"{meshrepair.__file__}: meshrepair {meshrepair.__version__} works")


if __name__ == "__main__":
    main()
