"""What fields and maps follow."""

from __future__ import annotations

import math
from typing import Any, Mapping, Optional

import numpy as np

from ._handle import Handle
from ._library import lib, path
from .arrays import indices32, pointer, real, reals
from .errors import ArgumentTypeError, LengthMismatchError, check, refusal
from .keywords import Group, Keyword, of_table
from .options import guidance_options, set_option

#: The options of the library's guidance.
OPTIONS = guidance_options()

#: The keywords of what `field`, `map` and `quad` follow: the options of the library and those below.
GUIDANCE = Group(
    "What to follow",
    (
        Keyword(
            "features",
            "Union[float, ArrayLike, None]",
            None,
            "The sharp edges: an angle in degrees, and edges at which the surface turns by it or more are "
            "sharp; or an array of pairs of vertices, one pair for each edge, of shape (edges, 2).",
        ),
        Keyword(
            "curvature",
            "Optional[tuple[float, float]]",
            None,
            "constrain_curvature and curvature_weight, which see below, in one.",
        ),
        Keyword(
            "constraints",
            "Optional[tuple[ArrayLike, ArrayLike]]",
            None,
            "Directions that faces must have: (faces, angles), in radians, counter-clockwise from the "
            "face's first edge.",
        ),
        Keyword(
            "guides",
            "Optional[tuple[ArrayLike, ArrayLike, ArrayLike]]",
            None,
            "Directions that faces should have: (faces, angles, weights), angles as those of constraints.",
        ),
        Keyword(
            "indices",
            "Optional[tuple[ArrayLike, ArrayLike]]",
            None,
            "All irregular vertices: (vertices, steps), an index in steps of 1/symmetry of a turn for each; "
            "1 at the corner of a cube. With the boundary loops', they must sum to the Euler characteristic.",
        ),
        Keyword(
            "guide_file",
            "Optional[File]",
            None,
            "A text file of what to follow, one request a line, elements counted from 0: `direction FACE X Y Z "
            "[WEIGHT]` is a guide, or a constraint without a weight; `edge VERTEX VERTEX` is a feature; "
            "`index VERTEX STEPS` is an irregular vertex.",
        ),
        *of_table(OPTIONS),
    ),
).but(
    detail={"text": "Details smaller than this length attract no irregular vertices. None: all details count."},
    feature_angle={"text": "As features with one angle, but in radians."},
)


def split(keywords: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """The keywords of the guidance, and the others, which are options."""
    mine = {k: v for k, v in keywords.items() if k in _KEYWORDS}
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
        set_option(guidance, "guidance", "feature_angle", math.radians(real(value, "features")))
        return
    pairs = indices32(value, "features", (-1, 2))
    check(lib.roundel_guidance_set_feature_lines(guidance, len(pairs), pointer(pairs)))


def _curvature(guidance: Any, _mesh: Any, value: Any) -> None:
    fraction, weight = _parts(value, "curvature", "constrain_curvature", "curvature_weight")
    set_option(guidance, "guidance", "constrain_curvature", fraction)
    set_option(guidance, "guidance", "curvature_weight", weight)


def _constraints(guidance: Any, _mesh: Any, value: Any) -> None:
    of, turned = _parts(value, "constraints", "faces", "angles")
    faces, angles = indices32(of, "constraints"), reals(turned, "constraints")
    _same("constraints", faces, angles)
    call = lib.roundel_guidance_set_constraints
    check(call(guidance, len(faces), pointer(faces), pointer(angles)))


def _guides(guidance: Any, _mesh: Any, value: Any) -> None:
    of, turned, weighed = _parts(value, "guides", "faces", "angles", "weights")
    faces, angles, weights = indices32(of, "guides"), reals(turned, "guides"), reals(weighed, "guides")
    _same("guides", faces, angles, weights)
    call = lib.roundel_guidance_set_guides
    check(call(guidance, len(faces), pointer(faces), pointer(angles), pointer(weights)))


def _indices(guidance: Any, _mesh: Any, value: Any) -> None:
    at, turns = _parts(value, "indices", "vertices", "steps")
    vertices, steps = indices32(at, "indices"), indices32(turns, "indices")
    _same("indices", vertices, steps)
    call = lib.roundel_guidance_set_indices
    check(call(guidance, len(vertices), pointer(vertices), pointer(steps)))


def _guide_file(guidance: Any, mesh: Any, value: Any) -> None:
    check(lib.roundel_guidance_read(guidance, mesh._handle.pointer, path(value)))


def _parts(value: Any, what: str, *names: str) -> tuple[Any, ...]:
    """The parts of a keyword that takes several things in one."""
    try:
        parts = tuple(value)
    except TypeError:
        parts = ()
    if len(parts) != len(names):
        raise refusal(ArgumentTypeError, f"{what} should be ({', '.join(names)}), and is {value!r}")
    return parts


def _same(what: str, *arrays: np.ndarray) -> None:
    if len({len(array) for array in arrays}) > 1:
        lengths = ", ".join(str(len(array)) for array in arrays)
        raise refusal(LengthMismatchError, f"{what}: the arrays should have one length, and have {lengths}")


_SETTERS = {
    "features": _features,
    "curvature": _curvature,
    "constraints": _constraints,
    "guides": _guides,
    "indices": _indices,
    "guide_file": _guide_file,
}
_KEYWORDS = OPTIONS.keys() | _SETTERS.keys()
