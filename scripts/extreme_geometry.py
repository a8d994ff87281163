#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Repairs shapes of extreme geometry, each made for it, and prints what comes of them and how long it takes.

The exit code is 0 if each ended as documented, and what was certified is a valid solid to meshcheck.
"""

import argparse
import json
import math
import os
import random
import subprocess
import sys
import tempfile

DOCUMENTED = (0, 1, 4, 5, 6)
ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")


def box(low, high):
    points = [tuple((low, high)[i >> axis & 1][axis] for axis in range(3)) for i in range(8)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return points, [t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))]


def sphere(rings=50, radius=1.0, centre=(0, 0, 0)):
    sides = 2 * rings
    points = [(centre[0], centre[1], centre[2] + radius), (centre[0], centre[1], centre[2] - radius)]
    for ring in range(1, rings):
        down = math.pi * ring / rings
        for side in range(sides):
            turn = 2 * math.pi * side / sides
            points.append((centre[0] + radius * math.sin(down) * math.cos(turn),
                           centre[1] + radius * math.sin(down) * math.sin(turn),
                           centre[2] + radius * math.cos(down)))
    at = lambda ring, side: 2 + (ring - 1) * sides + side % sides
    triangles = []
    for side in range(sides):
        triangles.append((0, at(1, side), at(1, side + 1)))
        triangles.append((1, at(rings - 1, side + 1), at(rings - 1, side)))
        for ring in range(1, rings - 1):
            a, b = at(ring, side), at(ring, side + 1)
            c, d = at(ring + 1, side), at(ring + 1, side + 1)
            triangles += [(a, c, b), (b, c, d)]
    return points, triangles


def united(*meshes):
    points, triangles = [], []
    for more, faces in meshes:
        first = len(points)
        points += more
        triangles += [tuple(first + corner for corner in face) for face in faces]
    return points, triangles


def changed(mesh, function):
    return [function(point) for point in mesh[0]], mesh[1]


def scaled(mesh, by):
    return changed(mesh, lambda p: tuple(by * x for x in p))


def double_cone(sides):
    points = [(0, 0, 1), (0, 0, -1)]
    points += [(math.cos(2 * math.pi * i / sides), math.sin(2 * math.pi * i / sides), 0) for i in range(sides)]
    triangles = []
    for i in range(sides):
        a, b = 2 + i, 2 + (i + 1) % sides
        triangles += [(0, a, b), (1, b, a)]
    return points, triangles


def star(sides):
    """A double cone whose rim goes up and down and in and out at random, so it is all spikes."""
    chance = random.Random(1)
    points, triangles = double_cone(sides)
    for i in range(2, len(points)):
        reach, height = chance.uniform(0.5, 1), chance.uniform(-0.2, 0.2)
        points[i] = (reach * points[i][0], reach * points[i][1], height)
    return points, triangles


def random_fan(triangles):
    """Triangles with one corner in common and nothing else; each crosses many others."""
    chance = random.Random(2)
    points = [(0, 0, 0)]
    faces = []
    for i in range(triangles):
        a = [chance.gauss(0, 1) for _ in range(3)]
        b = [x + 0.02 * chance.gauss(0, 1) for x in a]
        points += [tuple(a), tuple(b)]
        faces.append((0, 2 * i + 1, 2 * i + 2))
    return points, faces


def city(blocks):
    chance = random.Random(3)
    houses = []
    for x in range(blocks):
        for y in range(blocks):
            height = chance.uniform(1, 20)
            houses.append(box((10 * x, 10 * y, 0), (10 * x + 6, 10 * y + 6, height)))
    return united(*houses)


def sponge(level):
    """Menger's, as the boxes that it is made of, which share faces."""
    boxes = [(0, 0, 0)]
    for _ in range(level):
        boxes = [(3 * x + i, 3 * y + j, 3 * z + k) for x, y, z in boxes
                 for i in range(3) for j in range(3) for k in range(3)
                 if (i == 1) + (j == 1) + (k == 1) < 2]
    return united(*[box(b, tuple(x + 1 for x in b)) for b in boxes])


