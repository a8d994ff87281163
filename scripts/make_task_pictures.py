#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of the pages for those who print, scan, simulate, or use what a generator made.

meshrepair --picture draws a mesh before and after. Of two it also draws what is inside: halves of the mesh and of the result.
Writes docs/pictures/NAME.png.
"""

import dataclasses
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True

from textured_meshes import files, shapes, stored_pictures, tasks  # noqa: E402

Vector = shapes.Vector
Triangle = list[Vector]


@dataclasses.dataclass(frozen=True)
class Task:
    """A mesh, how it is repaired, and from where it is looked at."""

    result: str
    options: tuple[str, ...]
    view: str
    halves: str = ""  # the view of its halves, if there is one
    size: str = "320x240"


TASKS = {"rook.stl": Task("rook_print.stl", ("--for", "print", "--thicken", "1%"), "20,15"),
         "pawn.xyz": Task("pawn.stl", (), "20,20", size="200x200"),
         "bracket.stl": Task("bracket.ply", ("--for", "simulation"), "50,30", "0,25"),
         "robot.glb": Task("robot_clean.glb", (), "20,15", "0,10")}


def make_meshes(folder: pathlib.Path) -> None:
    made = {**files.stl("rook", tasks.rook()), **files.stl("bracket", tasks.bracket()), **files.glb("robot", tasks.robot())}
    made["pawn.xyz"] = "".join(files.numbers(point) + "\n" for point in tasks.pawn_points()).encode()
    for name, data in made.items():
        (folder / name).write_bytes(data)


def triangles_of(mesh: pathlib.Path, programs: pathlib.Path) -> list[Triangle]:
    """With z up."""
    text = subprocess.run([programs / "meshconvert", "--quiet", "--drop", "all", "--format", "obj", mesh, "-"],
                          stdout=subprocess.PIPE, check=True).stdout.decode()
    points, triangles = [], []
    for line in text.splitlines():
        kind, *rest = line.split() or [""]
        if kind == "v":
            x, y, z = map(float, rest)
            points.append((x, -z, y) if mesh.suffix == ".glb" else (x, y, z))
        elif kind == "f":
            triangles.append([points[int(corner) - 1] for corner in rest])
    return triangles


def back_half(triangle: Triangle) -> Triangle:
    """The polygon of a triangle with y at least 0."""
    found = []
    for one, other in zip(triangle, triangle[1:] + triangle[:1]):
        if one[1] >= 0:
            found.append(one)
        if (one[1] >= 0) != (other[1] >= 0):
            share = one[1] / (one[1] - other[1])
            found.append(tuple(a + share * (b - a) for a, b in zip(one, other)))
    return found


def halves(before: list[Triangle], after: list[Triangle]) -> bytes:
    """Both beside each other, as OBJ."""
    width = max(p[0] for t in before for p in t) - min(p[0] for t in before for p in t)
    lines, count = [], 0
    for shift, triangles in ((0.0, before), (1.15 * width, after)):
        for polygon in map(back_half, triangles):
            if len(polygon) >= 3:
                lines += [f"v {x + shift:.6g} {y:.6g} {z:.6g}" for x, y, z in polygon]
                lines.append("f " + " ".join(str(count + k) for k in range(1, len(polygon) + 1)))
                count += len(polygon)
    return ("\n".join(lines) + "\n").encode()


def picture_of_halves(name: str, task: Task, folder: pathlib.Path, programs: pathlib.Path) -> bytes:
    (folder / "halves.obj").write_bytes(halves(*(triangles_of(folder / one, programs) for one in (name, task.result))))
    subprocess.run([programs / "meshcheck", "--quiet", "halves.obj", "--picture", "picture.png", "--picture-size", "640x240",
                    "--picture-view", task.halves], cwd=folder, check=False)  # halves are no solids
    return (folder / "picture.png").read_bytes()


def pictures(programs: pathlib.Path):
    """Names, and the bytes of each."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        make_meshes(folder)
        for mesh, task in TASKS.items():
            stem = mesh.partition(".")[0]
            subprocess.run([programs / "meshrepair", "--quiet", mesh, task.result, *task.options, "--picture", "picture.png",
                            "--picture-size", task.size, "--picture-view", task.view], cwd=folder, check=True)
            yield f"{stem}.png", (folder / "picture.png").read_bytes()
            if task.halves:
                yield f"{stem}_halves.png", picture_of_halves(mesh, task, folder, programs)


if __name__ == "__main__":
    sys.exit(stored_pictures.main(pathlib.Path(__file__).name, __doc__, make_meshes, pictures))
