#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs programs with less memory than they would take: they give the same bytes, by a file.

Usage: spilling_test.py PROGRAMS
"""

import json
import math
import os
import pathlib
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAMS = pathlib.Path()
LIMIT = "64M"


def write_torus(path, turns, rings, shift):
    """Binary STL of a bumpy torus with holes and some triangles that face the wrong way."""
    def point(i, j):
        u, v = 2 * math.pi * (i % turns) / turns, 2 * math.pi * (j % rings) / rings
        r = 0.4 + 0.05 * math.sin(9 * u + 4 * v)
        return ((1 + r * math.cos(v)) * math.cos(u) + shift, (1 + r * math.cos(v)) * math.sin(u), r * math.sin(v))

    points = [[point(i, j) for j in range(rings + 1)] for i in range(turns + 1)]
    triangles = []
    for i in range(turns):
        for j in range(rings):
            a, b, c, d = points[i][j], points[i + 1][j], points[i + 1][j + 1], points[i][j + 1]
            for number, corners in enumerate(((a, b, c), (a, c, d))):
                count = 2 * (i * rings + j) + number
                if count % 5003 == 0:
                    continue
                triangles.append(corners[::-1] if count % 1009 == 0 else corners)
    with open(path, "wb") as file:
        file.write(bytes(80) + struct.pack("<I", len(triangles)))
        for corners in triangles:
            file.write(struct.pack("<12fH", 0, 0, 0, *(x for corner in corners for x in corner), 0))


class Spilling(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="spilling_")
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.spill = cls.folder / "spill"
        cls.spill.mkdir()
        for name, shift in (("a.stl", 0), ("b.stl", 0.3)):
            write_torus(cls.folder / name, 500, 300, shift)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def run_program(self, name, *arguments, memory, temp=None, code=0, forced="0"):
        """`forced`: blocks of so many bytes lie in the file; 0 leaves it to the limit."""
        command = [PROGRAMS / name, "-q", *arguments, "--report", "report.json", "--max-memory", memory,
                   "--threads", "2", "--temp", temp or self.spill]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True,
                              env={**os.environ, "MESHREPAIR_SPILL_FROM": forced})
        self.assertEqual(done.returncode, code, done.stderr)
        return json.loads((self.folder / "report.json").read_text()), done.stderr

    def compare(self, name, arguments, output=None, code=0):
        """The report of the run with a limit; it has used the file, and left nothing of it."""
        bytes_of = {}
        reports = {}
        for memory in ("0", LIMIT):
            reports[memory], _ = self.run_program(name, *arguments, memory=memory, code=code)
            bytes_of[memory] = (self.folder / output).read_bytes() if output else b""
        self.assertEqual(bytes_of["0"], bytes_of[LIMIT])
        self.assertNotIn("temp_file", reports["0"])
        self.assertGreater(reports[LIMIT]["temp_file"]["bytes"], 1 << 20)
        self.assertEqual(list(self.spill.iterdir()), [])
        return reports[LIMIT]

    def test_repair(self):
        report = self.compare("meshrepair", ["a.stl", "out.ply"], "out.ply")
        self.assertEqual(report["exit_code"], 0)

    def test_check(self):
        self.compare("meshcheck", ["a.stl"], code=1)

    def test_boolean(self):
        self.compare("bspbool", ["a.stl", "b.stl", "--op", "union", "-o", "both.off"], "both.off")

    def test_distance(self):
        self.compare("meshdist", ["a.stl", "b.stl"])

    def test_without_a_file_it_gives_up(self):
        report, said = self.run_program("meshrepair", "a.stl", "none.ply", memory=LIMIT, temp="none", code=4)
        self.assertIn("memory limit of 64 MB reached", said)
        self.assertNotIn("temp_file", report)
        self.assertFalse((self.folder / "none.ply").exists())

    def test_a_folder_that_is_not_there(self):
        report, said = self.run_program("meshrepair", "a.stl", "none.ply", memory=LIMIT, temp="gone", code=6)
        self.assertIn("--temp: cannot create a file in gone: No such file or directory", said)

    def test_what_the_file_needs_itself_never_lies_in_it(self):
        write_torus(self.folder / "small.stl", 20, 10, 0)
        for forced in ("0", "1"):
            report, _ = self.run_program("meshrepair", "small.stl", f"{forced}.ply", memory="1G", forced=forced)
            self.assertEqual("temp_file" in report, forced != "0")
        self.assertEqual((self.folder / "0.ply").read_bytes(), (self.folder / "1.ply").read_bytes())

    def test_nothing_is_left_when_it_is_killed(self):
        command = [PROGRAMS / "meshrepair", "-q", "a.stl", "killed.ply", "--max-memory", LIMIT, "--temp", self.spill]
        for number in (signal.SIGKILL, signal.SIGTERM):
            run = subprocess.Popen(command, cwd=self.folder, stderr=subprocess.DEVNULL)
            time.sleep(0.5)
            run.send_signal(number)
            run.wait()
            self.assertEqual(list(self.spill.iterdir()), [])
            self.assertFalse((self.folder / "killed.ply").exists() and run.returncode != 0)


if __name__ == "__main__":
    PROGRAMS = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
