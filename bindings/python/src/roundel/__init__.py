"""Mixed-integer quadratic problems of geometry processing.

    minimise   1/2 x'Qx + q'x + c + sum_k w_k (a_k . x - r_k)^2
    subject to C x = d, l_G <= G x <= u_G, l <= x <= u, x_i integer for i in I

`solve` solves a problem in matrices, `Problem` builds one part by part, and `Solver` solves one many
times. `quad` makes quads of a triangle mesh, `field` and `map` the steps to them, and `repair` a mesh of
a polygon soup; `BaseLayout` makes quads that follow a base layout. `geodesic_distance` measures along a mesh. Elements are counted from 0. Angles are in radians and counter-clockwise, except for the
angle of features, which is in degrees.

    vertices, quads = roundel.quad("part.stl", quads=2000, features=40)

`help` of each function lists its keywords with type, default and a sentence each. Failures are an `Error`
that names the element at fault. Ctrl-C raises `Interrupted`, a KeyboardInterrupt that keeps the best
result so far.
"""

from . import errors as _errors
from ._library import lib as _lib, text as _text
from .errors import *  # noqa: F403: one class for each status
from .attributes import Attributes, FaceNames
from .curves import Cut, curve_guides, cut_along
from .events import Event
from .field import Field, field
from .geodesic import GeodesicDistance, geodesic_distance
from .layout import BaseLayout
from .lazy_rows import Candidate
from .map import Map

# Not in __all__, because a star import must not hide Python's own name.
from .map import map as map
from .mesh import Mesh
from .options import Option, guidance_options, options, presets, quad_options, repair_options
from .problem import Problem
from .proof import Proof, check_proof
from .quads import Quads, extract, quad
from .repair import EditKind, Repair, Soup, repair
from .solution import Solution
from .solve import solve
from .solver import Solver
from .keywords import tidy as _tidy
from .watch import CancelToken, Interrupted

__version__: str = _text(_lib.roundel_version_string())

__all__ = [
    "Attributes",
    "BaseLayout",
    "CancelToken",
    "Candidate",
    "Cut",
    "EditKind",
    "Event",
    "FaceNames",
    "Field",
    "GeodesicDistance",
    "Interrupted",
    "Map",
    "Mesh",
    "Option",
    "Problem",
    "Proof",
    "Quads",
    "Repair",
    "Solution",
    "Solver",
    "Soup",
    "check_proof",
    "curve_guides",
    "cut_along",
    "extract",
    "field",
    "geodesic_distance",
    "guidance_options",
    "options",
    "presets",
    "quad",
    "quad_options",
    "repair",
    "repair_options",
    "solve",
    *_errors.__all__,
]

for _name in (*__all__, "map"):
    _tidy(globals()[_name])
