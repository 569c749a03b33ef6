"""Solving a problem once."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Literal, Mapping, Optional, Union

import numpy as np

from ._groups import SOLVE, TUNING, WATCH
from ._handle import Handle
from ._library import ffi, lib, path
from ._types import ArrayLike, File, MatrixLike
from .arrays import compressed, reals
from .errors import ArgumentTypeError, refusal
from .events import Progress
from .keywords import checked, takes
from .lazy_rows import LazyRows, callback_of
from .options import options_handle
from .problem import Problem
from .proof import report_of
from .solution import Solution, taken_from
from .watch import CancelToken, Watch


@takes(SOLVE, WATCH, TUNING)
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
    progress: Progress = None,
    cancel: Optional[CancelToken] = None,
    **options: Any,
) -> Solution:
    """Minimises 1/2 x'Qx + q'x + c + sum_k weights_k (A_k x - b_k)^2 under linear constraints.

    The constraints are equations C x = d, inequalities l <= G x <= u, and bounds of variables. The sum over k is that over the rows of A. Matrices are NumPy arrays or SciPy matrices with one column
    for each variable; what is not given is zero, and one of Q, q and A must be given.

      Q: a symmetric matrix, without a direction in which the objective curves downwards; or a `Problem`, in
          place of all arguments up to `triangle`.
      q, c: the linear term and the constant.
      A, b, weights: rows of least squares, their right sides, and their weights, 1 by default.
      C, d: equations that hold exactly.
      inequalities: a matrix G and the sides l and u, each one number for each row of G or one for all. A side
          that does not limit is infinite, or None for all rows.
      bounds: the lower and the upper bounds, each one number for each variable or one for all. A bound that
          does not limit is infinite, or None for all variables.
      binaries: the variables that must be 0 or 1, given as integers are.
      integers: the variables that must be integer, as indices or as a boolean for each variable.
      pins: variables and the values that they are fixed to.
      guess: the values that variables keep where the objective does not determine them.
      triangle: which entries of Q are given, "full", "upper" or "lower".
      lazy_rows: a function of a `Candidate` and an empty `Problem`, called for each point that could become the
          solution, and for the minimiser of each relaxation that is not integer. The inequalities and
          constraints that it adds to the problem hold for the rest of the solve, and a point that they cut off
          is never the solution. What it adds must not depend on the order of its calls. A true value that it
          returns ends the solve.
      proof: a file for a proof of the bound, or that there is no solution, which `check_proof` confirms. The
          strategy must be "exact" or "auto". Half of `time_limit` is for the search at most. A proof that the
          limit or a cancel ends is not written; `Solution.proof` tells.

    Python's lock is free during the solve. An exception of `progress` ends it and is raised again.

    >>> import numpy as np, roundel
    >>> Q = np.array([[4.0, -2.0], [-2.0, 2.0]])
    >>> s = roundel.solve(Q, [-0.8, 0.0], 0.16, integers=[1], strategy="exact")
    >>> s.values, s.proved
    (array([0.2, 0. ]), True)

    >>> s = roundel.solve(A=np.eye(3), b=[0.2, 1.7, 0.4], C=[[1, 1, 1]], d=[4], integers=[0, 1, 2])
    >>> s.values
    array([1., 2., 1.])

    >>> limits = {"inequalities": ([[1, 1]], None, 3), "bounds": (0, [1, 9])}     # x0 + x1 <= 3
    >>> s = roundel.solve(A=np.eye(2), b=[2.6, 1.4], integers=[0, 1], **limits)
    >>> s.values
    array([1., 1.])

    >>> def in_order(candidate, rows):                                             # x0 <= x1
    ...     if candidate.values[0] > candidate.values[1]:
    ...         _ = rows.inequality([0, 1], [1, -1], upper=0)
    >>> s = roundel.solve(A=np.eye(2), b=[2.6, 1.4], integers=[0, 1], lazy_rows=in_order)
    >>> s.values
    array([2., 2.])

    A problem that cannot be solved raises an `Error` that names the element at fault:

    >>> roundel.solve(Q, integers=[0, 2])
    Traceback (most recent call last):
    ...
    roundel.errors.IndexOutOfRangeError: integer variables: entry 1 is 2, outside 0..2
    """
    options = checked(solve, options)
    if isinstance(Q, Problem):
        limits = (inequalities, bounds, binaries)
        if any(part is not None for part in (q, A, b, weights, C, d, *limits, integers, pins, guess)):
            told = "a problem stands for all arguments: change the problem"
            raise refusal(ArgumentTypeError, told)
        problem = Q
    else:
        problem = _assembled(Q, q, c, A, b, weights, C, d, integers, pins, guess, triangle)
        _limit(problem, inequalities, bounds, binaries)
    handle, watch = options_handle(options), Watch(progress, cancel)
    place = ffi.new("roundel_solution **")
    pointer = problem._handle.pointer
    if proof is not None:
        if lazy_rows is not None:
            raise refusal(ArgumentTypeError, "proof: there is none of a problem with lazy_rows")
        report = ffi.new("roundel_proof_report *")
        with watch:
            call = lib.roundel_problem_solve_with_proof
            status = call(pointer, handle.pointer, watch.pointer, path(proof), report, place)
        made = lambda: replace(taken_from(place), proof=report_of(report))  # noqa: E731
        return watch.result(status, made, problem.variables)
    if lazy_rows is None:
        with watch:
            status = lib.roundel_problem_solve(pointer, handle.pointer, watch.pointer, place)
    else:
        callback = callback_of(lazy_rows, watch)
        with watch:
            call = lib.roundel_problem_solve_lazy
            status = call(pointer, handle.pointer, watch.pointer, callback, ffi.NULL, place)
    return watch.result(status, lambda: taken_from(place), problem.variables)


def _assembled(
    Q: Any,
    q: Any,
    c: float,
    A: Any,
    b: Any,
    weights: Any,
    C: Any,
    d: Any,
    integers: Any,
    pins: Optional[Mapping[int, float]],
    guess: Any,
    triangle: Literal["full", "upper", "lower"],
) -> Problem:
    if (A is None) != (b is None) or (A is None and weights is not None):
        raise refusal(ArgumentTypeError, "A and b belong together, and weights with them")
    if (C is None) != (d is None):
        raise refusal(ArgumentTypeError, "C and d belong together")
    if Q is not None:
        Q = compressed(Q, "Q")
        variables = Q.shape[1]
    elif q is not None:
        q = reals(q, "q")
        variables = len(q)
    elif A is not None:
        A = compressed(A, "A")
        variables = A.shape[1]
    else:
        raise refusal(ArgumentTypeError, "one of Q, q and A must be given")
    problem = Problem(variables)
    if Q is not None:
        problem.quadratic(Q, triangle)
    if q is not None:
        problem.linear(q)
    problem.constant(c)
    if A is not None:
        problem.least_squares_rows(A, b, weights)
    if C is not None:
        problem.constrain_rows(C, d)
    if integers is not None:
        problem.integer(integers)
    for variable, value in (pins or {}).items():
        problem.pin(variable, value)
    if guess is not None:
        problem.guess(guess)
    return problem


def _limit(problem: Problem, inequalities: Any, bounds: Any, binaries: Any) -> None:
    """Adds inequalities, bounds and binaries."""
    if inequalities is not None:
        problem.inequality_rows(*_parts(inequalities, "inequalities", "a matrix, lower and upper sides"))
    if bounds is not None:
        lower, upper = _parts(bounds, "bounds", "lower and upper bounds")
        problem.bounds(np.arange(problem.variables), lower, upper)
    if binaries is not None:
        problem.binary(binaries)


def _parts(given: Any, what: str, wanted: str) -> Any:
    if not isinstance(given, (tuple, list)) or len(given) != (3 if what == "inequalities" else 2):
        raise refusal(ArgumentTypeError, f"{what}: there must be {wanted}, as a tuple")
    return given
