# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel in the properties of a mesh."""

import bpy

from .operator import ROUNDEL_OT_quads


class ROUNDEL_PT_quads(bpy.types.Panel):
    bl_label = "Roundel Quads"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "data"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "MESH"

    def draw(self, context):
        subject = context.object
        settings = subject.data.roundel
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(settings, "count")
        layout.prop(settings, "adapt")
        layout.row(heading="Symmetry").prop(settings, "mirror", expand=True)
        layout.column(heading="Features").prop(settings, "features", expand=True)
        if "ANGLE" in settings.features:
            layout.prop(settings, "angle")
        layout.prop(settings, "guides")
        layout.prop(settings, "density")
        if settings.density == "GROUP":
            layout.prop_search(settings, "density_name", subject, "vertex_groups", text="Group")
        elif settings.density == "COLOR":
            layout.prop_search(settings, "density_name", subject.data, "color_attributes", text="Attribute")
        layout.prop(settings, "use_modifiers")
        layout.prop(settings, "keep_attributes")
        layout.prop(settings, "result", expand=True)
        layout.operator(ROUNDEL_OT_quads.bl_idname, icon="MESH_GRID")
