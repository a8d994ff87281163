#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of the Python package: files and folders, and running the program.

Usage: files_test.py PACKAGES [CLASS]

PACKAGES is the folder that holds the package meshrepair, as build/release/python; CLASS one of the classes of tests below.

Example: tests/python/files_test.py build/release/python Files
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True

import package_under_test as package  # finds the package
import meshrepair
from package_under_test import CUBE, MESHES, PRELOADED, TRIANGLES


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="package_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_what_is_written_is_read_back(self):
        for extension in ("obj", "ply", "off", "glb", "3mf", "obj.gz"):
            path = self.folder / f"cube.{extension}"
            meshrepair.write(path, CUBE, TRIANGLES)
            back = meshrepair.read(path)
            self.assertTrue((back.vertices[back.faces] == CUBE[TRIANGLES]).all(), extension)

    def test_points_are_read(self):
        (self.folder / "a.xyz").write_text("0 0 0 0.6 0 0.8\n1 0 0 0.6 0 0.8\n0 1 0 0.6 0 0.8\n")
        points = meshrepair.read(self.folder / "a.xyz")
        self.assertEqual(points.points.tolist(), [[0, 0, 0], [1, 0, 0], [0, 1, 0]])
        self.assertEqual(points.normals.tolist(), [[0.6, 0, 0.8]] * 3)

    def test_sources_are_written(self):
        result = meshrepair.repair(CUBE, TRIANGLES[1:])
        meshrepair.write(self.folder / "a.ply", result, sources=True)
        self.assertIn(b"source_triangle", (self.folder / "a.ply").read_bytes())
        with self.assertRaisesRegex(meshrepair.UsageError, "only PLY"):
            meshrepair.write(self.folder / "a.obj", result, sources=True)
        for sources, words in (([2 ** 40] * 12, "^sources: row 0 is 1099511627776"), ([-2] * 12, "^sources: row 0 is -2"),
                               ([[0, 1]] * 12, r"^sources: has shape \(12, 2\)"), ([0.5] * 12, "^sources: ")):
            with self.assertRaisesRegex(meshrepair.UsageError, words):
                meshrepair.write(self.folder / "b.ply", CUBE, TRIANGLES, sources=sources)

    def test_units_go_along(self):
        meshrepair.write(self.folder / "a.3mf", CUBE, TRIANGLES, unit="inch")
        mesh = meshrepair.read(self.folder / "a.3mf")
        self.assertEqual((mesh.unit, meshrepair.repair(mesh).unit), ("inch", "inch"))
        with self.assertRaisesRegex(meshrepair.UsageError, "^unit: ell is none of micron"):
            meshrepair.write(self.folder / "b.3mf", CUBE, TRIANGLES, unit="ell")

    def test_a_file_is_repaired_and_reported(self):
        report = meshrepair.repair_file(MESHES / "broken_torus_box.stl", self.folder / "a.obj", distance=True)
        self.assertEqual((report["exit_code"], report["warnings"]), (0, []))
        self.assertIn("distance", report)
        self.assertTrue(meshrepair.check(meshrepair.read(self.folder / "a.obj")))

    def test_a_failure_leaves_what_was_there(self):
        (self.folder / "a.obj").write_text("old")
        with self.assertRaises(meshrepair.InputError):
            meshrepair.repair_file(self.folder / "none.stl", self.folder / "a.obj")
        self.assertEqual((self.folder / "a.obj").read_text(), "old")

    def test_names_that_are_no_text(self):
        path = os.path.join(os.fsencode(self.folder), b"\xff.obj")
        meshrepair.write(path, CUBE, TRIANGLES)
        self.assertEqual(len(meshrepair.read(path).faces), 12)
        with self.assertRaises(meshrepair.InputError):
            meshrepair.read(path + b"x")

    def test_a_folder_is_repaired(self):
        (self.folder / "in").mkdir()
        for name in ("cube.stl", "broken_torus_box.stl"):
            (self.folder / "in" / name).symlink_to(MESHES / name)
        summary = meshrepair.repair_folder(self.folder / "in", self.folder / "out", format="obj", jobs=2, max_memory="2G",
                                           inside="winding", max_hole=0.5)
        self.assertEqual(sorted(path.name for path in (self.folder / "out").glob("*.obj")), ["broken_torus_box.obj", "cube.obj"])
        self.assertIsInstance(summary, dict)
        with self.assertRaisesRegex(meshrepair.UsageError, "refuses the options"):
            meshrepair.repair_folder(self.folder / "in", self.folder / "other", inside="magic")

    def test_python_runs_the_program(self):
        if PRELOADED:
            self.skipTest("Python and the program that takes its place would need different runtimes")
        environment = {**os.environ, "PYTHONPATH": os.path.dirname(os.path.dirname(os.path.abspath(meshrepair.__file__)))}
        result = subprocess.run([sys.executable, "-m", "meshrepair", "--inside", "magic", "a", "b"], env=environment,
                                capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, "^meshrepair: --inside: magic not in ")


if __name__ == "__main__":
    package.main()
