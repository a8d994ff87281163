#!/usr/bin/env python3
"""Tests of scripts/repair_folder.py.

Usage: repair_folder_test.py MESHREPAIR [OPTIONS OF UNITTEST]

What it makes of meshes is tested with the program MESHREPAIR, what it does when a program fails in all
manners with a false one, which does what the name of its input says.
"""

import csv
import fcntl
import gzip
import io
import json
import os
import pathlib
import py_compile
import re
import resource
import shutil
import signal
import stat
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zipfile

sys.dont_write_bytecode = True  # a copy that is cut on a full disk would end all later tests
sys.pycache_prefix = os.devnull

import kill_folder

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts" / "repair_folder.py"
SAMPLES = ROOT / "samples" / "meshes"
MESHREPAIR = ""  # set by main
TAG = sys.implementation.cache_tag
SECONDS = 300  # for what takes one on an idle machine; what hangs, hangs for longer

CUBE = (SAMPLES / "cube.stl").read_bytes()
TETRAHEDRON = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
FLAT = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"

# Does what the first letters of its input's name say; tells FAKE_LOG how it was called.
FALSE_MESHREPAIR = """#!{python} -SE
import json, os, signal, sys, time
arguments = sys.argv[1:]
if arguments == ["--version"]:
    sys.exit(print("meshrepair 9.9.9"))
if arguments == ["--help"] and os.environ.get("FAKE_HELP") == "killed":
    os.kill(os.getpid(), signal.SIGKILL)
if arguments == ["--help"]:
    sys.exit(print(os.environ.get("FAKE_HELP", "no options")))
if "--bogus" in arguments:
    print("meshrepair: --bogus is unknown", file=sys.stderr)
    sys.exit(2)
source, target = arguments[-2:]
target = os.path.join(arguments[arguments.index("--staging") + 1], os.path.basename(target))
if "--report" not in arguments:
    sys.exit(3)
with open(os.environ["FAKE_LOG"], "a") as log:
    log.write(json.dumps(arguments) + "\\n")

def write(path, data):
    with open(path, "w") as file:
        file.write(data)

def end(code, error=None, verdict="PASS", mesh="whole mesh"):
    names = ("closed", "manifold", "oriented", "no_self_intersections", "no_degenerate_triangles")
    report = {{"exit_code": code, "error": error, "certificate": dict.fromkeys(names, verdict)}}
    write(arguments[arguments.index("--report") + 1], json.dumps(report))
    if mesh:
        write(target, mesh)
    sys.exit(code)

def hang():
    time.sleep(3600)

action = os.path.basename(source).partition(".")[0].rstrip("0123456789")
if action == "good":
    end(0)
elif action == "slow":
    while not os.path.exists(os.environ["FAKE_LOG"] + ".go"):
        time.sleep(0.01)
    end(0)
elif action == "code":
    code = int(open(source).read())
    end(code, source + ": so it is", "FAIL", "doubtful mesh" if code == 1 else "")
elif action == "hang":
    hang()
elif action == "deaf":
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    hang()
elif action == "half":
    write(target, "half a me")
    os.kill(os.getpid(), signal.SIGKILL)
elif action == "once":
    if not os.path.exists(source + ".tried"):
        write(source + ".tried", "")
        os.kill(os.getpid(), signal.SIGKILL)
    end(0)
elif action == "crash":
    os.kill(os.getpid(), signal.SIGSEGV)
elif action == "garbage":
    write(arguments[arguments.index("--report") + 1], "{{no json")
    write(target, "garbage")
elif action == "unproven":
    end(0, None, "FAIL")
elif action == "noisy":
    for i in range(300):
        os.write(2, b"x" * 65536)
    os.write(2, b"\\nmeshrepair: enough\\n")
    sys.exit(70)
elif action == "greedy":
    hoard = bytearray(b"x") * (300 << 20)
    hang()
elif action == "orphan" and os.fork() == 0:
    hang()  # and holds the pipe
elif action == "orphan":
    end(0)
"""


def write_files(folder, files):
    for name, data in files.items():
        path = os.path.join(os.fsencode(folder), os.fsencode(name))
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(data)


def names_in(folder):
    return {os.fsdecode(name) for name in kill_folder.outputs_in(folder)}


