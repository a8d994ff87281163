# SPDX-License-Identifier: MIT
"""Assemblies: bodies that are to touch, but for noise in their corners. What was meant is one part."""

import numpy as np

from .meshes import Case, Mesh, joined, random_turn, turned

# Of the size of the whole.
NOISES = (1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3)
# Faces of bodies whose corners are off by 1 along each axis are apart by no more than this.
APART = 4.0


def prism(outline, low, high, random, hole=None):
    """Upright, over an outline that turns to the left; over a hole as well that turns to the right, of as many corners."""
    count = len(outline)
    if hole is None:
        flat, caps = np.array(outline), fan(count)
    else:
        flat = np.concatenate([outline, hole])
        caps = [quad for i in range(count) for quad in cut(i, (i + 1) % count, count + (i + 1) % count, count + i, random)]
    size = len(flat)
    points = np.concatenate([np.column_stack([flat, np.full(size, z)]) for z in (low, high)])
    triangles = [(c, b, a) for a, b, c in caps] + [(a + size, b + size, c + size) for a, b, c in caps]
    for ring, turn in ((range(count), 1), (range(count, size), -1)):
        ring = list(ring)
        for i, a in enumerate(ring):
            b = ring[(i + turn) % len(ring)]
            triangles += cut(a, b, b + size, a + size, random)
    return Mesh(points, triangles)


def cut(a, b, c, d, random):
    return [(a, b, c), (a, c, d)] if random.random() < 0.5 else [(a, b, d), (b, c, d)]


def fan(count):
    return [(0, i, i + 1) for i in range(1, count - 1)]


def box(low, high, random):
    (x, y, z), (u, v, w) = low, high
    return prism([(x, y), (u, y), (u, v), (x, v)], z, w, random)


def round_outline(centre, radius, corners):
    angle = 2 * np.pi * np.arange(corners) / corners
    return np.array(centre) + radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def stack(random):
    """Boxes on each other, each shifted."""
    bodies, shared, low = [], 0.0, np.zeros(2)
    size, z = random.uniform(0.5, 1, 2), 0.0
    for i in range(int(random.integers(2, 6))):
        height = random.uniform(0.15, 0.5)
        if i:
            before = low, low + size
            size = random.uniform(0.5, 1, 2)
            low = low + random.uniform(-0.25, 0.25, 2)
            shared += np.prod(np.minimum(before[1], low + size) - np.maximum(before[0], low))
        bodies.append(box((*low, z), (*(low + size), z + height), random))
        z += height
    return bodies, shared, 0, f"{len(bodies)} boxes on each other"


def bricks(random):
    """A block, of bricks in rows, those of each layer by joints of its own."""
    layers, rows = (int(n) for n in random.integers(1, 4, 2))
    heights, depths = (np.concatenate([[0], np.cumsum(random.uniform(0.2, 0.5, n))]) for n in (layers, rows))
    bodies = []
    for k in range(layers):
        for j in range(rows):
            cuts = np.arange(1, int(random.integers(2, 5)))
            joints = [0, *(cuts / (len(cuts) + 1) + 0.05 * random.integers(-1, 2, len(cuts))), 1]
            for x, u in zip(joints, joints[1:]):
                bodies.append(box((x, depths[j], heights[k]), (u, depths[j + 1], heights[k + 1]), random))
    y, z = depths[-1], heights[-1]
    shared = (sum(body.area() for body in bodies) - 2 * (y + z + y * z)) / 2
    return bodies, shared, 0, f"a block of {len(bodies)} bricks"


