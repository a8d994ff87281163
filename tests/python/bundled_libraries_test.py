#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of python/bundled_libraries.py.

Usage: bundled_libraries_test.py PROGRAM [CLASS]

PROGRAM is the built program meshrepair, CLASS one of the classes of tests below.

Example: tests/python/bundled_libraries_test.py build/release/bin/meshrepair Platforms
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

sys.dont_write_bytecode = True

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))

import bundled_libraries
from bundled_libraries import Refused

PROGRAM = pathlib.Path()  # set by main()


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="libraries_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.libraries, self.licences = self.folder / "libraries", self.folder / "licences"
        self.program = self.folder / "bin" / "meshrepair"
        self.program.parent.mkdir()
        shutil.copy(PROGRAM, self.program)

    def bundle(self, **options):
        bundled_libraries.bundle([self.program], self.libraries, self.licences, **options)

    def loaded(self):
        """What the program loads, by name: the path of each library."""
        said = subprocess.run(["ldd", self.program], check=True, capture_output=True, text=True).stdout
        lines = [line.split() for line in said.splitlines() if " => " in line]
        return {words[0]: pathlib.Path(words[2]).resolve() for words in lines}


class Bundles(Case):
    def check(self):
        for name, path in self.loaded().items():
            is_inside = path.parent == self.libraries.resolve()
            self.assertNotEqual(is_inside, bundled_libraries.OF_SYSTEM.fullmatch(name) is not None, name)
        said = subprocess.run([self.program, "--version"], check=True, capture_output=True, text=True).stdout
        self.assertTrue(said.startswith("meshrepair "), said)

    def test_all_but_the_systems_libraries_are_loaded_from_the_folder(self):
        self.bundle()
        self.check()
        self.assertIn("libtbb.so.12", self.loaded())

    def test_renamed_libraries_are_loaded_by_names_that_no_others_have(self):
        self.bundle(rename=True)
        self.check()
        others = [name for name in self.loaded() if not bundled_libraries.OF_SYSTEM.fullmatch(name)]
        self.assertGreater(len(others), 5)
        for name in others:
            self.assertRegex(name, r"^lib\w+-[0-9a-f]{8}\.so")

    def test_the_same_program_gives_the_same_bytes(self):
        self.bundle(rename=True)
        first = {path.name: path.read_bytes() for path in [self.program, *self.libraries.iterdir()]}
        shutil.rmtree(self.libraries)
        shutil.copy(PROGRAM, self.program)
        self.bundle(rename=True)
        self.assertEqual(first, {path.name: path.read_bytes() for path in [self.program, *self.libraries.iterdir()]})


class Licences(Case):
    def test_each_library_has_its_licence_and_that_its_text(self):
        self.bundle()
        names = {path.name for path in self.licences.iterdir()}
        for library in bundled_libraries.libraries_of(PROGRAM, self.folder).values():
            self.assertIn(bundled_libraries.package_of(library), names)
        for path in self.licences.iterdir():
            for name in bundled_libraries.LONG_LICENCES:
                if f"/usr/share/common-licenses/{name}" in path.read_text(encoding="utf-8"):
                    self.assertIn(name, names)

    def test_a_library_whose_licence_nobody_has_read_is_refused(self):
        with unittest.mock.patch.dict(bundled_libraries.LICENCES) as licences:
            del licences["libtbb12"]
            with self.assertRaisesRegex(Refused, "^read the licence of libtbb12 first"):
                self.bundle()
        self.assertFalse(self.libraries.exists())

    def test_no_licence_is_the_gpl(self):
        for package, licence in bundled_libraries.LICENCES.items():
            self.assertNotRegex(licence, "GPL", package)


class Platforms(Case):
    def test_a_version_of_the_compiler_needs_a_linux_that_has_it(self):
        for version, glibc in (("GLIBC_2.2.5", (2, 2)), ("GLIBC_2.36", (2, 36)), ("GLIBC_ABI_DT_RELR", (2, 36)),
                               ("GLIBCXX_3.4", (2, 31)), ("GLIBCXX_3.4.29", (2, 34)), ("GLIBCXX_3.4.30", (2, 35)),
                               ("CXXABI_1.3.13", (2, 34)), ("GCC_3.0", (2, 31)), ("GCC_12.0.0", (2, 35))):
            self.assertEqual(bundled_libraries.glibc_for(version), glibc, version)

    def test_a_version_that_is_not_known_is_refused(self):
        for version in ("GLIBCXX_3.4.99", "CXXABI_1.3.99", "GCC_99.0.0", "GLIBC_PRIVATE", "GLIBC_ABI_NEW", "CXXABI_FLOAT128", "OTHER_1.0"):
            with self.assertRaisesRegex(Refused, version):
                bundled_libraries.glibc_for(version)

    def test_the_tag_is_of_the_newest_glibc_that_any_file_needs(self):
        self.bundle(rename=True)
        files = [self.program, *self.libraries.iterdir()]
        said = "".join(subprocess.run(["objdump", "-T", path], check=True, capture_output=True, text=True).stdout for path in files)
        newest = max(int(word.strip("()").split(".")[1]) for word in said.split() if word.strip("()").startswith("GLIBC_2."))
        tag = bundled_libraries.platform_of(files)
        self.assertRegex(tag, r"^manylinux_2_\d+_\w+$")
        self.assertGreaterEqual(int(tag.split("_")[2]), newest)


def main():
    global PROGRAM
    PROGRAM = pathlib.Path(sys.argv[1]).resolve()
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])


if __name__ == "__main__":
    main()
