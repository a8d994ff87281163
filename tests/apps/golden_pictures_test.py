#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What --picture-colours draws: a picture of each kind of defect, and of what became of triangles, pixel by pixel.

Usage: golden_pictures_test.py PROGRAMS [--update]

--update writes the pictures in tests/apps/pictures anew instead of comparing with them: look at them then.
"""

import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

PICTURES = pathlib.Path(__file__).resolve().parent / "pictures"
SIZE = "120x90"
CORNERS = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
SIDES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
CUBE = [face for a, b, c, d in SIDES for face in ((a, b, c), (a, c, d))]
TOP, FRONT = 2, 4  # the first of two triangles each


def mesh(points, faces):
    lines = [f"v {x} {y} {z}" for x, y, z in points] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    return "\n".join(lines) + "\n"


def without(faces, *left_out):
    return [face for i, face in enumerate(faces) if i not in left_out]


def turned(face):
    return face[::-1]


def two_cubes(offset):
    points = CORNERS + [tuple(a + b for a, b in zip(corner, offset)) for corner in CORNERS]
    return points, CUBE + [tuple(8 + corner for corner in face) for face in CUBE]


def touching_cubes():
    """They share the point (1, 1, 1)."""
    points, faces = two_cubes((1, 1, 1))
    return points, [tuple(7 if corner == 8 else corner for corner in face) for face in faces]


# Kind of defect, as reports have it -> points and faces with it.
DEFECTS = {
    "open_edges": (CORNERS, without(CUBE, TOP)),
    "nonmanifold_edges": (CORNERS + [(0.5, 0.2, 1.6)], CUBE + [(4, 5, 8)]),
    "nonmanifold_vertices": touching_cubes(),
    "inconsistent_edges": (CORNERS, [turned(face) if i == FRONT else face for i, face in enumerate(CUBE)]),
    "inside_out_parts": (CORNERS, [turned(face) for face in CUBE]),
    "self_intersections": two_cubes((0.7, 0.3, 0.4)),
    "degenerate_triangles": (CORNERS + [(0.5, 0, 1)], CUBE + [(4, 8, 5)]),
    "duplicate_triangles": (CORNERS, CUBE + [CUBE[TOP]]),
    "not_finite_triangles": (CORNERS + [("nan", 0, 2)], CUBE + [(4, 5, 8)]),
    "unused_points": (CORNERS + [(2, 2, 2)], CUBE),
}
BROKEN = (two_cubes((0.7, 0.3, 0.4))[0],
          [turned(face) if i in (FRONT, 15) else face for i, face in enumerate(two_cubes((0, 0, 0))[1]) if i != TOP + 12])


def pixels_of(png):
    """Width, height and the bytes of all pixels, of a PNG of 8 bits without interlacing."""
    at, packed = 8, b""
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at:at + 8])
        body = png[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colours, _, _, interlaced = struct.unpack(">2I5B", body)
            if (depth, interlaced) != (8, 0) or colours not in (2, 6):
                raise ValueError("another kind of PNG")
        packed += body if kind == b"IDAT" else b""
        at += 12 + length
    count = 3 if colours == 2 else 4
    lines, data = [bytes(width * count)], zlib.decompress(packed)
    for y in range(height):
        start = y * (width * count + 1)
        lines.append(unfiltered(data[start], data[start + 1:start + 1 + width * count], lines[-1], count))
    return width, height, b"".join(lines[1:])


def unfiltered(kind, line, above, count):
    """A line of pixels, from what a filter of PNG has left of it."""
    out = bytearray()
    for i, value in enumerate(line):
        left, up, corner = (out[i - count], above[i], above[i - count]) if i >= count else (0, above[i], 0)
        way = left + up - corner
        paeth = min((left, up, corner), key=lambda one: abs(way - one))
        out.append((value + (0, left, up, (left + up) // 2, paeth)[kind]) & 255)
    return bytes(out)


class Faults:
    def __init__(self, update):
        self.count, self.update = 0, update

    def say(self, text):
        print(text, file=sys.stderr)
        self.count += 1

    def compare(self, name, made):
        golden = PICTURES / f"{name}.png"
        if self.update:
            golden.write_bytes(made)
        elif not golden.exists() or pixels_of(made) != pixels_of(golden.read_bytes()):
            self.say(f"{name}: not as in {golden}")


def draw(programs, folder, program, *arguments):
    """The bytes of the picture, and the report."""
    picture, report = folder / "p.png", folder / "r.json"
    subprocess.run([programs / program, "-q", *arguments, "--picture", picture, "--picture-size", SIZE, "--report", report],
                   check=False, cwd=folder)
    return picture.read_bytes(), json.loads(report.read_text(encoding="utf-8"))


def main():
    programs, faults = pathlib.Path(sys.argv[1]).resolve(), Faults("--update" in sys.argv)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for defect, (points, faces) in DEFECTS.items():
            (folder / "in.obj").write_text(mesh(points, faces), encoding="ascii")
            picture, report = draw(programs, folder, "meshcheck", "in.obj", "--picture-colours", "defects")
            if report["check"]["defects"][defect]["count"] == 0:
                faults.say(f"{defect}: the mesh has none")
            faults.compare(defect, picture)
            plain, _ = draw(programs, folder, "meshcheck", "in.obj", "--picture-colours", "looks")
            if plain == picture:
                faults.say(f"{defect}: no other colours")
        (folder / "in.obj").write_text(mesh(*BROKEN), encoding="ascii")
        fates, _ = draw(programs, folder, "meshrepair", "in.obj", "out.obj", "--picture-colours", "fates")
        faults.compare("fates", fates)
        again, _ = draw(programs, folder, "meshrepair", "in.obj", "out.obj", "--picture-colours", "fates", "--threads", "1")
        if again != fates:
            faults.say("fates: one thread draws something else")
    return 1 if faults.count else 0


if __name__ == "__main__":
    sys.exit(main())
