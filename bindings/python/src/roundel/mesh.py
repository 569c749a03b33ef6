"""Triangle meshes from arrays, from files and from other packages."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._handle import Handle, number
from ._library import ffi, lib, path
from .arrays import indices, pointer, reals
from .errors import check


class Mesh:
    """An oriented triangle mesh, with or without boundary, which is checked on construction.

    Every function of this package that takes vertices and faces also takes a `Mesh`, a mesh of
    `trimesh`, `pymeshlab` or `openmesh`, or any object with `vertices` and `faces`.

    >>> import roundel
    >>> mesh = roundel.Mesh.shape("torus", 200)
    >>> mesh.euler_characteristic
    0
    >>> roundel.Mesh(mesh.vertices, mesh.faces).faces.shape == mesh.faces.shape
    True
    """

    def __init__(self, V: Any, F: Any = None) -> None:
        vertices, faces = arrays_of(V, F)
        points = reals(vertices, "vertices", (-1, 3))
        corners = indices(faces, "faces", (-1, 3))
        twin = "_i64" if corners.dtype == np.int64 else ""
        call = getattr(lib, f"roundel_mesh_new{twin}")
        arrays = (len(points), pointer(points), len(corners), pointer(corners))
        self._handle = Handle.made("roundel_mesh", call, *arrays)

    @classmethod
    def _of(cls, handle: Handle) -> "Mesh":
        made = cls.__new__(cls)
        made._handle = handle
        return made

    @classmethod
    def read(cls, file: Any, repair: bool = False) -> "Mesh":
        """Reads an OBJ, OFF, PLY, STL, glTF or GLB file.

        It must hold an oriented manifold of triangles, unless `repair` is true: then the file may hold any
        polygons. `roundel.repair(roundel.Soup.read(file))` does the same, and says what was done.
        """
        if repair:
            from .repair import Soup

            return cls.from_soup(Soup.read(file))
        return cls._of(Handle.made("roundel_mesh", lib.roundel_mesh_read, path(file)))

    @classmethod
    def from_soup(cls, vertices: Any, polygons: Any = None, **keywords: Any) -> "Mesh":
        """The mesh that `roundel.repair` makes of a soup, with its keywords."""
        from .repair import repair

        return repair(vertices, polygons, **keywords).mesh

    @classmethod
    def shape(cls, name: str, faces: int) -> "Mesh":
        """A procedural shape of about `faces` triangles: "rounded-cube", "sphere", "gear", ..."""
        return cls._of(Handle.made("roundel_mesh", lib.roundel_mesh_make_shape, name.encode(), faces))

    def write(self, file: Any) -> None:
        """Writes an OBJ, OFF, binary PLY, binary STL, glTF, GLB or USD text file."""
        check(lib.roundel_mesh_write(self._handle.pointer, path(file)))

    @property
    def vertices(self) -> np.ndarray:
        """x, y, z of every vertex."""
        found = np.empty((number(lib.roundel_mesh_vertex_count, self._handle.pointer), 3))
        check(lib.roundel_mesh_coordinates(self._handle.pointer, pointer(found), found.size))
        return found

    @property
    def faces(self) -> np.ndarray:
        """The three corners of every face."""
        return self._int32(lib.roundel_mesh_corners, lib.roundel_mesh_face_count, 3)

    @property
    def edge_faces(self) -> np.ndarray:
        """The two faces of every edge; the second is -1 at the boundary."""
        return self._int32(lib.roundel_mesh_edge_faces, lib.roundel_mesh_edge_count, 2)

    @property
    def face_edges(self) -> np.ndarray:
        """The three edges of every face; edge k runs from corner k to corner k + 1."""
        return self._int32(lib.roundel_mesh_face_edges, lib.roundel_mesh_face_count, 3)

    @property
    def boundary_loops(self) -> int:
        """The number of boundary loops."""
        return number(lib.roundel_mesh_boundary_loop_count, self._handle.pointer)

    @property
    def euler_characteristic(self) -> int:
        """Vertices minus edges plus faces."""
        call = lib.roundel_mesh_euler_characteristic
        return number(call, self._handle.pointer, kind="int64_t")

    def _int32(self, call: Any, count: Any, width: int) -> np.ndarray:
        found = np.empty((number(count, self._handle.pointer), width), dtype=np.int32)
        check(call(self._handle.pointer, pointer(found), found.size))
        return found


def as_mesh(V: Any, F: Any = None) -> Mesh:
    """The argument itself if it is a Mesh, otherwise a Mesh made of it."""
    return V if isinstance(V, Mesh) and F is None else Mesh(V, F)


def arrays_of(V: Any, F: Any) -> tuple[Any, Any]:
    """Vertices and faces of the arguments, or of a mesh of any package."""
    if F is not None:
        return V, F
    # A MeshSet of pymeshlab stands for its current mesh.
    mesh = V.current_mesh() if hasattr(V, "current_mesh") else V
    for vertices, faces in (
        ("vertex_matrix", "face_matrix"),
        ("points", "face_vertex_indices"),
        ("vertices", "faces"),
    ):
        if hasattr(mesh, vertices) and hasattr(mesh, faces):
            found = getattr(mesh, vertices), getattr(mesh, faces)
            points, corners = (part() if callable(part) else part for part in found)
            return points, corners
    raise TypeError(f"{type(V).__name__} has neither vertices and faces nor is it a known mesh")


def pointer_of(handle: Any) -> Any:
    """The address of an object of the library; NULL for None."""
    return ffi.NULL if handle is None else handle.pointer
