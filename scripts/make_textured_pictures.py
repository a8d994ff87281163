#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the pictures of docs/attributes.md: meshes with textures and defects, and what meshrepair makes of them.

The meshes are made, and repaired in their own format; meshrepair --picture draws both.
Writes docs/pictures/NAME.png.
"""

import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True

from textured_meshes import files, shapes, stored_pictures  # noqa: E402

SIZE = "320x240"
# How each is written, made and looked at.
MESHES = {"globe.obj": (files.obj, shapes.globe, "40,20"),
          "twins.glb": (files.glb, shapes.twins, "10,20"),
          "vase.ply": (files.ply, shapes.vase, "40,25"),
          "crate.3mf": (files.threemf, shapes.crate, "30,25"),
          "island.glb": (files.glb, shapes.island, "30,35")}


def make_meshes(folder: pathlib.Path) -> None:
    for mesh, (write, make, _) in MESHES.items():
        for name, data in write(mesh.partition(".")[0], make()).items():
            (folder / name).write_bytes(data)


def pictures(programs: pathlib.Path):
    """Names, and the bytes of each."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        make_meshes(folder)
        for mesh, (_, _, view) in MESHES.items():
            stem, _, extension = mesh.partition(".")
            subprocess.run([programs / "meshrepair", "--quiet", mesh, f"{stem}_repaired.{extension}", "--picture", "picture.png",
                            "--picture-size", SIZE, "--picture-view", view], cwd=folder, check=True)
            yield f"{stem}.png", (folder / "picture.png").read_bytes()


if __name__ == "__main__":
    sys.exit(stored_pictures.main(pathlib.Path(__file__).name, __doc__, make_meshes, pictures))
