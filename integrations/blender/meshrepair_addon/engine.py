# SPDX-License-Identifier: MIT
"""What does the work: the Python package meshrepair if Blender's Python has it, else the programs."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile

import bpy
import numpy as np

from . import ply

try:
    import meshrepair as package
except ImportError:
    package = None

SOUND = (200, 200, 200)  # the colour of a face without fault in what meshcheck --mark writes


class Failed(Exception):
    """Nothing came of it; the message says why."""


class Answer:
    """vertices, triangles, and source: of each triangle the one of the input that it lies in, -1 where a gap was closed; None
    where that is not known. `certified`, and the report as a dict."""

    def __init__(self, vertices, triangles, source, certified, report):
        self.vertices, self.triangles, self.source = vertices, triangles, source
        self.certified, self.report = certified, report


def repair(vertices, triangles, options):
    """`options`: values of long options of meshrepair, by their names without dashes."""
    if package is not None:
        return _by_package(lambda: package.repair(vertices, triangles, **_keywords(options)))
    with tempfile.TemporaryDirectory(prefix="meshrepair_") as name:
        folder = pathlib.Path(name)
        ply.write(folder / "in.ply", vertices, triangles)
        return _by_program(folder, "meshrepair", [folder / "in.ply", folder / "out.ply", "--sources", *_words(options)])


def combine(meshes, operation):
    """`meshes`: pairs of vertices and triangles; `operation` one of bspbool. Sources count through all meshes."""
    if package is not None:
        return _by_package(lambda: package.boolean(meshes, operation, precision="float32"))
    with tempfile.TemporaryDirectory(prefix="meshrepair_") as name:
        folder = pathlib.Path(name)
        inputs = [folder / f"in{number}.ply" for number in range(len(meshes))]
        for path, (vertices, triangles) in zip(inputs, meshes):
            ply.write(path, vertices, triangles)
        return _by_program(folder, "bspbool", ["--op", operation, "--precision", "float32", *inputs, "-o", folder / "out.ply"])


def check(vertices, triangles):
    """Whether the mesh is a valid solid, a dict of how many defects of each kind there are, and a flag for each triangle."""
    if package is not None:
        found = package.check(vertices, triangles)
        return found.valid_solid, dict(found.defects), found.marks != 0
    with tempfile.TemporaryDirectory(prefix="meshrepair_") as name:
        folder = pathlib.Path(name)
        ply.write(folder / "in.ply", vertices, triangles)
        report = _run(folder, "meshcheck", [folder / "in.ply", "--mark", folder / "marked.ply"], (0, 1))["check"]
        _, _, colours = ply.read(folder / "marked.ply")
        marked = np.stack([colours[name] for name in ("red", "green", "blue")], axis=1)
        counts = {name: defect["count"] for name, defect in report["defects"].items()}
        return report["valid_solid"], counts, (marked != SOUND).any(axis=1)


def _keywords(options):
    return {name.replace("-", "_") + ("_" if name == "for" else ""): value for name, value in options.items()}


def _words(options):
    return [f"--{name}={value}" for name, value in options.items()]


def _by_package(work):
    try:
        result = work()
    except package.Error as error:
        raise Failed(str(error)) from None
    return Answer(result.vertices, result.faces, result.source, result.certified, result.report)


def _by_program(folder, program, arguments):
    report = _run(folder, program, arguments, (0, 1))
    vertices, triangles, others = ply.read(folder / "out.ply")
    return Answer(vertices, triangles, others.get("source_triangle"), report["exit_code"] == 0, report)


def _run(folder, program, arguments, fine):
    """The report of the program. Throws Failed where its exit code is none of these."""
    path = program_path(program)
    if path is None:
        raise Failed(f"{program} is not there: install meshrepair, or name its folder in the preferences of the add-on")
    report = folder / "report.json"
    done = subprocess.run([path, *arguments, "--quiet", "--report", report], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                          text=True, check=False)
    if done.returncode not in fine:
        lines = done.stderr.strip().splitlines() or [f"ended with {done.returncode}"]
        # Names of temporary files tell the user nothing.
        raise Failed(re.sub(rf"^{program}: |{re.escape(str(folder))}/\w+\.ply: ", "", lines[-1]))
    return json.loads(report.read_text(encoding="utf-8"))


def program_path(program):
    addon = bpy.context.preferences.addons.get(__package__)
    folder = bpy.path.abspath(addon.preferences.folder) if addon and addon.preferences else ""
    return shutil.which(program, path=os.pathsep.join(filter(None, [folder, os.environ.get("PATH", "")])))
