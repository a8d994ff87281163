#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the meshes in samples/meshes: small shapes, each with the defects that its name tells.

The same files come out on every machine: coordinates are rounded to six decimals before anything is
written, and nothing but the seed below is random.

Usage: make_sample_meshes.py [--check]   (--check: compare with what is there, write nothing)
"""

import math
import pathlib
import random
import struct
import sys

FOLDER = pathlib.Path(__file__).resolve().parent.parent / "samples" / "meshes"


class Mesh:
    """Points and triangles (counter-clockwise seen from outside), points shared by index."""

    def __init__(self, points, triangles):
        self.points = [tuple(round(c, 6) + 0.0 for c in point) for point in points]
        self.triangles = [tuple(triangle) for triangle in triangles]

    def moved(self, dx, dy, dz):
        return Mesh([(x + dx, y + dy, z + dz) for x, y, z in self.points], self.triangles)

    def flipped(self):
        return Mesh(self.points, [(a, c, b) for a, b, c in self.triangles])

    def __add__(self, other):
        shift = len(self.points)
        return Mesh(self.points + other.points,
                    self.triangles + [tuple(i + shift for i in t) for t in other.triangles])

    def without(self, condition):
        """Without the triangles whose centre fulfils the condition: a hole."""
        return Mesh(self.points, [t for t in self.triangles if not condition(*self.centre(t))])

    def with_some_flipped(self, share, seed):
        chance = random.Random(seed)
        return Mesh(self.points, [(a, c, b) if chance.random() < share else (a, b, c)
                                  for a, b, c in self.triangles])

    def centre(self, triangle):
        return tuple(sum(self.points[i][axis] for i in triangle) / 3 for axis in range(3))

    def compact(self):
        """Without points that no triangle uses."""
        used = sorted({i for t in self.triangles for i in t})
        place = {old: new for new, old in enumerate(used)}
        return Mesh([self.points[i] for i in used],
                    [tuple(place[i] for i in t) for t in self.triangles])


def box(width, depth, height, cells=1):
    """Centred on the origin; each side is a grid of cells by cells squares."""
    half = (width / 2, depth / 2, height / 2)
    points, place, triangles = [], {}, []

    def point(steps):
        if steps not in place:
            place[steps] = len(points)
            points.append([half[axis] * (2 * steps[axis] / cells - 1) for axis in range(3)])
        return place[steps]

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for end in (0, cells):
            for i in range(cells):
                for j in range(cells):
                    corners = []
                    for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        steps = [0, 0, 0]
                        steps[axis], steps[u], steps[v] = end, i + di, j + dj
                        corners.append(point(tuple(steps)))
                    if end == 0:
                        corners.reverse()
                    a, b, c, d = corners
                    triangles += [(a, b, c), (a, c, d)]
    return Mesh(points, triangles)


def torus(radius, tube, around, across):
    points, triangles = [], []
    for i in range(around):
        for j in range(across):
            a, b = 2 * math.pi * i / around, 2 * math.pi * j / across
            ring = radius + tube * math.cos(b)
            points.append((ring * math.cos(a), ring * math.sin(a), tube * math.sin(b)))
    for i in range(around):
        for j in range(across):
            here, next_i = i * across, (i + 1) % around * across
            next_j = (j + 1) % across
            a, b, c, d = here + j, next_i + j, next_i + next_j, here + next_j
            triangles += [(a, b, c), (a, c, d)]
    return Mesh(points, triangles)


def sphere(radius, rings, around):
    points = [(0, 0, -radius)]
    for i in range(1, rings):
        angle = math.pi * i / rings - math.pi / 2
        for j in range(around):
            turn = 2 * math.pi * j / around
            points.append((radius * math.cos(angle) * math.cos(turn),
                           radius * math.cos(angle) * math.sin(turn), radius * math.sin(angle)))
    points.append((0, 0, radius))
    top = len(points) - 1
    triangles = []
    for j in range(around):
        k = (j + 1) % around
        triangles.append((0, 1 + k, 1 + j))
        triangles.append((top, top - around + j, top - around + k))
        for i in range(rings - 2):
            below, above = 1 + i * around, 1 + (i + 1) * around
            triangles += [(below + j, below + k, above + k), (below + j, above + k, above + j)]
    return Mesh(points, triangles)


def torus_through_box():
    """Crosses itself, has two holes, and one triangle in twelve is flipped."""
    shape = torus(1.0, 0.35, 48, 20) + box(1.2, 1.2, 1.2, 6).moved(1.0, 0.1, 0.05)
    shape = shape.without(lambda x, y, z: (x + 1.0) ** 2 + y ** 2 + (z - 0.35) ** 2 < 0.04)
    shape = shape.without(lambda x, y, z: x > 1.59 and abs(y - 0.1) < 0.2 and abs(z - 0.05) < 0.2)
    return shape.with_some_flipped(1 / 12, seed=1).compact()


def three_spheres():
    """Each crosses the others; one of them is inside out, one has a hole, and some triangles are doubled."""
    whole = sphere(1.0, 16, 24)
    holed = whole.moved(1.1, 0.2, 0.1).without(lambda x, y, z: x > 1.95)
    mesh = whole + holed + whole.moved(0.5, 1.0, -0.1).flipped()
    return Mesh(mesh.points, mesh.triangles + mesh.triangles[100:120]).compact()


def open_bowl():
    """Two walls, one in the other, that nothing joins at the rim: a gap as wide as the wall."""
    outside = sphere(1.0, 20, 32).without(lambda x, y, z: z > 0)
    inside = sphere(0.9, 20, 32).flipped().without(lambda x, y, z: z > 0)
    return (outside + inside).compact()


def hollow_sphere():
    return sphere(1.0, 16, 24) + sphere(0.6, 12, 18).flipped()


def overlapping_spheres():
    return sphere(1.0, 16, 24) + sphere(0.8, 14, 20).moved(0.9, 0.3, 0.2)


def number(value):
    return f"{value:.6f}".rstrip("0").rstrip(".")


def row(point):
    return " ".join(number(c) for c in point)


def to_obj(mesh):
    lines = ["v " + row(p) for p in mesh.points]
    lines += ["f " + " ".join(str(i + 1) for i in t) for t in mesh.triangles]
    return ("\n".join(lines) + "\n").encode()


def to_off(mesh):
    lines = ["OFF", f"{len(mesh.points)} {len(mesh.triangles)} 0"]
    lines += [row(p) for p in mesh.points]
    lines += ["3 " + " ".join(map(str, t)) for t in mesh.triangles]
    return ("\n".join(lines) + "\n").encode()


def to_ply(mesh):
    head = ["ply", "format ascii 1.0", f"element vertex {len(mesh.points)}", "property float x",
            "property float y", "property float z", f"element face {len(mesh.triangles)}",
            "property list uchar int vertex_indices", "end_header"]
    lines = head + [row(p) for p in mesh.points]
    lines += ["3 " + " ".join(map(str, t)) for t in mesh.triangles]
    return ("\n".join(lines) + "\n").encode()


def to_ascii_stl(mesh):
    lines = ["solid sample"]
    for triangle in mesh.triangles:
        lines += ["  facet normal 0 0 0", "    outer loop"]
        lines += ["      vertex " + row(mesh.points[i]) for i in triangle]
        lines += ["    endloop", "  endfacet"]
    lines.append("endsolid sample")
    return ("\n".join(lines) + "\n").encode()


def to_binary_stl(mesh):
    data = [b"binary STL".ljust(80), struct.pack("<I", len(mesh.triangles))]
    for triangle in mesh.triangles:
        corners = [c for i in triangle for c in mesh.points[i]]
        data.append(struct.pack("<12fH", 0, 0, 0, *corners, 0))
    return b"".join(data)


FILES = {
    "broken_torus_box.stl": lambda: to_binary_stl(torus_through_box()),
    "broken_spheres.obj": lambda: to_obj(three_spheres()),
    "cube.stl": lambda: to_ascii_stl(box(1, 1, 1)),
    "overlapping_spheres.off": lambda: to_off(overlapping_spheres()),
    "open_bowl.ply": lambda: to_ply(open_bowl()),
    "hollow_sphere.obj": lambda: to_obj(hollow_sphere()),
}


def main():
    if sys.argv[1:] not in ([], ["--check"]):
        print(__doc__.strip(), file=sys.stdout if sys.argv[1:] == ["--help"] else sys.stderr)
        return 0 if sys.argv[1:] == ["--help"] else 2
    different = 0
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name, make in FILES.items():
        path, data = FOLDER / name, make()
        if not sys.argv[1:]:
            path.write_bytes(data)
        elif not path.exists() or path.read_bytes() != data:
            print(f"{path} is not what this script makes")
            different += 1
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
