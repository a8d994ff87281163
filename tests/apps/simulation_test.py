#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""From broken meshes to what meshers and solvers make of meshbodies' results: TetGen, Gmsh and CalculiX.

Usage: simulation_test.py PROGRAMS

A test whose programs are not installed is skipped.
"""

import json
import math
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAMS = pathlib.Path()
SECONDS = 300  # for what takes one on an idle machine

SIDES = ((0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3))


def box(low, high):
    """Points and triangles, counter-clockwise seen from outside."""
    points = [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
    return points, list(SIDES)


def cylinder(centre, radius, low, high, sides=24):
    points = [(centre[0], centre[1], low), (centre[0], centre[1], high)]
    for i in range(sides):
        x = centre[0] + radius * math.cos(2 * math.pi * i / sides)
        y = centre[1] + radius * math.sin(2 * math.pi * i / sides)
        points += [(x, y, low), (x, y, high)]
    triangles = []
    for i in range(sides):
        a, b = 2 + 2 * i, 2 + 2 * ((i + 1) % sides)
        triangles += [(0, b, a), (1, a + 1, b + 1), (a, b, b + 1), (a, b + 1, a + 1)]
    return points, triangles


def joined(*meshes):
    points, triangles = [], []
    for more_points, more in meshes:
        triangles += [tuple(p + len(points) for p in t) for t in more]
        points += more_points
    return points, triangles


def write_off(path, mesh):
    points, triangles = mesh
    path.write_text(f"OFF\n{len(points)} {len(triangles)} 0\n" + "".join("%r %r %r\n" % p for p in points) +
                    "".join("3 %d %d %d\n" % t for t in triangles))


def volume_of(corners):
    a, b, c, d = corners
    u, v, w = ([q[i] - a[i] for i in range(3)] for q in (b, c, d))
    return abs(u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0])) / 6


def need(test, *programs):
    for program in programs:
        if not shutil.which(program):
            test.skipTest(f"{program} is not installed")


def run(*command):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=SECONDS)


def tetrahedra_of_tetgen(path):
    """The volume of all tetrahedra of each region."""
    def rows(suffix):
        lines = [line.split() for line in path.with_suffix(suffix).read_text().splitlines() if not line.startswith("#")]
        return lines[1:1 + int(lines[0][0])]
    nodes = {row[0]: tuple(map(float, row[1:4])) for row in rows(".1.node")}
    volumes = {}
    for row in rows(".1.ele"):
        region = round(float(row[5]))
        volumes[region] = volumes.get(region, 0) + volume_of([nodes[n] for n in row[1:5]])
    return volumes


class GmshMesh:
    """Of a file in the format of Abaqus: nodes, and the tetrahedra of each region."""

    def __init__(self, path):
        self.nodes, self.tetrahedra, self.regions = {}, {}, {}
        keyword, name = "", ""
        for line in path.read_text().splitlines():
            if line.startswith("*"):
                keyword = line.split(",")[0].lower() if "type=C3D4" not in line else "tetrahedra"
                name = re.sub(r".*ELSET=", "", line, flags=re.I)
            elif keyword == "*node":
                number, *place = line.split(",")
                self.nodes[int(number)] = tuple(map(float, place))
            elif keyword == "tetrahedra":
                number, *corners = map(int, line.split(","))
                self.tetrahedra[number] = corners
            elif keyword == "*elset":
                self.regions.setdefault(name, set()).update(int(n) for n in line.split(",") if n.strip())

    def region(self, name):
        return {n: self.tetrahedra[n] for n in self.regions[name] if n in self.tetrahedra}

    def volume(self, name):
        return sum(volume_of([self.nodes[n] for n in corners]) for corners in self.region(name).values())


class Simulation(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="simulation_")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def divide(self, meshes, output, *options):
        """The section of the report; each mesh is a pair of a name and a mesh."""
        files = []
        for name, mesh in meshes:
            files.append(self.folder / f"{name}.off")
            write_off(files[-1], mesh)
        done = run(PROGRAMS / "meshbodies", *files, "-o", self.folder / output, "--report", self.folder / "report.json", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads((self.folder / "report.json").read_text())["bodies"]

    def gmsh(self, name):
        done = run("gmsh", "-3", self.folder / f"{name}.geo", "-format", "inp", "-o", self.folder / f"{name}.inp")
        self.assertNotIn("Error", done.stdout + done.stderr)
        self.assertEqual(done.returncode, 0)
        return GmshMesh(self.folder / f"{name}.inp")

    def test_random_assemblies(self):
        need(self, "tetgen", "gmsh")
        for seed in range(12):
            rng = random.Random(seed)
            meshes = []
            for i in range(rng.randint(2, 4)):
                low = [rng.randint(0, 3) for _ in range(3)]
                mesh = box(low, [x + rng.randint(1, 2) for x in low])
                if rng.random() < 0.4:
                    mesh = cylinder((rng.uniform(0, 4), rng.uniform(0, 4)), rng.uniform(0.3, 1), 0, rng.uniform(1, 4), 8)
                meshes.append((f"b{i}", mesh))
            with self.subTest(seed=seed):
                overlap = ("--overlap", rng.choice(("first", "last", "smaller", "own")))
                bodies = self.divide(meshes, "all.poly", *overlap)
                self.divide(meshes, "all.msh", *overlap)
                done = run("tetgen", "-pAQ", self.folder / "all.poly")
                self.assertEqual(done.returncode, 0, done.stdout)
                volumes = tetrahedra_of_tetgen(self.folder / "all.poly")
                mesh = self.gmsh("all")
                for region in bodies["regions"]:
                    self.assertAlmostEqual(volumes.get(region["region"], 0), region["volume"], delta=1e-6 * bodies["volume"])
                    if region["triangles"]:
                        self.assertAlmostEqual(mesh.volume(region["name"]), region["volume"], delta=1e-6 * bodies["volume"])

    def test_a_loaded_bracket(self):
        """Steel, of plates that overlap, one of them inside out, with a bolt of aluminium through it, which carries the load."""
        need(self, "gmsh", "ccx")
        rib = box((0, 8, 0), (20, 12, 20))
        rib = rib[0], [(a, c, b) for a, b, c in rib[1]]
        bracket = joined(box((0, 0, 0), (4, 20, 40)), box((0, 0, 0), (40, 20, 4)), rib)
        bracket[1].append(bracket[1][0])  # twice there
        bolt = cylinder((32, 10), 3, -2, 8)
        bodies = self.divide([("bracket", bracket), ("bolt", bolt)], "part.msh", "--overlap", "last")
        mesh = self.gmsh("part")
        for region in bodies["regions"]:
            self.assertAlmostEqual(mesh.volume(region["name"]), region["volume"], delta=1e-6 * bodies["volume"])
        steel, aluminium = mesh.region("bracket"), mesh.region("bolt")
        common = {n for t in steel.values() for n in t} & {n for t in aluminium.values() for n in t}
        self.assertGreaterEqual(len(common), 2 * 24)  # both bodies have the nodes of their common faces
        fixed = [n for n, place in mesh.nodes.items() if abs(place[0]) < 1e-9]
        loaded = [n for n, place in mesh.nodes.items() if abs(place[2] - 8) < 1e-9 and n in {m for t in aluminium.values() for m in t}]
        force, reactions = -100.0, self.solve(mesh, steel, aluminium, fixed, loaded, -100.0)
        self.assertAlmostEqual(reactions[0], 0, delta=1e-3)
        self.assertAlmostEqual(reactions[1], 0, delta=1e-3)
        self.assertAlmostEqual(reactions[2], -force, delta=1e-3)

    def solve(self, mesh, steel, aluminium, fixed, loaded, force):
        """The sum of the reactions where the bracket is fixed."""
        used = {n for t in (*steel.values(), *aluminium.values()) for n in t}
        lines = ["*NODE, NSET=ALL"] + ["%d, %r, %r, %r" % (n, *mesh.nodes[n]) for n in sorted(used)]
        for name, tetrahedra, modulus, ratio in (("STEEL", steel, 210000, 0.3), ("ALU", aluminium, 70000, 0.33)):
            lines += [f"*ELEMENT, TYPE=C3D4, ELSET={name}"] + ["%d, %d, %d, %d, %d" % (n, *corners) for n, corners in tetrahedra.items()]
            lines += [f"*MATERIAL, NAME={name}", "*ELASTIC", f"{modulus}, {ratio}", f"*SOLID SECTION, ELSET={name}, MATERIAL={name}"]
        lines += ["*NSET, NSET=FIXED"] + [f"{n}," for n in fixed] + ["*BOUNDARY", "FIXED, 1, 3"]
        lines += ["*STEP", "*STATIC", "*CLOAD"] + [f"{n}, 3, {force / len(loaded)!r}" for n in loaded]
        lines += ["*NODE PRINT, NSET=FIXED, TOTALS=ONLY", "RF", "*END STEP"]
        (self.folder / "job.inp").write_text("\n".join(lines) + "\n")
        done = subprocess.run(["ccx", "-i", "job"], cwd=self.folder, capture_output=True, text=True, timeout=SECONDS)
        self.assertEqual(done.returncode, 0, done.stdout)
        numbers = (self.folder / "job.dat").read_text().split("total force")[1].splitlines()[2]
        return [float(x) for x in numbers.split()]


if __name__ == "__main__":
    PROGRAMS = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
