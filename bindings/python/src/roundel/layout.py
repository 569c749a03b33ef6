"""Base layouts, and quads that follow them."""

from __future__ import annotations

from typing import Any, Sequence

import numpy as np

from ._handle import Handle, number
from ._library import ffi, lib, path
from ._types import ArrayLike, File, MeshLike
from .arrays import indices32, pointer, reals
from .errors import check
from .mesh import as_mesh
from .quads import Quads
from .repair import Soup


class BaseLayout:
    """A base layout: a coarse mesh of polygons anywhere near a surface.

    Its vertices mark points of the surface, its edges are the arcs, its polygons the patches. Vertices are an array of
    shape (vertices, 3), polygons a list of lists of three corners or more.

    >>> import roundel
    >>> corners = [[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
    >>> sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    >>> cube = roundel.BaseLayout(corners, sides)
    >>> quads, subdivisions = cube.quads(roundel.Mesh.shape("sphere", 1000), 600)
    >>> len(quads), set(subdivisions.tolist())
    (600, {10})
    """

    def __init__(self, vertices: ArrayLike, polygons: Sequence[Sequence[int]]) -> None:
        points = reals(vertices, "vertices of the layout", (-1, 3))
        sizes = np.array([len(polygon) for polygon in polygons], dtype=np.int32)
        named = [corner for polygon in polygons for corner in polygon]
        corners = indices32(np.array(named, dtype=np.int64), "polygons of the layout")
        arrays = (len(points), pointer(points), len(sizes), pointer(sizes), len(corners), pointer(corners))
        self._handle = Handle.made("roundel_layout", lib.roundel_layout_new, *arrays)

    @classmethod
    def read(cls, file: File) -> BaseLayout:
        """Reads an OBJ file of vertices and polygons, with lines for arcs whose course is given."""
        layout = cls.__new__(cls)
        layout._handle = Handle.made("roundel_layout", lib.roundel_layout_read, path(file))
        return layout

    @classmethod
    def of_quads(cls, vertices: MeshLike, quads: Any = None, deviation: float = 0.0) -> BaseLayout:
        """Finds the layout of quads, given as for `Soup`, with every arc drawn.

        For a `deviation` of 0 it is the base complex; else a layout with the same irregular vertices and fewer
        patches, whose arcs drift at most so many edges across the lines of the quads. An `Error` names the quad, the
        edge or the vertex that is no part of a manifold of quads.

        >>> import roundel
        >>> made = roundel.quad(roundel.Mesh.shape("sphere", 1000), quads=300)
        >>> layout = roundel.BaseLayout.of_quads(*made)
        >>> len(layout.arcs) >= 12
        True
        """
        soup = vertices if isinstance(vertices, Soup) and quads is None else Soup(vertices, quads)
        given = (soup._handle.pointer, deviation, ffi.NULL)
        layout = cls.__new__(cls)
        layout._handle = Handle.made("roundel_layout", lib.roundel_layout_of_quads, *given)
        return layout

    def write(self, file: File) -> None:
        """Writes an OBJ file, which `read` reads."""
        check(lib.roundel_layout_write(self._handle.pointer, path(file)))

    @property
    def soup(self) -> Soup:
        """The vertices and the polygons."""
        made = Soup.__new__(Soup)
        made._handle = Handle.made("roundel_soup", lib.roundel_layout_soup, self._handle.pointer)
        return made

    @property
    def arcs(self) -> np.ndarray:
        """The two vertices that each arc joins, of shape (arcs, 2), in the order in which polygons name the arcs."""
        found = np.empty((number(lib.roundel_layout_arc_count, self._handle.pointer), 2), dtype=np.int32)
        check(lib.roundel_layout_arcs(self._handle.pointer, pointer(found), found.size))
        return found

    def fix_arc(self, arc: int, edges: int) -> None:
        """Fixes the number of edges of quads along an arc; 0 leaves it free."""
        check(lib.roundel_layout_fix_arc(self._handle.pointer, arc, edges))

    def draw_arc(self, arc: int, points: ArrayLike) -> None:
        """Gives the way of an arc by points near the surface, of shape (points, 3); no points leave it free.

        It runs from the first end of the arc to the second, at the vertices of the layout.
        """
        given = reals(points, "points of the arc", (-1, 3))
        check(lib.roundel_layout_draw_arc(self._handle.pointer, arc, len(given), pointer(given)))

    def hold_arcs(self, held: bool = True) -> None:
        """Keeps arcs whose course is given on it; else they slide."""
        check(lib.roundel_layout_hold_arcs(self._handle.pointer, int(held)))

    def quads(self, mesh: MeshLike, quads: int = 1000) -> tuple[Quads, np.ndarray]:
        """Makes about `quads` quads on a mesh that follow the layout, or as few as it allows for 0.

        The result has the quads and the number of their edges along each arc. An `Error` names the vertex, the arc or
        the patch of the layout at fault as its `index`.
        """
        surface = as_mesh(mesh)
        found = np.empty(len(self.arcs), dtype=np.int32)
        given = (surface._handle.pointer, self._handle.pointer, quads, ffi.NULL, pointer(found), found.size)
        made = Handle.made("roundel_quads", lib.roundel_quads_make_layout, *given)
        return Quads(made), found
