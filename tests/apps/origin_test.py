#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Repairs meshes and clouds far from the origin: their volumes do not depend on where they are, and all comes back.

Usage: origin_test.py PROGRAMS [COUNT]
"""

import json
import math
import pathlib
import random
import struct
import subprocess
import sys
import tempfile
import unittest

PROGRAMS = pathlib.Path()
COUNT = 3  # meshes and clouds
PLACES = ((500_000.0, 4_649_776.0, 120.0), (1e7, -1e7, 1e7), (691_607.8125, 5_334_760.5, 0.0))
FORMATS = ("stl", "glb", "3mf", "obj", "ply")


def house(chance):
    """Corners of boxes that intersect, with coordinates that are short decimals; one triangle is missing."""
    triangles = []
    for _ in range(chance.randint(2, 4)):
        low = [chance.randint(0, 8000) / 1000 for _ in range(3)]
        high = [x + chance.randint(2000, 9000) / 1000 for x in low]
        corner = [tuple((high if i >> k & 1 else low)[k] for k in range(3)) for i in range(8)]
        for a, b, c, d in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
            triangles += [(corner[a], corner[b], corner[c]), (corner[a], corner[c], corner[d])]
    return triangles[:-1]


def write_obj(path, triangles, place):
    lines = []
    for number, corners in enumerate(triangles):
        lines += ["v " + " ".join(repr(x + offset) for x, offset in zip(point, place)) for point in corners]
        lines.append(f"f {3 * number + 1} {3 * number + 2} {3 * number + 3}")
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def write_terrain(path, chance, place):
    bumps = [(chance.uniform(0, 8), chance.uniform(0, 8), chance.uniform(0.5, 2)) for _ in range(5)]
    with open(path, "w", encoding="ascii") as file:
        for i in range(40):
            for j in range(40):
                x, y = round(0.2 * i + chance.uniform(-0.05, 0.05), 3), round(0.2 * j + chance.uniform(-0.05, 0.05), 3)
                z = round(sum(h * math.exp(-(x - a) ** 2 - (y - b) ** 2) for a, b, h in bumps), 3)
                file.write(" ".join(repr(value + offset) for value, offset in zip((x, y, z), place)) + "\n")


def volume_of_stl(path):
    """By itself, of float32."""
    data = path.read_bytes()
    total = 0.0
    for at in range(84, len(data), 50):
        a, b, c = (struct.unpack_from("<3f", data, at + 12 * (1 + k)) for k in range(3))
        total += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
    return total


class Origin(unittest.TestCase):

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="origin_"))

    def run_program(self, name, *arguments, code=0):
        result = subprocess.run([PROGRAMS / name, *map(str, arguments)], capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, code, result.stderr)
        return result.stderr

    def repaired(self, path, name, *options):
        self.run_program("meshrepair", path, self.folder / name, *options, "--report", self.folder / "r.json")
        return json.loads((self.folder / "r.json").read_text(encoding="utf-8"))

    def check_everywhere(self, write, options):
        for number in range(COUNT):
            place = PLACES[number % len(PLACES)]
            near, far = self.folder / "near", self.folder / "far"
            write(near, random.Random(number), (0, 0, 0))
            write(far, random.Random(number), place)
            for ending in FORMATS:
                with self.subTest(number=number, place=place, format=ending):
                    right = self.repaired(near, f"near.{ending}", *options)["result"]["volume"]
                    report = self.repaired(far, f"far.{ending}", *options, "--origin", "auto")
                    self.assertAlmostEqual(report["result"]["volume"] / right, 1, delta=1e-6)
                    self.assertEqual(report["warnings"], [])
                    self.assertLess(max(abs(a - b) for a, b in zip(report["origin"]["offset"], place)), 100)
            self.assertAlmostEqual(volume_of_stl(self.folder / "far.stl") / volume_of_stl(self.folder / "near.stl"), 1, delta=1e-5)

    def test_volumes_of_meshes_are_those_at_the_origin(self):
        self.check_everywhere(lambda path, chance, place: write_obj(path, house(chance), place), ("--seal", "none"))

    def test_volumes_of_clouds_are_those_at_the_origin(self):
        self.check_everywhere(write_terrain, ("--base",))

    def test_corners_come_back_bit_for_bit(self):
        for number in range(COUNT):
            path = self.folder / "in.obj"
            write_obj(path, house(random.Random(number)), PLACES[number % len(PLACES)])
            self.run_program("meshconvert", path, self.folder / "as_given.off")
            given = set(self.points_of("as_given.off"))
            for ending in ("obj", "ply", "off"):
                self.repaired(path, f"near.{ending}", "--origin", "auto")
                self.run_program("meshconvert", self.folder / f"near.{ending}", self.folder / "back.off", "--restore-origin")
                back = set(self.points_of("back.off"))
                # The corners of the boxes; others lie where boxes intersect.
                self.assertGreaterEqual(len(given & back), 8, ending)
                self.run_program("meshconvert", path, self.folder / f"there.{ending}", "--origin", "auto")
                self.run_program("meshconvert", self.folder / f"there.{ending}", self.folder / "back.off", "--restore-origin")
                self.assertEqual((self.folder / "back.off").read_bytes(), (self.folder / "as_given.off").read_bytes())

    def points_of(self, name):
        for line in (self.folder / name).read_text(encoding="ascii").splitlines()[2:]:
            words = line.split()
            if len(words) == 3:
                yield tuple(words)

    def test_what_is_lost_is_said_before_anything_is_written(self):
        path = self.folder / "in.obj"
        write_obj(path, house(random.Random(1)), PLACES[0])
        said = self.run_program("meshrepair", path, self.folder / "out.stl")
        self.assertRegex(said, r"single precision \(float32\) has steps of 0.5 .* --origin auto .*W-FLOAT32-STEP")
        self.assertNotIn("FLOAT32", self.run_program("meshrepair", path, self.folder / "out.obj"))
        self.assertNotIn("FLOAT32", self.run_program("meshrepair", path, self.folder / "out.stl", "--origin", "none"))
        write_obj(path, house(random.Random(1)), (0, 0, 0))
        self.assertNotIn("FLOAT32", self.run_program("meshrepair", path, self.folder / "out.stl"))

    def test_two_meshes_have_one_origin(self):
        for name, seed in (("a.obj", 1), ("b.obj", 2)):
            write_obj(self.folder / name, house(random.Random(seed)), PLACES[0])
            self.repaired(self.folder / name, "near_" + name, "--origin", "auto")
        sizes = set()
        for first, second in (("a.obj", "b.obj"), ("near_a.obj", "b.obj"), ("near_a.obj", "near_b.obj"), ("a.obj", "near_b.obj")):
            self.run_program("bspbool", self.folder / first, self.folder / second, "--op", "intersection", "--origin", "auto", "-o",
                             self.folder / "both.stl", "--report", self.folder / "r.json")
            sizes.add(round(json.loads((self.folder / "r.json").read_text(encoding="utf-8"))["result"]["volume"], 4))
            if "near_a.obj" == first:  # its offset is that of the output
                self.run_program("meshbodies", self.folder / first, self.folder / second, "-o", self.folder / "bodies.obj", "--report",
                                 self.folder / "r.json")
                overlap = json.loads((self.folder / "r.json").read_text(encoding="utf-8"))["bodies"]["overlap_volume"]
                sizes.add(round(overlap, 4))
                self.assertIn("# offset ", (self.folder / "bodies.obj").read_text(encoding="utf-8"))
        self.assertEqual(len(sizes), 1, sizes)
        self.run_program("meshdist", self.folder / "near_a.obj", self.folder / "a.obj", "--report", self.folder / "r.json")
        self.assertLess(json.loads((self.folder / "r.json").read_text(encoding="utf-8"))["distance"]["a_to_b"]["hausdorff"], 20)


if __name__ == "__main__":
    PROGRAMS = pathlib.Path(sys.argv[1])
    if len(sys.argv) > 2:
        COUNT = int(sys.argv[2])
    unittest.main(argv=sys.argv[:1], verbosity=2)
