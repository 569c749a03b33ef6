"""Curves in space, drawn onto triangle meshes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Iterable

import numpy as np

from ._handle import Handle, number
from ._library import ffi, lib
from ._types import ArrayLike, MeshLike
from .arrays import pointer, real, reals
from .errors import check
from .mesh import Mesh, as_mesh


@dataclass(frozen=True)
class Cut:
    """A mesh that was cut along curves. Made by `cut_along`."""

    #: The mesh. Its first vertices are those of the mesh that was given.
    mesh: Mesh
    #: The face of the given mesh of which each face is a part.
    face_origins: np.ndarray
    #: The edges along curves by their two vertices, of shape (edges, 2): they may be `features`.
    edges: np.ndarray


def curve_guides(
    mesh: MeshLike, curves: Iterable[ArrayLike], *, weight: float = 10.0, symmetry: int = 4
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Guides along curves, for `guides` of `field`, `map` and `quad`: faces, angles and weights.

    A curve is an array of points in space, of shape (points, 3). It is drawn onto the mesh through their closest
    points, along shortest paths; it is closed if the last point is the first. The weight of a face is `weight` times
    the length of the curves inside it over the square root of its area. `symmetry` is that of the field.

    An `Error` names the point that is too far from the surface as its `index`.
    """
    surface = as_mesh(mesh)
    drawn = _drawn(surface, curves)
    given = (drawn.pointer, surface._handle.pointer, symmetry, real(weight, "weight"))
    size = number(lib.roundel_curves_guides, *given, 0, ffi.NULL, ffi.NULL, ffi.NULL)
    faces, angles, weights = np.empty(size, dtype=np.int32), np.empty(size), np.empty(size)
    if size > 0:
        number(lib.roundel_curves_guides, *given, size, pointer(faces), pointer(angles), pointer(weights))
    return faces, angles, weights


def cut_along(mesh: MeshLike, curves: Iterable[ArrayLike]) -> Cut:
    """Cuts the faces of a mesh along curves, given as for `curve_guides`, so that they are chains of edges.

    As `features` they become chains of edges of the quads, and closed ones edge loops.

    >>> import numpy as np, roundel
    >>> cut = roundel.cut_along(roundel.Mesh.shape("plane", 200), [[[-0.7, -0.5, 0], [0.6, 0.4, 0]]])
    >>> len(cut.mesh.faces) > 200
    True
    """
    surface = as_mesh(mesh)
    drawn = _drawn(surface, curves)
    handle = Handle.made("roundel_cut", lib.roundel_cut_new, surface._handle.pointer, drawn.pointer)
    made = Mesh._of(Handle.made("roundel_mesh", lib.roundel_cut_mesh, handle.pointer))
    origins = np.empty(len(made.faces), dtype=np.int32)
    check(lib.roundel_cut_face_origins(handle.pointer, pointer(origins), len(origins)))
    marks = np.empty(len(made.edge_faces), dtype=np.int32)
    check(lib.roundel_cut_mark_curves(handle.pointer, pointer(marks), len(marks)))
    ends = np.empty((marks.size, 2), dtype=np.int32)
    ends[made.face_edges] = np.stack([made.faces, np.roll(made.faces, -1, axis=1)], axis=2)
    return Cut(made, origins, ends[marks != 0])


def _drawn(mesh: Mesh, curves: Iterable[ArrayLike]) -> Handle:
    drawn = Handle.made("roundel_curves", lib.roundel_curves_new)
    for curve in curves:
        points = reals(curve, "points of a curve", (-1, 3))
        check(lib.roundel_curves_draw(drawn.pointer, mesh._handle.pointer, len(points), pointer(points), ffi.NULL))
    return drawn
