"""Builds a problem part by part."""

from __future__ import annotations

from typing import Any, Literal, Mapping, Optional

import numpy as np

from ._handle import Handle, number
from ._library import ffi, lib, path
from ._types import ArrayLike, File, MatrixLike
from .arrays import compressed, count, indices, indices32, pointer, real, reals, sides, whole
from .errors import InvalidArgumentError, LengthMismatchError, check, refusal
from .options import options_handle

_TRIANGLES = {
    "full": lib.ROUNDEL_TRIANGLE_FULL,
    "upper": lib.ROUNDEL_TRIANGLE_UPPER,
    "lower": lib.ROUNDEL_TRIANGLE_LOWER,
}


class Problem:
    """Minimise 1/2 x'Qx + q'x + c + sum_k w_k (a_k . x - r_k)^2 under constraints, some x integer.

    The constraints are equations C x = d, inequalities l <= G x <= u, and bounds of variables.

    Parts may be added in any order and any number of times; terms are summed. A call that fails
    changes nothing. Matrices are dense or SciPy matrices of any form. Those in CSR or CSC with indices
    of 32 or 64 bits and double precision are passed to the library without a copy in Python.

    >>> import roundel
    >>> problem = roundel.Problem(2)
    >>> problem.least_squares([0], [1.0], 0.4)
    0
    >>> problem.least_squares([0, 1], [1.0, -1.0], 0.0)
    1
    >>> problem.integer([1])
    >>> roundel.solve(problem).values
    array([0.2, 0. ])
    """

    def __init__(self, variables: int, _handle: Optional[Handle] = None) -> None:
        if _handle is None:
            wanted = count(variables, "variables")
            _handle = Handle.made("roundel_problem", lib.roundel_problem_new, wanted)
        self._handle = _handle
        self._maximises = False

    def __repr__(self) -> str:
        return f"<Problem: {self.variables} variables, {self.constraints} constraints>"

    @classmethod
    def read(cls, file: File) -> Problem:
        """Reads a problem from a file: LP for ".lp", QPLIB for ".qplib", MPS for any other name, also with ".gz".

        A file may maximise: the problem then minimises the negated objective, and `maximises` is True.
        """
        maximises = ffi.new("int32_t *")
        read = lib.roundel_problem_read
        problem = cls(0, Handle.made("roundel_problem", read, path(file), maximises))
        problem._maximises = bool(maximises[0])
        return problem

    def write(self, file: File) -> None:
        """Writes LP for a name that ends in ".lp" and free-format MPS for any other, compressed for ".gz"."""
        check(lib.roundel_problem_write(self._handle.pointer, path(file)))

    @property
    def maximises(self) -> bool:
        """Whether the problem was read from a file that maximises: its objective is minus that of the file."""
        return self._maximises

    @classmethod
    def read_mps(cls, file: File) -> Problem:
        """Reads a problem from a file in MPS, gzipped or not, whatever its name is."""
        return cls(0, Handle.made("roundel_problem", lib.roundel_problem_read_mps, path(file)))

    def write_mps(self, file: File) -> None:
        """Writes free-format MPS, gzipped if the file's name ends in ".gz"."""
        check(lib.roundel_problem_write_mps(self._handle.pointer, path(file)))

    def save_replay(self, file: File, options: Mapping[str, Any] = {}) -> None:
        """Writes the problem and options of `solve`, by name, so that the solve can be repeated elsewhere."""
        handle = options_handle(options)
        check(lib.roundel_problem_save_replay(self._handle.pointer, handle.pointer, path(file)))

    def copy(self) -> Problem:
        """An independent copy of the problem."""
        pointer_ = self._handle.pointer
        return Problem(0, Handle.made("roundel_problem", lib.roundel_problem_clone, pointer_))

    @property
    def variables(self) -> int:
        """The number of variables."""
        return number(lib.roundel_problem_variable_count, self._handle.pointer)

    @property
    def constraints(self) -> int:
        """The number of constraints so far, which is also the index of the next one."""
        return number(lib.roundel_problem_constraint_count, self._handle.pointer)

    @property
    def inequalities(self) -> int:
        """The number of inequalities so far, which is also the index of the next one."""
        return number(lib.roundel_problem_inequality_count, self._handle.pointer)

    @property
    def lower_bounds(self) -> np.ndarray:
        """The lower bound of each variable, minus infinity where there is none."""
        return self._bounds()[0]

    @property
    def upper_bounds(self) -> np.ndarray:
        """The upper bound of each variable, infinity where there is none."""
        return self._bounds()[1]

    def _bounds(self) -> tuple[np.ndarray, np.ndarray]:
        lower, upper = np.empty(self.variables), np.empty(self.variables)
        check(lib.roundel_problem_bounds(self._handle.pointer, pointer(lower), pointer(upper), len(lower)))
        return lower, upper

    def quadratic(self, Q: MatrixLike, triangle: Literal["full", "upper", "lower"] = "full") -> None:
        """Adds 1/2 x'Qx. `triangle` says which entries are given: "full", "upper" or "lower"."""
        matrix = compressed(Q, "Q")
        if matrix.shape != (self.variables, self.variables):
            told = f"Q: the shape is {matrix.shape} for {self.variables} variables"
            raise refusal(LengthMismatchError, told)
        if triangle not in _TRIANGLES:
            told = f"triangle: {triangle!r} is none of {', '.join(_TRIANGLES)}"
            raise refusal(InvalidArgumentError, told)
        call = getattr(lib, f"roundel_problem_add_quadratic_{matrix.form}{matrix.twin}")
        check(call(self._handle.pointer, _TRIANGLES[triangle], *matrix.arguments()))

    def linear(self, q: ArrayLike) -> None:
        """Adds q'x."""
        values = reals(q, "q")
        check(lib.roundel_problem_add_linear(self._handle.pointer, pointer(values), len(values)))

    def constant(self, c: float) -> None:
        """Adds a number to the objective."""
        check(lib.roundel_problem_add_constant(self._handle.pointer, real(c, "c")))

    def least_squares(
        self, indices: ArrayLike, coefficients: ArrayLike, rhs: float, weight: float = 1.0
    ) -> int:
        """Adds weight * (coefficients . x[indices] - rhs)^2 and returns the index of the row."""
        at = indices32(indices, "indices")
        values = reals(coefficients, "coefficients", (len(at),))
        numbers = (real(rhs, "rhs"), real(weight, "weight"))
        call = lib.roundel_problem_add_least_squares
        return number(call, self._handle.pointer, len(at), pointer(at), pointer(values), *numbers)

    def least_squares_rows(self, A: MatrixLike, b: ArrayLike, weights: Optional[ArrayLike] = None) -> int:
        """Adds sum_k weights_k (A_k . x - b_k)^2 and returns the index of the first row.

        Weights are 1 by default.
        """
        matrix = compressed(A, "A")
        if matrix.shape[1] != self.variables:
            raise refusal(LengthMismatchError, _columns("A", matrix, self.variables))
        rhs = reals(b, "b", (matrix.shape[0],))
        factors = None if weights is None else reals(weights, "weights", rhs.shape)
        call = getattr(lib, f"roundel_problem_add_least_squares_{matrix.form}{matrix.twin}")
        given = ffi.NULL if factors is None else pointer(factors)
        return number(call, self._handle.pointer, *matrix.arguments(), len(rhs), pointer(rhs), given)

    def constrain(self, indices: ArrayLike, coefficients: ArrayLike, rhs: float) -> int:
        """Adds the constraint coefficients . x[indices] = rhs and returns its index."""
        at = indices32(indices, "indices")
        values = reals(coefficients, "coefficients", (len(at),))
        number_ = self.constraints
        check(
            lib.roundel_problem_add_constraint(
                self._handle.pointer, len(at), pointer(at), pointer(values), real(rhs, "rhs")
            )
        )
        return number_

    def constrain_rows(self, C: MatrixLike, d: ArrayLike) -> int:
        """Adds the constraints C x = d, one for each row, and returns the index of the first."""
        matrix = compressed(C, "C")
        if matrix.shape[1] != self.variables:
            raise refusal(LengthMismatchError, _columns("C", matrix, self.variables))
        rhs = reals(d, "d")
        call = getattr(lib, f"roundel_problem_add_constraints_{matrix.form}{matrix.twin}")
        arguments = (*matrix.arguments(), len(rhs), pointer(rhs))
        return number(call, self._handle.pointer, *arguments)

    def inequality(
        self, indices: ArrayLike, coefficients: ArrayLike, lower: float = -np.inf, upper: float = np.inf
    ) -> int:
        """Adds the inequality lower <= coefficients . x[indices] <= upper and returns its index.

        A side that does not limit is infinite.
        """
        at = indices32(indices, "indices")
        values = reals(coefficients, "coefficients", (len(at),))
        limits = (real(lower, "lower"), real(upper, "upper"))
        call = lib.roundel_problem_add_inequality
        return number(call, self._handle.pointer, len(at), pointer(at), pointer(values), *limits)

    def inequality_rows(
        self, G: MatrixLike, lower: Optional[ArrayLike] = None, upper: Optional[ArrayLike] = None
    ) -> int:
        """Adds the inequalities lower <= G x <= upper, one for each row, and returns the index of the first.

        A side that does not limit is infinite, and sides that are not given are so for all rows.
        """
        matrix = compressed(G, "G")
        if matrix.shape[1] != self.variables:
            raise refusal(LengthMismatchError, _columns("G", matrix, self.variables))
        below, above = sides(lower, upper, matrix.shape[0])
        call = getattr(lib, f"roundel_problem_add_inequalities_{matrix.form}{matrix.twin}")
        arguments = (*matrix.arguments(), len(below), pointer(below), pointer(above))
        return number(call, self._handle.pointer, *arguments)

    def bounds(
        self,
        variables: ArrayLike,
        lower: Optional[ArrayLike] = None,
        upper: Optional[ArrayLike] = None,
    ) -> None:
        """Sets lower <= x[variables] <= upper, in place of earlier bounds of these variables.

        The bounds are one number for each of the variables, or one for all. A bound that does not limit is
        infinite, and so is one that is not given.

        >>> import roundel
        >>> problem = roundel.Problem(2)
        >>> problem.least_squares_rows([[1.0, 0.0], [0.0, 1.0]], [2.6, 1.4])
        0
        >>> problem.inequality([0, 1], [1.0, 1.0], upper=3.0)
        0
        >>> problem.bounds([0], upper=1.0)
        >>> problem.integer([0, 1])
        >>> roundel.solve(problem).values
        array([1., 1.])
        """
        at = self._at(variables, "variables")
        below, above = sides(lower, upper, len(at))
        arrays = (len(at), pointer(at), pointer(below), pointer(above))
        check(lib.roundel_problem_set_bounds(self._handle.pointer, *arrays))

    def integer(self, variables: ArrayLike) -> None:
        """Makes variables integer, given by their indices or by a boolean for each variable."""
        at = self._at(variables, "integers")
        check(lib.roundel_problem_set_integers(self._handle.pointer, len(at), pointer(at)))

    def binary(self, variables: ArrayLike) -> None:
        """Makes variables 0 or 1, given by their indices or by a boolean for each variable."""
        at = self._at(variables, "binaries")
        check(lib.roundel_problem_set_binaries(self._handle.pointer, len(at), pointer(at)))

    def _at(self, variables: ArrayLike, what: str) -> np.ndarray:
        """The indices of variables that are given by indices or by a boolean for each variable."""
        given = np.asarray(variables)
        if given.dtype == bool:
            if given.shape != (self.variables,):
                told = f"{what}: the shape is {given.shape} for {self.variables} variables"
                raise refusal(LengthMismatchError, told)
            given = np.flatnonzero(given)
        return indices32(given, what)

    def pin(self, variable: int, value: float) -> None:
        """Fixes a variable to a value."""
        check(lib.roundel_problem_pin(self._handle.pointer, whole(variable, "variable"), real(value, "value")))

    def unpin(self, variable: int) -> None:
        """Releases a pinned variable. A free variable stays free."""
        check(lib.roundel_problem_unpin(self._handle.pointer, whole(variable, "variable")))

    def guess(self, values: ArrayLike) -> None:
        """Sets the point whose values variables keep where the objective does not determine them."""
        given = reals(values, "guess")
        check(lib.roundel_problem_set_guess(self._handle.pointer, pointer(given), len(given)))

    def hint_cycles(self, offsets: ArrayLike, rows: ArrayLike, signs: ArrayLike) -> None:
        """Adds a hint: a basis of short cycles of least-squares rows, in compressed rows.

        The rows of cycle k are `rows[offsets[k]:offsets[k + 1]]`, and `signs` tells for each whether the
        cycle passes it forth (1) or back (-1). A wrong hint is ignored, with a log event.
        """
        starts, at = indices(offsets, "offsets"), indices(rows, "rows")
        if starts.dtype != at.dtype:
            starts, at = starts.astype(np.int64), at.astype(np.int64)
        twin = "_i64" if at.dtype == np.int64 else ""
        call = getattr(lib, f"roundel_problem_hint_cycles{twin}")
        turns = np.ascontiguousarray(signs, dtype=np.int8)
        if turns.shape != at.shape:
            raise refusal(LengthMismatchError, "signs: there must be one for each of the rows")
        arrays = (len(starts), pointer(starts), len(at), pointer(at), pointer(turns))
        check(call(self._handle.pointer, *arrays))


def _columns(what: str, matrix: Any, variables: int) -> str:
    return f"{what}: {matrix.shape[1]} columns for {variables} variables"
