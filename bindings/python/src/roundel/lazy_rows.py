"""Rows that a function adds during a solve."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, Optional

import numpy as np

from ._handle import Handle
from ._library import ffi
from .errors import ArgumentTypeError, refusal
from .problem import Problem
from .watch import Watch


@dataclass(frozen=True)
class Candidate:
    """A point that rows may cut off, for the function given as `lazy_rows` to `solve`.

    Attributes:

      values: np.ndarray
          One value for each variable.
      energy: float
          The objective at the point.
      is_integer: bool
          Whether all integer variables have integer values; False for the minimiser of a relaxation.
    """

    values: np.ndarray
    energy: float
    is_integer: bool


#: A function of a candidate and an empty problem, to which it adds inequalities and constraints. It returns a
#: true value to end the solve.
LazyRows = Optional[Callable[[Candidate, Problem], Any]]


def callback_of(lazy_rows: Any, watch: Watch) -> Any:
    """The library's callback for a function of the caller, to be kept until the call ends."""
    if not callable(lazy_rows):
        raise refusal(ArgumentTypeError, f"lazy_rows should be a function, and is {lazy_rows!r}")

    def ask(candidate: Any, rows: Any, _: Any) -> bool:
        values = np.frombuffer(ffi.buffer(candidate.values, 8 * candidate.count)).copy()
        point = Candidate(values, candidate.energy, bool(candidate.is_integer))
        lent = Problem(0, Handle.lent(rows))
        try:
            return bool(lazy_rows(point, lent))
        finally:
            # The library frees the rows when the function returns.
            lent._handle = Handle.lent(ffi.NULL)

    return watch.hears("roundel_lazy_callback", ask)
