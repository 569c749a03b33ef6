# SPDX-License-Identifier: GPL-3.0-or-later
"""From quads to an object. This runs in Blender's main thread."""

import bpy
import numpy as np


def place(context, subject, made, is_smooth):
    """Gives the quads to a new object beside the one that was read, or to that one, as its settings say."""
    settings = subject.data.roundel
    mesh = _mesh(subject, made, is_smooth)
    if settings.result == "INSTEAD":
        # Weights belong to the mesh, and the names of their groups to the object.
        if settings.use_modifiers:
            subject.modifiers.clear()
        name, subject.data.name = subject.data.name, subject.data.name + " before"
        subject.data = mesh
        mesh.name = name
        _groups(subject, made)
        return subject
    new = bpy.data.objects.new(f"{subject.name} Quads", mesh)
    new.matrix_world = subject.matrix_world
    _groups(new, made)
    for collection in subject.users_collection or [context.scene.collection]:
        collection.objects.link(new)
    subject.hide_set(True)
    for other in list(context.selected_objects):
        other.select_set(False)
    new.select_set(True)
    context.view_layer.objects.active = new
    return new


def _mesh(subject, made, is_smooth):
    mesh = bpy.data.meshes.new(f"{subject.data.name} Quads")
    mesh.from_pydata(made.vertices.tolist(), [], made.faces)
    for material in subject.data.materials:
        mesh.materials.append(material)
    if made.materials is not None and len(mesh.materials):
        mesh.polygons.foreach_set("material_index", made.materials.astype(np.int32))
    mesh.polygons.foreach_set("use_smooth", np.full(len(mesh.polygons), is_smooth))
    for name, values in made.uv_maps.items():
        layer = mesh.uv_layers.new(name=name, do_init=False)
        layer.uv.foreach_set("vector", values.astype(np.float32).ravel())
    for domain, colors in (("POINT", made.vertex_colors), ("CORNER", made.corner_colors)):
        for name, values in colors.items():
            attribute = mesh.color_attributes.new(name=name, type="FLOAT_COLOR", domain=domain)
            attribute.data.foreach_set("color", values.astype(np.float32).ravel())
    _copy_settings(subject.data.roundel, mesh.roundel)
    mesh.update()
    return mesh


def _copy_settings(given, own):
    for name in given.bl_rna.properties.keys():
        if name not in {"rna_type", "name"}:
            setattr(own, name, getattr(given, name))


def _groups(subject, made):
    for name, weights in made.weights.items():
        group = subject.vertex_groups.get(name) or subject.vertex_groups.new(name=name)
        for vertex, weight in enumerate(weights.tolist()):
            if weight > 0:
                group.add([vertex], min(weight, 1.0), "REPLACE")
