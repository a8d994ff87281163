# SPDX-License-Identifier: MIT
"""Repairs, checks and combines meshes with meshrepair, from the sidebar of the 3D view."""

import bpy

from . import operators, panel

bl_info = {
    "name": "meshrepair",
    "author": "The meshrepair authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > 3D-Print",
    "description": "Turns any broken mesh into the boundary of a solid",
    "category": "Mesh",
}


class Preferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    folder: bpy.props.StringProperty(
        name="Folder of the programs",
        description="Where meshrepair, meshcheck and bspbool are, if they are not in PATH. Not needed where Blender's Python has "
                    "the package meshrepair",
        subtype="DIR_PATH",
    )

    def draw(self, _context):
        self.layout.prop(self, "folder")


CLASSES = (Preferences, *operators.CLASSES, *panel.CLASSES)


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)


def unregister():
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
