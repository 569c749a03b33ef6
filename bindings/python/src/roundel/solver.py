"""Solves one problem many times with changing data."""

from __future__ import annotations

from typing import Any, Optional

from ._groups import SOLVE, TUNING, WATCH
from ._handle import Handle
from ._library import ffi, lib
from ._types import ArrayLike
from .arrays import indices32, pointer, real, reals, sides, whole
from .errors import check
from .events import Progress
from .keywords import checked, takes
from .options import options_handle
from .problem import Problem
from .solution import Solution, taken_from
from .watch import CancelToken, Watch


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
        self._constraints = problem.constraints
        self._inequalities = problem.inequalities
        self._last: Optional[Solution] = None
        self._handle = Handle.made("roundel_solver", lib.roundel_solver_new, problem._handle.pointer)

    def __repr__(self) -> str:
        sizes = f"{self._variables} variables, {self._constraints} constraints"
        last = "not solved yet" if self._last is None else f"last {self._last!r}"
        return f"<Solver: {sizes}, {last}>"

    def _replace(self, call: Any, values: Any, what: str) -> None:
        given = reals(values, what)
        check(call(self._handle.pointer, pointer(given), len(given)))

    def set_linear(self, q: ArrayLike) -> None:
        """Replaces the linear term, but not the contribution of least-squares rows to it."""
        self._replace(lib.roundel_solver_set_linear, q, "q")

    def set_constraint_right_sides(self, d: ArrayLike) -> None:
        """Replaces the right sides of the constraints, in the order in which they were added."""
        self._replace(lib.roundel_solver_set_constraint_right_sides, d, "d")

    def set_least_squares_right_sides(self, b: ArrayLike) -> None:
        """Replaces the right sides of the least-squares rows, in the order in which they were added."""
        self._replace(lib.roundel_solver_set_least_squares_right_sides, b, "b")

    def set_inequality_sides(
        self, lower: Optional[ArrayLike] = None, upper: Optional[ArrayLike] = None
    ) -> None:
        """Replaces the sides of the inequalities: one number for each, one for all, or None for no limit."""
        below, above = sides(lower, upper, self._inequalities)
        arrays = (pointer(below), pointer(above), len(below))
        check(lib.roundel_solver_set_inequality_sides(self._handle.pointer, *arrays))

    def set_bounds(
        self,
        variables: ArrayLike,
        lower: Optional[ArrayLike] = None,
        upper: Optional[ArrayLike] = None,
    ) -> None:
        """Sets bounds in place of earlier ones of these variables, as `Problem.bounds` does."""
        at = indices32(variables, "variables")
        below, above = sides(lower, upper, len(at))
        arrays = (len(at), pointer(at), pointer(below), pointer(above))
        check(lib.roundel_solver_set_bounds(self._handle.pointer, *arrays))

    def set_guess(self, values: ArrayLike) -> None:
        """Sets the point whose values variables keep where the objective does not determine them."""
        self._replace(lib.roundel_solver_set_guess, values, "guess")

    def pin(self, variable: int, value: float) -> None:
        """Fixes a variable to a value, or changes the value of a pinned variable."""
        check(lib.roundel_solver_pin(self._handle.pointer, whole(variable, "variable"), real(value, "value")))

    def unpin(self, variable: int) -> None:
        """Releases a pinned variable. A free variable stays free."""
        check(lib.roundel_solver_unpin(self._handle.pointer, whole(variable, "variable")))

    @takes(SOLVE, WATCH, TUNING)
    def solve(
        self, *, progress: Progress = None, cancel: Optional[CancelToken] = None, **options: Any
    ) -> Solution:
        """Solves the problem with its current data."""
        options = checked(Solver.solve, options)
        handle, watch = options_handle(options), Watch(progress, cancel)
        place = ffi.new("roundel_solution **")
        call = lib.roundel_solver_solve
        with watch:
            status = call(self._handle.pointer, handle.pointer, watch.pointer, place)
        self._last = watch.result(status, lambda: taken_from(place), self._variables)
        return self._last