def koch_prism(level):
    corners = [complex(0, 0), complex(1, 0), complex(0.5, -math.sqrt(0.75))]
    for _ in range(level):
        longer = []
        for i, a in enumerate(corners):
            d = (corners[(i + 1) % len(corners)] - a) / 3
            longer += [a, a + d, a + d + d * complex(0.5, math.sqrt(0.75)), a + 2 * d]
        corners = longer
    n = len(corners)
    points = [(c.real, c.imag, z) for z in (0, 0.1) for c in corners]
    walls = [t for i in range(n) for a, b in [(i, (i + 1) % n)] for t in ((b, a, n + a), (b, n + a, n + b))]
    return points, [tuple(range(n)), tuple(reversed(range(n, 2 * n)))] + walls


def folded_strip(folds):
    """A tube of square section, folded to and fro in the same place, so that every wall lies on others."""
    tubes = [box((0, 0, i), (10, 1, i + 1)) for i in range(folds)]
    tubes += [box((9 * (i % 2), 0, i), (9 * (i % 2) + 1, 1, i + 2)) for i in range(folds - 1)]
    return united(*tubes)


def crumpled(size):
    """A closed sheet, thrown together: a sphere whose points are moved by half its radius."""
    chance = random.Random(4)
    return changed(sphere(size), lambda p: tuple(x + chance.uniform(-0.5, 0.5) for x in p))


def repeated(mesh, times):
    return mesh[0], mesh[1] * times


