"""Groups of keywords that several functions take."""

from __future__ import annotations

from .keywords import Group, Keyword, of_table
from .options import options, presets, quad_options, repair_options

_PRESETS = presets()

_STRATEGIES = (
    "How integers are decided: 'relax', not at all: they stay real; 'direct', rounded at once; 'greedy', "
    "one by one, the rest solved anew each time; 'adaptive' and 'multiple', the same with less work; "
    "'lattice', as a close point of a lattice, best for maps; 'exact', with a proof that nothing is "
    "better, if time allows; 'auto', by what suits the problem."
)

_PRESET = Keyword(
    "preset",
    f"Optional[Literal[{', '.join(repr(name) for name in _PRESETS)}]]",
    None,
    "Sets several options at once; a keyword that is given too takes precedence. One of "
    + "; ".join(f"{name!r}, {text}" for name, text in _PRESETS.items())
    + ".",
)

_ALL = Group("How it is solved", (*of_table(options()), _PRESET)).but(strategy={"text": _STRATEGIES})
_USUAL = ("strategy", "time_limit", "gap", "threads", "preset")

#: The options of a solve that many callers want.
SOLVE = _ALL.only(*_USUAL)

#: The options of single strategies, for experts.
TUNING = Group(
    "For experts (where a text begins with names of strategies, only these use the option)",
    _ALL.without(*_USUAL).keywords,
)

#: Progress and its end.
WATCH = Group(
    "Watching it",
    (
        Keyword(
            "progress",
            "Progress",
            None,
            "True for a line on stderr (a bar of tqdm if it is installed), or a function that is called "
            "with an `Event`: if it returns something true, the best result so far is returned.",
        ),
        Keyword(
            "cancel",
            "Optional[CancelToken]",
            None,
            "A token by which another thread ends the call; the best result so far is returned. Ctrl-C "
            "raises `Interrupted`, a KeyboardInterrupt whose `incumbent` is the best result so far.",
        ),
    ),
)

_LENGTHS = (
    "The length of the edges of quads, in units of the mesh, instead of their number; or lengths for each "
    "face, one or two of them: along the field's arm and across it."
)

#: The size of quads and the remedies of a map.
SIZE = Group(
    "The size of the quads",
    (
        Keyword("quads", "Optional[int]", None, "The approximate number of quads; 1000 if nothing is said."),
        Keyword("edge_length", "Union[float, ArrayLike, None]", None, _LENGTHS),
        Keyword(
            "untangle",
            "bool",
            True,
            "If true, free the map of folds: integers that collapse cones are decided anew, flipped "
            "triangles are turned back, and the map is refined if some remain.",
        ),
        Keyword(
            "stiffenings",
            "int",
            5,
            "How often untangling solves again with more weight around folded triangles, before it moves "
            "vertices.",
        ),
    ),
)

#: The options of quads.
_MIRROR = Keyword(
    "mirror",
    "Union[str, Sequence[Union[str, Sequence[float]]], None]",
    None,
    "Planes about which the quads are symmetric, one or several that are perpendicular to each other. A plane is "
    "'x', 'y' or 'z' (through the centre of the bounding box; the side of larger coordinates is kept), '-x', '-y' "
    "or '-z' (the other side), 'auto' (the plane is found), or nx, ny, nz, d. See `Mesh.mirror_plane`.",
)
_OF_TABLE = Group("The quads", of_table(quad_options())).but(
    edge_length={"type": "Union[float, ArrayLike, None]", "text": _LENGTHS}
)
QUADS = Group(
    "The quads",
    (
        *_OF_TABLE.keywords,
        _MIRROR,
        Keyword(
            "density",
            "Optional[ArrayLike]",
            None,
            "How dense quads are at every vertex, as a factor of the number of their edges along a length.",
        ),
        Keyword(
            "near_vertices",
            "Optional[ArrayLike]",
            None,
            "The vertices that sizes change near, where `near` is 'vertices'.",
        ),
    ),
)

#: The options of repair.
REPAIR = Group("What may be done beyond what a mesh needs", of_table(repair_options()))
