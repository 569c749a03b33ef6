"""Attributes of meshes, read from their files."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional

import numpy as np

from ._handle import Handle, number
from ._library import ffi, lib
from .arrays import pointer
from .errors import check


@dataclass(frozen=True)
class FaceNames:
    """A name for each face, such as that of its material.

    Attributes:

      names: list[str]
          All names.
      labels: np.ndarray
          The place of each face's name there, or -1: `Quads.transfer_face_labels` carries them to quads.
    """

    names: list[str]
    labels: np.ndarray


@dataclass(frozen=True)
class Attributes:
    """What a file says of a mesh beside its positions: what `Mesh.attributes` and `Repair.attributes` give.

    What the file does not say is None, or empty for scalars. Colours are red, green, blue and alpha from 0 to 1. NaN
    stands for none. The methods `transfer_...` of `Quads` carry these arrays to quads.

    >>> import roundel, tempfile, os
    >>> file = os.path.join(tempfile.mkdtemp(), "two.obj")
    >>> with open(file, "w") as out:
    ...     _ = out.write("v 0 0 0\\nv 1 0 0\\nv 1 1 0\\nv 0 1 0\\nusemtl a\\nf 1 2 3\\nusemtl b\\nf 1 3 4\\n")
    >>> found = roundel.Mesh.read(file).attributes(file)
    >>> found.materials.names, found.materials.labels.tolist(), found.uv
    (['a', 'b'], [0, 1], None)

    Attributes:

      materials: Optional[FaceNames]
          The material of each face.
      groups: Optional[FaceNames]
          The group of each face.
      face_colors: Optional[np.ndarray]
          The colour of each face, of shape (faces, 4).
      uv: Optional[np.ndarray]
          Texture coordinates of the corners of each face, of shape (faces, 3, 2).
      vertex_colors: Optional[np.ndarray]
          The colour of each vertex, of shape (vertices, 4).
      scalars: dict[str, np.ndarray]
          Numbers of vertices, by name.
    """

    materials: Optional[FaceNames]
    groups: Optional[FaceNames]
    face_colors: Optional[np.ndarray]
    uv: Optional[np.ndarray]
    vertex_colors: Optional[np.ndarray]
    scalars: dict[str, np.ndarray]


def of_handle(handle: Handle, vertices: int, faces: int) -> Attributes:
    """A copy of what the library has read for a mesh of this size."""
    all_of = handle.pointer

    def has(kind: bytes) -> bool:
        return bool(number(lib.roundel_attributes_has, all_of, kind, kind="int32_t"))

    def names(kind: bytes) -> list[str]:
        return [_name(all_of, kind, i) for i in range(number(lib.roundel_attributes_name_count, all_of, kind))]

    def face_names(kind: bytes) -> Optional[FaceNames]:
        if not has(kind):
            return None
        labels = np.empty(faces, dtype=np.int32)
        check(lib.roundel_attributes_labels(all_of, kind, pointer(labels), labels.size))
        return FaceNames(names(kind), labels)

    def values(kind: bytes, *shape: int) -> Optional[np.ndarray]:
        if not has(kind):
            return None
        found = np.empty(shape)
        check(lib.roundel_attributes_values(all_of, kind, pointer(found), found.size))
        return found

    scalars = {}
    for index, name in enumerate(names(b"scalars")):
        scalars[name] = np.empty(vertices)
        check(lib.roundel_attributes_scalar(all_of, index, pointer(scalars[name]), vertices))
    return Attributes(
        materials=face_names(b"materials"),
        groups=face_names(b"groups"),
        face_colors=values(b"face_colors", faces, 4),
        uv=values(b"uv", faces, 3, 2),
        vertex_colors=values(b"vertex_colors", vertices, 4),
        scalars=scalars,
    )


def _name(all_of: Any, kind: bytes, index: int) -> str:
    length = number(lib.roundel_attributes_name, all_of, kind, index, ffi.NULL, 0)
    buffer = ffi.new("char[]", length + 1)
    check(lib.roundel_attributes_name(all_of, kind, index, buffer, length + 1, ffi.NULL))
    return ffi.string(buffer).decode()
