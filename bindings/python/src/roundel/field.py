"""Orientation fields on triangle meshes."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np

from . import packages
from ._groups import SOLVE, TUNING, WATCH
from ._handle import Handle, number
from ._library import ffi, lib
from ._types import ArrayLike, File, MeshLike
from .arrays import pointer
from .errors import check
from .events import Progress
from .guidance import GUIDANCE, guidance_handle, split
from .keywords import checked, takes
from .mesh import Mesh, as_mesh, pointer_of
from .options import options_handle
from .plot import Shown, crosses, draw
from .solution import Solution, taken
from .watch import CancelToken, Watch


class Field:
    """An N-symmetric field: N arms in every face (a cross for N = 4), matched over edges. Made by `field`."""

    def __init__(self, mesh: Mesh, handle: Handle, guidance: Optional[Handle]) -> None:
        #: The mesh of the field.
        self.mesh = mesh
        self._handle = handle
        self._guidance = guidance

    def __repr__(self) -> str:
        arms = {1: "vectors", 2: "lines", 4: "crosses"}.get(self.symmetry, f"{self.symmetry} arms")
        faces = self._count(lib.roundel_mesh_face_count)
        irregular = f"{len(self.irregular)} irregular vertices"
        return f"<Field: {arms} on {faces} triangles, {irregular}, energy {self.energy:.6g}>"

    def _array(self, call: Any, length: int, dtype: Any = np.float64) -> np.ndarray:
        found = np.empty(length, dtype=dtype)
        check(call(self._handle.pointer, pointer(found), length))
        return found

    def _count(self, call: Any) -> int:
        return number(call, self.mesh._handle.pointer)

    @property
    def angles(self) -> np.ndarray:
        """The angle of one arm of every face: radians, counter-clockwise from the face's first edge."""
        return self._array(lib.roundel_field_angles, self._count(lib.roundel_mesh_face_count))

    @property
    def directions(self) -> np.ndarray:
        """The arm of `angles` of every face, as a unit vector in space."""
        corners = self.mesh.vertices[self.mesh.faces]
        first = corners[:, 1] - corners[:, 0]
        first /= np.linalg.norm(first, axis=1)[:, None]
        normal = np.cross(first, corners[:, 2] - corners[:, 0])
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        angles = self.angles[:, None]
        return np.cos(angles) * first + np.sin(angles) * np.cross(normal, first)

    @property
    def period_jumps(self) -> np.ndarray:
        """One number for each edge: angle + kappa + 2 pi/N jump is the matching arm of the second face."""
        call, count = lib.roundel_field_period_jumps, lib.roundel_mesh_edge_count
        return self._array(call, self._count(count), np.int32)

    @property
    def kappa(self) -> np.ndarray:
        """For every edge, the angle between the frames of its two faces, in (-pi, pi]."""
        return self._array(lib.roundel_field_kappa, self._count(lib.roundel_mesh_edge_count))

    @property
    def vertex_indices(self) -> np.ndarray:
        """The index of every vertex in full turns: 1/4 at the corner of a cube, 0 at regular vertices and
        at the boundary. Each is `vertex_index_steps / symmetry`."""
        call, count = lib.roundel_field_vertex_indices, lib.roundel_mesh_vertex_count
        return self._array(call, self._count(count))

    @property
    def vertex_index_steps(self) -> np.ndarray:
        """The index of every vertex in steps of 1/N of a turn, integers: 1 at the corner of a cube."""
        call, count = lib.roundel_field_vertex_index_steps, lib.roundel_mesh_vertex_count
        return self._array(call, self._count(count), np.int32)

    @property
    def boundary_index_steps(self) -> np.ndarray:
        """The index of every boundary loop in steps of 1/N of a turn, integers."""
        call = lib.roundel_field_boundary_index_steps
        return self._array(call, self.mesh.boundary_loops, np.int32)

    @property
    def boundary_indices(self) -> np.ndarray:
        """The index of every boundary loop in full turns: `boundary_index_steps / symmetry`."""
        return self._array(lib.roundel_field_boundary_indices, self.mesh.boundary_loops)

    @property
    def irregular(self) -> np.ndarray:
        """The vertices whose index is not zero."""
        return np.flatnonzero(self.vertex_index_steps)

    @property
    def symmetry(self) -> int:
        """N, the number of arms in a face."""
        return number(lib.roundel_field_symmetry, self._handle.pointer, kind="int32_t")

    @property
    def energy(self) -> float:
        """The sum over interior edges of (angle + kappa + 2 pi/N jump - other angle)^2."""
        return number(lib.roundel_field_energy, self._handle.pointer, kind="double")

    @property
    def solution(self) -> Solution:
        """The solution of the field's problem."""
        call = lib.roundel_field_solution
        return taken(Handle.made("roundel_solution", call, self._handle.pointer).pointer)

    def to_pyvista(self) -> Any:
        """The mesh as a `pyvista.PolyData`, with `direction` a face and `index_steps` a vertex."""
        return packages.to_pyvista(self.mesh.vertices, [self.mesh.faces], *self._data())

    def to_meshio(self) -> Any:
        """The mesh as a `meshio.Mesh`, with `direction` a face and `index_steps` a vertex."""
        return packages.to_meshio(self.mesh.vertices, [self.mesh.faces], *self._data())

    def _data(self) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
        return {"index_steps": self.vertex_index_steps}, {"direction": self.directions}

    def plot(
        self, *, backend: Optional[str] = None, show: bool = True, file: Optional[File] = None
    ) -> Any:
        """Draws arms on the faces, vertices of positive index in red and of negative index in blue.

        See `Quads.plot` for the keywords. Of very many faces, some are without arms.
        """
        vertices, faces, steps = self.mesh.vertices, self.mesh.faces, self.vertex_index_steps
        arms = crosses(vertices, faces, self.directions, self.symmetry)
        shown = Shown(vertices, [faces], lines=arms, forth=vertices[steps > 0], back=vertices[steps < 0])
        return draw(shown, backend, show, file)


