"""The names of types that signatures use."""

from __future__ import annotations

import os
from typing import Any, Literal, Sequence, Union

import numpy as np

#: Numbers: a list, a tuple, a NumPy array.
ArrayLike = Union[Sequence[Any], np.ndarray]

#: A matrix: a NumPy array, a list of rows, or a matrix of SciPy in any sparse form.
MatrixLike = Any

#: A `Mesh`, the path of a file, vertices (beside faces), or a mesh of trimesh, pyvista, meshio, pymeshlab or
#: openmesh.
MeshLike = Any

#: The path of a file.
File = Union[str, "os.PathLike[str]"]

#: How integers are decided.
Strategy = Literal["relax", "direct", "greedy", "adaptive", "multiple", "lattice", "exact", "auto"]
