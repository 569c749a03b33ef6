"""Seamless maps of triangle meshes."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np

from ._handle import Handle, number
from ._library import lib, path
from .arrays import pointer, reals
from .errors import check
from .field import Field, field
from .guidance import OPTIONS, split
from .mesh import pointer_of
from .options import options as solve_options, options_handle, with_options
from .quads import Quads, extracted
from .solution import Solution, taken
from .watch import CancelToken, Progress, Watch


class Map:
    """Coordinates (u, v) on a cut surface that match over cuts by quarter turns and integer shifts.

    Made by `map`. `solve` solves it again for another size and reuses earlier work.
    """

    def __init__(self, of: Field) -> None:
        self.field = of
        mesh = of.mesh._handle.pointer
        arguments = (mesh, of._handle.pointer, pointer_of(of._guidance))
        self._handle = Handle.made("roundel_map", lib.roundel_map_new, *arguments)

    def solve(
        self,
        *,
        quads: Optional[int] = None,
        edge_length: Any = None,
        untangle: bool = True,
        stiffenings: int = 5,
        progress: Progress = None,
        cancel: Optional[CancelToken] = None,
        **options: Any,
    ) -> None:
        """Solves for a size: a number of quads, or an edge length, or one or two lengths for each face.

        `untangle` makes the map fold-free: integers that collapse cones are decided anew, flipped
        triangles are turned back, and the map is refined if some remain. Before that, the
        surroundings of flipped triangles are stiffened `stiffenings` times.
        """
        self._aim(quads, edge_length)
        handle, watch = options_handle(options), Watch(progress, cancel)
        check(lib.roundel_map_set_stiffening_count(self._handle.pointer, stiffenings))
        call = lib.roundel_map_solve_fold_free if untangle else lib.roundel_map_solve
        watch.check(call(self._handle.pointer, handle.pointer, watch.pointer))

    def _aim(self, quads: Optional[int], edge_length: Any) -> None:
        if quads is not None and edge_length is not None:
            raise TypeError("quads and edge_length are two ways to say one thing")
        if quads is not None:
            check(lib.roundel_map_set_quads(self._handle.pointer, quads))
        elif edge_length is not None and np.isscalar(edge_length):
            check(lib.roundel_map_set_edge_length(self._handle.pointer, edge_length))
        elif edge_length is not None:
            lengths = np.asarray(edge_length, dtype=np.float64)
            if lengths.ndim == 1:
                lengths = np.stack([lengths, lengths], axis=1)
            lengths = reals(lengths, "edge_length", (-1, 2))
            call = lib.roundel_map_set_edge_lengths
            check(call(self._handle.pointer, pointer(lengths), lengths.size))

    @property
    def uvs(self) -> np.ndarray:
        """u and v of the three corners of every face: an array of shape (faces, 3, 2)."""
        found = np.empty((len(self.field.mesh.faces), 3, 2))
        check(lib.roundel_map_corner_uvs(self._handle.pointer, pointer(found), found.size))
        return found

    @property
    def vertex_uvs(self) -> np.ndarray:
        """u and v of every vertex of the cut surface."""
        found = np.empty((number(lib.roundel_map_vertex_count, self._handle.pointer), 2))
        check(lib.roundel_map_vertex_uvs(self._handle.pointer, pointer(found), found.size))
        return found

    @property
    def vertex_corners(self) -> np.ndarray:
        """The three corners of every face as vertices of the cut surface."""
        found = np.empty((len(self.field.mesh.faces), 3), dtype=np.int32)
        check(lib.roundel_map_vertex_corners(self._handle.pointer, pointer(found), found.size))
        return found

    @property
    def transitions(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The cut edges, and for each its quarter turns (0 to 3) and its translation (s, t)."""
        count = number(lib.roundel_map_cut_count, self._handle.pointer)
        edges, quarters = np.empty((2, count), dtype=np.int32)
        shifts = np.empty((count, 2))
        arrays = (pointer(edges), pointer(quarters), pointer(shifts))
        check(lib.roundel_map_transitions(self._handle.pointer, count, *arrays))
        return edges, quarters, shifts

    @property
    def cones(self) -> np.ndarray:
        """The irregular vertices of the field, which lie on integers."""
        return self._list(lib.roundel_map_cone_count, lib.roundel_map_cones)

    @property
    def flipped(self) -> np.ndarray:
        """The faces that the map flips or collapses."""
        return self._list(lib.roundel_map_flipped_face_count, lib.roundel_map_flipped_faces)

    @property
    def winding_defects(self) -> np.ndarray:
        """The vertices around which the map turns a different number of times than the field."""
        return self._list(lib.roundel_map_winding_defect_count, lib.roundel_map_winding_defects)

    @property
    def refinements(self) -> int:
        """How often untangling refined the map, each time by the square root of two in length."""
        return number(lib.roundel_map_refinement_count, self._handle.pointer)

    @property
    def valid(self) -> bool:
        """Whether no face is flipped or collapsed."""
        return number(lib.roundel_map_flipped_face_count, self._handle.pointer) == 0

    @property
    def energy(self) -> float:
        """The sum over faces of area times the squared deviation of the gradients from the field."""
        return number(lib.roundel_map_energy, self._handle.pointer, kind="double")

    @property
    def solution(self) -> Solution:
        """The solution of the map's problem."""
        call = lib.roundel_map_solution
        return taken(Handle.made("roundel_solution", call, self._handle.pointer).pointer)

    def quads(self) -> Quads:
        """The quads of the map, not smoothed. Their vertices are the crossings of integer isolines."""
        return extracted(self._handle)

    def write(self, file: Any) -> None:
        """Writes the mesh with its coordinates to an OBJ file."""
        check(lib.roundel_map_write(self._handle.pointer, path(file)))

    def _list(self, count: Any, call: Any) -> np.ndarray:
        found = np.empty(number(count, self._handle.pointer), dtype=np.int32)
        check(call(self._handle.pointer, pointer(found), len(found)))
        return found


@with_options(OPTIONS, solve_options())
def map(
    V: Any,
    F: Any = None,
    *,
    quads: Optional[int] = None,
    edge_length: Any = None,
    untangle: bool = True,
    stiffenings: int = 5,
    progress: Progress = None,
    cancel: Optional[CancelToken] = None,
    **keywords: Any,
) -> Map:
    """A seamless map of a mesh or a `Field`, for a size of quads (by default, about 1000 quads).

    Keywords are those of `field` and of `Map.solve`; the options are those of both solves.

    >>> import roundel
    >>> cube = roundel.Mesh.shape("rounded-cube", 600)
    >>> map = roundel.map(cube, quads=100)
    >>> map.uvs.shape == (len(cube.faces), 3, 2), map.valid
    (True, True)
    """
    given, options = split(keywords)
    watched: dict[str, Any] = {"progress": progress, "cancel": cancel, **options}
    if isinstance(V, Field):
        if F is not None or given:
            raise TypeError("a field has its mesh and its guidance: give them to the field")
        made = Map(V)
    else:
        made = Map(field(V, F, **watched, **given))
    remedies: dict[str, Any] = {"untangle": untangle, "stiffenings": stiffenings}
    made.solve(quads=quads, edge_length=edge_length, **remedies, **watched)
    return made
