#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Interrupts runs of meshrepair --resume, and lets others go on from what they left.

Usage: resume_test.py PROGRAMS
"""

import json
import pathlib
import resource
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

from spilling_test import write_torus

PROGRAMS = pathlib.Path()
NOT_WRITTEN = 6
STL_HEADER = 84  # bytes; the count of triangles is the last four
STATES = ("prepared", "chambers", "repaired")  # in the order in which a run keeps them
TRIES = 50  # a busy machine lets a run go past a state before it is killed


def write_crossing_tori(path, turns, rings):
    bodies = []
    for shift in (0, 0.3):
        write_torus(path, turns, rings, shift)
        bodies.append(path.read_bytes()[STL_HEADER:])
    count = sum(map(len, bodies)) // 50
    path.write_bytes(bytes(80) + struct.pack("<I", count) + b"".join(bodies))


class Resume(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="resume_")
        cls.folder = pathlib.Path(cls.temporary.name)
        write_crossing_tori(cls.folder / "a.stl", 250, 150)
        subprocess.run(cls.command("a.stl", "whole.ply", "-q", resume=None), cwd=cls.folder, check=True)
        cls.whole = (cls.folder / "whole.ply").read_bytes()

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def setUp(self):
        self.states = self.folder / "states"
        (self.folder / "out.ply").unlink(missing_ok=True)

    def tearDown(self):
        self.drop_states()

    @staticmethod
    def command(mesh="a.stl", out="out.ply", *more, resume="states"):
        return [PROGRAMS / "meshrepair", mesh, out, *(["--resume", resume] if resume else []), *more]

    def state(self, name):
        return next(iter(self.states.glob(f"meshrepair-{name}-*.state")), None)

    def drop_states(self):
        if self.states.exists():
            for file in self.states.iterdir():
                file.unlink()
            self.states.rmdir()

    def wait_for(self, name, run):
        while run.poll() is None and not self.state(name):
            time.sleep(0.002)

    def interrupt_at(self, name, *more):
        """Leaves the states of a run that was killed once this one was there, and no later one."""
        later = STATES[STATES.index(name) + 1:]
        for _ in range(TRIES):
            self.drop_states()
            (self.folder / "out.ply").unlink(missing_ok=True)
            command = self.command("a.stl", "out.ply", "-q", "--report", "report.json", *more)
            run = subprocess.Popen(command, cwd=self.folder)
            self.wait_for(name, run)
            run.send_signal(signal.SIGKILL)
            if run.wait() == 0:
                continue
            self.assertEqual(run.returncode, -signal.SIGKILL)
            if (self.folder / "out.ply").exists():
                self.assertTrue(self.same_bytes())
            elif self.state(name) and not any(map(self.state, later)):
                return self.state(name)
        return self.fail(f"no run was killed at {name}")

    def finish(self, *more):
        """Of a run that ends by itself: what it went on from, what it says, its report."""
        done = subprocess.run(self.command("a.stl", "out.ply", "--report", "report.json", *more), cwd=self.folder,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        report = json.loads((self.folder / "report.json").read_text())
        names = [name.partition("-")[0] for name in report.get("resumed", {"from": []})["from"]]
        self.assertFalse(self.states.exists())
        return names, done.stderr, report

    def same_bytes(self):
        return (self.folder / "out.ply").read_bytes() == self.whole

    def test_nothing_is_left_without_an_interruption(self):
        names, _, report = self.finish()
        self.assertEqual(names, [])
        self.assertNotIn("resumed", report)
        self.assertTrue(self.same_bytes())

    def test_from_each_state(self):
        for name, went_on_from in (("prepared", ["prepared"]), ("chambers", ["prepared", "chambers"]),
                                   ("repaired", ["repaired"])):
            self.interrupt_at(name)
            names, _, report = self.finish()
            self.assertEqual(names, went_on_from)
            self.assertTrue(self.same_bytes(), name)
            stages = [stage["name"] for stage in report["stages"]]
            self.assertIn("resume", stages)
            for stage in ("clean", "arrange", "certify"):
                self.assertEqual(stages.count(stage), 1, name)

    def test_the_report_is_that_of_a_whole_run(self):
        _, _, whole = self.finish()
        self.interrupt_at("repaired")
        names, _, resumed = self.finish()
        self.assertEqual(names, ["repaired"])
        for report in (whole, resumed):
            for key in ("stages", "resumed", "seconds", "cpu_seconds", "peak_memory_bytes", "temp_file"):
                report.pop(key, None)
        self.assertEqual(whole, resumed)

    def test_after_a_damage_it_begins_anew(self):
        for at in (3, 20, -3):
            file = self.interrupt_at("repaired")
            data = bytearray(file.read_bytes())
            data[at] ^= 64
            file.write_bytes(data)
            names, said, _ = self.finish()
            self.assertNotIn("repaired", names)
            is_ours = at < 0  # in the header it is a state of some other program
            self.assertEqual("is damaged and ignored" in said, is_ours)
            self.assertTrue(self.same_bytes(), at)

    def test_a_state_that_is_cut_off(self):
        file = self.interrupt_at("repaired")
        data = file.read_bytes()
        for size in (0, 10, 30, len(data) // 2, len(data) - 1):
            self.states.mkdir(exist_ok=True)
            file.write_bytes(data[:size])
            self.assertNotIn("repaired", self.finish()[0])
            self.assertTrue(self.same_bytes(), size)

    def test_other_options_begin_anew(self):
        self.interrupt_at("prepared")
        self.assertEqual(self.finish("--inside", "winding")[0], [])

    def test_how_it_runs_makes_no_difference(self):
        self.interrupt_at("prepared", "--threads", "1")
        names, _, _ = self.finish("--threads", "2", "--max-memory", "2G", "--time-limit", "900")
        self.assertEqual(names, ["prepared"])
        self.assertTrue(self.same_bytes())

    def test_another_mesh_has_states_of_its_own(self):
        self.interrupt_at("prepared")
        write_crossing_tori(self.folder / "b.stl", 100, 60)
        done = subprocess.run(self.command("b.stl", "out.ply", "-q", "--report", "report.json"), cwd=self.folder)
        self.assertEqual(done.returncode, 0)
        self.assertNotIn("resumed", json.loads((self.folder / "report.json").read_text()))

    def test_one_run_at_a_time(self):
        first = subprocess.Popen(self.command("a.stl", "out.ply", "-q"), cwd=self.folder)
        self.wait_for("prepared", first)
        first.send_signal(signal.SIGSTOP)
        second = subprocess.run(self.command(), cwd=self.folder, capture_output=True, text=True)
        first.send_signal(signal.SIGCONT)
        self.assertEqual(second.returncode, NOT_WRITTEN)
        self.assertIn("--resume: another run is at work with states", second.stderr)
        self.assertEqual(first.wait(), 0)

    def test_no_folder_can_be_made(self):
        (self.folder / "file").write_text("")
        for name in ("file", "gone/states"):
            done = subprocess.run(self.command(resume=name), cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, NOT_WRITTEN)
            self.assertIn(f"--resume: {name} is no folder", done.stderr)

    def test_a_time_limit_keeps_what_is_done(self):
        self.interrupt_at("prepared")
        done = subprocess.run(self.command("a.stl", "out.ply", "--time-limit", "0.01"), cwd=self.folder)
        self.assertEqual(done.returncode, 4)
        self.assertTrue(self.state("prepared"))

    def test_a_mistake_leaves_what_is_kept(self):
        self.interrupt_at("chambers")
        for code, mesh, *more in ((3, "gone.stl"), (4, "a.stl", "--inside", "parity", "--time-limit", "0.01"), (2, "a.stl", "--sew", "x")):
            done = subprocess.run(self.command(mesh, "out.ply", *more), cwd=self.folder, capture_output=True)
            self.assertEqual(done.returncode, code)
            self.assertTrue(self.state("chambers"))
        self.assertEqual(self.finish()[0], ["prepared", "chambers"])

    def test_where_the_output_goes_makes_no_difference(self):
        self.interrupt_at("chambers")
        done = subprocess.run(self.command("a.stl", "./other.ply", "-q", "--report", "report.json"), cwd=self.folder)
        self.assertEqual(done.returncode, 0)
        self.assertEqual(len(json.loads((self.folder / "report.json").read_text())["resumed"]["from"]), 2)
        self.assertEqual((self.folder / "other.ply").read_bytes(), self.whole)

    def test_what_other_files_are_there_stays(self):
        self.states.mkdir()
        mine = ["game.state", "meshrepair-notes.state", "meshrepair-notes.txt", "meshrepair-prepared-1.state",
                "meshrepair-the-end.part", "movie.part", "notes.txt"]
        for name in mine:
            (self.states / name).write_text("mine")
        (self.states / "meshrepair-folder.state").mkdir()
        subprocess.run(self.command("a.stl", "out.ply", "-q"), cwd=self.folder, check=True)
        (self.states / "meshrepair-folder.state").rmdir()
        self.assertEqual(sorted(file.name for file in self.states.iterdir()), mine)

    def test_an_error_leaves_no_empty_folder(self):
        done = subprocess.run(self.command("gone.stl", "out.ply"), cwd=self.folder, capture_output=True)
        self.assertEqual(done.returncode, 3)
        self.assertFalse(self.states.exists())

    def test_where_states_do_not_fit_the_run_goes_on(self):
        def small_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            most = len(self.whole) + 1000
            resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))

        done = subprocess.run(self.command("a.stl", "out.ply", "--temp", "none"), cwd=self.folder, capture_output=True,
                              text=True, preexec_fn=small_files)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("cannot be written; later progress is not saved", done.stderr)
        self.assertTrue(self.same_bytes())
        self.assertFalse(self.states.exists())


if __name__ == "__main__":
    PROGRAMS = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
