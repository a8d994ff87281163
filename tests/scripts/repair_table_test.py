#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of bench/repair_table.py.

Usage: repair_table_test.py PROGRAMS [OPTIONS OF UNITTEST]

PROGRAMS is the folder of meshrepair and its sisters. Other tools are scripts of a line; no figure that depends on the load of the
machine is looked at.
"""

import csv
import html.parser
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "bench" / "repair_table.py"

sys.dont_write_bytecode = True
sys.path.insert(0, str(SCRIPT.parent))

from comparison.basics import Stop
from comparison.model_rows import Tool

MESHES = ("cube.stl", "broken_torus_box.stl", "open_bowl.ply")
PROGRAMS = pathlib.Path()  # set by main
SECONDS = 300  # for what takes one on an idle machine
COPY = """copy=sh -c 'echo "$0" >> "$LOG"; cp "$0" "$1"' {in.stl} {out.stl}"""


class RepairTable(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="repair_table_test_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.temporary, self.log, self.out = (self.folder / name for name in ("temporary", "log", "out"))
        self.temporary.mkdir()
        self.meshes = self.folder / "meshes"
        self.meshes.mkdir()
        for name in MESHES:
            (self.meshes / name).symlink_to(ROOT / "samples" / "meshes" / name)

    def run_script(self, *arguments, code=0, meshes=None):
        """Standard error; nothing temporary is left."""
        command = [sys.executable, SCRIPT, meshes or self.meshes, self.out, "--programs", PROGRAMS, *arguments]
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=SECONDS, check=False,
                              env={**os.environ, "LOG": str(self.log), "TMPDIR": str(self.temporary)})
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertNotIn("Traceback", done.stderr)
        self.assertEqual(os.listdir(self.temporary), [])
        return done.stderr

    def keep_only(self, model):
        for name in set(MESHES) - {model}:
            (self.meshes / name).unlink()

    def rows(self, name="table.csv"):
        with open(self.out / name, encoding="utf-8", newline="") as file:
            return {(row["model"], row["tool"]): row for row in csv.DictReader(file)}

    def copies(self):
        return len(self.log.read_text().splitlines())

    def test_each_model_has_a_row_of_each_tool(self):
        self.run_script("--tool", COPY)
        rows = self.rows()
        self.assertEqual(set(rows), {(model, tool) for model in MESHES for tool in ("input", "meshrepair", "copy")})
        for model in MESHES:
            row = rows[model, "meshrepair"]
            self.assertEqual([row[key] for key in ("status", "exit_code", "closed", "nonmanifold_edges", "solid", "self_intersections")],
                             ["result", "0", "yes", "0", "yes", "0"])
            self.assertLess(float(rows[model, "copy"]["hausdorff"]), 1e-6)
            self.assertEqual(rows[model, "copy"]["triangle_ratio"], "1.0")
        self.assertEqual(rows["broken_torus_box.stl", "copy"]["open_edges"], "23")
        self.assertEqual(rows["broken_torus_box.stl", "copy"]["solid"], "no")

    def test_what_has_no_result_has_a_row_that_says_why(self):
        self.keep_only("cube.stl")
        hog = f"hog={sys.executable} -c 'bytearray(1 << 30)' {{in}} {{out}}"
        tools = {"crash": "sh -c 'kill -SEGV $$' {in} {out}", "crash below": "sh -c 'exit 134' {in} {out}",
                 "nothing": "sh -c 'echo so be it >&2; exit 3' {in} {out}", "garbage": "sh -c 'echo garbage > \"$1\"' {in} {out}"}
        self.run_script("--max-memory", "500M", "--tool", hog, *(f"--tool={name}={line}" for name, line in tools.items()))
        found = {tool: (row["status"], row["exit_code"]) for (model, tool), row in self.rows().items() if model == "cube.stl"}
        self.assertEqual(found, {"input": ("result", ""), "meshrepair": ("result", "0"), "hog": ("out of memory", "1"),
                                 "crash": ("crashed: SIGSEGV", "-11"), "crash below": ("crashed: SIGABRT", "134"),
                                 "nothing": ("no result", "3"), "garbage": ("no result: unreadable", "0")})
        self.assertEqual(self.rows()["cube.stl", "nothing"]["error"], "so be it")
        self.assertIn("| crash | 1 | 0 (0.0 %) |", (self.out / "table.md").read_text())

    def test_what_hangs_is_out_of_time(self):
        self.keep_only("cube.stl")
        self.run_script("--timeout", "0.5", "--tool", "hang=sh -c 'sleep 3600; true' {in} {out}")
        row = self.rows()["cube.stl", "hang"]
        self.assertEqual((row["status"], row["exit_code"], row["solid"]), ("out of time", "", ""))

    def test_a_second_call_does_what_is_left(self):
        self.run_script("--tool", COPY)
        lines = (self.out / "table.csv").read_bytes().splitlines(keepends=True)
        (self.out / "table.csv").write_bytes(b"".join(lines[:-1]) + lines[-1][:20])
        self.assertEqual(self.copies(), 3)
        self.run_script("--tool", COPY)
        self.assertEqual(self.copies(), 4)
        self.assertEqual(len(self.rows()), 9)
        self.run_script("--tool", COPY)
        self.assertEqual(self.copies(), 4)

    def test_shards_together_are_the_whole(self):
        for share in ("1/2", "2/2"):
            self.run_script("--shard", share)
        parts = [self.rows(f"table.{number}-of-2.csv") for number in (1, 2)]
        self.assertEqual(sorted([*parts[0], *parts[1]]), sorted((model, tool) for model in MESHES for tool in ("input", "meshrepair")))
        self.assertIn("| meshrepair | 3 | 3 (100.0 %) |", (self.out / "table.md").read_text())

    def test_an_archive_is_as_its_folder(self):
        archive = self.folder / "meshes.zip"
        with zipfile.ZipFile(archive, "w") as file:
            for name in MESHES:
                file.write(self.meshes / name, f"sub/{name}")
        self.run_script(meshes=archive)
        self.assertEqual({row["triangles_out"] for row in self.rows().values() if row["model"] == "sub/cube.stl"}, {"12"})
        self.assertEqual(len(self.rows()), 6)

    def test_a_judge_is_believed_and_named(self):
        self.keep_only("cube.stl")
        judge = self.folder / "referee"
        judge.write_text("""#!/bin/sh
