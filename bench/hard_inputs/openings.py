# SPDX-License-Identifier: MIT
"""Bodies whose openings are hard to read: walls of vessels that have lost the rim between them, cups with a flange, limbs cut off
somewhere, and rings around a hub. What was meant is the body, with the opening closed as a person would."""

import numpy as np

from .bodies import ball, lathe
from .meshes import Case, Mesh, grid_triangles, joined, random_turn, turned, welded

VESSELS = ("pot", "ball", "band")
FLANGES = ("flat", "wavy", "sloped", "hat")
LIMBS = ("straight", "oblique", "ragged", "hole")
HUBS = ("once", "twice")


def rows_of(profile, around):
    """An open profile of (radius, height), turned about z: the surface lies to its right."""
    angle = 2 * np.pi * np.arange(around) / around
    rings = [np.stack([r * np.cos(angle), r * np.sin(angle), np.full(around, float(h))], axis=1) for r, h in profile]
    return welded(Mesh(np.concatenate(rings), grid_triangles(len(profile), around, wrap_columns=True)))


def line(a, b, steps):
    """Points from a on, without b."""
    return [tuple(np.array(a) + (np.array(b) - a) * i / steps) for i in range(steps)]


def ball_line(radius, first, last, steps):
    return [(abs(radius * np.sin(a)), -radius * np.cos(a)) for a in np.linspace(first, last, steps + 1)]


def walls_of(shape, random):
    """Outer and inner profile from where they begin to the mouth, and what closes them."""
    steps = int(random.integers(6, 20))
    wall = random.uniform(0.04, 0.12)
    if shape == "pot":
        height, narrow = random.uniform(0.6, 2), random.uniform(0.4, 0.9)
        outer = [(0, 0), *line((1, 0), (1, height), steps), (narrow, height + 0.4)]
        inner = [(0, wall), *line((1 - wall, wall), (1 - wall, height), steps), (narrow - wall, height + 0.4)]
        return outer, inner
    if shape == "ball":
        mouth = np.pi - random.uniform(0.25, 0.9)
        return ball_line(1, 0, mouth, steps), ball_line(1 - wall, 0, mouth, steps)
    # A band: both walls begin at a rim that is there.
    high = random.uniform(0.1, 0.4)
    return [(1, 0), *line((1, 0.001), (1, high), steps), (1, high)], [(1 - wall, 0), *line((1 - wall, 0.001), (1 - wall, high), steps),
                                                                     (1 - wall, high)]


def vessel_case(number, random, shape=None):
    shape = shape or VESSELS[number % len(VESSELS)]
    around = int(random.integers(16, 64))
    outer, inner = walls_of(shape, random)
    solid = lathe([*outer, *inner[::-1]], around)
    if shape == "band":
        walls = [rows_of([*inner[::-1], *outer], around)]
    else:
        walls = [rows_of(outer, around), rows_of(inner[::-1], around)]
    ragged, strays = random.random() < 0.3, int(random.choice([0, 0, 5, 30]))
    broken = joined(walls)
    mouth = max(p[1] for p in outer)
    if ragged:
        at_mouth = (broken.corners()[:, :, 2] > mouth - 1e-9).any(axis=1)
        broken = Mesh(broken.points, broken.triangles[~(at_mouth & (random.random(len(at_mouth)) < 0.3))])
    radius = (outer[-1][0] + inner[-1][0]) / 2
    if strays:
        angle = random.uniform(0, 2 * np.pi, strays)
        at = np.stack([radius * np.cos(angle), radius * np.sin(angle), np.full(strays, mouth)], axis=1)
        small = at[:, None, :] + random.normal(size=(strays, 3, 3)) * 0.01
        broken = joined([broken, Mesh(small.reshape(-1, 3), np.arange(3 * strays).reshape(-1, 3))])
    wound = random.random() < 0.7
    if not wound:
        flip = random.random(len(broken.triangles)) < 0.5
        broken.triangles[flip] = broken.triangles[flip][:, ::-1]
    text = f"{shape}, {around} around, {strays} strays{', ragged' if ragged else ''}{'' if wound else ', turned by chance'}"
    return placed(broken, solid, "rims", text, random)


