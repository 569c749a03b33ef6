"""Seamless maps of triangle meshes."""

from __future__ import annotations

from typing import Any, Optional, Union

import numpy as np

from . import packages
from ._groups import SIZE, SOLVE, TUNING, WATCH
from ._handle import Handle, number
from ._library import lib, path
from ._types import ArrayLike, File, MeshLike
from .arrays import count, pointer, real
from .errors import ArgumentTypeError, check, refusal
from .events import Progress
from .field import Field, field
from .guidance import GUIDANCE, split
from .keywords import checked, takes
from .mesh import pointer_of
from .options import options_handle
from .plot import Shown, draw, integer_lines, lifted
from .quads import Quads, extracted, lengths_of_faces, one_size
from .solution import Solution, taken
from .watch import CancelToken, Interrupted, Watch


class Map:
    """Coordinates (u, v) on a cut surface that match over cuts by quarter turns and integer shifts.

    Made by `map`, or as `Map(field)` and then solved. `solve` solves it again for another size and reuses
    earlier work.
    """

    def __init__(self, of: Field) -> None:
        #: The field of the map, with its mesh.
        self.field = of
        mesh = of.mesh._handle.pointer
        arguments = (mesh, of._handle.pointer, pointer_of(of._guidance))
        self._handle = Handle.made("roundel_map", lib.roundel_map_new, *arguments)
        self._solved = False

    def __repr__(self) -> str:
        if not self._solved:
            return f"<Map of {self.field!r}, not solved>"
        faces, cones = len(self.field.mesh.faces), len(self.cones)
        folded = len(self.flipped)
        return f"<Map: {faces} triangles, {folded} of them folded, {cones} cones, energy {self.energy:.6g}>"

    @takes(SIZE, SOLVE, WATCH, TUNING)
    def solve(
        self,
        *,
        quads: Optional[int] = None,
        edge_length: Union[float, ArrayLike, None] = None,
        untangle: bool = True,
        stiffenings: int = 5,
        progress: Progress = None,
        cancel: Optional[CancelToken] = None,
        **options: Any,
    ) -> None:
        """Solves the map for a size of quads, 1000 quads if nothing is said; its results are then replaced.

        >>> import roundel
        >>> map = roundel.map(roundel.Mesh.shape("rounded-cube", 600), quads=100)
        >>> map.solve(quads=400)
        >>> map.valid
        True
        """
        options = checked(Map.solve, options)
        self._aim(quads, edge_length)
        handle, watch = options_handle(options), Watch(progress, cancel)
        check(lib.roundel_map_set_stiffening_count(self._handle.pointer, count(stiffenings, "stiffenings")))
        call = lib.roundel_map_solve_fold_free if untangle else lib.roundel_map_solve
        with watch:
            status = call(self._handle.pointer, handle.pointer, watch.pointer)
        watch.result(status, self._now_solved)

    def _now_solved(self) -> Map:
        self._solved = True
        return self

    def _aim(self, quads: Optional[int], edge_length: Any) -> None:
        one_size(quads, edge_length)
        if quads is not None:
            check(lib.roundel_map_set_quads(self._handle.pointer, count(quads, "quads")))
        elif edge_length is not None and np.ndim(edge_length) == 0:
            check(lib.roundel_map_set_edge_length(self._handle.pointer, real(edge_length, "edge_length")))
        elif edge_length is not None:
            lengths = lengths_of_faces(edge_length)
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

    def write(self, file: File) -> None:
        """Writes the mesh with its coordinates to an OBJ file."""
        check(lib.roundel_map_write(self._handle.pointer, path(file)))

    def to_trimesh(self) -> Any:
        """The cut surface as a `trimesh.Trimesh` with texture coordinates (u, v)."""
        return packages.to_trimesh(self._cut_vertices(), self.vertex_corners, self.vertex_uvs)

    def to_pyvista(self) -> Any:
        """The cut surface as a `pyvista.PolyData` with texture coordinates (u, v)."""
        made = packages.to_pyvista(self._cut_vertices(), [self.vertex_corners])
        made.active_texture_coordinates = self.vertex_uvs
        return made

    def to_meshio(self) -> Any:
        """The cut surface as a `meshio.Mesh` with `uv` a vertex."""
        return packages.to_meshio(self._cut_vertices(), [self.vertex_corners], {"uv": self.vertex_uvs})

    def _cut_vertices(self) -> np.ndarray:
        found = np.empty((number(lib.roundel_map_vertex_count, self._handle.pointer), 3))
        found[self.vertex_corners] = self.field.mesh.vertices[self.field.mesh.faces]
        return found

    def plot(
        self, *, backend: Optional[str] = None, show: bool = True, file: Optional[File] = None
    ) -> Any:
        """Draws the lines of integer u and v on the surface, and the cones as `Field.plot` does.

        See `Quads.plot` for the keywords.
        """
        mesh = self.field.mesh
        vertices, faces, steps = mesh.vertices, mesh.faces, self.field.vertex_index_steps
        lines = integer_lines(lifted(vertices[faces]), self.uvs)
        shown = Shown(vertices, [faces], lines=lines, forth=vertices[steps > 0], back=vertices[steps < 0])
        return draw(shown, backend, show, file)

    def _list(self, count: Any, call: Any) -> np.ndarray:
        found = np.empty(number(count, self._handle.pointer), dtype=np.int32)
        check(call(self._handle.pointer, pointer(found), len(found)))
        return found


@takes(SIZE, GUIDANCE, SOLVE, WATCH, TUNING)
def map(
    V: Union[MeshLike, Field],
    F: Optional[ArrayLike] = None,
    *,
    quads: Optional[int] = None,
    edge_length: Union[float, ArrayLike, None] = None,
    untangle: bool = True,
    stiffenings: int = 5,
    progress: Progress = None,
    cancel: Optional[CancelToken] = None,
    **keywords: Any,
) -> Map:
    """A seamless map of a mesh: coordinates (u, v), whose integer lines are quads on the surface.

    `V` and `F` are vertices and triangles; or `V` alone is a `Mesh`, the path of a mesh file, a mesh of
    another package (see `Mesh`), or a `Field`, which the map then follows. Of a mesh, the field is solved
    for first, by the same options. On shapes with small details, ask for `detail` of about the edge of a
    quad. Every keyword may be left out.

    Whether all triangles are the right way round is told by `valid` of the map.

    >>> import roundel
    >>> cube = roundel.Mesh.shape("rounded-cube", 600)
    >>> map = roundel.map(cube, quads=100)
    >>> map.uvs.shape == (len(cube.faces), 3, 2), map.valid
    (True, True)
    """
    given, options = split(checked(map, keywords))
    watched: dict[str, Any] = {"progress": progress, "cancel": cancel, **options}
    one_size(quads, edge_length)
    if isinstance(V, Field):
        if F is not None or given:
            told = "a field has its mesh and its guidance: give them to the field"
            raise refusal(ArgumentTypeError, told)
        made = Map(V)
    else:
        made = Map(field(V, F, **watched, **given))
    remedies: dict[str, Any] = {"untangle": untangle, "stiffenings": stiffenings}
    try:
        made.solve(quads=quads, edge_length=edge_length, **remedies, **watched)
    except Interrupted as stop:
        # There is the field at least.
        stop.incumbent = made.field if stop.incumbent is None else stop.incumbent
        raise
    return made
