#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Boolean operations on pairs of solids, by bspbool and by CGAL's corefinement: do they agree?

The second solid of each pair is turned at random, brought to the size of the first and placed so that the two cross. Prints a
line for each pair: the largest difference of the volumes of union, intersection and difference, as a share of the volumes that
go in, the largest two-sided distance between the results, as a share of their diagonal, and the times. The exit code is 0 if
bspbool certifies all its results, and they agree within 1e-6 with all that CGAL gives.

Example: compare_booleans.py build/release/bin build/tables/bin/cgal_booleans a.off b.obj c.stl --pairs 50
"""

import argparse
import itertools
import json
import math
import os
import random
import subprocess
import sys
import tempfile

OPERATIONS = ("union", "intersection", "difference")
AGREED = 1e-6


def read_off(path):
    with open(path, encoding="ascii") as file:
        words = iter([word for line in file for word in line.split("#")[0].split()])
    assert next(words) == "OFF"
    points, faces, _ = (int(next(words)) for _ in range(3))
    corners = [tuple(float(next(words)) for _ in range(3)) for _ in range(points)]
    return corners, [[int(next(words)) for _ in range(int(next(words)))] for _ in range(faces)]


def write_off(path, mesh):
    points, faces = mesh
    with open(path, "w", encoding="ascii") as file:
        file.write(f"OFF\n{len(points)} {len(faces)} 0\n")
        file.writelines("%r %r %r\n" % p for p in points)
        file.writelines(f"{len(f)} {' '.join(map(str, f))}\n" for f in faces)


def box_of(points):
    return [(min(p[i] for p in points), max(p[i] for p in points)) for i in range(3)]


def diagonal_of(box):
    return math.sqrt(sum((high - low) ** 2 for low, high in box))


def random_rotation(rng):
    a, b, c, d = (rng.gauss(0, 1) for _ in range(4))
    n = math.sqrt(a * a + b * b + c * c + d * d)
    a, b, c, d = a / n, b / n, c / n, d / n
    return ((1 - 2 * (c * c + d * d), 2 * (b * c - a * d), 2 * (b * d + a * c)),
            (2 * (b * c + a * d), 1 - 2 * (b * b + d * d), 2 * (c * d - a * b)),
            (2 * (b * d - a * c), 2 * (c * d + a * b), 1 - 2 * (b * b + c * c)))


def placed(mesh, beside, rng):
    """Turned, of the other's size, its middle near a corner of the other."""
    points, faces = mesh
    box, other = box_of(points), box_of(beside)
    turn, scale = random_rotation(rng), diagonal_of(other) / diagonal_of(box)
    middle = [(low + high) / 2 for low, high in box]
    onto = rng.choice(beside)
    shift = [onto[i] + 0.1 * diagonal_of(other) * rng.uniform(-1, 1) for i in range(3)]
    moved = []
    for p in points:
        q = [scale * (p[i] - middle[i]) for i in range(3)]
        moved.append(tuple(sum(turn[i][k] * q[k] for k in range(3)) + shift[i] for i in range(3)))
    return moved, faces


def run(command, timeout):
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=timeout, check=False)
        return done.returncode, done.stdout, done.stderr
    except subprocess.TimeoutExpired:
        return 124, "", f"no result after {timeout} s"


