"""Quad meshes from triangle meshes and from maps."""

from __future__ import annotations

from typing import Any, Iterator, Optional

import numpy as np

from . import packages
from ._groups import QUADS, SOLVE, TUNING, WATCH
from ._handle import Handle, number
from ._library import ffi, lib, path
from ._types import ArrayLike, File, MeshLike
from .arrays import indices32, pointer, reals
from .errors import ArgumentTypeError, check, refusal
from .events import Progress
from .guidance import GUIDANCE, guidance_handle, says_curvature, split
from .keywords import checked, takes
from .mesh import as_mesh, pointer_of
from .options import options_handle, set_option
from .plot import Shown, draw
from .watch import CancelToken, Watch


class Quads:
    """A mesh of quads and of the few other polygons that a map may give. Made by `quad`.

    It unpacks into vertices and quads: `vertices, quads = roundel.quad(V, F)`.
    """

    def __init__(self, handle: Handle) -> None:
        self._handle = handle

    def __iter__(self) -> Iterator[np.ndarray]:
        return iter((self.vertices, self.faces))

    def __repr__(self) -> str:
        others = len(self.others)
        told = [f"{len(self)} quads", f"{len(self.vertices)} vertices", f"{self.irregular_count} irregular"]
        told += [f"{others} other faces"] if others else []
        told.append("conforming" if self.conforming else "not conforming")
        quality = self.scaled_jacobians
        if len(quality):
            told.append(f"scaled Jacobian {quality.min():.2f} at least, {quality.mean():.2f} on average")
        return f"<Quads: {', '.join(told)}>"

    def __len__(self) -> int:
        """The number of quads."""
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
    def scaled_jacobians(self) -> np.ndarray:
        """The quality of every quad: 1 for a rectangle, 0 or less for one that is inverted.

        It is the least over its corners of the sine of the angle.
        """
        corners = self.vertices[self.faces]
        normals = _unit(np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]))
        forth = _unit(np.roll(corners, -1, axis=1) - corners)
        back = _unit(np.roll(corners, 1, axis=1) - corners)
        return (np.cross(forth, back) * normals[:, None]).sum(axis=2).min(axis=1, initial=1.0)

    @property
    def irregular_count(self) -> int:
        """The number of vertices with other than four edges, or other than three on the boundary."""
        return number(lib.roundel_quads_irregular_count, self._handle.pointer)

    @property
    def near_feature_count(self) -> int:
        """The number of irregular vertices of the field that lie nearer to features than they should.

        That is nearer than an edge of the quads, or than `clearance`, but not on them. Quads that were extracted from a
        map raise an `InvalidArgumentError`: nobody looked for features.
        """
        return number(lib.roundel_quads_near_feature_count, self._handle.pointer)

    @property
    def paired_face_count(self) -> int:
        """The number of triangles of the mesh whose quads are pairs of them.

        No map had quads that conform and cover the surface there. It is 0 where all quads are those of a map.
        """
        return number(lib.roundel_quads_paired_face_count, self._handle.pointer)

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

    @takes(GUIDANCE.only("features", "feature_angle", "align_boundary", "guide_file"))
    def smooth(self, mesh: MeshLike, **keywords: Any) -> None:
        """Moves the vertices on `mesh` to make the quads more like squares of one size.

        Vertices on features and on the boundary slide along them. The keywords say what is a feature.

        >>> import roundel
        >>> cube = roundel.Mesh.shape("rounded-cube", 600)
        >>> quads = roundel.map(cube, quads=100).quads()
        >>> before = quads.scaled_jacobians.mean()
        >>> quads.smooth(cube)
        >>> bool(quads.scaled_jacobians.mean() > before)
        True
        """
        given = checked(Quads.smooth, keywords)
        surface = as_mesh(mesh)
        guidance = guidance_handle(surface, given)
        arguments = (surface._handle.pointer, pointer_of(guidance), ffi.NULL)
        check(lib.roundel_quads_smooth(self._handle.pointer, *arguments))

    def transfer_face_labels(self, mesh: MeshLike, labels: ArrayLike) -> np.ndarray:
        """The label of most of the area of `mesh` beneath each face: the quads, then the other faces.

        `labels` has a number for each face of the mesh, such as that of a material, from 0 on; -1 stands for none.

        >>> import roundel
        >>> cube = roundel.Mesh.shape("rounded-cube", 600)
        >>> quads = roundel.quad(cube, quads=100)
        >>> is_left = cube.vertices[cube.faces].mean(axis=1)[:, 0] < 0
        >>> labels = quads.transfer_face_labels(cube, is_left.astype(int))
        >>> len(labels) == len(quads) and set(labels.tolist()) == {0, 1}
        True
        """
        given = indices32(labels, "labels")
        surface = as_mesh(mesh)
        found = np.empty(len(self) + len(self.others), dtype=np.int32)
        arguments = (pointer(given), given.size, ffi.NULL, pointer(found), found.size)
        check(
            lib.roundel_quads_transfer_face_labels(
                self._handle.pointer, surface._handle.pointer, *arguments
            )
        )
        return found

    def transfer_vertex_values(self, mesh: MeshLike, values: ArrayLike) -> np.ndarray:
        """Numbers at every vertex, interpolated at the closest point of `mesh`.

        `values` has a number for each vertex of the mesh, or a row of numbers, such as a colour. NaN stands for none.

        >>> import roundel
        >>> cube = roundel.Mesh.shape("rounded-cube", 600)
        >>> quads = roundel.quad(cube, quads=100)
        >>> points = quads.transfer_vertex_values(cube, cube.vertices)
        >>> bool(abs(points - quads.vertices).max() < 1e-12)
        True
        """
        call = lib.roundel_quads_transfer_vertex_values
        return self._carried(call, mesh, values, "values", 1, len(self.vertices))

    def transfer_corner_values(self, mesh: MeshLike, values: ArrayLike) -> np.ndarray:
        """Numbers at the four corners of every quad, such as texture coordinates.

        `values` is of shape (faces, 3) or (faces, 3, k), for the corners of the faces of `mesh`. The result is of shape
        (quads, 4) or (quads, 4, k); where there are other faces, all corners come one after the other, first those of
        the quads: (corners,) or (corners, k). An edge whose faces have other values at one of its ends is a seam, and a
        quad has values of one side of it. NaN stands for none.

        >>> import roundel
        >>> cube = roundel.Mesh.shape("rounded-cube", 600)
        >>> quads = roundel.quad(cube, quads=100)
        >>> uvs = quads.transfer_corner_values(cube, cube.vertices[cube.faces][:, :, :2])
        >>> uvs.shape == (len(quads), 4, 2)
        True
        """
        others = self.others
        count = 4 * len(self) + sum(map(len, others))
        call = lib.roundel_quads_transfer_corner_values
        found = self._carried(call, mesh, values, "values", 2, count)
        return found if others else found.reshape(len(self), 4, *found.shape[1:])

    def _carried(
        self, call: Any, mesh: MeshLike, values: ArrayLike, what: str, depth: int, count: int
    ) -> np.ndarray:
        """Numbers of `count` elements. Those of the mesh are counted by the first `depth` axes of `values`."""
        deep = np.ndim(values) > depth
        shape = (-1, 3)[:depth] + (-1,) * deep
        given = reals(values, what, shape)
        components = given.shape[-1] if deep else 1
        surface = as_mesh(mesh)
        found = np.empty((count, components))
        arguments = (components, pointer(given), given.size, ffi.NULL, pointer(found), found.size)
        check(call(self._handle.pointer, surface._handle.pointer, *arguments))
        return found if deep else found[:, 0]

    def write(self, file: File) -> None:
        """Writes the faces as OBJ, OFF, PLY or USD text, by extension; as STL or glTF, triangles."""
        check(lib.roundel_quads_write(self._handle.pointer, path(file)))

    def to_trimesh(self) -> Any:
        """The faces split into triangles, as a `trimesh.Trimesh`, which has no quads.

        Quads are split along their shorter diagonal. Vertices keep their numbers.
        """
        points, quads = self.vertices, self.faces
        across = np.linalg.norm(points[quads[:, 2]] - points[quads[:, 0]], axis=1)
        other = np.linalg.norm(points[quads[:, 3]] - points[quads[:, 1]], axis=1)
        turned = np.where((across <= other)[:, None], quads, np.roll(quads, -1, axis=1))
        fans = [turned[:, [0, 1, 2]], turned[:, [0, 2, 3]]]
        for face in self.others:
            fans.append(np.array([[face[0], *pair] for pair in zip(face[1:-1], face[2:])]).reshape(-1, 3))
        return packages.to_trimesh(points, np.concatenate(fans))

    def to_pyvista(self) -> Any:
        """The faces as a `pyvista.PolyData`, with `scaled_jacobian` a face: NaN if it is no quad."""
        return packages.to_pyvista(self.vertices, *self._polygons())

    def to_meshio(self) -> Any:
        """The faces as a `meshio.Mesh`, with `scaled_jacobian` a face: NaN if it is no quad."""
        return packages.to_meshio(self.vertices, *self._polygons())

    def _polygons(self) -> tuple[list[np.ndarray], dict[str, np.ndarray], dict[str, np.ndarray]]:
        """The faces by their number of corners, and numbers of vertices and of faces."""
        blocks, others = [self.faces], self.others
        for size in sorted({len(face) for face in others}):
            blocks.append(np.stack([face for face in others if len(face) == size]))
        quality = np.concatenate([self.scaled_jacobians, np.full(len(others), np.nan)])
        return blocks, {}, {"scaled_jacobian": quality}

    def plot(
        self, *, backend: Optional[str] = None, show: bool = True, file: Optional[File] = None
    ) -> Any:
        """Draws the quads, coloured by their scaled Jacobians.

        `backend` is "pyvista", which can be turned with the mouse, or "matplotlib"; by default, the first
        of them that is installed. `file` names a picture to write (PNG). With `show=False` no window is
        opened. Returns pyvista's plotter or matplotlib's axes.
        """
        blocks, _, numbers = self._polygons()
        quality = numbers["scaled_jacobian"]
        shown = Shown(self.vertices, blocks, edges=True, values=quality, label="scaled Jacobian")
        return draw(shown, backend, show, file)


