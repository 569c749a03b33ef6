# SPDX-License-Identifier: GPL-3.0-or-later
"""What is read of an object, as arrays that a thread may use. This runs in Blender's main thread."""

from dataclasses import dataclass, field

import bpy
import numpy as np


class Refused(Exception):
    """What cannot be done, in words for people."""


@dataclass
class Surface:
    """A mesh of polygons."""

    vertices: np.ndarray
    #: The corners of all polygons, one after the other, and where each polygon starts; its end is the next start.
    corners: np.ndarray
    starts: np.ndarray
    #: Pairs of vertices: edges that become edges of quads.
    features: np.ndarray
    #: The angle in radians from which on an edge is sharp, or none.
    angle: float | None
    #: Curves in the space of the mesh.
    guides: list = field(default_factory=list)
    #: A factor of the density at every vertex, or none.
    density: np.ndarray | None = None
    #: The material of every polygon.
    materials: np.ndarray | None = None
    #: Numbers of every corner by name: UV maps and color attributes.
    uv_maps: dict = field(default_factory=dict)
    corner_colors: dict = field(default_factory=dict)
    #: Numbers of every vertex by name: color attributes and weights.
    vertex_colors: dict = field(default_factory=dict)
    weights: dict = field(default_factory=dict)
    is_smooth: bool = False

    def polygons(self):
        return np.split(self.corners, self.starts[1:-1])


def of_object(subject, depsgraph):
    """Reads an object with the settings of its mesh."""
    settings = subject.data.roundel
    if not settings.use_modifiers:
        return _read(subject, subject.data, settings, depsgraph)
    evaluated = subject.evaluated_get(depsgraph)
    mesh = bpy.data.meshes.new_from_object(evaluated, preserve_all_data_layers=True, depsgraph=depsgraph)
    try:
        return _read(subject, mesh, settings, depsgraph)
    finally:
        bpy.data.meshes.remove(mesh)


def _read(subject, mesh, settings, depsgraph):
    if not mesh.polygons:
        raise Refused("The mesh has no faces")
    count = len(mesh.vertices)
    starts = np.append(_numbers(mesh.polygons, "loop_start", np.int32), len(mesh.loops))
    surface = Surface(
        vertices=_numbers(mesh.vertices, "co", np.float32, 3).astype(float),
        corners=_numbers(mesh.loops, "vertex_index", np.int32),
        starts=starts,
        features=_features(mesh, settings),
        angle=settings.angle if "ANGLE" in settings.features else None,
        is_smooth=bool(_numbers(mesh.polygons, "use_smooth", bool).any()),
    )
    if settings.guides is not None:
        surface.guides = _curves(subject, settings.guides, depsgraph)
    weights = {group.name: _weights(mesh, group.index, count) for group in subject.vertex_groups}
    colors = {one.name: (one.domain, _numbers(one.data, "color", np.float32, 4)) for one in mesh.color_attributes}
    surface.density = _density(settings, weights, colors, surface)
    if settings.keep_attributes:
        surface.materials = _numbers(mesh.polygons, "material_index", np.int32)
        surface.uv_maps = {layer.name: _numbers(layer.uv, "vector", np.float32, 2) for layer in mesh.uv_layers}
        surface.weights = weights
        surface.vertex_colors = {name: values for name, (domain, values) in colors.items() if domain == "POINT"}
        surface.corner_colors = {name: values for name, (domain, values) in colors.items() if domain == "CORNER"}
    return surface


def _numbers(collection, name, kind, width=1):
    found = np.empty(len(collection) * width, dtype=kind)
    collection.foreach_get(name, found)
    return found.reshape(-1, width) if width > 1 else found


def _features(mesh, settings):
    ends = _numbers(mesh.edges, "vertices", np.int32, 2)
    chosen = np.zeros(len(ends), dtype=bool)
    if "SHARP" in settings.features:
        chosen |= _numbers(mesh.edges, "use_edge_sharp", bool)
    if "SEAM" in settings.features:
        chosen |= _numbers(mesh.edges, "use_seam", bool)
    if "MATERIAL" in settings.features:
        material = np.repeat(
            _numbers(mesh.polygons, "material_index", np.int32), _numbers(mesh.polygons, "loop_total", np.int32)
        )
        edge = _numbers(mesh.loops, "edge_index", np.int32)
        low, high = np.full(len(ends), np.iinfo(np.int32).max, np.int32), np.full(len(ends), -1, np.int32)
        np.minimum.at(low, edge, material)
        np.maximum.at(high, edge, material)
        chosen |= low < high
    return ends[chosen]


def _curves(subject, guides, depsgraph):
    """The curves of an object as lists of points, in the space of the mesh."""
    evaluated = guides.evaluated_get(depsgraph)
    lines = evaluated.to_mesh()
    if lines is None or not lines.edges:
        raise Refused(f"The curve object {guides.name} has no curves")
    try:
        points = _numbers(lines.vertices, "co", np.float32, 3).astype(float)
        ends = _numbers(lines.edges, "vertices", np.int32, 2)
    finally:
        evaluated.to_mesh_clear()
    to_mesh = np.array(subject.matrix_world.inverted() @ guides.matrix_world)
    points = points @ to_mesh[:3, :3].T + to_mesh[:3, 3]
    return [points[chain] for chain in chains(ends.tolist())]


def chains(edges):
    """Edges as chains of vertices; a closed one ends where it begins."""
    at = {}
    for number, (a, b) in enumerate(edges):
        at.setdefault(a, []).append((number, b))
        at.setdefault(b, []).append((number, a))
    used, found = set(), []
    # Open chains first, from their ends.
    for start in sorted(at, key=lambda v: len(at[v]) == 2):
        for first in at[start]:
            chain, step = [start], first
            while step is not None:
                number, vertex = step
                if number in used:
                    break
                used.add(number)
                chain.append(vertex)
                is_inner = len(at[vertex]) == 2
                step = next((one for one in at[vertex] if one[0] not in used), None) if is_inner else None
            if len(chain) > 1:
                found.append(chain)
    return found


def _weights(mesh, group, count):
    weights = np.zeros(count)
    for vertex in mesh.vertices:
        for one in vertex.groups:
            if one.group == group:
                weights[vertex.index] = one.weight
    return weights


def _density(settings, weights, colors, surface):
    name = settings.density_name
    if settings.density == "GROUP":
        if name not in weights:
            raise Refused(f"There is no vertex group {name!r}")
        return 2.0 ** (2.0 * weights[name] - 1.0)
    if settings.density == "COLOR":
        if name not in colors:
            raise Refused(f"There is no color attribute {name!r}")
        domain, values = colors[name]
        if domain == "CORNER":
            total = np.zeros((len(surface.vertices), 4))
            np.add.at(total, surface.corners, values)
            values = total / np.maximum(1, np.bincount(surface.corners, minlength=len(total)))[:, None]
        return 2.0 ** (values[:, 0] - 0.5 * (values[:, 1] + values[:, 2])).clip(-1, 1)
    return None
