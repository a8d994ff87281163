# SPDX-License-Identifier: MIT
"""Closed bodies, from which broken ones are made."""

import numpy as np

from .meshes import Mesh, grid_triangles, joined, patch, welded


def ball(level):
    """An icosahedron whose triangles are divided by four so often."""
    golden = (1 + 5 ** 0.5) / 2
    points = [(s, t * golden, 0) for s in (-1, 1) for t in (1, -1)]
    points = points + [(0, *p[:2]) for p in points] + [(p[1], 0, p[0]) for p in points]
    mesh = convex_triangles(np.array(points))
    for _ in range(level):
        mesh = divided(mesh)
        mesh = Mesh(mesh.points / np.linalg.norm(mesh.points, axis=1)[:, None], mesh.triangles)
    return Mesh(mesh.points / np.linalg.norm(mesh.points, axis=1)[:, None], mesh.triangles)


def convex_triangles(points):
    """Of a body with equilateral sides around the origin."""
    count = len(points)
    shortest = min(np.linalg.norm(points[0] - points[i]) for i in range(1, count))
    near = [[np.linalg.norm(a - b) < 1.01 * shortest for b in points] for a in points]
    triangles = []
    for a in range(count):
        for b in range(a + 1, count):
            for c in range(b + 1, count):
                if near[a][b] and near[b][c] and near[c][a]:
                    turn = np.dot(points[a], np.cross(points[b], points[c]))
                    triangles.append((a, b, c) if turn > 0 else (a, c, b))
    return Mesh(points, triangles)


