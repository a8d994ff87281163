# SPDX-License-Identifier: MIT
"""Scenes: bodies by the ground, which is an open sheet. What was meant are the bodies, an opening of their own closed."""

import numpy as np

from .bodies import ball, cube_grid, lathe, torus
from .meshes import Case, Mesh, joined, patch, random_turn, turned

BODIES = ("box", "ball", "torus", "cone")
PLACES = ("over", "on", "beside", "through", "under", "open over", "open beside")
CLEARANCES = (0.001, 0.01, 0.1, 1.0, 10.0)  # in sizes of the body
SIZES = (1.0, 3.0, 10.0, 100.0, 1000.0)  # of the ground, in those of the body


def body_of(shape, random):
    if shape == "box":
        return cube_grid(int(random.integers(1, 5)))
    if shape == "ball":
        return ball(int(random.integers(0, 3)))
    if shape == "torus":
        return torus(int(random.integers(8, 24)), int(random.integers(6, 16)))
    return lathe([(0.0, -1.0), (1.0, -1.0), (0.3, 1.0), (0.0, 1.0)], int(random.integers(6, 24)))


def without_top(random):
    """A box, and it without the face on its top."""
    solid = cube_grid(int(random.integers(1, 5)))
    is_top = (solid.corners()[:, :, 2] > 0.999).all(axis=1)
    return solid, Mesh(solid.points, solid.triangles[~is_top])


def ground(random, size):
    """Around the origin, flat or with hills below it."""
    cells = int(random.integers(2, 24))
    hills = random.choice([0.0, 0.02, 0.2]) * size
    waves = random.uniform(2, 8, 2)

    def place(u, v):
        height = -hills * (1 + np.sin(waves[0] * u) * np.cos(waves[1] * v)) / 2
        return np.stack([size * (u - 0.5), size * (v - 0.5), height], axis=1)
    return patch(place, cells, cells)


def lifted(mesh, place, clearance, size, random):
    """The body where the place says, beside a ground that goes up to z = 0."""
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    at = np.array([*random.uniform(-0.4, 0.4, 2) * size, 0.0])
    if place == "on":
        at[2] = -low[2]
    elif place == "through":
        at[2] = random.uniform(0.1, 0.9) * (low[2] - high[2]) - low[2]
    elif place == "under":
        at[2] = -high[2] - clearance - 0.4 * size
    elif place.endswith("beside"):
        at[:2] = (0.5 * size + clearance + 1.5, 0)
        at[2] = random.uniform(-1, 1)
    else:
        at[2] = clearance - low[2]
    return lambda points: points + at


def scene_case(number, random, place=None, shape=None):
    place = place or PLACES[number % len(PLACES)]
    shape = "box" if place.startswith("open") else shape or BODIES[number // len(PLACES) % len(BODIES)]
    size, clearance = 2 * random.choice(SIZES), 2 * random.choice(CLEARANCES)
    floor = ground(random, size)
    solid, given = without_top(random) if place.startswith("open") else [body_of(shape, random)] * 2
    move = lifted(solid, place, clearance, size, random)
    # Exact, so that the bodies are the same wherever they are.
    turn = random_turn(random) if place != "on" else np.eye(3)
    pieces = [given.moved(move), floor.flipped() if random.random() < 0.3 else floor]
    if number % 2:
        pieces.reverse()
    truth = {"family": "scenes", "shape": f"{place}, {shape}, ground {size / 2:g} times as large, {clearance / 2:g} away",
             "options": []}
    return Case(turned(joined(pieces), turn), truth, turned(solid.moved(move), turn))