def _unit(vectors: np.ndarray) -> np.ndarray:
    lengths = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(lengths > 0, lengths, 1)


def one_size(quads: Any, edge_length: Any) -> None:
    """Refuses a number of quads beside a length of their edges."""
    if quads is not None and edge_length is not None:
        raise refusal(ArgumentTypeError, "quads and edge_length are two ways to say one thing")


def lengths_of_faces(given: Any) -> np.ndarray:
    """Two lengths for each face, where one or two are given."""
    lengths = np.asarray(given)
    if lengths.ndim == 1:
        lengths = np.stack([lengths, lengths], axis=1)
    return reals(lengths, "edge_length", (-1, 2))


def extracted(map_: Handle) -> Quads:
    """The quads of a map's last solve."""
    return Quads(Handle.made("roundel_quads", lib.roundel_quads_extract, map_.pointer))


def extract(V: MeshLike, F: Optional[ArrayLike] = None, uvs: Optional[ArrayLike] = None) -> Quads:
    """The quads of any integer-grid map, such as one of another program. They are not smoothed.

    `V` and `F` are vertices and triangles; or `V` alone is a `Mesh`, the path of a mesh file, or a mesh of
    another package. `uvs` has u and v of the three corners of every triangle, of shape (faces, 3, 2). It is
    needed. Triangles that are flipped are coped with.

    >>> import roundel
    >>> mesh = roundel.Mesh.shape("plane", 200)
    >>> flat = mesh.vertices[mesh.faces][:, :, :2]
    >>> uvs = 4 * (flat - flat.min(axis=(0, 1)))
    >>> len(roundel.extract(mesh.vertices, mesh.faces, uvs)) > 0
    True
    >>> len(roundel.extract(mesh, uvs=uvs)) > 0
    True
    """
    if uvs is None:
        raise refusal(ArgumentTypeError, "uvs, the coordinates of the corners, must be given")
    mesh = as_mesh(V, F)
    given = reals(uvs, "uvs", (-1, 3, 2))
    arguments = (mesh._handle.pointer, pointer(given), given.size)
    return Quads(Handle.made("roundel_quads", lib.roundel_quads_extract_from_uvs, *arguments))


