"""Polygon soups, and the meshes that repair makes of them."""

from __future__ import annotations

from enum import IntEnum
from typing import Any, Optional, Union

import numpy as np

from ._groups import REPAIR
from ._handle import Handle, number
from ._library import ffi, lib, path
from ._types import File, MeshLike
from .arrays import indices, indices32, pointer, reals
from .attributes import Attributes, of_handle
from .errors import check
from .keywords import checked, takes
from .mesh import Mesh
from .options import set_option
from .packages import arrays_of, is_path


class EditKind(IntEnum):
    """What repair did: the kinds of the edits in `Repair.edits`.

    >>> import roundel
    >>> roundel.EditKind.VERTEX_WELDED.name.lower()
    'vertex_welded'

    Kinds, and what `element` and `other` of such an edit are, which count from 0:

      VERTEX_NOT_FINITE = 0
          A vertex with a coordinate that is no finite number was dropped. `element`: vertex.
      POLYGON_NOT_FINITE = 1
          A polygon with such a vertex was dropped. `element`: polygon; `other`: vertex that is not
          finite.
      POLYGON_OUT_OF_RANGE = 2
          A polygon that names a vertex that is not there was dropped. `element`: polygon; `other`:
          corner that names no vertex.
      VERTEX_WELDED = 3
          A vertex was welded to another one. `element`: vertex; `other`: vertex that stays.
      CORNERS_REMOVED = 4
          Corners of a polygon that repeat were removed. `element`: polygon; `other`: number of
          corners removed.
      POLYGON_DEGENERATE = 5
          A polygon of fewer than three different corners was dropped. `element`: polygon.
      POLYGON_TRIANGULATED = 6
          A polygon of more than three corners was triangulated. `element`: polygon; `other`: number
          of triangles.
      DUPLICATE_DROPPED = 7
          A triangle with the corners and the direction of an earlier one was dropped. `element`:
          polygon; `other`: polygon that stays.
      OPPOSITE_DROPPED = 8
          A triangle that runs against one with the same corners was dropped. `element`: polygon;
          `other`: polygon that it runs against.
      EDGE_COLLAPSED = 9
          A vertex of a triangle without area was merged with the vertex next to it. `element`:
          vertex; `other`: vertex that stays.
      CAP_FLIPPED = 10
          A triangle with a vertex on its opposite edge gave way: the others at that edge were split
          there. `element`: polygon; `other`: vertex on the edge.
      SLIVER_DROPPED = 11
          A triangle without area that could not be collapsed or flipped was dropped. `element`:
          polygon.
      POLYGON_TURNED = 12
          A polygon was turned, so that it runs like its neighbors. `element`: polygon.
      COMPONENT_TURNED = 13
          A closed component in which polygons were turned was turned outwards as a whole.
          `element`: lowest polygon of the component; `other`: number of triangles.
      EDGE_CUT = 14
          An edge was cut open: it had more than two faces, or its faces cannot run alike.
          `element`: vertex at one end; `other`: vertex at the other end.
      VERTEX_SPLIT = 15
          A vertex became several, one for each fan of its faces. `element`: vertex; `other`: number
          of vertices that it became.
      EDGE_HALVED = 16
          A second edge between the same vertices got a vertex in its middle. `element`: vertex at
          one end; `other`: vertex at the other end.
      VERTEX_UNUSED = 17
          A vertex without faces was dropped. `element`: vertex.
      COMPONENT_DROPPED = 18
          A component below the share of the area that was asked for was dropped. `element`: lowest
          polygon of the component; `other`: number of triangles.
      HOLE_FILLED = 19
          A hole was filled. `element`: a vertex on its rim; `other`: number of edges.
    """

    VERTEX_NOT_FINITE = 0
    POLYGON_NOT_FINITE = 1
    POLYGON_OUT_OF_RANGE = 2
    VERTEX_WELDED = 3
    CORNERS_REMOVED = 4
    POLYGON_DEGENERATE = 5
    POLYGON_TRIANGULATED = 6
    DUPLICATE_DROPPED = 7
    OPPOSITE_DROPPED = 8
    EDGE_COLLAPSED = 9
    CAP_FLIPPED = 10
    SLIVER_DROPPED = 11
    POLYGON_TURNED = 12
    COMPONENT_TURNED = 13
    EDGE_CUT = 14
    VERTEX_SPLIT = 15
    EDGE_HALVED = 16
    VERTEX_UNUSED = 17
    COMPONENT_DROPPED = 18
    HOLE_FILLED = 19


#: The type of an entry of `Repair.edits`.
EDIT = np.dtype([("kind", np.int32), ("element", np.int32), ("other", np.int32)])