class FolderTest(unittest.TestCase):
    """Has an input folder, an output folder and a false meshrepair."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="repair_folder_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.source, self.out = self.folder / "in", self.folder / "out"
        self.source.mkdir()
        self.log = self.folder / "log"
        self.false = self.folder / "false_meshrepair"
        self.false.write_text(FALSE_MESHREPAIR.format(python=sys.executable))
        self.false.chmod(0o755)
        self.environment = {**os.environ, "FAKE_LOG": str(self.log)}

    def command(self, *options, program=None, source=None, out=None):
        end = options.index("--") if "--" in options else len(options)
        return [sys.executable, SCRIPT, "--meshrepair", program or self.false, *options[:end],
                source or self.source, out or self.out, *options[end:]]

    def start(self, *options, **others):
        return subprocess.Popen(self.command(*options, **others), env=self.environment, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def run_script(self, *options, code=0, before=None, **others):
        result = subprocess.run(self.command(*options, **others), env=self.environment, text=True,
                                check=False, capture_output=True, timeout=SECONDS, preexec_fn=before)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertNotIn("Traceback", result.stderr)
        return result

    def wait_for_calls(self, number, process):
        """Until the false program was called so often."""
        while not self.log.exists() or len(self.log.read_text().splitlines()) < number:
            self.assertIsNone(process.poll(), "the script has ended")
            time.sleep(0.01)

    def let_slow_ones_end(self):
        pathlib.Path(f"{self.log}.go").touch()

    def rows(self):
        with open(self.out / "summary.csv", encoding="utf-8", newline="") as file:
            return {row["path"]: row for row in csv.DictReader(file)}

    def codes(self):
        return {path: int(row["exit_code"]) for path, row in self.rows().items()}

    def calls(self):
        """Names of the inputs that the false program got since the last call of this."""
        if not self.log.exists():
            return []
        lines = self.log.read_text().splitlines()
        self.log.unlink()
        return sorted(os.path.basename(json.loads(line)[-2]) for line in lines)


class Meshes(FolderTest):
    def make(self):
        write_files(self.source, {
            "cube.stl": CUBE, "sub/Tetrahedron.OBJ": TETRAHEDRON, "sub/deep/cube.stl": CUBE,
            "bad/cut.ply": b"ply\nformat binary", "bad/empty.stl": b"", "bad/flat.obj": FLAT,
            "readme.txt": b"no mesh"})

    def test_keeps_names_and_sub_folders_and_failures_stop_nothing(self):
        self.make()
        result = self.run_script(program=MESHREPAIR, code=1)
        self.assertEqual(names_in(self.out), {"cube.stl", "sub/Tetrahedron.OBJ", "sub/deep/cube.stl"})
        self.assertEqual(self.codes(), {
            "bad/cut.ply": 3, "bad/empty.stl": 3, "bad/flat.obj": 5, "cube.stl": 0,
            "sub/Tetrahedron.OBJ": 0, "sub/deep/cube.stl": 0})
        self.assertIn("bad/empty.stl: is empty (exit code 3)\n", result.stderr)
        self.assertRegex(result.stdout, r"\n +3 +2  cannot be read\n")

    def test_rows_are_sorted_and_say_what_came_out(self):
        self.make()
        self.run_script(program=MESHREPAIR, code=1)
        rows = self.rows()
        self.assertEqual(list(rows), sorted(rows))
        cube, flat = rows["cube.stl"], rows["bad/flat.obj"]
        for guarantee in ("closed", "manifold", "oriented", "no_self_intersections", "no_degenerate_triangles"):
            self.assertEqual((cube[guarantee], flat[guarantee]), ("PASS", ""))
        self.assertEqual((cube["output"], cube["triangles_in"], cube["triangles_out"]), ("cube.stl", "12", "12"))
        self.assertEqual(int(cube["bytes_in"]), len(CUBE))
        self.assertEqual(int(cube["bytes_out"]), (self.out / "cube.stl").stat().st_size)
        self.assertGreater(float(cube["seconds"]), 0)
        self.assertGreater(int(cube["peak_memory_bytes"]), 1 << 20)
        self.assertEqual((flat["output"], flat["bytes_out"]), ("", ""))
        summary = json.loads((self.out / "summary.json").read_bytes())
        self.assertEqual(summary["totals"]["by_exit_code"], {"0": 3, "3": 2, "5": 1})
        self.assertEqual([row["path"] for row in summary["files"]], list(rows))

    def test_killed_and_resumed_gives_what_an_undisturbed_run_gives(self):
        self.make()
        for i in range(6):
            shutil.copyfile(SAMPLES / "broken_torus_box.stl", self.source / f"torus{i}.stl")
        killer = kill_folder.Killer(MESHREPAIR, self.source, self.folder, seed=1)
        killer.run(6)
        self.assertEqual(killer.complaints, [])
        self.assertEqual(len(killer.outputs), 9)

    def test_format_and_options_reach_the_program(self):
        write_files(self.source, {"a.obj": TETRAHEDRON})
        self.run_script("--format", "ply-ascii", "--", "--sources", program=MESHREPAIR)
        self.assertIn(b"format ascii", (self.out / "a.ply").read_bytes())
        self.assertIn(b"source_triangle", (self.out / "a.ply").read_bytes())
        result = self.run_script("--", "--inside", "magic", program=MESHREPAIR, code=2)
        self.assertIn("refuses the options: --inside: magic", result.stderr)


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

    def test_a_program_that_takes_too_much_memory_is_killed(self):
        write_files(self.source, {"greedy.stl": b"x", "good.stl": b"x"})
        self.run_script("--max-memory", "100M", code=1)
        self.assertEqual(self.codes(), {"greedy.stl": 4, "good.stl": 0})

    def test_a_program_that_is_gone_fails_each_file(self):
        write_files(self.source, {"slow.stl": b"x", "then/good.stl": b"x"})
        process = self.start("--jobs", "1", "--quiet")
        self.wait_for_calls(1, process)
        self.false.unlink()
        self.let_slow_ones_end()
        process.communicate(timeout=SECONDS)
        self.assertEqual(process.returncode, 1)
        self.assertEqual(self.codes(), {"slow.stl": 0, "then/good.stl": 70})

    def test_a_full_disk_is_one_line(self):
        write_files(self.source, {f"good{i}.stl": b"x" for i in range(30)})
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4000, 4000))
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


class Names(FolderTest):
    def test_odd_names(self):
        odd = [b"-x.stl", b"a b.stl", b"new\nline.stl", b"caf\xe9.stl", "\u00e9\u4e2d.StL".encode(),
               b"q\"uote,.obj", b"sub\n/--help.stl", b"%s{0}.off", b".hidden.stl", b"back\\slash.ply",
               b"long" * 60 + b".stl"]
        write_files(self.source, {name: TETRAHEDRON for name in odd})
        self.run_script(program=MESHREPAIR)
        self.assertEqual(set(kill_folder.outputs_in(self.out)), set(odd))
        self.assertEqual(set(self.rows()), {name.decode("utf-8", "backslashreplace") for name in odd})
        before = self.rows()
        self.run_script(program=MESHREPAIR)
        self.assertEqual(self.rows(), before)  # with the same times: nothing was done again

    def test_what_is_no_file_is_left_out_and_never_waited_for(self):
        write_files(self.source, {"good.stl": b"x", "sub/good.stl": b"x"})
        os.mkfifo(self.source / "fifo.stl")
        os.symlink("fifo.stl", self.source / "link_to_fifo.stl")
        os.symlink("good.stl", self.source / "good2.stl")
        os.symlink("..", self.source / "sub" / "loop")
        os.symlink("sub", self.source / "link.stl")
        os.symlink("round.stl", self.source / "round.stl")
        os.symlink("nowhere", self.source / "dangling.obj")
        result = self.run_script(code=1)
        self.assertEqual(self.codes(), {
            "good.stl": 0, "sub/good.stl": 0, "good2.stl": 0, "round.stl": 3, "dangling.obj": 3})
        for line in ("fifo.stl: left out: is no regular file", "link_to_fifo.stl: left out: is no regular",
                     "sub/loop: left out: is a link to a folder", "link.stl: left out: is a link to a folder"):
            self.assertIn(line, result.stderr)

    def test_files_that_vanish_or_cannot_be_read_are_rows(self):
        write_files(self.source, {"slow.stl": b"x", "t_gone.stl": b"x", "shut.stl": b"x"})
        os.chmod(self.source / "shut.stl", 0)
        process = self.start("--jobs", "1")
        self.wait_for_calls(1, process)
        os.unlink(self.source / "t_gone.stl")
        self.let_slow_ones_end()
        process.communicate(timeout=SECONDS)
        self.assertEqual(self.rows()["t_gone.stl"]["error"], "cannot be opened: No such file or directory")
        if os.getuid() != 0:
            self.assertEqual(self.rows()["shut.stl"]["error"], "cannot be opened: Permission denied")
            self.calls()
            os.chmod(self.source / "shut.stl", 0o600)
            self.run_script(code=1)
            self.assertEqual(self.calls(), ["shut.stl"])

    @unittest.skipIf(os.getuid() == 0, "root reads every folder")
    def test_a_folder_that_cannot_be_read_is_no_success(self):
        write_files(self.source, {"good.stl": b"x", "shut/good.stl": b"x"})
        os.chmod(self.source / "shut", 0)
        self.addCleanup(os.chmod, self.source / "shut", stat.S_IRWXU)
        self.assertIn("shut/: left out: cannot be read: Permission denied", self.run_script(code=1).stderr)

    def test_outputs_of_one_name_keep_their_extensions(self):
        names = ["a.stl", "a.obj", "b.stl", "c.stl", "c.STL", "a.stl.obj", "d.stl", "d.obj/e.stl", "e/a.stl"]
        write_files(self.source, {name: TETRAHEDRON for name in names})
        self.run_script("--format", "obj", program=MESHREPAIR)
        self.assertEqual({path: row["output"] for path, row in self.rows().items()}, {
            "a.stl": "a.stl.obj", "a.obj": "a.obj.obj", "a.stl.obj": "a.stl.obj.obj", "b.stl": "b.obj",
            "c.stl": "c.stl.obj", "c.STL": "c.STL.obj", "d.stl": "d.stl.obj",
            "d.obj/e.stl": "d.obj/e.obj", "e/a.stl": "e/a.obj"})
        self.assertEqual(names_in(self.out), {row["output"] for row in self.rows().values()})


    def test_packed_files_come_out_packed_and_archives_as_what_they_hold(self):
        def archive(*names):
            data = io.BytesIO()
            with zipfile.ZipFile(data, "w") as file:
                for name in names:
                    file.writestr(name, TETRAHEDRON)
            return data.getvalue()
        packed = gzip.compress(TETRAHEDRON)
        write_files(self.source, {
            "a.obj.gz": packed, "B.OBJ.GZ": packed, "c.zip": archive("read.me", "d/c.obj", "__MACOSX/._c.obj"),
            "e.zip": archive("e.OBJ"), "e.obj": TETRAHEDRON, "e.zip.obj": TETRAHEDRON,
            "two.zip": archive("a.obj", "b.stl"), "none.zip": archive("a.txt"), "cut.zip": archive("a.obj")[:-5],
            "other.tar.gz": packed})
        result = self.run_script(program=MESHREPAIR)
        self.assertEqual({path: row["output"] for path, row in self.rows().items()}, {
            "a.obj.gz": "a.obj.gz", "B.OBJ.GZ": "B.OBJ.GZ", "c.zip": "c.obj", "e.zip": "e.zip.obj.obj",
            "e.obj": "e.obj", "e.zip.obj": "e.zip.obj"})
        self.assertTrue(gzip.decompress((self.out / "a.obj.gz").read_bytes()).startswith(b"v "))
        self.assertTrue((self.out / "c.obj").read_bytes().startswith(b"v "))
        self.assertIn("two.zip: left out: holds several meshes", result.stderr)
        self.assertIn("cut.zip: left out: is no ZIP archive that can be read", result.stderr)
        self.assertNotIn("none.zip", result.stderr)
        self.run_script("--format", "stl", "--restart", program=MESHREPAIR)
        self.assertEqual({path: row["output"] for path, row in self.rows().items()}, {
            "a.obj.gz": "a.stl", "B.OBJ.GZ": "B.stl", "c.zip": "c.stl", "e.zip": "e.zip.stl",
            "e.obj": "e.obj.stl", "e.zip.obj": "e.zip.obj.stl"})


def painted(library):
    """An OBJ file with a material of this library."""
    faces = b"usemtl wood\nf 1/1 3/3 2/2\nf 1/1 2/2 4/3\nf 2/1 3/2 4/3\nf 1/1 4/2 3/3\n"
    return b"mtllib " + library + b"\n" + TETRAHEDRON.split(b"f ")[0] + b"vt 0 0\nvt 1 0\nvt 0 1\n" + faces


def cube_as_gltf(uri="a.bin"):
    """The text, and the bytes of its buffer."""
    points = [float(i >> axis & 1) for i in range(8) for axis in range(3)]
    quads = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    corners = [corner for a, b, c, d in quads for corner in (a, b, c, a, c, d)]
    text = {
        "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"uri": uri, "byteLength": 168}],
        "bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}]}
    return json.dumps(text).encode(), struct.pack("<24f36H", *points, *corners)


class FilesBeside(FolderTest):
    """Meshes that need others beside them."""

    def text_of(self, name):
        return (self.out / name).read_text()

    def test_libraries_and_pictures_come_along(self):
        write_files(self.source, {
            "sub/a.obj": painted(b"wood.mtl"), "sub/wood.mtl": b"newmtl wood\nmap_Kd pictures/grain.png\n",
            "sub/pictures/grain.png": b"picture"})
        self.run_script(program=MESHREPAIR)
        self.assertEqual(names_in(self.out), {"sub/a.obj", "sub/a.mtl", "sub/pictures/grain.png"})
        self.assertIn("mtllib a.mtl\n", self.text_of("sub/a.obj"))
        self.assertEqual(self.text_of("sub/a.mtl"), "newmtl wood\nmap_Kd pictures/grain.png\n")
        self.assertEqual(self.text_of("sub/pictures/grain.png"), "picture")
        self.run_script("--format", "gltf", program=MESHREPAIR)
        image = json.loads(self.text_of("sub/a.gltf"))["images"][0]
        self.assertEqual(image["uri"], "pictures/grain.png")
        self.run_script("--format", "3mf", program=MESHREPAIR)
        self.assertNotIn("sub/pictures/grain.png", names_in(self.out))

    def test_what_lies_elsewhere_in_the_input_folder_is_found_and_comes_along(self):
        gltf, buffer = cube_as_gltf("../a.bin")
        gltf = json.dumps({**json.loads(gltf), "images": [{"uri": "../../b%20c.png"}]}).encode()
        write_files(self.source, {
            "sub/deep/a.obj": painted(b"../wood.mtl"), "sub/b.obj": painted(b"wood.mtl"),
            "sub/wood.mtl": b"newmtl wood\nmap_Kd ../shared.png\nmap_Bump bump.png\n", "shared.png": b"shared",
            "sub/bump.png": b"bump", "sub/deep/c.gltf": gltf, "sub/a.bin": buffer, "b c.png": b"of c"})
        self.run_script(program=MESHREPAIR)
        pictures = {"shared.png": "shared", "sub/bump.png": "bump", "b c.png": "of c"}
        meshes = {"sub/deep/a.obj", "sub/deep/a.mtl", "sub/b.obj", "sub/b.mtl", "sub/deep/c.gltf"}
        self.assertEqual(names_in(self.out), meshes | pictures.keys())
        for name, text in pictures.items():
            self.assertEqual(self.text_of(name), text)
        self.assertEqual(self.text_of("sub/deep/a.mtl"), "newmtl wood\nmap_Kd ../../shared.png\nmap_Bump ../bump.png\n")
        self.assertEqual(self.text_of("sub/b.mtl"), "newmtl wood\nmap_Kd ../shared.png\nmap_Bump bump.png\n")
        self.assertEqual(json.loads(self.text_of("sub/deep/c.gltf"))["images"][0]["uri"], "../../b%20c.png")
        (self.out / "shared.png").unlink()
        write_files(self.source, {"b c.png": b"another"})
        self.run_script(program=MESHREPAIR)
        self.assertEqual(self.text_of("shared.png") + self.text_of("b c.png"), "sharedanother")
        write_files(self.source, {"sub/deep/a.obj": FLAT, "sub/deep/c.gltf": b"{}"})
        self.run_script(program=MESHREPAIR, code=1)
        self.assertEqual(names_in(self.out), {"sub/b.obj", "sub/b.mtl", "shared.png", "sub/bump.png"})

    def test_what_lies_outside_of_the_input_folder_is_not_touched_but_said(self):
        write_files(self.folder, {"secret.png": b"secret", "secret.mtl": b"newmtl wood\nKd 0.125 0 0\n"})
        write_files(self.source, {
            "a.obj": painted(b"a.mtl"), "a.mtl": b"newmtl wood\nmap_Kd ../secret.png\nbump link.png\n",
            "b.obj": painted(b"../secret.mtl"), "c.obj": painted(b"link.mtl")})
        (self.source / "link.png").symlink_to("../secret.png")
        (self.source / "link.mtl").symlink_to("../secret.mtl")
        result = self.run_script(program=MESHREPAIR)
        self.assertEqual(names_in(self.out), {f"{name}.{end}" for name in "abc" for end in ("obj", "mtl")})
        self.assertIn("c.obj: warning: names link.mtl, outside of IN_DIR", result.stderr)
        self.assertIn("a.obj: warning: names ../secret.png and 1 more, outside of IN_DIR", result.stderr)
        self.assertIn("b.obj: warning: names ../secret.mtl, outside of IN_DIR", result.stderr)
        self.assertNotIn("0.125", self.text_of("b.mtl") + self.text_of("c.mtl"))
        for extension, warnings in (("3mf", 3), ("stl", 0)):
            result = self.run_script("--format", extension, program=MESHREPAIR)
            self.assertEqual(result.stderr.count("outside of IN_DIR"), warnings)

    def test_names_that_are_no_utf8_and_names_of_nothing(self):
        write_files(self.source, {
            "a.obj": painted(b"h\xf6lz.mtl"), b"h\xf6lz.mtl": b"newmtl wood\nmap_Kd w\xe4.png\n", b"w\xe4.png": b"x",
            "b.obj": painted(b"gone.mtl"), "c.obj": painted(b"c.mtl"), "c.mtl": b"newmtl wood\nmap_Kd gone.png\n"})
        result = self.run_script(program=MESHREPAIR)
        self.assertIn(os.fsdecode(b"w\xe4.png"), names_in(self.out))
        self.assertIn("b.obj: warning: names gone.mtl, which is not there", result.stderr)
        self.assertIn("c.obj: warning: names gone.png, which is not there", result.stderr)
        self.assertEqual(result.stderr.count("warning"), 2)
        self.assertIn("3 of 3 files were finished before", self.run_script(program=MESHREPAIR).stderr)

    def test_names_of_pictures_lead_to_nothing_that_is_made_there(self):
        names = (b"b.obj", b"b.mtl", b"summary.json", b".repair_folder/journal.jsonl", b"gone.png", b"folder")
        library = b"newmtl wood\n" + b"".join(b"map_Kd " + name + b"\n" for name in names)
        write_files(self.source, {
            "a.obj": painted(b"a.mtl"), "a.mtl": library, "b.obj": TETRAHEDRON, "b.mtl": b"x",
            "summary.json": b"x", ".repair_folder/journal.jsonl": b"x", "folder/x": b"x"})
        self.run_script(program=MESHREPAIR)
        self.assertEqual(names_in(self.out), {"a.obj", "a.mtl", "b.obj"})
        self.assertEqual(self.codes(), {"a.obj": 0, "b.obj": 0})

    def test_pictures_that_are_not_from_here_stay(self):
        write_files(self.source, {"a.obj": painted(b"a.mtl"), "a.mtl": b"newmtl wood\nmap_Kd a.png\n", "a.png": b"x"})
        write_files(self.out, {"a.png": b"mine"})
        self.run_script(program=MESHREPAIR, code=1)
        self.assertIn("a.png, which it names, is of another", self.rows()["a.obj"]["error"])
        self.assertEqual(names_in(self.out), {"a.png"})
        self.assertEqual(self.text_of("a.png"), "mine")

    def test_pictures_of_archives_come_along(self):
        data = io.BytesIO()
        with zipfile.ZipFile(data, "w") as file:
            file.writestr("a.obj", painted(b"a.mtl"))
            file.writestr("a.mtl", "newmtl wood\nmap_Kd grain.png\n")
            file.writestr("grain.png", "picture")
        write_files(self.source, {"a.zip": data.getvalue()})
        self.run_script(program=MESHREPAIR)
        self.assertEqual(names_in(self.out), {"a.obj", "a.mtl", "a_0.png"})
        self.assertEqual(self.text_of("a.mtl"), "newmtl wood\nmap_Kd a_0.png\n")

    def test_what_is_gone_or_torn_is_made_again_and_what_is_old_goes(self):
        write_files(self.source, {"a.obj": painted(b"a.mtl"), "a.mtl": b"newmtl wood\nKd 1 0 0\n"})
        self.run_script(program=MESHREPAIR)
        made = self.text_of("a.mtl")
        for damage in (lambda path: path.unlink(), lambda path: path.write_text("torn")):
            damage(self.out / "a.mtl")
            self.run_script(program=MESHREPAIR)
            self.assertEqual(self.text_of("a.mtl"), made)
        write_files(self.source, {"a.obj": TETRAHEDRON})
        self.run_script(program=MESHREPAIR)
        self.assertEqual(names_in(self.out), {"a.obj"})
        write_files(self.source, {"a.obj": painted(b"a.mtl")})
        self.run_script(program=MESHREPAIR)
        write_files(self.source, {"a.obj": FLAT})
        self.run_script(program=MESHREPAIR, code=1)
        self.assertEqual(names_in(self.out), set())

    def test_who_names_a_file_that_has_changed_is_done_again(self):
        write_files(self.source, {
            "sub/a.obj": painted(b"wood.mtl"), "sub/wood.mtl": b"newmtl wood\nKd 1 0 0\n",
            "sub/b.obj": painted(b"late.mtl"), "c.obj": painted(b"own.mtl"), "own.mtl": b"newmtl wood\nKd 0 1 0\n"})
        self.run_script(program=MESHREPAIR)

        def finished_before():
            said = re.search(r"(\d+) of 3 files were finished before", self.run_script(program=MESHREPAIR).stderr)
            return int(said[1]) if said else 0

        self.assertEqual(finished_before(), 3)
        write_files(self.source, {"sub/wood.mtl": b"newmtl wood\nKd 0 0 1\n"})
        os.utime(self.source / "sub" / "wood.mtl", (1, 1))
        self.assertEqual(finished_before(), 2)
        self.assertIn("Kd 0 0 1", self.text_of("sub/a.mtl"))
        write_files(self.source, {"sub/late.mtl": b"newmtl wood\nKd 0 1 1\n"})
        self.assertEqual(finished_before(), 2)
        self.assertIn("Kd 0 1 1", self.text_of("sub/b.mtl"))
        (self.source / "own.mtl").unlink()
        self.assertEqual(finished_before(), 2)
        self.assertNotIn("Kd 0 1 0", self.text_of("c.mtl"))
        self.assertEqual(finished_before(), 3)

    def test_a_buffer_that_comes_late_or_changes_counts(self):
        gltf, buffer = cube_as_gltf()
        write_files(self.source, {"a.gltf": gltf})
        self.run_script(program=MESHREPAIR, code=1)
        self.assertEqual(self.codes(), {"a.gltf": 3})
        write_files(self.source, {"a.bin": buffer})
        self.run_script(program=MESHREPAIR)
        small = (self.out / "a.gltf").read_bytes()
        write_files(self.source, {"a.bin": struct.pack("<24f", *(2 * x for x in struct.unpack("<24f", buffer[:96])))
                                  + buffer[96:]})
        self.run_script(program=MESHREPAIR)
        self.assertNotEqual((self.out / "a.gltf").read_bytes(), small)

    def test_a_library_is_of_one_output(self):
        for packed, codes in ((b"newmtl wood\nKd 0 1 0\n", [0, 6]), (b"newmtl wood\nKd 1 0 0\n", [0, 0])):
            write_files(self.source, {
                "a.obj": painted(b"a.mtl"), "a.mtl": b"newmtl wood\nKd 1 0 0\n",
                "a.obj.gz": gzip.compress(painted(b"b.mtl")), "b.mtl": packed})
            self.run_script("--restart", "--jobs", "1", program=MESHREPAIR, code=int(6 in codes))
            self.assertEqual(sorted(self.codes().values()), codes)
            self.assertEqual(self.text_of("a.mtl"), "newmtl wood\nKd 1 0 0\n")
        self.assertEqual(names_in(self.out), {"a.obj", "a.obj.gz", "a.mtl"})

    def test_libraries_of_others_are_not_replaced(self):
        write_files(self.source, {"a.obj": painted(b"a.mtl"), "a.mtl": b"newmtl wood\nKd 1 0 0\n"})
        write_files(self.out, {"a.mtl": b"mine"})
        self.run_script(program=MESHREPAIR, code=1)
        self.assertEqual(self.text_of("a.mtl"), "mine")
        self.assertIn("a.mtl, which it needs beside it, is of another", self.rows()["a.obj"]["error"])


class Folders(FolderTest):
    def test_outputs_never_become_inputs_or_replace_them(self):
        write_files(self.source, {"good.stl": b"x", "sub/good.stl": b"x"})
        for out in (self.source, self.folder, self.source / "sub" / ".."):
            self.assertIn("outputs could replace inputs", self.run_script(out=out, code=2).stderr)
        self.out = self.source / "repaired"
        self.run_script()
        self.run_script()
        self.assertEqual(names_in(self.out), {"good.stl", "sub/good.stl"})

    def test_links_in_the_output_folder_are_not_followed(self):
        write_files(self.source, {"good.stl": b"x", "sub/good.stl": b"x"})
        self.out.mkdir()
        self.run_script(source=self.out, out=self.folder / "other")  # nothing to do
        os.symlink(self.source / "sub", self.out / "sub")
        result = self.run_script(code=2)
        self.assertIn("not from repair_folder.py, 1 of them, such as sub/good.stl", result.stderr)
        os.symlink(self.source / "good.stl", self.out / "good.stl")
        self.run_script("--restart", code=1)
        self.assertEqual(self.codes(), {"good.stl": 0, "sub/good.stl": 6})
        self.assertEqual((self.source / "good.stl").read_bytes(), b"x")
        self.assertEqual((self.source / "sub" / "good.stl").read_bytes(), b"x")
        self.assertFalse((self.out / "good.stl").is_symlink())

    def test_foreign_files_are_not_replaced_unasked(self):
        write_files(self.source, {"good.stl": b"x", "code.stl": b"5"})
        write_files(self.out, {"good.stl": b"mine", "code.stl": b"mine"})
        self.run_script(code=2)
        self.assertEqual((self.out / "good.stl").read_bytes(), b"mine")
        self.run_script("--restart", code=1)
        self.assertEqual(names_in(self.out), {"good.stl"})

    def test_an_empty_folder_is_no_failure(self):
        self.assertIn("no mesh files in", self.run_script().stderr)
        self.assertEqual(self.rows(), {})


class CommandLine(FolderTest):
    def test_workers_get_limits_threads_and_options(self):
        write_files(self.source, {"good.stl": b"x"})
        self.environment["FAKE_HELP"] = "  --max-memory SIZE"
        self.run_script("--jobs", "1", "--timeout", "7", "--max-memory", "2G", "--", "--inside", "solidity")
        call = json.loads(self.log.read_text())
        cores = str(len(os.sched_getaffinity(0)))
        self.assertEqual(call[:11], ["--quiet", "--threads", cores, "--time-limit", "7", "--inside", "solidity",
                                     "--max-memory", "2048M", "--format", "stl"])

    def test_wrong_usage_is_one_line(self):
        for options in (["--frobnicate"], ["--jobs", "0"], ["--jobs", "many"], ["--timeout", "-1"],
                        ["--timeout", "nan"], ["--max-memory", "lots"], ["--format", "xyz"],
                        ["--meshrepair", "/nowhere"], ["--", "--report=x"], ["--", "-q"], ["--", "--root", "/"],
                        ["--", "--staging=x"], ["--", "--bogus"]):
            result = self.run_script(*options, code=2)
            self.assertRegex(result.stderr, "^repair_folder.py: [^\n]+\n$", options)
        self.run_script(source=self.folder / "nowhere", code=2)
        self.run_script(program="/bin/true", code=2)
        self.run_script(out=self.false, code=2)
        self.assertFalse(self.out.exists())

    def test_a_program_that_is_killed_while_it_is_asked_is_not_used(self):
        write_files(self.source, {"good.stl": b"x"})
        self.environment["FAKE_HELP"] = "killed"
        self.assertIn("cannot be asked for --help", self.run_script(code=2).stderr)
        self.assertEqual(self.calls(), [])

    def test_nobody_needs_to_listen(self):
        write_files(self.source, {"good.stl": b"x", "code.stl": b"5"})
        words = " ".join(f"'{word}'" for word in self.command())
        for closing in ("<&- >&- 2>&-", "2>&-", ">/dev/full 2>/dev/full", "2>&1 | true; exit ${PIPESTATUS[0]}"):
            shutil.rmtree(self.out, ignore_errors=True)
            code = subprocess.run(["bash", "-c", f"{words} {closing}"], env=self.environment, check=False,
                                  stdout=subprocess.DEVNULL).returncode
            self.assertEqual(code, 1, closing)
            self.assertEqual(self.codes(), {"good.stl": 0, "code.stl": 5})

    def test_help(self):
        text = self.run_script("--help").stdout
        self.assertRegex(text, "(?s)--timeout SECONDS.*default: 600.*Examples:\n  repair_folder")


def main():
    global MESHREPAIR
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        print(__doc__.strip(), file=sys.stdout if sys.argv[1:] == ["--help"] else sys.stderr)
        sys.exit(0 if sys.argv[1:] == ["--help"] else 2)
    MESHREPAIR = os.path.abspath(sys.argv.pop(1))
    unittest.main()


if __name__ == "__main__":
    main()
