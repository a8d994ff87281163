#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of the Python package: what arrays a mesh may come in, and what comes back.

Usage: arrays_test.py PACKAGES [CLASS]

PACKAGES is the folder that holds the package meshrepair, as build/release/python; CLASS one of the classes of tests below.

Example: tests/python/arrays_test.py build/release/python Arrays
"""

import copy
import os
import pathlib
import sys
import tempfile
import types
import unittest

sys.dont_write_bytecode = True

import numpy as np

import package_under_test as package  # finds the package
import meshrepair
from package_under_test import CUBE, QUADS, TRIANGLES, same, soup


class Arrays(unittest.TestCase):
    def test_any_layout_gives_the_same(self):
        plain = meshrepair.repair(CUBE, TRIANGLES[1:])
        padded = np.zeros((8, 7))
        padded[:, 1::2] = CUBE
        swapped = CUBE.astype(">f8")
        locked = CUBE.copy()
        locked.setflags(write=False)
        for vertices in (np.asfortranarray(CUBE), padded[:, 1::2], swapped, locked, CUBE.tolist(), CUBE.astype(np.int8),
                         CUBE.astype(np.longdouble), CUBE[::-1][::-1]):
            self.assertTrue(same(meshrepair.repair(vertices, TRIANGLES[1:]), plain))

    def test_any_integers_are_faces(self):
        plain = meshrepair.repair(CUBE, TRIANGLES)
        for kind in "bBhHiIlLqQ":
            self.assertTrue(same(meshrepair.repair(CUBE, TRIANGLES.astype(kind)), plain), kind)
        self.assertTrue(same(meshrepair.repair(CUBE, TRIANGLES.astype(">i4")), plain))
        quads = meshrepair.repair(CUBE, QUADS)
        for kind in ("u1", "u8", ">u8"):
            self.assertTrue(same(meshrepair.repair(CUBE, np.array(QUADS, kind)), quads), kind)

    def test_what_is_given_stays_as_it_is(self):
        vertices, faces = CUBE.copy(), TRIANGLES[1:].copy()
        meshrepair.repair(vertices, faces)
        self.assertTrue((vertices == CUBE).all() and (faces == TRIANGLES[1:]).all())

    def test_results_are_views_that_outlive_their_result(self):
        result = meshrepair.repair(CUBE, TRIANGLES[1:])
        vertices, faces, source = result.vertices, result.faces, result.source
        expected = vertices.copy(), faces.copy(), source.copy()
        self.assertFalse(vertices.flags.owndata or faces.flags.owndata or source.flags.owndata)
        del result
        for _ in range(20):
            meshrepair.repair(CUBE * 3, TRIANGLES)
        for left, right in zip((vertices, faces, source), expected):
            self.assertTrue((left == right).all())

    def test_single_precision_comes_back_certified_so(self):
        vertices, faces = soup(20)
        result = meshrepair.repair(vertices.astype(np.float32), faces)
        self.assertEqual(result.vertices.dtype, np.float32)
        self.assertTrue(result.certified)
        self.assertTrue(meshrepair.check(result))
        self.assertEqual(meshrepair.repair(vertices.astype(np.float32), faces, precision="float64").vertices.dtype, np.float64)
        self.assertEqual(meshrepair.repair(vertices, faces, precision="float32").vertices.dtype, np.float32)

    def test_the_types_are_as_said(self):
        result = meshrepair.repair(CUBE, TRIANGLES)
        self.assertEqual([a.dtype for a in (result.vertices, result.faces, result.source)], [np.float64, np.int32, np.int32])
        self.assertEqual([a.shape for a in (result.vertices, result.faces, result.source)], [(8, 3), (12, 3), (12,)])

    def test_polygons_are_triangulated_as_files_are(self):
        by_lists = meshrepair.repair(CUBE, QUADS[:5] + [(1, 5, 7), (1, 7, 3)])
        self.assertEqual(sorted(set(by_lists.source.tolist())), list(range(7)))
        of_types = meshrepair.repair(CUBE, [*np.array(QUADS[:5], np.uint64), (1, 5, 7), (1, 7, 3)])
        self.assertTrue(same(of_types, by_lists))
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "cube.off"
            rows = [" ".join(map(str, row)) for row in CUBE.tolist()] + ["4 " + " ".join(map(str, quad)) for quad in QUADS]
            path.write_text("OFF\n8 6 0\n" + "\n".join(rows) + "\n")
            self.assertTrue((meshrepair.read(path).faces == meshrepair.repair(CUBE, np.array(QUADS)).faces).all())

    def test_no_faces_enclose_nothing(self):
        for vertices, faces in ((CUBE, []), ([], []), (CUBE, np.zeros((0, 3), int)), (np.zeros((0, 3)), np.zeros((0, 3)))):
            with self.assertRaises(meshrepair.NoSolidError):
                meshrepair.repair(vertices, faces)


class Attributes(unittest.TestCase):
    def test_arrays_come_onto_the_result(self):
        colours = np.linspace(0, 1, 24).reshape(8, 3)
        parts = np.arange(11, dtype=np.int32) % 2
        corners = np.arange(66, dtype=np.float32).reshape(11, 3, 2)
        result = meshrepair.repair(CUBE, TRIANGLES[1:], attributes={
            "colour": colours, "texture": corners, "group": parts, "group_names": ["even", "odd"], "heat": np.arange(8)})
        kept = result.source >= 0
        self.assertTrue((result.attributes["texture"][kept] == corners[result.source[kept]]).all())
        self.assertEqual(result.attributes["texture"].dtype, np.float32)
        self.assertTrue((result.attributes["colour"] == colours).all())
        self.assertTrue((result.attributes["group"][kept] == parts[result.source[kept]]).all())
        self.assertEqual(list(result.attributes["group_names"]), ["even", "odd"])
        self.assertEqual(result.attributes["heat"].ravel().tolist(), list(range(8)))

    def test_files_carry_them(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.ply")
            bytes_of = np.arange(24, dtype=np.uint8).reshape(8, 3)
            meshrepair.write(path, CUBE, TRIANGLES, attributes={"colour": bytes_of})
            back = meshrepair.read(path)
            self.assertTrue((back.attributes["colour"] == bytes_of).all())
            self.assertEqual(back.attributes["colour"].dtype, np.uint8)
            self.assertEqual(meshrepair.read(path, attributes=False).attributes, {})

    def test_arrays_that_came_are_read_only_and_can_be_replaced(self):
        result = meshrepair.repair(CUBE, TRIANGLES, attributes={"colour": CUBE})
        with self.assertRaises(ValueError):
            result.attributes["colour"][0] = 1
        result.attributes["colour"] = 1 - CUBE
        again = meshrepair.repair(result)
        self.assertTrue((again.attributes["colour"] == 1 - CUBE).all())

    def test_copies_keep_what_arrays_do_not_say(self):
        """A material has a colour, in no array."""
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder)
            (path / "a.mtl").write_text("newmtl red\nKd 1 0 0\n")
            (path / "a.obj").write_text("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n")
            mesh = meshrepair.read(path / "a.obj")

            def written(attributes):
                meshrepair.write(path / "b.glb", mesh, attributes=attributes)
                return (path / "b.glb").read_bytes()
            expected = written(mesh.attributes)
            self.assertNotEqual(written(dict(mesh.attributes)), expected)
            for made in (copy.copy, copy.deepcopy):
                self.assertEqual(written(made(mesh.attributes)), expected)
            emptied = copy.copy(mesh.attributes)
            emptied.clear()
            self.assertEqual(written(copy.copy(emptied)), written({}))

    def test_polygons_share_theirs(self):
        result = meshrepair.repair(CUBE, QUADS, attributes={"part": np.arange(6)})
        self.assertTrue((result.attributes["part"].ravel() == result.source).all())

    def test_any_integers_are_labels(self):
        for kind in "bBhHiIlLqQ":
            group = np.zeros(12, kind)
            result = meshrepair.repair(CUBE, TRIANGLES, attributes={"group": group, "group_names": ["a"]})
            self.assertEqual(result.attributes["group"].tolist(), [0] * 12)

    def test_numbers_of_sets_are_kept_in_any_order(self):
        sets = {name: np.full((8, 2), number) for number, name in enumerate(("texture", "texture_1", "texture_2"))}
        found = meshrepair.repair(CUBE, TRIANGLES, attributes=dict(reversed(sets.items()))).attributes
        self.assertEqual({name: value[0, 0] for name, value in found.items()}, {"texture": 0, "texture_1": 1, "texture_2": 2})

    def test_what_does_not_fit_is_refused(self):
        for attributes, words in (({"colour": np.zeros((5, 3))}, r"^attributes: colour has shape \(5, 3\)"),
                                  ({"colour": np.zeros((8, 7))}, "^attributes: colour cannot have 7 numbers a row"),
                                  ({"colour": "red"}, "^attributes: colour"), ([1], "^attributes: list is no dict"),
                                  ({"group": np.zeros(12, int)}, "^attributes: group needs group_names"),
                                  ({"group": np.full(12, 3), "group_names": ["a"]}, "^attributes: group: row 0 is 3"),
                                  ({"group": np.zeros(12, int), "group_names": "ab"}, "^attributes: group_names is no list"),
                                  ({"group": np.zeros(12, int), "group_names": 5}, "^attributes: cannot be read: TypeError"),
                                  ({"group": np.zeros(12, int), "group_names": ["\ud800"]}, "^attributes: cannot be read"),
                                  ({"heat": np.ma.array(np.zeros(8), mask=[1] * 8)}, "^attributes: heat has masked")):
            with self.assertRaisesRegex(meshrepair.UsageError, words):
                meshrepair.repair(CUBE, TRIANGLES, attributes=attributes)
        other = meshrepair.repair(CUBE, TRIANGLES, attributes={"colour": CUBE}).attributes
        with self.assertRaisesRegex(meshrepair.UsageError, "another number of faces"):
            meshrepair.repair(CUBE, TRIANGLES[1:], attributes=other)


class Foreign(unittest.TestCase):
    """Stand-ins with the attributes and constructors of other packages' classes."""

    class Trimesh:
        def __init__(self, vertices, faces, process=True):
            self.vertices, self.faces, self.process = vertices, faces, process

    class PolyData:
        def __init__(self, points, faces):
            self.points, self.faces = points, faces

    class Meshio:
        def __init__(self, points, cells):
            self.points, self.cells = points, [types.SimpleNamespace(type=kind, data=np.asarray(data)) for kind, data in cells]

    def test_objects_are_taken_and_made(self):
        plain = meshrepair.repair(CUBE, TRIANGLES)
        flat = np.concatenate([[4, *quad] for quad in QUADS[:3]] + [[3, *t] for t in TRIANGLES[6:]])
        objects = (self.Trimesh(CUBE, TRIANGLES), self.PolyData(CUBE, flat),
                   self.PolyData(CUBE, np.column_stack([np.full(12, 3), TRIANGLES]).ravel()),
                   self.Meshio(CUBE, [("line", [(0, 1)]), ("quad", QUADS[:3]), ("triangle", TRIANGLES[6:])]))
        for one in objects:
            self.assertTrue(same(meshrepair.repair(one), plain), type(one).__name__)
            again = plain.like(one)
            self.assertIs(type(again), type(one))
            self.assertTrue(same(meshrepair.repair(again), plain))
        self.assertFalse(plain.like(objects[0]).process)

    def test_meshes_of_open3d(self):
        module = types.ModuleType("open3d_like")
        module.utility = types.SimpleNamespace(Vector3dVector=list, Vector3iVector=list)

        class TriangleMesh:
            def __init__(self, vertices, triangles):
                self.vertices, self.triangles = vertices, triangles
        TriangleMesh.__module__ = "open3d_like.geometry"
        sys.modules["open3d_like"] = module
        self.addCleanup(sys.modules.pop, "open3d_like")
        plain = meshrepair.repair(CUBE, TRIANGLES)
        mesh = TriangleMesh(list(CUBE), list(TRIANGLES))
        self.assertTrue(same(meshrepair.repair(mesh), plain))
        self.assertTrue(same(meshrepair.repair(plain.like(mesh)), plain))

    def test_none_is_imported(self):
        self.assertFalse({"trimesh", "open3d", "pyvista", "meshio", "tqdm"} & set(sys.modules))

    def test_others_are_refused(self):
        for thing in (object(), "text", 3, types.SimpleNamespace(vertices=CUBE)):
            with self.assertRaises(meshrepair.UsageError):
                meshrepair.repair(thing)
        curved = self.Meshio(CUBE, [("triangle", TRIANGLES), ("triangle6", np.zeros((1, 6), int))])
        with self.assertRaisesRegex(meshrepair.UsageError, "^mesh: has cells of type triangle6"):
            meshrepair.repair(curved)


