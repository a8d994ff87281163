#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Meshes come out the same with and without --picture, byte for byte, in all formats.

Usage: picture_test.py PROGRAMS
"""

import json
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))

import make_textured_pictures  # noqa: E402

FORMATS = ("stl", "stl-ascii", "obj", "off", "ply", "ply-ascii", "glb", "gltf", "3mf")


def run(programs: pathlib.Path, folder: pathlib.Path, program: str, *arguments: str) -> None:
    subprocess.run([programs / program, "-q", *arguments], cwd=folder, check=True)


def files_of(programs: pathlib.Path, folder: pathlib.Path, *command: str) -> dict[str, bytes]:
    """What a command writes, "OUT" being the name of its mesh, in a new folder beside the meshes."""
    with tempfile.TemporaryDirectory(dir=folder) as name:
        out = pathlib.Path(name)
        run(programs, folder, *(word.replace("OUT", str(out / "out")) for word in command))
        return {path.name: path.read_bytes() for path in out.iterdir() if path.suffix != ".png"}


def main() -> int:
    programs = pathlib.Path(sys.argv[1]).resolve()
    faults = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        make_textured_pictures.make_meshes(folder)
        commands = [(program, mesh, "OUT.mesh", "--format", mesh_format) for mesh_format in FORMATS
                    for program in ("meshrepair", "meshconvert") for mesh in ("crate.3mf", "globe.obj")]
        commands += [("bspbool", "globe.obj", "vase.ply", "--op", "union", "-o", "OUT.mesh", "--format", mesh_format)
                     for mesh_format in FORMATS]
        commands += [("meshrepair", "crate.3mf", "OUT.obj", "--drop", "all")]
        for command in commands:
            plain = files_of(programs, folder, *command)
            drawn = files_of(programs, folder, *command, "--picture", "OUT.png", "--picture-size", "40x30", "--report", "r.json")
            picture = json.loads((folder / "r.json").read_text(encoding="utf-8"))["picture"]
            if not plain or plain != drawn or (picture["width"], picture["height"], picture["warnings"]) != (82, 30, []):
                print(*command, "differs with --picture:", sorted(plain), sorted(drawn), picture, file=sys.stderr)
                faults += 1
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
