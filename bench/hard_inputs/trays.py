# SPDX-License-Identifier: MIT
"""Trays: open boxes of single sheets with dividers. What was meant is the box, closed flat at its rim."""

import numpy as np

from .bodies import cube_grid
from .meshes import Case, Mesh, random_turn, turned, welded

TURNS = ("outward", "by chance")


def grid_positions(random, cells, size):
    inner = np.sort(random.choice(np.arange(1, 40), cells - 1, replace=False)) / 40 * size
    return np.concatenate([[0.0], inner, [size]])


def quad(corners, random):
    """Two triangles, counter-clockwise as the corners are."""
    a, b, c, d = corners
    pieces = [(a, b, c), (a, c, d)] if random.random() < 0.5 else [(b, c, d), (b, d, a)]
    return [np.array(piece, dtype=float) for piece in pieces]


def divider_height(random, height, heights):
    return height if heights == "even" else height * random.choice([0.25, 0.5, 0.75])


def tray_case(number, random, heights=None):
    heights = heights or ("even", "lower")[number % 2]
    columns, rows = (int(n) for n in random.integers(1, 5, 2))
    if columns * rows == 1:
        columns = 2
    size = np.array([random.uniform(5, 40), random.uniform(5, 40), random.uniform(1, 20)])
    xs, ys = grid_positions(random, columns, size[0]), grid_positions(random, rows, size[1])
    top = size[2]
    # Dividers of all cells are as high as each other, so that they meet along whole edges.
    low = divider_height(random, top, heights)
    levels = [0.0, top] if low == top else [0.0, low, top]
    outer, inner = [], []
    for i in range(columns):
        x, u = xs[i], xs[i + 1]
        for j in range(rows):
            y, v = ys[j], ys[j + 1]
            outer += quad([(x, y, 0), (x, v, 0), (u, v, 0), (u, y, 0)], random)
            if i > 0:
                inner += quad([(x, y, 0), (x, v, 0), (x, v, low), (x, y, low)], random)
            if j > 0:
                inner += quad([(x, y, 0), (u, y, 0), (u, y, low), (x, y, low)], random)
    for bottom, above in zip(levels, levels[1:]):
        for x, u in zip(xs, xs[1:]):
            outer += quad([(x, 0, bottom), (u, 0, bottom), (u, 0, above), (x, 0, above)], random)
            outer += quad([(u, size[1], bottom), (x, size[1], bottom), (x, size[1], above), (u, size[1], above)], random)
        for y, v in zip(ys, ys[1:]):
            outer += quad([(0, v, bottom), (0, y, bottom), (0, y, above), (0, v, above)], random)
            outer += quad([(size[0], y, bottom), (size[0], v, bottom), (size[0], v, above), (size[0], y, above)], random)
    way = random.choice(TURNS)
    pieces = outer + [piece[::-1] if random.random() < 0.5 else piece for piece in inner]
    if way == "by chance":
        pieces = [piece[::-1] if random.random() < 0.5 else piece for piece in pieces]
    random.shuffle(pieces)
    mesh = welded(Mesh(np.concatenate(pieces), np.arange(3 * len(pieces)).reshape(-1, 3)))
    truth = {"family": "trays", "shape": f"{columns} x {rows} compartments, dividers {heights}, turned {way}", "options": []}
    solid = cube_grid(1).moved(lambda points: (points + 1) / 2 * size)
    turn = random_turn(random)
    return Case(turned(mesh, turn), truth, turned(solid, turn))
