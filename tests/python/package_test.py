#!/usr/bin/env python3
"""Tests of the Python package.

Usage: package_test.py PACKAGES [CLASS]

PACKAGES is the folder that holds the package meshrepair, as build/release/python; CLASS one of the classes of tests below.

Example: tests/python/package_test.py build/release/python Arrays
"""

import doctest
import importlib
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import types
import unittest

sys.dont_write_bytecode = True

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
MESHES = ROOT / "samples" / "meshes"
sys.path.insert(0, os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else "")
sys.path.insert(0, str(ROOT / "tests" / "apps"))

import meshrepair
from meshrepair.program import program_path

# The runtime of a sanitizer, say, is for this process: the programs have their own.
PRELOADED = os.environ.pop("LD_PRELOAD", None)

import report_schema

CUBE = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
TRIANGLES = np.array([t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))])


def soup(boxes, seed=1):
    """Boxes, twelve triangles each, that cross each other."""
    chance = np.random.default_rng(seed)
    turns = np.linalg.qr(chance.standard_normal((boxes, 3, 3)))[0]
    corners = (CUBE - 0.5) @ turns * (0.5 * boxes ** (-1 / 3)) + chance.random((boxes, 1, 3))
    return corners.reshape(-1, 3), (TRIANGLES + 8 * np.arange(boxes)[:, None, None]).reshape(-1, 3)


def same(one, other):
    return one.vertices.tobytes() == other.vertices.tobytes() and one.faces.tobytes() == other.faces.tobytes()


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
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "cube.off"
            rows = [" ".join(map(str, row)) for row in CUBE.tolist()] + ["4 " + " ".join(map(str, quad)) for quad in QUADS]
            path.write_text("OFF\n8 6 0\n" + "\n".join(rows) + "\n")
            self.assertTrue((meshrepair.read(path).faces == meshrepair.repair(CUBE, np.array(QUADS)).faces).all())

    def test_no_faces_enclose_nothing(self):
        for vertices, faces in ((CUBE, []), ([], []), (CUBE, np.zeros((0, 3), int)), (np.zeros((0, 3)), np.zeros((0, 3)))):
            with self.assertRaises(meshrepair.NoSolidError):
                meshrepair.repair(vertices, faces)


class Errors(unittest.TestCase):
    def assert_refused(self, words, *arguments, **options):
        with self.assertRaisesRegex(ValueError, words) as caught:
            meshrepair.repair(*arguments, **options)
        self.assertIsInstance(caught.exception, meshrepair.UsageError)

    def test_messages_name_the_row(self):
        for value in (np.nan, np.inf):
            vertices = CUBE.copy()
            vertices[5, 1] = value
            self.assert_refused("^vertices: row 5 is .*not finite$", vertices, TRIANGLES)
        for index in (-1, 8, 2 ** 40):
            faces = TRIANGLES.copy()
            faces[7, 2] = index
            self.assert_refused(f"^faces: row 7 has the index {index}, but there are 8 vertices$", CUBE, faces)
        self.assert_refused("^vertices: row 1 has not 3 numbers", [(0, 0, 0), (1, 2)], [])
        self.assert_refused("^faces: row 1 has 2 corners", CUBE, [(0, 1, 2), (0, 1)])
        self.assert_refused("^faces: row 1 is no list of indices: 7", CUBE, [(0, 1, 2), 7])
        self.assert_refused("^faces: row 1 has the index 9,", CUBE, [(0, 1, 2), (0, 1, 2, 9)])

    def test_messages_name_the_shape_and_the_type(self):
        self.assert_refused(r"^vertices: has shape \(8, 2\), not \(rows, 3\)$", CUBE[:, :2], TRIANGLES)
        self.assert_refused("^faces: has elements of type float64, not integers$", CUBE, TRIANGLES + 0.5)
        self.assert_refused("^vertices: has elements of type bool, not numbers$", CUBE > 0, TRIANGLES)
        self.assert_refused("^vertices: is None$", None, TRIANGLES)

    def test_options_are_those_of_the_program(self):
        self.assert_refused("^--inside: magic not in {auto,solidity,parity,winding}", CUBE, TRIANGLES, inside="magic")
        self.assert_refused("^no_such: there is no such option$", CUBE, TRIANGLES, no_such=1)
        self.assert_refused("^scene: is for files, and here are none$", CUBE, TRIANGLES, scene="each")
        self.assert_refused("^always: is a flag, and takes no value$", CUBE, TRIANGLES, always="yes")
        self.assert_refused("^sew: needs a value$", CUBE, TRIANGLES, sew=False)
        self.assert_refused("^nan: is 'keep', neither 'raise' nor 'drop'$", CUBE, TRIANGLES, nan="keep")

    def test_each_exit_code_has_an_exception(self):
        sheet = CUBE, [(0, 1, 2)]
        crossing = soup(2000)
        cases = {meshrepair.NoSolidError: lambda: meshrepair.repair(*sheet),
                 meshrepair.InputError: lambda: meshrepair.read("/nonexistent/mesh.obj"),
                 meshrepair.OutputError: lambda: meshrepair.write("/nonexistent/mesh.obj", CUBE, TRIANGLES),
                 meshrepair.LimitError: lambda: meshrepair.repair(*crossing, time_limit=0.01),
                 meshrepair.UsageError: lambda: meshrepair.repair(*sheet, seal="x")}
        for kind, work in cases.items():
            with self.assertRaises(kind) as caught:
                work()
            self.assertEqual(type(caught.exception), kind)
            if kind is not meshrepair.UsageError:
                self.assertEqual(caught.exception.report["exit_code"], kind.exit_code)
                self.assertEqual(caught.exception.report["error"], str(caught.exception))

    def test_not_finite_vertices_can_be_dropped(self):
        vertices = np.vstack([CUBE, [(np.nan, 0, 0)]])
        result = meshrepair.repair(vertices, np.vstack([TRIANGLES, [(0, 1, 8)]]), nan="drop")
        self.assertTrue(result.certified)
        self.assertEqual(result.report["clean"]["dropped_not_finite"], 1)


