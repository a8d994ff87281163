# SPDX-License-Identifier: MIT
"""The files that commands in the documents name."""

import gzip
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
MESHES = ROOT / "samples" / "meshes"
sys.path.insert(0, str(ROOT / "tests" / "apps"))
sys.path.insert(0, str(ROOT / "scripts"))
import make_cli_inputs  # noqa: E402
import make_task_pictures  # noqa: E402
import make_textured_pictures  # noqa: E402

COPIES = {"broken.stl": "broken_torus_box.stl", "broken.obj": "broken_spheres.obj", "part.stl": "cube.stl",
          "part.obj": "hollow_sphere.obj", "duct.stl": "cube.stl", "original.stl": "broken_torus_box.stl", "body.stl": "cube.stl",
          "half.stl": "broken_torus_box.stl", "tenth.stl": "broken_torus_box.stl",
          "drill.obj": "hollow_sphere.obj", "a.obj": "hollow_sphere.obj", "site.obj": "hollow_sphere.obj",
          "b.off": "overlapping_spheres.off",
          "open_bowl.ply": "open_bowl.ply", "hollow_sphere.obj": "hollow_sphere.obj",
          "scans/one.stl": "broken_torus_box.stl", "scans/more/two.ply": "open_bowl.ply", "sheets/bowl.ply": "open_bowl.ply"}

# In place of programs that need not be there. The key that is asked of jq has to be in the report.
CURL = '#!/bin/sh\nexec cat "{mesh}"\n'
JQ = """#!/usr/bin/env python3
import functools, json, sys
print(json.dumps(functools.reduce(lambda value, key: value[key], sys.argv[1].split(".")[1:], json.load(sys.stdin))))
"""


def ascii_ply(points: bytes) -> bytes:
    """A PLY of points alone from lines of coordinates."""
    count = points.count(b"\n")
    return (b"ply\nformat ascii 1.0\nelement vertex %d\nproperty double x\nproperty double y\nproperty double z\n"
            b"end_header\n" % count) + points


def clouds() -> dict[str, bytes]:
    make = make_cli_inputs
    sphere = make.sphere_points(1500)
    hills = make.hill_points(2000)
    return {"scan.xyz": make.lines_of(sphere), "scan.pcd": make.binary_pcd(sphere, promised=len(sphere)),
            "scan.ply": ascii_ply(make.lines_of(sphere)), "hills.xyz": make.lines_of(hills),
            "terrain.pcd": make.binary_pcd(hills, promised=len(hills)),
            "half_sphere.xyz": make.lines_of(p for p in make.sphere_points(4000) if p[2] > 0.4)}


def make_folder(folder: pathlib.Path, programs: pathlib.Path) -> None:
    """All files that the documents name, in the folder."""
    for name, source in COPIES.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(MESHES / source, folder / name)
    for name, data in {**clouds(), "triangle.obj": make_cli_inputs.SINGLE_TRIANGLE,
                       "project.3mf": make_cli_inputs.project("NegativeVolume", *make_cli_inputs.HALVES)}.items():
        (folder / name).write_bytes(data)
    make_textured_pictures.make_meshes(folder)
    make_task_pictures.make_meshes(folder)
    (folder / "scan.stl.gz").write_bytes(gzip.compress((folder / "broken.stl").read_bytes()))
    (folder / "part.zip").write_bytes(make_cli_inputs.zip_of({"a/part.stl": (folder / "part.stl").read_bytes(), "read.me": b""}))
    for kind in ("zip", "gztar"):
        shutil.make_archive(str(folder / "scans"), kind, folder / "scans")
    os.symlink(ROOT / "samples", folder / "samples")
    os.symlink(ROOT / "scripts", folder / "scripts")
    os.symlink(ROOT / "integrations", folder / "integrations")
    (folder / "build" / "release").mkdir(parents=True)
    os.symlink(programs, folder / "build" / "release" / "bin")

    def run(program: str, *arguments: str) -> None:
        subprocess.run([programs / program, "-q", *arguments], cwd=folder, check=True)

    run("meshrepair", "hollow_sphere.obj", "hole.stl")
    run("meshrepair", "hollow_sphere.obj", "a.ply")
    run("meshrepair", "hollow_sphere.obj", "b.ply")
    run("meshrepair", "broken.stl", "repaired.stl")
    run("meshbodies", "body.stl", "drill.obj", "-o", "assembly.3mf")
    for name, mesh in (("a.bsp", "a.obj"), ("b.bsp", "b.off"), ("c.bsp", "broken.obj")):
        run("bspbuild", mesh, "-o", name)
        run("bspsolid", name, "-o", name)


def make_stand_ins(folder: pathlib.Path) -> None:
    for name, text in (("curl", CURL.format(mesh=MESHES / "broken_torus_box.stl")), ("jq", JQ)):
        (folder / name).write_text(text, encoding="utf-8")
        (folder / name).chmod(0o755)
