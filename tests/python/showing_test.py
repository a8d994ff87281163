#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of the Python package: what is shown: views in notebooks, docstrings.

Usage: showing_test.py PACKAGES [CLASS]

PACKAGES is the folder that holds the package meshrepair, as build/release/python; CLASS one of the classes of tests below.

Example: tests/python/showing_test.py build/release/python Notebook
"""

import doctest
import html
import importlib
import json
import pathlib
import shutil
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True

import package_under_test as package  # finds the package
import meshrepair
from package_under_test import CUBE, TRIANGLES


class Notebook(unittest.TestCase):
    def test_a_result_is_a_view_and_a_table(self):
        result = meshrepair.repair(CUBE, TRIANGLES[1:])
        text = result._repr_html_()
        self.assertIn("<iframe srcdoc=", text)
        self.assertRegex(text, "certified</th><td[^>]*>yes<")
        self.assertNotIn("@POINTS@", text)
        self.assertNotIn("http", text.replace("https://", "http").split("<table")[0].replace("http-equiv", ""))
        self.assertIn("open edges", meshrepair.check(CUBE, TRIANGLES[1:])._repr_html_())

    def run_script(self, more):
        """The script of the page in node, where nothing can be drawn, and more after it."""
        if shutil.which("node") is None:
            self.skipTest("no node")
        page = html.unescape(meshrepair.repair(CUBE * (1, 1, 3), TRIANGLES)._repr_html_().split('"')[1])
        script = page.split("<script>")[1].split("</script>")[0]
        stand_in = "const document = {querySelector: () => ({getContext: () => null}), body: {}};"
        done = subprocess.run(["node", "-"], input=stand_in + script + more, text=True, stdout=subprocess.PIPE, check=True)
        return json.loads(done.stdout)

    def test_the_script_has_the_mesh(self):
        found = self.run_script("console.log(JSON.stringify([[...points], [...faces], [...marks]]))")
        self.assertEqual([len(part) for part in found], [24, 36, 12])

    def test_the_mesh_fits_the_view(self):
        """From all sides, on a wide and on a high canvas."""
        for aspect in (1, 4 / 3, 0.5):
            most = self.run_script(f"""
                let most = 0;
                for (let azimuth = 0; azimuth < 7; azimuth += 0.1) {{
                  const matrix = turn(azimuth, 0.4), zoom = fitting(matrix, {aspect});
                  for (let i = 0; i < points.length; i += 3) {{
                    const [x, y] = [0, 1].map(r => [0, 1, 2].reduce((sum, k) => sum + matrix[3 * k + r] * points[i + k], 0) * zoom);
                    most = Math.max(most, Math.abs(x) / Math.max({aspect}, 1), Math.abs(y) / Math.max(1 / {aspect}, 1));
                  }}
                }}
                console.log(most);""")
            self.assertAlmostEqual(most, 0.92)


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
    package.main()
