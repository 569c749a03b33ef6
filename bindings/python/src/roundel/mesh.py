"""Triangle meshes from arrays, from files and from other packages."""

from __future__ import annotations

import sys
import warnings
from typing import Any, Optional

import numpy as np

from . import packages
from ._groups import REPAIR
from ._handle import Handle, number
from ._library import ffi, lib, path
from ._types import ArrayLike, File, MeshLike
from .attributes import Attributes, of_handle
from .arrays import count, indices, pointer, reals
from .errors import (
    InconsistentOrientationError,
    IsolatedVertexError,
    NonManifoldEdgeError,
    NonManifoldVertexError,
    NotATriangleError,
    RepeatedVertexError,
    ZeroAreaError,
    check,
)
from .keywords import takes
from .plot import Shown, draw


class Mesh:
    """An oriented triangle mesh, with or without boundary, which is checked on construction.

    `V` has x, y, z of every vertex, of shape (vertices, 3), and `F` the three corners of every triangle,
    counted from 0 and counter-clockwise seen from outside, of shape (faces, 3). In place of both, `V` is
    the path of a file (as for `read`), or a mesh of trimesh, pyvista, meshio, pymeshlab or openmesh, or
    any object with `vertices` and `faces`. Every function of this package that takes a mesh takes all of
    these as well.

    What is not an oriented manifold of triangles is refused, by an `Error` that names the face or the
    vertex at fault: `Mesh.from_soup` repairs it, and `Mesh.from_trimesh` welds seams of textures.

    >>> import roundel
    >>> mesh = roundel.Mesh.shape("torus", 200)
    >>> mesh
    <Mesh: 96 vertices, 192 triangles, closed, Euler characteristic 0>
    >>> roundel.Mesh(mesh.vertices, mesh.faces).faces.shape == mesh.faces.shape
    True
    """

    def __init__(self, V: MeshLike, F: Optional[ArrayLike] = None) -> None:
        if F is None and packages.is_path(V):
            self._handle = _read(V)
            return
        vertices, faces = packages.arrays_of(V, F)
        points = reals(vertices, "vertices", (-1, 3))
        corners = indices(faces, "faces", (-1, 3))
        twin = "_i64" if corners.dtype == np.int64 else ""
        call = getattr(lib, f"roundel_mesh_new{twin}")
        arrays = (len(points), pointer(points), len(corners), pointer(corners))
        try:
            self._handle = Handle.made("roundel_mesh", call, *arrays)
        except _NOT_A_MANIFOLD as error:
            error.args = (f"{error}: {_remedy(V)}",)
            raise
        if F is None and self.boundary_loops > 0:
            self._warn_of_seams(V)

    def _warn_of_seams(self, given: Any) -> None:
        seams = packages.seams(self.vertices, self.faces)
        if seams > 0:
            told = f"the mesh is cut along {seams} edges, as textures cut it: {_remedy(given)}"
            warnings.warn(told, stacklevel=_levels_to_caller())

    def __repr__(self) -> str:
        vertices = number(lib.roundel_mesh_vertex_count, self._handle.pointer)
        triangles = number(lib.roundel_mesh_face_count, self._handle.pointer)
        loops = self.boundary_loops
        rim = f"{loops} boundary loop{'s' if loops > 1 else ''}" if loops else "closed"
        euler = f"Euler characteristic {self.euler_characteristic}"
        return f"<Mesh: {vertices} vertices, {triangles} triangles, {rim}, {euler}>"

    @classmethod
    def _of(cls, handle: Handle) -> Mesh:
        made = cls.__new__(cls)
        made._handle = handle
        return made

    @classmethod
    def read(cls, file: File, repair: bool = False) -> Mesh:
        """Reads an OBJ, OFF, PLY, STL, glTF or GLB file, which may be compressed by gzip.

        It must hold an oriented manifold of triangles, unless `repair` is true: then the file may hold any
        polygons, and vertices of equal position are welded. `roundel.repair(file)` does the same, and
        says what was done.
        """
        if repair:
            from .repair import Soup

            return cls.from_soup(Soup.read(file))
        return cls._of(_read(file))

    @classmethod
    @takes(REPAIR)
    def from_soup(cls, vertices: MeshLike, polygons: Any = None, **keywords: Any) -> Mesh:
        """The mesh that `roundel.repair` makes of a soup, with its arguments and keywords.

        >>> import roundel
        >>> roundel.Mesh.from_soup([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
        <Mesh: 4 vertices, 2 triangles, 1 boundary loop, Euler characteristic 1>
        """
        from .repair import repair

        return repair(vertices, polygons, **keywords).mesh

    @classmethod
    def from_trimesh(cls, mesh: Any, weld: float = 0.0) -> Mesh:
        """The mesh of a `trimesh.Trimesh` or a `trimesh.Scene`, without the seams of its texture.

        trimesh has a vertex as often as it has texture coordinates, which cuts the surface open. Vertices
        that lie on each other, or up to `weld` apart in units of the mesh, are welded, and what then is no
        oriented manifold is repaired, as by `roundel.repair`.
        """
        from .repair import repair

        return repair(mesh, weld=weld).mesh

    @classmethod
    def shape(cls, name: str, faces: int) -> Mesh:
        """A procedural shape of about `faces` triangles.

        Its name is "rounded-cube", "sphere", "torus", "genus-N" with a number N, "gear", "plane", "disk" or
        "plate-with-holes".
        """
        wanted = count(faces, "faces")
        return cls._of(Handle.made("roundel_mesh", lib.roundel_mesh_make_shape, str(name).encode(), wanted))

    def attributes(self, file: File) -> Attributes:
        """Materials, groups, colours, texture coordinates and scalars, from the file that the mesh was read from.

        A mesh that `repair` made has `Repair.attributes` instead.
        """
        call = lib.roundel_mesh_read_attributes
        handle = Handle.made("roundel_attributes", call, self._handle.pointer, path(file))
        vertices = number(lib.roundel_mesh_vertex_count, self._handle.pointer)
        return of_handle(handle, vertices, number(lib.roundel_mesh_face_count, self._handle.pointer))

    def write(self, file: File) -> None:
        """Writes an OBJ, OFF, binary PLY, binary STL, glTF, GLB or USD text file, by the extension."""
        check(lib.roundel_mesh_write(self._handle.pointer, path(file)))

    def to_trimesh(self) -> Any:
        """The mesh as a `trimesh.Trimesh`."""
        return packages.to_trimesh(self.vertices, self.faces)

    def to_pyvista(self) -> Any:
        """The mesh as a `pyvista.PolyData`."""
        return packages.to_pyvista(self.vertices, [self.faces])

    def to_meshio(self) -> Any:
        """The mesh as a `meshio.Mesh`."""
        return packages.to_meshio(self.vertices, [self.faces])

    def plot(
        self, *, backend: Optional[str] = None, show: bool = True, file: Optional[File] = None
    ) -> Any:
        """Draws the mesh. See `Quads.plot` for the keywords."""
        return draw(Shown(self.vertices, [self.faces], edges=True), backend, show, file)

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

    def mirror_plane(self, plane: str = "auto") -> tuple[np.ndarray, float, float]:
        """The mirror plane that a word means, as `quad` takes it: its normal n, its offset d and its deviation.

        Points of the plane have n . p = d; n points to the side that is kept. The deviation is the largest
        distance of a mirrored vertex from the surface, as a part of the diagonal of the bounding box.

        >>> import roundel
        >>> normal, offset, deviation = roundel.Mesh.shape("torus", 600).mirror_plane("-1,0,0,0")
        >>> normal.tolist(), offset, deviation < 0.05
        ([-1.0, 0.0, 0.0], 0.0, True)
        """
        found, deviation = np.empty(4), ffi.new("double *")
        arguments = (plane.encode(), pointer(found), deviation)
        check(lib.roundel_mesh_mirror_plane(self._handle.pointer, *arguments))
        return found[:3], float(found[3]), deviation[0]

    def _int32(self, call: Any, count: Any, width: int) -> np.ndarray:
        found = np.empty((number(count, self._handle.pointer), width), dtype=np.int32)
        check(call(self._handle.pointer, pointer(found), found.size))
        return found


