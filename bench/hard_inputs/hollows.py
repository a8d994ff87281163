# SPDX-License-Identifier: MIT
"""Hollow bodies: by mistake, as a generator's double wall with pinholes, or on purpose, as bottles and balls with drain holes.
What was meant of the former is the full body, of the latter the solid as it is."""

import numpy as np

from .bodies import lathe
from .meshes import Case, Mesh, grid_triangles, random_turn, turned

KINDS = ("double wall", "bottle", "double wall", "drained ball", "double wall", "bird house", "double wall", "captive ball")


def radius(theta, phi, random):
    waves = random.integers(2, 6, 3)
    bumps = random.uniform(0, 0.15, 2)
    return 1 + bumps[0] * np.sin(waves[0] * phi) * np.sin(waves[1] * theta) ** 2 + bumps[1] * np.cos(waves[2] * theta)


class GridBall:
    """A bumpy ball of 2 n columns and n rows: two walls of it, with square holes of whole cells."""

    def __init__(self, n, wall, noise, random):
        theta, phi = np.linspace(0, np.pi, n + 1)[1:-1], np.linspace(0, 2 * np.pi, 2 * n, endpoint=False)
        t, p = np.meshgrid(theta, phi, indexing="ij")
        r = radius(t, p, random)
        ways = np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], axis=-1)
        self.rows, self.columns = t.shape

        def points(depth):
            ring = ways * (r - depth)[..., None] + random.normal(size=ways.shape) * noise / n
            poles = np.array([[0, 0, ring[0, :, 2].mean()], [0, 0, ring[-1, :, 2].mean()]])
            return np.concatenate([ring.reshape(-1, 3), poles])
        self.outer, self.inner = points(0), points(wall)
        self.is_hole = np.zeros((self.rows - 1, self.columns), dtype=bool)

    def add_hole(self, cells, random):
        """Where there is room, away from the poles and from other holes."""
        margin = self.rows // 5
        for _ in range(50):
            row = int(random.integers(margin, max(margin + 1, self.rows - margin - cells)))
            columns = (int(random.integers(0, self.columns)) + np.arange(-2, cells + 2)) % self.columns
            if not self.is_hole[max(row - 2, 0):row + cells + 2][:, columns].any():
                self.is_hole[row:row + cells, columns[2:-2]] = True
                return

    def wall(self, with_holes):
        grid = grid_triangles(self.rows, self.columns, wrap_columns=True)[:, ::-1].reshape(2, -1, 3)
        keep = ~self.is_hole.ravel() if with_holes else np.ones(self.is_hole.size, dtype=bool)
        first, count = np.arange(self.columns), self.rows * self.columns
        after, last = np.roll(first, -1), count - self.columns
        caps = [np.stack([np.full_like(first, count), first, after], axis=1),
                np.stack([np.full_like(first, count + 1), last + after, last + first], axis=1)]
        return np.concatenate([*grid[:, keep], *caps])

    def hollow(self):
        wall, offset = self.wall(True), len(self.outer)
        sides = np.concatenate([wall[:, [0, 1]], wall[:, [1, 2]], wall[:, [2, 0]]])
        keys = sides[:, 0] * offset + sides[:, 1]
        rim = sides[~np.isin(keys, sides[:, 1] * offset + sides[:, 0])]
        a, b = rim.T
        tubes = [np.stack([b, a, a + offset], axis=1), np.stack([b, a + offset, b + offset], axis=1)]
        return Mesh(np.concatenate([self.outer, self.inner]), np.concatenate([wall, wall[:, ::-1] + offset, *tubes]))

    def full(self):
        return Mesh(self.outer, self.wall(False))


def double_wall(random):
    n = int(random.choice([36, 60, 100, 160]))
    ball = GridBall(n, random.uniform(0.012, 0.12), random.choice([0, 0.01, 0.05]), random)
    # Up to 5 % of the size: what is wider is an opening.
    widest = max(1, int(0.05 * 3.5 * n / np.pi))
    cells = int(random.integers(1, min(widest, 3) + 1))
    holes = int(random.choice([1, 3, 10, 40]))
    for _ in range(holes):
        ball.add_hole(cells, random)
    return ball.hollow(), ball.full(), f"{holes} pinholes of {cells} cells, {n} rows"


