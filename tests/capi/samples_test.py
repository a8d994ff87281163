#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the samples of the C interface: samples_test.py c SAMPLE MESHREPAIR | rust FOLDER_OF_LIBRARY WORK

Ends with 77 where there is no cargo.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
BROKEN = ROOT / "samples/meshes/broken_torus_box.stl"


def test_c(sample, meshrepair):
    """The sample does what the program does, and says the same where it cannot."""
    with tempfile.TemporaryDirectory() as folder:
        out, other = Path(folder) / "out.obj", Path(folder) / "other.obj"
        ran = subprocess.run([sample, BROKEN, out], capture_output=True, text=True)
        assert ran.returncode == 0, ran
        assert re.fullmatch(r"\d+ vertices, \d+ triangles, certified\n", ran.stdout), ran.stdout
        assert "certify" in ran.stderr, ran.stderr
        subprocess.run([meshrepair, BROKEN, other, "--for", "print", "-q"], check=True)
        assert out.read_bytes() == other.read_bytes()
        missing = subprocess.run([sample, Path(folder) / "none.stl", out], capture_output=True, text=True)
        assert missing.returncode == 3 and "none.stl" in missing.stderr, missing


def test_rust(library, work):
    cargo = shutil.which("cargo") or shutil.which("cargo", path=os.path.expanduser("~/.cargo/bin"))
    if cargo is None:
        print("skipped: there is no cargo")
        return 77
    environment = dict(os.environ, MESHREPAIR_LIB_DIR=library, PATH=f"{Path(cargo).parent}:{os.environ['PATH']}")
    ran = subprocess.run([cargo, "run", "--quiet", "--offline", "--locked", "--target-dir", work], cwd=ROOT / "samples/rust",
                         env=environment, capture_output=True, text=True)
    assert ran.returncode == 0, ran
    assert ran.stdout == "12 triangles, volume 1\n", ran.stdout
    return 0


if __name__ == "__main__":
    sys.exit({"c": test_c, "rust": test_rust}[sys.argv[1]](*sys.argv[2:]))