@takes(GUIDANCE, SOLVE, WATCH, TUNING)
def field(
    V: MeshLike,
    F: Optional[ArrayLike] = None,
    *,
    progress: Progress = None,
    cancel: Optional[CancelToken] = None,
    **keywords: Any,
) -> Field:
    """The smoothest orientation field of a mesh: a cross of four directions in every triangle.

    `V` and `F` are vertices and triangles; or `V` alone is a `Mesh`, the path of a mesh file, or a mesh of
    trimesh, pyvista, meshio, pymeshlab or openmesh: see `Mesh`. Every keyword may be left out. Then the
    field is one of crosses that follows the boundary. Of several requests for one face, a given direction
    comes first, then features and the boundary, then curvature.

    Raises an `Error` that names the face or vertex at fault, or the option.

    >>> import roundel
    >>> cube = roundel.Mesh.shape("rounded-cube", 600)
    >>> field = roundel.field(cube.vertices, cube.faces)
    >>> len(field.irregular), float(field.vertex_indices.sum())
    (8, 2.0)
    >>> gear = roundel.Mesh.shape("gear", 2000)
    >>> field = roundel.field(gear, features=40)        # edges at which the surface turns by 40 degrees
    >>> field.directions.shape == gear.faces.shape
    True
    """
    given, options = split(checked(field, keywords))
    mesh = as_mesh(V, F)
    guidance = guidance_handle(mesh, given)
    handle, watch = options_handle(options), Watch(progress, cancel)
    place = ffi.new("roundel_field **")
    call, of = lib.roundel_field_solve, mesh._handle.pointer
    with watch:
        status = call(of, pointer_of(guidance), handle.pointer, watch.pointer, place)
    return watch.result(status, lambda: Field(mesh, Handle("roundel_field", place[0]), guidance))
