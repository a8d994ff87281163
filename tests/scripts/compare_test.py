#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of bench/compare.py.

Usage: compare_test.py PROGRAMS [OPTIONS OF UNITTEST]

How it runs, judges, records and ends is tested with false programs, which are scripts of a few lines; class RealPrograms uses
those in the folder PROGRAMS, on tiny inputs.
"""

import contextlib
import csv
import dataclasses
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import types
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "bench" / "compare.py"
PROGRAMS = pathlib.Path()  # set by main
SECONDS = 300  # for what takes one on an idle machine; what hangs, hangs for longer

sys.dont_write_bytecode = True
sys.path.insert(0, str(SCRIPT.parent))

from comparison import growth, history, inputs, measure
from comparison.basics import Stop

TRIANGLES = "OFF\n3 {count} 0\n0 0 0\n1 0 0\n0 1 0\n"
FALSE_PROGRAMS = {
    # Tells the log that it ran, and copies its input.
    "meshrepair": 'echo "$(basename "$(dirname "$0")")" >> "$LOG"\ncp "$1" "$2"\n',
    "bspbool": 'test "$3 $4 $5" = "--op union -o" && cp "$1" "$6"\n',
    "make_models": """
kind=${2%%:*}; size=${2#*:}
write() { printf 'OFF\\n3 %s 0\\n0 0 0\\n1 0 0\\n0 1 0\\n' "$size" > "$1"; echo "$1"; }
case $kind in
  union) write "$1/union_a.off"; write "$1/union_b.off" ;;
  cloud) write "$1/cloud.xyz" ;;
  *) write "$1/$kind.off" ;;
esac
""",
    "meshcheck": """
