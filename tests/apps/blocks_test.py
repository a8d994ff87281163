#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Repairs a mesh in blocks, as many machines would, by meshrepair-blocks.

Usage: blocks_test.py PROGRAMS
"""

import itertools
import json
import os
import pathlib
import random
import shlex
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

from spilling_test import write_torus

PROGRAMS = pathlib.Path()
RINGS = 5
STL_HEADER = 84  # bytes
STL_RECORD = struct.Struct("<12fH")


def write_stl(path, corners_of_triangles):
    with open(path, "wb") as file:
        file.write(bytes(80) + struct.pack("<I", len(corners_of_triangles)))
        for corners in corners_of_triangles:
            file.write(STL_RECORD.pack(0, 0, 0, *(x for corner in corners for x in corner), 0))


def write_rings(path, rings=RINGS, turns=60, across=30):
    """Pairs of rings that cross, each pair apart from the others; the triangles of all are mixed."""
    records = []
    for i in range(2 * rings):
        write_torus(path, turns, across, 4 * (i // 2) + 0.3 * (i % 2))
        data = path.read_bytes()[STL_HEADER:]
        records += [data[at:at + STL_RECORD.size] for at in range(0, len(data), STL_RECORD.size)]
    random.Random(1).shuffle(records)
    path.write_bytes(bytes(80) + struct.pack("<I", len(records)) + b"".join(records))


def square(z, size=1.0):
    a, b, c, d = (0, 0, z), (size, 0, z), (size, size, z), (0, size, z)
    return [(a, b, c), (a, c, d)]


class Blocks(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="blocks_")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.mesh, self.blocks, self.out = self.folder / "mesh.stl", self.folder / "mesh.blocks", self.folder / "out.ply"

    def run_verb(self, *arguments, code=0):
        """What it says on both streams."""
        done = subprocess.run([PROGRAMS / "meshrepair-blocks", *map(str, arguments)], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stdout + done.stderr

    def plan(self, *options):
        self.run_verb("plan", self.mesh, self.blocks, *options)
        return json.loads((self.blocks / "plan.json").read_text())

    def run_all(self, *options, order=None):
        for block in order or range(1, len(json.loads((self.blocks / "plan.json").read_text())["blocks"]) + 1):
            self.run_verb("run", "-q", self.blocks, "--block", block, *options)

    def join(self, code=0, out=None):
        said = self.run_verb("join", self.blocks, out or self.out, code=code)
        return said, (out or self.out).read_bytes() if code in (0, 1) else None

    def plan_rings(self):
        write_rings(self.mesh)
        return self.plan("--triangles", "1000")

    def test_a_mesh_of_rings(self):
        plan = self.plan_rings()
        self.assertEqual(len(plan["blocks"]), RINGS)
        self.assertEqual(sum(block["triangles"] for block in plan["blocks"]), plan["triangles"])
        self.run_all()
        self.join()
        checked = subprocess.run([PROGRAMS / "meshcheck", self.out], check=False, capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stdout)
        whole = self.folder / "whole.ply"
        subprocess.run([PROGRAMS / "meshrepair", "-q", self.mesh, whole], check=True)
        distance = json.loads(subprocess.run([PROGRAMS / "meshdist", self.out, whole, "--json"], check=True,
                                             capture_output=True).stdout)["distance"]
        self.assertLess(distance["hausdorff"], 1e-4)

    def test_reports_are_as_the_schema_says(self):
        write_rings(self.mesh)
        reports = [self.folder / f"{verb}.json" for verb in ("plan", "run", "join")]
        self.plan("--triangles", "100000", "--report", reports[0])
        self.run_all("--report", reports[1])
        self.run_verb("join", self.blocks, self.out, "--report", reports[2])
        schema = pathlib.Path(__file__).resolve().parent / "report_schema.py"
        subprocess.run([sys.executable, schema, *reports], check=True)

    def test_the_same_bytes_wherever_and_however_often(self):
        results = []
        for threads, order in (("1", [3, 1, 5, 4, 2]), ("2", [1, 2, 2, 3, 5, 4, 1])):
            self.blocks = self.folder / f"blocks{threads}"
            if not self.mesh.exists():
                write_rings(self.mesh)
            self.plan("--triangles", "1000", "--threads", threads)
            self.run_all("--threads", threads, order=order)
            results.append(self.join()[1])
        self.assertEqual(results[0], results[1])

    def test_blocks_of_several_groups(self):
        write_rings(self.mesh)
        self.assertEqual(len(self.plan("--triangles", "100000")["blocks"]), 1)
        shutil.rmtree(self.blocks)
        plan = self.plan("--triangles", "16000")
        self.assertTrue(1 < len(plan["blocks"]) < RINGS)
        self.assertEqual(sum(block["groups"] for block in plan["blocks"]), RINGS)

    def test_what_is_done_is_not_done_again(self):
        self.plan_rings()
        self.run_all(order=[2])
        result = self.blocks / "repaired" / "2.ply"
        before = result.stat().st_mtime_ns
        self.assertIn("block 2 is done already", self.run_verb("run", self.blocks, "--block", 2))
        self.assertEqual(result.stat().st_mtime_ns, before)

    def test_what_is_damaged_is_done_again(self):
        self.plan_rings()
        self.run_all()
        whole = self.join()[1]
        for name in ("2.ply", "2.done"):
            file = self.blocks / "repaired" / name
            data = file.read_bytes()
            file.write_bytes(data[:-9] + b"x" + data[-8:])
            self.assertIn("not repaired: block 2; run: meshrepair-blocks run", self.join(code=3)[0])
            self.run_all(order=[2])
            self.assertEqual(self.join()[1], whole)

    def test_a_block_that_is_damaged(self):
        self.plan_rings()
        file = self.blocks / "blocks" / "3.ply"
        file.write_bytes(file.read_bytes()[:-1])
        self.assertIn("3.ply: is not what the plan says", self.run_verb("run", self.blocks, "--block", 3, code=3))

    def test_a_plan_that_is_damaged(self):
        self.plan_rings()
        plan = self.blocks / "plan.json"
        whole = plan.read_text()
        fewer = json.loads(whole)
        del fewer["blocks"][1]
        for text in ("", "{", "[]", "{}", json.dumps(fewer),
                     json.dumps({**fewer, "blocks": []}), json.dumps({**json.loads(whole), "unit": "ells"}),
                     whole.replace('"groups"', '"grops"'), whole.replace(": 1,", ": -1,", 1),
                     whole.replace('"triangles": ', '"triangles": "a", "b": ', 1)):
            plan.write_text(text)
            said = self.run_verb("join", self.blocks, self.out, code=3)
            self.assertEqual(said.count("\n"), 1)
            self.assertRegex(said, r"plan\.json: (not a plan|(is )?damaged)")

    def test_blocks_that_are_missing_are_named(self):
        self.plan_rings()
        self.run_all(order=[1, 3])
        self.assertIn("not repaired: blocks 2, 4, 5; run", self.join(code=3)[0])
        self.assertFalse(self.out.exists())

    def test_all_blocks_have_the_same_options(self):
        self.plan_rings()
        self.run_all()
        self.run_all("--holes", "flat", order=[4])
        self.assertIn("block 4 was repaired with other options than block 1", self.join(code=3)[0])

    def test_results_of_other_options_do_not_meet(self):
        self.plan_rings()
        self.run_all(order=[1])
        self.run_all("--holes", "flat", order=[1])
        names = sorted(file.name for file in (self.blocks / "repaired").iterdir())
        self.assertEqual(len(names), 2)
        self.assertRegex(names[0], r"^1-[0-9a-f]{8}\.ply$")
        self.assertEqual(names[1], "1.done")

    def test_all_blocks_are_of_the_same_program(self):
        self.plan_rings()
        self.run_all()
        done = self.blocks / "repaired" / "3.done"
        result = json.loads(done.read_text())
        done.write_text(json.dumps({**result, "program": result["program"] + 1}))
        self.assertIn("block 3 was repaired by another build of meshrepair-blocks than block 1; run", self.join(code=3)[0])
        self.run_all(order=[3])
        self.assertEqual(json.loads(done.read_text()), result)
        self.join()

    def test_join_says_with_which_options_a_block_is_to_be_done(self):
        self.plan_rings()
        self.run_all("--holes", "flat", "--always", order=[1, 3, 4, 5])
        self.blocks = self.blocks.rename(self.folder / "it's $HOME")
        said = self.join(code=3)[0]
        self.assertRegex(said, r"; run: meshrepair-blocks run \S.* --block 2 --holes=flat --always=true\n")
        subprocess.run(f"{PROGRAMS}/" + said.split("; run: ")[1], shell=True, check=True, capture_output=True)
        self.join()

    def test_a_file_that_lies_says_nothing_in_a_command(self):
        self.plan_rings()
        self.run_all(order=[1])
        done = self.blocks / "repaired" / "1.done"
        result = json.loads(done.read_text())
        for options in ("--seal=1; touch x; $(touch y)\n", "x\n", "--seal=\u001b[31m\n", "--a\0b\n", "--seal=" + 5000 * "x" + "\n"):
            done.write_text(json.dumps({**result, "options": options}))
            said = self.join(code=3)[0]
            self.assertLess(len(said), 1500)
            words = shlex.split(said.split("; run: ")[1])
            self.assertEqual(words[:2] + words[3:5], ["meshrepair-blocks", "run", "--block", "2"])
            self.assertIn(words[5:], ([], [options[:-1]]))
            self.assertTrue(said[:-1].isprintable())

    def test_what_is_no_file_is_no_part_of_the_folder(self):
        self.plan_rings()
        self.run_all()
        for name, make in itertools.product(("repaired/1.done", "repaired/1.ply", "plan.json"), (os.mkdir, os.mkfifo)):
            file = self.blocks / name
            kept = file.rename(self.folder / "kept")
            make(file)
            self.join(code=3)
            os.rmdir(file) if make is os.mkdir else file.unlink()
            kept.rename(file)
        self.join()

    def test_a_block_in_the_solid_of_another_is_told(self):
        corners = [(x, y, z) for x in (4, 5) for y in (4, 5) for z in (1, 1.5)]
        sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        box = [tuple(corners[i] for i in corner) for a, b, c, d in sides for corner in ((a, b, c), (a, c, d))]
        write_stl(self.mesh, square(0, 10) + box)
        self.assertEqual(len(self.plan("--triangles", "1")["blocks"]), 2)
        self.run_all("--thicken", "4", "--holes", "none")
        self.assertIn("1 part in the solid of another block", self.join(code=1)[0])

    def test_pictures_and_pages_are_of_no_matter(self):
        self.plan_rings()
        self.run_all("-q")
        for option, name in (("--picture", "2.png"), ("--html", "2.html"), ("--explain", "2.ply")):
            file = self.folder / name
            self.run_verb("run", self.blocks, "--block", 2, option, file)
            self.assertTrue(file.exists())
        self.join()

    def test_files_of_the_folder_are_not_replaced(self):
        self.plan_rings()
        for name in ("plan.json", "blocks/1.ply", "repaired/1.done", "repaired/x.ply"):
            file = self.blocks / name
            self.assertIn("among the files of", self.run_verb("run", self.blocks, "--block", 1, "--report", file, code=2))
            self.assertIn("among the files of", self.run_verb("join", self.blocks, self.out, "--report", file, code=2))
        self.assertIn("OUT: ", self.run_verb("join", self.blocks, self.blocks / "blocks" / "6.ply", code=2))
        self.run_all("--report", self.blocks / "report.json")
        self.join(out=self.blocks / "out.ply")

    def test_blocks_go_on_from_states_of_their_own(self):
        self.plan_rings()
        states = self.folder / "states"
        runs = [subprocess.Popen([PROGRAMS / "meshrepair-blocks", "run", "-q", self.blocks, "--block", str(block), "--resume", states])
                for block in range(1, RINGS + 1)]
        self.assertEqual([run.wait() for run in runs], [0] * RINGS)
        self.assertEqual(list(states.iterdir()), [])
        self.join()

    def test_options_of_the_whole_mesh_are_refused(self):
        self.plan_rings()
        self.assertIn("--staging: ", self.run_verb("run", self.blocks, "--block", 1, "--staging", self.folder, code=2))
        self.assertIn("--units: ", self.run_verb("run", self.blocks, "--block", 1, "--units", "mm", code=2))

    def test_an_input_that_is_not_there_leaves_nothing(self):
        self.run_verb("plan", self.mesh, self.blocks, code=3)
        self.assertFalse(self.blocks.exists())

    def test_single_precision(self):
        self.plan_rings()
        self.run_all()
        said, _ = self.join(code=2, out=self.folder / "out.stl")
        self.assertIn("repair them with its --format", said)
        self.run_all("--precision", "float32")
        self.join(code=2, out=self.folder / "out.stl")
        self.run_all("--format", "stl")
        self.join(out=self.folder / "out.stl")
        checked = subprocess.run([PROGRAMS / "meshcheck", "-q", self.folder / "out.stl"], check=False)
        self.assertEqual(checked.returncode, 0)

    def test_a_sheet_is_no_part_of_the_result(self):
        write_rings(self.mesh, 1)
        data = self.mesh.read_bytes()
        sheet = self.folder / "sheet.stl"
        write_stl(sheet, square(50, 3))
        count = struct.unpack("<I", data[80:84])[0] + 2
        self.mesh.write_bytes(bytes(80) + struct.pack("<I", count) + data[84:] + sheet.read_bytes()[84:])
        self.assertEqual(len(self.plan("--triangles", "1000")["blocks"]), 2)
        self.run_all()
        self.assertIn("of 2 blocks", self.join()[0])

    def test_only_sheets(self):
        write_stl(self.mesh, square(0))
        self.plan()
        self.run_all()
        self.assertIn("no block encloses anything", self.join(code=5)[0])

    def test_blocks_that_meet_are_told(self):
        write_stl(self.mesh, square(0) + square(0.1))
        self.assertEqual(len(self.plan("--triangles", "1", "--margin", "0")["blocks"]), 2)
        self.run_all("--thicken", "0.3")
        said, data = self.join(code=1)
        self.assertIn("of different blocks meet: plan with a larger --margin", said)
        self.assertTrue(data)

    def test_one_part_is_one_block(self):
        write_torus(self.mesh, 60, 30, 0)
        self.assertIn("several machines do not help", self.run_verb("plan", self.mesh, self.blocks, "--triangles", 100))

    def test_a_plan_is_not_replaced(self):
        self.plan_rings()
        self.assertIn("there is a plan already", self.run_verb("plan", self.mesh, self.blocks, code=2))

    def test_a_run_that_is_killed_leaves_nothing_half_written(self):
        self.plan_rings()
        rng = random.Random(2)
        for _ in range(20):
            run = subprocess.Popen([PROGRAMS / "meshrepair-blocks", "run", "-q", self.blocks, "--block", "1"])
            time.sleep(rng.uniform(0, 0.3))
            run.send_signal(signal.SIGKILL)
            if run.wait() == 0:
                break
            self.assertIn("not repaired: block", self.join(code=3)[0])
        self.run_all()
        self.join()

    def test_mistakes(self):
        self.assertIn("VERB is required", self.run_verb(code=2))
        self.assertIn("walk not in {plan,run,join}", self.run_verb("walk", code=2))
        self.assertIn("VERB: must precede all options", self.run_verb("-q", "plan", code=2))
        self.assertIn("not a plan", self.run_verb("run", self.folder, "--block", 1, code=3))
        self.assertIn("not a plan", self.run_verb("join", self.folder, self.out, code=3))
        self.plan_rings()
        self.assertIn("--block: must be 1 to 5", self.run_verb("run", self.blocks, "--block", 6, code=2))
        self.assertIn("--block", self.run_verb("run", self.blocks, "--block", 0, code=2))


if __name__ == "__main__":
    PROGRAMS = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
