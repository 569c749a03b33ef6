# Written by build_stubs.py from the running package: see there.

from enum import IntEnum
from typing import Any, Iterable, Iterator, Literal, Mapping, Optional, Sequence, Union

import numpy as np

from ._types import ArrayLike as ArrayLike, File as File, MatrixLike as MatrixLike, MeshLike as MeshLike
from ._types import Strategy as Strategy
from .errors import *
from .errors import classes as classes
from .events import Event as Event, Progress as Progress
from .lazy_rows import Candidate as Candidate, LazyRows as LazyRows
from .options import Option as Option

__version__: str

class Attributes:
    materials: Optional[FaceNames]
    groups: Optional[FaceNames]
    face_colors: Optional[np.ndarray]
    uv: Optional[np.ndarray]
    vertex_colors: Optional[np.ndarray]
    scalars: dict[str, np.ndarray]
    def __init__(
        self,
        materials: Optional[FaceNames],
        groups: Optional[FaceNames],
        face_colors: Optional[np.ndarray],
        uv: Optional[np.ndarray],
        vertex_colors: Optional[np.ndarray],
        scalars: dict[str, np.ndarray],
    ) -> None: ...

class BaseLayout:
    def __init__(self, vertices: ArrayLike, polygons: Sequence[Sequence[int]]) -> None: ...
    @classmethod
    def read(cls, file: File) -> BaseLayout: ...
    @classmethod
    def of_quads(cls, vertices: MeshLike, quads: Any = None, deviation: float = 0.0) -> BaseLayout: ...
    def write(self, file: File) -> None: ...
    @property
    def soup(self) -> Soup: ...
    @property
    def arcs(self) -> np.ndarray: ...
    def fix_arc(self, arc: int, edges: int) -> None: ...
    def draw_arc(self, arc: int, points: ArrayLike) -> None: ...
    def hold_arcs(self, held: bool = True) -> None: ...
    def quads(self, mesh: MeshLike, quads: int = 1000) -> tuple[Quads, np.ndarray]: ...

class CancelToken:
    def __init__(self) -> None: ...
    def cancel(self) -> None: ...
    def reset(self) -> None: ...
    @property
    def is_cancelled(self) -> bool: ...

class Cut:
    mesh: Mesh
    face_origins: np.ndarray
    edges: np.ndarray
    def __init__(self, mesh: Mesh, face_origins: np.ndarray, edges: np.ndarray) -> None: ...

class EditKind(IntEnum):
    VERTEX_NOT_FINITE = 0
    POLYGON_NOT_FINITE = 1
    POLYGON_OUT_OF_RANGE = 2
    VERTEX_WELDED = 3
    CORNERS_REMOVED = 4
    POLYGON_DEGENERATE = 5
    POLYGON_TRIANGULATED = 6
    DUPLICATE_DROPPED = 7
    OPPOSITE_DROPPED = 8
    EDGE_COLLAPSED = 9
    CAP_FLIPPED = 10
    SLIVER_DROPPED = 11
    POLYGON_TURNED = 12
    COMPONENT_TURNED = 13
    EDGE_CUT = 14
    VERTEX_SPLIT = 15
    EDGE_HALVED = 16
    VERTEX_UNUSED = 17
    COMPONENT_DROPPED = 18
    HOLE_FILLED = 19

class FaceNames:
    names: list[str]
    labels: np.ndarray
    def __init__(self, names: list[str], labels: np.ndarray) -> None: ...

