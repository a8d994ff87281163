#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the types of the package, as mypy --strict sees them from a script of a user, and runs that script.

Usage: mypy_test.py PACKAGES

PACKAGES is the folder that holds the package meshrepair, as build/release/python. Skipped where mypy is missing.
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True

SCRIPT = pathlib.Path(__file__).parent / "user_script.py"
# Types of tqdm need not be there: the package works without tqdm.
CONFIG = "[mypy]\nstrict = True\n[mypy-tqdm.*]\nignore_missing_imports = True\n"
packages = ""  # set below


class Types(unittest.TestCase):
    def test_a_script_of_a_user_is_right(self):
        """So is what it calls: mypy looks into the package, as that lies in its path."""
        with tempfile.TemporaryDirectory(prefix="mypy_") as folder:
            config = pathlib.Path(folder, "mypy.ini")
            config.write_text(CONFIG, encoding="utf-8")
            try:
                done = subprocess.run(["mypy", "--config-file", config, "--cache-dir", folder, "--python-executable", sys.executable,
                                       SCRIPT], env={**os.environ, "MYPYPATH": packages}, stdout=subprocess.PIPE, text=True, check=False)
            except FileNotFoundError:
                self.skipTest("mypy is not installed")
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_the_script_runs(self):
        done = subprocess.run([sys.executable, SCRIPT], env={**os.environ, "PYTHONPATH": packages}, stdout=subprocess.PIPE, text=True,
                              check=True)
        self.assertTrue(done.stdout.endswith("1.0 1.875 0.8660254037844386 0 float64 17\n"), done.stdout)


if __name__ == "__main__":
    packages = os.path.abspath(sys.argv.pop(1))
    unittest.main()
