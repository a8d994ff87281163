# SPDX-License-Identifier: MIT
"""What the add-on does."""

import bpy
from mathutils import Matrix

from . import engine, layers

PURPOSES = (("none", "Any", "Nothing but what the options say"),
            ("print", "Print", "No closed voids, no double walls, sheets with walls"),
            ("simulation", "Simulation", "Voids stay, crumbs go"),
            ("render", "Render", "What nobody sees goes"),
            ("boolean", "Boolean", "As it is, to be combined with others"))
OPERATIONS = (("union", "Union", "What is in any of the objects"),
              ("intersection", "Intersection", "What is in all objects"),
              ("difference", "Difference", "What is in the active object and in no other"))


class MeshOperator:
    """Of an active mesh, in any mode. Failures are told, and the mesh stays as it was."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.active_object is not None and context.active_object.type == "MESH"

    def execute(self, context):
        item, mode = context.active_object, context.active_object.mode
        bpy.ops.object.mode_set(mode="OBJECT")
        try:
            return self.work(context, item)
        except engine.Failed as failure:
            self.report({"ERROR"}, str(failure))
            return {"CANCELLED"}
        finally:
            if item.mode != mode and not self.has_chosen_mode:
                bpy.ops.object.mode_set(mode=mode)

    has_chosen_mode = False


class MESHREPAIR_OT_repair(MeshOperator, bpy.types.Operator):
    """Make the mesh the boundary of a solid: closed, without intersections. Materials, UV maps, colours and vertex groups stay"""

    bl_idname = "mesh.meshrepair_repair"
    bl_label = "Repair"

    purpose: bpy.props.EnumProperty(name="For", items=PURPOSES, default="none")
    seal: bpy.props.StringProperty(name="Seal", description="Close openings below this size: a number, a share as 1%, auto, or double-walls")
    thicken: bpy.props.StringProperty(name="Thicken", description="Walls for open sheets: a number, a share as 1%, or auto")
    keep: bpy.props.EnumProperty(name="Keep", items=(("all", "All", "All solids"), ("largest", "Largest", "The largest solid"),
                                                     ("outer", "Outer", "Solids that are in no void of others")), default="all")

    def work(self, _context, item):
        options = {"precision": "float32"}
        if self.purpose != "none":
            options["for"] = self.purpose
        if self.keep != "all":
            options["keep"] = self.keep
        options.update({name: value for name, value in (("seal", self.seal), ("thicken", self.thicken)) if value})
        given = layers.Triangles(item, Matrix())
        answer = engine.repair(given.vertices, given.triangles, options)
        layers.put(item, given, answer)
        return _told(self, answer)


class MESHREPAIR_OT_check(MeshOperator, bpy.types.Operator):
    """Select the faces that keep the mesh from being the boundary of a solid"""

    bl_idname = "mesh.meshrepair_check"
    bl_label = "Check"

    def work(self, context, item):
        given = layers.Triangles(item, Matrix())
        is_valid, defects, marked = engine.check(given.vertices, given.triangles)
        at_fault = set(given.polygon[marked].tolist())
        for polygon in item.data.polygons:
            polygon.select = polygon.index in at_fault
        for edge in item.data.edges:
            edge.select = False
        for vertex in item.data.vertices:
            vertex.select = False
        if is_valid:
            self.report({"INFO"}, "A valid solid")
            return {"FINISHED"}
        context.tool_settings.mesh_select_mode = (False, False, True)
        bpy.ops.object.mode_set(mode="EDIT")
        self.has_chosen_mode = True
        counts = ", ".join(f"{name.replace('_', ' ')}: {count}" for name, count in defects.items() if count)
        self.report({"WARNING"}, f"No valid solid: {counts}")
        return {"FINISHED"}


class MESHREPAIR_OT_boolean(MeshOperator, bpy.types.Operator):
    """Combine the active object with the other selected ones, which are repaired first if need be, and are hidden then"""

    bl_idname = "mesh.meshrepair_boolean"
    bl_label = "Combine"

    operation: bpy.props.EnumProperty(name="Operation", items=OPERATIONS, default="union")

    @classmethod
    def poll(cls, context):
        return super().poll(context) and sum(item.type == "MESH" for item in context.selected_objects) > 1

    def work(self, context, item):
        others = [other for other in context.selected_objects if other.type == "MESH" and other != item]
        if item.matrix_world.determinant() == 0:
            raise engine.Failed(f"{item.name} has a scale of 0")
        to_active = item.matrix_world.inverted()
        given = layers.Triangles(item, Matrix())
        meshes = [(given.vertices, given.triangles)]
        for other in others:
            more = layers.Triangles(other, to_active @ other.matrix_world)
            meshes.append((more.vertices, more.triangles))
            given.join(more)
        answer = engine.combine(meshes, self.operation)
        layers.put(item, given, answer, alone=True)
        for other in others:
            other.hide_set(True)
        return _told(self, answer)


def _told(operator, answer):
    text = f"{len(answer.triangles):,} triangles"
    if answer.certified:
        operator.report({"INFO"}, f"{text}, a certified solid")
    else:
        operator.report({"WARNING"}, f"{text}, but {answer.report['error']}")
    return {"FINISHED"}


CLASSES = (MESHREPAIR_OT_repair, MESHREPAIR_OT_check, MESHREPAIR_OT_boolean)