class Field:
    mesh: Mesh
    @property
    def angles(self) -> np.ndarray: ...
    @property
    def directions(self) -> np.ndarray: ...
    @property
    def period_jumps(self) -> np.ndarray: ...
    @property
    def kappa(self) -> np.ndarray: ...
    @property
    def vertex_indices(self) -> np.ndarray: ...
    @property
    def vertex_index_steps(self) -> np.ndarray: ...
    @property
    def boundary_index_steps(self) -> np.ndarray: ...
    @property
    def boundary_indices(self) -> np.ndarray: ...
    @property
    def irregular(self) -> np.ndarray: ...
    @property
    def symmetry(self) -> int: ...
    @property
    def energy(self) -> float: ...
    @property
    def solution(self) -> Solution: ...
    def to_pyvista(self) -> Any: ...
    def to_meshio(self) -> Any: ...
    def plot(
        self,
        *,
        backend: Optional[str] = None,
        show: bool = True,
        file: Optional[File] = None,
    ) -> Any: ...

class GeodesicDistance:
    mesh: Mesh
    @property
    def distances(self) -> np.ndarray: ...
    @property
    def nearest_sources(self) -> np.ndarray: ...
    def at(self, faces: ArrayLike, barycentric: ArrayLike) -> np.ndarray: ...
    def gradients(self, faces: ArrayLike, barycentric: ArrayLike) -> np.ndarray: ...
    def path(self, face: int, barycentric: ArrayLike) -> tuple[np.ndarray, np.ndarray]: ...
    def path_from_vertex(self, vertex: int) -> np.ndarray: ...

class Interrupted(KeyboardInterrupt):
    incumbent: Any
    def __init__(self, incumbent: Any = None) -> None: ...

class Map:
    field: Field
    def __init__(self, of: Field) -> None: ...
    def solve(
        self,
        *,
        quads: Optional[int] = None,
        edge_length: Union[float, ArrayLike, None] = None,
        untangle: bool = True,
        stiffenings: int = 5,
        strategy: Strategy = "auto",
        time_limit: float = ...,
        gap: float = 0.0,
        threads: int = 0,
        preset: Optional[Literal["orientation_field", "parametrization"]] = None,
        progress: Progress = None,
        cancel: Optional[CancelToken] = None,
        rounding_threshold: float = 0.5,
        exact_integers: int = 1000,
        gauss_seidel_updates: int = 100000,
        gauss_seidel_tolerance: float = 0.001,
        cg_iterations: int = 50,
        cg_tolerance: float = 0.001,
        exact_steps: bool = True,
        warm_start: Literal["off", "offer", "keep"] = "off",
        ordering: Literal["fill_reducing", "natural", "largest_pivot"] = "fill_reducing",
        dense_integers: int = 1000,
        beam_width: int = 256,
        lattice_rounds: int = 1,
        nodes: int = 10000000000,
    ) -> None: ...
    @property
    def uvs(self) -> np.ndarray: ...
    @property
    def vertex_uvs(self) -> np.ndarray: ...
    @property
    def vertex_corners(self) -> np.ndarray: ...
    @property
    def transitions(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]: ...
    @property
    def cones(self) -> np.ndarray: ...
    @property
    def flipped(self) -> np.ndarray: ...
    @property
    def winding_defects(self) -> np.ndarray: ...
    @property
    def refinements(self) -> int: ...
    @property
    def valid(self) -> bool: ...
    @property
    def energy(self) -> float: ...
    @property
    def solution(self) -> Solution: ...
    def quads(self) -> Quads: ...
    def write(self, file: File) -> None: ...
    def to_trimesh(self) -> Any: ...
    def to_pyvista(self) -> Any: ...
    def to_meshio(self) -> Any: ...
    def plot(
        self,
        *,
        backend: Optional[str] = None,
        show: bool = True,
        file: Optional[File] = None,
    ) -> Any: ...

