# SPDX-License-Identifier: MIT
"""Runs the macro inside FreeCAD, on the mesh that MESHREPAIR_MESH names, and says "fine" at the end: FreeCAD's exit code tells
nothing."""

import os
import runpy
import sys
import tempfile

import FreeCAD
import Mesh

macro = runpy.run_path(os.environ["MESHREPAIR_MACRO"])
document = FreeCAD.newDocument("test")
broken = document.addObject("Mesh::Feature", "broken")
broken.Mesh = Mesh.Mesh(os.environ["MESHREPAIR_MESH"])
broken.Placement = FreeCAD.Placement(FreeCAD.Vector(5, 0, 0), FreeCAD.Rotation(FreeCAD.Vector(0, 0, 1), 30))
sheet = document.addObject("Mesh::Feature", "sheet")
sheet.Mesh = Mesh.Mesh([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])

made = macro["repair_objects"](document, [broken, sheet])
assert [item.Label for item in made] == ["broken repaired"], made
mesh = made[0].Mesh
assert not broken.Mesh.isSolid() and mesh.isSolid() and not mesh.hasSelfIntersections() and not mesh.hasNonManifolds()
inside = broken.Mesh.BoundBox
inside.enlarge(1e-5)
assert inside.isInside(mesh.BoundBox), (broken.Mesh.BoundBox, mesh.BoundBox)
assert abs(mesh.Volume - 3.60955) < 1e-4, mesh.Volume
walls = macro["repair_objects"](document, [sheet], ["--thicken", "0.1"])
assert len(walls) == 1 and walls[0].Mesh.isSolid()

# A program that makes a mesh, and says that it lacks a guarantee.
with tempfile.TemporaryDirectory() as folder:
    program = os.path.join(folder, "meshrepair")
    with open(program, "w", encoding="utf-8") as file:
        file.write('#!/bin/sh\ncp "$1" "$2"\necho "meshrepair: $2: is not closed" >&2\nexit 1\n')
    os.chmod(program, 0o755)
    os.environ["MESHREPAIR_FOLDER"] = folder
    assert len(macro["repair_objects"](document, [sheet])) == 1
print("fine")
sys.stdout.flush()