class Options(unittest.TestCase):
    def test_keywords_are_the_long_options(self):
        vertices, faces = soup(20)
        report = meshrepair.repair(vertices, faces, for_="print", min_part=0, always=True, strict=False, seal=None).report
        self.assertEqual(report["command"], ["meshrepair", "--for=print", "--min-part=0", "--always"])
        self.assertEqual(report["purpose"]["name"], "print")
        self.assertEqual(report["purpose"]["overridden"], ["--min-part"])

    def test_a_format_certifies_as_its_file_will_be(self):
        vertices, faces = soup(20)
        result = meshrepair.repair(vertices, faces, format="stl")
        self.assertTrue((result.vertices == result.vertices.astype(np.float32)).all())

    def test_reports_are_those_of_the_program(self):
        vertices, faces = soup(20)
        for distance in (False, True):
            report = meshrepair.repair(vertices, faces, distance=distance).report
            self.assertEqual(list(report_schema.complaints(json.dumps(report).encode())), [])
            self.assertEqual("distance" in report, distance)
        both = meshrepair.boolean([(CUBE, QUADS), (CUBE + 0.5, QUADS)], "union").report
        self.assertEqual(list(report_schema.complaints(json.dumps(both).encode())), [])

    def test_threads_change_nothing(self):
        vertices, faces = soup(200)
        self.assertTrue(same(meshrepair.repair(vertices, faces, threads=1), meshrepair.repair(vertices, faces)))

    def test_warnings_are_returned_and_not_printed(self):
        far = np.vstack([CUBE, [(1e12, 0, 0), (1e12, 1, 0), (1e12, 0, 1)]])
        with tempfile.TemporaryFile() as said:
            kept = os.dup(2)
            os.dup2(said.fileno(), 2)
            try:
                with self.assertRaises(meshrepair.Error):
                    meshrepair.repair(far, np.vstack([TRIANGLES, [(8, 9, 10)]]))
                sheet = meshrepair.repair(CUBE, TRIANGLES[:10])
            finally:
                os.dup2(kept, 2)
                os.close(kept)
            said.seek(0)
            self.assertEqual(said.read(), b"")
        self.assertEqual(sheet.warnings, [])


