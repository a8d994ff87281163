#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Shrinks a mesh that a program fails on, to one of few triangles that it fails on as well.

Runs COMMAND on smaller and smaller meshes, {} standing for the name of the mesh, and keeps what leaves the
outcome as it is. Triangles are dropped by halves, quarters and so on down to single ones; with --simplify
points are then merged with their neighbours and coordinates rounded.

By default the outcome is the exit code and the last line on stderr, numbers and names of files in it aside.

Examples:
  minimize.py bad.stl -o small.off -- build/release/bin/meshrepair {} out.obj
  minimize.py bad.obj -o small.off --exit-code 1 --simplify -- build/release/bin/meshrepair -q {} out.obj
  minimize.py bad.ply -o small.obj --stderr 'internal error' -- build/release/bin/bspbuild {} -o out.bsp
  minimize.py slow.obj -o small.off --hang --timeout 20 -- build/release/bin/meshrepair {} out.obj

Reads STL, OBJ, OFF and PLY, in text and binary, as plainly as such programs write them; polygons are cut into
fans. Writes OBJ or OFF, which keep every bit of a coordinate.
"""

import argparse
import hashlib
import math
import pathlib
import re
import struct
import subprocess
import sys
import tempfile


# ---- meshes: points as triples of floats, triangles as triples of their numbers

class Mesh:
    def __init__(self, points, triangles):
        self.points, self.triangles = points, triangles

    def with_triangles(self, triangles):
        """These triangles, without points that none of them uses."""
        used = sorted({i for triangle in triangles for i in triangle})
        place = {old: new for new, old in enumerate(used)}
        return Mesh([self.points[i] for i in used],
                    [tuple(place[i] for i in triangle) for triangle in triangles])

    def to_bytes(self, suffix):
        rows = [" ".join(map(repr, point)) for point in self.points]
        if suffix == ".obj":
            lines = ["v " + row for row in rows]
            lines += ["f " + " ".join(str(i + 1) for i in t) for t in self.triangles]
        else:
            lines = ["OFF", f"{len(self.points)} {len(self.triangles)} 0", *rows]
            lines += ["3 " + " ".join(map(str, t)) for t in self.triangles]
        return ("\n".join(lines) + "\n").encode()


def fan(corners):
    return [(corners[0], b, c) for b, c in zip(corners[1:], corners[2:])]


def of_corners(corners):
    """A mesh of three corners for each triangle, those at one place being one point."""
    number, triangles = {}, []
    for at in range(0, len(corners) - 2, 3):
        triangles.append(tuple(number.setdefault(tuple(p), len(number)) for p in corners[at:at + 3]))
    return Mesh(list(number), triangles)


def read_stl(data):
    if len(data) >= 84 and len(data) == 84 + 50 * struct.unpack_from("<I", data, 80)[0]:
        numbers = [struct.unpack_from("<9f", data, at + 12) for at in range(84, len(data), 50)]
        return of_corners([row[k:k + 3] for row in numbers for k in (0, 3, 6)])
    words = data.decode(errors="replace").split()
    return of_corners([tuple(map(float, words[i + 1:i + 4]))
                       for i, word in enumerate(words) if word.lower() == "vertex"])


def read_obj(data):
    points, triangles = [], []
    for line in data.decode(errors="replace").replace("\\\n", " ").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append(tuple(map(float, words[1:4])))
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) for word in words[1:]]
            triangles += fan([i - 1 if i > 0 else len(points) + i for i in corners])
    return Mesh(points, triangles)


def read_off(data):
    words = re.sub(r"#.*", "", data.decode(errors="replace")).split()
    if words and words[0].upper() == "OFF":
        words = words[1:]
    count, faces = int(words[0]), int(words[1])
    numbers = list(map(float, words[3:3 + 3 * count]))
    points = [tuple(numbers[i:i + 3]) for i in range(0, 3 * count, 3)]
    triangles, at = [], 3 + 3 * count
    for _ in range(faces):
        corners = int(words[at])
        triangles += fan(list(map(int, words[at + 1:at + 1 + corners])))
        at += 1 + corners
    return Mesh(points, triangles)


PLY_TYPES = {"char": "b", "int8": "b", "uchar": "B", "uint8": "B", "short": "h", "int16": "h", "ushort": "H",
             "uint16": "H", "int": "i", "int32": "i", "uint": "I", "uint32": "I", "float": "f",
             "float32": "f", "double": "d", "float64": "d"}


def ply_header(data):
    end = re.search(rb"end_header\r?\n", data).end()
    order, elements = "", []
    for line in data[:end].decode(errors="replace").splitlines():
        words = line.split()
        if words[0] == "format":
            order = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}[words[1]]
        elif words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            elements[-1][2].append(words[1:])
    return order, elements, end


def read_ply(data):
    order, elements, at = ply_header(data)
    words = iter(data[at:].split()) if not order else None

    def number(kind):
        nonlocal at
        if not order:
            word = next(words)
            return float(word) if PLY_TYPES[kind] in "fd" else int(word)
        value = struct.unpack_from(order + PLY_TYPES[kind], data, at)[0]
        at += struct.calcsize(order + PLY_TYPES[kind])
        return value

    points, triangles = [], []
    for name, count, properties in elements:
        for _ in range(count):
            values = {}
            for words_of in properties:
                if words_of[0] == "list":
                    values[words_of[3]] = [number(words_of[2]) for _ in range(int(number(words_of[1])))]
                else:
                    values[words_of[1]] = number(words_of[0])
            if name == "vertex":
                points.append(tuple(float(values[axis]) for axis in "xyz"))
            elif name == "face":
                triangles += fan(values.get("vertex_indices") or values.get("vertex_index"))
    return Mesh(points, triangles)


def read_mesh(path):
    data = path.read_bytes()
    if data.startswith(b"ply"):
        return read_ply(data)
    return {".stl": read_stl, ".obj": read_obj, ".off": read_off}[path.suffix.lower()](data)


# ---- the outcome of a command

class Outcome:
    def __init__(self, exit_code, last_line, text):
        self.exit_code, self.last_line, self.text = exit_code, last_line, text

    @property
    def hung(self):
        return self.exit_code is None

    def __str__(self):
        return "no end in time" if self.hung else f"exit code {self.exit_code}, '{self.last_line}'"


def kind_of(line):
    """The line without what differs from mesh to mesh."""
    line = re.sub(r"\S*/\S*", "FILE", line)
    return re.sub(r"[-+]?\d[\d.,]*(e[-+]?\d+)?", "N", line)


class Runner:
    """Runs the command on meshes in a folder of its own, each mesh once."""

    def __init__(self, command, suffix, timeout, folder):
        self.path = pathlib.Path(folder) / ("mesh" + suffix)
        self.command = [word.replace("{}", str(self.path)) for word in command]
        self.suffix, self.timeout = suffix, timeout
        self.runs = 0

    def run(self, mesh):
        self.runs += 1
        self.path.write_bytes(mesh.to_bytes(self.suffix))
        try:
            result = subprocess.run(self.command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                    stderr=subprocess.PIPE, timeout=self.timeout)
        except subprocess.TimeoutExpired:
            return Outcome(None, "", "")
        text = result.stderr.decode(errors="replace")
        return Outcome(result.returncode, kind_of((text.strip().splitlines() or [""])[-1]), text)


def judge_of(options, first):
    """The function that tells whether an outcome is the one looked for."""
    if options.hang:
        return lambda outcome: outcome.hung
    if options.exit_code is None and options.stderr is None:
        if first.hung:
            sys.exit("minimize.py: the command does not end on the full mesh: use --hang, or --timeout")
        return lambda o: (o.exit_code, o.last_line) == (first.exit_code, first.last_line)
    return lambda o: not o.hung and (options.exit_code in (None, o.exit_code)) and \
        (options.stderr is None or re.search(options.stderr, o.text) is not None)


# ---- shrinking

class Shrinker:
    def __init__(self, mesh, is_interesting):
        self.mesh = mesh
        self.is_interesting = is_interesting
        self.seen = {self.key(mesh)}

    @staticmethod
    def key(mesh):
        """Not the mesh itself: of a large one very many are tried."""
        return hashlib.sha256(repr((mesh.points, mesh.triangles)).encode()).digest()

    def accept(self, mesh):
        """Goes on from this mesh if the command still fails on it."""
        key = self.key(mesh)
        if not mesh.triangles or key in self.seen:
            return False
        self.seen.add(key)
        if not self.is_interesting(mesh):
            return False
        self.mesh = mesh
        print(f"{len(mesh.triangles)} triangles, {len(mesh.points)} points", file=sys.stderr)
        return True

    def drop_triangles(self):
        size = max(1, len(self.mesh.triangles) // 2)
        while True:
            dropped = self.drop_chunks(size)
            if size == 1 and not dropped:
                return
            if size > 1 and not dropped:
                size = size // 2
            size = max(1, min(size, len(self.mesh.triangles) // 2))

    def drop_chunks(self, size):
        at, dropped = 0, False
        while at < len(self.mesh.triangles):
            rest = self.mesh.triangles[:at] + self.mesh.triangles[at + size:]
            if self.accept(self.mesh.with_triangles(rest)):
                dropped = True
            else:
                at += size
        return dropped

    def simplify(self):
        """Whole passes until one gains nothing; each makes the mesh simpler, so they end."""
        while self.merge_points() or self.round_coordinates():
            self.drop_triangles()

    def merge_points(self):
        """Points into neighbours of lower number; what has two equal corners then goes."""
        for a, b in sorted({(t[i], t[j]) for t in self.mesh.triangles
                            for i in range(3) for j in range(3) if t[i] < t[j]}):
            merged = [tuple(a if i == b else i for i in t) for t in self.mesh.triangles]
            if self.accept(self.mesh.with_triangles([t for t in merged if len(set(t)) == 3])):
                return True
        return False

    def round_coordinates(self):
        gained = False
        for point in range(len(self.mesh.points)):
            for axis in range(3):
                gained |= self.round_coordinate(point, axis)
        return gained

    def round_coordinate(self, point, axis):
        value = self.mesh.points[point][axis]
        for simple in simpler_numbers(value):
            points = [list(p) for p in self.mesh.points]
            points[point][axis] = simple
            if self.accept(Mesh([tuple(p) for p in points], self.mesh.triangles)):
                return True
        return False


def simpler_numbers(value):
    """Zero, then ever more digits; none that takes as many digits as the number itself."""
    if value == 0 or not math.isfinite(value):
        return
    yield 0.0
    for digits in (1, 2, 4, 8):
        rounded = float(f"{value:.{digits - 1}e}")
        if rounded == value:
            return
        yield rounded


def parse_options():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
        usage="%(prog)s MESH -o SMALL [OPTION...] -- COMMAND {}")
    parser.add_argument("mesh", metavar="MESH", type=pathlib.Path)
    parser.add_argument("-o", dest="output", metavar="SMALL", type=pathlib.Path, required=True,
                        help="where the small mesh goes: .obj or .off")
    parser.add_argument("--exit-code", type=int, metavar="N", help="the outcome is this exit code")
    parser.add_argument("--stderr", metavar="REGEX", help="the outcome is a match of this on stderr")
    parser.add_argument("--timeout", type=float, default=60, metavar="S",
                        help="a run that takes longer (default: 60 seconds) hangs")
    parser.add_argument("--hang", action="store_true", help="the outcome is that it hangs")
    parser.add_argument("--simplify", action="store_true", help="merge points and round coordinates, too")
    if "--" not in sys.argv:
        if {"-h", "--help"} & set(sys.argv):
            parser.parse_args(["--help"])
        parser.error("no command: -- COMMAND {} comes last")
    split = sys.argv.index("--")
    options = parser.parse_args(sys.argv[1:split])
    options.command = sys.argv[split + 1:]
    if not any("{}" in word for word in options.command):
        parser.error("the command has no {} for the name of the mesh")
    if options.output.suffix not in (".obj", ".off"):
        parser.error("SMALL has to end in .obj or .off")
    if options.hang and (options.exit_code is not None or options.stderr is not None):
        parser.error("--hang excludes --exit-code and --stderr")
    return options


def main():
    options = parse_options()
    try:
        mesh = read_mesh(options.mesh)
    except (OSError, KeyError, ValueError, IndexError, AttributeError, TypeError, struct.error,
            StopIteration) as error:
        print(f"minimize.py: {options.mesh}: cannot be read: {error!r}", file=sys.stderr)
        return 3
    suffix = options.output.suffix
    with tempfile.TemporaryDirectory(prefix="minimize_") as folder:
        runner = Runner(options.command, suffix, options.timeout, folder)
        first = runner.run(mesh)
        is_the_one = judge_of(options, first)
        if not is_the_one(first):
            print(f"minimize.py: on the full mesh the outcome is another one: {first}", file=sys.stderr)
            return 1
        shrinker = Shrinker(mesh, lambda smaller: is_the_one(runner.run(smaller)))
        shrinker.drop_triangles()
        if options.simplify:
            shrinker.simplify()
        options.output.write_bytes(shrinker.mesh.to_bytes(suffix))
        print(f"{options.output}: {len(shrinker.mesh.triangles)} of {len(mesh.triangles)} triangles after "
              f"{runner.runs} runs: {first}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
