"""Solves one problem many times with changing data."""

from __future__ import annotations

from typing import Any, Optional

from ._handle import Handle
from ._library import ffi, lib
from .arrays import pointer, reals
from .errors import check
from .options import options_handle
from .problem import Problem
from .solution import Solution, taken
from .watch import CancelToken, Progress, Watch


class Solver:
    """A problem with fixed matrices and integers that is solved many times.

    Elimination, orderings and factors are kept from one solve to the next. The solution equals that of
    `solve` for the same data, except that the option `warm_start` may improve it. Only one thread at a
    time may use a solver.

    >>> import roundel
    >>> problem = roundel.Problem(2)
    >>> problem.least_squares_rows([[1.0, 0.0], [1.0, -1.0]], [0.4, 0.0])
    0
    >>> problem.integer([1])
    >>> solver = roundel.Solver(problem)
    >>> solver.solve().values
    array([0.2, 0. ])
    >>> solver.set_least_squares_right_sides([3.4, 0.0])
    >>> solver.solve(warm_start="offer").values
    array([3.2, 3. ])
    """

    def __init__(self, problem: Problem) -> None:
        self._variables = problem.variables
        self._handle = Handle.made("roundel_solver", lib.roundel_solver_new, problem._handle.pointer)

    def _replace(self, call: Any, values: Any, what: str) -> None:
        given = reals(values, what)
        check(call(self._handle.pointer, pointer(given), len(given)))

    def set_linear(self, q: Any) -> None:
        """Replaces the linear term, but not the contribution of least-squares rows to it."""
        self._replace(lib.roundel_solver_set_linear, q, "q")

    def set_constraint_right_sides(self, d: Any) -> None:
        """Replaces the right sides of the constraints, in the order in which they were added."""
        self._replace(lib.roundel_solver_set_constraint_right_sides, d, "d")

    def set_least_squares_right_sides(self, b: Any) -> None:
        """Replaces the right sides of the least-squares rows, in the order in which they were added."""
        self._replace(lib.roundel_solver_set_least_squares_right_sides, b, "b")

    def set_guess(self, values: Any) -> None:
        """Sets the point whose values variables keep where the objective does not determine them."""
        self._replace(lib.roundel_solver_set_guess, values, "guess")

    def pin(self, variable: int, value: float) -> None:
        """Fixes a variable to a value, or changes the value of a pinned variable."""
        check(lib.roundel_solver_pin(self._handle.pointer, variable, value))

    def unpin(self, variable: int) -> None:
        """Releases a pinned variable. A free variable stays free."""
        check(lib.roundel_solver_unpin(self._handle.pointer, variable))

    def solve(
        self, *, progress: Progress = None, cancel: Optional[CancelToken] = None, **options: Any
    ) -> Solution:
        """Solves the problem with its current data. Keywords are those of `roundel.solve`."""
        handle, watch = options_handle(options), Watch(progress, cancel)
        place = ffi.new("roundel_solution **")
        call = lib.roundel_solver_solve
        status = call(self._handle.pointer, handle.pointer, watch.pointer, place)
        watch.check(status, self._variables)
        return taken(Handle("roundel_solution", place[0]).pointer)