CASES = {
    "sphere of 1e38": lambda: scaled(sphere(), 1e38),
    "sphere of 1e-38": lambda: scaled(sphere(), 1e-38),
    "sphere of 1e300": lambda: scaled(sphere(), 1e300),
    "sphere of 1e-300": lambda: scaled(sphere(), 1e-300),
    "spheres of 1 and 1e-3, times 1e104": lambda: scaled(united(sphere(), sphere(20, 1e-3, (1.5, 0, 0))), 1e104),
    "spheres of 1 and 1e-3, times 1e-106": lambda: scaled(united(sphere(), sphere(20, 1e-3, (1.5, 0, 0))), 1e-106),
    "spheres of 1 and 1e-6, apart": lambda: united(sphere(), sphere(20, 1e-6, (1.5, 0.3, 0.2))),
    "spheres of 1 and 1e-6, crossing": lambda: united(sphere(), sphere(20, 1e-6, (0, 0, 1))),
    "spheres of 1 and 1e-9, apart": lambda: united(sphere(), sphere(20, 1e-9, (1.5, 0.3, 0.2))),
    "sphere of 1 at 1e6": lambda: sphere(50, 1.0, (1e6, -1e6, 1e6)),
    "crossing spheres of 1 at 1e6": lambda: united(sphere(50, 1.0, (1e6, -1e6, 1e6)),
                                                   sphere(50, 1.0, (1e6 + 0.7, -1e6, 1e6))),
    "box of 1 x 1 x 1e-6": lambda: box((0, 0, 0), (1, 1, 1e-6)),
    "box of 1 x 1 x 1e-12": lambda: box((0, 0, 0), (1, 1, 1e-12)),
    "100,000 times one triangle": lambda: ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)] * 100_000),
    "a cube, each face 10,000 times": lambda: repeated(box((0, 0, 0), (1, 1, 1)), 10_000),
    "double cone of 100,000 triangles": lambda: double_cone(50_000),
    "spiky double cone of 100,000": lambda: star(50_000),
    "fan of 2,000 crossing triangles": lambda: random_fan(2_000),
    "city of 10,000 houses": lambda: city(100),
    "the same under one triangle": lambda: united(
        city(100), ([(-9e3, -9e3, 5), (9e3, -9e3, 5.5), (0, 9e3, 6)], [(0, 1, 2)])),
    "Menger sponge of 8,000 cubes": lambda: sponge(3),
    "prism of a Koch curve, 12,288 sides": lambda: koch_prism(6),
    "strip in 200 folds": lambda: folded_strip(200),
    "crumpled sheet of 4,800 triangles": lambda: crumpled(25),
    "all corners on a line": lambda: ([(i, 2 * i, 3 * i) for i in range(999)],
                                      [(i, i + 1, i + 2) for i in range(997)]),
    "all corners in a plane": lambda: ([(i % 30, i // 30, i % 30 + i // 30) for i in range(900)],
                                       [(i, i + 1, i + 31) for i in range(860)]),
    "all corners in one point": lambda: ([(3, 4, 5)] * 99, [(i, i + 1, i + 2) for i in range(97)]),
    "tetrahedron, a needle of 1e12 to 1": lambda: ([(0, 0, 0), (1e12, 0, 0), (0, 1, 0), (0, 0, 1)],
                                                     [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]),
}


def write_off(path, mesh):
    points, triangles = mesh
    with open(path, "w", encoding="ascii") as file:
        file.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        file.writelines("%r %r %r\n" % tuple(float(x) for x in p) for p in points)
        file.writelines(f"{len(t)} {' '.join(map(str, t))}\n" for t in triangles)


def run(name, make, folder, arguments):
    source, output = os.path.join(folder, "in.off"), os.path.join(folder, "out" + arguments.format)
    report = os.path.join(folder, "report.json")
    mesh = make()
    write_off(source, mesh)
    for path in (output, report):
        if os.path.exists(path):
            os.remove(path)
    result = subprocess.run([arguments.meshrepair, source, output, "--quiet", "--always", "--report", report,
                             "--time-limit", str(arguments.time_limit)],
                            capture_output=True, text=True, check=False)
    with open(report, encoding="utf-8") as file:
        told = json.load(file)
    if os.path.exists(output):
        check = subprocess.run([arguments.meshcheck, output], capture_output=True, check=False)
        what = told["result"]
        outcome = (f"{what['triangles']} triangles, {what['parts']} parts, volume {what['volume']:.6g}"
                   if what["volume"] is not None else f"{what['triangles']} triangles, {what['parts']} parts")
        outcome += "" if check.returncode == 0 or result.returncode == 1 else ", NO VALID SOLID"
    else:
        outcome = (told["error"] or "").removeprefix(source + ": ")
    if result.returncode == 1:
        outcome += "; " + result.stderr.strip().splitlines()[-1].split(", but ")[-1]
    memory = told["peak_memory_bytes"] / 2**20
    print(f"{name:<38} {len(mesh[1]):>8} {result.returncode:>4} {told['seconds']:>7.2f} {memory:>6.0f}  {outcome}",
          flush=True)
    return result.returncode in DOCUMENTED and "NO VALID SOLID" not in outcome


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", help="words of the cases to run; all, if there are none")
    parser.add_argument("--format", default=".obj", help="extension of the output (%(default)s)")
    parser.add_argument("--time-limit", type=float, default=120, metavar="SECONDS", help="(%(default)s)")
    parser.add_argument("--meshrepair", default=f"{ROOT}/build/release/bin/meshrepair")
    parser.add_argument("--meshcheck", default=f"{ROOT}/build/release/bin/meshcheck")
    arguments = parser.parse_args()
    sound = True
    print(f"{'input':<38} {'faces':>8} {'exit':>4} {'s':>7} {'MB':>6}  result")
    with tempfile.TemporaryDirectory() as folder:
        for name, make in CASES.items():
            if not arguments.names or any(word in name for word in arguments.names):
                sound &= run(name, make, folder, arguments)
    return 0 if sound else 1


if __name__ == "__main__":
    sys.exit(main())
