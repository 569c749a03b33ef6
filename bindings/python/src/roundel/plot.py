"""Pictures of meshes, fields, maps and quads, drawn by pyvista or by matplotlib."""

from __future__ import annotations

from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any, Iterator, Optional, Sequence

import numpy as np

from ._library import path
from .errors import MissingPackageError, OptionRangeError, refusal
from .packages import package, to_pyvista

#: What is grey, the lines on it, and vertices that turn forth and back.
SURFACE, LINE, FORTH, BACK = "#d9d9d9", "#1f3a5f", "#d62728", "#1f77b4"
#: Where matplotlib looks from, in degrees.
ELEVATION, AZIMUTH = 30.0, -60.0
#: The largest number of crosses that are drawn: more of them are a grey surface.
CROSSES = 4000


@dataclass(frozen=True)
class Shown:
    """A surface, and what is drawn on it."""

    vertices: np.ndarray
    #: One array for each number of corners.
    polygons: Sequence[np.ndarray]
    #: Whether the edges of the polygons are drawn.
    edges: bool = False
    #: A number for each polygon, which is its colour, and what it is called.
    values: Optional[np.ndarray] = None
    label: str = ""
    #: Lines on the surface, of shape (lines, 2, 3).
    lines: Optional[np.ndarray] = None
    #: Points on the surface in a colour each: those that turn forth, and those that turn back.
    forth: Optional[np.ndarray] = None
    back: Optional[np.ndarray] = None

    def points(self) -> list[tuple[np.ndarray, str]]:
        """The points with their colours."""
        both = ((self.forth, FORTH), (self.back, BACK))
        return [(points, colour) for points, colour in both if points is not None and len(points)]


def draw(shown: Shown, backend: Optional[str], show: bool, file: Any) -> Any:
    """Draws by a package; returns pyvista's plotter or matplotlib's axes."""
    if backend is None:
        backend = next((name for name in _BACKENDS if find_spec(name)), None)
        if backend is None:
            raise refusal(MissingPackageError, "plot needs pyvista or matplotlib: pip install pyvista")
    if backend not in _BACKENDS:
        words = ", ".join(repr(name) for name in _BACKENDS)
        raise refusal(OptionRangeError, f"backend: {backend!r} is none of {words}")
    target = None if file is None else path(file).decode()
    return _BACKENDS[backend](shown, show, target)


def _by_pyvista(shown: Shown, show: bool, file: Optional[str]) -> Any:
    pyvista = package("pyvista", "plot")
    plotter = pyvista.Plotter(off_screen=None if show else True)
    surface = to_pyvista(shown.vertices, shown.polygons)
    look: dict[str, Any] = {"show_edges": shown.edges, "edge_color": LINE}
    if shown.values is None:
        plotter.add_mesh(surface, color=SURFACE, **look)
    else:
        surface.cell_data[shown.label] = shown.values
        plotter.add_mesh(surface, scalars=shown.label, cmap="viridis", clim=_limits(shown.values), **look)
    if shown.lines is not None and len(shown.lines):
        pieces = pyvista.line_segments_from_points(shown.lines.reshape(-1, 3))
        plotter.add_mesh(pieces, color=LINE, line_width=2)
    for points, colour in shown.points():
        plotter.add_points(points, color=colour, point_size=12, render_points_as_spheres=True)
    if show:
        plotter.show(screenshot=file or False)
    elif file is not None:
        plotter.screenshot(file)
    return plotter


def _by_matplotlib(shown: Shown, show: bool, file: Optional[str]) -> Any:
    pyplot = package("matplotlib.pyplot", "plot")
    art = package("mpl_toolkits.mplot3d.art3d", "plot")
    figure = pyplot.figure(figsize=(7, 6))
    axes = figure.add_subplot(projection="3d")
    axes.set_proj_type("ortho")
    axes.view_init(elev=ELEVATION, azim=AZIMUTH)
    axes.add_collection3d(_sorted_by_depth(shown, art))
    low, high = shown.vertices.min(axis=0), shown.vertices.max(axis=0)
    around = np.maximum(high - low, 1e-3 * np.max(high - low))
    for set_limits, from_, to in zip((axes.set_xlim, axes.set_ylim, axes.set_zlim), low, low + around):
        set_limits(from_, to)
    axes.set_box_aspect(around, zoom=1.05)
    axes.set_axis_off()
    if shown.values is not None:
        scale = pyplot.cm.ScalarMappable(pyplot.Normalize(*_limits(shown.values)), "viridis")
        figure.colorbar(scale, ax=axes, label=shown.label, shrink=0.6)
    if file is not None:
        figure.savefig(file, dpi=150)
    if show:
        pyplot.show()
    return axes


_BACKENDS = {"pyvista": _by_pyvista, "matplotlib": _by_matplotlib}


def _limits(values: np.ndarray) -> tuple[float, float]:
    """What the ends of the colours mean: scaled Jacobians are from 0 to 1, inverted quads below."""
    return min(0.0, float(values.min(initial=0.0))), 1.0


def _towards_camera() -> np.ndarray:
    up, around = np.radians([ELEVATION, AZIMUTH])
    return np.array([np.cos(up) * np.cos(around), np.cos(up) * np.sin(around), np.sin(up)])


