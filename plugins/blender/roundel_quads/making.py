# SPDX-License-Identifier: GPL-3.0-or-later
"""From a surface to quads. Nothing here belongs to Blender: this runs in a thread of its own."""

from dataclasses import dataclass, field

import numpy as np
import roundel


@dataclass
class Request:
    """What is asked for besides the surface."""

    count: int
    adapt: float
    mirror: list


@dataclass
class Made:
    """Quads, and what they have got of the surface."""

    vertices: np.ndarray
    faces: list
    #: One line about the quads, and about what was repaired.
    words: str
    conforming: bool
    materials: np.ndarray | None = None
    uv_maps: dict = field(default_factory=dict)
    corner_colors: dict = field(default_factory=dict)
    vertex_colors: dict = field(default_factory=dict)
    weights: dict = field(default_factory=dict)


def make(surface, request, hear=None):
    """Makes the quads. `hear` is told the stage and the share that is done, and may raise `KeyboardInterrupt`: then the
    best quads so far are finished, if there are some; else it goes on to the caller.
    """
    repaired = roundel.repair(surface.vertices, surface.polygons())
    mesh = repaired.mesh
    options = {"quads": request.count, "adapt": request.adapt, "mirror": request.mirror}
    features = _features(surface, repaired)
    if len(features):
        options["features"] = features
    if surface.guides:
        options["guides"] = roundel.curve_guides(mesh, surface.guides)
    if surface.density is not None:
        origins = repaired.vertex_origins
        options["density"] = np.where(origins >= 0, surface.density[origins], 1.0)

    def tell(event):
        if hear is not None:
            hear(event.stage, event.share)

    is_best_so_far = False
    try:
        quads = roundel.quad(mesh, progress=tell, **options)
    except roundel.Interrupted as stop:
        quads, is_best_so_far = stop.incumbent, True
        if quads is None:
            raise
    return _with_attributes(surface, repaired, quads, is_best_so_far)


def _features(surface, repaired):
    """The edges of the repaired mesh that become edges of quads, by their vertices."""
    mesh = repaired.mesh
    ends = np.empty((len(mesh.edge_faces), 2), dtype=np.int64)
    ends[mesh.face_edges] = np.stack([mesh.faces, np.roll(mesh.faces, -1, axis=1)], axis=2)
    chosen = np.zeros(len(ends), dtype=bool)
    if len(surface.features):
        welded = repaired.welded_to
        count = len(surface.vertices)
        mine = _keys(repaired.vertex_origins[ends], count)
        chosen |= (mine >= 0) & np.isin(mine, _keys(welded[surface.features], count))
    if surface.angle is not None:
        corners = mesh.vertices[mesh.faces]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
        sides = mesh.edge_faces
        cosine = (normals[sides[:, 0]] * normals[sides[:, 1]]).sum(axis=1)
        chosen |= (sides >= 0).all(axis=1) & (cosine <= np.cos(surface.angle))
    return ends[chosen]


def _keys(pairs, count):
    """A number for each pair of vertices, whatever their order; none of pairs with a vertex that is not there."""
    low, high = pairs.min(axis=1).astype(np.int64), pairs.max(axis=1).astype(np.int64)
    return np.where(low >= 0, low * count + high, -1)


def _with_attributes(surface, repaired, quads, is_best_so_far):
    mesh = repaired.mesh
    faces = [face.tolist() for face in quads.faces] + [face.tolist() for face in quads.others]
    words = f"{len(quads):,} quads, {quads.irregular_count:,} irregular vertices"
    if len(quads.others):
        words += f", {len(quads.others):,} other faces"
    if is_best_so_far:
        words += ", the best so far"
    if repaired.summary:
        words += f"; {repaired.summary}"
    made = Made(quads.vertices, faces, words, quads.conforming)
    origins, polygons = repaired.vertex_origins, repaired.face_origins

    def of_vertices(values):
        found = np.asarray(values, dtype=float)[origins]
        found[origins < 0] = np.nan
        return np.nan_to_num(quads.transfer_vertex_values(mesh, found))

    made.weights = {name: of_vertices(values) for name, values in surface.weights.items()}
    made.vertex_colors = {name: of_vertices(values) for name, values in surface.vertex_colors.items()}
    if surface.materials is not None:
        labels = np.where(polygons >= 0, surface.materials[polygons], -1)
        made.materials = np.maximum(quads.transfer_face_labels(mesh, labels), 0)
    if surface.uv_maps or surface.corner_colors:
        corners = _corner_origins(surface, repaired)

        def of_corners(values):
            found = np.asarray(values, dtype=float)[corners]
            found[corners < 0] = np.nan
            carried = quads.transfer_corner_values(mesh, found)
            return np.nan_to_num(carried.reshape(-1, found.shape[-1]))

        made.uv_maps = {name: of_corners(values) for name, values in surface.uv_maps.items()}
        made.corner_colors = {name: of_corners(values) for name, values in surface.corner_colors.items()}
    return made


def _corner_origins(surface, repaired):
    """The corner of a polygon that each corner of the repaired mesh comes from; -1 for none."""
    count = len(surface.vertices)
    welded = repaired.welded_to
    sizes = np.diff(surface.starts)
    polygon_of = np.repeat(np.arange(len(sizes)), sizes)
    keys = polygon_of.astype(np.int64) * count + welded[surface.corners]
    order = np.argsort(keys, kind="stable")
    vertices = repaired.vertex_origins[repaired.mesh.faces].astype(np.int64)
    polygons = repaired.face_origins[:, None].astype(np.int64)
    wanted = np.where((vertices >= 0) & (polygons >= 0), polygons * count + vertices, -1)
    place = np.searchsorted(keys[order], wanted).clip(0, len(order) - 1)
    found = order[place]
    return np.where(keys[found] == wanted, found, -1)
