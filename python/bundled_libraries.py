#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Puts the shared libraries that programs and extension modules need beside them, with their licences.

Then they run where none of these is installed. What every Linux has stays outside: the libraries of the C and the C++ compiler.
A library whose licence nobody has read is refused, so that none under the GPL slips in.

Needs Debian, whose packages hold the licences, and patchelf. For the wheel (build_backend.py) and the archive (scripts/package.sh).

Example: bundled_libraries.py --into root/lib --licences root/share/doc/meshrepair/licences root/bin/*
"""

import argparse
import hashlib
import itertools
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

OF_SYSTEM = re.compile(r"(ld-linux[-\w]*|libc|libm|libdl|libpthread|librt|libstdc\+\+|libgcc_s)\.so[.\d]*")

# Packages of libraries that may be inside, and the licence under which they are. Their files "copyright" name the GPL, too, if at all
# for Debian's own scripts, for examples, or as one of two licences.
LICENCES = {
    "libbz2-1.0": "bzip2-1.0.6",
    "libdraco7": "Apache-2.0",
    "libexpat1": "MIT",
    "libfmt9": "MIT",
    "libjpeg62-turbo": "IJG AND BSD-3-Clause AND Zlib",
    "libmeshoptimizer2d": "MIT",
    "libpng16-16": "libpng-2.0",
    "libspdlog1.10": "MIT",
    "libssl3": "Apache-2.0",
    "libtbb12": "Apache-2.0",
    "libzip4": "BSD-3-Clause",
    "libzstd1": "BSD-3-Clause",
    "zlib1g": "Zlib",
}
# Their code is in what the compiler made, and their licences ask to be named with it.
COMPILED_IN = ("libcli11-dev", "libeigen3-dev", "libnanoflann-dev", "libopenmesh-dev", "nlohmann-json3-dev", "pybind11-dev")
# "copyright" names these by their path in Debian.
LONG_LICENCES = ("Apache-2.0", "MPL-2.0")

# The oldest glibc of a Linux whose compiler has these versions of its libraries; what is not here has to be looked up first
# (github.com/pypa/auditwheel, manylinux-policy.json).
OF_COMPILER = {
    "CXXABI": (((1, 3, 12), (2, 31)), ((1, 3, 13), (2, 34))),
    "GCC": (((7, 0, 0), (2, 31)), ((12, 0, 0), (2, 35))),
    "GLIBCXX": (((3, 4, 28), (2, 31)), ((3, 4, 29), (2, 34)), ((3, 4, 30), (2, 35))),
}


class Refused(Exception):
    """Something cannot be put inside; one line says why."""


def _output(*command):
    result = subprocess.run([str(word) for word in command], check=False, capture_output=True, text=True, errors="replace")
    if result.returncode != 0:
        raise Refused(f"{command[0]} {command[-1]}: {(result.stderr or result.stdout).strip()}")
    return result.stdout


def libraries_of(file, folder):
    """All libraries that a file needs, directly or not: by name, where each is. Without the system's, and those in the folder."""
    found = {}
    for name, path in re.findall(r"^\s*(\S+) => (.*?)(?: \(0x\w+\))?$", _output("ldd", file), re.MULTILINE):
        if path == "not found":
            raise Refused(f"{file}: {name} is not found")
        if not OF_SYSTEM.fullmatch(name) and Path(path).resolve().parent != folder.resolve():
            found[name] = Path(path)
    return found


def package_of(library):
    """Debian's package of a file; /lib may be a link to /usr/lib, and only one of the two is known."""
    real = library.resolve()
    for path in (real, library, Path(str(real).removeprefix("/usr"))):
        result = subprocess.run(["dpkg", "-S", path], check=False, capture_output=True, text=True)
        if result.returncode == 0:
            return result.stdout.split(":")[0]
    raise Refused(f"{library} is of no package of Debian")


def copy_licences(libraries, folder):
    packages = {package_of(library) for library in libraries}
    unknown = sorted(packages - LICENCES.keys())
    if unknown:
        raise Refused(f"read the licence of {', '.join(unknown)} first, and add it to bundled_libraries.py")
    folder.mkdir(parents=True, exist_ok=True)
    for package in sorted(packages.union(COMPILED_IN)):
        source = Path("/usr/share/doc") / package / "copyright"
        if not source.exists():
            raise Refused(f"{source} is not there")
        shutil.copyfile(source, folder / package)
    for name in LONG_LICENCES:
        shutil.copyfile(Path("/usr/share/common-licenses") / name, folder / name)


def unique_name(name, path):
    """Of two libraries of one name a process loads only the first: in a wheel each has a name of its own."""
    stem, end = name.split(".so", 1)
    return f"{stem}-{hashlib.sha256(path.read_bytes()).hexdigest()[:8]}.so{end}"


def needed_by(file):
    return _output("patchelf", "--print-needed", file).split()


def _lead(file, folder, names):
    """Lets a file find its libraries in the folder, by their names there."""
    renamed = [["--replace-needed", name, names[name]] for name in needed_by(file) if names.get(name, name) != name]
    if renamed:
        _output("patchelf", *itertools.chain(*renamed), file)
    _output("patchelf", "--set-rpath", os.path.join("$ORIGIN", os.path.relpath(folder, file.parent)).removesuffix("/."), file)
    outside = [name for name in needed_by(file) if not OF_SYSTEM.fullmatch(name) and not (folder / name).exists()]
    if outside:
        raise Refused(f"{file} still needs {', '.join(outside)}")


def bundle(files, folder, licences, rename=False):
    """Copies what the files need into the folder, and leads them there. rename: gives the copies names that no other has."""
    found = {}
    for file in files:
        found |= libraries_of(file, folder)
    copy_licences(found.values(), licences)
    names = {name: unique_name(name, path) if rename else name for name, path in found.items()}
    folder.mkdir(parents=True, exist_ok=True)
    for name, path in found.items():
        shutil.copyfile(path, folder / names[name])
        if rename:
            _output("patchelf", "--set-soname", names[name], folder / names[name])
    for file in [*files, *(folder / name for name in names.values())]:
        _lead(file, folder, names)


def versions_needed(file):
    """The versions of symbols that a file needs of the system's libraries, as "GLIBC_2.34"."""
    needed, of_system = set(), False
    for line in _output("objdump", "-p", file).partition("Version References:")[2].splitlines():
        if match := re.match(r"\s+required from (.*):$", line):
            of_system = OF_SYSTEM.fullmatch(match[1]) is not None
        elif of_system and (match := re.match(r"\s+0x\w+ 0x\w+ \d+ (\S+)$", line)):
            needed.add(match[1])
    return needed


def glibc_for(version):
    """The oldest glibc, as (2, 34), of a Linux that has a version of symbols."""
    if version == "GLIBC_ABI_DT_RELR":
        return (2, 36)
    library, _, digits = version.partition("_")
    if re.fullmatch(r"\d+(\.\d+)*", digits):
        number = tuple(map(int, digits.split(".")))
        if library == "GLIBC":
            return number[:2]
        for newest, glibc in OF_COMPILER.get(library, ()):
            if number <= newest:
                return glibc
    raise Refused(f"it is not known which systems have {version}")


def platform_of(files):
    """The tag of the platforms that have all that the files need of them: "manylinux_2_36_x86_64", say."""
    versions = set().union(*map(versions_needed, files))
    major, minor = max(map(glibc_for, versions), default=(2, 17))
    return f"manylinux_{major}_{minor}_{os.uname().machine}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--into", required=True, type=Path, metavar="FOLDER", help="for the libraries")
    parser.add_argument("--licences", required=True, type=Path, metavar="FOLDER", help="for their licences")
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE", help="program, library or extension module")
    arguments = parser.parse_args()
    try:
        bundle(arguments.files, arguments.into, arguments.licences)
    except Refused as error:
        sys.exit(f"bundled_libraries.py: {error}")


if __name__ == "__main__":
    main()