def _sorted_by_depth(shown: Shown, art: Any) -> Any:
    """Faces, lines and points in one collection: matplotlib hides what is behind only within one.

    Lines and points come a little towards the camera, which in an orthographic picture moves none of them.
    """
    faces = [shown.vertices[face] for block in shown.polygons for face in block]
    length = np.median([np.linalg.norm(face[1] - face[0]) for face in faces])
    lift = 2 * length * _towards_camera()
    lines = [] if shown.lines is None else [np.array([a, b, a]) + lift for a, b in shown.lines]
    dots = [(dot, colour) for points, colour in shown.points() for dot in _dots(points + 2 * lift, shown)]
    clear, edge = (0.0, 0.0, 0.0, 0.0), LINE if shown.edges else "none"
    fills = [*_colours(shown, faces), *[clear] * len(lines), *[colour for _, colour in dots]]
    rims = [edge] * len(faces) + [LINE] * len(lines) + ["none"] * len(dots)
    widths = [0.4] * len(faces) + [0.8] * len(lines) + [0.0] * len(dots)
    polygons = [*faces, *lines, *[dot for dot, _ in dots]]
    to_rgba = package("matplotlib.colors", "plot").to_rgba_array
    return art.Poly3DCollection(polygons, facecolors=to_rgba(fills), edgecolors=to_rgba(rims), linewidths=widths)


def _dots(points: np.ndarray, shown: Shown) -> Iterator[np.ndarray]:
    """Discs that face the camera, of a hundredth of the mesh's diagonal."""
    radius = 0.01 * np.linalg.norm(np.ptp(shown.vertices, axis=0))
    right = np.array([-np.sin(np.radians(AZIMUTH)), np.cos(np.radians(AZIMUTH)), 0.0])
    up = np.cross(_towards_camera(), right)
    turns = np.linspace(0, 2 * np.pi, 12, endpoint=False)[:, None]
    disc = radius * (np.cos(turns) * right + np.sin(turns) * up)
    return (point + disc for point in points)


def _colours(shown: Shown, corners: Sequence[np.ndarray]) -> np.ndarray:
    """The colour of every polygon, darker where it looks away from the light."""
    colours = package("matplotlib.colors", "plot")
    if shown.values is None:
        base = np.tile(colours.to_rgb(SURFACE), (len(corners), 1))
    else:
        low, high = _limits(shown.values)
        base = package("matplotlib", "plot").colormaps["viridis"]((shown.values - low) / (high - low))[:, :3]
    normals = np.array([np.cross(c[2] - c[0], c[-1] - c[1]) for c in corners])
    lengths = np.linalg.norm(normals, axis=1)
    towards = normals @ np.array([0.3, -0.5, 0.8]) / np.where(lengths > 0, lengths, 1)
    lit = np.clip(base * (0.75 + 0.25 * towards[:, None]), 0, 1)
    return np.hstack([lit, np.ones((len(lit), 1))])


def crosses(vertices: np.ndarray, faces: np.ndarray, directions: np.ndarray, symmetry: int) -> np.ndarray:
    """The arms of a field as lines, evenly thinned out where there are very many faces."""
    at = np.unique(np.linspace(0, len(faces) - 1, min(len(faces), CROSSES)).astype(int))
    corners, along = vertices[faces[at]], directions[at]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    doubled = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = normals / doubled
    length = 0.35 * np.sqrt(doubled * len(faces) / len(at))
    centres = corners.mean(axis=1) + 0.05 * length * normals
    across = np.cross(normals, along)
    arms = []
    for arm in range(symmetry):
        angle = 2 * np.pi * arm / symmetry
        arms.append(centres + length * (np.cos(angle) * along + np.sin(angle) * across))
    return np.concatenate([np.stack([centres, arm], axis=1) for arm in arms])


def integer_lines(corners: np.ndarray, uvs: np.ndarray) -> np.ndarray:
    """The lines of integer u and of integer v on triangles, given by their corners in space and in the plane."""
    both = [_levels(corners, uvs[:, :, axis]) for axis in (0, 1)]
    return np.concatenate(both)


def lifted(corners: np.ndarray) -> np.ndarray:
    """Triangles a little above themselves, so that lines on them are not hidden."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    height = 0.002 * np.linalg.norm(np.ptp(corners.reshape(-1, 3), axis=0))
    return corners + height * (normals / np.where(lengths > 0, lengths, 1))[:, None]


def _levels(corners: np.ndarray, values: np.ndarray) -> np.ndarray:
    low = np.ceil(values.min(axis=1) - 1e-9).astype(int)
    crossed = np.maximum(np.floor(values.max(axis=1) + 1e-9).astype(int) - low + 1, 0)
    face = np.repeat(np.arange(len(values)), crossed)
    level = low[face] + np.arange(len(face)) - np.repeat(np.cumsum(crossed) - crossed, crossed)
    hits = np.full((len(face), 3, 3), np.nan)
    for k in range(3):
        a, b = values[face, k], values[face, (k + 1) % 3]
        with np.errstate(divide="ignore", invalid="ignore"):
            t = (level - a) / (b - a)
        t = np.where((t > -1e-9) & (t < 1 + 1e-9), t, np.nan)[:, None]
        hits[:, k] = (1 - t) * corners[face, k] + t * corners[face, (k + 1) % 3]
    # A line through a corner meets three edges: its ends are the two points that are furthest apart.
    pairs = np.stack([hits[:, [0, 1]], hits[:, [1, 2]], hits[:, [2, 0]]], axis=1)
    lengths = np.nan_to_num(np.linalg.norm(pairs[:, :, 1] - pairs[:, :, 0], axis=2), nan=-1.0)
    longest = np.argmax(lengths, axis=1)
    rows = np.arange(len(face))
    return pairs[rows, longest][lengths[rows, longest] > 0]
