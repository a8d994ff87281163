# SPDX-License-Identifier: MIT
"""Tests of the add-on, inside Blender.

Usage: blender --background --factory-startup --python-exit-code 1 --python addon_test.py -- PROGRAMS

PROGRAMS is the folder of the built programs. With --python-use-system-env, and the Python package in PYTHONPATH, the add-on
works through that.
"""

import math
import os
import pathlib
import sys
import unittest

import bpy
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
os.environ["PATH"] = os.pathsep.join([sys.argv[sys.argv.index("--") + 1], os.environ["PATH"]])
sys.path.insert(0, str(ROOT / "integrations" / "blender"))

import meshrepair_addon
from meshrepair_addon import engine, layers


def add_object(name, mesh):
    item = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(item)
    for other in bpy.context.selected_objects:
        other.select_set(False)
    bpy.context.view_layer.objects.active = item
    item.select_set(True)
    return item


def textured_ball(name, centre=(0, 0, 0), colour=(1, 0, 0, 1), radius=1.0):
    """With a UV map and a colour that are linear in the place, a material, a vertex group of heights, and a hole."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=24, ring_count=16, radius=radius)
    mesh = bpy.context.active_object.data.copy()
    bpy.data.objects.remove(bpy.context.active_object)
    faces = [tuple(polygon.vertices) for polygon in mesh.polygons][:-5]
    vertices = [tuple(np.array(vertex.co) + centre) for vertex in mesh.vertices]
    made = bpy.data.meshes.new(name)
    made.from_pydata(vertices, [], faces)
    material = bpy.data.materials.new(name)
    material.diffuse_color = colour
    made.materials.append(material)
    item = add_object(name, made)
    places = np.array(vertices)
    layer = made.uv_layers.new(name="map", do_init=False)
    corners = np.array([loop.vertex_index for loop in made.loops])
    layer.data.foreach_set("uv", places[corners][:, :2].astype(np.float32).ravel())
    colours = made.color_attributes.new("paint", "FLOAT_COLOR", "CORNER")
    colours.data.foreach_set("color", np.hstack([places, np.ones((len(places), 1))])[corners].astype(np.float32).ravel())
    group = item.vertex_groups.new(name="height")
    for index, place in enumerate(places):
        group.add([index], 0.5 + place[2] / 8, "REPLACE")
    return item


def corner_places(mesh):
    vertices = np.array([tuple(vertex.co) for vertex in mesh.vertices])
    return vertices[[loop.vertex_index for loop in mesh.loops]]


class AddOn(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        meshrepair_addon.register()

    def tearDown(self):
        meshrepair_addon.unregister()

    def check_layers(self, item, least):
        """UV map, colour and weights are still those of the place, but for what closes a gap."""
        mesh = item.data
        places = corner_places(mesh)
        uv = np.array([tuple(entry.uv) for entry in mesh.uv_layers["map"].data])
        self.assertGreater((np.abs(uv - places[:, :2]).max(axis=1) < 1e-5).mean(), least)
        paint = np.array([tuple(entry.color) for entry in mesh.color_attributes["paint"].data])
        self.assertGreater((np.abs(paint[:, :3] - places).max(axis=1) < 1e-5).mean(), least)
        group = item.vertex_groups["height"]
        near = [abs(entry.weight - 0.5 - vertex.co.z / 8) < 1e-5
                for vertex in mesh.vertices for entry in vertex.groups if entry.group == group.index]
        self.assertEqual(len(near), len(mesh.vertices))
        self.assertGreater(np.mean(near), least)

    def assert_solid(self, item):
        given = layers.Triangles(item, item.matrix_world.Identity(4))
        is_valid, defects, _ = engine.check(given.vertices, given.triangles)
        self.assertTrue(is_valid, defects)

    def test_a_broken_ball_is_repaired_and_keeps_what_it_carries(self):
        item = textured_ball("ball")
        first, second = textured_ball("one"), textured_ball("two", (0.7, 0.2, 0.1), (0, 1, 0, 1))
        first.select_set(True)
        bpy.context.view_layer.objects.active = first
        bpy.ops.object.join()
        for one in (item, first):
            bpy.context.view_layer.objects.active = one
            materials = [slot.material for slot in one.material_slots]
            self.assertEqual(bpy.ops.mesh.meshrepair_repair(), {"FINISHED"})
            self.assert_solid(one)
            self.check_layers(one, 0.9)
            self.assertEqual([slot.material for slot in one.material_slots], materials)
        used = {polygon.material_index for polygon in first.data.polygons}
        self.assertEqual(used, {0, 1})
        for polygon in first.data.polygons:
            centre = np.array(polygon.center)
            ball = np.array([(0, 0, 0), (0.7, 0.2, 0.1)][polygon.material_index])
            self.assertLess(np.linalg.norm(centre - ball), 1.001)

    def test_check_selects_the_faces_at_the_hole(self):
        item = textured_ball("ball")
        count = len(item.data.polygons)
        self.assertEqual(bpy.ops.mesh.meshrepair_check(), {"FINISHED"})
        self.assertEqual(item.mode, "EDIT")
        bpy.ops.object.mode_set(mode="OBJECT")
        selected = [polygon.index for polygon in item.data.polygons if polygon.select]
        self.assertGreater(len(selected), 4)
        self.assertLess(len(selected), count / 4)
        bpy.ops.mesh.meshrepair_repair()
        bpy.ops.mesh.meshrepair_check()
        self.assertEqual(item.mode, "OBJECT")
        self.assertFalse(any(polygon.select for polygon in item.data.polygons))

    def test_objects_are_combined_where_they_stand(self):
        volumes = {}
        for operation in ("union", "intersection", "difference"):
            first, second = textured_ball("one"), textured_ball("two", colour=(0, 1, 0, 1), radius=0.5)
            first.location = (5, 0, 0)
            first.rotation_euler = (0, 0, 1)
            second.location = (5.9, 0, 0)
            second.scale = (-1, 1, 1)  # mirrored
            bpy.context.view_layer.update()
            first.select_set(True)
            second.select_set(True)
            bpy.context.view_layer.objects.active = first
            self.assertEqual(bpy.ops.mesh.meshrepair_boolean(operation=operation), {"FINISHED"})
            self.assert_solid(first)
            self.assertTrue(second.hide_get())
            self.assertEqual([slot.material.name for slot in first.material_slots], [first.data.materials[0].name, second.data.materials[0].name])
            self.assertEqual({polygon.material_index for polygon in first.data.polygons}, {0, 1})
            given = layers.Triangles(first, first.matrix_world.Identity(4))
            a, b, c = (given.vertices[given.triangles[:, k]] for k in range(3))
            volumes[operation] = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
        ball = volumes["difference"] + volumes["intersection"]
        self.assertLess(abs(ball - 4 / 3 * math.pi), 0.15)
        self.assertGreater(volumes["union"], ball)

    def combine_balls(self, first, second):
        second.location = (0.5, 0, 0)
        bpy.context.view_layer.update()
        first.select_set(True)
        second.select_set(True)
        bpy.context.view_layer.objects.active = first
        return bpy.ops.mesh.meshrepair_boolean(operation="union")

    def test_an_object_with_the_same_mesh_keeps_it(self):
        second = textured_ball("ball")
        count = len(second.data.polygons)
        first = add_object("again", second.data)
        self.assertEqual(self.combine_balls(first, second), {"FINISHED"})
        self.assertNotEqual(len(first.data.polygons), count)
        self.assertEqual(len(second.data.polygons), count)

    def test_what_has_no_material_gets_none_of_another_object(self):
        first, second = textured_ball("one"), textured_ball("two")
        first.data.materials.clear()
        self.assertEqual(self.combine_balls(first, second), {"FINISHED"})
        self.assertEqual([slot.material for slot in first.material_slots], [None, second.data.materials[0]])
        self.assertEqual({polygon.material_index for polygon in first.data.polygons if polygon.center.x < -0.6}, {0})

    def test_an_object_without_extent_is_refused(self):
        first, second = textured_ball("flat"), textured_ball("ball")
        first.scale = (1, 1, 0)
        with self.assertRaisesRegex(RuntimeError, "^Error: flat has a scale of 0"):
            self.combine_balls(first, second)

    def test_a_failure_is_told_and_changes_nothing(self):
        mesh = bpy.data.meshes.new("sheet")
        mesh.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [], [(0, 1, 2)])
        item = add_object("sheet", mesh)
        with self.assertRaises(RuntimeError) as caught:
            bpy.ops.mesh.meshrepair_repair()
        self.assertRegex(str(caught.exception), r"^Error: (the mesh: )?all triangles lie in one plane.*--thicken")
        self.assertEqual(len(item.data.polygons), 1)
        self.assertEqual(bpy.ops.mesh.meshrepair_repair(thicken="0.1"), {"FINISHED"})
        self.assert_solid(item)

    def test_both_ways_of_working_agree(self):
        if engine.package is None:
            self.skipTest("Blender's Python has no package meshrepair")
        given = layers.Triangles(textured_ball("ball"), bpy.context.active_object.matrix_world)
        by_package = engine.repair(given.vertices, given.triangles, {"precision": "float32"})
        package, engine.package = engine.package, None
        try:
            by_program = engine.repair(given.vertices, given.triangles, {"precision": "float32"})
        finally:
            engine.package = package
        self.assertTrue((by_package.vertices == by_program.vertices).all())
        self.assertTrue((by_package.triangles == by_program.triangles).all())
        self.assertTrue((by_package.source == by_program.source).all())


if __name__ == "__main__":
    result = unittest.TextTestRunner(verbosity=2).run(unittest.defaultTestLoader.loadTestsFromTestCase(AddOn))
    sys.exit(0 if result.wasSuccessful() else 1)
