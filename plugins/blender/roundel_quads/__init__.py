# SPDX-License-Identifier: GPL-3.0-or-later
"""Roundel in Blender: a panel in the properties of a mesh, and an operator that makes quads of it."""

import bpy

from .operator import ROUNDEL_OT_quads
from .panel import ROUNDEL_PT_quads
from .settings import RoundelSettings

CLASSES = (RoundelSettings, ROUNDEL_OT_quads, ROUNDEL_PT_quads)


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.Mesh.roundel = bpy.props.PointerProperty(type=RoundelSettings)


def unregister():
    del bpy.types.Mesh.roundel
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
