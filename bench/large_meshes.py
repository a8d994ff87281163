#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes a mesh of many millions of broken triangles, strip by strip, so that it needs little memory.

    bench/large_meshes.py scan 20000000 scan.ply     a surface as a scan gives it
    bench/large_meshes.py bodies 20000000 bodies.stl bodies that overlap their neighbours

Everywhere are holes, triangles that face the wrong way, and places where the surface passes through itself. The same
arguments make the same bytes. Needs numpy."""

import argparse
import math
import pathlib

import numpy as np

HOLES, FLIPS, FOLDS = 200, 1000, 50  # for each million triangles
HOLE, FOLD = 4, 7  # cells: half of a hole's side, of a fold's


class Sheet:
    """A torus, cut into rows x columns cells of two triangles, with rough places."""

    def __init__(self, rows, columns, center, radii, seed):
        self.rows, self.columns, self.center, self.radii, self.seed = rows, columns, center, radii, seed
        rng = np.random.default_rng(seed)
        millions = 2 * rows * columns / 1e6
        self.holes = self._places(rng, millions * HOLES)
        self.folds = self._places(rng, millions * FOLDS)
        self.flips = 1e-6 * FLIPS

    def _places(self, rng, count):
        count = max(1, round(count))
        return np.stack([rng.integers(0, self.rows, count), rng.integers(0, self.columns, count)], axis=1)

    def vertices(self, row):
        """columns x 3, of one row."""
        row %= self.rows
        rng = np.random.default_rng([self.seed, row])
        column = np.arange(self.columns, dtype=np.float64)
        along = np.full(self.columns, float(row))
        for r, c in self._near(self.folds, row, FOLD):  # it moves over its neighbours
            away = np.hypot(r, (column - c + self.columns / 2) % self.columns - self.columns / 2)
            along += np.where(away < FOLD, 2 * FOLD * np.cos(away * math.pi / (2 * FOLD)) ** 2, 0)
        u = 2 * math.pi * along / self.rows
        v = 2 * math.pi * column / self.columns
        large, small = self.radii
        rough = small * (1 + 0.02 * np.sin(9 * u) * np.cos(11 * v)) + 0.1 * small / self.columns * rng.standard_normal(self.columns)
        ring = large + rough * np.cos(v)
        return np.stack([ring * np.cos(u), ring * np.sin(u), rough * np.sin(v)], axis=1) + self.center

    def triangles(self, row):
        """n x 3 indices into the vertices of this row and, behind them, of the next."""
        rng = np.random.default_rng([self.seed, row, 1])
        left = np.arange(self.columns)
        right = (left + 1) % self.columns
        faces = np.stack([
            np.stack([left, left + self.columns, right], axis=1),
            np.stack([right, left + self.columns, right + self.columns], axis=1)
        ], axis=1)
        keep = np.ones(self.columns, dtype=bool)
        for _, column in self._near(self.holes, row, HOLE):
            keep[np.arange(column - HOLE, column + HOLE) % self.columns] = False
        faces = faces[keep].reshape(-1, 3)
        flipped = rng.random(len(faces)) < self.flips
        faces[flipped] = faces[flipped][:, ::-1]
        return faces

    def _near(self, places, row, size):
        away = (row - places[:, 0] + self.rows // 2) % self.rows - self.rows // 2
        for i in np.flatnonzero(np.abs(away) < size):
            yield away[i], places[i, 1]


def scan(triangles):
    columns = round(math.sqrt(triangles / 2 / 3))
    return [Sheet(3 * columns, columns, np.zeros(3), (100.0, 33.0), 1)]


def bodies(triangles):
    """Rings of 20,000 triangles in a cubic lattice; each overlaps those beside it."""
    count = max(1, round(triangles / 20_000))
    side = math.ceil(count ** (1 / 3))
    lattice = [np.array([i % side, i // side % side, i // side**2]) for i in range(count)]
    return [Sheet(173, 58, 2.1 * at + 0.13 * (at[0] % 3), (1.0, 0.4), 10 + i) for i, at in enumerate(lattice)]


KINDS = {"scan": scan, "bodies": bodies}


def write_stl(sheets, out):
    out.write(b"\0" * 80 + np.uint32(0).tobytes())
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    count = 0
    for sheet in sheets:
        here = sheet.vertices(0)
        for row in range(sheet.rows):
            there = sheet.vertices(row + 1)
            faces = sheet.triangles(row)
            records = np.zeros(len(faces), dtype=record)
            records["corners"] = np.concatenate([here, there])[faces]
            out.write(records.tobytes())
            count += len(faces)
            here = there
    out.seek(80)
    out.write(np.uint32(count).tobytes())
    return count


def write_ply(sheets, out):
    vertices = sum(sheet.rows * sheet.columns for sheet in sheets)

    def header(faces):
        return (f"ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\n"
                f"property float z\nelement face {faces:010d}\nproperty list uchar int vertex_indices\nend_header\n").encode()

    out.write(header(0))
    for sheet in sheets:
        for row in range(sheet.rows):
            out.write(sheet.vertices(row).astype("<f4").tobytes())
    record = np.dtype([("count", "u1"), ("corners", "<i4", 3)])
    count, first = 0, 0
    for sheet in sheets:
        total = sheet.rows * sheet.columns
        for row in range(sheet.rows):
            faces = sheet.triangles(row)
            records = np.zeros(len(faces), dtype=record)
            records["count"] = 3
            records["corners"] = first + (faces + row * sheet.columns) % total
            out.write(records.tobytes())
            count += len(faces)
        first += total
    out.seek(0)
    out.write(header(count))
    return count


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", choices=KINDS)
    parser.add_argument("triangles", type=int, help="about so many")
    parser.add_argument("out", type=pathlib.Path, metavar="OUT.stl|OUT.ply")
    arguments = parser.parse_args()
    write = {".stl": write_stl, ".ply": write_ply}.get(arguments.out.suffix)
    if write is None:
        parser.error("OUT ends in .stl or .ply")
    with arguments.out.open("wb") as out:
        count = write(KINDS[arguments.kind](arguments.triangles), out)
    print(f"{arguments.out}: {count:,} triangles")


if __name__ == "__main__":
    main()
