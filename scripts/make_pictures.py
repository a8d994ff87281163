#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of README.md: a broken mesh, and what meshrepair makes of it.

A small rasteriser with a depth buffer, shading by the angle to the light, and supersampling. Back faces are red,
boundary edges yellow.
Writes docs/pictures/before.png and docs/pictures/after.png. Needs python3-numpy.
"""

import argparse
import collections
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

try:
    import numpy as np
except ImportError:
    sys.exit("make_pictures.py: python3-numpy is missing: scripts/setup.sh installs it")

ROOT = pathlib.Path(__file__).resolve().parents[1]
MESH = ROOT / "samples" / "meshes" / "broken_torus_box.stl"
PICTURES = ROOT / "docs" / "pictures"
WIDTH, HEIGHT, SAMPLES = 480, 340, 4  # pixels, and samples along each side of one
EYE = np.array([0.50, -0.70, 0.62])  # direction from the scene to the eye
LIGHT = np.array([0.1, -0.5, 0.8])
FRONT, BACK, EDGE, LINE, PAPER = (np.array(c, float) for c in (
    (126, 164, 204), (214, 62, 48), (250, 196, 0), (52, 70, 92), (255, 255, 255)))
EDGE_WIDTH, LINE_WIDTH = 3.2, 0.35  # in pixels
EXAMPLES = """examples:
  scripts/make_pictures.py
  scripts/make_pictures.py --check --programs build/dev/bin"""


def read_stl(data: bytes) -> tuple[np.ndarray, np.ndarray]:
    """Points and triangles of a binary STL; equal corners are one point."""
    count = struct.unpack_from("<I", data, 80)[0]
    kind = np.dtype([("normal", "<3f4"), ("corners", "<9f4"), ("attribute", "<u2")])
    corners = np.frombuffer(data, kind, count, 84)["corners"].reshape(-1, 3)
    points, triangles = np.unique(corners, axis=0, return_inverse=True)
    return points.astype(float), triangles.reshape(-1, 3)


def repaired(programs: pathlib.Path) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "repaired.stl"
        subprocess.run([programs / "meshrepair", "--quiet", MESH, out], check=True)
        return out.read_bytes()


def camera() -> np.ndarray:
    """Rows: right, up, towards the eye."""
    towards = EYE / np.linalg.norm(EYE)
    right = np.cross([0, 0, 1], towards)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(towards, right), towards])


def projection(points: np.ndarray):
    """A function from points to sample coordinates and depth, such that all these points are in the picture."""
    seen = points @ camera().T
    low, high = seen.min(axis=0), seen.max(axis=0)
    scale = 0.94 * SAMPLES * min(WIDTH / (high[0] - low[0]), HEIGHT / (high[1] - low[1]))
    middle = (low + high) / 2

    def project(some: np.ndarray) -> np.ndarray:
        view = (some @ camera().T - middle) * scale
        return np.stack([view[:, 0] + SAMPLES * WIDTH / 2, SAMPLES * HEIGHT / 2 - view[:, 1], view[:, 2]], axis=1)

    return project


class Canvas:
    """Colours and depths of all samples; larger depths are nearer."""

    def __init__(self) -> None:
        self.colour = np.tile(PAPER, (HEIGHT * SAMPLES, WIDTH * SAMPLES, 1))
        self.depth = np.full((HEIGHT * SAMPLES, WIDTH * SAMPLES), -np.inf)

    def box(self, corners: np.ndarray, margin: float):
        low = np.maximum(np.floor(corners[:, :2].min(axis=0) - margin), 0).astype(int)
        high = np.minimum(np.ceil(corners[:, :2].max(axis=0) + margin) + 1, [WIDTH * SAMPLES, HEIGHT * SAMPLES]).astype(int)
        window = np.s_[low[1]:high[1], low[0]:high[0]]
        x, y = np.meshgrid(np.arange(low[0], high[0]) + 0.5, np.arange(low[1], high[1]) + 0.5)
        return window, x, y

    def put(self, window, inside: np.ndarray, depth: np.ndarray, colour: np.ndarray) -> None:
        nearer = inside & (depth > self.depth[window])
        self.depth[window][nearer] = depth[nearer]
        self.colour[window][nearer] = colour

    def triangle(self, corners: np.ndarray, colour: np.ndarray) -> None:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = corners
        area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        if area == 0:
            return
        window, x, y = self.box(corners, 0)
        b = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area
        c = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area
        self.put(window, (b >= 0) & (c >= 0) & (b + c <= 1), az + b * (bz - az) + c * (cz - az), colour)

    def line(self, ends: np.ndarray, width: float, colour: np.ndarray) -> None:
        """A little in front of where it is, so that the surface at it does not hide it."""
        radius = width * SAMPLES / 2
        window, x, y = self.box(ends, radius)
        along = ends[1] - ends[0]
        length = max(along[0] ** 2 + along[1] ** 2, 1e-12)
        t = np.clip(((x - ends[0, 0]) * along[0] + (y - ends[0, 1]) * along[1]) / length, 0, 1)
        away = (x - ends[0, 0] - t * along[0]) ** 2 + (y - ends[0, 1] - t * along[1]) ** 2
        self.put(window, away <= radius ** 2, ends[0, 2] + t * along[2] + 1.5 * SAMPLES, colour)

    def pixels(self) -> np.ndarray:
        mean = self.colour.reshape(HEIGHT, SAMPLES, WIDTH, SAMPLES, 3).mean(axis=(1, 3))
        return np.clip(np.rint(mean), 0, 255).astype(np.uint8)


def edge_counts(triangles: np.ndarray) -> collections.Counter:
    return collections.Counter(tuple(sorted((int(t[k]), int(t[(k + 1) % 3])))) for t in triangles for k in range(3))


def picture_of(points: np.ndarray, triangles: np.ndarray, project) -> np.ndarray:
    canvas = Canvas()
    places = project(points)
    light = LIGHT / np.linalg.norm(LIGHT)
    for triangle in triangles:
        a, b, c = points[triangle]
        normal = np.cross(b - a, c - a)
        normal /= max(np.linalg.norm(normal), 1e-300)
        front = normal @ camera()[2] > 0
        brightness = 0.35 + 0.35 * (1 + float((normal if front else -normal) @ light))
        canvas.triangle(places[triangle], (FRONT if front else BACK) * brightness)
    for (i, j), count in edge_counts(triangles).items():
        if count == 1:
            canvas.line(places[[i, j]], EDGE_WIDTH, EDGE)
        else:
            canvas.line(places[[i, j]], LINE_WIDTH, LINE)
    return canvas.pixels()


def png_of(pixels: np.ndarray) -> bytes:
    """Each line as differences from the one above, which compresses well."""
    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    above = np.vstack([np.zeros_like(pixels[:1]), pixels[:-1]])
    lines = (pixels - above).reshape(len(pixels), -1)
    data = b"".join(b"\x02" + line.tobytes() for line in lines)
    height, width = pixels.shape[:2]
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(data, 9)) + chunk(b"IEND", b""))


def pixels_of(png: bytes) -> np.ndarray:
    """Of a picture that png_of() made."""
    width, height = struct.unpack_from(">II", png, 16)
    size = struct.unpack_from(">I", png, 33)[0]
    lines = np.frombuffer(zlib.decompress(png[41:41 + size]), np.uint8).reshape(height, 1 + 3 * width)
    return np.cumsum(lines[:, 1:], axis=0, dtype=np.uint8).reshape(height, width, 3)


def looks_the_same(one: np.ndarray, other: np.ndarray) -> bool:
    """But for a few pixels: another processor may round otherwise."""
    if one.shape != other.shape:
        return False
    far = np.abs(one.astype(int) - other.astype(int)).max(axis=2) > 16
    return float(far.mean()) < 0.001


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, epilog=EXAMPLES,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programs", type=pathlib.Path, default=ROOT / "build/release/bin", metavar="FOLDER",
                        help="folder of the programs (default: build/release/bin)")
    parser.add_argument("--check", action="store_true", help="write nothing; exit code 1 if a picture is not up to date")
    arguments = parser.parse_args()
    before, after = read_stl(MESH.read_bytes()), read_stl(repaired(arguments.programs.resolve()))
    project = projection(before[0])
    stale = 0
    for name, (points, triangles) in (("before.png", before), ("after.png", after)):
        path, pixels = PICTURES / name, picture_of(points, triangles, project)
        if arguments.check and not (path.exists() and looks_the_same(pixels_of(path.read_bytes()), pixels)):
            print(f"{path.relative_to(ROOT)}: is not up to date: run scripts/make_pictures.py", file=sys.stderr)
            stale += 1
        elif not arguments.check:
            PICTURES.mkdir(exist_ok=True)
            path.write_bytes(png_of(pixels))
            print(f"written: {path.relative_to(ROOT)}")
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
