#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Hard inputs are what they say, and meant.py finds what is not as meant.

Run as: hard_inputs_test.py FOLDER_OF_PROGRAMS [test]
"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
BENCH = Path(__file__).resolve().parent.parent.parent / "bench"
sys.path.insert(0, str(BENCH))

try:
    import numpy as np
except ImportError:
    np = None
else:
    from hard_inputs import walls
    from hard_inputs.measure import missing_triangles
    from hard_inputs.meshes import Mesh, read_off
    from make_hard_inputs import FAMILIES, case_of

PROGRAMS = None


def run(script, *words):
    return subprocess.run([sys.executable, BENCH / script, *map(str, words)], capture_output=True, text=True, check=False)


@unittest.skipIf(np is None, "python3-numpy is not installed")
class Truths(unittest.TestCase):
    def test_solids_are_closed_and_turned_outward(self):
        for family in FAMILIES:
            for number in range(8):
                case = case_of(family, number)
                if case.truth.get("code") == 5:
                    self.assertIsNone(case.solid)
                    continue
                if family == "assemblies":
                    self.assertTrue(case.broken.is_closed())
                    self.assertAlmostEqual(case.broken.volume() / case.truth["volume"], 1, delta=0.02)
                    continue
                if case.solid is None:
                    walls_volume = case.truth["area"] * case.truth["thickness"]
                    self.assertGreater(walls_volume, 0)
                    self.assertGreater(case.truth["volume"], 0.9 * walls_volume)
                    continue
                with self.subTest(family=family, number=number):
                    self.assertTrue(case.solid.is_closed())
                    self.assertGreater(case.solid.volume(), 0)
                    self.assertAlmostEqual(case.solid.volume() / case.truth["volume"], 1, delta=0.001)

    def test_double_walls_bound_a_solid_with_a_handle_for_each_hole_but_one(self):
        for shape, handles in (("ball", 0), ("box", 0), ("knot", 2)):
            case = case_of("walls", 0, shape=shape, holes=10, size=0.005)
            self.assertTrue(case.broken.is_closed())
            self.assertEqual(case.broken.genus(), 9 + handles)
            self.assertEqual(case.broken.parts(), 1)
            self.assertLess(case.broken.volume(), 0.6 * case.solid.volume())
            outer = Mesh(case.broken.points, case.broken.triangles[:case.truth["wall_triangles"]])
            self.assertEqual(missing_triangles(case.solid, outer), 0)

    def test_plates_have_the_volume_and_the_handles_of_their_holes(self):
        plate = case_of("patches", 0, shape="plate")
        self.assertAlmostEqual(plate.solid.volume() / plate.truth["volume"], 1, delta=0.001)
        self.assertGreaterEqual(plate.truth["genus"], 1)

    def test_vessels_are_thin(self):
        for name in walls.VESSELS:
            vessel = walls.vessel(name)
            self.assertTrue(vessel.broken.is_closed())
            self.assertLess(vessel.truth["own_volume"], 0.5 * vessel.truth["volume"])

    def test_what_has_no_room_is_refused(self):
        with self.assertRaises(ValueError):
            case_of("walls", 0, shape="knot", holes=100, size=0.05)


@unittest.skipIf(np is None, "python3-numpy is not installed")
class Files(unittest.TestCase):
    def test_the_same_options_make_the_same_files(self):
        with tempfile.TemporaryDirectory() as name:
            folders = [Path(name) / side for side in ("a", "b")]
            for folder in folders:
                self.assertEqual(run("make_hard_inputs.py", "all", folder, "--count", 12).returncode, 0)
            files = sorted(path.name for path in folders[0].iterdir())
            self.assertEqual(len([file for file in files if file.endswith(".json")]), 12)
            for file in files:
                self.assertEqual((folders[0] / file).read_bytes(), (folders[1] / file).read_bytes(), file)
            truth = json.loads((folders[0] / "walls_0000.json").read_text())
            self.assertEqual(truth["genus"], 0)
            solid = read_off(folders[0] / "walls_0000_true.off")
            self.assertAlmostEqual(solid.volume(), truth["volume"])

    def test_wrong_words_are_refused(self):
        self.assertEqual(run("make_hard_inputs.py", "nothing", "/tmp").returncode, 2)
        self.assertEqual(run("make_hard_inputs.py", "walls", "/dev/null/folder").returncode, 6)
        self.assertEqual(run("meant.py", "nothing").returncode, 2)


@unittest.skipIf(np is None, "python3-numpy is not installed")
class Tables(unittest.TestCase):
    def test_sheets_and_soups_are_as_meant(self):
        done = run("meant.py", "sheets", "soups", "--count", 6, "--programs", PROGRAMS)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("| cards | as needed | 3 | 0: 3 |", done.stdout)
        self.assertTrue(done.stdout.endswith("\n0 not as meant\n"))

    def test_trays_and_hollow_bodies_are_as_meant(self):
        done = run("meant.py", "families", "--family", "trays", "--family", "hollows", "--count", 8, "--programs", PROGRAMS)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("| hollows | as needed | 4 | 0: 4 |", done.stdout)

    def test_openings_are_closed_as_meant(self):
        families = [word for name in ("rims", "flanges", "limbs", "hubs") for word in ("--family", name)]
        done = run("meant.py", "families", *families, "--count", 24, "--programs", PROGRAMS)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("| hubs | as needed | 6 | 0: 6 |", done.stdout)

    def test_assemblies_are_one_part(self):
        done = run("meant.py", "families", "--family", "assemblies", "--count", 20, "--programs", PROGRAMS)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("| assemblies | as needed | 20 | 0: 16, 2: 4 |", done.stdout)

    def test_a_program_that_leaves_everything_as_it_is_is_found_out(self):
        with tempfile.TemporaryDirectory() as name:
            fake = Path(name) / "meshrepair"
            fake.write_text('#!/bin/sh\ncp "$1" "$2"\necho \'{"result": {"volume": 1}}\' > "$4"\n')
            fake.chmod(0o755)
            done = run("meant.py", "soups", "--programs", name, "--failures", Path(name) / "kept")
            self.assertEqual(done.returncode, 1)
            self.assertIn("NOT AS MEANT: soup_torus_0.01", done.stdout)
            self.assertTrue((Path(name) / "kept" / "soup_torus_0.01.json").exists())


if __name__ == "__main__":
    PROGRAMS = sys.argv.pop(1)
    unittest.main()
