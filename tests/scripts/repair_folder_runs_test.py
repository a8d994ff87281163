#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of scripts/repair_folder.py: programs that fail, runs that end early, and what is done again.

Most of them use a false program, which does what the name of its input says.

Usage: repair_folder_runs_test.py MESHREPAIR [OPTIONS OF UNITTEST]
"""

import fcntl
import json
import os
import pathlib
import py_compile
import resource
import shutil
import signal
import subprocess
import sys
import time

sys.dont_write_bytecode = True  # a copy that is cut on a full disk would end all later tests
sys.pycache_prefix = os.devnull

import kill_folder
from repair_folder_case import SCRIPT, SECONDS, FolderTest, main, names_in, write_files

TAG = sys.implementation.cache_tag


class FailingPrograms(FolderTest):
    def test_no_manner_of_failing_stops_the_others_or_leaves_a_file(self):
        actions = ("crash", "garbage", "good", "half", "noisy", "once", "orphan", "silent", "unproven")
        write_files(self.source, {f"{action}.stl": b"x" for action in actions})
        self.run_script("--jobs", "6", code=1)
        self.assertEqual(self.codes(), {
            "crash.stl": 139, "garbage.stl": 70, "good.stl": 0, "half.stl": 137, "noisy.stl": 70,
            "once.stl": 0, "orphan.stl": 0, "silent.stl": 70, "unproven.stl": 70})
        rows = self.rows()
        self.assertEqual(rows["half.stl"]["error"], "killed by signal 9")
        self.assertEqual(rows["noisy.stl"]["error"], "enough")
        self.assertEqual(names_in(self.out), {"good.stl", "once.stl", "orphan.stl"})
        self.assertEqual(self.calls().count("half.stl"), 2)
        self.assertEqual(os.listdir(self.out / ".repair_folder" / "work"), [])

    def test_what_does_not_end_is_killed_at_its_limit_and_the_next_is_begun(self):
        # Only what would take an hour: on a busy machine everything else could reach the limit, too.
        write_files(self.source, {"deaf.stl": b"x", "hang.stl": b"x"})
        self.run_script("--jobs", "1", "--timeout", "2", "--grace", "0.3", code=1)
        self.assertEqual(self.codes(), {"deaf.stl": 4, "hang.stl": 4})
        for row in self.rows().values():
            self.assertEqual(row["error"], "does not end at the time limit of 2 s: killed")
        self.assertEqual(names_in(self.out), set())
        self.assertEqual(os.listdir(self.out / ".repair_folder" / "work"), [])

    def test_all_workers_are_killed(self):
        write_files(self.source, {"hang.stl": b"x", "slow.stl": b"x", "then/good.stl": b"x"})
        process = self.start("--jobs", "2", "--quiet", "--timeout", "1", "--grace", "0.5")
        self.wait_for_calls(2, process)
        self.kill_server(process)
        self.let_slow_ones_end()
        process.communicate(timeout=SECONDS)
        self.assertEqual(process.returncode, 1)
        self.assertEqual(self.codes(), {"hang.stl": 4, "slow.stl": 0, "then/good.stl": 0})

    def test_a_program_that_is_gone_fails_each_file(self):
        write_files(self.source, {"slow.stl": b"x", "then/good.stl": b"x"})
        process = self.start("--jobs", "1", "--quiet")
        self.wait_for_calls(1, process)
        self.false.write_text("#!/bin/sh\nexit 9\n")
        self.kill_server(process)
        self.let_slow_ones_end()
        process.communicate(timeout=SECONDS)
        self.assertEqual(process.returncode, 1)
        self.assertEqual(self.codes(), {"slow.stl": 70, "then/good.stl": 70})
        self.assertEqual(self.rows()["slow.stl"]["error"], "meshrepair --jobs-from ended with exit code 9")

    @staticmethod
    def kill_server(process):
        """Of the processes that the script has started, that which others belong to."""
        for entry in pathlib.Path("/proc").iterdir():
            try:
                if entry.name.isdigit() and (entry / "stat").read_text().rsplit(")", 1)[1].split()[1] == str(process.pid):
                    os.kill(int(entry.name), signal.SIGKILL)
            except OSError:
                pass

    def test_a_full_disk_is_one_line(self):
        write_files(self.source, {f"good{i}.stl": b"x" for i in range(30)})
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4000, 4000))
        self.environment["FAKE_LOG"] = os.devnull  # else it is full first
        result = self.run_script("--quiet", before=limit, code=6)
        self.assertRegex(result.stderr, r"^repair_folder.py: [^\n]*journal.jsonl: cannot be written: [^\n]*\n$")
        self.run_script()
        self.assertEqual(len(self.codes()), 30)


class Resuming(FolderTest):
    def test_final_ends_are_not_tried_again_and_others_are(self):
        files = {f"code{code}.stl": str(code).encode() for code in (1, 2, 3, 4, 5, 6, 70)}
        write_files(self.source, {**files, "good.stl": b"x", "crash.stl": b"x"})
        self.run_script(code=1)
        self.assertEqual(len(self.calls()), 9)
        before = kill_folder.comparable_summary(self.out)
        self.run_script(code=1)
        self.assertEqual(self.calls(), ["code2.stl", "code4.stl", "code6.stl", "code70.stl", "crash.stl"])
        self.assertEqual(kill_folder.comparable_summary(self.out), before)
        self.assertEqual(self.rows()["code3.stl"]["error"], "so it is")
        self.run_script("--restart", code=1)
        self.assertEqual(len(self.calls()), 9)

    def test_what_has_changed_is_done_again(self):
        write_files(self.source, {"good1.stl": b"x", "good2.stl": b"x", "good3.stl": b"x"})
        self.run_script()
        self.calls()
        os.utime(self.source / "good1.stl", (1, 1))
        (self.out / "good2.stl").write_bytes(b"cut")
        self.run_script()
        self.assertEqual(self.calls(), ["good1.stl", "good2.stl"])
        self.run_script("--", "--strict")
        self.assertEqual(len(self.calls()), 3)
        self.false.write_text(self.false.read_text() + "# another build\n")
        self.run_script("--", "--strict")
        self.assertEqual(len(self.calls()), 3)
        self.run_script("--jobs", "1", "--timeout", "9", "--max-memory", "1G", "--", "--strict")
        self.assertEqual(self.calls(), [])

    def test_a_journal_that_is_torn_or_damaged_costs_what_is_damaged(self):
        write_files(self.source, {f"good{i}.stl": b"x" for i in range(4)})
        self.run_script()
        self.calls()
        journal = self.out / ".repair_folder" / "journal.jsonl"
        lines = journal.read_bytes().splitlines(keepends=True)
        lost = [json.loads(line)["path"] for line in lines[2:]]
        damage = b'[1]\n{"row": 3}\n\0\0\0\n'
        journal.write_bytes(lines[0] + damage + lines[1] + lines[2][:99] + b"\n" + lines[3][:-9])
        self.run_script()
        self.assertEqual(self.calls(), sorted(lost))
        self.run_script()
        self.assertEqual(self.calls(), [])

    def test_the_old_output_of_an_input_that_now_fails_is_removed(self):
        write_files(self.source, {"code.stl": b"1", "good.stl": b"x"})
        self.run_script(code=1)
        self.assertEqual(names_in(self.out), {"code.stl", "good.stl"})
        write_files(self.source, {"code.stl": b"5 "})
        (self.source / "good.stl").unlink()
        result = self.run_script(code=1)
        self.assertEqual(names_in(self.out), {"good.stl"})
        self.assertIn("good.stl in OUT_DIR is of an earlier run", result.stderr)

    def test_what_a_killed_run_has_left_is_removed(self):
        write_files(self.source, {"good.stl": b"x"})
        write_files(self.out, {".repair_folder/work/7/.mesh.stl.0123456789abcdef.tmp": b"half"})
        self.run_script()
        self.assertEqual(os.listdir(self.out / ".repair_folder" / "work"), [])


class Signals(FolderTest):
    def interrupt(self, number, code):
        write_files(self.source, {"a/good.stl": b"x", "hang1.stl": b"x", "deaf.stl": b"x", "hang2.stl": b"x"})
        # None of these may be waited for: neither the limit of time, nor what is given beyond it.
        process = self.start("--jobs", "2", "--quiet", "--timeout", "3600", "--grace", "3600")
        self.wait_for_calls(3, process)
        process.send_signal(number)
        _, stderr = process.communicate(timeout=SECONDS)
        self.assertEqual(process.returncode, code)
        self.assertEqual(stderr.count("\n"), 1, stderr)
        self.assertEqual(self.codes(), {"a/good.stl": 0})
        self.assertEqual(names_in(self.out), {"a/good.stl"})
        self.assertEqual(json.loads((self.out / "summary.json").read_bytes())["totals"]["not_done"], 3)
        self.assertEqual(kill_folder.marked_processes(os.fsencode(self.log)), [])

    def test_interrupt(self):
        self.interrupt(signal.SIGINT, 130)

    def test_termination(self):
        self.interrupt(signal.SIGTERM, 143)

    def test_workers_die_with_the_script(self):
        write_files(self.source, {"hang.stl": b"x", "deaf.stl": b"x"})
        process = self.start("--jobs", "2")
        self.wait_for_calls(2, process)
        process.kill()
        process.communicate()
        deadline = time.monotonic() + SECONDS
        while kill_folder.marked_processes(os.fsencode(self.log)):
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)

    def test_a_second_run_refuses(self):
        write_files(self.source, {"good.stl": b"x"})
        self.run_script()
        with open(self.out / ".repair_folder" / "lock", "rb") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            result = self.run_script(code=6)
        self.assertIn("another run is at work here", result.stderr)
        self.run_script()


class Caches(FolderTest):
    """The compiled copies of its parts that Python keeps beside a script."""

    def setUp(self):
        super().setUp()
        self.scripts = self.folder / "scripts"
        shutil.copytree(SCRIPT.parent, self.scripts, ignore=shutil.ignore_patterns("__pycache__"))
        for name in ("PYTHONDONTWRITEBYTECODE", "PYTHONPYCACHEPREFIX"):
            self.environment.pop(name, None)

    def start_script(self, before=None):
        return subprocess.run([sys.executable, self.scripts / SCRIPT.name, "--help"], env=self.environment, text=True,
                              check=False, capture_output=True, timeout=SECONDS, preexec_fn=before)

    def test_a_first_start_on_a_full_disk_leaves_nothing(self):
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4000, 4000))
        self.assertEqual(self.start_script(before=limit).returncode, 0)
        self.assertEqual(list(self.scripts.rglob("*.pyc")), [])

    def test_cut_copies_of_an_earlier_version_do_no_harm(self):
        for part in (self.scripts / "folder_repair").glob("*.py"):
            copy = pathlib.Path(py_compile.compile(str(part), doraise=True,
                                                   cfile=f"{part.parent}/__pycache__/{part.stem}.{TAG}.pyc"))
            copy.write_bytes(copy.read_bytes()[:100])
        result = self.start_script()
        self.assertEqual((result.returncode, result.stderr), (0, ""))


if __name__ == "__main__":
    main(__doc__)
