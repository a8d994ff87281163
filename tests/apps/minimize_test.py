#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Shrinks meshes with a known smallest one, by scripts/minimize.py.

Usage: minimize_test.py MINIMIZE_PY [CASE]; the cases are the functions called test_...
"""

import pathlib
import random
import struct
import subprocess
import sys
import tempfile

# A program that fails on meshes with these two triangles.
FAILING = """
import sys
sys.dont_write_bytecode = True  # a copy that is cut on a full disk would end all later runs
sys.path.insert(0, {folder!r})
import minimize, pathlib
mesh = minimize.read_mesh(pathlib.Path(sys.argv[1]))
levels = {{min(mesh.points[i][2] for i in t) for t in mesh.triangles}}
if {{7.25, 11.5}} <= levels:
    print('note')
    print('mesh %s: %d triangles fail' % (sys.argv[1], len(mesh.triangles)), file=sys.stderr)
    sys.exit(9)
sys.exit(0)
"""
# Hangs on them, and ends at once on others: no program that takes long to start, for on a busy machine it could reach the limit.
HANGING = ["sh", "-c", "if grep -q ' 7.25$' $0 && grep -q ' 11.5$' $0; then exec sleep 3600; fi", "{}"]


def some_mesh():
    """Triangles on levels of their own."""
    chance = random.Random(1)
    points, triangles = [], []
    for level in [i * 0.75 + 100 for i in range(24)] + [7.25, 11.5]:
        triangles.append(tuple(range(len(points), len(points) + 3)))
        points += [(chance.randint(0, 99) / 8, chance.randint(0, 99) / 8, level + k) for k in range(3)]
    chance.shuffle(triangles)
    return points, triangles


def as_obj(points, triangles):
    text = "".join("v %r %r %r\n" % p for p in points)
    return (text + "".join("f %d/1 %d %d\n" % tuple(i + 1 for i in t) for t in triangles)).encode()


def as_off(points, triangles):
    text = "OFF # a comment\n%d %d 0\n" % (len(points), len(triangles))
    text += "".join("%r %r %r\n" % p for p in points)
    return (text + "".join("3 %d %d %d\n" % t for t in triangles)).encode()


def as_ascii_stl(points, triangles):
    text = "solid s\n"
    for t in triangles:
        text += "facet normal 0 0 0\nouter loop\n"
        text += "".join("vertex %r %r %r\n" % points[i] for i in t) + "endloop\nendfacet\n"
    return (text + "endsolid\n").encode()


def as_binary_stl(points, triangles):
    data = bytes(80) + struct.pack("<I", len(triangles))
    for t in triangles:
        data += bytes(12) + struct.pack("<9f", *(x for i in t for x in points[i])) + bytes(2)
    return data


def as_ply(order):
    def write(points, triangles):
        kind = {"": "ascii", "<": "binary_little_endian", ">": "binary_big_endian"}[order]
        data = (f"ply\nformat {kind} 1.0\nelement vertex {len(points)}\nproperty double x\nproperty float y\n"
                "property double z\nproperty uchar red\n"
                f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n").encode()
        for x, y, z in points:
            data += struct.pack(order + "dfdB", x, y, z, 1) if order else f"{x!r} {y!r} {z!r} 1\n".encode()
        for t in triangles:
            data += struct.pack(order + "B3i", 3, *t) if order else b"3 %d %d %d\n" % t
        return data
    return write


class Bench:
    def __init__(self, script, folder):
        self.script, self.folder = pathlib.Path(script), pathlib.Path(folder)
        self.small = self.folder / "small.off"

    def program(self):
        path = self.folder / "failing.py"
        path.write_text(FAILING.format(folder=str(self.script.parent)))
        return [sys.executable, str(path), "{}"]

    def minimize(self, data, name, *options, program=None):
        mesh = self.folder / name
        mesh.write_bytes(data)
        return subprocess.run([sys.executable, self.script, mesh, "-o", self.small, *options, "--",
                               *(program or self.program())], stderr=subprocess.PIPE, text=True)

    def expect_two_triangles(self, data, name, *options, program=None):
        result = self.minimize(data, name, *options, program=program)
        lines = self.small.read_text().splitlines() if self.small.exists() else ["none"]
        self.small.unlink(missing_ok=True)
        if result.returncode != 0 or lines[1] != "6 2 0":
            sys.exit(f"{name} {options}: exit code {result.returncode}, {lines[:2]}\n{result.stderr}")
        return lines


def test_formats(bench):
    mesh = some_mesh()
    for name, write in {"a.obj": as_obj, "a.off": as_off, "b.stl": as_ascii_stl, "c.STL": as_binary_stl,
                        "a.ply": as_ply(""), "b.ply": as_ply("<"), "c.ply": as_ply(">")}.items():
        lines = bench.expect_two_triangles(write(*mesh), name)
        points = [tuple(map(float, line.split())) for line in lines[2:8]]
        if not set(points) <= set(mesh[0]):
            sys.exit(f"{name}: coordinates have changed: {points}")


def test_outcomes(bench):
    data = as_obj(*some_mesh())
    for options in (["--exit-code", "9"], ["--stderr", "triangles fail$"],
                    ["--exit-code", "9", "--stderr", "mesh .*: [0-9]+"]):
        bench.expect_two_triangles(data, "a.obj", *options)
    for options in (["--exit-code", "8"], ["--stderr", "no such thing"], ["--hang"]):
        if bench.minimize(data, "a.obj", *options).returncode != 1:
            sys.exit(f"{options}: another outcome on the full mesh was not refused")


def test_hang(bench):
    points, triangles = some_mesh()
    few = [t for t in triangles if points[t[0]][2] < 104]
    bench.expect_two_triangles(as_obj(points, few), "a.obj", "--hang", "--timeout", "2", program=HANGING)


def test_simplify(bench):
    lines = bench.expect_two_triangles(as_obj(*some_mesh()), "a.obj", "--simplify")
    if any(line.split()[:2] != ["0.0", "0.0"] for line in lines[2:8]):
        sys.exit(f"coordinates that do not matter are still there: {lines}")


def main():
    cases = {name[5:]: case for name, case in globals().items() if name.startswith("test_")}
    for name, case in cases.items():
        if sys.argv[2:] and name not in sys.argv[2:]:
            continue
        with tempfile.TemporaryDirectory(prefix="minimize_test_") as folder:
            case(Bench(sys.argv[1], folder))


if __name__ == "__main__":
    main()