class Mesh:
    def __init__(self, V: MeshLike, F: Optional[ArrayLike] = None) -> None: ...
    @classmethod
    def read(cls, file: File, repair: bool = False) -> Mesh: ...
    @classmethod
    def from_soup(
        cls,
        vertices: MeshLike,
        polygons: Any = None,
        *,
        weld: float = 0.0,
        drop_components: float = 0.0,
        fill_holes: int = 0,
    ) -> Mesh: ...
    @classmethod
    def from_trimesh(cls, mesh: Any, weld: float = 0.0) -> Mesh: ...
    @classmethod
    def shape(cls, name: str, faces: int) -> Mesh: ...
    def attributes(self, file: File) -> Attributes: ...
    def write(self, file: File) -> None: ...
    def to_trimesh(self) -> Any: ...
    def to_pyvista(self) -> Any: ...
    def to_meshio(self) -> Any: ...
    def plot(
        self,
        *,
        backend: Optional[str] = None,
        show: bool = True,
        file: Optional[File] = None,
    ) -> Any: ...
    @property
    def vertices(self) -> np.ndarray: ...
    @property
    def faces(self) -> np.ndarray: ...
    @property
    def edge_faces(self) -> np.ndarray: ...
    @property
    def face_edges(self) -> np.ndarray: ...
    @property
    def boundary_loops(self) -> int: ...
    @property
    def euler_characteristic(self) -> int: ...
    def mirror_plane(self, plane: str = "auto") -> tuple[np.ndarray, float, float]: ...

class Problem:
    def __init__(self, variables: int) -> None: ...
    @classmethod
    def read(cls, file: File) -> Problem: ...
    def write(self, file: File) -> None: ...
    @property
    def maximises(self) -> bool: ...
    @classmethod
    def read_mps(cls, file: File) -> Problem: ...
    def write_mps(self, file: File) -> None: ...
    def save_replay(self, file: File, options: Mapping[str, Any] = ...) -> None: ...
    def copy(self) -> Problem: ...
    @property
    def variables(self) -> int: ...
    @property
    def constraints(self) -> int: ...
    @property
    def inequalities(self) -> int: ...
    @property
    def lower_bounds(self) -> np.ndarray: ...
    @property
    def upper_bounds(self) -> np.ndarray: ...
    def quadratic(self, Q: MatrixLike, triangle: Literal["full", "upper", "lower"] = "full") -> None: ...
    def linear(self, q: ArrayLike) -> None: ...
    def constant(self, c: float) -> None: ...
    def least_squares(
        self,
        indices: ArrayLike,
        coefficients: ArrayLike,
        rhs: float,
        weight: float = 1.0,
    ) -> int: ...
    def least_squares_rows(self, A: MatrixLike, b: ArrayLike, weights: Optional[ArrayLike] = None) -> int: ...
    def constrain(self, indices: ArrayLike, coefficients: ArrayLike, rhs: float) -> int: ...
    def constrain_rows(self, C: MatrixLike, d: ArrayLike) -> int: ...
    def inequality(
        self,
        indices: ArrayLike,
        coefficients: ArrayLike,
        lower: float = ...,
        upper: float = ...,
    ) -> int: ...
    def inequality_rows(
        self,
        G: MatrixLike,
        lower: Optional[ArrayLike] = None,
        upper: Optional[ArrayLike] = None,
    ) -> int: ...
    def bounds(
        self,
        variables: ArrayLike,
        lower: Optional[ArrayLike] = None,
        upper: Optional[ArrayLike] = None,
    ) -> None: ...
    def integer(self, variables: ArrayLike) -> None: ...
    def binary(self, variables: ArrayLike) -> None: ...
    def pin(self, variable: int, value: float) -> None: ...
    def unpin(self, variable: int) -> None: ...
    def guess(self, values: ArrayLike) -> None: ...
    def hint_cycles(self, offsets: ArrayLike, rows: ArrayLike, signs: ArrayLike) -> None: ...

class Proof:
    energy: Optional[float]
    lower_bound: Optional[float]
    violation: float
    nodes: int
    stopped_by: str
    def __init__(
        self,
        energy: Optional[float],
        lower_bound: Optional[float],
        violation: float,
        nodes: int,
        stopped_by: str,
    ) -> None: ...

