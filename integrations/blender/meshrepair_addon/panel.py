# SPDX-License-Identifier: MIT
"""Where the operators are found: the sidebar of the 3D view, beside those of the 3D-Print Toolbox."""

import bpy

from . import engine


class MESHREPAIR_PT_panel(bpy.types.Panel):
    bl_label = "meshrepair"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "3D-Print"

    def draw(self, _context):
        column = self.layout.column(align=True)
        column.operator("mesh.meshrepair_check", icon="VIEWZOOM")
        repair = column.operator("mesh.meshrepair_repair", icon="MOD_SOLIDIFY")
        repair.purpose = "none"
        column.operator("mesh.meshrepair_repair", text="Repair for Print", icon="MOD_SOLIDIFY").purpose = "print"
        column.separator()
        column.operator_menu_enum("mesh.meshrepair_boolean", "operation", icon="MOD_BOOLEAN")
        if engine.package is None and engine.program_path("meshrepair") is None:
            self.layout.label(text="meshrepair is not installed", icon="ERROR")


CLASSES = (MESHREPAIR_PT_panel,)
