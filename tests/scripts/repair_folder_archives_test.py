#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of scripts/repair_folder.py: archives that stand for a folder, and what is hostile in them.

Usage: repair_folder_archives_test.py MESHREPAIR [OPTIONS OF UNITTEST]
"""

import gzip
import io
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tarfile
import time
import unittest
import zipfile

sys.dont_write_bytecode = True
sys.pycache_prefix = os.devnull

import kill_folder
from repair_folder_beside_test import cube_as_gltf, painted
from repair_folder_case import CUBE, FLAT, SECONDS, TETRAHEDRON, FolderTest, main, names_in, write_files

GLTF, BUFFER = cube_as_gltf("../buffers/a%20b.bin")
LIBRARY = b"newmtl wood\nmap_Kd -s 1 1 1 pictures/my grain.png\n"
# In an order in which each mesh comes before what it names, or behind it.
FILES = {
    "sub/a.obj": painted(b"../m/wood.mtl"), "z.obj.gz": gzip.compress(painted(b"m/wood.mtl")), "m/pictures/my grain.png": b"picture",
    "m/wood.mtl": LIBRARY, "m/b.obj": painted(b"wood.mtl"), "buffers/a b.bin": BUFFER, "y/g.gltf": GLTF, "cube.stl": CUBE,
    "sub/c.stl": CUBE, "bad/empty.stl": b"", "bad/flat.obj": FLAT, "notes.txt": b"no mesh", "m/unused.png": b"unused"}
COMPRESSIONS = {"tar": "w:", "tar.gz": "w:gz", "tar.bz2": "w:bz2", "tar.xz": "w:xz"}


def make_tar(path, files, mode="w:", others=()):
    with tarfile.open(path, mode) as archive:
        for name, data in files.items() if isinstance(files, dict) else files:
            info = tarfile.TarInfo(os.fsdecode(name))
            info.size, info.mtime = len(data), 1_000_000_000
            archive.addfile(info, io.BytesIO(data))
        for info in others:
            archive.addfile(info)


def make_zip(path, files, compression=zipfile.ZIP_DEFLATED):
    with zipfile.ZipFile(path, "w", compression) as archive:
        for name, data in files.items() if isinstance(files, dict) else files:
            archive.writestr(zipfile.ZipInfo(name), data, compression)


def link(name, to, kind=tarfile.SYMTYPE):
    info = tarfile.TarInfo(name)
    info.type, info.linkname = kind, to
    return info


class ArchiveTest(FolderTest):
    def archive(self, ending, files=None, others=()):
        """Becomes IN_DIR."""
        files = FILES if files is None else files
        self.source = self.folder / f"scans.{ending}"
        if ending == "zip":
            make_zip(self.source, files)
        elif ending == "tar.zst":
            make_tar(self.folder / "scans.tar", files, others=others)
            subprocess.run(["zstd", "-qf", self.folder / "scans.tar", "-o", self.source], check=True)
        else:
            make_tar(self.source, files, COMPRESSIONS[ending], others)

    def all_kinds(self):
        return [*COMPRESSIONS, "zip", *(["tar.zst"] if shutil.which("zstd") else [])]

    def of_folder(self, files=None):
        """Summary and files of a run over the same as a folder."""
        folder, out = self.folder / "unpacked", self.folder / "out_of_folder"
        write_files(folder, FILES if files is None else files)
        self.run_script(source=folder, out=out, program=self.meshrepair, code=1)
        return kill_folder.comparable_summary(out), kill_folder.outputs_in(out)

    def left_out(self):
        return {one["path"]: one["why"] for one in json.loads((self.out / "summary.json").read_bytes())["left_out"]}

    def nothing_is_left(self):
        self.assertEqual(os.listdir(self.out / ".repair_folder" / "work"), [])


class Archives(ArchiveTest):
    def test_the_same_as_of_the_folder_it_was_made_of(self):
        summary, files = self.of_folder()
        for ending in self.all_kinds():
            with self.subTest(ending):
                self.out = self.folder / f"out_{ending}"
                self.archive(ending)
                self.run_script("--jobs", "2", program=self.meshrepair, code=1)
                self.assertEqual(kill_folder.comparable_summary(self.out), summary)
                self.assertEqual(kill_folder.outputs_in(self.out), files)
                self.nothing_is_left()
                said = self.run_script(program=self.meshrepair, code=1).stderr
                self.assertIn("8 of 8 files were finished before", said)
                self.assertEqual(kill_folder.comparable_summary(self.out), summary)

    def test_what_was_repaired_is_not_done_again_until_it_has_changed(self):
        for ending in ("zip", "tar", "tar.gz"):
            with self.subTest(ending):
                self.out = self.folder / f"out_{ending}"
                files = {"good1.stl": b"x", "sub/good2.stl": b"x", "code3.stl": b"3", "code4.stl": b"4"}
                self.archive(ending, files)
                self.run_script(code=1)
                self.assertEqual(len(self.calls()), 4)
                self.run_script(code=1)
                self.assertEqual(self.calls(), ["code4.stl"])
                self.archive(ending, {"new/good9.stl": b"x", **files, "good1.stl": b"xy"})
                self.run_script(code=1)
                self.assertEqual(self.calls(), ["code4.stl", "good1.stl", "good9.stl"])
                self.run_script("--restart", code=1)
                self.assertEqual(len(self.calls()), 5)
                self.archive(ending, {"good1.stl": b"xy"})
                self.assertIn("sub/good2.stl in OUT_DIR is of an earlier run", self.run_script().stderr)

    def test_who_names_a_member_that_has_changed_is_done_again(self):
        for ending in ("zip", "tar", "tar.xz"):
            with self.subTest(ending):
                self.out = self.folder / f"out_{ending}"
                self.archive(ending)
                self.run_script(program=self.meshrepair, code=1)
                self.archive(ending, {**FILES, "m/pictures/my grain.png": b"another one"})
                said = self.run_script(program=self.meshrepair, code=1).stderr
                self.assertIn("5 of 8 files were finished before", said)  # three have the picture
                self.assertEqual((self.out / "m/pictures/my grain.png").read_bytes(), b"another one")

    def test_shards_lists_and_the_gallery(self):
        summary, files = self.of_folder()
        for ending in ("zip", "tar.gz"):
            with self.subTest(ending):
                self.out = self.folder / f"out_{ending}"
                self.archive(ending)
                processes = [self.start("--jobs", "1", "--shard", f"{i}/3", program=self.meshrepair) for i in (1, 2, 3)]
                for process in processes:
                    process.communicate(timeout=SECONDS)
                    self.assertIn(process.returncode, (0, 1))
                self.run_script("--merge", program=self.meshrepair, code=1)
                self.assertEqual(kill_folder.comparable_summary(self.out), summary)
                self.assertEqual(kill_folder.outputs_in(self.out), files)
                self.out = self.folder / f"listed_{ending}"
                (self.folder / "list").write_bytes(b"sub/a.obj\nm/../cube.stl\nmissing.stl\nnotes.txt\n")
                self.run_script("--list", self.folder / "list", "--html", program=self.meshrepair, code=1)
                self.assertEqual(self.codes(), {"sub/a.obj": 0, "cube.stl": 0, "missing.stl": 3})
                self.assertEqual(self.left_out(), {"notes.txt": "has not the name of a mesh"})
                self.assertTrue((self.out / "index.files/sub/a.obj.html").exists())
                (self.folder / "list").write_bytes(b"../x.stl\n")
                self.assertIn("is not in", self.run_script("--list", self.folder / "list", code=2).stderr)

    def test_formats_and_packed_meshes_and_archives_in_it(self):
        inner = io.BytesIO()
        make_zip(inner, {"d/inner.obj": TETRAHEDRON})
        two = io.BytesIO()
        make_zip(two, {"a.stl": CUBE, "b.stl": CUBE})
        for ending in ("zip", "tar", "tar.gz"):
            with self.subTest(ending):
                self.out = self.folder / f"out_{ending}"
                self.archive(ending, {"a.stl": CUBE, "a.obj": TETRAHEDRON, "c.zip": inner.getvalue(), "two.zip": two.getvalue(),
                                      "p.stl.gz": gzip.compress(CUBE), "cut.zip": inner.getvalue()[:-9]})
                self.run_script(program=self.meshrepair)
                self.assertEqual(names_in(self.out), {"a.stl", "a.obj", "c.obj", "p.stl.gz"})
                self.assertEqual(set(self.left_out()), {"two.zip", "cut.zip"})
                self.run_script("--format", "ply", "--restart", program=self.meshrepair)
                self.assertLessEqual({"a.stl.ply", "a.obj.ply", "c.ply", "p.ply"}, names_in(self.out))

    @unittest.skipUnless(shutil.which("zstd"), "there is no zstd")
    def test_what_only_the_report_names_is_unpacked_then(self):
        packed = subprocess.run(["zstd", "-qc"], input=painted(b"m/wood.mtl"), check=True, capture_output=True).stdout
        self.environment["PATH"] = os.path.dirname(sys.executable)  # no program zstd, as on other machines
        for ending in ("zip", "tar", "tar.gz"):
            with self.subTest(ending):
                self.out = self.folder / f"out_{ending}"
                self.archive(ending, {"a.obj.zst": packed, "m/wood.mtl": LIBRARY, "m/pictures/my grain.png": b"picture"})
                self.assertNotIn("warning", self.run_script(program=self.meshrepair).stderr)
                self.assertEqual(names_in(self.out), {"a.obj.zst", "a.mtl", "m/pictures/my grain.png"})

    def test_archives_in_a_folder_are_named(self):
        write_files(self.source, {"good.stl": b"x"})
        make_zip(self.source / "two.zip", {"a.stl": CUBE, "b.stl": CUBE})
        make_tar(self.source / "scans.tgz", {"a.stl": CUBE}, "w:gz")
        said = self.run_script().stderr
        self.assertIn("two.zip: left out: holds several meshes: repair it by itself, as IN_DIR", said)
        self.assertIn("scans.tgz: left out: is an archive: repair it by itself, as IN_DIR", said)


class EndingEarly(ArchiveTest):
    def test_killed_and_resumed_gives_what_an_undisturbed_run_gives(self):
        summary, files = self.of_folder()
        for ending in ("zip", "tar.gz"):
            self.archive(ending)
            killer = kill_folder.Killer(self.meshrepair, self.source, self.folder / ending, seed=2)
            killer.run(4)
            self.assertEqual(killer.complaints, [])
            self.assertEqual((killer.summary, killer.outputs), (summary, files))

    def test_an_interrupted_run_leaves_nothing_unpacked(self):
        self.archive("tar.gz", {"a/good.stl": b"x", "hang1.stl": b"x", "hang2.stl": b"x"})
        process = self.start("--jobs", "2")
        self.wait_for_calls(3, process)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=SECONDS)
        self.assertEqual(process.returncode, 130)
        self.assertEqual(self.codes(), {"a/good.stl": 0})
        self.nothing_is_left()

    def test_what_a_killed_run_has_unpacked_goes_with_the_next(self):
        self.archive("zip", {"hang.stl": b"x"})
        process = self.start()
        self.wait_for_calls(1, process)
        process.kill()
        process.communicate()
        self.assertEqual(list((self.out / ".repair_folder/work").rglob("*.stl")), [self.out / ".repair_folder/work/1.in/hang.stl"])
        self.archive("zip", {"good.stl": b"x"})
        self.run_script()
        self.nothing_is_left()

    def test_only_what_is_at_work_is_unpacked(self):
        for ending in ("zip", "tar.gz"):
            self.out = self.folder / f"out_{ending}"
            self.archive(ending, {f"slow{i}.stl": b"x" * 100_000 for i in range(20)})
            process = self.start("--jobs", "2")
            self.wait_for_calls(2, process)
            there = list((self.out / ".repair_folder/work").rglob("slow*.stl"))
            self.let_slow_ones_end()
            process.communicate(timeout=SECONDS)
            self.assertEqual(len(there), 2)
            pathlib.Path(f"{self.log}.go").unlink()
            self.log.unlink()

    def test_an_archive_that_changes_meanwhile_is_not_believed(self):
        self.archive("tar", {"slow.stl": b"x", "t/good.stl": b"x"})
        process = self.start("--jobs", "1")
        self.wait_for_calls(1, process)
        with open(self.source, "ab") as file:
            file.write(b"more")
        self.let_slow_ones_end()
        process.communicate(timeout=SECONDS)
        self.assertEqual(process.returncode, 1)
        self.assertIn("has changed", self.rows()["t/good.stl"]["error"])

    def test_killed_workers_are_tried_again_in_a_stream(self):
        self.archive("tar.gz", {"half.stl": b"x", "good.stl": b"x", "good2.stl": b"x"})
        self.run_script("--jobs", "1", code=1)
        self.assertEqual(self.codes(), {"half.stl": 137, "good.stl": 0, "good2.stl": 0})
        self.assertEqual(self.calls().count("half.stl"), 2)
        self.nothing_is_left()


class HostileArchives(ArchiveTest):
    def all_in(self):
        """Names of all files below the folder of this test, but for OUT_DIR."""
        return {str(path.relative_to(self.folder)) for path in self.folder.rglob("*") if self.out not in path.parents}

    def test_nothing_leads_out_of_it(self):
        for ending in ("zip", "tar", "tar.gz"):
            with self.subTest(ending):
                self.out = self.folder / f"out_{ending}"
                self.archive(ending, [("../up.stl", CUBE), ("/tmp/abs.stl", CUBE), ("a/../../b.stl", CUBE), ("good.stl", CUBE),
                                      ("a.obj", painted(b"../../../../etc/passwd")), ("./dot//c.stl", CUBE),
                                      (".repair_folder/journal.stl", CUBE), ("__MACOSX/._good.stl", b"x"), ("._good.stl", b"x")])
                before = self.all_in()
                result = self.run_script(program=self.meshrepair, code=1)
                self.assertEqual(self.all_in() - before, {self.out.name})
                self.assertEqual(set(self.codes()), {"good.stl", "a.obj", "dot/c.stl"})
                self.assertEqual(set(self.left_out()), {"../up.stl", "/tmp/abs.stl", "a/../../b.stl"})
                self.assertIn("../up.stl: left out: its name leads out of the archive\n", result.stderr)

    def test_links_and_devices(self):
        (self.folder / "secret.stl").write_bytes(CUBE)
        fifo = tarfile.TarInfo("fifo.stl")
        fifo.type = tarfile.FIFOTYPE
        device = tarfile.TarInfo("device.stl")
        device.type, device.devmajor, device.devminor = tarfile.CHRTYPE, 1, 5
        links = [link("sub/hard.stl", "good.stl", tarfile.LNKTYPE), link("sub/soft.stl", "../good.stl"), link("out.stl", "../secret.stl"),
                 link("abs.stl", str(self.folder / "secret.stl")), link("round.stl", "round.stl"), link("dir", ".."), fifo, device]
        for ending in ("tar", "tar.gz"):
            with self.subTest(ending):
                self.out = self.folder / f"out_{ending}"
                self.archive(ending, {"good.stl": CUBE, "dir/secret.stl": CUBE}, links)
                self.run_script(program=self.meshrepair)
                self.assertEqual(set(self.codes()), {"good.stl", "dir/secret.stl", "sub/hard.stl", "sub/soft.stl"})
                self.assertEqual(self.left_out(), {
                    "fifo.stl": "is no regular file", "device.stl": "is no regular file",
                    **dict.fromkeys(("out.stl", "abs.stl", "round.stl"), "is a link to no file in the archive")})

    def test_of_one_name_the_last_counts(self):
        for ending in ("zip", "tar", "tar.gz"):
            with self.subTest(ending):
                self.out = self.folder / f"out_{ending}"
                with unittest.mock.patch("warnings.warn"):
                    self.archive(ending, [("code.stl", b"5"), ("good.stl", b"x"), ("./code.stl", b"1")])
                self.run_script(code=1)
                self.assertEqual(self.codes(), {"code.stl": 1, "good.stl": 0})

    def test_odd_names(self):
        odd = [b"-x.stl", b"a b.stl", b"new\nline.stl", b"caf\xe9.stl", "\u00e9\u4e2d.StL".encode(), b"long" * 60 + b".stl"]
        for ending in ("tar", "tar.gz"):
            self.out = self.folder / f"out_{ending}"
            self.archive(ending, dict.fromkeys(odd, TETRAHEDRON))
            self.run_script(program=self.meshrepair)
            self.assertEqual(set(kill_folder.outputs_in(self.out)), set(odd))
            self.assertIn("6 of 6 files were finished", self.run_script(program=self.meshrepair).stderr)
        self.archive("tar", {"n" * 300 + ".stl": CUBE, "good.stl": CUBE})
        self.out = self.folder / "out_long"
        self.run_script(program=self.meshrepair, code=1)
        self.assertEqual(sorted(self.codes().values()), [0, 6])

    def test_names_in_a_zip_that_are_not_marked_as_utf8(self):
        make_zip(self.folder / "scans.zip", {"cafX.stl": CUBE, "d\\e.stl": CUBE})
        data = (self.folder / "scans.zip").read_bytes().replace(b"cafX", b"caf\x82")
        self.source = self.folder / "scans.zip"
        for system, names in ((3, {b"caf\x82.stl", b"d\\e.stl"}), (0, {"caf\u00e9.stl".encode(), b"d/e.stl"})):
            at, changed = 0, bytearray(data)
            while (at := changed.find(b"PK\1\2", at)) >= 0:
                changed[at + 5] = system
                at += 4
            self.source.write_bytes(changed)
            self.out = self.folder / f"out_{system}"
            self.run_script(program=self.meshrepair)
            self.assertEqual(set(kill_folder.outputs_in(self.out)), names)

    def test_cut_archives(self):
        chance = random.Random(3)
        files = {f"good{i}.stl": chance.randbytes(50_000) for i in range(8)}
        for ending in self.all_kinds():
            with self.subTest(ending):
                self.out = self.folder / f"out_{ending}"
                self.archive(ending, files)
                whole = self.source.read_bytes()
                self.source.write_bytes(whole[:len(whole) * 6 // 10])
                if ending in ("zip", "tar.bz2"):  # at the end of a ZIP is what is in it; bzip2 has large blocks
                    result = self.run_script(code=None)
                    self.assertIn(result.returncode, (1, 3))
                else:
                    result = self.run_script(code=1)
                    self.assertGreaterEqual(len(self.codes()), 2)
                    self.assertLess(len(self.codes()), 8)
                self.assertEqual(len([line for line in result.stderr.splitlines() if "scans." in line]), 1, result.stderr)
                self.source.write_bytes(whole)
                self.run_script()
                self.assertEqual(len(self.codes()), 8)

    def run_script(self, *options, code=0, **others):
        if code is not None:
            return super().run_script(*options, code=code, **others)
        return subprocess.run(self.command(*options, **others), env=self.environment, text=True, check=False, capture_output=True,
                              timeout=SECONDS)

    def test_damage_at_random_is_no_traceback_and_no_file_elsewhere(self):
        chance = random.Random(4)
        for ending in self.all_kinds():
            self.archive(ending, {f"sub/good{i}.stl": chance.randbytes(700) for i in range(5)})
            whole = self.source.read_bytes()
            for trial in range(4):
                self.out = self.folder / f"out_{ending}_{trial}"
                data = bytearray(whole)
                for _ in range(1 + trial * 3):
                    data[chance.randrange(len(data))] = chance.randrange(256)
                self.source.write_bytes(data)
                before = self.all_in()
                result = self.run_script("-q", code=None)
                self.assertIn(result.returncode, (0, 1, 2, 3), result.stderr)
                self.assertNotIn("Traceback", result.stderr)
                self.assertLessEqual(self.all_in() - before, {self.out.name, "log"})

    def test_no_archive_and_none_that_can_be_read(self):
        self.source = self.folder / "scans.zip"
        for data, code in ((b"PK\3\4 no more", 3), (b"\x1f\x8bno gzip", 3), (gzip.compress(b"no tar" * 200), 3), (b"text", 2), (b"", 2)):
            self.source.write_bytes(data)
            result = self.run_script(code=code)
            self.assertRegex(result.stderr, r"^repair_folder.py: [^\n]*scans.zip[^\n]*\n$")
            self.assertFalse(self.out.exists())
        make_zip(self.source, {"a.stl": CUBE})
        self.assertIn("outputs could replace inputs", self.run_script(out=self.folder, code=2).stderr)

    def test_a_member_that_is_broken_or_encrypted_is_a_row(self):
        make_zip(self.folder / "scans.zip", {"good.stl": b"x" * 999, "good2.stl": b"y" * 999}, zipfile.ZIP_STORED)
        data = bytearray((self.folder / "scans.zip").read_bytes())
        data[data.find(b"yyyy")] = 0
        self.source = self.folder / "scans.zip"
        self.source.write_bytes(data)
        self.run_script(code=1)
        self.assertEqual(self.codes(), {"good.stl": 0, "good2.stl": 3})
        self.assertIn("cannot be unpacked: Bad CRC", self.rows()["good2.stl"]["error"])
        for at in (data.find(b"PK\3\4") + 6, data.find(b"PK\1\2") + 8):
            data[at] |= 1
        self.source.write_bytes(data)
        self.run_script("--restart", code=1)
        self.assertIn("is encrypted", self.rows()["good.stl"]["error"])
        self.nothing_is_left()

    def test_huge_sizes_and_headers(self):
        make_zip(self.folder / "scans.zip", {"good.stl": b"x", "huge.stl": b"x"}, zipfile.ZIP_STORED)
        data = bytearray((self.folder / "scans.zip").read_bytes())
        at = data.find(b"PK\1\2", data.find(b"PK\1\2") + 4)
        data[at + 20:at + 28] = b"\xfe\xff\xff\xff" * 2
        self.source = self.folder / "scans.zip"
        self.source.write_bytes(data)
        self.run_script(code=1)
        self.assertEqual(self.codes()["good.stl"], 0)
        self.assertIn(self.codes()["huge.stl"], (3, 4))
        info = tarfile.TarInfo("huge.stl")
        info.size = 1 << 60
        self.source = self.folder / "scans.tar"
        make_tar(self.source, {"good.stl": b"x"})
        whole = self.source.read_bytes()
        self.source.write_bytes(whole[:1024] + info.tobuf() + bytes(4096))
        self.out = self.folder / "out_tar"
        self.run_script(code=1)
        self.assertEqual(self.codes()["good.stl"], 0)
        for kind, size in ((tarfile.XHDTYPE, 1 << 40), (tarfile.GNUTYPE_LONGNAME, 1 << 40), (tarfile.REGTYPE, -1024)):
            info = tarfile.TarInfo("x.stl")
            info.type, info.size = kind, size
            header = info.tobuf(tarfile.GNU_FORMAT)
            for ending, pack in (("tar", bytes), ("tar.gz", gzip.compress)):
                self.source = self.folder / f"scans.{ending}"
                self.source.write_bytes(pack(whole[:1024] + header + bytes(1 << 20)))
                result = self.run_script("--restart", code=1)
                self.assertEqual(self.codes(), {"good.stl": 0})
                self.assertIn(f"scans.{ending}: left out: broken or cut off", result.stderr)

    def test_a_bomb_does_not_outlast_the_time_limit(self):
        with zipfile.ZipFile(self.folder / "scans.zip", "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("good.stl", b"x")
            with archive.open("bomb.stl", "w", force_zip64=True) as file:
                for _ in range(600):
                    file.write(bytes(1 << 20))
        self.source = self.folder / "scans.zip"
        self.run_script("--timeout", "0.05", "--grace", "600", code=1)
        self.assertEqual(self.codes()["bomb.stl"], 4)
        self.assertIn("is not unpacked at the time limit", self.rows()["bomb.stl"]["error"])
        self.nothing_is_left()


if __name__ == "__main__":
    import unittest.mock
    main(__doc__)
