#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of the recipes in packaging/, as far as they go without the package managers, and of scripts/fill_recipes.py.

Usage: recipes_test.py BUILD [CLASS]

BUILD is a build tree with the programs, CLASS one of the classes of tests below.

Example: tests/scripts/recipes_test.py build/release Aur
"""

import ast
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import yaml

sys.dont_write_bytecode = True

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGING = ROOT / "packaging"
sys.path.insert(0, str(ROOT / "scripts"))

import fill_recipes

BUILD = pathlib.Path()  # set by main()

# What Debian calls it, and the others. None: not there, see the recipe. fmt is what spdlog uses.
NAMES = {
    #                         vcpkg             Conan            conda-forge         Homebrew         Arch
    "libboost-dev":          ("boost-graph",    "boost",         "libboost-headers", "boost",         "boost"),
    "libcli11-dev":          ("cli11",          "cli11",         "cli11",            "cli11",         "cli11"),
    "libdraco-dev":          ("draco",          "draco",         "draco",            "draco",         "draco"),
    "libeigen3-dev":         ("eigen3",         "eigen",         "eigen",            "eigen@3",       "eigen"),
    "libexpat1-dev":         ("expat",          "expat",         "expat",            "expat",         "expat"),
    "libjpeg-dev":           ("libjpeg-turbo",  "libjpeg-turbo", "libjpeg-turbo",    "jpeg-turbo",    "libjpeg-turbo"),
    "libmeshoptimizer-dev":  ("meshoptimizer",  "meshoptimizer", "meshoptimizer",    None,            "meshoptimizer"),
    "libnanoflann-dev":      ("nanoflann",      "nanoflann",     "nanoflann",        "nanoflann",     "nanoflann"),
    "libopenmesh-dev":       ("openmesh",       "openmesh",      "openmesh",         "open-mesh",     "openmesh"),
    "libpng-dev":            ("libpng",         "libpng",        "libpng",           "libpng",        "libpng"),
    "libspdlog-dev":         ("spdlog",         "spdlog",        "spdlog",           "spdlog",        "spdlog"),
    "libtbb-dev":            ("tbb",            "onetbb",        "tbb-devel",        "tbb",           "onetbb"),
    "libzip-dev":            ("libzip",         "libzip",        "libzip",           "libzip",        "libzip"),
    "libzstd-dev":           ("zstd",           "zstd",          "zstd",             "zstd",          "zstd"),
    "nlohmann-json3-dev":    ("nlohmann-json",  "nlohmann_json", "nlohmann_json",    "nlohmann-json", "nlohmann-json"),
    "zlib1g-dev":            ("zlib",           "zlib",          "zlib",             "zlib",          "zlib"),
}
TOOLS = {"debhelper-compat", "cmake", "dh-sequence-python3", "ninja-build", "pkg-config", "pybind11-dev", "python3-dev"}
MANAGERS = ("vcpkg", "conan", "conda-forge", "homebrew", "aur")
OTHERS = {"vcpkg": {"vcpkg-cmake", "vcpkg-cmake-config"}, "conan": set(), "conda-forge": set(),
          "homebrew": {"cmake", "fmt", "ninja", "pkgconf"}, "aur": {"cmake", "fmt", "gcc-libs", "glibc", "ninja", "pkgconf"}}


def text_of(name):
    return (PACKAGING / name).read_text(encoding="utf-8")


def vcpkg_dependencies():
    manifest = json.loads(text_of("vcpkg/meshrepair/vcpkg.json"))
    listed = manifest["dependencies"] + manifest["features"]["tools"]["dependencies"]
    return {entry if isinstance(entry, str) else entry["name"] for entry in listed}


def conan_dependencies():
    words = [node.value for node in ast.walk(ast.parse(text_of("conan/conanfile.py"))) if isinstance(node, ast.Constant)]
    found = {match[1] for word in words if isinstance(word, str) and (match := re.fullmatch(r"([a-z]\w[\w-]+)/[\[\d].*", word))}
    return found - {"cmake", "pkgconf"}


def conda_recipe():
    """The recipe, as conda-build reads it: without the lines of Jinja, and with its values set in."""
    lines = [line for line in text_of("conda-forge/meta.yaml").splitlines() if not line.startswith("{%")]
    values = {"version": fill_recipes.project_version(ROOT), "compiler('cxx')": "gxx_linux-64", "stdlib('c')": "sysroot_linux-64"}
    return yaml.safe_load(re.sub(r"{{ (.*?) }}", lambda match: values[match[1]], "\n".join(lines)))


def aur_dependencies():
    command = 'source "$1"; printf "%s\\n" "${depends[@]}" "${makedepends[@]}"'
    said = subprocess.run(["bash", "-euc", command, "bash", PACKAGING / "aur/PKGBUILD"], check=True, capture_output=True, text=True)
    return set(said.stdout.split())


def dependencies_of(manager):
    if manager == "homebrew":
        return set(re.findall(r'^  depends_on "(.*?)"', text_of("homebrew/meshrepair.rb"), re.MULTILINE))
    if manager == "conda-forge":
        return {line.split()[0] for line in conda_recipe()["requirements"]["host"]}
    return {"vcpkg": vcpkg_dependencies, "conan": conan_dependencies, "aur": aur_dependencies}[manager]()


class Facts(unittest.TestCase):
    """What is said in several places is the same."""

    def test_versions_are_that_of_the_project(self):
        version = fill_recipes.project_version(ROOT)
        for name, kind, value in fill_recipes.values_of(PACKAGING):
            if kind == "version":
                self.assertEqual(value, version, name)
        self.assertTrue(text_of("debian/changelog").startswith(f"meshrepair ({version}) "))

    def test_every_library_of_the_debian_package_is_in_every_recipe(self):
        field = re.search(r"^Build-Depends:\n((?: .*\n)+)", text_of("debian/control"), re.MULTILINE)[1]
        libraries = {line.split()[0].rstrip(",") for line in field.splitlines()} - TOOLS
        self.assertEqual(libraries, set(NAMES))
        for column, manager in enumerate(MANAGERS):
            needed = {names[column] for names in NAMES.values()} - {None}
            self.assertEqual(dependencies_of(manager), needed | OTHERS[manager], manager)

    def test_options_are_those_of_the_project(self):
        declared = {name for path in [ROOT / "CMakeLists.txt", *(ROOT / "cmake").glob("*.cmake")]
                    for name in re.findall(r"(?:option|set)\((MESHREPAIR_\w+)", path.read_text(encoding="utf-8"))}
        for path in sorted(PACKAGING.rglob("*")):
            if path.is_file():
                named = set(re.findall(r"\bD?(MESHREPAIR_[A-Z_]+)", path.read_text(encoding="utf-8")))
                self.assertEqual(named - declared, set(), path)

    def test_every_program_is_copied_by_vcpkg(self):
        said = (ROOT / "apps/CMakeLists.txt").read_text(encoding="utf-8")
        programs = re.search(r"^set\(programs (.*)\)$", said, re.MULTILINE)[1]
        self.assertIn(f"TOOL_NAMES {programs}\n", text_of("vcpkg/meshrepair/portfile.cmake"))

    def test_conan_names_every_library_after_those_that_use_it(self):
        names = re.search(r"^LIBRARIES = (\(.*\))$", text_of("conan/conanfile.py"), re.MULTILINE)[1]
        listed = ast.literal_eval(names)
        self.assertEqual(sorted(listed), sorted(path.parent.name[3:] for path in ROOT.glob("lib*/CMakeLists.txt")))
        for name in listed:
            call = (ROOT / f"lib{name}/CMakeLists.txt").read_text(encoding="utf-8")
            for used in re.findall(r"meshrepair::(\w+)", call):
                self.assertLess(listed.index(name), listed.index(used), f"{name} uses {used}")


class Syntax(unittest.TestCase):
    def test_the_portfile_runs_to_its_end(self):
        functions = set(re.findall(r"^ *(vcpkg_\w+)\(", text_of("vcpkg/meshrepair/portfile.cmake"), re.MULTILINE))
        with tempfile.TemporaryDirectory(prefix="recipes_") as name:
            script = pathlib.Path(name) / "run.cmake"
            stubs = "".join(f"function({function})\n  message(STATUS \"{function} ${{ARGN}}\")\nendfunction()\n" for function in functions)
            script.write_text(f'cmake_minimum_required(VERSION 3.25)\nset(FEATURES tools)\nset(CURRENT_PACKAGES_DIR "{name}")\n'
                              f'set(PORT meshrepair)\n{stubs}include("{PACKAGING}/vcpkg/meshrepair/portfile.cmake")\n', encoding="utf-8")
            said = subprocess.run(["cmake", "-P", script], check=False, capture_output=True, text=True)
            self.assertEqual(said.returncode, 0, said.stderr)
            self.assertTrue((pathlib.Path(name) / "share/meshrepair/usage").exists())
        for function in functions:
            self.assertIn(f"-- {function}", said.stdout)

    def test_the_recipe_of_conan_compiles(self):
        compile(text_of("conan/conanfile.py"), "conanfile.py", "exec")
        data = yaml.safe_load(text_of("conan/conandata.yml"))
        self.assertEqual(list(data["sources"]), [fill_recipes.project_version(ROOT)])

    def test_the_recipe_of_conda_forge_is_yaml(self):
        recipe = conda_recipe()
        self.assertEqual(recipe["package"], {"name": "meshrepair", "version": fill_recipes.project_version(ROOT)})
        for name in recipe["test"]["source_files"]:
            self.assertTrue((ROOT / name).exists(), name)

    @unittest.skipUnless(shutil.which("ruby"), "there is no ruby")
    def test_the_formula_is_ruby(self):
        said = subprocess.run(["ruby", "-c", PACKAGING / "homebrew/meshrepair.rb"], check=False, capture_output=True, text=True)
        self.assertEqual(said.returncode, 0, said.stderr)


class Aur(unittest.TestCase):
    """The functions of the PKGBUILD, on a tree that is built."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="recipes_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / f"meshrepair-{fill_recipes.project_version(ROOT)}").symlink_to(ROOT)
        (self.folder / "build").symlink_to(BUILD)

    def run_function(self, name):
        command = 'source "$1"; srcdir=$PWD; pkgdir=$PWD/package; "$2"'
        result = subprocess.run(["bash", "-euc", command, "bash", PACKAGING / "aur/PKGBUILD", name], cwd=self.folder, check=False,
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_check_repairs_a_mesh(self):
        self.run_function("check")
        self.assertGreater((self.folder / "repaired.obj").stat().st_size, 0)

    def test_package_installs_programs_and_licence(self):
        self.run_function("package")
        self.assertEqual((self.folder / "package/usr/share/licenses/meshrepair/LICENSE").read_text(encoding="utf-8"),
                         (ROOT / "LICENSE").read_text(encoding="utf-8"))
        programs = [path for path in (self.folder / "package").rglob("bin/meshrepair") if os.access(path, os.X_OK)]
        self.assertEqual(len(programs), 1)

    def test_srcinfo_is_that_of_the_pkgbuild(self):
        self.assertEqual(text_of("aur/.SRCINFO"), fill_recipes.srcinfo(PACKAGING / "aur/PKGBUILD"))


class Filling(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="recipes_")
        self.addCleanup(folder.cleanup)
        self.copy = pathlib.Path(folder.name) / "packaging"
        shutil.copytree(PACKAGING, self.copy)
        self.archive = pathlib.Path(folder.name) / "v1.tar.gz"
        self.archive.write_bytes(b"an archive")

    def run_script(self, archive):
        return subprocess.run([ROOT / "scripts/fill_recipes.py", archive, "--packaging", self.copy], check=False, capture_output=True,
                              text=True)

    def test_all_recipes_have_the_hash_of_the_archive(self):
        self.assertEqual(self.run_script(self.archive).returncode, 0)
        hashes = {kind: getattr(hashlib, kind)(b"an archive").hexdigest() for kind in ("sha256", "sha512")}
        for name, kind, value in fill_recipes.values_of(self.copy):
            if kind in hashes:
                self.assertEqual(value, hashes[kind], name)
        self.assertIn(hashes["sha256"], (self.copy / "aur/.SRCINFO").read_text(encoding="utf-8"))

    def test_an_archive_that_is_not_there_is_one_line(self):
        result = self.run_script(self.archive.with_name("none"))
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"^fill_recipes.py: .*none.*\n$")

    def test_a_recipe_without_a_place_for_the_hash_is_said(self):
        formula = self.copy / "homebrew/meshrepair.rb"
        formula.write_text(formula.read_text(encoding="utf-8").replace("  sha256", "  # sha256"), encoding="utf-8")
        result = self.run_script(self.archive)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"^fill_recipes.py: .*meshrepair.rb: 0 lines .*\n$")


def main():
    global BUILD
    BUILD = pathlib.Path(sys.argv[1]).resolve()
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])


if __name__ == "__main__":
    main()
