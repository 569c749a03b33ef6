"""Solving a problem once."""

from __future__ import annotations

from typing import Any, Mapping, Optional, Union

from ._handle import Handle
from ._library import ffi, lib
from .arrays import compressed
from .options import options as solve_options, options_handle, with_options
from .problem import Problem
from .solution import Solution, taken
from .watch import CancelToken, Progress, Watch


@with_options(solve_options())
def solve(
    Q: Union[Problem, Any] = None,
    q: Any = None,
    c: float = 0.0,
    *,
    A: Any = None,
    b: Any = None,
    weights: Any = None,
    C: Any = None,
    d: Any = None,
    integers: Any = None,
    pins: Optional[Mapping[int, float]] = None,
    guess: Any = None,
    triangle: str = "full",
    progress: Progress = None,
    cancel: Optional[CancelToken] = None,
    **options: Any,
) -> Solution:
    """Minimises 1/2 x'Qx + q'x + c + sum_k weights_k (A_k x - b_k)^2 subject to C x = d.

    Instead of all these, the first argument may be a `Problem`. Matrices are dense or SciPy matrices
    with one column for each variable; those not given are zero. `integers` are indices of variables,
    or a boolean for each variable. `pins` fixes variables to values. Where the objective does not
    determine variables, they keep the values of `guess`. `triangle` says which entries of Q are given.

    `progress` is True for a progress line on stderr, or a function that is called with an `Event`. If
    it returns a true value, the solve ends with the best solution so far. An exception from it ends
    the solve and is raised again. Ctrl-C ends the solve and raises KeyboardInterrupt. `cancel` may be
    set from another thread, because the solve releases Python's lock. `options` are those of the
    library (see `roundel.options()`), and `preset`.

    >>> import numpy as np, roundel
    >>> Q = np.array([[4.0, -2.0], [-2.0, 2.0]])
    >>> s = roundel.solve(Q, [-0.8, 0.0], 0.16, integers=[1], strategy="exact")
    >>> s.values, s.proved
    (array([0.2, 0. ]), True)

    >>> s = roundel.solve(A=np.eye(3), b=[0.2, 1.7, 0.4], C=[[1, 1, 1]], d=[4], integers=[0, 1, 2])
    >>> s.values
    array([1., 2., 1.])

    A problem that cannot be solved raises an `Error` that names the element at fault:

    >>> roundel.solve(Q, integers=[0, 2])
    Traceback (most recent call last):
    ...
    roundel.errors.IndexOutOfRangeError: integer variables: entry 1 is 2, outside 0..2
    """
    if isinstance(Q, Problem):
        if any(part is not None for part in (q, A, b, weights, C, d, integers, pins, guess)):
            raise TypeError("a problem stands for all arguments: change the problem")
        problem = Q
    else:
        problem = _assembled(Q, q, c, A, b, weights, C, d, integers, pins, guess, triangle)
    handle, watch = options_handle(options), Watch(progress, cancel)
    place = ffi.new("roundel_solution **")
    pointer = problem._handle.pointer
    status = lib.roundel_problem_solve(pointer, handle.pointer, watch.pointer, place)
    watch.check(status, problem.variables)
    return taken(Handle("roundel_solution", place[0]).pointer)


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
    triangle: str,
) -> Problem:
    if (A is None) != (b is None) or (A is None and weights is not None):
        raise TypeError("A and b belong together, and weights with them")
    if (C is None) != (d is None):
        raise TypeError("C and d belong together")
    if Q is not None:
        Q = compressed(Q, "Q")
        variables = Q.shape[1]
    elif q is not None:
        variables = len(q)
    elif A is not None:
        A = compressed(A, "A")
        variables = A.shape[1]
    else:
        raise TypeError("one of Q, q and A must be given")
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