def flange_case(number, random, shape=None):
    shape = shape or FLANGES[number % len(FLANGES)]
    around, rows = int(random.integers(12, 64)), int(random.integers(1, 6))
    depth, width = random.uniform(0.4, 2), random.uniform(0.1, 0.5)
    steps = int(random.integers(1, 6))
    cup = [(0, -depth), *line((1, -depth), (1, 0), steps), (1, 0)]
    if shape == "hat":
        cup = [(0, -depth), *line((0.8, -depth), (1, 0), steps), (1, 0)]
    slope = random.uniform(-0.4, 0.4) if shape == "sloped" else 0
    flange = [(1 + width * (i + 1) / rows, slope * width * (i + 1) / rows) for i in range(rows)]
    broken = rows_of([*cup, *flange], around)
    if shape == "wavy":
        waves, high = int(random.integers(2, 6)), random.uniform(0.1, 0.3) * width
        radius, angle = np.hypot(*broken.points[:, :2].T), np.arctan2(*broken.points[:, 1::-1].T)
        broken.points[:, 2] += np.clip((radius - 1) / width, 0, 1) * high * np.sin(waves * angle)
    solid = lathe([*cup, (0, 0)], around)
    case = placed(broken, solid, "flanges", f"{shape}, {around} around, {width:.2g} wide in {rows} rows", random)
    return case


def limb_case(number, random, shape=None):
    """A rounded limb, or a ball with a hole where it is least in the way."""
    shape = shape or LIMBS[number % len(LIMBS)]
    if shape == "hole":
        whole = ball(int(random.integers(3, 5)))
        whole = whole.moved(lambda p: p * random.uniform(0.7, 1.3, 3))
        centre = whole.corners().mean(axis=1)
        away = np.linalg.norm(centre - centre[random.integers(len(centre))], axis=1)
        return placed(Mesh(whole.points, whole.triangles[away > random.uniform(0.1, 0.4)]), whole, "limbs", shape, random)
    around, steps, taper = int(random.integers(16, 64)), int(random.integers(20, 60)), random.uniform(0, 0.25)
    length = random.uniform(2, 5)
    end = [(max(0.0, np.sin(a)), 1 - np.cos(a)) for a in np.linspace(0, np.pi / 2, 8)[:-1]]
    profile = end + [(1 - taper * i / steps, 1 + length * i / steps) for i in range(steps + 1)] + [(0, 1 + length)]
    whole = lathe(profile, around)
    tilt = random.uniform(0.1, 0.6) if shape != "straight" else 0.0
    height = random.uniform(0.5, 0.7) * length + 1
    level = whole.points[:, 2] + tilt * whole.points[:, 0] - height
    if shape == "ragged":
        level = level + random.uniform(-0.05, 0.05, len(level))
    return placed(*cut_off(whole, level, shape == "oblique"), "limbs", f"{shape}, {around} around, tilt {tilt:.2g}", random)


def cut_off(mesh, level, smooth):
    """What lies below the level, without what would close it, and with a flat end."""
    points = mesh.points
    keep = (level[mesh.triangles] < 0).all(axis=1)
    broken = Mesh(points, mesh.triangles[keep])
    if smooth:  # the points at the cut go along the limb until they lie in the plane
        edges, count = broken.edges()
        rim = np.unique(edges[count == 1])
        points = points.copy()
        points[rim, 2] -= level[rim]
        broken = Mesh(points, broken.triangles)
    edges, count = broken.edges()
    sides = np.concatenate([broken.triangles[:, [0, 1]], broken.triangles[:, [1, 2]], broken.triangles[:, [2, 0]]])
    open_sides = {tuple(e) for e in edges[count == 1].tolist()}
    rim = np.array([s for s in sides.tolist() if tuple(sorted(s)) in open_sides])
    middle = len(points)
    lid = np.column_stack([rim[:, 1], rim[:, 0], np.full(len(rim), middle)])
    solid = Mesh(np.vstack([points, points[np.unique(rim)].mean(axis=0)]), np.concatenate([broken.triangles, lid]))
    return broken, used_only(solid)


def used_only(mesh):
    used, numbers = np.unique(mesh.triangles, return_inverse=True)
    return Mesh(mesh.points[used], numbers.reshape(-1, 3))


def hub_case(number, random, shape=None):
    """A ring there twice, around a closed hub that is there once or twice: no void where the hub is."""
    shape = shape or HUBS[number % len(HUBS)]
    around, high = int(random.integers(8, 48)), random.uniform(0.1, 0.6)
    r = random.uniform(0.1, 0.6)
    inset = random.uniform(0.05, 0.3) * high
    ring = rows_of([(1, 0), (1, high)], around)
    hub = lathe([(0, inset), (r, inset), (r, high - inset), (0, high - inset)], int(random.integers(4, 24)))
    parts = [ring, ring.flipped(), hub] + ([hub.flipped()] if shape == "twice" else [])
    solid = lathe([(0, 0), (1, 0), (1, high), (0, high)], around)
    return placed(joined(parts), solid, "hubs", f"hub there {shape}, {around} around, {high:.2g} high, radius {r:.2g}", random)


def placed(broken, solid, family, text, random):
    turn = random_turn(random)
    chosen = random.permutation(len(broken.triangles))
    broken = Mesh(broken.points, broken.triangles[chosen])
    return Case(turned(broken, turn), {"family": family, "shape": text, "options": [], "box": True}, turned(solid, turn))
