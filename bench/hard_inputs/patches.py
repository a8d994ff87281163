# SPDX-License-Identifier: MIT
"""Patches of CAD models, each divided into triangles by itself: at each seam, the two sides have other points. What was
meant is the body with seams that fit."""

import numpy as np

from .bodies import CUBE_FACES, HoledPlate, cube_face, torus_points
from .meshes import Case, joined, patch, random_turn, turned, welded

SHAPES = ("plate", "blob", "torus", "capsule")
FINE = 48  # rows and columns of a patch of the solid


def blob(random):
    """Six patches: a cube whose faces bulge to a superellipsoid with waves."""
    exponent = random.uniform(2, 4)
    stretch = random.uniform(0.6, 1.4, 3)
    waves = random.uniform(-0.08, 0.08, 3)

    def place(points):
        length = (np.abs(points) ** exponent).sum(axis=1) ** (1 / exponent)
        on = points / length[:, None]
        bulge = 1 + (waves * np.sin(3 * on)).sum(axis=1)
        return on * bulge[:, None] * stretch
    return [lambda u, v, f=face: place(cube_face(*f, u, v)) for face in CUBE_FACES]


def torus_patches(random):
    across, around = int(random.integers(2, 5)), int(random.integers(3, 7))
    small = random.uniform(0.2, 0.45)
    return [lambda u, v, i=i, j=j: torus_points((i + u) / around, (j + v) / across, small=small)
            for i in range(around) for j in range(across)]


def capsule(random):
    """Four patches around a cylinder, and at its ends the upper and the lower half of a cube that is made round."""
    half = random.uniform(0.5, 2)

    def end(points, up):
        on = points / np.linalg.norm(points, axis=1)[:, None]
        return on + np.array([0, 0, half if up else -half])

    def wall(u, v, face):
        points = cube_face(*face, u, v)
        circle = points[:, :2] / np.linalg.norm(points[:, :2], axis=1)[:, None]
        return np.column_stack([circle, half * points[:, 2]])

    def upper_half(face):
        def place(u, v):
            points = cube_face(*face, u, v)
            points[:, 2] = (points[:, 2] + 1) / 2
            return end(points, True)
        return place

    def lower_half(face):
        def place(u, v):
            points = cube_face(*face, u, v)
            points[:, 2] = (points[:, 2] - 1) / 2
            return end(points, False)
        return place
    sides = [face for face in CUBE_FACES if face[0] != 2]
    return ([lambda u, v, f=f: wall(u, v, f) for f in sides]
            + [upper_half(f) for f in sides] + [lower_half(f) for f in sides]
            + [lambda u, v: end(cube_face(2, 1, u, v), True), lambda u, v: end(cube_face(2, -1, u, v), False)])


def plate_case(random):
    plate = HoledPlate(int(random.integers(1, 4)), int(random.integers(1, 3)), random.uniform(0.1, 0.6),
                       random.uniform(0.15, 0.4))

    def points():
        return 8 * int(random.integers(2, 9))
    parts = [plate.ring(c, h, up, points()) for c in plate.cells() for h, up in ((plate.thickness, True), (0.0, False))]
    parts += [plate.wall_of_hole(c, points()) for c in plate.cells()]
    parts += [plate.side(*ends, int(random.integers(2, 9))) for ends in plate.sides()]
    return joined(parts), plate.mesh(8 * FINE), plate.volume()


def patches_case(number, random, shape=None):
    shape = shape or SHAPES[number % len(SHAPES)]
    if shape == "plate":
        broken, solid, volume = plate_case(random)
    else:
        places = {"blob": blob, "torus": torus_patches, "capsule": capsule}[shape](random)
        broken = joined([patch(place, *random.integers(6, 25, 2)) for place in places])
        solid = welded(joined([patch(place, FINE, FINE) for place in places]))
        volume = solid.volume()
    turn = random_turn(random)
    truth = {"family": "patches", "shape": shape, "volume": volume, "options": []}
    return Case(turned(broken, turn), truth, turned(solid, turn))
