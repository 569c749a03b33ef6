"""What fields and maps shall follow."""

from __future__ import annotations

import math
from typing import Any, Mapping, Optional

import numpy as np

from ._library import Handle, lib, path
from .arrays import indices32, pointer, reals
from .errors import check

#: The keywords that `field`, `map` and `quad` take beside the library's options:
#:
#: `features`: an angle in degrees, from which on an edge is sharp, or pairs of vertices whose edges
#: are; `align_boundary`: whether the boundary is a feature (True); `curvature`: (fraction, weight),
#: the part of the faces that have the direction of least curvature, and how strongly all others are
#: drawn to it; `constraints`: (faces, angles) that a field must have; `guides`: (faces, angles,
#: weights) that it should have; `indices`: (vertices, steps), all irregular vertices with their index
#: in steps of 1/4; `symmetry`: arms of the field, 1, 2, 4 or 6; `detail`: the length of details that
#: attract no irregular vertices; `guide_file`: a text file with such guidance.
KEYWORDS = (
    "features",
    "align_boundary",
    "curvature",
    "constraints",
    "guides",
    "indices",
    "symmetry",
    "detail",
    "guide_file",
)


def split(keywords: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """The keywords of the guidance, and the others, which are options."""
    mine = {k: v for k, v in keywords.items() if k in KEYWORDS and v is not None}
    return mine, {k: v for k, v in keywords.items() if k not in KEYWORDS}


def guidance_handle(mesh: Any, given: Mapping[str, Any]) -> Optional[Handle]:
    """The keywords as the library's guidance; None where there are none."""
    if not given:
        return None
    handle = Handle.made("roundel_guidance", lib.roundel_guidance_new)
    for name, value in given.items():
        _SETTERS[name](handle.pointer, mesh, value)
    return handle


def _features(guidance: Any, _mesh: Any, value: Any) -> None:
    if np.ndim(value) == 0:
        check(lib.roundel_guidance_set_feature_angle(guidance, math.radians(float(value))))
        return
    pairs = indices32(value, "features", (-1, 2))
    check(lib.roundel_guidance_set_feature_lines(guidance, len(pairs), pointer(pairs)))


def _align_boundary(guidance: Any, _mesh: Any, value: Any) -> None:
    check(lib.roundel_guidance_set_align_boundary(guidance, int(bool(value))))


def _curvature(guidance: Any, _mesh: Any, value: Any) -> None:
    fraction, weight = value
    check(lib.roundel_guidance_set_curvature(guidance, fraction, weight))


def _constraints(guidance: Any, _mesh: Any, value: Any) -> None:
    faces, angles = indices32(value[0], "constraints"), reals(value[1], "constraints")
    _same(faces, angles)
    call = lib.roundel_guidance_set_constraints
    check(call(guidance, len(faces), pointer(faces), pointer(angles)))


def _guides(guidance: Any, _mesh: Any, value: Any) -> None:
    faces = indices32(value[0], "guides")
    angles, weights = reals(value[1], "guides"), reals(value[2], "guides")
    _same(faces, angles, weights)
    call = lib.roundel_guidance_set_guides
    check(call(guidance, len(faces), pointer(faces), pointer(angles), pointer(weights)))


def _indices(guidance: Any, _mesh: Any, value: Any) -> None:
    vertices, steps = indices32(value[0], "indices"), indices32(value[1], "indices")
    _same(vertices, steps)
    call = lib.roundel_guidance_set_indices
    check(call(guidance, len(vertices), pointer(vertices), pointer(steps)))


def _symmetry(guidance: Any, _mesh: Any, value: Any) -> None:
    check(lib.roundel_guidance_set_symmetry(guidance, value))


def _detail(guidance: Any, _mesh: Any, value: Any) -> None:
    check(lib.roundel_guidance_set_detail(guidance, float(value)))


def _guide_file(guidance: Any, mesh: Any, value: Any) -> None:
    check(lib.roundel_guidance_read(guidance, mesh._handle.pointer, path(value)))


def _same(*arrays: np.ndarray) -> None:
    if len({len(array) for array in arrays}) > 1:
        raise ValueError("arrays that belong together differ in length")


_SETTERS = {name: globals()[f"_{name}"] for name in KEYWORDS}
