#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of the nodes of integrations/comfyui, called as ComfyUI calls them. Its tensors are stood in for.

Usage: comfyui_test.py PACKAGES [CLASS]

PACKAGES is the folder that holds the package meshrepair, as build/release/python.

Example: tests/python/comfyui_test.py build/release/python
"""

import importlib.util
import pathlib
import shutil
import sys
import tempfile
import types
import unittest

sys.dont_write_bytecode = True

import numpy as np

import package_under_test as package  # finds the package
import meshrepair
from package_under_test import MESHES

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Tensor:
    """As much of one of torch as meshes need."""

    def __init__(self, array):
        self.array = np.asarray(array)

    def __len__(self):
        return len(self.array)

    def __getitem__(self, at):
        return Tensor(self.array[at])

    def cpu(self):
        return self

    def numpy(self):
        return self.array

    def float(self):
        return Tensor(self.array.astype(np.float32))

    def new_tensor(self, array):
        return Tensor(np.asarray(array, self.array.dtype))


def nodes() -> types.ModuleType:
    spec = importlib.util.spec_from_file_location("comfyui_nodes", ROOT / "integrations" / "comfyui" / "__init__.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def called(name: str, **inputs):
    """As ComfyUI calls a node: what the function does not get has its default."""
    node = nodes().NODE_CLASS_MAPPINGS[name]
    declared = node.INPUT_TYPES()["required"]
    for key, (kind, *more) in declared.items():
        if key not in inputs:
            inputs[key] = kind[0] if isinstance(kind, tuple) else more[0]["default"]
    if set(inputs) != set(declared):
        raise TypeError(f"{set(inputs)}, not {set(declared)}")
    result = getattr(node(), node.FUNCTION)(**inputs)
    if len(result) != len(node.RETURN_TYPES):
        raise TypeError("not what is declared")
    return result


class Nodes(unittest.TestCase):
    def broken(self) -> types.SimpleNamespace:
        mesh = meshrepair.read(MESHES / "broken_torus_box.stl")
        return types.SimpleNamespace(vertices=Tensor(mesh.vertices[None].astype(np.float32)), faces=Tensor(mesh.faces[None].astype(np.int64)),
                                     uvs=Tensor(np.zeros((1, len(mesh.vertices), 2))))

    def test_a_mesh_becomes_a_solid(self):
        given = self.broken()
        repaired, report = called("MeshrepairMesh", mesh=given)
        self.assertEqual((repaired.vertices.array.dtype, repaired.faces.array.dtype, repaired.uvs), (np.float32, np.int64, None))
        self.assertTrue(meshrepair.check(repaired.vertices.array[0], repaired.faces.array[0]))
        self.assertRegex(report, r"^2,\d\d\d triangles, \d parts, volume 3\.\d+")
        self.assertIsNotNone(given.uvs)

    def test_half_precision_does_not_round_the_solid(self):
        given = self.broken()
        given.vertices = Tensor((given.vertices.array + 37.3).astype(np.float16))
        repaired, _ = called("MeshrepairMesh", mesh=given)
        self.assertEqual(repaired.vertices.array.dtype, np.float32)
        self.assertTrue(meshrepair.check(repaired.vertices.array[0], repaired.faces.array[0]))

    def test_it_has_as_many_triangles_as_asked(self):
        repaired, _ = called("MeshrepairMesh", mesh=self.broken(), purpose="print", triangles=500)
        self.assertIn(len(repaired.faces.array[0]), range(480, 501))
        repaired, _ = called("MeshrepairMesh", mesh=self.broken(), max_error=1.0)
        self.assertLess(len(repaired.faces.array[0]), 1500)

    def test_all_purposes_are_those_of_the_programs(self):
        for purpose in nodes().PURPOSES:
            called("MeshrepairMesh", mesh=self.broken(), purpose=purpose)

    def test_a_batch_is_refused(self):
        given = self.broken()
        given.vertices = Tensor(np.repeat(given.vertices.array, 2, axis=0))
        with self.assertRaisesRegex(ValueError, "one mesh, not a batch of 2"):
            called("MeshrepairMesh", mesh=given)

    def test_a_file_becomes_one_beside_it(self):
        with tempfile.TemporaryDirectory() as name:
            given = shutil.copy(MESHES / "broken_torus_box.stl", name)
            made, report = called("MeshrepairFile", path=given)
            self.assertEqual(pathlib.Path(made).name, "broken_torus_box_repaired.stl")
            self.assertTrue(meshrepair.check(meshrepair.read(made)))
            self.assertIn("triangles", report)
            with self.assertRaises(meshrepair.Error):
                called("MeshrepairFile", path=str(pathlib.Path(name) / "none.glb"))


if __name__ == "__main__":
    package.main()
