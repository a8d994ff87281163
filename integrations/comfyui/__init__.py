# SPDX-License-Identifier: MIT
"""Nodes for ComfyUI that make a generated mesh the boundary of a solid, with the Python package meshrepair.

Copy this folder into ComfyUI/custom_nodes, and install meshrepair into ComfyUI's Python. The nodes are in the category 3d:

- Repair Mesh: of a MESH the shape, between a node that makes one and one that saves it;
- Repair Mesh File: of a file its shape, texture and materials.
"""

import copy
import pathlib
import re

import meshrepair

PURPOSES = ("none", "print", "simulation", "render", "boolean")
OPTIONS = {
    "purpose": (PURPOSES, {"tooltip": "What the mesh is for: print closes and thickens it; render keeps sheets as thin solids"}),
    "triangles": ("INT", {"default": 0, "min": 0, "max": 2**31 - 1, "tooltip": "Reduce the result to this many triangles; 0 keeps all"}),
    "max_error": ("FLOAT", {"default": 0.0, "min": 0.0, "max": 10.0, "step": 0.01,
                            "tooltip": "Reduce the result while it stays this near to the repaired mesh, in % of its diagonal; 0: off"}),
}


def options_of(purpose, triangles, max_error):
    """The options of meshrepair."""
    options = {} if purpose == "none" else {"for_": purpose}
    if triangles:
        options["triangles"] = max(triangles, 4)
    if max_error:
        options["max_error"] = f"{max_error}%"
    return options


def told(report):
    """What was done, in a few lines."""
    result = report["result"]
    volume = "unknown" if result["volume"] is None else f"{result['volume']:.6g}"
    lines = [f"{result['triangles']:,} triangles, {result['parts']:,} parts, volume {volume}"]
    return "\n".join(lines + [f"{warning['text']} [{warning['code']}]" for warning in report["warnings"]])


class RepairMesh:
    """The shape of one MESH: its vertices and faces."""

    INPUT_TYPES = classmethod(lambda cls: {"required": {"mesh": ("MESH",), **OPTIONS}})
    RETURN_TYPES = ("MESH", "STRING")
    RETURN_NAMES = ("mesh", "report")
    FUNCTION = "repair"
    CATEGORY = "3d"

    def repair(self, mesh, purpose="none", triangles=0, max_error=0.0):
        if len(mesh.vertices) != 1:
            raise ValueError(f"Repair Mesh takes one mesh, not a batch of {len(mesh.vertices)}")
        # Half precision would round what was certified.
        vertices = mesh.vertices.float()
        result = meshrepair.repair(vertices[0].cpu().numpy(), mesh.faces[0].cpu().numpy(), precision="float32",
                                   **options_of(purpose, triangles, max_error))
        # What belongs to the old vertices goes: colours, texture coordinates, normals.
        repaired = copy.copy(mesh)
        for name in vars(repaired):
            setattr(repaired, name, None)
        repaired.vertices = vertices.new_tensor(result.vertices)[None]
        repaired.faces = mesh.faces.new_tensor(result.faces)[None]
        return repaired, told(result.report)


class RepairMeshFile:
    """A file, into one beside it."""

    INPUT_TYPES = classmethod(lambda cls: {"required": {"path": ("STRING", {"default": ""}), **OPTIONS}})
    RETURN_TYPES = ("STRING", "STRING")
    RETURN_NAMES = ("path", "report")
    FUNCTION = "repair"
    CATEGORY = "3d"

    def repair(self, path, purpose="none", triangles=0, max_error=0.0):
        given = pathlib.Path(path)
        made = given.with_name(re.sub(r"(\.\w+(\.(gz|zst))?)?$", r"_repaired\1", given.name, count=1))
        report = meshrepair.repair_file(given, made, **options_of(purpose, triangles, max_error))
        return str(made), told(report)


NODE_CLASS_MAPPINGS = {"MeshrepairMesh": RepairMesh, "MeshrepairFile": RepairMeshFile}
NODE_DISPLAY_NAME_MAPPINGS = {"MeshrepairMesh": "Repair Mesh", "MeshrepairFile": "Repair Mesh File"}