_UNSAID = " None: {} at first; fields with less are tried as well (see vary_curvature)."
_CURVATURE = {"constrain_curvature": 0.005, "curvature_weight": 0.07}
_DETAIL = (
    "Details smaller than this length attract no irregular vertices. None: a quarter of an edge of the quads."
)
_OF_QUADS = GUIDANCE.but(
    detail={"text": _DETAIL},
    **{
        k.name: {
            "type": "Optional[float]",
            "default": None,
            "text": k.text + _UNSAID.format(_CURVATURE[k.name]),
        }
        for k in GUIDANCE.only(*_CURVATURE).keywords
    },
)


@takes(QUADS, _OF_QUADS, SOLVE.but(strategy={"default": "lattice"}), WATCH, TUNING)
def quad(
    V: MeshLike,
    F: Optional[ArrayLike] = None,
    *,
    progress: Progress = None,
    cancel: Optional[CancelToken] = None,
    **keywords: Any,
) -> Quads:
    """Makes quads of a triangle mesh: field, map, extraction and smoothing in one call.

    `V` and `F` are vertices and triangles; or `V` alone is a `Mesh`, the path of a mesh file, or a mesh of
    trimesh, pyvista, meshio, pymeshlab or openmesh: see `Mesh`. Every keyword may be left out: then there
    are about 1000 quads, which follow the boundary and, where it is clear, the curvature. `features=40`
    makes the edges of a machine part edges of quads.

    The result unpacks into vertices and quads, and its `conforming` tells whether there is nothing but
    quads, closed where the triangles are. The quads are those of the program `roundel quad`. Options of the
    solve hold for the map and the field, but for the strategy: that of the field is `field_strategy`.

    Raises an `Error` that names the face or vertex at fault, or the option.

    >>> import roundel
    >>> cube = roundel.Mesh.shape("rounded-cube", 600)
    >>> vertices, quads = found = roundel.quad(cube.vertices, cube.faces, quads=100)
    >>> found.conforming, len(vertices) - len(quads)
    (True, 2)
    >>> half = roundel.quad(cube, quads=100, mirror="x")
    >>> left, right = (half.vertices[half.vertices[:, 0] * side > 0] for side in (-1, 1))
    >>> sorted(map(tuple, left * [-1, 1, 1])) == sorted(map(tuple, right))
    True
    >>> gear = roundel.Mesh.shape("gear", 1500)
    >>> sharp = roundel.quad(gear, quads=400, features=40)
    >>> sharp.conforming
    True
    """
    keywords = checked(quad, keywords)
    own = {name: keywords.pop(name) for name in QUADS.names() & keywords.keys()}
    length = own.get("edge_length")
    one_size(own.get("quads"), length)
    mesh = as_mesh(V, F)
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
    if length is not None and np.ndim(length) > 0:
        lengths = lengths_of_faces(own.pop("edge_length"))
        check(lib.roundel_quad_options_set_edge_lengths(how.pointer, pointer(lengths), lengths.size))
    mirror = own.pop("mirror", None) or []
    for plane in [mirror] if isinstance(mirror, str) else mirror:
        word = plane if isinstance(plane, str) else ",".join(repr(float(x)) for x in plane)
        check(lib.roundel_quad_options_add_mirror(how.pointer, word.encode()))
    density, near = own.pop("density", None), own.pop("near_vertices", None)
    if density is not None:
        dense = reals(density, "density")
        check(lib.roundel_quad_options_set_density(how.pointer, pointer(dense), dense.size))
    if near is not None:
        near = indices32(near, "near_vertices")
        check(lib.roundel_quad_options_set_near_vertices(how.pointer, near.size, pointer(near)))
    for name, value in own.items():
        set_option(how.pointer, "quad_options", name, value)
    watch = Watch(progress, cancel)
    place = ffi.new("roundel_quads **")
    with watch:
        status = lib.roundel_quads_make(mesh._handle.pointer, how.pointer, watch.pointer, place)
    return watch.result(status, lambda: Quads(Handle("roundel_quads", place[0])))