class Quads:
    def __iter__(self) -> Iterator[np.ndarray]: ...
    def __len__(self) -> int: ...
    @property
    def vertices(self) -> np.ndarray: ...
    @property
    def faces(self) -> np.ndarray: ...
    @property
    def others(self) -> list[np.ndarray]: ...
    @property
    def scaled_jacobians(self) -> np.ndarray: ...
    @property
    def irregular_count(self) -> int: ...
    @property
    def near_feature_count(self) -> int: ...
    @property
    def paired_face_count(self) -> int: ...
    @property
    def euler_characteristic(self) -> int: ...
    @property
    def conforming(self) -> bool: ...
    def smooth(
        self,
        mesh: MeshLike,
        *,
        features: Union[float, ArrayLike, None] = None,
        feature_angle: Optional[float] = None,
        align_boundary: bool = True,
        guide_file: Optional[File] = None,
    ) -> None: ...
    def transfer_face_labels(self, mesh: MeshLike, labels: ArrayLike) -> np.ndarray: ...
    def transfer_vertex_values(self, mesh: MeshLike, values: ArrayLike) -> np.ndarray: ...
    def transfer_corner_values(self, mesh: MeshLike, values: ArrayLike) -> np.ndarray: ...
    def write(self, file: File) -> None: ...
    def to_trimesh(self) -> Any: ...
    def to_pyvista(self) -> Any: ...
    def to_meshio(self) -> Any: ...
    def plot(
        self,
        *,
        backend: Optional[str] = None,
        show: bool = True,
        file: Optional[File] = None,
    ) -> Any: ...

class Repair:
    @property
    def mesh(self) -> Mesh: ...
    @property
    def edits(self) -> np.ndarray: ...
    @property
    def counts(self) -> dict[str, int]: ...
    @property
    def summary(self) -> str: ...
    @property
    def vertex_origins(self) -> np.ndarray: ...
    @property
    def face_origins(self) -> np.ndarray: ...
    @property
    def welded_to(self) -> np.ndarray: ...
    def attributes(self, file: File) -> Attributes: ...
    def attribute_edges(self, file: File, attribute: str) -> np.ndarray: ...

class Solution:
    values: np.ndarray
    energy: float
    lower_bound: Optional[float]
    gap: Optional[float]
    status: str
    complete: bool
    stopped_by: str
    constraint_violation: float
    integrality_violation: float
    counts: dict[str, int]
    seconds: dict[str, float]
    proof: Optional[Proof]
    @property
    def proved(self) -> bool: ...
    def __init__(
        self,
        values: np.ndarray,
        energy: float,
        lower_bound: Optional[float],
        gap: Optional[float],
        status: str,
        complete: bool,
        stopped_by: str,
        constraint_violation: float,
        integrality_violation: float,
        counts: dict[str, int],
        seconds: dict[str, float],
        proof: Optional[Proof] = None,
    ) -> None: ...

class Solver:
    def __init__(self, problem: Problem) -> None: ...
    def set_linear(self, q: ArrayLike) -> None: ...
    def set_constraint_right_sides(self, d: ArrayLike) -> None: ...
    def set_least_squares_right_sides(self, b: ArrayLike) -> None: ...
    def set_inequality_sides(
        self,
        lower: Optional[ArrayLike] = None,
        upper: Optional[ArrayLike] = None,
    ) -> None: ...
    def set_bounds(
        self,
        variables: ArrayLike,
        lower: Optional[ArrayLike] = None,
        upper: Optional[ArrayLike] = None,
    ) -> None: ...
    def set_guess(self, values: ArrayLike) -> None: ...
    def pin(self, variable: int, value: float) -> None: ...
    def unpin(self, variable: int) -> None: ...
    def solve(
        self,
        *,
        strategy: Strategy = "auto",
        time_limit: float = ...,
        gap: float = 0.0,
        threads: int = 0,
        preset: Optional[Literal["orientation_field", "parametrization"]] = None,
        progress: Progress = None,
        cancel: Optional[CancelToken] = None,
        rounding_threshold: float = 0.5,
        exact_integers: int = 1000,
        gauss_seidel_updates: int = 100000,
        gauss_seidel_tolerance: float = 0.001,
        cg_iterations: int = 50,
        cg_tolerance: float = 0.001,
        exact_steps: bool = True,
        warm_start: Literal["off", "offer", "keep"] = "off",
        ordering: Literal["fill_reducing", "natural", "largest_pivot"] = "fill_reducing",
        dense_integers: int = 1000,
        beam_width: int = 256,
        lattice_rounds: int = 1,
        nodes: int = 10000000000,
    ) -> Solution: ...

