# SPDX-License-Identifier: MIT
"""Meshes as people have them who want to print, to simulate, or to use what a generator made; and a scan."""

import math
from collections.abc import Callable

from . import textures
from .shapes import Material, Mesh, Vector, near, rounded, sphere, turned

PLAIN = Material("plain", b"")  # for formats without textures


def block(low: Vector, high: Vector, material: Material = PLAIN) -> Mesh:
    """A box of twelve triangles."""
    mesh = Mesh([material], places=[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    mesh.points = [rounded((x, y, z)) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
    for side in ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)):
        mesh.add([(point, place) for place, point in enumerate(side)])
    return mesh


def lathe(outline: list[tuple[float, float]], sides: int, material: Material = PLAIN) -> Mesh:
    low, high = min(z for _, z in outline), max(z for _, z in outline)
    return turned([(radius, z, (z - low) / (high - low)) for radius, z in outline], sides, material)


def rod(radius: float, low: float, high: float, sides: int, material: Material = PLAIN) -> Mesh:
    return lathe([(0.0, low), (radius, low), (radius, high), (0.0, high)], sides, material)


def around(angle: float) -> Callable[[Vector], Vector]:
    cosine, sine = math.cos(angle), math.sin(angle)
    return lambda p: (cosine * p[0] - sine * p[1], sine * p[0] + cosine * p[1], p[2])


def flag() -> Mesh:
    """One sheet, and nothing behind it."""
    mesh = Mesh([PLAIN], places=[(0.0, 0.0)])
    steps = 16
    for i in range(steps + 1):
        x = 0.4 + 17 * i / steps
        mesh.points += [rounded((x, 1.6 * math.sin(0.45 * x), z)) for z in (63.0, 73.0)]
    for i in range(steps):
        mesh.add([(2 * i, 0), (2 * i + 2, 0), (2 * i + 3, 0), (2 * i + 1, 0)])
    return mesh


def rook() -> Mesh:
    """A piece of chess in millimetres: parts stuck into each other, no floor, a hole, turned triangles, a flag, a crumb."""
    outline = [(14.0, 0.0), (14.0, 4.0), (12.0, 5.5), (11.0, 8.0), (8.5, 14.0)]
    outline += [(8.5 - 1.2 * math.sin(math.pi * i / 8), 14.0 + 20.0 * i / 8) for i in range(1, 9)]
    outline += [(10.0, 38.0), (12.0, 40.0), (12.0, 48.0), (8.5, 48.0), (8.5, 44.0), (0.0, 44.0)]
    mesh = lathe(outline, 48)
    mesh.drop(near((-3.0, -7.0, 22.0), 3.5))
    for k in range(6):
        mesh.add_mesh(block((8.0, -2.5, 45.0), (12.5, 2.5, 53.0)).moved(around(math.pi * k / 3)))
    mesh.add_mesh(rod(0.9, 42.0, 74.0, 12))
    mesh.flip(lambda t: textures.hashed(t, 0, 3) < 0.06)
    mesh.add_mesh(flag())
    mesh.add_mesh(block((20.0, 0.0, 30.0), (20.2, 0.2, 30.2)))
    return mesh


def bracket() -> Mesh:
    """Parts of a CAD program that nobody has united: they overlap, and share faces."""
    mesh = block((-40.0, -20.0, 0.0), (40.0, 20.0, 6.0))
    mesh.add_mesh(block((34.0, -20.0, 0.0), (40.0, 20.0, 45.0)))
    for y in (-14.0, 11.0):
        rib = Mesh([PLAIN], places=[(0.0, 0.0)])
        rib.points = [(x, y + dy, z) for dy in (0.0, 3.0) for x, z in ((8.0, 6.0), (34.0, 6.0), (34.0, 40.0))]
        for side in ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)):
            rib.add([(point, 0) for point in side])
        mesh.add_mesh(rib)
    mesh.add_mesh(rod(11.0, 0.0, 24.0, 40).moved(lambda p: (p[0] - 22.0, p[1], p[2])))
    mesh.add_mesh(rod(5.0, 2.0, 24.5, 40).moved(lambda p: (p[0] - 22.0, p[1], p[2])))
    mesh.add_mesh(block((20.0, -4.0, 46.0), (20.1, -3.9, 46.1)))
    return mesh


def robot() -> Mesh:
    """As generators make it: shells in each other, a body of two walls with a pinhole, nothing united. With y up."""
    body = [(0.02, 0.25), (0.45, 0.25), (0.6, 0.4), (0.68, 0.8), (0.66, 1.3), (0.5, 1.55), (0.0, 1.62)]
    inner = [(0.0, 1.54), (0.46, 1.48), (0.58, 1.27), (0.6, 0.82), (0.53, 0.45), (0.4, 0.33), (0.02, 0.33), (0.02, 0.25)]
    mesh = lathe(body + inner, 48, Material("glaze", textures.png(textures.glaze())))
    metal, stripes = (Material(name, textures.png(make())) for name, make in
                      (("metal", textures.metal), ("stripes", textures.stripes)))
    for size in (0.5, 0.42):
        mesh.add_mesh(sphere(20, 40, stripes).moved(lambda p: (size * p[0], size * p[1], size * p[2] + 1.85)))
    for side in (-1, 1):
        mesh.add_mesh(rod(0.09, 0.0, 0.55, 20, metal).moved(lambda p: (p[0] + 0.25 * side, p[1], p[2])))
        arm = rod(0.11, -0.1, 0.75, 20, metal).moved(lambda p: (side * (p[2] + 0.45), side * p[1], 0.5 * p[2] - p[0] + 0.9))
        mesh.add_mesh(arm)
        mesh.add_mesh(sphere(12, 24, metal).moved(lambda p: (0.1 * p[0] + 0.17 * side, 0.1 * p[1] - 0.45, 0.1 * p[2] + 1.95)))
    return mesh.moved(lambda p: (p[0], p[2], -p[1]))


def pawn_points() -> list[Vector]:
    """A scan of a pawn that stood on a table, in places that the scanner saw."""
    outline = [(14.0 - 0.6 * i, 0.7 * i) for i in range(7)]
    outline += [(5.0 + 4.8 * math.exp(-i / 8), 4.9 + 0.8 * i) for i in range(28)]
    outline += [(5.4 + 3.0 * math.sin(math.pi * i / 9), 27.3 + 0.28 * i) for i in range(10)]
    outline += [(7.5 * math.sin(t), 35.5 - 7.5 * math.cos(t)) for t in (0.8 + 0.1 * i for i in range(23))]
    hidden = near((2.5, -6.0, 16.0), 2.8)
    points = []
    for ring, (radius, z) in enumerate(outline):
        count = max(1, round(2 * math.pi * radius / 0.8))
        for k in range(count):
            angle = 2 * math.pi * (k + 0.5 * (ring % 2)) / count
            points.append(rounded((radius * math.cos(angle), radius * math.sin(angle), z)))
    return [point for point in points if not hidden(point)]