def divided(mesh):
    """Each triangle by four, at the middles of its sides."""
    t = mesh.triangles
    sides = np.sort(np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]]), axis=1)
    edges, number = np.unique(sides, axis=0, return_inverse=True)
    ab, bc, ca = number.reshape(3, -1) + len(mesh.points)
    a, b, c = t.T
    triangles = np.concatenate([np.stack(x, axis=1) for x in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return Mesh(np.concatenate([mesh.points, mesh.points[edges].mean(axis=1)]), triangles)


CUBE_FACES = [(axis, side) for axis in range(3) for side in (-1, 1)]


def cube_face(axis, side, u, v):
    """A point of a face of the cube from -1 to 1; u and v from 0 to 1, turned so that the face looks outward."""
    points = np.empty((len(u), 3))
    points[:, axis] = side
    points[:, (axis + 1) % 3] = 2 * (u if side > 0 else 1 - u) - 1
    points[:, (axis + 2) % 3] = 2 * v - 1
    return points


def cube_grid(cells):
    """The cube from -1 to 1, each face in so many cells a side."""
    faces = [patch(lambda u, v, f=face: cube_face(*f, u, v), cells + 1, cells + 1) for face in CUBE_FACES]
    return welded(joined(faces))


def torus_points(u, v, large=1.0, small=0.35):
    """u around the whole, v around the tube, from 0 to 1."""
    a, b = 2 * np.pi * u, 2 * np.pi * v
    return np.stack([(large + small * np.cos(b)) * np.cos(a), (large + small * np.cos(b)) * np.sin(a),
                     small * np.sin(b)], axis=1)


def torus(around, across, large=1.0, small=0.35):
    v, u = np.meshgrid(np.arange(across) / across, np.arange(around) / around, indexing="ij")
    return Mesh(torus_points(u.ravel(), v.ravel(), large, small),
                grid_triangles(across, around, wrap_rows=True, wrap_columns=True))


def knot(along, across, radius=0.4):
    """A tube around the trefoil that winds twice around the axis and three times around the ring."""
    t = 2 * np.pi * np.arange(along) / along
    line = np.stack([(2 + np.cos(3 * t)) * np.cos(2 * t), (2 + np.cos(3 * t)) * np.sin(2 * t), np.sin(3 * t)], axis=1)
    tangent = np.roll(line, -1, axis=0) - np.roll(line, 1, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    ring = np.stack([np.cos(2 * t), np.sin(2 * t), 0 * t], axis=1)
    first = np.cross(tangent, ring)
    first /= np.linalg.norm(first, axis=1)[:, None]
    second = np.cross(tangent, first)
    angle = 2 * np.pi * np.arange(across) / across
    points = (line[:, None, :] + radius * (np.cos(angle)[None, :, None] * first[:, None, :]
                                           + np.sin(angle)[None, :, None] * second[:, None, :]))
    mesh = Mesh(points.reshape(-1, 3), grid_triangles(along, across, wrap_rows=True, wrap_columns=True))
    return mesh if mesh.volume() > 0 else mesh.flipped()


def lathe(profile, around):
    """A closed profile of (radius, height), counter-clockwise with the radius to the right, turned about z. A radius of 0
    is a point of the axis."""
    angle = 2 * np.pi * np.arange(around) / around
    rings = [np.stack([r * np.cos(angle), r * np.sin(angle), np.full(around, float(h))], axis=1) for r, h in profile]
    wrap = profile[0][0] > 0 or profile[-1][0] > 0
    mesh = Mesh(np.concatenate(rings), grid_triangles(len(profile), around, wrap_rows=wrap, wrap_columns=True))
    return welded(mesh)


class HoledPlate:
    """A plate of square cells, each with a round hole through it: top, bottom, walls of holes, and sides."""

    def __init__(self, columns, rows, thickness=0.3, radius=0.3):
        self.size = (columns, rows)
        self.thickness = thickness
        self.radius = radius

    def volume(self):
        columns, rows = self.size
        return columns * rows * (1 - np.pi * self.radius ** 2) * self.thickness

    def cells(self):
        return [(x + 0.5, y + 0.5) for x in range(self.size[0]) for y in range(self.size[1])]

    def ring(self, centre, height, up, points):
        """One cell of the top or the bottom, from the circle to the square; points: those of a circle, a multiple of 8."""
        angle = 2 * np.pi * (np.arange(points) + 0.0) / points
        direction = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        square = direction * (0.5 / np.abs(direction).max(axis=1))[:, None]
        rows = [np.array(centre) + ring for ring in (self.radius * direction, square)]
        flat = np.concatenate(rows)
        mesh = Mesh(np.column_stack([flat, np.full(len(flat), height)]),
                    grid_triangles(2, points, wrap_columns=True))
        return mesh.flipped() if up else mesh

    def wall_of_hole(self, centre, points):
        angle = 2 * np.pi * np.arange(points) / points
        circle = np.array(centre) + self.radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        rings = [np.column_stack([circle, np.full(points, z)]) for z in (0.0, self.thickness)]
        return Mesh(np.concatenate(rings), grid_triangles(2, points, wrap_columns=True)).flipped()

    def side(self, start, end, points):
        """Upright, from one corner to the next, counter-clockwise seen from above."""
        def place(u, v):
            xy = np.outer(1 - u, start) + np.outer(u, end)
            return np.column_stack([xy, self.thickness * v])
        return patch(place, 2, points)

    def sides(self):
        """Of each the ends, a cell long."""
        columns, rows = self.size
        return ([((x, 0), (x + 1, 0)) for x in range(columns)]
                + [((columns, y), (columns, y + 1)) for y in range(rows)]
                + [((x + 1, rows), (x, rows)) for x in range(columns)]
                + [((0, y + 1), (0, y)) for y in range(rows)])

    def mesh(self, points):
        """Closed: all circles have so many points, a multiple of 8, and all sides what fits to that."""
        parts = [self.ring(c, h, up, points) for c in self.cells() for h, up in ((self.thickness, True), (0.0, False))]
        parts += [self.wall_of_hole(c, points) for c in self.cells()]
        for start, end in self.sides():
            parts.append(self.square_side(start, end, points))
        return welded(joined(parts))

    def square_side(self, start, end, points):
        """Of the points that ring() has on the square."""
        angle = np.linspace(-np.pi / 4, np.pi / 4, points // 4 + 1)
        share = (np.tan(angle) + 1) / 2

        def place(u, v):
            at = np.interp(u, np.linspace(0, 1, len(share)), share)
            return np.column_stack([np.outer(1 - at, start) + np.outer(at, end), self.thickness * v])
        return patch(place, 2, len(share))
