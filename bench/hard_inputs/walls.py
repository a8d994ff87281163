# SPDX-License-Identifier: MIT
"""Double walls with pinholes: a hollow body whose inner wall is joined to the outer one by tubes, as image-to-3D
generators make them. What was meant is the full body."""

import numpy as np

from .bodies import ball, cube_grid, knot, lathe
from .meshes import Case, Mesh, random_turn, turned

SHAPES = ("ball", "box", "knot")
KNOT_RADIUS = 0.45
# Of a knot, what is between its strands: wider balls do not pass there either.
KNOT_GAP = 0.9
# How thick walls are, as a share of the size.
WALL = {"ball": 0.02, "box": 0.02, "knot": 0.01}


def shape_of(name, level):
    """Outer points, the function to inner ones that are so much further in, and triangles; levels 0 to 5 are finer."""
    if name == "ball":
        mesh = ball(level)
        return mesh, lambda depth: mesh.points * (1 - depth)
    if name == "box":
        mesh = cube_grid(6 * 2 ** level)
        return mesh, lambda depth: np.where(np.abs(mesh.points) == 1, np.sign(mesh.points) * (1 - depth), mesh.points)
    along, across = 60 * 2 ** level // 2, 10 * 2 ** level // 2
    mesh = knot(along, across, KNOT_RADIUS)
    return mesh, lambda depth: knot(along, across, KNOT_RADIUS - depth).points


def rings_of(mesh):
    """Of each point those around it, counter-clockwise seen from outside."""
    after = [{} for _ in mesh.points]
    for a, b, c in mesh.triangles.tolist():
        after[a][b], after[b][c], after[c][a] = c, a, b
    rings = []
    for steps in after:
        ring = [next(iter(steps))]
        while len(ring) < len(steps):
            ring.append(steps[ring[-1]])
        rings.append(ring)
    return rings


def far_apart(mesh, inner, rings, count, room, random):
    """So many points with room around them, in the inner wall, too, no two in one triangle; nothing if there are too few."""
    is_flat = flat_stars(mesh, rings)
    taken, chosen = set(), []
    for p in random.permutation(len(mesh.points)).tolist():
        spokes = np.concatenate([wall[rings[p]] - wall[p] for wall in (mesh.points, inner)])
        if p in taken or not is_flat(p) or np.linalg.norm(spokes, axis=1).min() < room:
            continue
        taken.update(rings[p])
        chosen.append(p)
        if len(chosen) == count:
            return chosen
    return None


def flat_stars(mesh, rings):
    """Whether the triangles around a point face about the same way."""
    def is_flat(p):
        spokes = mesh.points[rings[p]] - mesh.points[p]
        normals = np.cross(spokes, np.roll(spokes, -1, axis=0))
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        return float((normals @ normals.T).min()) > 0.7
    return is_flat


def with_rims(mesh, points, rings, holes, diameter):
    """The points of the mesh, moved to `points`, and behind them those of a rim on the spokes of each hole."""
    rims = []
    for p in holes:
        spokes = points[rings[p]] - points[p]
        rims.append(points[p] + spokes * (diameter / 2 / np.linalg.norm(spokes, axis=1))[:, None])
    return np.concatenate([points, *rims])


def wall_triangles(mesh, rings, holes):
    """Of the wall without its holes, of the caps that close these, and the rims: numbers of with_rims()."""
    star = np.isin(mesh.triangles, holes).any(axis=1)
    wall, caps, rims = [mesh.triangles[~star]], [], []
    first = len(mesh.points)
    for p in holes:
        ring = np.array(rings[p])
        rim = first + np.arange(len(ring))
        next_ring, next_rim = np.roll(ring, -1), np.roll(rim, -1)
        wall += [np.stack([rim, ring, next_ring], axis=1), np.stack([rim, next_ring, next_rim], axis=1)]
        caps.append(np.stack([np.full(len(rim), p), rim, next_rim], axis=1))
        rims.append((rim, next_rim))
        first += len(ring)
    return np.concatenate(wall), np.concatenate(caps), rims