class Pair:
    def __init__(self, args, folder):
        self.args, self.folder = args, folder
        self.volume = self.distance = 0.0
        self.seconds = {"ours": 0.0, "cgal": 0.0}
        self.faults, self.cgal_faults = [], []

    def path(self, name):
        return os.path.join(self.folder, name)

    def ours(self, operation):
        report = self.path("report.json")
        code, _, errors = run([os.path.join(self.args.bin, "bspbool"), self.path("a.off"), self.path("b.off"), "--op", operation,
                               "-o", self.path("ours.off"), "--report", report, "--quiet"], self.args.timeout)
        if code != 0:
            self.faults.append(f"bspbool {operation}: exit {code} {errors.strip()}")
            return None
        with open(report, encoding="utf-8") as file:
            read = json.load(file)
        self.seconds["ours"] += read["seconds"]
        return read["result"]["volume"] if "result" in read else 0.0

    def cgal(self, operation):
        code, text, errors = run([self.args.cgal, self.path("a.off"), self.path("b.off"), operation, self.path("cgal.off")],
                                 self.args.timeout)
        said = json.loads(text) if text.startswith("{") else {"error": errors.strip()[:100] or f"exit {code}"}
        if "error" in said or not said["closed"]:
            self.cgal_faults.append(f"CGAL {operation}: {said.get('error', 'not closed')}")
            return None
        self.seconds["cgal"] += said["read_seconds"] + said["seconds"]
        return said["volume"]

    def compare(self, operation, given):
        mine, other = self.ours(operation), self.cgal(operation)
        if mine is None or other is None:
            return
        self.volume = max(self.volume, abs(mine - other) / given)
        if self.volume > AGREED:
            self.faults.append(f"{operation}: volumes {mine!r} and {other!r}")
        code, text, errors = run([os.path.join(self.args.bin, "meshdist"), self.path("ours.off"), self.path("cgal.off"),
                                  "--samples", str(self.args.samples), "--json", "--quiet"], self.args.timeout)
        if code != 0:
            self.faults.append(f"meshdist: {errors.strip()}")
            return
        distance = json.loads(text)["distance"]
        apart = distance["hausdorff"] / distance["diagonal"]
        self.distance = max(self.distance, apart)
        if apart > AGREED:
            self.faults.append(f"{operation}: distance {apart:.2g}")


def volume_of(mesh):
    points, faces = mesh
    total = 0.0
    for face in faces:
        a = points[face[0]]
        for k in range(1, len(face) - 1):
            b, c = points[face[k]], points[face[k + 1]]
            total += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                      a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
    return total


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", help="folder of meshrepair, bspbool and meshdist")
    parser.add_argument("cgal", help="the program cgal_booleans (bench/others)")
    parser.add_argument("meshes", nargs="+", help="closed meshes without faults, two or more")
    parser.add_argument("--pairs", type=int, default=50, metavar="N", help="how many [%(default)s]")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of the placements [%(default)s]")
    parser.add_argument("--samples", type=int, default=50000, metavar="N", help="of the distance, on each mesh [%(default)s]")
    parser.add_argument("--timeout", type=float, default=300, metavar="SECONDS", help="of each program [%(default)s]")
    return parser.parse_args()


def load(args, folder):
    meshes = {}
    for path in args.meshes:
        out = os.path.join(folder, "mesh.off")
        code, _, errors = run([os.path.join(args.bin, "meshrepair"), path, out, "--quiet"], args.timeout)
        if code != 0:
            sys.exit(f"{path}: {errors.strip()}")
        meshes[os.path.basename(path)] = read_off(out)
    return meshes


def compare_pair(args, folder, first, second, rng):
    while True:
        pair = Pair(args, folder)
        write_off(pair.path("a.off"), first)
        moved = placed(second, first[0], rng)
        write_off(pair.path("b.off"), moved)
        common = pair.ours("intersection")
        if common == 0:
            continue  # they lie apart
        given = volume_of(first) + volume_of(moved)
        pair = Pair(args, folder)
        for operation in OPERATIONS:
            pair.compare(operation, given)
        return pair


def main():
    args = arguments()
    rng = random.Random(args.seed)
    failed, cgal_failed, worst = 0, 0, [0.0, 0.0]
    with tempfile.TemporaryDirectory() as folder:
        meshes = load(args, folder)
        pairs = itertools.islice(itertools.cycle(itertools.combinations(meshes, 2)), args.pairs)
        print(f"{'pair':64} {'volume':>9} {'distance':>9} {'ours, s':>8} {'CGAL, s':>8}")
        for first, second in pairs:
            pair = compare_pair(args, folder, meshes[first], meshes[second], rng)
            print(f"{first + ' ' + second:64} {pair.volume:9.2g} {pair.distance:9.2g} {pair.seconds['ours']:8.2f} "
                  f"{pair.seconds['cgal']:8.2f}", flush=True)
            for fault in pair.faults + pair.cgal_faults:
                print("    " + fault, flush=True)
            failed += bool(pair.faults)
            cgal_failed += bool(pair.cgal_faults)
            worst = [max(worst[0], pair.volume), max(worst[1], pair.distance)]
    print(f"{args.pairs} pairs: {failed} wrong or apart, {cgal_failed} without a result of CGAL; at most {worst[0]:.2g} of the volume "
          f"and {worst[1]:.2g} of the diagonal apart")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