class Soup:
    def __init__(self, vertices: MeshLike, polygons: Any = None) -> None: ...
    @classmethod
    def read(cls, file: File, format: Optional[str] = None) -> Soup: ...
    def __len__(self) -> int: ...
    @property
    def vertices(self) -> np.ndarray: ...
    @property
    def polygons(self) -> list[np.ndarray]: ...

def check_proof(file: File, problem: Optional[Problem] = None) -> Proof: ...

def curve_guides(
    mesh: MeshLike,
    curves: Iterable[ArrayLike],
    *,
    weight: float = 10.0,
    symmetry: int = 4,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]: ...

def cut_along(mesh: MeshLike, curves: Iterable[ArrayLike]) -> Cut: ...

def extract(V: MeshLike, F: Optional[ArrayLike] = None, uvs: Optional[ArrayLike] = None) -> Quads: ...

def field(
    V: MeshLike,
    F: Optional[ArrayLike] = None,
    *,
    features: Union[float, ArrayLike, None] = None,
    curvature: Optional[tuple[float, float]] = None,
    constraints: Optional[tuple[ArrayLike, ArrayLike]] = None,
    guides: Optional[tuple[ArrayLike, ArrayLike, ArrayLike]] = None,
    indices: Optional[tuple[ArrayLike, ArrayLike]] = None,
    guide_file: Optional[File] = None,
    symmetry: Literal[1, 2, 4, 6] = 4,
    constrain_curvature: float = 0.0,
    curvature_weight: float = 0.0,
    feature_angle: Optional[float] = None,
    feature_length: Optional[float] = None,
    align_boundary: bool = True,
    detail: Optional[float] = None,
    clearance: Optional[float] = None,
    strategy: Strategy = "auto",
    time_limit: float = ...,
    gap: float = 0.0,
    threads: int = 0,
    preset: Optional[Literal["orientation_field", "parametrization"]] = None,
    progress: Progress = None,
    cancel: Optional[CancelToken] = None,
    rounding_threshold: float = 0.5,
    exact_integers: int = 1000,
    gauss_seidel_updates: int = 100000,
    gauss_seidel_tolerance: float = 0.001,
    cg_iterations: int = 50,
    cg_tolerance: float = 0.001,
    exact_steps: bool = True,
    warm_start: Literal["off", "offer", "keep"] = "off",
    ordering: Literal["fill_reducing", "natural", "largest_pivot"] = "fill_reducing",
    dense_integers: int = 1000,
    beam_width: int = 256,
    lattice_rounds: int = 1,
    nodes: int = 10000000000,
) -> Field: ...

def geodesic_distance(
    V: MeshLike,
    F: Optional[ArrayLike] = None,
    *,
    vertices: ArrayLike = (),
    points: Optional[tuple[ArrayLike, ArrayLike]] = None,
    polylines: Iterable[Sequence[Any]] = (),
    edges: Iterable[ArrayLike] = (),
    boundary: bool = False,
    limit: float = ...,
    everywhere: bool = False,
) -> GeodesicDistance: ...

def guidance_options() -> dict[str, Option]: ...