def letters(random):
    """Letters on a plate, each in a field of its own."""
    fields = int(random.integers(1, 6))
    height = random.uniform(0.1, 0.4)
    bodies, shared = [box((0, 0, 0), (fields, 1.5, height), random)], 0.0
    for i in range(fields):
        top = height + random.uniform(0.1, 0.5)
        x, y, u, v = i + 0.2, 0.2, i + 0.8, random.uniform(0.7, 1.3)
        form = random.choice(list("ILOC"))
        if form == "I":
            outline, hole = [(x, y), (u, y), (u, v), (x, v)], None
        elif form == "L":
            outline, hole = [(x, y), (u, y), (u, y + 0.2), (x + 0.2, y + 0.2), (x + 0.2, v), (x, v)], None
            outline = outline[3:] + outline[:3]  # all of it is seen from the inner corner
        elif form == "O":
            outline = [(x, y), (u, y), (u, v), (x, v)]
            hole = [(x + 0.2, y + 0.2), (u - 0.2, y + 0.2), (u - 0.2, v - 0.2), (x + 0.2, v - 0.2)]
        else:
            outline, hole = round_outline(((x + u) / 2, 0.6), 0.3, int(random.integers(5, 24))), None
        body = prism(outline, height, top, random, hole)
        shared += foot_of(body)
        bodies.append(body)
    return bodies, shared, 0, f"{fields} letters on a plate"


def foot_of(body):
    corners = body.corners()
    low = (corners[:, :, 2] == corners[:, :, 2].min()).all(axis=1)
    return Mesh(body.points, body.triangles[low]).area()


def posts(random):
    """Cylinders between two plates."""
    height, long, corners = random.uniform(0.1, 0.3), random.uniform(0.2, 1), int(random.integers(6, 40))
    count = int(random.integers(1, 5))
    bodies, shared = [box((0, 0, 0), (count, 1, height), random)], 0.0
    for i in range(count):
        body = prism(round_outline((i + 0.5, 0.5), random.uniform(0.15, 0.4), corners), height, height + long, random)
        shared += 2 * foot_of(body)
        bodies.append(body)
    bodies.append(box((-0.1, -0.2, height + long), (count + 0.2, 1.1, 2 * height + long), random))
    return bodies, shared, count - 1, f"{count} posts between plates"


def thin(random):
    """A stack with a sheet of metal on it, thinner than what is to be joined."""
    bodies, _, _, _ = stack(random)
    low, high = bodies[-1].points.min(axis=0), bodies[-1].points.max(axis=0)
    width = random.uniform(0.002, 0.01)
    bodies.append(box((*low[:2], high[2]), (*high[:2], high[2] + width), random))
    return bodies, width, 0, "a sheet on boxes"


MAKERS = {"stack": stack, "bricks": bricks, "letters": letters, "posts": posts, "thin": thin}


def assembly_case(number, random, kind=None, noise=None):
    kind = kind or list(MAKERS)[number % len(MAKERS)]
    bodies, shared, genus, what = MAKERS[kind](random)
    solid = joined(bodies)
    size = solid.diagonal()
    share = noise or random.choice(NOISES)
    off = share * size if kind != "thin" else 1e-6 * size
    distance = APART * off if kind != "thin" else shared * random.uniform(1.1, 3)
    area, volume = solid.area() - 2 * shared, sum(body.volume() for body in bodies)
    noisy = [Mesh(b.points + random.uniform(-off, off, b.points.shape), b.triangles) for b in bodies]
    way = "turned" if random.random() < 0.5 else "upright"
    broken = joined(noisy)
    if way == "turned":
        broken = turned(broken, random_turn(random))
    seen = kind != "thin" and share < 1e-4 and random.random() < 0.3  # how far to go is to be seen from the mesh
    truth = {"family": "assemblies", "shape": f"{what}, {way}, noise {off / size:.0e}{', auto' if seen else ''}",
             "volume": volume, "options": ["--join-gaps", "auto" if seen else repr(float(distance))]}
    lengths = np.linalg.norm(broken.corners() - np.roll(broken.corners(), 1, axis=1), axis=2)
    if kind == "thin" or lengths.min() < 2 * distance:
        return Case(broken, truth | {"code": 2})
    return Case(broken, truth | {"area": area, "genus": genus, "parts": 1})
