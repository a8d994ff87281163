# SPDX-License-Identifier: MIT
"""Car bodies of panels: each panel is a sheet by itself, a little above or below its neighbours, and reaches over their
rims. What was meant is the body."""

import numpy as np

from .bodies import CUBE_FACES, cube_face, cube_grid
from .meshes import Case, joined, patch, random_turn, turned

OVERLAP = 0.06  # of a panel's width, at each side
OFFSET = 0.003  # in lengths of the body


def car_shape(random):
    """From the cube to a body with a bonnet, a cabin and a boot."""
    cabin, start, end = random.uniform(0.35, 0.6), random.uniform(-0.5, -0.2), random.uniform(0.3, 0.6)

    def place(points, above=0.0):
        on = points / ((np.abs(points) ** 4).sum(axis=1) ** 0.25)[:, None] * (1 + above)
        x, y, z = on.T
        roof = np.clip((z + 1) / 2, 0, None) * cabin / (1 + np.exp(-12 * (x - start))) / (1 + np.exp(12 * (x - end)))
        return np.stack([2 * x, y * (0.85 - 0.15 * roof), 0.5 * z + roof], axis=1)
    return place


def car_case(number, random, panels=None):
    """`panels` a side of each face of the cube that the body is made of."""
    count = int(panels or 1 + number % 3)
    place = car_shape(random)
    parts = []
    for face in CUBE_FACES:
        for i in range(count):
            for j in range(count):
                above = OFFSET * random.uniform(-1, 1)

                def panel(u, v, i=i, j=j, face=face, above=above):
                    u = (i - OVERLAP + (1 + 2 * OVERLAP) * u) / count
                    v = (j - OVERLAP + (1 + 2 * OVERLAP) * v) / count
                    return place(cube_face(*face, u, v), above)
                parts.append(patch(panel, *random.integers(8, 20, 2)))
    solid = cube_grid(40).moved(place)
    turn = random_turn(random)
    truth = {"family": "cars", "shape": f"{len(parts)} panels", "options": []}
    return Case(turned(joined(parts), turn), truth, turned(solid, turn))