def map(
    V: Union[MeshLike, Field],
    F: Optional[ArrayLike] = None,
    *,
    quads: Optional[int] = None,
    edge_length: Union[float, ArrayLike, None] = None,
    untangle: bool = True,
    stiffenings: int = 5,
    features: Union[float, ArrayLike, None] = None,
    curvature: Optional[tuple[float, float]] = None,
    constraints: Optional[tuple[ArrayLike, ArrayLike]] = None,
    guides: Optional[tuple[ArrayLike, ArrayLike, ArrayLike]] = None,
    indices: Optional[tuple[ArrayLike, ArrayLike]] = None,
    guide_file: Optional[File] = None,
    symmetry: Literal[1, 2, 4, 6] = 4,
    constrain_curvature: float = 0.0,
    curvature_weight: float = 0.0,
    feature_angle: Optional[float] = None,
    feature_length: Optional[float] = None,
    align_boundary: bool = True,
    detail: Optional[float] = None,
    clearance: Optional[float] = None,
    strategy: Strategy = "auto",
    time_limit: float = ...,
    gap: float = 0.0,
    threads: int = 0,
    preset: Optional[Literal["orientation_field", "parametrization"]] = None,
    progress: Progress = None,
    cancel: Optional[CancelToken] = None,
    rounding_threshold: float = 0.5,
    exact_integers: int = 1000,
    gauss_seidel_updates: int = 100000,
    gauss_seidel_tolerance: float = 0.001,
    cg_iterations: int = 50,
    cg_tolerance: float = 0.001,
    exact_steps: bool = True,
    warm_start: Literal["off", "offer", "keep"] = "off",
    ordering: Literal["fill_reducing", "natural", "largest_pivot"] = "fill_reducing",
    dense_integers: int = 1000,
    beam_width: int = 256,
    lattice_rounds: int = 1,
    nodes: int = 10000000000,
) -> Map: ...

def options() -> dict[str, Option]: ...

def presets() -> dict[str, str]: ...

def quad(
    V: MeshLike,
    F: Optional[ArrayLike] = None,
    *,
    quads: int = 1000,
    edge_length: Union[float, ArrayLike, None] = None,
    field_strategy: Strategy = "adaptive",
    smooth: bool = True,
    count: Literal["exact", "about"] = "exact",
    vary_curvature: bool = True,
    refine: bool = True,
    adapt: float = 0.0,
    stretch: float = 0.0,
    min_length: Optional[float] = None,
    max_length: Optional[float] = None,
    gradation: float = 1.5,
    near: Literal["nothing", "features", "boundary", "vertices"] = "nothing",
    near_size: float = 0.5,
    near_distance: Optional[float] = None,
    untangle: bool = True,
    stiffenings: int = 5,
    mirror_tolerance: float = 0.05,
    mirror: Union[str, Sequence[Union[str, Sequence[float]]], None] = None,
    density: Optional[ArrayLike] = None,
    near_vertices: Optional[ArrayLike] = None,
    features: Union[float, ArrayLike, None] = None,
    curvature: Optional[tuple[float, float]] = None,
    constraints: Optional[tuple[ArrayLike, ArrayLike]] = None,
    guides: Optional[tuple[ArrayLike, ArrayLike, ArrayLike]] = None,
    indices: Optional[tuple[ArrayLike, ArrayLike]] = None,
    guide_file: Optional[File] = None,
    symmetry: Literal[1, 2, 4, 6] = 4,
    constrain_curvature: Optional[float] = None,
    curvature_weight: Optional[float] = None,
    feature_angle: Optional[float] = None,
    feature_length: Optional[float] = None,
    align_boundary: bool = True,
    detail: Optional[float] = None,
    clearance: Optional[float] = None,
    strategy: Strategy = "lattice",
    time_limit: float = ...,
    gap: float = 0.0,
    threads: int = 0,
    preset: Optional[Literal["orientation_field", "parametrization"]] = None,
    progress: Progress = None,
    cancel: Optional[CancelToken] = None,
    rounding_threshold: float = 0.5,
    exact_integers: int = 1000,
    gauss_seidel_updates: int = 100000,
    gauss_seidel_tolerance: float = 0.001,
    cg_iterations: int = 50,
    cg_tolerance: float = 0.001,
    exact_steps: bool = True,
    warm_start: Literal["off", "offer", "keep"] = "off",
    ordering: Literal["fill_reducing", "natural", "largest_pivot"] = "fill_reducing",
    dense_integers: int = 1000,
    beam_width: int = 256,
    lattice_rounds: int = 1,
    nodes: int = 10000000000,
) -> Quads: ...

