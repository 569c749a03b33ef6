"""Exact geodesic distances on triangle meshes."""

from __future__ import annotations

from typing import Any, Iterable, Optional, Sequence

import numpy as np

from ._handle import Handle, number
from ._library import ffi, lib
from ._types import ArrayLike, MeshLike
from .arrays import indices32, pointer, real, reals
from .errors import LengthMismatchError, check, refusal
from .mesh import Mesh, as_mesh


class GeodesicDistance:
    """The exact distance along a mesh of every vertex from the nearest source. Made by `geodesic_distance`."""

    def __init__(self, mesh: Mesh, handle: Handle) -> None:
        #: The mesh.
        self.mesh = mesh
        self._handle = handle

    def __repr__(self) -> str:
        distances = self.distances
        reached = distances[np.isfinite(distances)]
        return f"<GeodesicDistance: {len(reached)} of {len(distances)} vertices, up to {reached.max():.6g}>"

    @property
    def distances(self) -> np.ndarray:
        """The distance of every vertex; infinite beyond the limit and where no source can be reached."""
        found = np.empty(self._count())
        check(lib.roundel_geodesic_distances(self._handle.pointer, pointer(found), len(found)))
        return found

    @property
    def nearest_sources(self) -> np.ndarray:
        """The number of the nearest source of every vertex; -1 where the distance is infinite."""
        found = np.empty(self._count(), dtype=np.int32)
        check(lib.roundel_geodesic_nearest_sources(self._handle.pointer, pointer(found), len(found)))
        return found

    def at(self, faces: ArrayLike, barycentric: ArrayLike) -> np.ndarray:
        """The distances of points: a face each, and the weights of its corners, of shape (points, 3).

        Points other than vertices need `everywhere=True` of `geodesic_distance`.
        """
        number_of, weights = _points(faces, barycentric)
        found = np.empty(len(number_of))
        self._ask(lib.roundel_geodesic_distances_at, number_of, weights, found)
        return found

    def gradients(self, faces: ArrayLike, barycentric: ArrayLike) -> np.ndarray:
        """The gradients at points, given as for `at`: unit vectors in the planes of faces, of shape (points, 3).

        They are null on the sources and where the distance is infinite.
        """
        number_of, weights = _points(faces, barycentric)
        found = np.empty((len(number_of), 3))
        self._ask(lib.roundel_geodesic_gradients_at, number_of, weights, found)
        return found

    def path(self, face: int, barycentric: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
        """A shortest path from a point to the nearest source: the faces and the barycentric coordinates of its
        points, of which those that follow each other lie on a common face. It is empty where the distance is
        infinite. It is a polyline for `geodesic_distance`.
        """
        faces, weights = _points([face], [barycentric])
        given = (self._handle.pointer, self.mesh._handle.pointer, int(faces[0]), pointer(weights))
        size = number(lib.roundel_geodesic_path, *given, 0, ffi.NULL, ffi.NULL)
        path, along = np.empty(size, dtype=np.int32), np.empty((size, 3))
        if size > 0:
            number(lib.roundel_geodesic_path, *given, size, pointer(path), pointer(along))
        return path, along

    def path_from_vertex(self, vertex: int) -> np.ndarray:
        """The positions along a shortest path from a vertex to the nearest source, of shape (points, 3)."""
        corners = self.mesh.faces
        face, corner = np.argwhere(corners == vertex)[0]
        faces, weights = self.path(int(face), np.eye(3)[corner])
        return np.einsum("ij,ijk->ik", weights, self.mesh.vertices[corners[faces]])

    def _count(self) -> int:
        found: int = number(lib.roundel_mesh_vertex_count, self.mesh._handle.pointer)
        return found

    def _ask(self, call: Any, faces: np.ndarray, weights: np.ndarray, found: np.ndarray) -> None:
        handles = (self._handle.pointer, self.mesh._handle.pointer)
        check(call(*handles, len(faces), pointer(faces), pointer(weights), pointer(found)))


def geodesic_distance(
    V: MeshLike,
    F: Optional[ArrayLike] = None,
    *,
    vertices: ArrayLike = (),
    points: Optional[tuple[ArrayLike, ArrayLike]] = None,
    polylines: Iterable[Sequence[Any]] = (),
    edges: Iterable[ArrayLike] = (),
    boundary: bool = False,
    limit: float = float("inf"),
    everywhere: bool = False,
) -> GeodesicDistance:
    """The exact distance along a mesh from the nearest of some sources.

    Sources are numbered in this order: each of `vertices`; each of `points`, which are a pair of faces and
    barycentric coordinates; each of `polylines`, which are pairs like that, or have a third entry that tells
    whether they are closed; each set of `edges`; with `boundary` each loop of the boundary. Points of a
    polyline that follow each other lie on a common face. Distances above `limit` are infinite. With
    `everywhere`, distances, gradients and paths can be asked for at any point, which takes more memory.

    An `Error` names the source that is not on the mesh as its `index`.

    >>> import roundel
    >>> plane = roundel.Mesh.shape("plane", 200)
    >>> roundel.geodesic_distance(plane, boundary=True)
    <GeodesicDistance: 121 of 121 vertices, up to 1>
    """
    mesh = as_mesh(V, F)
    sources = Handle.made("roundel_sources", lib.roundel_sources_new)
    named = indices32(vertices, "vertices")
    check(lib.roundel_sources_add_vertices(sources.pointer, len(named), pointer(named)))
    if points is not None:
        faces, weights = _points(*points)
        check(lib.roundel_sources_add_points(sources.pointer, len(faces), pointer(faces), pointer(weights)))
    for line in polylines:
        faces, weights = _points(line[0], line[1])
        closed = int(bool(line[2])) if len(line) > 2 else 0
        given = (len(faces), pointer(faces), pointer(weights), closed)
        check(lib.roundel_sources_add_polyline(sources.pointer, *given))
    for chain in edges:
        named = indices32(chain, "edges")
        check(lib.roundel_sources_add_edges(sources.pointer, len(named), pointer(named)))
    if boundary:
        check(lib.roundel_sources_add_boundary(sources.pointer, mesh._handle.pointer))
    arguments = (mesh._handle.pointer, sources.pointer, real(limit, "limit"), int(bool(everywhere)), ffi.NULL)
    return GeodesicDistance(mesh, Handle.made("roundel_geodesic", lib.roundel_geodesic_new, *arguments))


def _points(faces: Any, barycentric: Any) -> tuple[np.ndarray, np.ndarray]:
    named, weights = indices32(faces, "faces"), reals(barycentric, "barycentric", (-1, 3))
    if len(named) != len(weights):
        raise refusal(LengthMismatchError, f"{len(named)} faces, but {len(weights)} barycentric coordinates")
    return named, weights