echo '{"is_clean": true, "outward_oriented": true, "n_triangles": 6, "n_boundary_edges": 0, "n_nonmanifold_edges": 7,
  "n_self_intersecting_pairs": 0, "n_degenerate_faces": 1, "n_repeated_vertex_faces": 2, "n_components": 4}'
""")
        judge.chmod(0o755)
        self.run_script("--judge", judge)
        row = self.rows()["cube.stl", "meshrepair"]
        self.assertEqual([row[key] for key in ("judge", "solid", "closed", "nonmanifold_edges", "degenerate_triangles", "parts",
                                               "triangle_ratio")], ["referee", "yes", "yes", "7", "3", "4", "0.5"])
        self.assertEqual(self.rows()["cube.stl", "input"]["judge"], "meshcheck")

    def test_a_judge_that_says_nothing_is_no_verdict(self):
        self.keep_only("cube.stl")
        self.run_script("--judge", "/bin/false")
        row = self.rows()["cube.stl", "meshrepair"]
        self.assertEqual([row[key] for key in ("status", "judge", "solid", "hausdorff")], ["result", "?", "", "0.0"])

    def test_the_page_needs_nothing_else(self):
        self.keep_only("cube.stl")
        self.run_script("-q")
        page = (self.out / "table.html").read_text()
        found = []
        parser = html.parser.HTMLParser()
        parser.handle_starttag = lambda tag, attributes: found.append((tag, dict(attributes)))
        parser.feed(page)
        self.assertIn("svg", dict(found))
        self.assertFalse([tag for tag, names in found if {"src", "href"} & set(names)])
        self.assertIn((self.out / "table.svg").read_text().strip(), page)

    def test_wrong_usage_is_refused(self):
        for tool in ("no_equals", "a=", "a=true {in}", "a=true {out}", "a=true {in} {out.stl} {out}", "a=no_such_program {in} {out}",
                     "a=true '{in} {out}"):
            with self.assertRaises(Stop):
                Tool(tool)
        self.assertRegex(self.run_script("--tool", "input=true {in} {out}", code=2), "^repair_table.py: [^\n]*\n$")
        self.assertIn("is not there", self.run_script(meshes=self.folder / "none", code=2))


def main():
    global PROGRAMS
    if len(sys.argv) < 2 or sys.argv[1] in ("-h", "--help"):
        print(__doc__.strip())
        sys.exit(0 if len(sys.argv) == 2 else 2)
    PROGRAMS = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main(verbosity=2)


if __name__ == "__main__":
    main()
