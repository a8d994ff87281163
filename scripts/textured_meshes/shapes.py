# SPDX-License-Identifier: MIT
"""Shapes whose corners have places in textures, and what is broken about them.

Coordinates are rounded to six digits, so that the same come out everywhere.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from . import textures

Vector = tuple[float, ...]
Corner = tuple[int, int]  # numbers of a point and of a place in the texture


@dataclass
class Material:
    name: str
    texture: bytes  # a PNG


@dataclass
class Mesh:
    """Triangles are counter-clockwise seen from outside."""

    materials: list[Material]
    points: list[Vector] = field(default_factory=list)
    places: list[Vector] = field(default_factory=list)
    triangles: list[tuple[Corner, Corner, Corner]] = field(default_factory=list)
    material_of: list[int] = field(default_factory=list)  # of each triangle

    def add(self, corners: list[Corner], material: int = 0) -> None:
        """A triangle, or a quadrangle as two."""
        for k in range(1, len(corners) - 1):
            triangle = (corners[0], corners[k], corners[k + 1])
            if len({point for point, _ in triangle}) == 3:
                self.triangles.append(triangle)
                self.material_of.append(material)

    def add_mesh(self, other: "Mesh") -> None:
        point, place, material = len(self.points), len(self.places), len(self.materials)
        self.points += other.points
        self.places += other.places
        self.materials += other.materials
        self.triangles += [tuple((p + point, q + place) for p, q in triangle) for triangle in other.triangles]
        self.material_of += [number + material for number in other.material_of]

    def moved(self, move: Callable[[Vector], Vector]) -> "Mesh":
        self.points = [rounded(move(point)) for point in self.points]
        return self

    def middle(self, triangle) -> Vector:
        return tuple(sum(self.points[p][axis] for p, _ in triangle) / 3 for axis in range(3))

    def drop(self, condition: Callable[[Vector], bool]) -> None:
        """The triangles whose middle fulfils it: a hole."""
        keep = [not condition(self.middle(triangle)) for triangle in self.triangles]
        self.material_of = [number for number, kept in zip(self.material_of, keep) if kept]
        self.triangles = [triangle for triangle, kept in zip(self.triangles, keep) if kept]

    def flip(self, condition: Callable[[int], bool]) -> None:
        self.triangles = [(a, c, b) if condition(t) else (a, b, c) for t, (a, b, c) in enumerate(self.triangles)]

    def duplicate(self, condition: Callable[[int], bool]) -> None:
        chosen = [t for t in range(len(self.triangles)) if condition(t)]
        self.triangles += [self.triangles[t] for t in chosen]
        self.material_of += [self.material_of[t] for t in chosen]


def rounded(numbers: Vector) -> Vector:
    return tuple(round(number, 6) + 0.0 for number in numbers)


def turned(profile: list[tuple[float, float, float]], sides: int, material: Material) -> Mesh:
    """Around the z axis, of (radius, height, v) from below on the outside; where the radius is 0 it is closed.

    Points of a ring are shared all around, but places in the texture are not: there is a seam.
    """
    mesh = Mesh([material])
    rings = []
    for radius, height, v in profile:
        first = len(mesh.points)
        count = sides if radius > 0 else 1
        for k in range(count):
            angle = 2 * math.pi * k / sides
            mesh.points.append(rounded((radius * math.cos(angle), radius * math.sin(angle), height)))
        place = len(mesh.places)
        mesh.places += [rounded((k / sides, v)) for k in range(sides + 1)]
        rings.append([(first + k % count, place + k) for k in range(sides + 1)])
    for below, above in zip(rings, rings[1:]):
        for k in range(sides):
            mesh.add([below[k], below[k + 1], above[k + 1], above[k]])
    return mesh


def sphere(stacks: int, sides: int, material: Material) -> Mesh:
    profile = [(math.sin(math.pi * i / stacks) if 0 < i < stacks else 0, -math.cos(math.pi * i / stacks), i / stacks)
               for i in range(stacks + 1)]
    return turned(profile, sides, material)


def near(middle: Vector, radius: float) -> Callable[[Vector], bool]:
    return lambda point: math.dist(point, middle) < radius


def globe() -> Mesh:
    """A sphere with two holes, one of them over the seam of the texture."""
    mesh = sphere(32, 64, Material("globe", textures.png(textures.globe())))
    mesh.drop(near((0.5, -0.72, 0.48), 0.33))
    mesh.drop(near((0.97, 0.02, 0.2), 0.22))
    return mesh


def twins() -> Mesh:
    """Two spheres of different materials in each other, each with a hole. With y up."""
    def place(offset: float, size: float) -> Callable[[Vector], Vector]:
        return lambda p: (size * p[0] + offset, size * p[2], -size * p[1])

    mesh = sphere(24, 48, Material("stripes", textures.png(textures.stripes()))).moved(place(-0.5, 1.0))
    mesh.drop(near((-0.8, 0.55, 0.8), 0.28))
    other = sphere(24, 48, Material("checks", textures.png(textures.checks()))).moved(place(0.75, 0.8))
    other.drop(near((1.05, 0.45, 0.58), 0.26))
    mesh.add_mesh(other)
    return mesh


def vase() -> Mesh:
    """With an outer and an inner wall, a seam of the texture, and a patch missing from the outer one."""
    outline = [(0.0, 0.0), (0.42, 0.0), (0.46, 0.04)]
    for i in range(1, 28):
        height = 0.04 + 2.0 * i / 28
        outline.append((0.62 + 0.26 * math.sin(2.6 * height - 0.7) - 0.05 * height * height, height))
    rim_radius, rim_height = outline[-1]
    outline.append((rim_radius + 0.02, rim_height + 0.06))
    inner = [(radius - 0.1, height + 0.02) for radius, height in reversed(outline[4:])]
    profile = [(r, h, h / 2.1) for r, h in outline] + [(r, h, h / 2.1) for r, h in inner] + [(0.0, 0.2, 0.1)]
    mesh = turned(profile, 56, Material("glaze", textures.png(textures.glaze())))
    in_hole = near((0.62, -0.52, 1.0), 0.3)
    mesh.drop(lambda point: in_hole(point) and math.hypot(point[0], point[1]) > 0.77)  # not of the inner wall
    return mesh


def box(material: Material, size: float, cells: int) -> Mesh:
    """A cube around the origin. Each side has the whole texture, and points of its own only in the texture."""
    mesh = Mesh([material])
    number: dict[Vector, int] = {}
    sides = [((1, 0, 0), (0, 1, 0), (0, 0, 1)), ((-1, 0, 0), (0, -1, 0), (0, 0, 1)), ((0, 1, 0), (-1, 0, 0), (0, 0, 1)),
             ((0, -1, 0), (1, 0, 0), (0, 0, 1)), ((0, 0, 1), (0, 1, 0), (-1, 0, 0)), ((0, 0, -1), (0, 1, 0), (1, 0, 0))]
    for out, right, up in sides:
        grid = {}
        for i in range(cells + 1):
            for j in range(cells + 1):
                s, t = (2 * k / cells - 1 for k in (i, j))
                point = rounded(tuple(size * (out[a] + s * right[a] + t * up[a]) for a in range(3)))
                if point not in number:
                    number[point] = len(mesh.points)
                    mesh.points.append(point)
                grid[i, j] = (number[point], len(mesh.places))
                mesh.places.append(rounded((i / cells, j / cells)))
        for i in range(cells):
            for j in range(cells):
                mesh.add([grid[i, j], grid[i + 1, j], grid[i + 1, j + 1], grid[i, j + 1]])
    return mesh


def crate() -> Mesh:
    """A box that a pole pierces, and a hole in each."""
    mesh = box(Material("planks", textures.png(textures.planks())), 0.8, 6)
    mesh.drop(near((0.2, -0.8, -0.35), 0.3))
    profile = [(0.0, -1.4, 0.0)] + [(0.32, -1.4 + 2.8 * i / 14, i / 14) for i in range(15)] + [(0.0, 1.4, 1.0)]
    pole = turned(profile, 40, Material("metal", textures.png(textures.metal())))
    slope = 0.35
    cosine, sine = math.cos(slope), math.sin(slope)
    pole.moved(lambda p: (p[0], cosine * p[1] - sine * p[2], sine * p[1] + cosine * p[2]))
    pole.drop(near((0.25, -0.56, 1.05), 0.14))
    mesh.add_mesh(pole)
    return mesh


def island() -> Mesh:
    """A block of land with flipped, doubled and missing triangles. With y up."""
    cells = 40
    mesh = Mesh([Material("ground", textures.png(textures.ground())), Material("strata", textures.png(textures.strata()))])
    place_of = {}
    for i in range(cells + 1):
        for j in range(cells + 1):
            u, v = i / cells, j / cells
            height = 0.9 * max(0.42, textures.hills(u, v, 3, 2, 3)) - 0.2
            mesh.points.append(rounded((2 * u - 1, height, 1 - 2 * v)))
            mesh.places.append(rounded((u, v)))
            place_of[i, j] = (i * (cells + 1) + j,) * 2
    for i in range(cells):
        for j in range(cells):
            mesh.add([place_of[i, j], place_of[i + 1, j], place_of[i + 1, j + 1], place_of[i, j + 1]])
    rim = [(i, 0) for i in range(cells)] + [(cells, j) for j in range(cells)] + \
          [(i, cells) for i in range(cells, 0, -1)] + [(0, j) for j in range(cells, 0, -1)]
    add_walls(mesh, [place_of[at][0] for at in rim])
    mesh.flip(lambda t: textures.hashed(t, 0, 7) < 0.04)
    mesh.duplicate(lambda t: textures.hashed(t, 1, 7) < 0.05)
    mesh.drop(near((0.3, 0.3, 0.55), 0.17))
    return mesh


def add_walls(mesh: Mesh, rim: list[int]) -> None:
    """From the points of the rim, counter-clockwise seen from above, down to a floor."""
    depth = -0.35
    below, upper, lower = [], [], []
    for k, point in enumerate(rim):
        x, height, z = mesh.points[point]
        below.append(len(mesh.points))
        mesh.points.append(rounded((x, depth, z)))
        upper.append(len(mesh.places))
        lower.append(len(mesh.places) + 1)
        mesh.places += [rounded((8 * k / len(rim), height - depth)), rounded((8 * k / len(rim), 0))]
    for k, point in enumerate(rim):
        n = (k + 1) % len(rim)
        mesh.add([(point, upper[k]), (below[k], lower[k]), (below[n], lower[n]), (rim[n], upper[n])], 1)
    middle = (len(mesh.points), len(mesh.places))
    mesh.points.append((0.0, depth, 0.0))
    mesh.places.append((0.0, 0.0))
    for k in range(len(rim)):
        n = (k + 1) % len(rim)
        mesh.add([(below[n], lower[n]), (below[k], lower[k]), middle], 1)