class Measures(unittest.TestCase):
    def test_a_check_says_what_is_wrong_and_where(self):
        check = meshrepair.check(CUBE, TRIANGLES[1:])
        self.assertFalse(check)
        self.assertEqual({name: count for name, count in check.defects.items() if count}, {"open_edges": 3})
        open_faces = check.faces_with("open_edges")
        self.assertEqual(len(open_faces), 3)
        self.assertTrue(all(len(set(TRIANGLES[1:][f]) & set(TRIANGLES[0])) == 2 for f in open_faces))
        self.assertTrue(meshrepair.check(CUBE, TRIANGLES))
        self.assertEqual(meshrepair.check(CUBE, TRIANGLES).volume, 1)

    def test_a_check_is_that_of_the_program(self):
        mesh = MESHES / "broken_torus_box.stl"
        text = subprocess.run([os.path.join(os.path.dirname(os.path.realpath(program_path())), "meshcheck"), "--json", mesh],
                              stdout=subprocess.PIPE, check=False).stdout
        self.assertEqual(meshrepair.check(meshrepair.read(mesh)).report["check"], json.loads(text)["check"])

    def test_a_check_takes_what_is_not_finite(self):
        check = meshrepair.check(np.where(CUBE == 1, np.nan, CUBE), TRIANGLES)
        self.assertEqual(check.defects["not_finite_triangles"], 12)

    def test_the_distance_of_a_shifted_mesh(self):
        distance = meshrepair.distance((CUBE, TRIANGLES), (CUBE + (0, 0, 3), TRIANGLES), bound=True)
        self.assertAlmostEqual(distance.hausdorff, 3)
        self.assertGreaterEqual(distance.bound, 3)
        self.assertAlmostEqual(distance.diagonal, 3 ** 0.5)


