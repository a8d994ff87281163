#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of the Python package: options, failures, results, and what happens while a call works.

Usage: calls_test.py PACKAGES [CLASS]

PACKAGES is the folder that holds the package meshrepair, as build/release/python; CLASS one of the classes of tests below.

Example: tests/python/calls_test.py build/release/python Errors
"""

import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

sys.dont_write_bytecode = True

import numpy as np

import package_under_test as package  # finds the package
import meshrepair
from meshrepair.program import program_path
import report_schema
from package_under_test import CUBE, MESHES, QUADS, TRIANGLES, same, soup


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
        self.assert_refused('^only: is gone: use cavities="fill" for only="outer"$', CUBE, TRIANGLES, only="outer")
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

    def test_a_check_marks_polygons(self):
        check = meshrepair.check(CUBE, QUADS[:5])
        self.assertEqual(len(check.marks), 5)
        self.assertEqual(check.faces_with("open_edges").tolist(), [0, 1, 2, 3])
        with self.assertRaisesRegex(meshrepair.UsageError, "^defect: 'holes' is none of open_edges, "):
            check.faces_with("holes")

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
        with self.assertRaisesRegex(meshrepair.UsageError, "^meshes: at least two solids are needed"):
            meshrepair.boolean([(CUBE, QUADS)], "union")


class BodiesWithCommonFaces(unittest.TestCase):
    def test_each_face_has_a_region_on_both_sides(self):
        bodies = meshrepair.bodies([(CUBE, QUADS), (CUBE + [1, 0, 0], QUADS), (CUBE + [0.5, 0.5, 0.5], QUADS)], overlap="own")
        self.assertTrue(bodies.certified)
        regions = bodies.report["bodies"]["regions"]
        self.assertEqual([region["name"] for region in regions], ["0", "1", "2", "0+2", "1+2"])
        for region in regions:
            vertices, faces = bodies.boundary(region["region"])
            self.assertAlmostEqual(meshrepair.check(vertices, faces).volume, region["volume"])
        self.assertAlmostEqual(sum(region["volume"] for region in regions), 2.75)
        self.assertEqual(bodies.regions.shape, bodies.faces.shape[:1] + (2,))
        self.assertTrue((bodies.regions[:, 0] < bodies.regions[:, 1]).all())

    def test_sources_are_of_the_meshes_that_were_given(self):
        bodies = meshrepair.bodies([(CUBE, QUADS), (CUBE + [1, 0, 0], QUADS)])
        self.assertEqual(set(bodies.source.tolist()) - {len(QUADS)}, set(range(2 * len(QUADS))) - {len(QUADS)})

    def test_messages_name_the_operand(self):
        with self.assertRaisesRegex(meshrepair.UsageError, "^operand 1: faces: row 0 has the index 8"):
            meshrepair.bodies([(CUBE, QUADS), (CUBE, [(0, 1, 8)])])
        with self.assertRaisesRegex(meshrepair.UsageError, "--overlap: bogus not in {first,"):
            meshrepair.bodies([(CUBE, QUADS)], overlap="bogus")
        with self.assertRaisesRegex(meshrepair.UsageError, "^meshes: is empty"):
            meshrepair.bodies([])
        with self.assertRaisesRegex(meshrepair.UsageError, "^region: is 2, not from 1 to 1"):
            meshrepair.bodies([(CUBE, QUADS)]).boundary(2)


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

    def test_python_ends_while_others_work(self):
        script = ("import sys, threading, time; sys.path[:0] = sys.argv[1:]; import meshrepair; from package_under_test import soup\n"
                  "begun = threading.Event()\n"
                  "work = lambda: meshrepair.repair(*soup(5000), progress=lambda stage, share: begun.set())\n"
                  "threading.Thread(target=work, daemon=True).start(); begun.wait()")
        folders = [os.path.dirname(os.path.dirname(meshrepair.__file__)), os.path.dirname(os.path.abspath(package.__file__))]
        environment = {**os.environ, **({"LD_PRELOAD": package.PRELOADED} if package.PRELOADED else {})}
        ended = subprocess.run([sys.executable, "-c", script, *folders], env=environment, stderr=subprocess.PIPE, text=True, timeout=120)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertNotIn("FATAL", ended.stderr)

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


if __name__ == "__main__":
    package.main()
