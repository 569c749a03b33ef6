"""Quad meshes from triangle meshes and from maps."""

from __future__ import annotations

from typing import Any, Iterator, Optional

import numpy as np

from ._handle import Handle, number
from ._library import ffi, lib, path
from .arrays import pointer, reals
from .errors import check
from .guidance import OPTIONS as GUIDANCE, guidance_handle, says_curvature, split
from .mesh import Mesh, as_mesh, pointer_of
from .options import options, options_handle, quad_options, set_option, with_options
from .watch import CancelToken, Progress, Watch

#: The options that quads have beside those of their guidance and of the solves.
OPTIONS = quad_options()


class Quads:
    """A mesh of quads and of the few other polygons that a map may give. Made by `quad`.

    It unpacks into vertices and quads: `vertices, quads = roundel.quad(V, F)`.
    """

    def __init__(self, handle: Handle) -> None:
        self._handle = handle

    def __iter__(self) -> Iterator[np.ndarray]:
        return iter((self.vertices, self.faces))

    def __len__(self) -> int:
        return number(lib.roundel_quads_count, self._handle.pointer)

    @property
    def vertices(self) -> np.ndarray:
        """x, y, z of every vertex."""
        found = np.empty((number(lib.roundel_quads_vertex_count, self._handle.pointer), 3))
        check(lib.roundel_quads_coordinates(self._handle.pointer, pointer(found), found.size))
        return found

    @property
    def faces(self) -> np.ndarray:
        """The four corners of every quad, counter-clockwise seen from outside."""
        found = np.empty((len(self), 4), dtype=np.int32)
        check(lib.roundel_quads_corners(self._handle.pointer, pointer(found), found.size))
        return found

    @property
    def others(self) -> list[np.ndarray]:
        """The corners of every face that is not a quad."""
        counts = ffi.new("size_t[2]")
        check(lib.roundel_quads_other_face_counts(self._handle.pointer, counts, counts + 1))
        sizes, corners = np.empty(counts[0], np.int32), np.empty(counts[1], np.int32)
        arrays = (len(sizes), pointer(sizes), len(corners), pointer(corners))
        check(lib.roundel_quads_other_faces(self._handle.pointer, *arrays))
        return np.split(corners, np.cumsum(sizes)[:-1]) if len(sizes) else []

    @property
    def irregular_count(self) -> int:
        """The number of vertices with other than four edges, or other than three on the boundary."""
        return number(lib.roundel_quads_irregular_count, self._handle.pointer)

    @property
    def euler_characteristic(self) -> int:
        """Vertices minus edges plus faces."""
        call = lib.roundel_quads_euler_characteristic
        return number(call, self._handle.pointer, kind="int64_t")

    @property
    def conforming(self) -> bool:
        """Whether all faces are quads and the topology is that of the triangle mesh."""
        call = lib.roundel_quads_is_conforming
        return bool(number(call, self._handle.pointer, kind="int32_t"))

    def smooth(self, mesh: Mesh, **keywords: Any) -> None:
        """Moves the vertices on `mesh` to make the quads more like squares of one size."""
        guidance = guidance_handle(mesh, keywords)
        arguments = (mesh._handle.pointer, pointer_of(guidance), ffi.NULL)
        check(lib.roundel_quads_smooth(self._handle.pointer, *arguments))

    def write(self, file: Any) -> None:
        """Writes the faces as OBJ, OFF, PLY or USD text, by extension; as STL or glTF, triangles."""
        check(lib.roundel_quads_write(self._handle.pointer, path(file)))


def extracted(map_: Handle) -> Quads:
    """The quads of a map's last solve."""
    return Quads(Handle.made("roundel_quads", lib.roundel_quads_extract, map_.pointer))


def extract(V: Any, F: Any, uvs: Any) -> Quads:
    """The quads of any integer-grid map, given by u and v of the corners, of shape (faces, 3, 2).

    >>> import roundel
    >>> mesh = roundel.Mesh.shape("plane", 200)
    >>> flat = mesh.vertices[mesh.faces][:, :, :2]
    >>> uvs = 4 * (flat - flat.min(axis=(0, 1)))
    >>> len(roundel.extract(mesh.vertices, mesh.faces, uvs)) > 0
    True
    """
    mesh = as_mesh(V, F)
    given = reals(uvs, "uvs", (-1, 3, 2))
    arguments = (mesh._handle.pointer, pointer(given), given.size)
    return Quads(Handle.made("roundel_quads", lib.roundel_quads_extract_from_uvs, *arguments))


@with_options(OPTIONS, GUIDANCE, options())
def quad(
    V: Any,
    F: Any = None,
    *,
    progress: Progress = None,
    cancel: Optional[CancelToken] = None,
    **keywords: Any,
) -> Quads:
    """Quadrangulates a mesh with about `quads` quads (1000 by default) or edges of about `edge_length`.

    Field, map, extraction and smoothing in one call, as the program `roundel quad` does it. Keywords
    are those of `field`; quads follow the boundary and the curvature unless these say otherwise.
    Options are those of the map's solve, `lattice` without a strategy; and but for the strategy of the
    field's, which is `field_strategy`.

    >>> import roundel
    >>> cube = roundel.Mesh.shape("rounded-cube", 600)
    >>> vertices, quads = found = roundel.quad(cube.vertices, cube.faces, quads=100)
    >>> found.conforming, len(vertices) - len(quads)
    (True, 2)
    """
    mesh = as_mesh(V, F)
    own = {name: keywords.pop(name) for name in OPTIONS if name in keywords}
    own = {name: value for name, value in own.items() if value is not None}
    if {"quads", "edge_length"} <= own.keys():
        raise TypeError("quads and edge_length are two ways to say one thing")
    given, solve = split(keywords)
    guidance = guidance_handle(mesh, given, of_quads=True)
    own.setdefault("vary_curvature", not says_curvature(given))
    by = solve if {"strategy", "preset"} & solve.keys() else {"strategy": "lattice", **solve}
    how = Handle.made("roundel_quad_options", lib.roundel_quad_options_new)
    check(lib.roundel_quad_options_set_guidance(how.pointer, pointer_of(guidance)))
    for call, given in (
        (lib.roundel_quad_options_set_map_options, by),
        (lib.roundel_quad_options_set_field_options, {**solve, "strategy": "adaptive"}),
    ):
        check(call(how.pointer, options_handle(given).pointer))
    for name, value in own.items():
        set_option(how.pointer, "quad_options", name, value)
    watch = Watch(progress, cancel)
    place = ffi.new("roundel_quads **")
    watch.check(lib.roundel_quads_make(mesh._handle.pointer, how.pointer, watch.pointer, place))
    return Quads(Handle("roundel_quads", place[0]))
