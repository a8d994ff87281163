#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of scripts/repair_folder.py: files beside the meshes, as libraries, pictures and buffers.

Usage: repair_folder_beside_test.py MESHREPAIR [OPTIONS OF UNITTEST]
"""

import gzip
import io
import json
import os
import re
import struct
import sys
import zipfile

sys.dont_write_bytecode = True  # a copy that is cut on a full disk would end all later tests
sys.pycache_prefix = os.devnull

from repair_folder_case import FLAT, TETRAHEDRON, FolderTest, main, names_in, write_files


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
        self.run_script(program=self.meshrepair)
        self.assertEqual(names_in(self.out), {"sub/a.obj", "sub/a.mtl", "sub/pictures/grain.png"})
        self.assertIn("mtllib a.mtl\n", self.text_of("sub/a.obj"))
        self.assertEqual(self.text_of("sub/a.mtl"), "newmtl wood\nmap_Kd pictures/grain.png\n")
        self.assertEqual(self.text_of("sub/pictures/grain.png"), "picture")
        self.run_script("--format", "gltf", program=self.meshrepair)
        image = json.loads(self.text_of("sub/a.gltf"))["images"][0]
        self.assertEqual(image["uri"], "pictures/grain.png")
        self.run_script("--format", "3mf", program=self.meshrepair)
        self.assertNotIn("sub/pictures/grain.png", names_in(self.out))

    def test_what_lies_elsewhere_in_the_input_folder_is_found_and_comes_along(self):
        gltf, buffer = cube_as_gltf("../a.bin")
        gltf = json.dumps({**json.loads(gltf), "images": [{"uri": "../../b%20c.png"}]}).encode()
        write_files(self.source, {
            "sub/deep/a.obj": painted(b"../wood.mtl"), "sub/b.obj": painted(b"wood.mtl"),
            "sub/wood.mtl": b"newmtl wood\nmap_Kd ../shared.png\nmap_Bump bump.png\n", "shared.png": b"shared",
            "sub/bump.png": b"bump", "sub/deep/c.gltf": gltf, "sub/a.bin": buffer, "b c.png": b"of c"})
        self.run_script(program=self.meshrepair)
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
        self.run_script(program=self.meshrepair)
        self.assertEqual(self.text_of("shared.png") + self.text_of("b c.png"), "sharedanother")
        write_files(self.source, {"sub/deep/a.obj": FLAT, "sub/deep/c.gltf": b"{}"})
        self.run_script(program=self.meshrepair, code=1)
        self.assertEqual(names_in(self.out), {"sub/b.obj", "sub/b.mtl", "shared.png", "sub/bump.png"})

    def test_what_lies_outside_of_the_input_folder_is_not_touched_but_said(self):
        write_files(self.folder, {"secret.png": b"secret", "secret.mtl": b"newmtl wood\nKd 0.125 0 0\n"})
        write_files(self.source, {
            "a.obj": painted(b"a.mtl"), "a.mtl": b"newmtl wood\nmap_Kd ../secret.png\nbump link.png\n",
            "b.obj": painted(b"../secret.mtl"), "c.obj": painted(b"link.mtl")})
        (self.source / "link.png").symlink_to("../secret.png")
        (self.source / "link.mtl").symlink_to("../secret.mtl")
        result = self.run_script(program=self.meshrepair)
        self.assertEqual(names_in(self.out), {f"{name}.{end}" for name in "abc" for end in ("obj", "mtl")})
        self.assertIn("c.obj: warning: names link.mtl, outside of IN_DIR", result.stderr)
        self.assertIn("a.obj: warning: names ../secret.png and 1 more, outside of IN_DIR", result.stderr)
        self.assertIn("b.obj: warning: names ../secret.mtl, outside of IN_DIR", result.stderr)
        self.assertNotIn("0.125", self.text_of("b.mtl") + self.text_of("c.mtl"))
        for extension, warnings in (("3mf", 3), ("stl", 0)):
            result = self.run_script("--format", extension, program=self.meshrepair)
            self.assertEqual(result.stderr.count("outside of IN_DIR"), warnings)

    def test_names_that_are_no_utf8_and_names_of_nothing(self):
        write_files(self.source, {
            "a.obj": painted(b"h\xf6lz.mtl"), b"h\xf6lz.mtl": b"newmtl wood\nmap_Kd w\xe4.png\n", b"w\xe4.png": b"x",
            "b.obj": painted(b"gone.mtl"), "c.obj": painted(b"c.mtl"), "c.mtl": b"newmtl wood\nmap_Kd gone.png\n"})
        result = self.run_script(program=self.meshrepair)
        self.assertIn(os.fsdecode(b"w\xe4.png"), names_in(self.out))
        self.assertIn("b.obj: warning: names gone.mtl, which is not there", result.stderr)
        self.assertIn("c.obj: warning: names gone.png, which is not there", result.stderr)
        self.assertEqual(result.stderr.count("warning"), 2)
        self.assertIn("3 of 3 files were finished before", self.run_script(program=self.meshrepair).stderr)

    def test_names_of_pictures_lead_to_nothing_that_is_made_there(self):
        names = (b"b.obj", b"b.mtl", b"summary.json", b".repair_folder/journal.jsonl", b"gone.png", b"folder")
        library = b"newmtl wood\n" + b"".join(b"map_Kd " + name + b"\n" for name in names)
        write_files(self.source, {
            "a.obj": painted(b"a.mtl"), "a.mtl": library, "b.obj": TETRAHEDRON, "b.mtl": b"x",
            "summary.json": b"x", ".repair_folder/journal.jsonl": b"x", "folder/x": b"x"})
        result = self.run_script(program=self.meshrepair)
        self.assertEqual(names_in(self.out), {"a.obj", "a.mtl", "b.obj"})
        self.assertEqual(self.codes(), {"a.obj": 0, "b.obj": 0})
        self.assertIn("a.obj: warning: names .repair_folder/journal.jsonl and 3 more, whose place in OUT_DIR is kept", result.stderr)

    def test_pictures_that_are_not_from_here_stay(self):
        write_files(self.source, {"a.obj": painted(b"a.mtl"), "a.mtl": b"newmtl wood\nmap_Kd a.png\n", "a.png": b"x"})
        write_files(self.out, {"a.png": b"mine"})
        self.run_script(program=self.meshrepair, code=1)
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
        self.run_script(program=self.meshrepair)
        self.assertEqual(names_in(self.out), {"a.obj", "a.mtl", "a_0.png"})
        self.assertEqual(self.text_of("a.mtl"), "newmtl wood\nmap_Kd a_0.png\n")

    def test_what_is_gone_or_torn_is_made_again_and_what_is_old_goes(self):
        write_files(self.source, {"a.obj": painted(b"a.mtl"), "a.mtl": b"newmtl wood\nKd 1 0 0\n"})
        self.run_script(program=self.meshrepair)
        made = self.text_of("a.mtl")
        for damage in (lambda path: path.unlink(), lambda path: path.write_text("torn")):
            damage(self.out / "a.mtl")
            self.run_script(program=self.meshrepair)
            self.assertEqual(self.text_of("a.mtl"), made)
        write_files(self.source, {"a.obj": TETRAHEDRON})
        self.run_script(program=self.meshrepair)
        self.assertEqual(names_in(self.out), {"a.obj"})
        write_files(self.source, {"a.obj": painted(b"a.mtl")})
        self.run_script(program=self.meshrepair)
        write_files(self.source, {"a.obj": FLAT})
        self.run_script(program=self.meshrepair, code=1)
        self.assertEqual(names_in(self.out), set())

    def test_who_names_a_file_that_has_changed_is_done_again(self):
        write_files(self.source, {
            "sub/a.obj": painted(b"wood.mtl"), "sub/wood.mtl": b"newmtl wood\nKd 1 0 0\n",
            "sub/b.obj": painted(b"late.mtl"), "c.obj": painted(b"own.mtl"), "own.mtl": b"newmtl wood\nKd 0 1 0\n"})
        self.run_script(program=self.meshrepair)

        def finished_before():
            said = re.search(r"(\d+) of 3 files were finished before", self.run_script(program=self.meshrepair).stderr)
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
        self.run_script(program=self.meshrepair, code=1)
        self.assertEqual(self.codes(), {"a.gltf": 3})
        write_files(self.source, {"a.bin": buffer})
        self.run_script(program=self.meshrepair)
        small = (self.out / "a.gltf").read_bytes()
        write_files(self.source, {"a.bin": struct.pack("<24f", *(2 * x for x in struct.unpack("<24f", buffer[:96])))
                                  + buffer[96:]})
        self.run_script(program=self.meshrepair)
        self.assertNotEqual((self.out / "a.gltf").read_bytes(), small)

    def test_a_library_is_of_one_output(self):
        for packed, codes in ((b"newmtl wood\nKd 0 1 0\n", [0, 6]), (b"newmtl wood\nKd 1 0 0\n", [0, 0])):
            write_files(self.source, {
                "a.obj": painted(b"a.mtl"), "a.mtl": b"newmtl wood\nKd 1 0 0\n",
                "a.obj.gz": gzip.compress(painted(b"b.mtl")), "b.mtl": packed})
            self.run_script("--restart", "--jobs", "1", program=self.meshrepair, code=int(6 in codes))
            self.assertEqual(sorted(self.codes().values()), codes)
            self.assertEqual(self.text_of("a.mtl"), "newmtl wood\nKd 1 0 0\n")
        self.assertEqual(names_in(self.out), {"a.obj", "a.obj.gz", "a.mtl"})

    def test_libraries_of_others_are_not_replaced(self):
        write_files(self.source, {"a.obj": painted(b"a.mtl"), "a.mtl": b"newmtl wood\nKd 1 0 0\n"})
        write_files(self.out, {"a.mtl": b"mine"})
        self.run_script(program=self.meshrepair, code=1)
        self.assertEqual(self.text_of("a.mtl"), "mine")
        self.assertIn("a.mtl, which it needs beside it, is of another", self.rows()["a.obj"]["error"])


if __name__ == "__main__":
    main(__doc__)
