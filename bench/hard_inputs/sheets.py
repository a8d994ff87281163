# SPDX-License-Identifier: MIT
"""Open sheets: trees of leaf cards, garments. They enclose nothing; what was meant is a wall of some thickness, whose
volume is about its area times that."""

import numpy as np

from .bodies import lathe
from .meshes import Case, Mesh, grid_triangles, joined, patch, random_turn, turned, welded

# The volume that crossing cards of thickness T share, per T^2 and length of the line where they cross.
SHARED = {2: 1.0, 3: 2.6}


def card(width, height):
    return Mesh([[-width / 2, 0, 0], [width / 2, 0, 0], [width / 2, 0, height], [-width / 2, 0, height]],
                [[0, 1, 2], [0, 2, 3]])


def about_z(mesh, angle):
    c, s = np.cos(angle), np.sin(angle)
    return turned(mesh, np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]))


def cards_case(number, random, cards=None):
    """A trunk, and in the crown above it bunches of two or three cards that cross."""
    count = int(cards or random.integers(3, 40))
    quads = 2 + number % 2
    bunches, places, lines = [], [], 0.0
    while len(bunches) < count:
        place = random.uniform(-1, 1, 3)
        width, height = random.uniform(0.15, 0.3, 2)
        if np.linalg.norm(place) > 1 or any(np.linalg.norm(place - p) < 0.35 for p in places) and len(places) < 12:
            continue
        bunch = joined([about_z(card(width, height), np.pi * i / quads) for i in range(quads)])
        bunches.append(turned(bunch, random_turn(random)).moved(lambda p, at=place: p + at))
        places.append(place)
        lines += height
    leaves = joined(bunches)
    trunk = lathe([(0.0, -3.0), (0.12, -3.0), (0.06, -1.5), (0.0, -1.5)], 16)
    has_trunk = number % 4 < 2
    broken = joined([leaves, trunk]) if has_trunk else leaves
    thickness = 0.002 * broken.diagonal()
    volume = leaves.area() * thickness - lines * SHARED[quads] * thickness ** 2
    truth = {"family": "cards", "shape": f"{count} bunches of {quads}", "area": leaves.area(), "thickness": thickness,
             "volume": volume + (trunk.volume() if has_trunk else 0),
             "options": ["--thicken", repr(thickness)]}
    return Case(broken, truth)


def pleated_tube(profile, around, pleats, depth):
    """Radius and height row by row, the radius waving around the tube."""
    a = 2 * np.pi * np.arange(around) / around
    rows = [np.stack([r * (1 + depth * np.sin(pleats * a)) * np.cos(a), r * (1 + depth * np.sin(pleats * a)) * np.sin(a),
                      np.full(around, float(h))], axis=1) for r, h in profile]
    return Mesh(np.concatenate(rows), grid_triangles(len(profile), around, wrap_columns=True))


def shirt(random):
    """A tube, open at the waist and the neck, with a sleeve at either side."""
    around, rows = 48, 28
    heights = np.linspace(0, 1.4, rows)
    radii = 0.5 * np.interp(heights, [0, 0.9, 1.2, 1.4], [1, 0.95, 0.85, 0.4])
    body = pleated_tube(list(zip(radii, heights)), around, int(random.integers(3, 9)), random.uniform(0, 0.05))
    length, droop = random.uniform(0.3, 0.9), random.uniform(-0.6, 0.3)
    pieces, kept = [body], np.ones(len(body.triangles), dtype=bool)
    side, low = 6, 18
    for middle, sign in ((0, 1), (around // 2, -1)):
        columns = [(middle - side // 2 + k) % around for k in range(side + 1)]
        levels = list(range(low, low + side + 1))
        inner = {r * around + c for r in levels for c in columns}
        cells = np.isin(body.triangles, list(inner)).all(axis=1)
        kept &= ~cells
        rim = ([(low, c) for c in columns] + [(r, columns[-1]) for r in levels[1:]]
               + [(levels[-1], c) for c in columns[-2::-1]] + [(r, columns[0]) for r in levels[-2:0:-1]])
        start = body.points[[r * around + c for r, c in rim]]
        angle = 2 * np.pi * (np.arange(len(rim)) + 0.5) / len(rim) - 3 * np.pi / 4
        cuff = np.stack([np.full(len(rim), sign * (0.55 + length)), sign * 0.12 * np.cos(angle),
                         start[:, 2].mean() + droop * length + 0.12 * np.sin(angle)], axis=1)
        steps = np.linspace(0, 1, 14)
        sleeve = np.concatenate([start + t * (cuff - start) for t in steps])
        pieces.append(Mesh(sleeve, grid_triangles(len(steps), len(rim), wrap_columns=True)))
    pieces[0] = Mesh(body.points, body.triangles[kept])
    return welded(joined(pieces))


def skirt(random):
    rows = int(random.integers(10, 24))
    heights = np.linspace(0, 1, rows)
    radii = np.interp(heights, [0, 1], [random.uniform(0.5, 0.9), 0.3])
    return pleated_tube(list(zip(radii, heights)), 96, int(random.integers(5, 12)), random.uniform(0.02, 0.12))


def cape(random):
    """Part of a cone, open in front and below."""
    opening = random.uniform(0.3, 2.5)
    waves = int(random.integers(4, 9))

    def place(u, v):
        a = opening / 2 + (2 * np.pi - opening) * u
        r = 0.3 + 0.6 * v + 0.03 * v * np.sin(waves * a)
        return np.stack([r * np.cos(a), r * np.sin(a), 1 - v], axis=1)
    return patch(place, 20, 64).flipped()


def scarf(random):
    """A strip that is folded several times, its layers apart."""
    folds = int(random.integers(1, 5))
    gap = random.uniform(0.06, 0.15)
    radius = gap / 2
    line, height = [(0.0, 0.0)], 0.0
    for fold in range(folds + 1):
        there = fold % 2 == 0
        end = 1.0 if there else 0.0
        line += [(x, height) for x in np.linspace(1 - end, end, 12)[1:]]
        if fold == folds:
            break
        angles = np.linspace(-np.pi / 2, np.pi / 2, 9)[1:]
        sign = 1 if there else -1
        line += [(end + sign * radius * np.cos(a), height + radius + radius * np.sin(a)) for a in angles]
        height += gap
    line = np.array(line)
    across = np.linspace(0, random.uniform(0.3, 0.8), 12)
    points = np.array([[x, y, z] for x, z in line for y in across])
    return Mesh(points, grid_triangles(len(line), len(across)))


GARMENTS = {"shirt": shirt, "skirt": skirt, "cape": cape, "scarf": scarf}


def garment_case(number, random, shape=None):
    shape = shape or list(GARMENTS)[number % len(GARMENTS)]
    broken = turned(GARMENTS[shape](random), random_turn(random))
    thickness = 0.004 * broken.diagonal()
    truth = {"family": "garments", "shape": shape, "area": broken.area(), "thickness": thickness,
             "volume": broken.area() * thickness, "options": ["--thicken", repr(thickness)]}
    return Case(broken, truth)
