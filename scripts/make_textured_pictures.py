#!/usr/bin/env python3
"""Draws the pictures of docs/attributes.md: meshes with textures and defects, and what meshrepair makes of them.

The meshes are made, and repaired in their own format; meshrepair --picture draws both.
Writes docs/pictures/NAME.png.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True

from textured_meshes import files, shapes, stored_pictures  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[1]
SIZE = "320x240"
# How each is written, made and looked at.
MESHES = {"globe.obj": (files.obj, shapes.globe, "40,20"),
          "twins.glb": (files.glb, shapes.twins, "10,20"),
          "vase.ply": (files.ply, shapes.vase, "40,25"),
          "crate.3mf": (files.threemf, shapes.crate, "30,25"),
          "island.glb": (files.glb, shapes.island, "30,35")}
EXAMPLES = """examples:
  scripts/make_textured_pictures.py
  scripts/make_textured_pictures.py --check --programs build/dev/bin
  scripts/make_textured_pictures.py --meshes FOLDER"""


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


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, epilog=EXAMPLES,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programs", type=pathlib.Path, default=ROOT / "build/release/bin", metavar="FOLDER",
                        help="folder of the programs (default: build/release/bin)")
    parser.add_argument("--meshes", type=pathlib.Path, metavar="FOLDER", help="write the meshes there, and draw nothing")
    parser.add_argument("--check", action="store_true", help="write nothing; exit code 1 if a picture is not up to date")
    arguments = parser.parse_args()
    if arguments.meshes:
        arguments.meshes.mkdir(parents=True, exist_ok=True)
        make_meshes(arguments.meshes)
        return 0
    return stored_pictures.store(pictures(arguments.programs.resolve()), arguments.check, pathlib.Path(__file__).name)


if __name__ == "__main__":
    sys.exit(main())