def bird_house(random):
    n = int(random.choice([36, 60, 100, 160]))
    ball = GridBall(n, random.uniform(0.05, 0.15), 0, random)
    cells = int(random.uniform(0.3, 0.6) * n / np.pi)
    ball.add_hole(cells, random)
    solid = ball.hollow()
    return solid, solid, f"an opening of {cells} cells, {n} rows"


def ball_profile(outer, inner, top, bottom, steps):
    """Of a ball with a wall and holes of these radii at its poles."""
    def curve(r):
        ends = [np.arcsin(top / r), np.pi - np.arcsin(bottom / r)] if bottom else [np.arcsin(top / r), np.pi]
        angles = np.linspace(ends[0], ends[1], steps)
        points = [(float(r * np.sin(a)), float(r * np.cos(a))) for a in angles]
        if not bottom:
            points[-1] = (0.0, -r)
        return points
    return curve(outer), curve(inner)


def drained_ball(random):
    around, steps = int(random.choice([32, 64, 128])), int(random.choice([16, 48, 96]))
    wall = random.uniform(0.03, 0.12)
    top = random.uniform(0.04, 0.12)
    bottom = top if random.random() < 0.5 else 0.0
    outer, inner = ball_profile(1.0, 1.0 - wall, top, bottom, steps)
    if bottom:
        profile = [*outer[::-1], *inner, outer[-1]]
    else:
        profile = [*outer[::-1], *inner]
    solid = lathe(profile, around)
    return solid, solid, f"drain holes of {top:.2g}, {around} around"


def bottle(random):
    around = int(random.choice([24, 48, 96, 192]))
    wall, neck, r, h = random.uniform(0.02, 0.06), random.uniform(0.1, 0.3), 0.5, random.uniform(1, 3)
    steps = int(random.choice([1, 10, 40]))
    def along(a, b):
        return [tuple(np.array(a) + (np.array(b) - a) * i / steps) for i in range(steps)]
    outer = [(0.0, 0.0), *along((r, 0.0), (r, h)), *along((r, h), (neck, h + 0.4)), *along((neck, h + 0.4), (neck, h + 0.8)), (neck, h + 0.8)]
    inner = [(0.0, wall), *along((r - wall, wall), (r - wall, h - wall)), *along((r - wall, h - wall), (neck - wall, h + 0.4 - wall)),
             *along((neck - wall, h + 0.4 - wall), (neck - wall, h + 0.8)), (neck - wall, h + 0.8)]
    solid = lathe(outer + inner[::-1], around)
    return solid, solid, f"a bottle, {around} around"


def captive_ball(random):
    """A ball in a cage of windows."""
    n = int(random.choice([36, 60]))
    cage = GridBall(n, random.uniform(0.08, 0.2), 0, random)
    cells = n // 5
    for _ in range(12):
        cage.add_hole(cells, random)
    solid = cage.hollow()
    inner = GridBall(n, 0.1, 0, random).full()
    both = Mesh(np.concatenate([solid.points, 0.4 * inner.points]),
                np.concatenate([solid.triangles, inner.triangles + len(solid.points)]))
    return both, both, f"a ball in a cage, windows of {cells} cells"


MAKERS = {"double wall": double_wall, "bottle": bottle, "drained ball": drained_ball, "bird house": bird_house, "captive ball": captive_ball}


def hollow_case(number, random, kind=None):
    kind = kind or KINDS[number % len(KINDS)]
    broken, solid, text = MAKERS[kind](random)
    turn = random_turn(random)
    return Case(turned(broken, turn), {"family": "hollows", "shape": f"{kind}, {text}", "options": ["--for", "print"]},
                turned(solid, turn))
