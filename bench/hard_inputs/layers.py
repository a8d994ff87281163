# SPDX-License-Identifier: MIT
"""Two-sided bodies, as game engines have them: each face is there twice, and the copy faces inward. What was meant is the
body. A two-sided sheet encloses nothing."""

import numpy as np

from .bodies import CUBE_FACES, cube_face, torus_points
from .meshes import Case, Mesh, joined, random_turn

SHAPES = ("torus", "box", "prism", "pot")
# How the copy differs from the faces.
WAYS = ("same", "diagonals", "corners", "noise", "float32", "n-gons", "partly", "missing", "bent", "beside", "sheet")
GRID_STEPS = 2.0 ** 26  # over the bounding box, to which meshrepair rounds


class Faces:
    """Polygons, counter-clockwise seen from outside."""

    def __init__(self, points, polygons):
        self.points = np.asarray(points, dtype=float)
        self.polygons = [list(polygon) for polygon in polygons]

    def mesh(self, first=lambda polygon: 0):
        """Cut into triangles from the corner first(polygon) of each, a position in it."""
        triangles = []
        for polygon in self.polygons:
            start = first(polygon) % len(polygon)
            corners = polygon[start:] + polygon[:start]
            triangles += [(corners[0], corners[k], corners[k + 1]) for k in range(1, len(corners) - 1)]
        return Mesh(self.points, triangles)

    def of(self, chosen):
        return Faces(self.points, [p for p, is_chosen in zip(self.polygons, chosen) if is_chosen])

    def flipped(self):
        return Faces(self.points, [polygon[::-1] for polygon in self.polygons])

    def moved(self, transform):
        return Faces(transform(self.points), self.polygons)


def grid_faces(rows, columns, wrap_rows, wrap_columns):
    """Quads of points numbered row by row, as grid_triangles() turns them."""
    return [(i * columns + j, i * columns + (j + 1) % columns, (i + 1) % rows * columns + (j + 1) % columns,
             (i + 1) % rows * columns + j)
            for i in range(rows if wrap_rows else rows - 1) for j in range(columns if wrap_columns else columns - 1)]


def box_faces(cells):
    """The cube from -1 to 1."""
    number, points, polygons = {}, [], []
    steps = np.linspace(0, 1, cells + 1)
    for face in CUBE_FACES:
        v, u = np.meshgrid(steps, steps, indexing="ij")
        here = []
        for point in cube_face(*face, u.ravel(), v.ravel()):
            key = tuple(np.round(point, 6))
            if key not in number:
                number[key] = len(points)
                points.append(point)
            here.append(number[key])
        polygons += [[here[k] for k in quad] for quad in grid_faces(cells + 1, cells + 1, False, False)]
    return Faces(points, polygons)


def prism_faces(corners):
    """Its two ends have one face each."""
    angle = 2 * np.pi * np.arange(corners) / corners
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    points = np.concatenate([np.column_stack([ring, np.full(corners, z)]) for z in (-1.0, 1.0)])
    ends = [list(range(corners))[::-1], list(range(corners, 2 * corners))]
    return Faces(points, grid_faces(2, corners, False, True) + ends)


def faces_of(shape, random):
    if shape == "torus":
        around, across = (int(n) for n in random.integers(6, 20, 2))
        v, u = np.meshgrid(np.arange(across) / across, np.arange(around) / around, indexing="ij")
        return Faces(torus_points(u.ravel(), v.ravel()), grid_faces(across, around, True, True))
    if shape == "box":
        return box_faces(int(random.integers(1, 8)))
    if shape == "prism":
        return prism_faces(int(random.integers(3, 24)))
    if shape == "pot":
        return prism_faces(int(random.integers(8, 24))).moved(lambda p: p * (1 + 0.4 * p[:, 2:]))
    raise ValueError(f"there is no body {shape}")


def sheet_faces(random):
    """A grid, bent a little."""
    rows, columns = (int(n) for n in random.integers(3, 12, 2))
    v, u = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    height = random.uniform(0, 1) * np.sin(0.5 * u + random.uniform(0, 6)) + random.uniform(0, 1) * np.sin(0.4 * v)
    return Faces(np.stack([u, v, height], axis=-1).reshape(-1, 3), grid_faces(rows, columns, False, False))


def rounded(points):
    """To single precision."""
    return points.astype(np.float32).astype(float)


def layers_of(faces, way, random):
    """The two layers, as meshes."""
    other = faces.flipped()
    def by_chance(polygon):
        return int(random.integers(len(polygon)))
    if way == "same":
        return faces.mesh(), faces.mesh().flipped()
    if way in ("diagonals", "n-gons", "bent"):
        return faces.mesh(), other.mesh()
    if way == "partly":
        return faces.mesh(), other.of(random.random(len(other.polygons)) < random.choice([0.01, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9])).mesh(by_chance)
    if way == "missing":
        return faces.mesh(), other.of(random.permutation(len(other.polygons)) >= int(random.integers(1, 4))).mesh(by_chance)
    if way == "noise":
        step = np.ptp(faces.points, axis=0).max() / GRID_STEPS
        return faces.mesh(), other.moved(lambda p: p + step * random.uniform(0, 10) * random.uniform(-1, 1, p.shape)).mesh(by_chance)
    if way == "float32":
        return faces.moved(rounded).mesh(), other.moved(lambda p: rounded(rounded(p * 1.1) / np.float32(1.1))).mesh(by_chance)
    return faces.mesh(by_chance), other.mesh(by_chance)


def placed(faces, way, random):
    """At any place, of any size and turn; bent, its quads are not planar."""
    bend = 0.03 * np.ptp(faces.points, axis=0).max() / len(faces.polygons) ** 0.5 if way == "bent" else 0
    size, at, turn = 10.0 ** random.uniform(-2, 3), random.uniform(-3, 3, 3), random_turn(random)
    return faces.moved(lambda p: size * ((p + bend * random.uniform(-1, 1, p.shape)) * random.uniform(0.4, 1.5, 3) @ turn.T + at))


def layers_case(number, random, shape=None, way=None):
    way = way or WAYS[number % len(WAYS)]
    shape = "sheet" if way == "sheet" else shape or SHAPES[number // len(WAYS) % len(SHAPES)]
    if way == "n-gons" and shape not in ("prism", "pot"):
        shape = "prism"
    faces = placed(sheet_faces(random) if shape == "sheet" else faces_of(shape, random), way, random)
    layers = list(layers_of(faces, way, random))
    # Of one mesh, with the same points where they are the same, as exporters write them or not.
    if number % 2:
        random.shuffle(layers)
    truth = {"family": "layers", "shape": f"{shape}, {way}", "options": []}
    if shape == "sheet":
        return Case(joined(layers), truth | {"code": 5, "volume": None, "area": faces.mesh().area()})
    # Quads that are not planar are two surfaces; the first one decides.
    solid = layers[0] if layers[0].volume() > 0 else layers[0].flipped()
    if way != "bent":
        solid = faces.mesh()
    if way == "beside":
        size = np.ptp(solid.points, axis=0).max()
        plain = faces_of("torus", random).mesh().moved(lambda p: size * p + solid.points.max(axis=0) + 2 * size)
        layers.append(plain)
        solid = joined([solid, plain])
    return Case(joined(layers), truth, solid)