if [ "$(head -n 1 "$1")" = OFF ]; then echo '{"check": {"valid_solid": true}}'; else echo '{"error": "no mesh"}'; exit 3; fi
""",
    "calibration": "exit 0\n",
}


def write_script(path, text):
    path.write_text("#!/bin/sh\n" + text)
    path.chmod(0o755)
    return path


class Table:
    """What was printed, as dictionaries: by heading of the table, its rows."""

    def __init__(self, text):
        self.rows = []
        head = None
        for line in text.splitlines():
            cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
            if not line.startswith("|"):
                head = None
            elif head is None:
                head = cells
            elif not set(line) <= set("|-"):
                self.rows.append(dict(zip(head, cells)))

    def of(self, program):
        return [row for row in self.rows if row.get("program") == program and "accepted" in row]


class WithFalsePrograms(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="compare_test_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.temporary = self.folder / "temporary"
        self.temporary.mkdir()
        self.log = self.folder / "log"
        self.history = self.folder / "history.csv"
        self.ours = self.make_programs("ours")

    def make_programs(self, name):
        folder = self.folder / name
        folder.mkdir()
        for program, text in FALSE_PROGRAMS.items():
            write_script(folder / program, text)
        return folder

    def script(self, name, text):
        return write_script(self.folder / name, text)

    def start(self, *arguments):
        command = [sys.executable, SCRIPT, *map(str, arguments)]
        environment = {**os.environ, "LOG": str(self.log), "TMPDIR": str(self.temporary)}
        return subprocess.Popen(command, env=environment, cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True)

    def run_script(self, *arguments):
        """Exit code, standard output and standard error; nothing temporary is left."""
        child = self.start(*arguments)
        out, errors = child.communicate(timeout=SECONDS)
        self.assertEqual(os.listdir(self.temporary), [])
        self.assertNotIn("Traceback", errors)
        return child.returncode, out, errors

    def assert_gone(self, pid):
        """Or a zombie that nobody has waited for."""
        end = time.monotonic() + SECONDS
        while time.monotonic() < end:
            with contextlib.suppress(FileNotFoundError, ProcessLookupError):
                if pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z":
                    time.sleep(0.01)
                    continue
            return
        self.fail(f"process {pid} is still there")

    def compare(self, *arguments, kinds="clean", rounds=1):
        return self.run_script("--ours", self.ours, "--sizes", "1k", "--kinds", kinds, "--rounds", rounds, "-q", "--history", self.history,
                               *arguments)


class CommandLine(WithFalsePrograms):
    def assert_refused(self, arguments, reason, code=2):
        found, out, errors = self.run_script(*arguments)
        self.assertEqual((found, out), (code, ""), errors)
        self.assertRegex(errors, f"^compare.py: .*{reason}")
        self.assertEqual(errors.count("\n"), 1, errors)

    def test_help_has_examples_and_a_wrapper(self):
        code, out, _ = self.run_script("--help")
        self.assertEqual(code, 0)
        for words in ("Examples:", "--record --history-check", "#!/bin/sh", "Exit codes:"):
            self.assertIn(words, out)

    def test_what_is_wrong_is_told_in_a_line(self):
        self.assert_refused(["--bogus"], "unrecognized arguments: --bogus")
        self.assert_refused(["file"], "unrecognized arguments: file")
        self.assert_refused(["--kinds", "clean,foo"], "foo is none of clean, ")
        self.assert_refused(["--sizes", "10q"], "10q is no size")
        self.assert_refused(["--sizes", "1"], "1 is no size")
        self.assert_refused(["--sizes", ""], " is no size")
        self.assert_refused(["--rounds", "0"], "0 is not a number from 1")
        self.assert_refused(["--threads", "1,x"], "x is not a number from 1")
        self.assert_refused(["--timeout", "0"], "0 is not a number of seconds")

    def test_programs_that_are_not_there_are_told_before_anything_runs(self):
        empty = self.folder / "empty"
        empty.mkdir()
        some = ["--ours", self.ours]
        self.assert_refused(["--ours", empty], "empty/meshrepair: is no program")
        self.assert_refused([*some, "--peer", "a=/nowhere"], "/nowhere: is no program")
        self.assert_refused([*some, "--peer", "a="], "a= is not NAME=PATH")
        self.assert_refused([*some, "--peer", str(self.ours / "meshrepair")], " is not NAME=PATH")
        self.assert_refused([*some, "--judge", "/nowhere"], "/nowhere: is no program")
        self.assert_refused([*some, "--make-models", "/nowhere"], "/nowhere: is no program")
        self.assert_refused([*some, "--ours", self.ours], "two programs are called ours")
        self.assert_refused([*some, "--output", self.folder / "none" / "table"], "cannot be written", 6)
        self.assert_refused([*some, "--output", self.folder], "cannot be written", 6)
        self.assert_refused([*some, "--record", "--history", "/nowhere/history.csv"], "cannot be written", 6)
        self.assert_refused([*some, "--record", "--history", "/proc/history.csv"], "cannot be written", 6)
        self.assertFalse(self.log.exists())

    def test_record_needs_the_calibration(self):
        (self.ours / "calibration").unlink()
        self.assert_refused(["--ours", self.ours, "--record"], "calibration: is no program")

    def test_a_calibration_that_fails_is_told(self):
        write_script(self.ours / "calibration", "exit 3")
        code, _, errors = self.compare("--record")
        self.assertEqual(code, 2)
        self.assertIn("calibration: exit code 3", errors)
        self.assertFalse(self.history.exists())

    def test_inputs_that_cannot_be_made_are_told(self):
        self.script("maker", "echo 'maker: no input is called clean:1000' >&2; exit 2")
        code, _, errors = self.compare("--make-models", self.folder / "maker")
        self.assertEqual(code, 2)
        self.assertIn("did not make clean:1000: maker: no input is called clean:1000", errors)

    def test_inputs_that_take_too_long_are_told(self):
        self.script("maker", "exec sleep 3600")
        code, _, errors = self.compare("--make-models", self.folder / "maker", "--timeout", "0.5")
        self.assertEqual(code, 2)
        self.assertIn("did not make clean:1000 in time", errors)


class Caches(WithFalsePrograms):
    """The compiled copies of its parts that Python keeps beside a script."""

    def setUp(self):
        super().setUp()
        self.scripts = self.folder / "bench"
        shutil.copytree(SCRIPT.parent / "comparison", self.scripts / "comparison", ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copy(SCRIPT, self.scripts)

    def test_a_first_start_on_a_full_disk_leaves_nothing(self):
        environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4000, 4000))
        done = subprocess.run([sys.executable, self.scripts / SCRIPT.name, "--help"], env=environment, check=False,
                              capture_output=True, timeout=SECONDS, preexec_fn=limit)
        self.assertEqual(done.returncode, 0)
        self.assertEqual(list(self.scripts.rglob("*.pyc")), [])


class Runs(WithFalsePrograms):
    def test_rounds_alternate_between_programs(self):
        other = self.make_programs("other")
        code, out, _ = self.compare("--ours", f"other={other}", rounds=3)
        self.assertEqual(code, 0)
        self.assertEqual(self.log.read_text().split(), ["ours", "other", "other", "ours", "ours", "other"])
        self.assertEqual([row["program"] for row in Table(out).rows], ["ours", "other"])

    def test_all_kinds_are_run(self):
        code, out, _ = self.compare(kinds=",".join(inputs.KINDS))
        self.assertEqual(code, 0)
        self.assertEqual([row["input"] for row in Table(out).rows], [f"{kind} 1k" for kind in inputs.KINDS])

    def test_a_size_is_the_number_of_triangles_for_cubes_too(self):
        _, out, _ = self.compare(kinds="cubes")
        self.assertEqual(Table(out).rows[0]["triangles"], str(1000 // 12))  # as many cubes were asked for

    def test_threads_have_rows_and_a_table_of_their_own(self):
        _, out, _ = self.compare("--threads", "1,2")
        rows = Table(out).rows
        self.assertEqual([row["program"] for row in rows[:2]], ["ours, 1 thread", "ours, 2 threads"])
        self.assertEqual([(row["program"], row["threads"]) for row in rows[2:]], [("ours", "1"), ("ours", "2")])
        self.assertEqual(rows[2]["speed-up"], "1.00")

    def test_output_is_a_file_that_is_whole(self):
        code, out, _ = self.compare("--output", self.folder / "table.md")
        self.assertEqual((code, out), (0, ""))
        self.assertEqual(len(Table((self.folder / "table.md").read_text()).rows), 1)

    def test_a_failure_of_ours_is_exit_code_1(self):
        write_script(self.ours / "meshrepair", "echo 'meshrepair: so it is' >&2; exit 4")
        code, out, errors = self.compare()
        self.assertEqual(code, 1)
        self.assertEqual(Table(out).rows[0]["exit"], "4")
        self.assertIn("no result, exit code 4: meshrepair: so it is", errors)

    def test_what_is_not_certified_is_judged_all_the_same(self):
        write_script(self.ours / "meshrepair", 'cp "$1" "$2"; exit 1')
        code, out, _ = self.compare()
        self.assertEqual((code, Table(out).rows[0]["exit"], Table(out).rows[0]["accepted"]), (1, "1", "yes"))


class Peers(WithFalsePrograms):
    def row_of(self, text, *arguments, kinds="clean", rounds=1):
        """The row of a peer; our program goes on as if it were alone."""
        peer = self.script("peer.sh", text)
        code, out, errors = self.compare("--peer", f"peer={peer}", *arguments, kinds=kinds, rounds=rounds)
        self.assertEqual(code, 0, errors)
        self.assertEqual(len(Table(out).of("ours")), len(kinds.split(",")))
        rows = Table(out).of("peer")
        return rows[0] if rows else None

    def test_a_peer_that_makes_a_mesh_is_accepted(self):
        row = self.row_of('cp "$1" "$2"')
        self.assertEqual((row["exit"], row["accepted"], row["result"]), ("0", "yes", "1,000"))

    def test_a_peer_that_fails_has_no_result_and_is_not_tried_again(self):
        row = self.row_of('cp "$1" "$2"; echo peer >> "$LOG"; exit 3', rounds=3)
        self.assertEqual((row["exit"], row["accepted"], row["CPU, s"]), ("3", "no result", "-"))
        self.assertEqual(self.log.read_text().split().count("peer"), 1)

    def test_a_peer_that_writes_garbage_is_not_accepted(self):
        row = self.row_of('head -c 1000 /dev/urandom > "$2"')
        self.assertEqual((row["exit"], row["accepted"], row["result"]), ("0", "no", "-"))

    def test_a_peer_that_writes_nothing_has_no_result(self):
        row = self.row_of("exit 0")
        self.assertEqual((row["exit"], row["accepted"]), ("0", "no result"))

    def test_a_peer_that_makes_a_folder_has_no_result(self):
        row = self.row_of('mkdir "$2"; touch "$2/file"')
        self.assertEqual((row["exit"], row["accepted"]), ("0", "no result"))

    def test_one_bad_result_of_several_is_not_accepted(self):
        row = self.row_of('if mkdir "$LOG.seen" 2>&-; then echo bad > "$2"; else cp "$1" "$2"; fi', rounds=2)
        self.assertEqual(row["accepted"], "no")

    def test_a_peer_without_end_is_killed_with_all_that_it_started(self):
        row = self.row_of('sleep 3600 & echo $! > "$LOG.pid"; wait', "--timeout", "0.5")
        self.assertEqual((row["exit"], row["accepted"]), ("timeout", "no result"))
        self.assert_gone(int((self.folder / "log.pid").read_text()))

    def test_what_a_peer_leaves_running_is_killed(self):
        self.row_of('sleep 3600 & echo $! > "$LOG.pid"; cp "$1" "$2"')
        self.assert_gone(int((self.folder / "log.pid").read_text()))

    def test_a_peer_says_which_kinds_it_does_not_do(self):
        self.assertIsNone(self.row_of('test "$COMPARE_KIND" = clean && exit 77'))

    def test_a_peer_gets_both_meshes_of_a_union(self):
        row = self.row_of('test $# = 3 && cmp "$1" "$2" && cp "$1" "$3"', kinds="union")
        self.assertEqual(row["accepted"], "yes")

    def test_a_peer_that_is_no_program_ends_the_script(self):
        peer = self.folder / "peer"
        peer.write_bytes(b"\x7fELF garbage")
        peer.chmod(0o755)
        code, _, errors = self.compare("--peer", f"peer={peer}")
        self.assertEqual(code, 2)
        self.assertRegex(errors, "compare.py: .*peer: cannot be started")


class Judges(WithFalsePrograms):
    def verdict(self, text, kinds="clean"):
        _, out, _ = self.compare("--judge", self.script("judge.sh", text), kinds=kinds)
        return Table(out).rows[0]["accepted"]

    def test_both_answers_have_to_be_yes(self):
        self.assertEqual(self.verdict("""echo '{"is_clean": true, "outward_oriented": true}'"""), "yes")
        self.assertEqual(self.verdict("""echo '{"is_clean": false, "outward_oriented": true}'"""), "no")
        self.assertEqual(self.verdict("""echo '{"is_clean": true, "outward_oriented": false}'"""), "no")
        self.assertEqual(self.verdict("""echo '{"error": "no mesh"}'; exit 2"""), "no")

    def test_a_judge_that_says_nothing_is_told_from_one_that_says_no(self):
        self.assertEqual(self.verdict("exit 0"), "?")
        self.assertEqual(self.verdict("kill -9 $$"), "?")

    def test_a_judge_without_end_is_killed_with_all_that_it_started(self):
        judge = self.script("judge.sh", 'sleep 3600 & echo $! > "$LOG.pid"; wait')
        _, out, _ = self.compare("--judge", judge, "--timeout", "0.5")
        self.assertEqual(Table(out).rows[0]["accepted"], "?")
        self.assert_gone(int((self.folder / "log.pid").read_text()))

    def test_a_judge_gets_the_input_where_it_is_one_mesh(self):
        yes = """echo '{"is_clean": true, "outward_oriented": true}'"""
        self.assertEqual(self.verdict(f'test "$2" = --against && test -f "$3" && {yes}'), "yes")
        self.assertEqual(self.verdict(f"test $# = 1 && {yes}", kinds="union"), "yes")
        self.assertEqual(self.verdict(f"test $# = 1 && {yes}", kinds="cloud"), "yes")


class Interruptions(WithFalsePrograms):
    def interrupt(self, number):
        """While our program runs without end."""
        write_script(self.ours / "meshrepair", 'echo $$ > "$LOG.new"; mv "$LOG.new" "$LOG"; exec sleep 3600')
        self.history.write_text("untouched\n")
        before = self.history.read_bytes()
        child = self.start("--ours", self.ours, "--kinds", "clean", "--output", self.folder / "table.md")
        while not self.log.exists() and child.poll() is None:
            time.sleep(0.01)
        child.send_signal(number)
        _, errors = child.communicate(timeout=SECONDS)
        self.assertRegex(errors, "compare.py: interrupted; nothing is left\n$")
        self.assertEqual(os.listdir(self.temporary), [])
        self.assertFalse((self.folder / "table.md").exists())
        self.assertEqual(self.history.read_bytes(), before)
        self.assert_gone(int(self.log.read_text()))
        return child.returncode

    def test_nothing_is_left_after_ctrl_c(self):
        self.assertEqual(self.interrupt(signal.SIGINT), 130)

    def test_nothing_is_left_after_sigterm(self):
        self.assertEqual(self.interrupt(signal.SIGTERM), 143)

    def test_nothing_is_left_when_the_terminal_is_closed(self):
        self.assertEqual(self.interrupt(signal.SIGHUP), 129)


class Inputs(unittest.TestCase):
    def test_sizes(self):
        for text, size in (("10k", 10_000), ("1M", 1_000_000), ("1.5k", 1500), ("500", 500), ("3m", 3_000_000)):
            self.assertEqual(inputs.size_of(text), size)
        for text in ("", "k", "-1k", "99", "31M", "1e5", "10 k"):
            self.assertRaises(ValueError, inputs.size_of, text)
        self.assertEqual([inputs.short_size(size) for size in (10_000, 1_000_000, 1_500_000, 500)], ["10k", "1M", "1500k", "500"])

    def test_faces_are_counted_by_the_header(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "mesh.off")
            for text, count in ((TRIANGLES.format(count=7), 7), ("OFF # so\n# and so\n\n3 8 0\n", 8), ("OFF 3 9 0\n", 9), ("", None),
                                ("OFF\n", None), ("OFF\nx y z\n", None), ("solid a\n1 2 3", None)):
                path.write_text(text)
                self.assertEqual(inputs.count_faces(path), count, text)


def made_up(kind, size, cpu, peak, out=None, name="ours", hidden=False, failed=False):
    """Looks like what rounds.Measured tells."""
    least = {"cpu": cpu, "peak": peak}.get
    item = types.SimpleNamespace(kind=kind, size=size, triangles=size)
    return types.SimpleNamespace(item=item, program=types.SimpleNamespace(name=name), least=least, triangles=out,
                                 peak_hidden=lambda: hidden, failed=lambda: failed)


class Exponents(unittest.TestCase):
    def test_a_power_is_found_again(self):
        for power in (0.5, 1, 1.5, 2):
            self.assertAlmostEqual(growth.exponent(1000, 3 * 1000**power, 7000, 3 * 7000**power), power)

    def test_what_tells_nothing_has_none(self):
        for values in ((1000, 0, 2000, 1), (1000, 1, 1000, 2), (None, 1, 2000, 2), (1000, 1, 0, 2)):
            self.assertIsNone(growth.exponent(*values))

    def test_what_grows_too_fast_is_bold(self):
        self.assertEqual([growth.shown(value) for value in (None, 1.0, 1.15, 1.16, 2.0)], ["-", "1.00", "1.15", "**1.16**", "**2.00**"])

    def test_each_pair_of_neighbours_has_one(self):
        rows = growth.growth_rows([made_up("clean", size, cpu, peak) for size, cpu, peak in
                                   ((10_000, 1, 100), (100_000, 10, 100), (1_000_000, 1000, 1000))])
        self.assertEqual(rows, [["clean", "ours", "in", "10,000 to 100,000 to 1,000,000", "1.00, **2.00**", "0.00, 1.00"]])

    def test_sizes_may_come_in_any_order(self):
        rows = growth.growth_rows([made_up("clean", 100_000, 10, 100), made_up("clean", 10_000, 1, 10)])
        self.assertEqual(rows[0][3:], ["10,000 to 100,000", "1.00", "1.00"])

    def test_cubes_are_told_by_their_result_too(self):
        rows = growth.growth_rows([made_up("cubes", 1000, 1, 10, 5000), made_up("cubes", 10_000, 100, 100, 500_000)])
        self.assertEqual([row[2:5] for row in rows], [["in", "1,000 to 10,000", "**2.00**"], ["out", "5,000 to 500,000", "1.00"]])

    def test_programs_are_apart_and_failures_left_out(self):
        rows = growth.growth_rows([made_up("clean", 1000, 1, 10), made_up("clean", 10_000, 10, 100),
                                   made_up("clean", 1000, 1, 10, name="peer"), made_up("clean", 10_000, 1, 10, name="peer", failed=True)])
        self.assertEqual([row[1] for row in rows], ["ours"])

    def test_memory_that_is_not_known_has_none(self):
        rows = growth.growth_rows([made_up("clean", 1000, 1, 20, hidden=True), made_up("clean", 10_000, 10, 100)])
        self.assertEqual(rows[0][4:], ["1.00", "-"])

    def test_stages_that_take_no_time_are_left_out(self):
        rows = growth.stage_rows("clean", [1000, 10_000], [{"read": 0.001, "tree": 0.1}, {"read": 0.002, "tree": 1.0, "cells": 0.5}])
        self.assertEqual(rows, [["clean", "tree", "0.100 to 1.00", "1.00"], ["clean", "cells", "0.000 to 0.500", "-"]])


ROW = history.Row("aaaaaaa", "2026-01-01", "machine x 2", "clean", 10_000, "0123456789ab", 1.0, 100.0, 0.5, 3, 0.02)


def row(commit, **others):
    return dataclasses.replace(ROW, commit=commit, **others)


class HistoryCheck(unittest.TestCase):
    """With made-up rows; of these each aaaaaaa costs 2 calibrations and 100 MB."""

    def assert_grew(self, rows, *patterns, sure=True, since=None):
        lines, grew = history.check(rows, since)
        self.assertEqual(len(lines) - 1, len(patterns), lines)
        for line, pattern in zip(lines, patterns):
            self.assertRegex(line, pattern)
        self.assertEqual(grew, sure, lines)
        return lines[-1]

    def test_a_tenth_is_seen(self):
        self.assert_grew([ROW, row("bbbbbbb", cpu_s=1.09)], sure=False)
        self.assert_grew([ROW, row("bbbbbbb", cpu_s=1.12)], "^clean 10k: CPU 12 % above the row before, aaaaaaa: 1.120 s")

    def test_a_slow_machine_is_no_growth(self):
        self.assert_grew([ROW, row("bbbbbbb", cpu_s=1.3, calibration_s=0.65)], sure=False)

    def test_a_fast_machine_hides_no_growth(self):
        self.assert_grew([ROW, row("bbbbbbb", cpu_s=1.0, calibration_s=0.4)], "CPU 25 % above")

    def test_growth_within_what_rounds_differ_is_doubtful(self):
        self.assert_grew([ROW, row("bbbbbbb", cpu_s=1.12, differ=0.2)], "12 % above .*; doubtful, rounds differ by 20 %", sure=False)
        self.assert_grew([row("aaaaaaa", differ=0.2), row("bbbbbbb", cpu_s=1.12)], "doubtful", sure=False)

    def test_one_round_proves_nothing(self):
        self.assert_grew([ROW, row("bbbbbbb", cpu_s=1.5, rounds=1)], "50 % above .*; doubtful, of one round", sure=False)

    def test_memory_is_seen(self):
        self.assert_grew([ROW, row("bbbbbbb", peak_mb=111.0)], "memory 11 % above the row before, aaaaaaa: 111 MB, 100 MB")

    def test_memory_that_is_not_known_is_not_compared(self):
        self.assert_grew([row("aaaaaaa", peak_mb=0.0), row("bbbbbbb", peak_mb=30.0), row("ccccccc", peak_mb=31.0)], sure=False)
        self.assert_grew([ROW, row("bbbbbbb", peak_mb=0.0)], sure=False)
        self.assert_grew([ROW, row("bbbbbbb", peak_mb=0.0), row("ccccccc", peak_mb=120.0)], "20 % above the best, aaaaaaa")

    def test_small_steps_add_up(self):
        self.assert_grew([ROW, row("bbbbbbb", cpu_s=1.06), row("ccccccc", cpu_s=1.12)], "CPU 12 % above the best, aaaaaaa")

    def test_growth_that_was_meant_is_left_behind(self):
        rows = [ROW, row("bbbbbbb", cpu_s=2.0), row("ccccccc", cpu_s=2.0)]
        self.assert_grew(rows, "above the best")
        self.assert_grew(rows, sure=False, since="bbbbbb")
        self.assertRaisesRegex(Stop, "no row of the history is of dd", history.check, rows, "dd")

    def test_only_what_is_alike_is_compared(self):
        for others in ({"machine": "other x 2"}, {"kind": "holes"}, {"size": 20_000}, {"digest": "ba9876543210"}):
            summary = self.assert_grew([ROW, row("bbbbbbb", cpu_s=9.0, **others)], sure=False)
            self.assertIn("0 of 1 inputs have rows before", summary)

    def test_the_later_of_two_rows_of_a_commit_counts(self):
        self.assert_grew([ROW, row("bbbbbbb", cpu_s=2.0), row("bbbbbbb", cpu_s=1.0)], sure=False)
        self.assert_grew([row("aaaaaaa", cpu_s=3.0), ROW, row("bbbbbbb", cpu_s=2.0)], "CPU 100 % above")

    def test_one_commit_alone_is_compared_with_nothing(self):
        self.assertIn("0 of 1 inputs have rows before", self.assert_grew([ROW, ROW], sure=False))
        self.assertEqual(history.check([]), (["no rows"], False))


class History(WithFalsePrograms):
    def rows(self):
        with open(self.history, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_rows_are_added_and_none_changed(self):
        code, _, errors = self.compare("--record", "--commit", "aaaaaaa", kinds="clean,union")
        self.assertEqual(code, 0, errors)
        before = self.history.read_bytes()
        self.assertEqual([(each["commit"], each["kind"], each["size"]) for each in self.rows()],
                         [("aaaaaaa", "clean", "1000"), ("aaaaaaa", "union", "1000")])
        self.compare("--record", "--commit", "bbbbbbb", rounds=2)
        self.assertTrue(self.history.read_bytes().startswith(before))
        self.assertEqual((self.rows()[2]["commit"], self.rows()[2]["rounds"]), ("bbbbbbb", "2"))
        self.assertEqual(self.rows()[0]["digest"], self.rows()[2]["digest"])

    def test_what_was_not_accepted_is_not_recorded(self):
        write_script(self.ours / "meshcheck", "echo '{}'")
        code, _, errors = self.compare("--record", "--commit", "aaaaaaa")
        self.assertEqual(code, 1)
        self.assertIn("0 rows added", errors)
        self.assertEqual(self.rows(), [])

    def test_only_the_first_of_several_is_recorded(self):
        self.compare("--record", "--commit", "aaaaaaa", "--threads", "1,2", "--ours", f"other={self.make_programs('other')}")
        self.assertEqual(len(self.rows()), 1)

    def test_a_check_alone_runs_nothing(self):
        history.append(str(self.history), [ROW, row("bbbbbbb", cpu_s=1.5)])
        code, out, _ = self.compare("--history-check")
        self.assertEqual(code, 1)
        self.assertRegex(out, "^clean 10k: CPU 50 % above the row before, aaaaaaa.*\nbbbbbbb on machine x 2: 1 of 1 inputs .* 1 grew")
        self.assertFalse(self.log.exists())
        self.assertEqual(self.compare("--history-check", "--since", "bbbbbbb")[0], 0)

    def test_a_file_that_is_no_history_is_told_in_a_line(self):
        head = ",".join(history.COLUMNS)
        for text, reason in (("", "the first line is not"), ("a,b\n", "the first line is not"), (head + "\n1,2\n", ":2: 2 columns"),
                             (head + "\na,b,c,d,e,f,g,h,i,j,k\n", ":2: invalid literal"),
                             (head + "\na,b,c,d,1,f,0,1,1,1,0\n", ":2: a time or a size is below 0")):
            self.history.write_text(text)
            for option in ("--history-check", "--record"):
                code, out, errors = self.compare(option)
                self.assertEqual((code, out), (2, ""))
                self.assertIn(reason, errors)
                self.assertEqual(errors.count("\n"), 1)
            self.assertEqual(self.history.read_text(), text)

    def test_a_history_that_is_not_there_is_told(self):
        code, _, errors = self.compare("--history-check")
        self.assertEqual(code, 2)
        self.assertIn("there is no such file", errors)

    def test_the_history_of_the_project_is_one(self):
        self.assertTrue(history.read_rows(str(ROOT / "bench" / "history.csv")))


class Measuring(unittest.TestCase):
    def measured(self, command, timeout=SECONDS):
        with tempfile.TemporaryDirectory() as work:
            return measure.run([sys.executable, "-SE", "-c", command], work, timeout)

    def test_cpu_time_and_memory_are_those_of_the_program(self):
        small = self.measured("pass")
        large = self.measured("a = bytearray(200 << 20)\nfor i in range(3_000_000): pass")
        self.assertGreater(large.peak, 200)
        self.assertFalse(large.peak_hidden)
        self.assertGreater(large.cpu, small.cpu)
        self.assertGreaterEqual(large.wall, 0)

    def test_memory_below_that_of_the_script_is_hidden(self):
        with tempfile.TemporaryDirectory() as work:
            self.assertTrue(measure.run(["/bin/true"], work, SECONDS).peak_hidden)

    def test_what_a_program_starts_counts(self):
        done = self.measured("import subprocess, sys; subprocess.run([sys.executable, '-c', 'a = bytearray(200 << 20)'])")
        self.assertGreater(done.peak, 200)

    def test_signals_and_last_lines_are_told(self):
        done = self.measured("import os, sys; print('one\\ntwo', file=sys.stderr, flush=True); os.kill(os.getpid(), 9)")
        self.assertEqual((done.code, done.error), (-9, "two"))
        self.assertIsNone(self.measured("import time; time.sleep(3600)", 0.5).code)


class RealPrograms(unittest.TestCase):
    """All kinds, tiny, with the programs of the build."""

    def compare(self, *arguments):
        command = [sys.executable, SCRIPT, "--ours", PROGRAMS, "-q", *arguments]
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=SECONDS, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def test_every_kind_is_made_repaired_and_accepted(self):
        out = self.compare("--sizes", "300,600", "--rounds", "2", "--threads", "1,2", "--exponents")
        for kind in inputs.KINDS:
            found = [each for each in Table(out).rows if each.get("input") == f"{kind} 300" and "accepted" in each]
            self.assertTrue({"ours, 1 thread", "ours, 2 threads"} <= {each["program"] for each in found})
            self.assertTrue(all(each["accepted"] == "yes" for each in found if each["program"] != "CGAL"), found)
        self.assertIn("Exponents of growth", out)

    def test_what_is_recorded_can_be_checked(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "history.csv")
            out = self.compare("--kinds", "clean,union", "--sizes", "300", "--rounds", "1", "--record", "--history-check", "--history", path)
            self.assertIn("0 of 2 inputs have rows before", out)
            self.assertEqual(len(history.read_rows(str(path))), 2)

    def test_inputs_are_the_same_each_time(self):
        with tempfile.TemporaryDirectory() as folder:
            for kind in inputs.KINDS:
                found = set()
                for number in range(2):
                    work = pathlib.Path(folder, f"{kind}{number}")
                    found.add(inputs.make_input(str(PROGRAMS / "make_models"), kind, 600, str(work), 60).digest)
                    shutil.rmtree(work)
                self.assertEqual(len(found), 1, kind)

    def test_an_input_that_is_unknown_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("foo:100", "clean", "clean:", "clean:x", "clean:0", "clean:-1", "clean:1k"):
                done = subprocess.run([PROGRAMS / "make_models", folder, name], capture_output=True, text=True, check=False)
                self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), name)
                self.assertRegex(done.stderr, f"^make_models: .*{re.escape(name)}")


def main():
    global PROGRAMS
    if len(sys.argv) < 2 or sys.argv[1] in ("-h", "--help"):
        print(__doc__.strip())
        sys.exit(0 if len(sys.argv) == 2 else 2)
    PROGRAMS = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main(verbosity=2)


if __name__ == "__main__":
    main()