class Soup:
    """A polygon soup: vertices, and polygons with any number of corners, of which nothing is assumed.

    `vertices` has x, y, z of every vertex. `polygons` is a list of lists of corners, counted from 0, or an
    array with as many columns as a polygon has corners. It is left out where `vertices` is the path of a
    file (as for `read`) or a mesh of another package: see `Mesh`. Corners that name no vertex are kept,
    for repair to tell.

    >>> import roundel
    >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    >>> soup = roundel.Soup(square, [[0, 1, 2, 3]])
    >>> len(soup), len(soup.vertices)
    (1, 4)
    """

    def __init__(self, vertices: MeshLike, polygons: Any = None) -> None:
        if polygons is None and is_path(vertices):
            self._handle = Handle.made("roundel_soup", lib.roundel_soup_read, path(vertices))
            return
        vertices, polygons = arrays_of(vertices, polygons)
        points = reals(vertices, "vertices", (-1, 3))
        corners, sizes = _lists(polygons)
        twin = "_i64" if corners.dtype == np.int64 else ""
        call = getattr(lib, f"roundel_soup_new{twin}")
        arrays = (len(points), pointer(points), len(sizes), pointer(sizes))
        self._handle = Handle.made("roundel_soup", call, *arrays, len(corners), pointer(corners))

    @classmethod
    def read(cls, file: File, format: Optional[str] = None) -> Soup:
        """Reads an OBJ, OFF, PLY, STL, glTF or GLB file, which may be compressed by gzip.

        `format` is "obj", "off", "ply", "stl", "gltf" or "glb"; without it, the extension tells.
        """
        made = cls.__new__(cls)
        if format is None:
            made._handle = Handle.made("roundel_soup", lib.roundel_soup_read, path(file))
        else:
            call = lib.roundel_soup_read_as
            made._handle = Handle.made("roundel_soup", call, path(file), format.encode())
        return made

    def __repr__(self) -> str:
        vertices = number(lib.roundel_soup_vertex_count, self._handle.pointer)
        return f"<Soup: {vertices} vertices, {len(self)} polygons>"

    def __len__(self) -> int:
        """The number of polygons."""
        return self._counts()[0]

    @property
    def vertices(self) -> np.ndarray:
        """x, y, z of every vertex."""
        found = np.empty((number(lib.roundel_soup_vertex_count, self._handle.pointer), 3))
        check(lib.roundel_soup_coordinates(self._handle.pointer, pointer(found), found.size))
        return found

    @property
    def polygons(self) -> list[np.ndarray]:
        """The corners of every polygon."""
        count, corner_count = self._counts()
        sizes, corners = np.empty(count, np.int32), np.empty(corner_count, np.int64)
        arrays = (count, pointer(sizes), corner_count, pointer(corners))
        check(lib.roundel_soup_polygons(self._handle.pointer, *arrays))
        return np.split(corners, np.cumsum(sizes)[:-1]) if count else []

    def _counts(self) -> tuple[int, int]:
        counts = ffi.new("size_t[2]")
        check(lib.roundel_soup_polygon_counts(self._handle.pointer, counts, counts + 1))
        return counts[0], counts[1]


def _lists(polygons: Any) -> tuple[np.ndarray, np.ndarray]:
    """The corners of all polygons, and the number of corners of each."""
    if isinstance(polygons, np.ndarray) and polygons.ndim == 2:
        corners = indices(polygons.reshape(-1), "polygons")
        return corners, np.full(len(polygons), polygons.shape[1], np.int32)
    each = [indices(polygon, "polygons") for polygon in polygons]
    sizes = indices32([len(polygon) for polygon in each], "polygons")
    return indices(np.concatenate(each) if each else [], "polygons"), sizes


