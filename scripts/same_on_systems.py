#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares what the programs write on several systems, byte by byte.

Each way to run the programs repairs each mesh of a folder, smallest first, once for each format, reduces it, unites it with the one before,
and checks it. The outputs of the first way are compared with those of the others: exit codes, files and reports, these without times,
memory, paths and command lines. Prints a table of the differences. The exit code is 1 if there is one, 2 for wrong arguments, else 0.
"""

import argparse
import hashlib
import itertools
import json
import os
import shlex
import subprocess
import sys
import tempfile
import time
from pathlib import Path

MESHES = {".3mf", ".glb", ".gltf", ".obj", ".off", ".ply", ".stl"}
FORMATS = "obj,stl,ply,glb,3mf"
REPORT = "report.json"
OWN_KEYS = {"build", "command", "cpu_seconds", "path", "peak_bytes", "peak_memory_bytes", "seconds"}  # of a run
EXAMPLES = """
A way is NAME=COMMAND. COMMAND starts a program, whose name replaces each "*"; without a "*", it ends with the folder of the programs.

examples:
  scripts/same_on_systems.py samples/meshes --way x86=build/release/bin \\
    --way "arm64=qemu-aarch64 -L build/arm64-sysroot -R 16G build/arm64/bin"
  scripts/same_on_systems.py samples/meshes --way linux=build/release/bin \\
    --way "windows=scripts/run_wine.sh build/windows/bin/*.exe" --formats obj,3mf
"""


class Way:
    """A way to run the programs, and the folder where they write."""

    def __init__(self, text):
        self.name, equals, command = text.partition("=")
        words = shlex.split(command)
        if not equals or not self.name or not words:
            raise argparse.ArgumentTypeError(f'"{text}" is not NAME=COMMAND')
        if not any("*" in word for word in words):
            words[-1] = os.path.join(words[-1], "*")
        # Programs run in other folders.
        self.words = [os.path.abspath(word) if os.path.exists(os.path.dirname(word) or word) else word for word in words]

    def run(self, folder, timeout, program, *arguments):
        """What it leaves: its exit code, and the files in the folder, by name; None if it took too long."""
        folder.mkdir(parents=True)
        command = [word.replace("*", program) for word in self.words] + [str(argument) for argument in arguments]
        try:
            code = subprocess.run(command, cwd=folder, timeout=timeout, stdin=subprocess.DEVNULL, capture_output=True).returncode
        except subprocess.TimeoutExpired:
            return None
        return {"exit code": code} | {path.name: contents(path) for path in sorted(folder.iterdir())}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, epilog=EXAMPLES, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", type=Path, metavar="FOLDER", help="a folder of meshes")
    parser.add_argument("--way", type=Way, action="append", required=True, dest="ways", metavar="NAME=COMMAND", help="twice at least")
    parser.add_argument("--formats", default=FORMATS, help="extensions of the repaired files, none for checks alone (default: %(default)s)")
    parser.add_argument("--options", default="", help='of meshrepair, such as "--for print"')
    parser.add_argument("--limit-seconds", type=float, default=float("inf"), help="begin no mesh after this time (default: none)")
    parser.add_argument("--timeout", type=float, default=600, help="seconds for one run, which is left out then (default: %(default)s)")
    result = parser.parse_args()
    if len({way.name for way in result.ways}) < max(2, len(result.ways)):
        parser.error("two ways at least, with different names")
    if not result.meshes.is_dir():
        parser.error(f"there is no folder {result.meshes}")
    return result


def contents(path):
    """Of a report a dictionary from the path of a key to its value, of another file its bytes."""
    if path.name != REPORT:
        return path.read_bytes()
    try:
        return dict(values_of(json.loads(path.read_text()), ""))
    except ValueError:
        return path.read_bytes()


def values_of(value, path):
    if isinstance(value, (dict, list)):
        yield path, type(value).__name__
        for key, inner in value.items() if isinstance(value, dict) else enumerate(value):
            if key not in OWN_KEYS:
                yield from values_of(inner, f"{path}.{key}".lstrip("."))
    else:
        yield path, value


def described(value):
    if isinstance(value, bytes):
        return f"{len(value)} bytes, SHA-256 {hashlib.sha256(value).hexdigest()[:16]}"
    return "none" if value is None else json.dumps(value) if not isinstance(value, dict) else "a report"


def difference(first, other):
    """In words, None if there is none."""
    if first == other and type(first) is type(other):
        return None
    if isinstance(first, dict) and isinstance(other, dict):
        keys = [key for key in first | other if first.get(key) != other.get(key)]
        return f"{len(keys)} keys; {keys[0]}: {described(first.get(keys[0]))}; {described(other.get(keys[0]))}"
    text = f"{described(first)}; {described(other)}"
    if isinstance(first, bytes) and isinstance(other, bytes):
        text += f"; from byte {next(i for i, (a, b) in enumerate(itertools.zip_longest(first, other)) if a != b)}"
    return text


def runs_of(mesh, before, options, formats):
    """A name and the words of each run. A mesh is found from where a program runs."""
    path, other = (Path("../../meshes", one.name) for one in (mesh, before))
    more = ("--threads", 1, "-q", "--report", REPORT)
    for extension in formats:
        yield extension, ("meshrepair", path, f"out.{extension}", *more, *options)
    yield "check", ("meshcheck", path, *more)
    if formats:
        yield "reduced", ("meshrepair", path, "out.obj", "--triangles", "50%", *more, *options)
        yield "union", ("bspbool", path, other, "--op", "union", "-o", "out.obj", *more)


def compare(mesh, before, args, folder):
    """For each output of each other way a row: run, name, way, difference or None. And how many runs took too long."""
    rows, late = [], 0
    for name, words in runs_of(mesh, before, shlex.split(args.options), [f for f in args.formats.split(",") if f]):
        left = {}
        for way in args.ways:
            left[way.name] = way.run(folder / way.name / f"{mesh.name}.{name}", args.timeout, *words)
            late += left[way.name] is None
        first, *others = left.items()
        for way, files in others:
            if first[1] is not None and files is not None:
                rows += [(name, file, way, difference(first[1].get(file), files.get(file))) for file in first[1] | files]
    return rows, late


def print_table(rows):
    widths = [max(len(row[column]) for row in rows) for column in range(4)]
    for row in rows:
        print("  ".join([text.ljust(width) for text, width in zip(row, widths)] + [row[4]]))


def main():
    args = arguments()
    meshes = [path for path in args.meshes.iterdir() if path.suffix.lower() in MESHES]
    meshes.sort(key=lambda path: (path.stat().st_size, path.name))
    start = time.monotonic()
    files, outputs, late, different = 0, 0, 0, []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "meshes").symlink_to(args.meshes.resolve())
        for before, mesh in zip(meshes[:1] + meshes, meshes):
            if time.monotonic() - start > args.limit_seconds:
                break
            rows, slow = compare(mesh, before, args, folder)
            files += 1
            outputs += len(rows)
            late += slow
            different += [(mesh.name, *row) for row in rows if row[3]]
            print(f"same_on_systems: {mesh.name}: {len(rows)} outputs, {sum(1 for row in rows if row[3])} differ", file=sys.stderr)
    if different:
        print_table([("mesh", "run", "output", "way", f"{args.ways[0].name}; the other"), *different])
    print(f"{files} files, {outputs} outputs, {len(different)} differ" + (f", {late} runs took too long" if late else ""))
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
