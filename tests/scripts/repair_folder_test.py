#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of scripts/repair_folder.py: what comes out, and which files it takes and makes.

What it makes of meshes is tested with the program MESHREPAIR.

Usage: repair_folder_test.py MESHREPAIR [OPTIONS OF UNITTEST]
"""

import gzip
import io
import json
import os
import shutil
import stat
import subprocess
import sys
import unittest
import zipfile

sys.dont_write_bytecode = True  # a copy that is cut on a full disk would end all later tests
sys.pycache_prefix = os.devnull

import kill_folder
from repair_folder_case import CUBE, FLAT, SAMPLES, SECONDS, TETRAHEDRON, FolderTest, main, names_in, write_files


class Meshes(FolderTest):
    def make(self):
        write_files(self.source, {
            "cube.stl": CUBE, "sub/Tetrahedron.OBJ": TETRAHEDRON, "sub/deep/cube.stl": CUBE,
            "bad/cut.ply": b"ply\nformat binary", "bad/empty.stl": b"", "bad/flat.obj": FLAT,
            "readme.txt": b"no mesh"})

    def test_keeps_names_and_sub_folders_and_failures_stop_nothing(self):
        self.make()
        result = self.run_script(program=self.meshrepair, code=1)
        self.assertEqual(names_in(self.out), {"cube.stl", "sub/Tetrahedron.OBJ", "sub/deep/cube.stl"})
        self.assertEqual(self.codes(), {
            "bad/cut.ply": 3, "bad/empty.stl": 3, "bad/flat.obj": 5, "cube.stl": 0,
            "sub/Tetrahedron.OBJ": 0, "sub/deep/cube.stl": 0})
        self.assertIn("bad/empty.stl: is empty (exit code 3)\n", result.stderr)
        self.assertRegex(result.stdout, r"\n +3 +2  cannot be read\n")

    def test_rows_are_sorted_and_say_what_came_out(self):
        self.make()
        self.run_script(program=self.meshrepair, code=1)
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
        killer = kill_folder.Killer(self.meshrepair, self.source, self.folder, seed=1)
        killer.run(6)
        self.assertEqual(killer.complaints, [])
        self.assertEqual(len(killer.outputs), 9)

    def test_format_and_options_reach_the_program(self):
        write_files(self.source, {"a.obj": TETRAHEDRON})
        self.run_script("--format", "ply-ascii", "--", "--sources", program=self.meshrepair)
        self.assertIn(b"format ascii", (self.out / "a.ply").read_bytes())
        self.assertIn(b"source_triangle", (self.out / "a.ply").read_bytes())
        result = self.run_script("--", "--inside", "magic", program=self.meshrepair, code=2)
        self.assertIn("refuses the options: --inside: magic", result.stderr)


    def test_a_scene_is_certified_mesh_by_mesh_and_warnings_and_requirements_stand_in_the_table(self):
        write_files(self.source, {"scene.obj": b"o one\n" + TETRAHEDRON, "odd.obj": TETRAHEDRON + b"f 1 2 99\n"})
        self.run_script("--", "--scene", "each", program=self.meshrepair)
        self.assertEqual(self.codes(), {"odd.obj": 0, "scene.obj": 0})
        self.assertEqual(self.rows()["odd.obj"]["warnings"], "W-FACES-UNREADABLE")
        self.assertEqual(self.rows()["scene.obj"]["warnings"], "")
        self.run_script("--", "--scene", "each", "--require", "warnings=0", program=self.meshrepair, code=1)
        self.assertEqual(self.codes(), {"odd.obj": 1, "scene.obj": 0})
        self.assertIn("warnings=0 is not met: 1", self.rows()["odd.obj"]["error"])


class Names(FolderTest):
    def test_odd_names(self):
        odd = [b"-x.stl", b"a b.stl", b"new\nline.stl", b"caf\xe9.stl", "\u00e9\u4e2d.StL".encode(),
               b"q\"uote,.obj", b"sub\n/--help.stl", b"%s{0}.off", b".hidden.stl", b"back\\slash.ply",
               b"long" * 60 + b".stl"]
        write_files(self.source, {name: TETRAHEDRON for name in odd})
        self.run_script(program=self.meshrepair)
        self.assertEqual(set(kill_folder.outputs_in(self.out)), set(odd))
        self.assertEqual(set(self.rows()), {name.decode("utf-8", "backslashreplace") for name in odd})
        before = self.rows()
        self.run_script(program=self.meshrepair)
        self.assertEqual(self.rows(), before)  # with the same times: nothing was done again

    def test_no_two_names_are_one_text(self):
        names = [b"a\xff.stl", b"a\\xff.stl", b"a\\x5cxff.stl"]
        write_files(self.source, {name: TETRAHEDRON for name in names})
        self.run_script(program=self.meshrepair)
        self.assertEqual(set(self.rows()), {"a\\xff.stl", "a\\x5cxff.stl", "a\\x5cx5cxff.stl"})

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

    def test_what_would_lie_where_the_script_writes_is_left_out_and_no_success(self):
        write_files(self.source, {"summary.csv/good1.stl": b"", "summary.json/sub/good2.stl": b"", "index.html/good3.stl": b"",
                                  "sub/summary.csv/good4.stl": b"", "good5.stl": b""})
        result = self.run_script(code=1)
        for name in ("summary.csv/good1.stl", "summary.json/sub/good2.stl", "index.html/good3.stl"):
            first = name.split("/", maxsplit=1)[0]
            self.assertIn(f"{name}: left out: {first} in OUT_DIR is made by repair_folder.py: rename its folder", result.stderr)
        self.assertEqual(self.rows().keys(), {"sub/summary.csv/good4.stl", "good5.stl"})
        self.assertEqual(names_in(self.out), {"sub/summary.csv/good4.stl", "good5.stl"})

    def test_a_folder_where_the_summary_goes_is_named(self):
        write_files(self.source, {"good1.stl": b""})
        write_files(self.out, {"summary.csv/mine.txt": b"mine"})
        self.assertIn(f"{self.out}/summary.csv: cannot be written: Is a directory", self.run_script(code=6).stderr)
        self.assertEqual((self.out / "summary.csv/mine.txt").read_bytes(), b"mine")

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
        self.run_script("--format", "obj", program=self.meshrepair)
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
        result = self.run_script(program=self.meshrepair)
        self.assertEqual({path: row["output"] for path, row in self.rows().items()}, {
            "a.obj.gz": "a.obj.gz", "B.OBJ.GZ": "B.OBJ.GZ", "c.zip": "c.obj", "e.zip": "e.zip.obj.obj",
            "e.obj": "e.obj", "e.zip.obj": "e.zip.obj"})
        self.assertTrue(gzip.decompress((self.out / "a.obj.gz").read_bytes()).startswith(b"v "))
        self.assertTrue((self.out / "c.obj").read_bytes().startswith(b"v "))
        self.assertIn("two.zip: left out: holds several meshes", result.stderr)
        self.assertIn("cut.zip: left out: is no ZIP archive that can be read", result.stderr)
        self.assertNotIn("none.zip", result.stderr)
        self.run_script("--format", "stl", "--restart", program=self.meshrepair)
        self.assertEqual({path: row["output"] for path, row in self.rows().items()}, {
            "a.obj.gz": "a.stl", "B.OBJ.GZ": "B.stl", "c.zip": "c.stl", "e.zip": "e.zip.stl",
            "e.obj": "e.obj.stl", "e.zip.obj": "e.zip.obj.stl"})


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
        self.run_script("--jobs", "1", "--timeout", "7", "--max-memory", "2G", "--", "--inside", "solidity")
        call = json.loads(self.log.read_text())
        cores = str(len(os.sched_getaffinity(0)))
        self.assertEqual(call[:13], ["--quiet", "--threads", cores, "--time-limit", "7", "--max-memory", "2048M",
                                     "--inside", "solidity", "--root", str(self.source), "--format", "stl"])

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
        self.environment["KILLED"] = "1"
        self.assertIn("cannot be asked for --version", self.run_script(code=2).stderr)
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


if __name__ == "__main__":
    main(__doc__)
