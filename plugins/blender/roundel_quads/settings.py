# SPDX-License-Identifier: GPL-3.0-or-later
"""What a mesh is asked to become. The settings belong to the mesh, and are saved with it."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty


def _is_curve(_settings, candidate):
    return candidate.type == "CURVE"


class RoundelSettings(bpy.types.PropertyGroup):
    count: IntProperty(name="Quads", description="About how many quads", default=2000, min=6, soft_max=100000)
    adapt: FloatProperty(
        name="Adapt",
        description="How far quads get smaller where the surface curves",
        default=0.0,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )
    mirror: EnumProperty(
        name="Symmetry",
        description="Planes through the middle of the mesh about which the quads are symmetric; one side is kept",
        items=[
            ("x", "X", "Left and right alike"),
            ("y", "Y", "Front and back alike"),
            ("z", "Z", "Top and bottom alike"),
        ],
        options={"ENUM_FLAG"},
        default=set(),
    )
    features: EnumProperty(
        name="Features",
        description="Edges that become edges of quads",
        items=[
            ("SHARP", "Sharp", "Edges that are marked sharp"),
            ("SEAM", "Seams", "Edges that are marked as seams"),
            ("MATERIAL", "Materials", "Edges between faces of different materials"),
            ("ANGLE", "Angle", "Edges at which the surface turns by an angle or more"),
        ],
        options={"ENUM_FLAG"},
        default={"SHARP"},
    )
    angle: FloatProperty(
        name="Angle",
        description="The angle between faces from which on an edge is sharp",
        default=0.698132,
        min=0.0174533,
        max=3.14159,
        subtype="ANGLE",
    )
    guides: PointerProperty(
        name="Guide Curves",
        description="A curve object near the surface: edges of quads run along it",
        type=bpy.types.Object,
        poll=_is_curve,
    )
    density: EnumProperty(
        name="Density",
        description="What says where quads are denser",
        items=[
            ("NONE", "Even", "Quads of one size, or as Adapt says"),
            ("GROUP", "Vertex Group", "Weight 1: edges of half the length; 0: of twice the length"),
            ("COLOR", "Color Attribute", "Red: edges of half the length; white: as elsewhere; cyan: of twice the length"),
        ],
        default="NONE",
    )
    density_name: StringProperty(name="Name", description="The vertex group or color attribute")
    use_modifiers: BoolProperty(
        name="Apply Modifiers", description="Start from the mesh with its modifiers", default=True
    )
    keep_attributes: BoolProperty(
        name="Keep Attributes",
        description="Carry materials, UV maps, color attributes and vertex groups over to the quads",
        default=True,
    )
    result: EnumProperty(
        name="Result",
        items=[
            ("BESIDE", "New Object", "The mesh stays, hidden; the quads are an object of their own"),
            ("INSTEAD", "Replace", "The quads take the place of the mesh"),
        ],
        default="BESIDE",
    )
