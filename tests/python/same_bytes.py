#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares what the Python package makes of files with what the program makes of them, byte by byte.

Usage: same_bytes.py PACKAGES FILE... [-- OPTION=VALUE...]

PACKAGES is the folder that holds the package meshrepair, as build/release/python. Each file is repaired in three ways,
into each format: by the program; by repair_file(); and by read(), repair() and write(). All have to write the same
files, or to fail with the same exit code and message. Exit code 1 where they differ.

Example: tests/python/same_bytes.py build/release/python samples/meshes/* -- for=print
"""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True

FORMATS = ("obj", "stl", "ply", "glb")


def contents(folder):
    """Of all files in a folder, by their names."""
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def by_program(program, source, target, options):
    words = [f"--{name.rstrip('_').replace('_', '-')}={value}" for name, value in options.items()]
    result = subprocess.run([program, "--quiet", *words, source, target], check=False, stderr=subprocess.PIPE, text=True)
    said = result.stderr.strip().removeprefix("meshrepair: ").removeprefix("error: ")
    return result.returncode, said.split(" (try ")[0].removeprefix("[error] ")


def by_file(package, source, target, options):
    try:
        report = package.repair_file(source, target, **options)
    except package.Error as error:
        return error.exit_code, str(error)
    return report["exit_code"], (report["error"] or "").removeprefix("error: ")


def by_arrays(package, source, target, options):
    try:
        given = package.read(source)
        kept = {"format": target.suffix[1:], **options}
        if isinstance(given, package.Points):
            result = package.repair_points(given.points, given.normals, nan="drop", **kept)
        else:
            result = package.repair(given, nan="drop", **kept)
        package.write(target, result)
    except package.Error as error:
        return error.exit_code, str(error)
    return (0 if result.certified else 1), (result.report["error"] or "")


def differences(package, program, source, extension, options):
    """One line for each way that is not as the program."""
    with tempfile.TemporaryDirectory(prefix="same_bytes_") as name:
        found = {}
        for way, repair in (("program", by_program), ("repair_file", by_file), ("arrays", by_arrays)):
            folder = pathlib.Path(name) / way
            folder.mkdir()
            code, message = repair(program if way == "program" else package, source, folder / f"out.{extension}", options)
            # In memory things have other names than files.
            message = message.replace(f"{folder}/", "") if way != "arrays" else ""
            found[way] = (code, message, contents(folder))
        code, message, files = found.pop("program")
        for way, (other_code, other_message, other_files) in found.items():
            if other_code != code:
                yield f"{way}: exit code {other_code}, not {code}: {other_message} {message}"
            elif way == "repair_file" and other_message != message:
                yield f"{way}: says '{other_message}', not '{message}'"
            elif other_files != files:
                names = sorted(key for key in {*files, *other_files} if files.get(key) != other_files.get(key))
                yield f"{way}: other bytes in {', '.join(names)}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("packages", metavar="PACKAGES")
    parser.add_argument("files", metavar="FILE", nargs="+", type=pathlib.Path)
    end = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    arguments = parser.parse_args(sys.argv[1:end])
    options = dict(word.split("=", 1) for word in sys.argv[end + 1:])
    sys.path.insert(0, os.path.abspath(arguments.packages))
    import meshrepair
    from meshrepair.program import program_path
    compared = differ = 0
    for source in arguments.files:
        for extension in FORMATS:
            compared += 1
            for line in differences(meshrepair, program_path(), source, extension, options):
                differ += 1
                print(f"{source} to {extension}: {line}", flush=True)
    print(f"{len(arguments.files)} files, {compared} repairs, each in three ways: {differ} differ")
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