#: What repair does something about.
_NOT_A_MANIFOLD = (
    InconsistentOrientationError,
    IsolatedVertexError,
    NonManifoldEdgeError,
    NonManifoldVertexError,
    NotATriangleError,
    RepeatedVertexError,
    ZeroAreaError,
)


def _levels_to_caller() -> int:
    """How many calls lie between the caller of this package and the caller of this function."""
    frame, levels = sys._getframe(1), 1
    while frame.f_back is not None and frame.f_globals.get("__name__", "").startswith(f"{__package__}."):
        frame, levels = frame.f_back, levels + 1
    return levels


def _read(file: Any) -> Handle:
    try:
        return Handle.made("roundel_mesh", lib.roundel_mesh_read, path(file))
    except _NOT_A_MANIFOLD as error:
        error.args = (f"{error}: roundel.Mesh.read(file, repair=True) repairs it",)
        raise


def _remedy(given: Any) -> str:
    if type(given).__module__.split(".")[0] == "trimesh":
        return "roundel.Mesh.from_trimesh welds seams of textures and repairs the rest"
    return "roundel.Mesh.from_soup welds vertices of equal position and repairs the rest"


def as_mesh(V: Any, F: Any = None) -> Mesh:
    """The argument itself if it is a Mesh, otherwise a Mesh made of it."""
    return V if isinstance(V, Mesh) and F is None else Mesh(V, F)


def pointer_of(handle: Any) -> Any:
    """The address of an object of the library; NULL for None."""
    return ffi.NULL if handle is None else handle.pointer
