"""What fields and maps follow."""

from __future__ import annotations

import math
from typing import Any, Mapping, Optional

import numpy as np

from ._handle import Handle
from ._library import lib, path
from .arrays import indices32, pointer, reals
from .errors import check
from .options import guidance_options, set_option

#: The options of the library's guidance, which `field`, `map` and `quad` take as keywords. Beside them
#: they take `features`: an angle in degrees, from which on an edge is sharp, or pairs of vertices
#: whose edges are; `curvature`: (constrain_curvature, curvature_weight) in one; `constraints`: (faces,
#: angles) that a field must have; `guides`: (faces, angles, weights) that it should have; `indices`:
#: (vertices, steps), all irregular vertices with their index in steps of 1/4; `guide_file`: a file of
#: guidance.
OPTIONS = guidance_options()


def split(keywords: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """The keywords of the guidance, and the others, which are options."""
    mine = {k: v for k, v in keywords.items() if k in _KEYWORDS and v is not None}
    return mine, {k: v for k, v in keywords.items() if k not in _KEYWORDS}


def guidance_handle(mesh: Any, given: Mapping[str, Any], of_quads: bool = False) -> Optional[Handle]:
    """The keywords as the library's guidance; None where there are none."""
    if not given:
        return None
    new = lib.roundel_guidance_new_for_quads if of_quads else lib.roundel_guidance_new
    handle = Handle.made("roundel_guidance", new)
    # Whoever says how curvature counts says all of it, and where indices are given it does not.
    if says_curvature(given) or "indices" in given:
        _curvature(handle.pointer, mesh, (0.0, 0.0))
    for name, value in given.items():
        if name in OPTIONS:
            set_option(handle.pointer, "guidance", name, value)
        else:
            _SETTERS[name](handle.pointer, mesh, value)
    return handle


def says_curvature(given: Mapping[str, Any]) -> bool:
    """Whether the keywords say how curvature counts."""
    return not given.keys().isdisjoint(("curvature", "constrain_curvature", "curvature_weight"))


def _features(guidance: Any, _mesh: Any, value: Any) -> None:
    if np.ndim(value) == 0:
        set_option(guidance, "guidance", "feature_angle", math.radians(float(value)))
        return
    pairs = indices32(value, "features", (-1, 2))
    check(lib.roundel_guidance_set_feature_lines(guidance, len(pairs), pointer(pairs)))


def _curvature(guidance: Any, _mesh: Any, value: Any) -> None:
    fraction, weight = value
    set_option(guidance, "guidance", "constrain_curvature", fraction)
    set_option(guidance, "guidance", "curvature_weight", weight)


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


def _guide_file(guidance: Any, mesh: Any, value: Any) -> None:
    check(lib.roundel_guidance_read(guidance, mesh._handle.pointer, path(value)))


def _same(*arrays: np.ndarray) -> None:
    if len({len(array) for array in arrays}) > 1:
        raise ValueError("arrays that belong together differ in length")


_SETTERS = {
    "features": _features,
    "curvature": _curvature,
    "constraints": _constraints,
    "guides": _guides,
    "indices": _indices,
    "guide_file": _guide_file,
}
_KEYWORDS = OPTIONS.keys() | _SETTERS.keys()