class Booleans(unittest.TestCase):
    def test_operations_have_their_volumes(self):
        boxes = [(CUBE * 2, QUADS), (CUBE * 2 + 1, QUADS)]
        for op, volume in (("union", 15), ("intersection", 1), ("difference", 7), ("xor", 14)):
            result = meshrepair.boolean(boxes, op)
            self.assertTrue(result.certified)
            self.assertAlmostEqual(meshrepair.check(result).volume, volume)

    def test_nothing_is_a_result(self):
        result = meshrepair.boolean([(CUBE, QUADS), (CUBE + 5, QUADS)], "intersection")
        self.assertEqual((len(result.faces), result.certified), (0, True))

    def test_sources_are_of_the_meshes_that_were_given(self):
        """What closes an operand has none."""
        boxes = [(CUBE * 2, QUADS[1:]), (CUBE * 2 + 1, QUADS[1:])]
        vertices = np.concatenate([box[0] for box in boxes])
        quads = np.concatenate([QUADS[1:], np.array(QUADS[1:]) + len(CUBE)])
        result = meshrepair.boolean(boxes, "union")
        self.assertEqual(set(result.source.tolist()), set(range(-1, 10)))
        for face, source in zip(result.faces, result.source):
            if source < 0:
                continue
            axis = np.flatnonzero(np.ptp(vertices[quads[source]], axis=0) == 0)[0]
            self.assertEqual(set(result.vertices[face][:, axis]), {vertices[quads[source][0], axis]})

    def test_bytes_are_those_of_the_program(self):
        names = [MESHES / "overlapping_spheres.off", MESHES / "cube.stl"]
        program = os.path.join(os.path.dirname(os.path.realpath(program_path())), "bspbool")
        with tempfile.TemporaryDirectory() as folder:
            for op in ("union", "difference"):
                one, other = os.path.join(folder, "one.obj"), os.path.join(folder, "other.obj")
                subprocess.run([program, "-q", *names, "--op", op, "-o", one], check=True)
                meshrepair.write(other, meshrepair.boolean([meshrepair.read(name) for name in names], op, format="obj"))
                self.assertEqual(pathlib.Path(one).read_bytes(), pathlib.Path(other).read_bytes())

    def test_messages_name_the_operand(self):
        with self.assertRaisesRegex(meshrepair.UsageError, "^operand 1: faces: row 0 has the index 8"):
            meshrepair.boolean([(CUBE, QUADS), (CUBE, [(0, 1, 8)])], "union")
        with self.assertRaisesRegex(meshrepair.NoSolidError, "^operand 1: "):
            meshrepair.boolean([(CUBE, QUADS), (CUBE, [(0, 1, 2)])], "union")
        with self.assertRaisesRegex(meshrepair.UsageError, "--op: bogus not in {union,"):
            meshrepair.boolean([(CUBE, QUADS), (CUBE, QUADS)], "bogus")
        with self.assertRaisesRegex(meshrepair.UsageError, "^meshes: two solids are needed"):
            meshrepair.boolean([(CUBE, QUADS)], "union")


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


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="package_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_what_is_written_is_read_back(self):
        for extension in ("obj", "ply", "off", "glb", "3mf", "obj.gz"):
            path = self.folder / f"cube.{extension}"
            meshrepair.write(path, CUBE, TRIANGLES)
            back = meshrepair.read(path)
            self.assertTrue((back.vertices[back.faces] == CUBE[TRIANGLES]).all(), extension)

    def test_points_are_read(self):
        (self.folder / "a.xyz").write_text("0 0 0 0.6 0 0.8\n1 0 0 0.6 0 0.8\n0 1 0 0.6 0 0.8\n")
        points = meshrepair.read(self.folder / "a.xyz")
        self.assertEqual(points.points.tolist(), [[0, 0, 0], [1, 0, 0], [0, 1, 0]])
        self.assertEqual(points.normals.tolist(), [[0.6, 0, 0.8]] * 3)

    def test_sources_are_written(self):
        result = meshrepair.repair(CUBE, TRIANGLES[1:])
        meshrepair.write(self.folder / "a.ply", result, sources=True)
        self.assertIn(b"source_triangle", (self.folder / "a.ply").read_bytes())
        with self.assertRaisesRegex(meshrepair.UsageError, "only PLY"):
            meshrepair.write(self.folder / "a.obj", result, sources=True)

    def test_units_go_along(self):
        meshrepair.write(self.folder / "a.3mf", CUBE, TRIANGLES, unit="inch")
        mesh = meshrepair.read(self.folder / "a.3mf")
        self.assertEqual((mesh.unit, meshrepair.repair(mesh).unit), ("inch", "inch"))
        with self.assertRaisesRegex(meshrepair.UsageError, "^unit: ell is none of micron"):
            meshrepair.write(self.folder / "b.3mf", CUBE, TRIANGLES, unit="ell")

    def test_a_file_is_repaired_and_reported(self):
        report = meshrepair.repair_file(MESHES / "broken_torus_box.stl", self.folder / "a.obj", distance=True)
        self.assertEqual((report["exit_code"], report["warnings"]), (0, []))
        self.assertIn("distance", report)
        self.assertTrue(meshrepair.check(meshrepair.read(self.folder / "a.obj")))

    def test_a_failure_leaves_what_was_there(self):
        (self.folder / "a.obj").write_text("old")
        with self.assertRaises(meshrepair.InputError):
            meshrepair.repair_file(self.folder / "none.stl", self.folder / "a.obj")
        self.assertEqual((self.folder / "a.obj").read_text(), "old")

    def test_names_that_are_no_text(self):
        path = os.path.join(os.fsencode(self.folder), b"\xff.obj")
        meshrepair.write(path, CUBE, TRIANGLES)
        self.assertEqual(len(meshrepair.read(path).faces), 12)
        with self.assertRaises(meshrepair.InputError):
            meshrepair.read(path + b"x")

    def test_a_folder_is_repaired(self):
        (self.folder / "in").mkdir()
        for name in ("cube.stl", "broken_torus_box.stl"):
            (self.folder / "in" / name).symlink_to(MESHES / name)
        summary = meshrepair.repair_folder(self.folder / "in", self.folder / "out", format="obj", jobs=2, inside="winding")
        self.assertEqual(sorted(path.name for path in (self.folder / "out").glob("*.obj")), ["broken_torus_box.obj", "cube.obj"])
        self.assertIsInstance(summary, dict)
        with self.assertRaisesRegex(meshrepair.UsageError, "refuses the options"):
            meshrepair.repair_folder(self.folder / "in", self.folder / "other", inside="magic")

    def test_python_runs_the_program(self):
        if PRELOADED:
            self.skipTest("Python and the program that takes its place would need different runtimes")
        environment = {**os.environ, "PYTHONPATH": os.path.dirname(os.path.dirname(os.path.abspath(meshrepair.__file__)))}
        result = subprocess.run([sys.executable, "-m", "meshrepair", "--inside", "magic", "a", "b"], env=environment,
                                capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, "^meshrepair: --inside: magic not in ")


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

    def test_polygons_share_theirs(self):
        result = meshrepair.repair(CUBE, QUADS, attributes={"part": np.arange(6)})
        self.assertTrue((result.attributes["part"].ravel() == result.source).all())

    def test_what_does_not_fit_is_refused(self):
        for attributes, words in (({"colour": np.zeros((5, 3))}, r"^attributes: colour has shape \(5, 3\)"),
                                  ({"colour": np.zeros((8, 7))}, "^attributes: colour cannot have 7 numbers a row"),
                                  ({"colour": "red"}, "^attributes: colour"), ([1], "^attributes: list is no dict"),
                                  ({"group": np.zeros(12, int)}, "^attributes: group needs group_names"),
                                  ({"group": np.full(12, 3), "group_names": ["a"]}, "^attributes: group: row 0 is 3")):
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


