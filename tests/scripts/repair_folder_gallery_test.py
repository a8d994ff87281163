#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of scripts/repair_folder.py --html: the gallery, its pictures and pages.

Usage: repair_folder_gallery_test.py MESHREPAIR [OPTIONS OF UNITTEST]
"""

import base64
import hashlib
import html.parser
import json
import os
import re
import struct
import sys
import urllib.parse

sys.dont_write_bytecode = True
sys.pycache_prefix = os.devnull

from repair_folder_case import CUBE, FLAT, ROOT, TETRAHEDRON, FolderTest, main, names_in, write_files

HOSTILE = "</script><img src=x onerror=alert(1)>&'\".stl"
BYTES = b"\xff\xfe.stl"  # no UTF-8
INSIDE_OUT = TETRAHEDRON.replace(b"f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n", b"f 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n")


class Elements(html.parser.HTMLParser):
    """The scripts and styles of a page, its policy, and the names of all its elements."""

    def __init__(self, page):
        super().__init__()
        self.names, self.texts, self.policy, self.inside = [], {}, "", ""
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        self.names.append(tag)
        attributes = dict(attrs)
        if attributes.get("http-equiv") == "Content-Security-Policy":
            self.policy = attributes["content"]
        self.inside = attributes.get("id", tag) if tag in ("script", "style") else ""

    def handle_endtag(self, tag):
        self.inside = ""

    def handle_data(self, data):
        if self.inside:
            self.texts[self.inside] = self.texts.get(self.inside, "") + data


class Gallery(FolderTest):
    def setUp(self):
        super().setUp()
        self.index, self.pages = self.out / "index.html", self.out / "index.files"

    def repair(self, *options, code=0):
        return self.run_script("--html", *options, program=self.meshrepair, code=code)

    def elements(self):
        return Elements(self.index.read_text(encoding="utf-8"))

    def shown(self):
        """Rows of the gallery: path -> {column: value}."""
        facts = json.loads(self.elements().texts["facts"])
        return {row[0]: dict(zip(facts["columns"], row)) for row in facts["rows"]}

    def test_rows_are_those_of_the_summary(self):
        write_files(self.source, {"cube.stl": CUBE, "sub/tetra.obj": TETRAHEDRON, "flat.obj": FLAT, "bad.stl": b"solid x\n"})
        self.repair(code=1)
        shown, rows = self.shown(), self.rows()
        self.assertEqual(shown.keys(), rows.keys())
        for path, row in rows.items():
            for column in ("exit_code", "triangles_in", "triangles_out", "bytes_out", "error", "output"):
                self.assertEqual(str(shown[path][column] if shown[path][column] is not None else ""), row[column], path)
        self.assertEqual({path for path, row in shown.items() if row["page"] and row["picture"]},
                         {"cube.stl", "sub/tetra.obj", "flat.obj"})
        self.assertEqual(names_in(self.out) - {"index.html"}, {
            "cube.stl", "sub/tetra.obj", *(f"index.files/{name}.{ending}" for name in ("cube.stl", "sub/tetra.obj", "flat.obj")
                                           for ending in ("html", "png"))})

    def test_pictures_have_the_size_that_the_gallery_says(self):
        write_files(self.source, {"cube.stl": CUBE})
        self.repair()
        head = (self.pages / "cube.stl.png").read_bytes()[:24]
        size = json.loads(self.elements().texts["facts"])["picture"]
        self.assertEqual(list(struct.unpack(">2I", head[16:])), size)
        self.repair("--restart", "--", "--picture-size", "40x30")
        self.assertLess(struct.unpack(">2I", (self.pages / "cube.stl.png").read_bytes()[16:24]), tuple(size))

    def test_volumes(self):
        write_files(self.source, {"a.obj": TETRAHEDRON, "b.obj": INSIDE_OUT, "open.obj": TETRAHEDRON.replace(b"f 1 4 3\n", b"")})
        self.repair()
        volumes = {path: (row["volume_in"], row["volume_out"]) for path, row in self.shown().items()}
        self.assertEqual(volumes["a.obj"], (1 / 6, 1 / 6))
        self.assertEqual(volumes["b.obj"], (-1 / 6, 1 / 6))
        self.assertIsNone(volumes["open.obj"][0])
        self.assertAlmostEqual(volumes["open.obj"][1], 1 / 6)

    def test_names_are_text(self):
        files = {HOSTILE.replace("/", "_"): CUBE, BYTES: CUBE, "javascript:alert(1).stl": CUBE, "a b#c?d%41.stl": CUBE, "n" * 251 + ".stl": CUBE}
        write_files(self.source, files)
        self.repair()
        elements = self.elements()
        plain = Elements((ROOT / "scripts/folder_repair/gallery/gallery.html").read_text())
        self.assertEqual(elements.names, plain.names)
        for name, text in (("script", elements.texts["script"]), ("style", elements.texts["style"])):
            digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
            self.assertIn(f"{name}-src 'sha256-{digest}'", elements.policy)
        for path, row in self.shown().items():
            self.assertTrue(row["page"], path)
            for ending in (".html", ".png"):
                url = (row["url"] or row["path"]) + ending
                self.assertRegex(url, r"^[\w.~%-]+$")
                self.assertTrue(os.path.isfile(os.path.join(os.fsencode(self.pages), urllib.parse.unquote_to_bytes(url))), url)

    def test_pictures_at_its_place_do_not_come_along_which_is_said(self):
        lines = b"vt 0 0\nvt 1 0\nvt 0 1\nusemtl wood\nf 1/1 3/3 2/2\nf 1/1 2/2 4/3\nf 2/1 3/2 4/3\nf 1/1 4/2 3/3\n"
        write_files(self.source, {
            "m.stl": CUBE, "index.files/t.obj": b"mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n" + lines,
            "index.files/t.mtl": b"newmtl wood\nmap_Kd m.stl.png\n", "index.files/m.stl.png": b"another picture"})
        warning = "index.files/t.obj: warning: names m.stl.png, whose place in OUT_DIR is kept for what is made there"
        self.assertIn(warning, self.repair().stderr)
        self.assertNotEqual((self.out / "index.files/m.stl.png").read_bytes(), b"another picture")
        self.assertIn(warning, self.run_script("--restart", program=self.meshrepair).stderr)

    def test_the_second_run_does_nothing(self):
        write_files(self.source, {"a.stl": CUBE, "b.obj": TETRAHEDRON})
        self.repair()
        pages = {name: os.stat(self.pages / name).st_mtime_ns for name in os.listdir(self.pages)}
        rows = self.shown()
        self.assertIn("2 of 2 files were finished before", self.repair().stderr)
        self.assertEqual({name: os.stat(self.pages / name).st_mtime_ns for name in os.listdir(self.pages)}, pages)
        self.assertEqual(self.shown(), rows)
        (self.pages / "a.stl.html").unlink()
        self.assertIn("1 of 2 files were finished before", self.repair().stderr)
        self.assertTrue((self.pages / "a.stl.html").exists())

    def test_pages_go_with_their_mesh(self):
        write_files(self.source, {"a.stl": CUBE, "b.obj": TETRAHEDRON})
        self.repair()
        write_files(self.source, {"b.obj": b"v 1 2 3\n"})
        self.repair(code=1)
        self.assertEqual(set(os.listdir(self.pages)), {"a.stl.html", "a.stl.png"})
        self.assertFalse(self.shown()["b.obj"]["page"])

    def test_without_it_there_is_none(self):
        write_files(self.source, {"a.stl": CUBE})
        self.repair()
        self.run_script(program=self.meshrepair)
        self.assertEqual(names_in(self.out), {"a.stl"})

    def test_files_of_others_stay(self):
        write_files(self.source, {"a.stl": CUBE})
        for name in ("index.html", "index.files/mine.txt"):
            write_files(self.out, {name: b"mine"})
            result = self.repair(code=2)
            self.assertIn("holds files that would be replaced", result.stderr)
            self.assertEqual((self.out / name).read_bytes(), b"mine")
            self.run_script(program=self.meshrepair, out=self.folder / name.replace("/", "_"))
            (self.out / name).unlink()
        write_files(self.out, {"index.html": b"mine"})
        self.run_script(program=self.meshrepair)
        self.assertEqual(self.index.read_bytes(), b"mine")

    def test_page_and_mesh_are_those_of_the_program(self):
        write_files(self.source, {"a.obj": INSIDE_OUT})
        self.repair()
        with_pages = (self.out / "a.obj").read_bytes()
        self.run_script("--restart", program=self.meshrepair)
        self.assertEqual((self.out / "a.obj").read_bytes(), with_pages)

    def test_options_of_its_own_are_refused(self):
        for option in ("--html=x.html", "--picture=x.png"):
            self.assertIn("sets this itself", self.run_script("--", option, program=self.meshrepair, code=2).stderr)

    def test_what_is_done_is_shown_after_an_interruption(self):
        write_files(self.source, {"good1.stl": b"", "slow1.stl": b""})
        process = self.start("--html", "--jobs", "1")
        self.wait_for_calls(2, process)
        process.terminate()
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 143)
        self.assertEqual(self.shown().keys(), {"good1.stl"})
        self.assertRegex(self.elements().texts["facts"], re.escape("1 of 2 repaired and certified, 1 not done"))


if __name__ == "__main__":
    main(__doc__)