def quad_options() -> dict[str, Option]: ...

def repair(
    vertices: Union[MeshLike, Soup],
    polygons: Any = None,
    *,
    weld: float = 0.0,
    drop_components: float = 0.0,
    fill_holes: int = 0,
) -> Repair: ...

def repair_options() -> dict[str, Option]: ...

def solve(
    Q: Union[Problem, MatrixLike, None] = None,
    q: Optional[ArrayLike] = None,
    c: float = 0.0,
    *,
    A: Optional[MatrixLike] = None,
    b: Optional[ArrayLike] = None,
    weights: Optional[ArrayLike] = None,
    C: Optional[MatrixLike] = None,
    d: Optional[ArrayLike] = None,
    inequalities: Optional[tuple[MatrixLike, Optional[ArrayLike], Optional[ArrayLike]]] = None,
    bounds: Optional[tuple[Optional[ArrayLike], Optional[ArrayLike]]] = None,
    binaries: Optional[ArrayLike] = None,
    integers: Optional[ArrayLike] = None,
    pins: Optional[Mapping[int, float]] = None,
    guess: Optional[ArrayLike] = None,
    triangle: Literal["full", "upper", "lower"] = "full",
    lazy_rows: LazyRows = None,
    proof: Optional[File] = None,
    strategy: Strategy = "auto",
    time_limit: float = ...,
    gap: float = 0.0,
    threads: int = 0,
    preset: Optional[Literal["orientation_field", "parametrization"]] = None,
    progress: Progress = None,
    cancel: Optional[CancelToken] = None,
    rounding_threshold: float = 0.5,
    exact_integers: int = 1000,
    gauss_seidel_updates: int = 100000,
    gauss_seidel_tolerance: float = 0.001,
    cg_iterations: int = 50,
    cg_tolerance: float = 0.001,
    exact_steps: bool = True,
    warm_start: Literal["off", "offer", "keep"] = "off",
    ordering: Literal["fill_reducing", "natural", "largest_pivot"] = "fill_reducing",
    dense_integers: int = 1000,
    beam_width: int = 256,
    lattice_rounds: int = 1,
    nodes: int = 10000000000,
) -> Solution: ...

__all__ = [
    "ArgumentTypeError",
    "Attributes",
    "BaseLayout",
    "CancelToken",
    "CancelledError",
    "Candidate",
    "CountOverflowError",
    "Cut",
    "EditKind",
    "EmptyError",
    "Error",
    "Event",
    "FaceNames",
    "Field",
    "GeodesicDistance",
    "InconsistentOrientationError",
    "IndexOutOfRangeError",
    "InfeasibleError",
    "Interrupted",
    "InvalidArgumentError",
    "IoError",
    "IsolatedVertexError",
    "LengthMismatchError",
    "Map",
    "Mesh",
    "MissingPackageError",
    "NoIntegerSolutionError",
    "NonManifoldEdgeError",
    "NonManifoldVertexError",
    "NotATriangleError",
    "NotConvexError",
    "NotFiniteError",
    "NotSupportedError",
    "NullPointerError",
    "Option",
    "OptionRangeError",
    "OptionTypeError",
    "OutOfMemoryError",
    "PanicError",
    "ParseError",
    "Problem",
    "Proof",
    "ProofRefusedError",
    "Quads",
    "Repair",
    "RepeatedVertexError",
    "SearchLimitError",
    "Solution",
    "Solver",
    "Soup",
    "TimeLimitError",
    "UnboundedError",
    "UnknownOptionError",
    "UnusableError",
    "ZeroAreaError",
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
]
