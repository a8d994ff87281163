#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of scripts/repair_folder.py: lists of files, and shards that work on one folder at the same time.

Usage: repair_folder_shards_test.py MESHREPAIR [OPTIONS OF UNITTEST]
"""

import json
import os
import random
import subprocess
import sys

sys.dont_write_bytecode = True
sys.pycache_prefix = os.devnull

import kill_folder
from repair_folder_case import CUBE, FLAT, SECONDS, TETRAHEDRON, FolderTest, main, names_in, write_files

COUNT = 4
FILES = {**{f"sub{i % 3}/mesh{i}.stl": CUBE for i in range(20)}, **{f"tetra{i}.obj": TETRAHEDRON for i in range(10)},
         "flat.obj": FLAT, "bad.stl": b"solid nothing\n", os.fsdecode(b"\xff.stl"): CUBE}


class Shards(FolderTest):
    def setUp(self):
        super().setUp()
        write_files(self.source, FILES)

    def codes_of(self, commands):
        processes = [subprocess.Popen(command, env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                     for command in commands]
        return [process.wait(SECONDS) for process in processes]

    def run_shards(self, count=COUNT, numbers=None, *options):
        numbers = range(1, count + 1) if numbers is None else numbers
        return self.codes_of([self.command("--jobs", "1", "--shard", f"{i}/{count}", *options, program=self.meshrepair) for i in numbers])

    def merge(self, *options, code=1):
        return self.run_script("--merge", *options, program=self.meshrepair, code=code)

    def undisturbed(self, *options):
        """Its summary and its files."""
        out = self.folder / "undisturbed"
        self.run_script(*options, program=self.meshrepair, out=out, code=1)
        return kill_folder.comparable_summary(out), kill_folder.outputs_in(out)

    def test_the_same_as_one_run(self):
        summary, files = self.undisturbed()
        self.assertLessEqual(set(self.run_shards()), {0, 1})
        self.assertFalse((self.out / "summary.json").exists())
        self.merge()
        self.assertEqual(kill_folder.comparable_summary(self.out), summary)
        self.assertEqual(kill_folder.outputs_in(self.out), files)

    def test_each_file_is_in_one_shard(self):
        self.run_shards()
        done = [json.loads(line)["path"] for journal in self.out.glob(".repair_folder/shards/*/journal.jsonl")
                for line in journal.read_text().splitlines()]
        self.assertEqual(sorted(done), sorted(FILES))

    def test_added_files_move_no_others(self):
        self.run_shards()
        write_files(self.source, {"new.stl": CUBE, "sub0/new.obj": TETRAHEDRON})
        self.environment["FAKE_LOG"] = str(self.log)
        for i in range(1, COUNT + 1):
            said = self.run_script("--shard", f"{i}/{COUNT}", program=self.meshrepair, code=None).stderr
            self.assertRegex(said, "of [0-9]+ files were finished before")
        self.merge()
        self.assertEqual(len(self.rows()), len(FILES) + 2)

    def run_script(self, *options, code=0, **others):
        if code is not None:
            return super().run_script(*options, code=code, **others)
        return subprocess.run(self.command(*options, **others), env=self.environment, text=True, check=False, capture_output=True,
                              timeout=SECONDS)

    def test_what_is_missing_is_said(self):
        self.run_shards(numbers=[1, 3])
        said = self.merge(code=1)
        totals = json.loads((self.out / "summary.json").read_text())["totals"]
        self.assertGreater(totals["not_done"], 0)
        self.assertIn("not done", said.stdout)
        self.run_shards(numbers=[2, 4])
        self.merge()
        self.assertEqual(json.loads((self.out / "summary.json").read_text())["totals"]["not_done"], 0)

    def test_one_run_goes_on_where_shards_stopped(self):
        summary, files = self.undisturbed()
        self.run_shards(numbers=[1, 2])
        said = self.run_script(program=self.meshrepair, code=1).stderr
        self.assertRegex(said, "[1-9][0-9]* of 33 files were finished before")
        self.assertEqual(kill_folder.comparable_summary(self.out), summary)
        self.assertEqual(kill_folder.outputs_in(self.out), files)
        # And shards where one run stopped.
        said = self.run_script("--shard", "2/3", program=self.meshrepair, code=None).stderr
        done, all_of_them = said.split(" files were finished")[0].split()[-3::2]
        self.assertEqual(done, all_of_them)

    def test_other_shares_later(self):
        summary, files = self.undisturbed()
        self.run_shards(2, [1])
        self.run_shards(5)
        self.merge()
        self.assertEqual(kill_folder.comparable_summary(self.out), summary)
        self.assertEqual(kill_folder.outputs_in(self.out), files)

    def test_killed_shards(self):
        summary, files = self.undisturbed()
        seeds = random.Random(5)
        for _ in range(6):
            processes = [self.start("--jobs", "1", "--shard", f"{i}/{COUNT}", program=self.meshrepair) for i in range(1, COUNT + 1)]
            for process in processes:
                try:
                    process.communicate(timeout=seeds.uniform(0.05, 0.4))
                except subprocess.TimeoutExpired:
                    process.kill()
                    process.communicate()
            for name, data in kill_folder.outputs_in(self.out).items():
                self.assertEqual(files[name], data, name)
        self.assertLessEqual(set(self.run_shards()), {0, 1})
        self.merge()
        self.assertEqual(kill_folder.comparable_summary(self.out), summary)
        self.assertEqual(kill_folder.outputs_in(self.out), files)

    def test_locks(self):
        write_files(self.source, {"slow.stl": b""})
        for name in FILES:
            os.unlink(self.source / name)
        number = next(i for i in range(1, COUNT + 1)
                      if self.run_script("--shard", f"{i}/{COUNT}", "--merge", code=2) and self.is_in(b"slow.stl", i))
        process = self.start("--shard", f"{number}/{COUNT}")
        self.wait_for_calls(1, process)
        self.assertIn("another run is at work", self.run_script("--shard", f"{number}/{COUNT}", code=6).stderr)
        self.assertIn("another run is at work", self.run_script(code=6).stderr)
        self.assertIn("another run is at work", self.run_script("--merge", code=6).stderr)
        self.run_script("--shard", f"{number % COUNT + 1}/{COUNT}")
        self.let_slow_ones_end()
        process.communicate(timeout=SECONDS)
        self.assertEqual(process.returncode, 0)
        self.run_script("--merge")

    @staticmethod
    def is_in(name, number):
        sys.path.insert(0, str(kill_folder.SCRIPT.parent))
        from folder_repair.shards import Shard
        return Shard(number, COUNT).holds(name)

    def test_the_gallery_comes_with_the_merge(self):
        self.run_shards(2, None, "--html")
        self.assertFalse((self.out / "index.html").exists())
        self.merge("--html")
        self.assertIn(b"mesh19.stl", (self.out / "index.html").read_bytes())
        self.assertTrue((self.out / "index.files/sub0/mesh0.stl.html").exists())

    def test_what_hit_a_limit_is_in_the_merge(self):
        for name in FILES:
            os.unlink(self.source / name)
        write_files(self.source, {"code4.stl": b"4", "good.stl": b""})
        for i in (1, 2):
            self.run_script("--shard", f"{i}/2", code=None)
        self.calls()
        self.run_script("--merge", code=1)
        self.assertEqual(self.codes(), {"code4.stl": 4, "good.stl": 0})
        self.assertEqual(self.calls(), [])
        for i in (1, 2):
            self.run_script("--shard", f"{i}/2", code=None)
        self.assertEqual(self.calls(), ["code4.stl"])

    def test_wrong_shards(self):
        for word in ("0/3", "4/3", "1", "1/0", "a/b", "-1/3", "1/3/3", ""):
            self.assertIn("--shard", self.run_script("--shard", word, code=2).stderr)
        for option in ("--shard=1/2", "--restart"):
            self.assertIn("--merge goes with neither", self.run_script("--merge", option, code=2).stderr)


class Lists(FolderTest):
    def setUp(self):
        super().setUp()
        write_files(self.source, FILES)
        self.list = self.folder / "list"

    def run_list(self, data, code=0, *options):
        self.list.write_bytes(data)
        return self.run_script("--list", self.list, *options, program=self.meshrepair, code=code)

    def test_only_what_it_names(self):
        self.run_list(b"tetra1.obj\nsub0/mesh0.stl\n./tetra1.obj\n\nsub1/../tetra2.obj\n" + os.fsencode(self.source) + b"/tetra3.obj\n")
        self.assertEqual(set(self.rows()), {"tetra1.obj", "tetra2.obj", "tetra3.obj", "sub0/mesh0.stl"})
        self.assertEqual(names_in(self.out), {"tetra1.obj", "tetra2.obj", "tetra3.obj", "sub0/mesh0.stl"})
        said = self.run_list(b"tetra4.obj").stderr
        self.assertNotIn("earlier run", said)
        self.assertEqual(len(names_in(self.out)), 5)

    def test_any_name(self):
        write_files(self.source, {"a\nb.stl": CUBE})
        self.run_list(b"a\nb.stl\0\xff.stl\0")
        self.assertEqual(names_in(self.out), {"a\nb.stl", os.fsdecode(b"\xff.stl")})

    def test_standard_input(self):
        command = self.command("--list", "-", program=self.meshrepair)
        subprocess.run(command, input=b"tetra1.obj\n", check=True, capture_output=True, timeout=SECONDS)
        self.assertEqual(names_in(self.out), {"tetra1.obj"})

    def test_what_is_not_there(self):
        self.run_list(b"tetra1.obj\nmissing.stl\nnotes.txt\nsub0\n", 1)
        self.assertEqual({path: int(row["exit_code"]) for path, row in self.rows().items()}, {"tetra1.obj": 0, "missing.stl": 3})
        left_out = json.loads((self.out / "summary.json").read_text())["left_out"]
        self.assertEqual([one["path"] for one in left_out], ["notes.txt", "sub0"])

    def test_names_outside(self):
        for name in (b"../x.stl", b"/etc/x.stl", b"sub0/../../x.stl"):
            self.assertIn("is not in", self.run_list(name, 2).stderr)
        self.assertIn("--list", self.run_script("--list", self.folder / "none", code=2).stderr)

    def test_shards_of_a_list(self):
        names = [name for name in sorted(FILES) if name.startswith("tetra")]
        data = "\n".join(names).encode()
        for i in (1, 2, 3):
            self.run_list(data, 0, "--shard", f"{i}/3")
        self.run_list(data, 0, "--merge")
        self.assertEqual(sorted(self.rows()), names)


if __name__ == "__main__":
    main(__doc__)
