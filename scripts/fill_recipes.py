#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the version of a release, and the hashes of its source archive, into the recipes of packaging/.

Usage: fill_recipes.py ARCHIVE

ARCHIVE is what the recipes download: the tar.gz of the tag v0.1.0, say. The version is that of CMakeLists.txt. Until this is run for a
release the recipes have zeros for hashes, and no package manager takes them.

Example: fill_recipes.py v0.1.0.tar.gz
"""

import argparse
import hashlib
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# Where in packaging/ something stands, once in each file: what it is, and the group of the expression.
PLACES = (
    ("aur/PKGBUILD", "version", r"^pkgver=([\d.]+)$"),
    ("aur/PKGBUILD", "sha256", r"^sha256sums=\('([0-9a-f]*)'\)$"),
    ("conan/conanfile.py", "version", r'^    version = "([\d.]+)"$'),
    ("conan/conandata.yml", "version", r'^  "([\d.]+)":$'),
    ("conan/conandata.yml", "version", r'^    url: ".*/tags/v([\d.]+)\.tar\.gz"$'),
    ("conan/conandata.yml", "sha256", r'^    sha256: "([0-9a-f]*)"$'),
    ("conda-forge/meta.yaml", "version", r'^{% set version = "([\d.]+)" %}$'),
    ("conda-forge/meta.yaml", "sha256", r"^  sha256: ([0-9a-f]*)$"),
    ("homebrew/meshrepair.rb", "version", r'^  url ".*/tags/v([\d.]+)\.tar\.gz"$'),
    ("homebrew/meshrepair.rb", "sha256", r'^  sha256 "([0-9a-f]*)"$'),
    ("vcpkg/meshrepair/vcpkg.json", "version", r'^  "version": "([\d.]+)",$'),
    ("vcpkg/meshrepair/portfile.cmake", "sha512", r"^    SHA512 ([0-9a-f]*)$"),
)

# What makepkg --printsrcinfo prints, for a package that is one and has no variants.
SRCINFO = r"""
source "$1"
echo "pkgbase = $pkgname"
for name in pkgdesc pkgver pkgrel url arch license makedepends depends source sha256sums; do
  declare -n values=$name
  for value in "${values[@]}"; do printf '\t%s = %s\n' "$name" "$value"; done
done
printf '\npkgname = %s\n' "$pkgname"
"""


class Refused(Exception):
    """One line says what is wrong."""


def project_version(root):
    text = (root / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"^project\(meshrepair VERSION ([\d.]+)", text, re.MULTILINE)[1]


def place(folder, name, expression):
    """The text of a file, and the match of an expression in it."""
    text = (folder / name).read_text(encoding="utf-8")
    matches = list(re.finditer(expression, text, re.MULTILINE))
    if len(matches) != 1:
        raise Refused(f"{folder / name}: {len(matches)} lines are as {expression}")
    return text, matches[0]


def values_of(folder):
    """What the recipes say: file, what it is, value."""
    return [(name, kind, place(folder, name, expression)[1][1]) for name, kind, expression in PLACES]


def srcinfo(pkgbuild):
    return subprocess.run(["bash", "-euc", SRCINFO, "bash", pkgbuild], check=True, capture_output=True, text=True).stdout


def fill(folder, values):
    for name, kind, expression in PLACES:
        text, match = place(folder, name, expression)
        (folder / name).write_text(text[:match.start(1)] + values[kind] + text[match.end(1):], encoding="utf-8")
    (folder / "aur" / ".SRCINFO").write_text(srcinfo(folder / "aur" / "PKGBUILD"), encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("archive", metavar="ARCHIVE", type=Path, help="the source archive of the release")
    parser.add_argument("--packaging", metavar="FOLDER", type=Path, default=ROOT / "packaging", help="the folder of the recipes")
    arguments = parser.parse_args()
    try:
        data = arguments.archive.read_bytes()
        fill(arguments.packaging, {"version": project_version(ROOT), "sha256": hashlib.sha256(data).hexdigest(),
                                   "sha512": hashlib.sha512(data).hexdigest()})
    except (OSError, Refused) as error:
        sys.exit(f"fill_recipes.py: {error}")


if __name__ == "__main__":
    main()