class Repair:
    """What `repair` makes of a soup: a mesh, the edits, and where its vertices and faces come from."""

    def __init__(self, handle: Handle) -> None:
        self._handle = handle
        self._mesh: Optional[Mesh] = None

    def __repr__(self) -> str:
        return f"<Repair: {self.summary or 'nothing to do'}; {self.mesh!r}>"

    @property
    def mesh(self) -> Mesh:
        """The mesh."""
        if self._mesh is None:
            call = lib.roundel_repair_mesh
            self._mesh = Mesh._of(Handle.made("roundel_mesh", call, self._handle.pointer))
        return self._mesh

    @property
    def edits(self) -> np.ndarray:
        """Everything that was done, in order: an array of `kind`, an `EditKind`, `element` and `other`.

        The kind says which numbers of the soup `element` and `other` are; `other` is -1 where there is none.
        """
        count = number(lib.roundel_repair_edit_count, self._handle.pointer)
        columns = [np.empty(count, np.int32) for _ in EDIT.names or ()]
        places = (pointer(column) for column in columns)
        check(lib.roundel_repair_edits(self._handle.pointer, *places, count))
        found = np.empty(count, EDIT)
        for name, column in zip(EDIT.names or (), columns):
            found[name] = column
        return found

    @property
    def counts(self) -> dict[str, int]:
        """How often each kind of edit was made, by its name; kinds that were not are left out."""
        call = lib.roundel_repair_count_of
        counts = {kind.name.lower(): number(call, self._handle.pointer, kind.value) for kind in EditKind}
        return {name: count for name, count in counts.items() if count}

    @property
    def summary(self) -> str:
        """One line, such as "welded 12 vertices, split 3 vertices"; empty if nothing was done."""
        length = ffi.new("size_t *")
        check(lib.roundel_repair_summary(self._handle.pointer, ffi.NULL, 0, length))
        buffer = ffi.new("char[]", length[0] + 1)
        check(lib.roundel_repair_summary(self._handle.pointer, buffer, length[0] + 1, ffi.NULL))
        return ffi.string(buffer).decode()

    @property
    def vertex_origins(self) -> np.ndarray:
        """The vertex of the soup that each vertex of the mesh comes from; -1 for one that repair made."""
        return self._int32(lib.roundel_repair_vertex_origins, lib.roundel_repair_vertex_count)

    @property
    def face_origins(self) -> np.ndarray:
        """The polygon of the soup that each face of the mesh comes from; -1 for one that fills a hole."""
        return self._int32(lib.roundel_repair_face_origins, lib.roundel_repair_face_count)

    @property
    def welded_to(self) -> np.ndarray:
        """The vertex to which each vertex of the soup was welded: itself if to none, -1 if it is not finite."""
        return self._int32(lib.roundel_repair_welded_to, lib.roundel_repair_soup_vertex_count)

    def attributes(self, file: File) -> Attributes:
        """Materials, groups, colours, texture coordinates and scalars of the mesh.

        They come from the file that the soup was read from. Faces that fill holes have none.
        """
        call = lib.roundel_repair_read_attributes
        handle = Handle.made("roundel_attributes", call, self._handle.pointer, path(file))
        vertices = number(lib.roundel_repair_vertex_count, self._handle.pointer)
        return of_handle(handle, vertices, number(lib.roundel_repair_face_count, self._handle.pointer))

    def attribute_edges(self, file: File, attribute: str) -> np.ndarray:
        """The edges whose two faces differ in an attribute of the file that the soup was read from.

        `attribute` is "materials", "groups", "smoothing", "seams" (of texture coordinates) or "normals" of an
        OBJ file, or "colors" of the faces of a PLY file. Edges are given by their two vertices, in an array of
        shape (edges, 2), which may be `features` of a field, a map or quads.
        """
        mesh = self.mesh
        marks = np.empty(len(mesh.edge_faces), dtype=np.int32)
        call = lib.roundel_repair_mark_attribute
        check(call(self._handle.pointer, path(file), attribute.encode(), pointer(marks), marks.size))
        ends = np.empty((marks.size, 2), dtype=np.int32)
        ends[mesh.face_edges] = np.stack([mesh.faces, np.roll(mesh.faces, -1, axis=1)], axis=2)
        return ends[marks != 0]

    def _int32(self, call: Any, count: Any) -> np.ndarray:
        found = np.empty(number(count, self._handle.pointer), dtype=np.int32)
        check(call(self._handle.pointer, pointer(found), found.size))
        return found


@takes(REPAIR)
def repair(vertices: Union[MeshLike, Soup], polygons: Any = None, **keywords: Any) -> Repair:
    """Makes an oriented manifold mesh of a soup, and says what it did.

    `vertices` has x, y, z of every vertex, and `polygons` the corners of every polygon, as for `Soup`; or
    `vertices` alone is a `Soup`, the path of a mesh file, or a mesh of another package. A soup that `Mesh`
    accepts comes back as it is, unless its boundary edges lie on each other: then they are welded.

    >>> import roundel
    >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [5, 5, 5]]
    >>> done = roundel.repair(square, [[0, 1, 2, 3]])
    >>> done.summary
    'triangulated 1 polygon, dropped 1 unused vertex'
    >>> done.mesh.faces.shape, done.vertex_origins.tolist(), done.face_origins.tolist()
    ((2, 3), [0, 1, 2, 3], [0, 0])
    >>> done.counts
    {'polygon_triangulated': 1, 'vertex_unused': 1}
    """
    options = checked(repair, keywords)
    given = vertices if isinstance(vertices, Soup) and polygons is None else Soup(vertices, polygons)
    how = Handle.made("roundel_repair_options", lib.roundel_repair_options_new)
    for name, value in options.items():
        set_option(how.pointer, "repair_options", name, value)
    return Repair(Handle.made("roundel_repair", lib.roundel_soup_repair, given._handle.pointer, how.pointer))
