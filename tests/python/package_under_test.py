# SPDX-License-Identifier: MIT
"""Finds the package that a script of tests is called with, and has the meshes that several of them use."""

import os
import pathlib
import sys
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
MESHES = ROOT / "samples" / "meshes"
sys.path.insert(0, os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else "")
sys.path.insert(0, str(ROOT / "tests" / "apps"))

# The runtime of a sanitizer, say, is for this process: the programs have their own.
PRELOADED = os.environ.pop("LD_PRELOAD", None)

CUBE = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
TRIANGLES = np.array([t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))])


def soup(boxes, seed=1):
    """Boxes, twelve triangles each, that cross each other."""
    chance = np.random.default_rng(seed)
    turns = np.linalg.qr(chance.standard_normal((boxes, 3, 3)))[0]
    corners = (CUBE - 0.5) @ turns * (0.5 * boxes ** (-1 / 3)) + chance.random((boxes, 1, 3))
    return corners.reshape(-1, 3), (TRIANGLES + 8 * np.arange(boxes)[:, None, None]).reshape(-1, 3)


def same(one, other):
    return one.vertices.tobytes() == other.vertices.tobytes() and one.faces.tobytes() == other.faces.tobytes()


def main():
    del sys.argv[1]
    unittest.main()