class Interrupting(unittest.TestCase):
    def test_progress_tells_stages_and_shares(self):
        told = []
        meshrepair.repair(*soup(200), progress=lambda stage, share: told.append((stage, share)))
        self.assertIn("certify", [stage for stage, _ in told])
        self.assertTrue(all(0 <= share <= 1 for _, share in told))

    def test_what_progress_raises_ends_the_work(self):
        def stop(stage, share):
            raise RuntimeError("enough")
        with self.assertRaisesRegex(RuntimeError, "enough"):
            meshrepair.repair(*soup(3000), progress=stop)

    def test_a_bar_is_drawn(self):
        with tempfile.TemporaryFile("w+") as said:
            kept, sys.stderr = sys.stderr, said
            modules, sys.modules["tqdm"] = sys.modules.get("tqdm"), None
            try:
                meshrepair.repair(*soup(20), progress=True)
            finally:
                sys.stderr = kept
                del sys.modules["tqdm"]
                if modules:
                    sys.modules["tqdm"] = modules
            said.seek(0)
            self.assertRegex(said.read(), r"certify +\d+%")
        with self.assertRaisesRegex(meshrepair.UsageError, "^progress: int can be neither called"):
            meshrepair.repair(CUBE, TRIANGLES, progress=3)

    def test_the_signal_of_ctrl_c_ends_the_work(self):
        stages = []

        def told(stage, share):
            stages.append(stage)
            if len(stages) == 2:
                os.kill(os.getpid(), signal.SIGINT)
        with self.assertRaises(KeyboardInterrupt):
            meshrepair.repair(*soup(5000), progress=told)
        self.assertNotIn("check", stages)

    def test_others_run_meanwhile(self):
        """A thread counts while another one works: Python's lock is free."""
        ended, count = threading.Event(), [0]

        def work():
            meshrepair.repair(*soup(500))
            ended.set()
        thread = threading.Thread(target=work)
        thread.start()
        while not ended.is_set():
            count[0] += 1
            time.sleep(0.001)
        thread.join()
        self.assertGreater(count[0], 20)

    def test_threads_get_their_own_results(self):
        expected = [meshrepair.repair(*soup(20, seed)) for seed in range(4)]
        found = [None] * 4

        def work(seed):
            for _ in range(5):
                found[seed] = meshrepair.repair(*soup(20, seed))
        threads = [threading.Thread(target=work, args=(seed,)) for seed in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertTrue(all(same(one, other) for one, other in zip(found, expected)))


class Notebook(unittest.TestCase):
    def test_a_result_is_a_view_and_a_table(self):
        result = meshrepair.repair(CUBE, TRIANGLES[1:])
        text = result._repr_html_()
        self.assertIn("<iframe srcdoc=", text)
        self.assertRegex(text, "certified</th><td[^>]*>yes<")
        self.assertNotIn("@POINTS@", text)
        self.assertNotIn("http", text.replace("https://", "http").split("<table")[0].replace("http-equiv", ""))
        self.assertIn("open edges", meshrepair.check(CUBE, TRIANGLES[1:])._repr_html_())

    def test_the_script_is_one(self):
        node = subprocess.run(["node", "--version"], capture_output=True, check=False) if os.access("/usr/bin/node", os.X_OK) else None
        if node is None or node.returncode != 0:
            self.skipTest("no node")
        page = (pathlib.Path(meshrepair.__file__).parent / "viewer.html").read_text()
        script = page.split("<script>")[1].split("</script>")[0]
        subprocess.run(["node", "--check", "-"], input=script, text=True, check=True)


class Doctests(unittest.TestCase):
    def test_docstrings_say_what_is_so(self):
        attempted = 0
        for path in pathlib.Path(meshrepair.__file__).parent.glob("*.py"):
            if path.stem in ("__main__", "__init__"):
                continue
            result = doctest.testmod(importlib.import_module(f"meshrepair.{path.stem}"))
            self.assertEqual(result.failed, 0)
            attempted += result.attempted
        self.assertGreater(attempted, 20)

    def test_all_that_is_offered_has_a_docstring(self):
        for name in meshrepair.__all__:
            if not name.startswith("_"):
                self.assertTrue(getattr(meshrepair, name).__doc__, name)


if __name__ == "__main__":
    del sys.argv[1]
    unittest.main()
