"""Meshes of other packages: taken apart, and made."""

from __future__ import annotations

import importlib
import os
from typing import Any, Mapping, Optional, Sequence

import numpy as np

from .errors import ArgumentTypeError, MissingPackageError, refusal


def package(name: str, purpose: str) -> Any:
    """A package that is not needed elsewhere."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        told = f"{purpose} needs the package {name}: pip install {name.split('.')[0]}"
        raise refusal(MissingPackageError, told) from error


def is_path(thing: Any) -> bool:
    """Whether this is the path of a file."""
    return isinstance(thing, (str, os.PathLike))


def arrays_of(V: Any, F: Any) -> tuple[Any, Any]:
    """Vertices and faces of the arguments, or of a mesh of any package."""
    if F is not None:
        return V, F
    # A MeshSet of pymeshlab stands for its current mesh, a scene of trimesh for all its meshes.
    mesh = V.current_mesh() if hasattr(V, "current_mesh") else V
    mesh = mesh.to_mesh() if hasattr(mesh, "to_mesh") else mesh
    if hasattr(mesh, "regular_faces"):
        return mesh.points, _faces_of_pyvista(mesh)
    if hasattr(mesh, "cells") and hasattr(mesh, "points"):
        return mesh.points, _faces_of_meshio(mesh)
    for vertices, faces in (
        ("vertex_matrix", "face_matrix"),
        ("points", "face_vertex_indices"),
        ("vertices", "faces"),
    ):
        if hasattr(mesh, vertices) and hasattr(mesh, faces):
            found = getattr(mesh, vertices), getattr(mesh, faces)
            points, corners = (part() if callable(part) else part for part in found)
            return points, corners
    raise refusal(ArgumentTypeError, _not_a_mesh(V))


def _not_a_mesh(V: Any) -> str:
    name = type(V).__name__
    if isinstance(V, (np.ndarray, list, tuple)):
        return f"{name}: an array of vertices needs an array of faces beside it"
    return f"{name} has neither vertices and faces, nor is it a path or a mesh of a known package"


def _faces_of_pyvista(mesh: Any) -> Any:
    if mesh.is_all_triangles:
        return np.asarray(mesh.regular_faces)
    return [np.asarray(face) for face in mesh.irregular_faces]


def _faces_of_meshio(mesh: Any) -> Any:
    blocks = [block.data for block in mesh.cells if block.dim == 2]
    if len({block.shape[1] for block in blocks}) == 1:
        return np.concatenate(blocks)
    return [face for block in blocks for face in block]


def seams(vertices: np.ndarray, faces: np.ndarray) -> int:
    """The number of boundary edges that lie on another one that runs the other way."""
    edges = faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    alone = edges[~_in(edges, edges[:, ::-1])]
    _, place = np.unique(vertices, axis=0, return_inverse=True)
    placed = place.reshape(-1)[alone]
    return int(np.count_nonzero(_in(placed, placed[:, ::-1])) // 2)


def _in(edges: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Whether each edge is one of the others."""
    width = 1 + max(edges.max(initial=0), others.max(initial=0))
    weights = np.array([width, 1], dtype=np.int64)
    return np.isin(edges @ weights, others @ weights)


def to_trimesh(vertices: np.ndarray, triangles: np.ndarray, uvs: Optional[np.ndarray] = None) -> Any:
    """A mesh of trimesh, whose vertices keep their numbers."""
    trimesh = package("trimesh", "to_trimesh")
    made = trimesh.Trimesh(vertices, triangles, process=False)
    if uvs is not None:
        visual = package("trimesh.visual", "to_trimesh")
        made.visual = visual.TextureVisuals(uv=uvs)
    return made


def to_pyvista(
    vertices: np.ndarray,
    polygons: Sequence[np.ndarray],
    of_vertices: Mapping[str, np.ndarray] = {},
    of_faces: Mapping[str, np.ndarray] = {},
) -> Any:
    """A mesh of pyvista. `polygons` has one array for each number of corners."""
    pyvista = package("pyvista", "to_pyvista")
    padded = [np.insert(block, 0, block.shape[1], axis=1).reshape(-1) for block in polygons]
    made = pyvista.PolyData(vertices, faces=np.concatenate(padded) if padded else None)
    for name, values in of_vertices.items():
        made.point_data[name] = values
    for name, values in of_faces.items():
        made.cell_data[name] = values
    return made


#: What meshio calls polygons.
_MESHIO = {3: "triangle", 4: "quad"}


def to_meshio(
    vertices: np.ndarray,
    polygons: Sequence[np.ndarray],
    of_vertices: Mapping[str, np.ndarray] = {},
    of_faces: Mapping[str, np.ndarray] = {},
) -> Any:
    """A mesh of meshio. `polygons` has one array for each number of corners."""
    meshio = package("meshio", "to_meshio")
    cells = [(_MESHIO.get(block.shape[1], "polygon"), block) for block in polygons]
    ends = np.cumsum([len(block) for block in polygons])[:-1]
    data = {name: np.split(values, ends) for name, values in of_faces.items()}
    return meshio.Mesh(vertices, cells, point_data=dict(of_vertices), cell_data=data)
