#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of scripts/setup.sh: what it makes of an npm that fails. Nothing is installed: all programs are false ones. And of scripts that
others name."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
NODE_FOLDERS = ("tests/node", "web/viewer")
FALSE_PROGRAMS = {
    "dpkg-query": "echo -n installed",
    "apt-get": "exit 1",
    "node": "exit 1",
    "npm": 'echo "$NPM_SAYS" >&2; [ -z "$NPM_SAYS" ] && mkdir -p "$3/node_modules"',
}


class NodePackages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="setup_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name in ("scripts/setup.sh", *(f"{folder}/package-lock.json" for folder in NODE_FOLDERS)):
            (self.folder / name).parent.mkdir(parents=True)
            shutil.copy(ROOT / name, self.folder / name)
        (self.folder / "bin").mkdir()
        for name, text in FALSE_PROGRAMS.items():
            (self.folder / "bin" / name).write_text(f"#!/bin/sh\n{text}\n")
            (self.folder / "bin" / name).chmod(0o755)

    def run_setup(self, npm_says):
        environment = {"PATH": f"{self.folder}/bin:{os.environ['PATH']}", "NPM_SAYS": npm_says}
        return subprocess.run([self.folder / "scripts/setup.sh", "all"], env=environment, check=False,
                              capture_output=True, text=True, timeout=60)

    def is_noted(self):
        noted = {(self.folder / folder / "node_modules/.installed-lock.json").exists() for folder in NODE_FOLDERS}
        self.assertEqual(len(noted), 1)
        return noted.pop()

    def test_a_registry_out_of_reach_is_one_line_and_no_failure(self):
        for code in ("ENOTFOUND", "ECONNREFUSED", "E503"):
            result = self.run_setup(f"npm ERR! code {code}\nnpm ERR! more lines")
            self.assertEqual(result.returncode, 0)
            self.assertRegex(result.stderr, rf"^(setup.sh: warning: the registry of npm [^\n]*\({code}\)[^\n]*\n){{2}}$")
            self.assertFalse(self.is_noted())

    def test_what_else_goes_wrong_is_a_failure(self):
        result = self.run_setup("npm ERR! code EINTEGRITY")
        self.assertEqual(result.returncode, 1)
        self.assertIn("EINTEGRITY", result.stderr)
        self.assertFalse(self.is_noted())

    def test_what_is_installed_is_not_installed_again(self):
        self.assertEqual(self.run_setup("").returncode, 0)
        self.assertTrue(self.is_noted())
        self.assertEqual(self.run_setup("npm ERR! code EINTEGRITY").returncode, 0)


class Names(unittest.TestCase):
    def test_scripts_that_scripts_and_workflows_call_are_there(self):
        callers = [*(ROOT / "scripts").rglob("*.sh"), *(ROOT / ".github").rglob("*.yml"), ROOT / ".ci" / "run"]
        for caller in callers:
            for name in set(re.findall(r"\b(?:scripts|bench|python)/[\w./-]+\.(?:sh|py)\b", caller.read_text(encoding="utf-8"))):
                with self.subTest(caller=caller.name, name=name):
                    self.assertTrue((ROOT / name).is_file())


if __name__ == "__main__":
    unittest.main()