def double_wall(shape, holes, share, random, turn=None):
    """`holes` pinholes whose diameter is this share of the size, between walls that are WALL apart. Throws ValueError where there
    is no room for so many."""
    for level in (3, 2, 1, 0) if shape == "ball" else (2, 1, 0):
        mesh, inner_points = shape_of(shape, level)
        rings = rings_of(mesh)
        diameter = share * mesh.diagonal()
        inside = inner_points(WALL[shape] * mesh.diagonal())
        chosen = far_apart(mesh, inside, rings, holes, 0.65 * diameter, random)
        if chosen is not None:
            break
    else:
        raise ValueError(f"a {shape} has no room for {holes} holes of {100 * share:g} %")
    outer = with_rims(mesh, mesh.points, rings, chosen, diameter)
    inner = with_rims(mesh, inside, rings, chosen, diameter)
    wall, caps, rims = wall_triangles(mesh, rings, chosen)
    offset = len(outer)
    tubes = []
    for rim, after in rims:
        tubes += [np.stack([rim, after, after + offset], axis=1), np.stack([rim, after + offset, rim + offset], axis=1)]
    broken = Mesh(np.concatenate([outer, inner]), np.concatenate([wall, wall[:, ::-1] + offset, *tubes]))
    solid = Mesh(outer, np.concatenate([wall, caps]))
    if turn is not None:
        broken, solid = turned(broken, turn), turned(solid, turn)
    truth = {"family": "walls", "shape": shape, "holes": holes, "hole_diameter": diameter, "size": mesh.diagonal(),
             "seal": 2 * diameter, "options": ["--seal", repr(2 * diameter)], "wall_triangles": len(wall)}
    if shape == "knot":
        truth["widest_seal"] = KNOT_GAP
    return Case(broken, truth, solid)


def walls_case(number, random, shape=None, holes=None, size=None, turn=True):
    """One of many: shape, number of holes and their size go round, unless they are given."""
    shape = shape or SHAPES[number % 3]
    shares = (0.001, 0.005, 0.01, 0.05)
    for attempt in range(4):
        share = size or shares[(number // 3 + attempt) % 4]
        count = holes or (1, 10, 100)[(number // 12) % 3]
        if shape == "knot" and 2 * share > 0.06 and size is None:
            continue
        try:
            return double_wall(shape, count, share, random, random_turn(random) if turn else None)
        except ValueError:
            if size is not None or attempt == 3:
                raise
    raise ValueError(f"a {shape} has no room for {count} holes")


def turned_profile(outer, inner):
    """Of a vessel: up outside, down inside. Both go from the bottom to the rim."""
    return outer + inner[::-1]


def arc(centre, radius, start, end, points):
    angles = np.radians(np.linspace(start, end, points))
    return [(max(0.0, centre[0] + radius * float(np.cos(a))), centre[1] + radius * float(np.sin(a))) for a in angles]


VESSELS = ("bust", "mug", "bottle", "bell")


def vessel(name, around=96):
    """A thin body that is open: a bust open below, a mug, a bottle, a bell. The solid is the same without its hollow: closed
    by a flat lid. A ball of the diameter `passes` comes to all of the hollow, one of `mouth` into none of it."""
    if name == "bust":
        body = [(0.62, 0.0), (0.66, 0.3), (0.45, 0.62), (0.24, 0.75), (0.22, 0.86)]
        outer = body + arc((0, 1.25), 0.42, -52, 90, 24)
        inner = [(r - 0.04, h) for r, h in body] + arc((0, 1.25), 0.38, -52, 90, 24)
        profile, lid, mouth = turned_profile(outer, inner), [(0.0, 0.0)] + outer, 2 * (0.62 - 0.04)
        passes = 2 * (0.22 - 0.04)
    elif name == "mug":
        outer = [(0.0, 0.0), (0.4, 0.0), (0.4, 1.0)]
        profile, lid, mouth = turned_profile(outer, [(0.0, 0.05), (0.36, 0.05), (0.36, 1.0)]), outer + [(0.0, 1.0)], 0.72
        passes = 0.72
    elif name == "bottle":
        outer = [(0.0, 0.0), (0.4, 0.0), (0.4, 0.9), (0.12, 1.2), (0.12, 1.5)]
        inner = [(0.0, 0.04), (0.36, 0.04), (0.36, 0.89), (0.08, 1.19), (0.08, 1.5)]
        profile, lid, mouth = turned_profile(outer, inner), outer + [(0.0, 1.5)], 0.16
        passes = 0.16
    elif name == "bell":
        outer = [(0.6, 0.0), (0.42, 0.2), (0.36, 0.6)] + arc((0, 0.7), 0.36, 0, 90, 16)
        inner = [(r - 0.04, h) for r, h in outer[:3]] + arc((0, 0.7), 0.32, 0, 90, 16)
        profile, lid, mouth = turned_profile(outer, inner), [(0.0, 0.0)] + outer, 2 * 0.56
        passes = 0.64
    else:
        raise ValueError(f"there is no vessel {name}")
    broken, solid = lathe(profile, around), lathe(lid, around)
    truth = {"family": "vessels", "shape": name, "mouth": mouth, "passes": passes, "size": broken.diagonal(), "own_volume": broken.volume(),
             "options": []}
    return Case(broken, truth, solid)