class Points(unittest.TestCase):
    def ball(self, count=500):
        i = np.arange(count)
        t, a = np.arccos(1 - (2 * i + 1) / count), np.pi * (1 + 5 ** 0.5) * i
        return np.stack([np.cos(a) * np.sin(t), np.sin(a) * np.sin(t), np.cos(t)], axis=1)

    def test_a_ball_with_and_without_normals(self):
        ball = self.ball()
        for normals in (None, ball, ball.tolist()):
            result = meshrepair.repair_points(ball, normals)
            self.assertTrue(result.certified)
            self.assertAlmostEqual(meshrepair.check(result).volume, 4.19, delta=0.2)

    def test_objects_with_points_are_taken(self):
        cloud = types.SimpleNamespace(points=self.ball(), normals=self.ball())
        self.assertTrue(same(meshrepair.repair_points(cloud), meshrepair.repair_points(cloud.points, cloud.normals)))

    def test_messages_name_the_row(self):
        with self.assertRaisesRegex(meshrepair.UsageError, "^points: row 2 is .* not finite"):
            meshrepair.repair_points([(0, 0, 0), (1, 0, 0), (0, np.nan, 0)])
        with self.assertRaisesRegex(meshrepair.UsageError, "^normals: are 2, but there are 500 points"):
            meshrepair.repair_points(self.ball(), self.ball()[:2])


if __name__ == "__main__":
    package.main()
