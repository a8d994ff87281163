# SPDX-License-Identifier: MIT
"""A mesh, what can be said of it, and how it is written."""

import json

import numpy as np


class Mesh:
    """Points and triangles, counter-clockwise seen from outside."""

    def __init__(self, points, triangles):
        self.points = np.asarray(points, dtype=float).reshape(-1, 3)
        self.triangles = np.asarray(triangles, dtype=np.int64).reshape(-1, 3)

    def corners(self):
        return self.points[self.triangles]

    def volume(self):
        a, b, c = np.moveaxis(self.corners() - self.points.mean(axis=0), 1, 0)
        return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)

    def area(self):
        a, b, c = np.moveaxis(self.corners(), 1, 0)
        return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)

    def diagonal(self):
        used = self.points[self.triangles.ravel()]
        return float(np.linalg.norm(used.max(axis=0) - used.min(axis=0)))

    def mean_edge(self):
        corners = self.corners()
        return float(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean())

    def edges(self):
        """Each edge once, and how many triangles it has."""
        t = self.triangles
        sides = np.sort(np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]]), axis=1)
        return np.unique(sides, axis=0, return_counts=True)

    def parts(self):
        """Connected through points."""
        group = np.arange(len(self.points))
        while True:
            least = group[self.triangles].min(axis=1)
            before = group.copy()
            for k in range(3):
                np.minimum.at(group, self.triangles[:, k], least)
            group = group[group]
            if (group == before).all():
                return len(np.unique(group[self.triangles.ravel()]))

    def genus(self):
        """Of a closed mesh: the handles of all parts together."""
        used = len(np.unique(self.triangles))
        euler = used - len(self.edges()[0]) + len(self.triangles)
        return self.parts() - euler // 2

    def is_closed(self):
        return bool((self.edges()[1] == 2).all())

    def moved(self, transform):
        return Mesh(transform(self.points), self.triangles)

    def flipped(self):
        return Mesh(self.points, self.triangles[:, ::-1])


def joined(meshes):
    """All in one, none of their points shared."""
    points, triangles, count = [], [], 0
    for mesh in meshes:
        points.append(mesh.points)
        triangles.append(mesh.triangles + count)
        count += len(mesh.points)
    return Mesh(np.concatenate(points), np.concatenate(triangles))


def welded(mesh, step=1e-9):
    """Points in one place, but for what sines and cosines are off, are one. Triangles that lose a corner go."""
    keys = np.round(mesh.points / (step * max(1.0, mesh.diagonal()))).astype(np.int64)
    _, first, number = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    triangles = number.reshape(-1)[mesh.triangles]
    a, b, c = triangles.T
    return Mesh(mesh.points[first], triangles[(a != b) & (b != c) & (c != a)])


def unwelded(mesh):
    """No two triangles share a point."""
    return Mesh(mesh.corners().reshape(-1, 3), np.arange(3 * len(mesh.triangles)).reshape(-1, 3))


def grid_triangles(rows, columns, wrap_rows=False, wrap_columns=False):
    """Of points numbered row by row. Seen from where rows go up and columns to the right, counter-clockwise."""
    i, j = np.meshgrid(np.arange(rows if wrap_rows else rows - 1), np.arange(columns if wrap_columns else columns - 1),
                       indexing="ij")
    above, right = (i + 1) % rows, (j + 1) % columns
    a, b, c, d = (x.ravel() for x in (i * columns + j, i * columns + right, above * columns + right, above * columns + j))
    return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def patch(place, rows, columns):
    """The surface place(u, v) over the unit square, u along the columns."""
    v, u = np.meshgrid(np.linspace(0, 1, rows), np.linspace(0, 1, columns), indexing="ij")
    return Mesh(place(u.ravel(), v.ravel()), grid_triangles(rows, columns))


def random_turn(random):
    """A rotation, all alike likely."""
    q = random.normal(size=4)
    w, x, y, z = q / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def turned(mesh, turn):
    return mesh.moved(lambda points: points @ turn.T)


def write_off(mesh, path):
    used, numbers = np.unique(mesh.triangles, return_inverse=True)
    points = "\n".join("%r %r %r" % tuple(p) for p in mesh.points[used].tolist())
    triangles = "\n".join("3 %d %d %d" % tuple(t) for t in numbers.reshape(-1, 3).tolist())
    path.write_text(f"OFF\n{len(used)} {len(mesh.triangles)} 0\n{points}\n{triangles}\n", encoding="ascii")


def read_off(path):
    words = path.read_text(encoding="ascii").split()
    points, triangles = int(words[1]), int(words[2])
    first = 4 + 3 * points
    faces = np.array(words[first:first + 4 * triangles], dtype=np.int64).reshape(-1, 4)
    return Mesh(np.array(words[4:first], dtype=float), faces[:, 1:])


class Case:
    """A broken mesh, what was meant, and what to tell a repair: `truth` is written as JSON."""

    def __init__(self, broken, truth, solid=None):
        self.broken = broken
        self.solid = solid
        self.truth = dict(truth)
        if solid is not None:
            self.truth |= {"volume": solid.volume(), "genus": solid.genus(), "parts": solid.parts(),
                           "triangles": len(solid.triangles)} | truth

    def write(self, folder, name):
        """NAME.off, NAME.json, and NAME_true.off of a solid."""
        write_off(self.broken, folder / f"{name}.off")
        if self.solid is not None:
            write_off(self.solid, folder / f"{name}_true.off")
        text = json.dumps({"name": name} | self.truth, indent=1, sort_keys=True)
        (folder / f"{name}.json").write_text(text + "\n", encoding="ascii")
