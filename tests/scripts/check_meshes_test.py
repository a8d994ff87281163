#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of integrations/action: a repository with sound and broken meshes, as the action and pre-commit check it.

Usage: check_meshes_test.py PROGRAMS

PROGRAMS is the folder of the built programs.

Example: tests/scripts/check_meshes_test.py build/release/bin
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
ACTION = ROOT / "integrations" / "action"
MESHES = ROOT / "samples" / "meshes"
PROGRAMS = pathlib.Path()  # set by main()
SOUND = {"a b/cube.stl": "cube.stl", "deep/er/ball.obj": "hollow_sphere.obj", "CUBE.STL": "cube.stl", "1.stl": "cube.stl", "2.stl": "cube.stl",
         "3.stl": "cube.stl", "-4.stl": "cube.stl"}
BROKEN = {"a b/br,ok:en%|.stl": "broken_torus_box.stl", "bowl.ply": "open_bowl.ply"}


class Action(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="action_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name, mesh in {**SOUND, **BROKEN}.items():
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(MESHES / mesh, self.folder / name)
        (self.folder / "none.stl").write_text("version https://git-lfs.github.com/spec/v1\n")
        subprocess.run(["git", "init", "--quiet"], cwd=self.folder, check=True)
        subprocess.run(["git", "add", "--all"], cwd=self.folder, check=True)
        shutil.copy(MESHES / "open_bowl.ply", self.folder / "untracked.ply")

    def run_command(self, command: list, **more: str) -> subprocess.CompletedProcess:
        environment = {key: value for key, value in os.environ.items() if not key.startswith("GITHUB_")}
        environment |= {"PATH": f"{PROGRAMS}{os.pathsep}{os.environ['PATH']}", **more}
        return subprocess.run(command, cwd=self.folder, env=environment, capture_output=True, check=False, text=True)

    def test_a_line_for_each_broken_mesh(self):
        done = self.run_command([ACTION / "check_meshes.py"])
        self.assertEqual((done.returncode, done.stderr), (1, ""))
        *lines, last = done.stdout.splitlines()
        self.assertEqual(last, "7 of 10 meshes bound solids")
        self.assertEqual([line.split(": ")[0] for line in lines], ["a b/br,ok:en%|.stl", "bowl.ply", "none.stl"])
        self.assertEqual(lines[1], "bowl.ply: open edges: 64, first at (0.990393, 0.097545, 0)")
        self.assertIn("pointer of Git LFS", lines[2])

    def test_no_mesh_is_overwritten_and_folders_are_made_first(self):
        before = (self.folder / "bowl.ply").read_bytes()
        done = self.run_command([ACTION / "check_meshes.py", "--repair", ".", "./bowl.ply"])
        self.assertEqual((done.returncode, (self.folder / "bowl.ply").read_bytes()), (1, before))
        self.assertIn("is a mesh to check, and is not overwritten", done.stdout)
        done = self.run_command([ACTION / "check_meshes.py", "--pages", "bowl.ply"])
        self.assertEqual((done.returncode, done.stderr), (2, "check_meshes.py: bowl.ply: File exists\n"))

    def test_on_github_files_are_annotated_and_the_summary_has_a_table(self):
        summary = self.folder / "summary.md"
        done = self.run_command([ACTION / "check_meshes.py", "--pages", "pages", "--repair", "fixed"], GITHUB_ACTIONS="true",
                                GITHUB_STEP_SUMMARY=str(summary))
        self.assertEqual(done.returncode, 1)
        told = re.findall(r"^::error file=(\S.*),title=Not a valid solid::(\S.*)$", done.stdout, re.MULTILINE)
        self.assertEqual([name for name, _ in told], ["a b/br%2Cok%3Aen%25|.stl", "bowl.ply", "none.stl"])
        table = summary.read_text(encoding="utf-8")
        self.assertTrue(table.startswith("### 7 of 10 meshes bound solids\n"))
        self.assertIn(r"| a b/br,ok:en%\|.stl | 2,325 | open edges: 23, first at", table)
        self.assertEqual(len(list((self.folder / "pages").iterdir())), 2)
        for fixed in (self.folder / "fixed").iterdir():
            self.assertEqual(self.run_command(["meshcheck", "--quiet", fixed]).returncode, 0)
        self.assertEqual(sorted(path.name for path in (self.folder / "fixed").iterdir()), ["a b%2Fbr,ok%3Aen%25%7C.stl", "bowl.ply"])

    def test_sound_meshes_end_with_0(self):
        done = self.run_command([ACTION / "check_meshes.py", "--", *SOUND])
        self.assertEqual((done.returncode, done.stdout), (0, "7 of 7 meshes bound solids\n"))

    def test_without_programs_or_a_repository_it_says_so(self):
        done = self.run_command([sys.executable, ACTION / "check_meshes.py", "1.stl"], PATH="/nowhere")
        self.assertIn("meshcheck is not in PATH", done.stderr)
        self.assertEqual(done.returncode, 2)
        with tempfile.TemporaryDirectory() as name:
            done = self.run_command([ACTION / "check_meshes.py"], GIT_DIR=name)
        self.assertIn("not in a repository", done.stderr)

    def test_the_steps_of_the_action_check_the_meshes_of_its_inputs(self):
        action = yaml.safe_load((ACTION / "action.yml").read_text(encoding="utf-8"))
        step = action["runs"]["steps"][-1]
        self.assertEqual(set(step["env"].values()), {"${{ inputs.%s }}" % name for name in ("meshes", "pages", "repair")})
        inputs = {"MESHES": "*.stl bowl.ply", "PAGES": "my pages", "REPAIR": "", "GITHUB_ACTION_PATH": str(ACTION)}
        done = self.run_command(["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", step["run"]], **inputs)
        self.assertEqual((done.returncode, done.stdout.splitlines()[-1]), (1, "4 of 6 meshes bound solids"), done.stdout + done.stderr)
        self.assertEqual([path.name for path in (self.folder / "my pages").iterdir()], ["bowl.ply.html"])

    def test_the_hook_of_pre_commit_is_there_and_takes_meshes(self):
        hook, = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
        self.assertTrue(os.access(ROOT / hook["entry"].split()[0], os.X_OK))
        self.assertTrue(all(re.search(hook["files"], name) for name in (*SOUND, *BROKEN)))
        self.assertFalse(re.search(hook["files"], "notes.txt"))


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__.strip())
    PROGRAMS = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
